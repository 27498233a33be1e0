"""Checks of secondary beams: pinned ends, uniform load, the top flange held by the slab. EN 1993-1-1, 6.2 and 7.2."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.codes.ec3.member import Member, Stability, Strength
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_class import section_class
from edesign.project.building.building import Building
from edesign.space.structure.design_block import design_of
from edesign.space.structure.load_cases import NON_STRUCTURAL, PERMANENT
from edesign.space.structure.secondary_beams import SecondaryBeam, secondary_beams
from edesign.space.structure.steel_by_thickness import steel_by_thickness

DEFLECTION = "EN 1993-1-1, 7.2.1(1)B"
"""Clause of the deflections of secondary beams."""
LARGEST_CLASS = 3


def secondary_criteria(
    building: Building, fundamental: Sequence[Combination], characteristic: Sequence[Combination]
) -> list[RuleCheck]:
    """Return bending, shear and deflection of the secondary beams that have a section; the limits are those of beams.

    Own load cases do not count, and reduced live loads neither. Shear does not reduce bending: it is greatest where
    the moment is zero.

    Args:
        building: with steels by thickness and the block `design`.
        fundamental: combinations for persistent situations.

    Source: EN 1993-1-1:2005, 6.2.5(2), 6.2.6(1), 7.2.1(1)B; deflection 5 w L4 / 384 E I, M = w L2 / 8, V = w L / 2.
    """
    design, found = design_of(building), []
    limits = design.serviceability.beams
    for beam in secondary_beams(building):
        _, steel = steel_by_thickness(building, beam.section, beam.material)
        section = section_of(building, beam.section)
        at = f"floor {beam.floors[0]}" if len(beam.floors) == 1 else f"floors {beam.floors[0]} to {beam.floors[-1]}"
        w, row = max(((_load(beam, row.static), row.name) for row in fundamental), key=lambda each: each[0])
        number = section_class(section, steel.fy, 0.0).number
        if number > LARGEST_CLASS:
            found.append(at_most("EN 1993-1-1, 5.5", f"class of {beam.name}", LARGEST_CLASS, number, at))
            continue
        strength = Strength(
            Member(section, steel.fy, Stability(0.0, 0.0, 0.0), number, gamma_M0=design.partial_factors.M0)
        )
        M, V = w * beam.length**2 / 8.0, w * beam.length / 2.0
        detail = f"{at}: {row}"
        found.append(at_most("EN 1993-1-1, 6.2.5", f"{beam.name}, M_Ed / M_c,Rd", 1.0, M / strength.M_Rd("y"), detail))
        found.append(at_most("EN 1993-1-1, 6.2.6", f"{beam.name}, V_Ed / V_c,Rd", 1.0, V / strength.V_Rd("z"), detail))
        bent = 5.0 * beam.length**3 / (384.0 * steel.E * section.I_y)
        for text, limit, permanent in (("all loads", limits.total, 1.0), ("variable loads alone", limits.live, 0.0)):
            if limit is not None:
                w = max(_load(beam, row.static, permanent) for row in characteristic)
                found.append(at_most(DEFLECTION, f"deflection of {beam.name} over span, {text}", limit, w * bent, at))
    return found


def _load(beam: SecondaryBeam, static: Mapping[str, float], permanent: float = 1.0) -> float:
    """The load of a combination on a beam, N/m; of a pattern the half that acts."""
    total = permanent * (static.get(PERMANENT, 0.0) * beam.G + static.get(NON_STRUCTURAL, 0.0) * beam.G2)
    for category, Q in beam.Q.items():
        names = [f"{stem}{half}" for stem in ("Q", f"Q_{category}") for half in ("", "1", "2")]
        total += max(static.get(name, 0.0) for name in names) * Q
    return total
