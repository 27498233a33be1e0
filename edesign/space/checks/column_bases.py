"""Column bases of moment frames, where plastic hinges are planned, EN 1998-1:2004, 6.6.1(1)P and 6.6.3(2)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from edesign.codes.ec3.cross_section import axial_resistance, moment_resistance, shear_resistance
from edesign.codes.ec8.steel.moment_frames import SHEAR_LIMIT, column_hinge_shear
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck, at_most, first_of_largest
from edesign.frame.sections.section_class import section_class
from edesign.project.building.building import Steel
from edesign.space.analysis.effects import Effects, largest
from edesign.space.checks.capacity import bend_about_y, by_section
from edesign.space.structure.frame import Axis, SpaceFrame

N, M_Y, M_Z = 0, 4, 5  # places in internal forces
_TURNS = {"x": 4, "y": 3}  # degree of a support that turns under horizontal forces along an axis


def hinged_bases(frame: SpaceFrame, axis: Axis) -> np.ndarray:
    """Return the numbers of the columns on supports that restrain rotation by forces along an axis.

    Above a rigid basement these are the columns that stand on the highest held floor.

    Args:
        axis: direction of the horizontal forces.

    Returns:
        (n,) numbers.

    Source: EN 1998-1:2004, 4.4.2.6(5): the lowest cross-section where a plastic hinge can form.
    """
    if frame.held:
        return frame.columns[frame.level_of_nodes[frame.ends[0][frame.columns]] == frame.held]
    turn = _TURNS[axis]
    restrained = frame.fixed[:, turn] | (frame.springs[:, turn] > 0.0)
    return np.array([number for number in frame.columns if restrained[frame.members[number].start]], dtype=int)


def base_criteria(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    effects: Effects,
    amplified: Sequence[Combination],
    bases: np.ndarray,
    axis: Axis,
    highest: int,
    gamma_M0: float,
    axial: float | None = None,
) -> Iterator[RuleCheck]:
    """Yield the rules for hinges at the column bases: class of the section, and shear with M_pl,Rd at the column base.

    Columns whose section has no class do not count.

    The moment at the column base is M_pl,Rd, that at the head what the amplified combinations give; V_Ed is their sum
    over the length. N_Ed, which the class depends on, is that of the amplified combinations.

    Args:
        materials: its steels, by name.
        amplified: combinations for members that must not yield.
        bases: numbers of the columns, by `hinged_bases`.
        axis: of the moment frame.
        highest: class that dissipative sections may have.
        gamma_M0: partial factor.
        axial: largest N_Ed / N_pl,Rd; None: there is no limit. The clause does not say which N_Ed; that of the
            amplified combinations is taken, the largest one.

    Source: EN 1998-1:2004, 6.5.3(2); 6.6.3(2) and (4), Eq. 6.7; NTC 2018, 7.5.3.2, Eq. 7.5.3.
    """
    bases = np.setdiff1d(bases, frame.unclassified)
    if not bases.size:
        return
    of_bases = Effects(effects.cases, effects.static[:, bases], effects.seismic[:, bases])
    acting = largest(of_bases, amplified)
    pairs, of_members = frame.sections
    worst, where = 0, ""
    for kind in np.unique(of_members[bases]):
        name, material = pairs[kind]
        force = float(acting[of_members[bases] == kind, 0, N].max())
        of = section_class(frame.section(name), materials[material].fy, -force, about_y=True).number
        if of > worst:
            worst, where = of, name
    yield at_most("6.5.3(2)", f"class of columns at hinges at their bases, direction {axis}", highest, worst, where)
    if axial is not None:
        N_pl = by_section(frame, materials, lambda of, steel: axial_resistance(of.A, steel.fy, gamma_M0))[bases]
        share = acting[:, 0, N] / N_pl
        most = first_of_largest(share)
        text = f"N_Ed / N_pl,Rd of columns at hinges at their bases, direction {axis}"
        yield at_most(
            "NTC 2018, 7.5.3.2", text, axial, float(share[most]), f"{frame.members[bases[most]].name}; N_Ed by 7.5.7"
        )
    about_y = bend_about_y(frame, bases, axis)
    head = np.where(about_y, acting[:, -1, M_Y], acting[:, -1, M_Z])
    resistances = np.array(
        [
            by_section(frame, materials, lambda of, steel: moment_resistance(of.W_pl_y, steel.fy, gamma_M0))[bases],
            by_section(frame, materials, lambda of, steel: moment_resistance(of.W_pl_z, steel.fy, gamma_M0))[bases],
            by_section(frame, materials, lambda of, steel: shear_resistance(of.A_vz, steel.fy, gamma_M0))[bases],
            by_section(frame, materials, lambda of, steel: shear_resistance(of.A_vy, steel.fy, gamma_M0))[bases],
        ]
    )
    M_pl, V_pl = np.where(about_y, resistances[0], resistances[1]), np.where(about_y, resistances[2], resistances[3])
    ratio = column_hinge_shear(M_pl, head, frame.length[bases]) / V_pl
    worst_base = first_of_largest(ratio)
    yield at_most(
        "6.6.3(4)",
        f"V_Ed / V_pl,Rd of columns with M_pl,Rd at the column base, direction {axis}",
        SHEAR_LIMIT,
        float(ratio[worst_base]),
        frame.members[bases[worst_base]].name,
    )
