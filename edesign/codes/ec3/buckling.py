"""Flexural buckling of members in compression, EN 1993-1-1:2005, 6.3.1.

Cross-sections are taken as of class 1, 2 or 3, with their whole area. For a section of class 4 the clause counts its
effective area (Eqs. 6.48 and 6.51), which is smaller. Doubly symmetric I and hollow sections buckle by torsion
(6.3.1.4) at higher forces than by bending about their weak axis, unless that has the shorter buckling length.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from edesign.codes.names import unknown
from edesign.errors import InputError

Curve = Literal["a0", "a", "b", "c", "d"]
Axis = Literal["y", "z"]
"""y: the strong axis of an I section, z: the weak one."""

IMPERFECTION: dict[str, float] = {"a0": 0.13, "a": 0.21, "b": 0.34, "c": 0.49, "d": 0.76}
"""Imperfection factor alpha of the buckling curves. Source: EN 1993-1-1:2005, Table 6.1."""
GAMMA_M1 = 1.0
"""Partial factor of members to instability. Source: EN 1993-1-1:2005, 6.1(1), recommended."""
NO_BUCKLING = 0.2
"""Slenderness up to which buckling may be ignored. Source: EN 1993-1-1:2005, 6.3.1.2(4)."""

_S460 = 460e6  # Pa: the right column of Table 6.2 begins with this steel


class Flexural(NamedTuple):
    """Flexural buckling about an axis; without it lambda is 0 and N_cr infinite.

    Attributes:
        slenderness: lambda.
        N_cr: elastic critical force, N.
        chi: reduction factor.
        N_b_Rd: resistance, N; that of torsional buckling where it is less.
    """

    slenderness: float
    N_cr: float
    chi: float
    N_b_Rd: float


def rolled_i_curve(height: float, width: float, flange: float, axis: Axis, yield_stress: float) -> Curve:
    """Return the buckling curve of a rolled I section.

    Args:
        height: h, overall, m.
        width: b, overall, m.
        flange: t_f, m.
        axis: about which it buckles.
        yield_stress: f_y, Pa; from 460 MPa on the steel counts as S460.

    Source: EN 1993-1-1:2005, Table 6.2. Flanges above 100 mm with h/b > 1.2 are not in it; they take the curve of those
        with h/b <= 1.2.
    """
    high = yield_stress >= _S460
    if flange > 0.100:
        return "c" if high else "d"
    if height / width > 1.2 and flange <= 0.040:
        if high:
            return "a0"
        return "a" if axis == "y" else "b"
    if high:
        return "a"
    return "b" if axis == "y" else "c"


def welded_i_curve(flange: float, axis: Axis) -> Curve:
    """Return the buckling curve of a welded I section.

    Args:
        flange: t_f, m.
        axis: about which it buckles.

    Source: EN 1993-1-1:2005, Table 6.2.
    """
    if flange <= 0.040:
        return "b" if axis == "y" else "c"
    return "c" if axis == "y" else "d"


def welded_box_curve(height: float, width: float, flange: float, web: float) -> Curve:
    """Return the buckling curve of a welded box about any axis.

    Args:
        height: h, m.
        width: b, m.
        flange: t_f, m.
        web: t_w, m.

    Source: EN 1993-1-1:2005, Table 6.2. Boxes of thick plates, b/t_f and h/t_w below 30, have curve c if their welds
        are thick. The size of the welds is not known here, and counts as thick.
    """
    return "c" if width / flange < 30.0 and height / web < 30.0 else "b"


def hollow_curve(yield_stress: float, cold_formed: bool = False) -> Curve:
    """Return the buckling curve of a hollow section about any axis.

    Args:
        yield_stress: f_y, Pa; from 460 MPa on the steel counts as S460.
        cold_formed: otherwise hot finished.

    Source: EN 1993-1-1:2005, Table 6.2.
    """
    if cold_formed:
        return "c"
    return "a0" if yield_stress >= _S460 else "a"


def angle_curve() -> Curve:
    """Return the buckling curve of an angle about any axis.

    Source: EN 1993-1-1:2005, Table 6.2.
    """
    return "b"


def angle_slenderness(slenderness: float) -> float:
    """Return the effective slenderness about v of an angle that one leg joins, not less than its own.

    Stocky bars lose by the eccentricity of the joint. Slender ones would win by its stiffness, which is left out: it
    needs two bolts and members that hold the ends.

    Args:
        slenderness: lambda_v of flexural buckling about the weak principal axis.

    Source: EN 1993-1-1:2005, BB.1.2(2), lambda_eff,v = 0.35 + 0.7 lambda_v.
    """
    return max(slenderness, 0.35 + 0.7 * slenderness)


def solid_curve() -> Curve:
    """Return the buckling curve of solid sections, and of U and T sections, about any axis.

    Source: EN 1993-1-1:2005, Table 6.2.
    """
    return "c"


def critical_force(modulus: float, inertia: float, length: float) -> float:
    """Return N_cr = pi2 E I / L_cr2, N: the elastic critical force of flexural buckling.

    Args:
        modulus: E, Pa.
        inertia: I about the axis, of the gross section, m4.
        length: L_cr, buckling length, m.

    Raises:
        InputError: a value is not greater than zero.
    """
    _positive(modulus=modulus, inertia=inertia, length=length)
    return math.pi**2 * modulus * inertia / length**2


def torsional_critical_force(
    modulus: float, shear_modulus: float, area: float, polar_inertia: float, I_t: float, I_w: float, length: float
) -> float:
    """Return N_cr,T = A / (I_y + I_z) (G I_t + pi2 E I_w / L_T2), N, of a doubly symmetric section.

    Args:
        modulus: E, Pa.
        shear_modulus: G, Pa.
        area: A, m2.
        polar_inertia: I_y + I_z, m4.
        I_t: torsion constant, m4.
        I_w: warping constant, m6.
        length: L_T, between restraints of twisting, m.

    Raises:
        InputError: a value that must be greater than zero is not.

    Source: NCCI SN001; Timoshenko & Gere, Theory of elastic stability, 5.3. EN 1993-1-1, 6.3.1.4, asks for it.
    """
    _positive(modulus=modulus, shear_modulus=shear_modulus, area=area, polar_inertia=polar_inertia, length=length)
    return area / polar_inertia * (shear_modulus * I_t + math.pi**2 * modulus * I_w / length**2)


def slenderness(area: float, yield_stress: float, critical: float) -> float:
    """Return the non-dimensional slenderness sqrt(A f_y / N_cr).

    Args:
        area: A, m2.
        yield_stress: f_y, Pa.
        critical: N_cr, N.

    Raises:
        InputError: a value is not greater than zero.

    Source: EN 1993-1-1:2005, 6.3.1.2(1), Eq. 6.49.
    """
    _positive(area=area, yield_stress=yield_stress, critical=critical)
    return math.sqrt(area * yield_stress / critical)


def reduction_factor(slenderness: float, curve: str) -> float:
    """Return chi <= 1: Phi = 0.5 [1 + alpha (s - 0.2) + s2], chi = 1 / (Phi + sqrt(Phi2 - s2)).

    Args:
        slenderness: s, non-dimensional.
        curve: a0, a, b, c or d.

    Raises:
        InputError: there is no such curve, or the slenderness is negative.

    Source: EN 1993-1-1:2005, 6.3.1.2(1), Eq. 6.49, and (4).
    """
    if curve not in IMPERFECTION:
        raise unknown("buckling curve", curve, IMPERFECTION)
    if not slenderness >= 0.0:
        raise InputError(f"a slenderness of {slenderness:g} is negative [E-VALUE-02]")
    if slenderness <= NO_BUCKLING:
        return 1.0
    phi = 0.5 * (1.0 + IMPERFECTION[curve] * (slenderness - 0.2) + slenderness**2)
    return 1.0 / (phi + math.sqrt(phi**2 - slenderness**2))


def buckling_resistance(area: float, yield_stress: float, factor: float, gamma_M1: float = GAMMA_M1) -> float:
    """Return N_b,Rd = chi A f_y / gamma_M1, N.

    Args:
        area: A, m2.
        yield_stress: f_y, Pa.
        gamma_M1: partial factor.

    Source: EN 1993-1-1:2005, 6.3.1.1(3), Eq. 6.47.
    """
    return factor * area * yield_stress / gamma_M1


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not value > 0.0:
            raise InputError(f"{name.replace('_', ' ')}: {value:g} is not greater than zero [E-VALUE-02]")
