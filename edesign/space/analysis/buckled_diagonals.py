"""Columns beside single diagonals that buckle, EN 1998-1:2004, 6.7.4(3).

Where the diagonals in tension and in compression do not cross, those in compression push at other columns than those
that the diagonals in tension pull at, with as much as their buckling resistance. Their vertical components go down the
column lines, as `bracing` says, beside the amplified effects of the diagonals in tension.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np

from edesign.codes.ec3.member import Member, Stability, Strength
from edesign.codes.ec3.section import SteelSection
from edesign.codes.en1990.combinations import Combination
from edesign.project.building.building import Building, Steel
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.effects import Effects
from edesign.space.structure.design_block import design_of
from edesign.space.structure.frame import SpaceFrame

CASES = ("buckling+", "buckling-")
"""Diagonals in compression at their buckling resistance, those that fall along the axis, and those that rise."""
CROSSING = "cross"
N = 0  # place in internal forces
WITHOUT_EFFECT = 3  # class of a section: buckling resistances of classes 1 to 3 are the same


def single_diagonals(frame: SpaceFrame, bracing: Bracing) -> np.ndarray:
    """Return which braces count in tension only and cross no other one, (b,)."""
    members = [frame.members[number] for number in bracing.braces]
    return np.array([not of.compression and of.bracing != CROSSING for of in members], dtype=bool)


def with_buckled_diagonals(
    effects: Effects, frame: SpaceFrame, bracing: Bracing, single: np.ndarray, building: Building
) -> Effects:
    """Return the effects with the axial forces of columns beside buckled diagonals, as two more static cases.

    Args:
        effects: of all actions.
        frame: with its sections.
        bracing: of the building.
        single: by `single_diagonals`.
        building: with its materials and the block `design`.
    """
    design = design_of(building)
    gamma_M1 = design.partial_factors.M1
    N_b = np.zeros(bracing.braces.size)
    for column in np.flatnonzero(single):
        number = int(bracing.braces[column])
        member, length = frame.members[number], float(frame.length[number])
        steel = building.materials[member.material]
        factor = design.members.buckling_length.of(member.kind, member.group, member.storey)
        N_b[column] = _buckling_resistance(
            frame.section(member.section), steel, factor.y * length, factor.z * length, gamma_M1
        )
    found = np.zeros((len(CASES), *effects.static.shape[1:]))
    for case, in_tension in enumerate(bracing.in_tension):
        pushed = bracing.to_columns @ np.where(in_tension, 0.0, -N_b)
        found[case, bracing.columns, :, N] = pushed[:, None]
    return Effects((*effects.cases, *CASES), np.concatenate([effects.static, found]), effects.seismic)


def buckling_combinations(rows: Sequence[Combination]) -> tuple[Combination, ...]:
    """Return amplified combinations with buckled diagonals, for either sense; signs of E_x and E_y do not count.

    Args:
        rows: with amplified seismic effects.
    """
    return tuple(
        replace(row, name=f"{row.name} + {case}", static={**row.static, case: 1.0})
        for row in rows
        if row.seismic[0] > 0.0 and row.seismic[1] > 0.0
        for case in CASES
    )


@cache
def _buckling_resistance(section: SteelSection, steel: Steel, L_cr_y: float, L_cr_z: float, gamma_M1: float) -> float:
    shear_modulus = steel.E / (2.0 * (1.0 + steel.nu))
    stability = Stability(L_cr_y=L_cr_y, L_cr_z=L_cr_z, L_LT=0.0)
    member = Member(section, steel.fy, stability, WITHOUT_EFFECT, E=steel.E, G=shear_modulus, gamma_M1=gamma_M1)
    return min(Strength(member).flexural(axis).N_b_Rd for axis in ("y", "z"))
