"""Yield rotations of beams and columns, and the lower-bound strength of columns."""

from __future__ import annotations

import math

from edesign.codes.fema356.sections import ISection


def beam_yield_rotation(section: ISection, length: float) -> float:
    """Return theta_y = Z F_ye l_b / (6 E I_b), rad: the chord rotation at the plastic moment, in double curvature.

    Args:
        length: l_b, m.

    Source: FEMA 356, 5.5.2.2.2, Eq. 5-1.
    """
    return section.plastic_modulus * section.expected_yield * length / (6.0 * section.E * section.inertia)


def column_yield_rotation(section: ISection, length: float, compression: float) -> float:
    """Return theta_y = Z F_ye l_c / (6 E I_c) (1 - P/P_ye), rad, not less than zero.

    Args:
        length: l_c, m.
        compression: P, N; tension (negative) counts as none.

    Source: FEMA 356, 5.5.2.2.2, Eq. 5-2.
    """
    reduction = 1.0 - max(compression, 0.0) / section.yield_axial_force
    return beam_yield_rotation(section, length) * max(reduction, 0.0)


def lower_bound_axial_strength(section: ISection, in_plane: float, out_of_plane: float) -> float:
    """Return P_CL, N: flexural buckling about the weaker of both axes, with a resistance factor of 1.

    Args:
        section: of the column.
        in_plane: effective length for buckling in the plane of bending, m.
        out_of_plane: effective length for buckling out of it, m.

    Source: FEMA 356, 5.5.2.3.2: AISC LRFD chapter E with F_yLB and phi = 1; the column curve is that of AISC 360-16,
        E3, Eqs. E3-2 to E3-4 (0.658^(F_y/F_e) F_y; 0.877 F_e where F_y/F_e > 2.25). Local and torsional buckling are
        not in it.
    """
    axes = ((section.inertia, in_plane), (section.weak_inertia, out_of_plane))
    euler = min(math.pi**2 * section.E * inertia / (section.area * length**2) for inertia, length in axes)
    ratio = section.lower_bound_yield / euler
    stress = section.lower_bound_yield * 0.658**ratio if ratio <= 2.25 else 0.877 * euler
    return section.area * stress
