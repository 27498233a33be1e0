"""The load cases of a building as actions of EN 1990: permanent and variable ones, with their factors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from edesign.codes.ec8.national import ActionFactors, NationalParameters, Psi
from edesign.codes.en1990.actions import PERMANENT
from edesign.codes.en1990.combinations import Combination, stated
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.load_cases import NON_STRUCTURAL, PATTERNED
from edesign.space.structure.masses import psi_2


def with_joined_cases(frame: SpaceFrame) -> SpaceFrame:
    """Return the frame with its permanent cases as one, `G`, and a single category of use as `Q`; own cases last.

    Permanent loads that are not structural stay apart, as `G2`.
    """
    structural = [case for case in frame.cases.values() if case.category == PERMANENT and case.name != NON_STRUCTURAL]
    apart = [case for case in frame.cases.values() if case.name == NON_STRUCTURAL]
    variable = [case for case in frame.cases.values() if case.category != PERMANENT and not case.own]
    if len({case.category for case in variable}) == 1:
        single = f"Q_{variable[0].category}"
        variable = [replace(case, name="Q" + case.name.removeprefix(single)) for case in variable]
    own = [case for case in frame.cases.values() if case.own]
    cases = {"G": _sum("G", structural)} | {case.name: case for case in (*apart, *variable, *own)}
    return frame.with_sections(frame.members, cases, frame.node_mass)


def _sum(name: str, cases: Sequence[LoadCase]) -> LoadCase:
    return LoadCase(
        name,
        PERMANENT,
        nodal=np.sum([case.nodal for case in cases], axis=0),
        uniform=np.sum([case.uniform for case in cases], axis=0),
        point_member=np.concatenate([case.point_member for case in cases]),
        point_position=np.concatenate([case.point_position for case in cases]),
        point_force=np.concatenate([case.point_force for case in cases]),
    )


def relieving_cases(cases: Mapping[str, LoadCase]) -> tuple[str, ...]:
    """Return the names of the cases that may relieve what others load."""
    return tuple(name for name, case in cases.items() if case.relieving)


def patterns_of(cases: Mapping[str, LoadCase], pattern: str) -> tuple[frozenset[str], ...]:
    """Return the cases that act in each pattern of imposed loads; nothing without patterns.

    Args:
        cases: load cases by name, those of halves of the bays with names that end in 1 and 2.
    """
    if pattern == "none":
        return ()
    imposed = [name for name, case in cases.items() if case.category in PATTERNED and not case.own]
    return tuple(frozenset(name for name in imposed if name[-1] != other) for other in "21")


def stated_combinations(design: Design, cases: Mapping[str, LoadCase]) -> tuple[Combination, ...]:
    """Return the combinations whose factors the file states.

    Args:
        cases: load cases by name; `Q_B` stands for `Q` where it is the only category, and for both halves of a pattern.
    """
    found = []
    for row in design.fundamental.stated:
        factors = {}
        for written, factor in row.items():
            for name, case in cases.items():
                if name == written or (not case.own and written in ("Q", f"Q_{case.category}") and name[0] == "Q"):
                    factors[name] = factor
        found.append(stated({name: factors[name] for name in cases if name in factors}))
    return tuple(found)


def action_factors_of(design: Design, national: NationalParameters) -> ActionFactors:
    """Return the national partial factors with gamma_G and gamma_Q of the file."""
    return replace(national.action_factors, G_sup=design.partial_factors.G, Q=design.partial_factors.Q)


def psi_of(building: Building, national: NationalParameters) -> dict[str, Psi]:
    """Return the national psi factors; psi_2 is that of the masses where the file gives it."""
    psi = dict(national.psi) | {name: Psi(*values) for name, values in building.loads.psi.items()}
    masses = building.masses
    if masses is not None and masses.from_loads is not None:
        for category in {load.category for load in building.loads.items if load.category is not None}:
            known = psi[category]
            psi[category] = Psi(known.psi_0, known.psi_1, psi_2(building, category))
    return psi
