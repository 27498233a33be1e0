"""Sections of the braces of dampers, chosen from lists: the lightest that is strong, and as stiff as asked for.

Braces carry the force of the dampers alone: their compression is held to N_b,Rd of EN 1993-1-1, 6.3.1, with the length
between nodes times a factor. Sections of class 4 are left out, as only a part of them would count.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from edesign.codes.ec3.section import DENSITY
from edesign.errors import InputError
from edesign.frame.device_places import DamperSites, DevicePlace
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.section_lists import sections_of
from edesign.frame.sections.steel_section import SteelSection
from edesign.frame.struts import Strut
from edesign.project.dampers.dampers import AnyChosenBrace, BraceSection, ChosenBrace
from edesign.project.reading.problems import Keys, listed

LARGEST_CLASS = 3
"""Of a section whose whole area counts in compression. Source: EN 1993-1-1:2005, 6.3.1.1(3)."""


@dataclass(frozen=True)
class Candidate:
    """A section at the length of a brace.

    Attributes:
        section: its name.
        axial: E A / L, N/m.
        strut: its buckling resistance.
        line: its mass, kg/m, in proportion to the area.
    """

    section: str
    axial: float
    strut: Strut
    line: float


def candidates(
    sites: DamperSites, asked: AnyChosenBrace, length: float, keys: Keys, where: str
) -> tuple[Candidate, ...]:
    """Return the sections that braces of a length may have, the lightest first.

    Args:
        length: of a brace between its nodes, m.
        keys: of the damper or design.
        where: begins messages: the place of the key `brace`.

    Raises:
        InputError: a list has a name that is no section or family, or none of its sections may be used.
    """
    found: dict[str, Candidate] = {}
    left_out = []
    for text in asked.choose:
        try:
            sections = sections_of(text)
        except InputError as error:
            raise InputError(f"{where}.choose: {error}") from error
        for section in sections:
            brace = BraceSection(
                section=section.name,
                material=asked.material,
                buckling_length_factor=asked.buckling_length_factor,
            )
            axial, as_strut = sites.bar(brace, length, keys)
            assert as_strut is not None, "sections of the catalogue have second moments of area"
            if math.isinf(as_strut.squash):
                message = f"`{asked.material}` does not yield, so that nothing limits its braces; give one with `fy`"
                raise InputError(f"{where}.material: {message} [E-DAMPER-06]")
            if as_strut.slenderness > asked.largest_slenderness or _class(section, as_strut) > LARGEST_CLASS:
                left_out.append(section.name)
                continue
            found[section.name] = Candidate(section.name, axial, as_strut, DENSITY * section.A)
    if not found:
        why = f"are of class 4 in compression, or more slender than {asked.largest_slenderness:g}"
        raise InputError(f"{where}.choose: all of {listed(left_out)} {why} [E-DAMPER-06]")
    return tuple(sorted(found.values(), key=lambda one: (one.line, one.section)))


def chosen_brace(sites: DamperSites, asked: ChosenBrace, place: DevicePlace, keys: Keys, where: str) -> BraceSection:
    """Return the braces of a damper of a known force with the section that is chosen for them.

    Args:
        asked: what to choose from, and what the braces hold.
        where: begins messages: the place of the key `brace`.

    Raises:
        InputError: no section that may be used is strong and stiff enough.
    """
    force = _of(asked.force, place) * (asked.overstrength or 1.0) * place.share
    stiffness = 0.0 if asked.stiffness is None else _of(asked.stiffness, place)
    least = stiffness / (place.braces * place.cosine**2)
    among = candidates(sites, asked, place.length, keys, where)
    chosen = first_that_holds(among, force, least)
    if chosen is None:
        raise InputError(f"{where}.choose: {place.name}: {why_none(among, force, least)} [E-DAMPER-06]")
    return BraceSection(
        section=among[chosen].section,
        material=asked.material,
        buckling_length_factor=asked.buckling_length_factor,
    )


def first_that_holds(among: Sequence[Candidate], force: float, axial: float) -> int | None:
    """Return the number of the lightest section that is strong and stiff enough; None: none is.

    Args:
        force: compression of one brace, N.
        axial: least E A / L of one brace, N/m.
    """
    for number, one in enumerate(among):
        if one.strut.resistance >= force and one.axial >= axial * (1.0 - 1e-12):
            return number
    return None


def why_none(among: Sequence[Candidate], force: float, axial: float) -> str:
    """Return why no section is strong and stiff enough, with the best that there is.

    Args:
        force: compression of one brace, N.
        axial: least E A / L of one brace, N/m.
    """
    strong = max(among, key=lambda one: one.strut.resistance)
    stiff = max(among, key=lambda one: one.axial)
    if strong.strut.resistance < force:
        return (
            f"no section holds {1e-3 * force:.4g} kN over {strong.strut.length:.3g} m; the strongest, "
            f"{strong.section}, has N_b,Rd = {1e-3 * strong.strut.resistance:.4g} kN"
        )
    if stiff.axial < axial:
        return (
            f"no section has E A / L = {1e-6 * axial:.4g} kN/mm; the stiffest, {stiff.section}, has "
            f"{1e-6 * stiff.axial:.4g} kN/mm"
        )
    return (
        f"no section has both N_b,Rd = {1e-3 * force:.4g} kN and E A / L = {1e-6 * axial:.4g} kN/mm; the strongest is "
        f"{strong.section}, the stiffest {stiff.section}"
    )


def _class(section: SteelSection, as_strut: Strut) -> int:
    return section_class(section, as_strut.squash / section.A, N_Ed=-1.0, about_y=False).number


def _of(values: float | tuple[float, ...], place: DevicePlace) -> float:
    return values[place.index] if isinstance(values, tuple) else values
