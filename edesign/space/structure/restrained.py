"""Buckling-restrained braces of a building: the values of their manufacturer, for the core that each of them has."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.damper.law_file import WHAT, Source, read_law_file, resolve
from edesign.project.building.building import Building
from edesign.project.building.members import BraceRun
from edesign.project.dampers.dampers import LawDescription
from edesign.space.structure.frame import SpaceFrame

SAME = 1e-6
"""Relative difference of two values that are meant as one."""


def restrained_law(building: Building, number: int) -> RestrainedBrace:
    """Return the brace that the law of an entry of `braces` is of.

    Args:
        number: of the entry, which has a law.

    Raises:
        InputError: it is of another law or has other parameters, or its F_ysc and E are not those of the material.
    """
    run = building.braces[number]
    assert run.law is not None and building.dampers is not None, "the cross checks want a law"
    spec = building.dampers.laws[run.law]
    described: LawDescription = spec
    source = asked = Source(building.path, building.root, ("dampers", "laws", run.law))
    if spec.file is not None:
        described, source = read_law_file(building.folder / spec.file, building.yaml_content(spec.file, WHAT))
    values = resolve(described, source, spec.temperature, asked).for_core
    if values.law != "buckling_restrained":
        raise asked.refuse(
            ("type",), f"`{values.law}`; the braces that name this law are `buckling_restrained` [E-DEVICE-04]"
        )
    brace, steel = RestrainedBrace.of_law(values.values), building.materials[run.material]
    for parameter, of_law, key, of_steel, unit in (
        ("F_ysc", brace.yield_stress, "fy", steel.fy, "MPa"),
        ("E", brace.modulus, "E", steel.E, "MPa"),
    ):
        if abs(of_law - of_steel) > SAME * of_steel:
            place = Source(building.path, building.root, ("braces", number))
            raise place.refuse(
                ("material",),
                f"`{run.material}` has {key} = {of_steel / 1e6:g} {unit}, and {parameter} of the law `{run.law}` is "
                f"{of_law / 1e6:g} {unit}; the core is of one steel: give both one value [E-DEVICE-04]",
            )
    return brace


def law_of_run(building: Building, run: BraceRun) -> RestrainedBrace | None:
    """Return the brace of the law of an entry; None of braces without one."""
    return None if run.law is None else restrained_law(building, building.braces.index(run))


@dataclass(frozen=True)
class RestrainedBraces:
    """The buckling-restrained braces of a frame.

    Attributes:
        numbers: (r,) numbers of the members.
        braces: each with its core and its length between work points.
    """

    numbers: np.ndarray
    braces: tuple[RestrainedBrace, ...]

    @property
    def tension(self) -> np.ndarray:
        """Adjusted strengths omega R_y P_ysc, (r,) N (AISC 341-16, F4.2a)."""
        return np.array([of.adjusted_tension for of in self.braces])

    @property
    def compression(self) -> np.ndarray:
        """Adjusted strengths beta omega R_y P_ysc, (r,) N (AISC 341-16, F4.2a)."""
        return np.array([of.adjusted_compression for of in self.braces])


def laws_of_groups(building: Building) -> Mapping[str, RestrainedBrace]:
    """Return the law of each group of buckling-restrained braces."""
    return {
        run.group or "": restrained_law(building, i) for i, run in enumerate(building.braces) if run.law is not None
    }


def restrained_braces(frame: SpaceFrame, laws: Mapping[str, RestrainedBrace]) -> RestrainedBraces:
    """Return the buckling-restrained braces of a frame with its sections.

    Args:
        laws: by `laws_of_groups`.
    """
    numbers = [number for number, member in enumerate(frame.members) if member.group in laws]
    found = []
    for number in numbers:
        member = frame.members[number]
        law, area = laws[member.group], frame.section(member.section).A
        found.append(law.at(area / law.area, float(frame.length[number])))
    return RestrainedBraces(np.array(numbers, dtype=int), tuple(found))
