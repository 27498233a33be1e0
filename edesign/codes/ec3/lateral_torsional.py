"""Lateral torsional buckling of members in bending, EN 1993-1-1:2005, 6.3.2, and its elastic critical moment.

The critical moment is not in EN 1993-1-1; it is that of NCCI SN003 (Access Steel), for doubly symmetric sections.
"""

from __future__ import annotations

import math
from typing import Any, TypeVar

import numpy as np

from edesign.codes.ec3.buckling import GAMMA_M1, IMPERFECTION, Curve
from edesign.codes.names import unknown
from edesign.errors import InputError

Values = TypeVar("Values", float, np.ndarray)
"""Numbers, or arrays of one shape."""

LAMBDA_LT_0 = 0.4
"""Length of the plateau. Source: EN 1993-1-1:2005, 6.3.2.3(1), recommended."""
BETA = 0.75
"""Source: EN 1993-1-1:2005, 6.3.2.3(1), recommended."""

_RATIO = (-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0)
_C1 = (2.55, 2.57, 2.33, 2.05, 1.77, 1.52, 1.31, 1.14, 1.00)

TRANSVERSE_LOADS: dict[str, tuple[float, float, float]] = {  # C1, C2, k_c
    "uniform_pinned": (1.127, 0.454, 0.94),
    "uniform_fixed": (2.578, 1.554, 0.90),
    "point_pinned": (1.348, 0.630, 0.86),
    "point_fixed": (1.683, 1.645, 0.77),
}
"""C1, C2 and k_c of members under a transverse load, by their ends in bending about the strong axis (k = k_w = 1).

Source: NCCI SN003, Table 3.2; Eurocodes: Design of steel buildings with worked examples (JRC 2014). k_c: EN 1993-1-1,
Table 6.6.
"""


def end_moment_factor(psi: float) -> float:
    """Return C1 of a member under end moments M and psi M; between the rows of the table it is interpolated.

    Args:
        psi: ratio of the end moments, -1 (double curvature) to 1.

    Raises:
        InputError: psi is not in that range.

    Source: NCCI SN003, Table 3.1, k = 1.
    """
    return float(np.interp(_ratio(psi), _RATIO, _C1))


def diagram_factor(M_max: Values, M_quarter: Values, M_middle: Values, M_three_quarters: Values) -> Values:
    """Return C1 of any moment diagram, from its largest moment and those at the quarter points.

    Args:
        M_max: largest moment, N m; all of any sign.
        M_quarter: at a quarter of the length, N m.
        M_middle: at mid-length, N m.
        M_three_quarters: at three quarters of the length, N m.

    Source: Serna, Lopez, Puente & Yong, Equivalent uniform moment factors for lateral-torsional buckling of steel
        members, J. Constr. Steel Res. 62 (2006), for ends free to warp; 1 without any moment.
    """
    squared = np.square(M_max)
    weighted = squared + 9.0 * np.square(M_quarter) + 16.0 * np.square(M_middle) + 9.0 * np.square(M_three_quarters)
    share = np.divide(squared, weighted, out=np.full_like(weighted, 1.0 / 35.0), where=squared > 0.0)
    return np.sqrt(35.0 * share)


def quarter_moments(steady: np.ndarray, alternating: np.ndarray) -> np.ndarray:
    """Return the magnitudes at the quarter points, (3, ...), from those at sixths, (..., 7).

    Those at a quarter come by a parabola through the next three sixths, and of responses by a line.

    Args:
        steady: static moments with sign.
    """
    middle = np.abs(steady[..., 3]) + alternating[..., 3]
    return np.stack([_quarter(steady, alternating), middle, _quarter(steady[..., ::-1], alternating[..., ::-1])])


def _quarter(steady: np.ndarray, alternating: np.ndarray) -> np.ndarray:
    return np.asarray(
        np.abs(3.0 * steady[..., 1] + 6.0 * steady[..., 2] - steady[..., 3]) / 8.0
        + 0.5 * (alternating[..., 1] + alternating[..., 2])
    )


def correction_of_factor(C1: Values) -> Values:
    """Return k_c = 1 / sqrt(C1) <= 1, for diagrams that Table 6.6 does not have.

    Args:
        C1: of the moment diagram.

    Source: EN 1993-1-1:2022, 8.3.2.3; SCI P362.
    """
    return np.minimum(1.0 / np.sqrt(C1), 1.0)


def critical_moment(
    modulus: float,
    shear_modulus: float,
    I_z: float,
    I_t: float,
    I_w: float,
    length: float,
    C1: float = 1.0,
    C2: float = 0.0,
    z_g: float = 0.0,
    k: float = 1.0,
    k_w: float = 1.0,
) -> float:
    """Return M_cr, N m, of a doubly symmetric section.

    Args:
        modulus: E, Pa.
        shear_modulus: G, Pa.
        I_z: second moment of area about the weak axis, m4.
        I_t: torsion constant, m4.
        I_w: warping constant, m6.
        length: L, between lateral restraints, m.
        C1: factor of the moment diagram.
        C2: factor of the height of the load.
        z_g: height of the load above the shear centre; positive where it makes the section tip over, m.
        k: effective length in lateral bending, by L.
        k_w: effective length in warping, by L.

    Raises:
        InputError: a value that must be greater than zero is not.

    Source: NCCI SN003, Eq. 1; EN 1999-1-1, Annex I.1.2.
    """
    for name, value in dict(E=modulus, G=shear_modulus, I_z=I_z, I_t=I_t, L=length, C1=C1, k=k, k_w=k_w).items():
        if not value > 0.0:
            raise InputError(f"{name}: {value:g} is not greater than zero [E-VALUE-02]")
    euler = math.pi**2 * modulus * I_z / (k * length) ** 2
    tipping = C2 * z_g
    inner = (k / k_w) ** 2 * I_w / I_z + shear_modulus * I_t / euler + tipping**2
    return C1 * euler * (math.sqrt(inner) - tipping)


def buckling_moments(
    M_Rk: np.ndarray,
    M_max: np.ndarray,
    M_quarters: np.ndarray,
    tipping: np.ndarray,
    euler: np.ndarray,
    squared: np.ndarray,
    imperfection: np.ndarray,
    plateau: float = LAMBDA_LT_0,
    beta: float = BETA,
) -> np.ndarray:
    """Return chi_LT,mod M_y,Rk of rolled sections under their moment diagrams, N m; all arguments of one shape.

    C1 is that of `diagram_factor`. Loads above the shear centre make M_cr less: of a member that buckles in a sine,
    C2 z_g = C1 L / (pi2 M_max) times the sum of z_g P sin2(pi x / L), 0.46 z_g for a uniform load on hinges.

    Args:
        M_Rk: W_y f_y.
        M_max: the largest moment along the member; magnitude.
        M_quarters: (3, ...) at the quarter points; magnitudes.
        tipping: L / pi2 times the sum of z_g P sin2(pi x / L), N m2; not negative.
        euler: pi2 E I_z / L2, N.
        squared: I_w / I_z + G I_t L2 / (pi2 E I_z), m2.
        imperfection: alpha_LT.
        plateau: lambda_LT,0, see `reduction_factor`.
        beta: see `reduction_factor`.

    Returns:
        chi_LT,mod M_y,Rk, N m, in the shape of the arguments.

    Source: EN 1993-1-1:2005 + AC:2009, 6.3.2.3, Eqs. 6.57 and 6.58; k_c as `correction_of_factor`. M_cr: NCCI SN003,
        Eq. 1; C2 by the energy of one half-wave (Timoshenko & Gere, Theory of Elastic Stability, 6.3).
    """
    C1 = diagram_factor(M_max, *M_quarters)
    C2_z_g = C1 * np.divide(tipping, M_max, out=np.zeros_like(M_max), where=M_max > 0.0)
    M_cr = C1 * euler * squared / (np.sqrt(squared + C2_z_g**2) + C2_z_g)  # sqrt(s + t2) - t without cancelling
    slender = np.sqrt(M_Rk / M_cr)
    chi = _reduction(slender, imperfection, plateau, beta)
    return modified_reduction_factor(chi, slender, correction_of_factor(C1)) * M_Rk


def slenderness(modulus: float, yield_stress: float, critical: float) -> float:
    """Return lambda_LT = sqrt(W_y f_y / M_cr).

    Args:
        modulus: W_pl,y of class 1 and 2, W_el,y of class 3, m3.
        yield_stress: f_y, Pa.
        critical: M_cr, N m.

    Raises:
        InputError: M_cr is not greater than zero.

    Source: EN 1993-1-1:2005, 6.3.2.2(1).
    """
    if not critical > 0.0:
        raise InputError(f"M_cr: {critical:g} is not greater than zero [E-VALUE-02]")
    return math.sqrt(modulus * yield_stress / critical)


def general_curve(height: float, width: float, rolled: bool = True) -> Curve:
    """Return the curve of an I section for the general case: rolled a or b, welded c or d, by h/b = 2.

    Args:
        height: h, m.
        width: b, m.
        rolled: rolled, not welded.

    Source: EN 1993-1-1:2005, 6.3.2.2(2), Table 6.4.
    """
    slender = height / width > 2.0
    return ("b" if slender else "a") if rolled else ("d" if slender else "c")


def rolled_curve(height: float, width: float, rolled: bool = True) -> Curve:
    """Return the curve of an I section for 6.3.2.3: rolled b or c, equivalent welded c or d, by h/b = 2.

    Args:
        height: h, m.
        width: b, m.
        rolled: rolled, not welded.

    Source: EN 1993-1-1:2005, 6.3.2.3(1), Table 6.5.
    """
    slender = height / width > 2.0
    return ("c" if slender else "b") if rolled else ("d" if slender else "c")


def reduction_factor_general(slenderness: float, curve: str) -> float:
    """Return chi_LT <= 1 of the general case; 1 up to a slenderness of 0.2.

    Args:
        slenderness: lambda_LT.
        curve: a, b, c or d.

    Raises:
        InputError: there is no such curve, or the slenderness is negative.

    Source: EN 1993-1-1:2005, 6.3.2.2(1), Eq. 6.56. Under (4) lateral torsional buckling may be ignored up to
        lambda_LT,0, a jump that is not made use of.
    """
    return float(_reduction(*_checked(slenderness, curve), plateau=0.2, beta=1.0))


def reduction_factor(slenderness: float, curve: str, lambda_LT_0: float = LAMBDA_LT_0, beta: float = BETA) -> float:
    """Return chi_LT <= 1 and <= 1 / lambda_LT2 of rolled and equivalent welded sections.

    Args:
        slenderness: lambda_LT.
        curve: b, c or d, by `rolled_curve`.
        lambda_LT_0: largest slenderness without reduction, as the National Annex has it.
        beta: correction factor for rolled sections, as the National Annex has it.

    Returns:
        chi_LT, dimensionless.

    Raises:
        InputError: there is no such curve, or the slenderness is negative.

    Source: EN 1993-1-1:2005, 6.3.2.3(1), Eq. 6.57.
    """
    return float(_reduction(*_checked(slenderness, curve), plateau=lambda_LT_0, beta=beta))


def moment_distribution_factor(slenderness: Values, k_c: Values) -> Values:
    """Return f = 1 - 0.5 (1 - k_c) [1 - 2 (lambda_LT - 0.8)2] <= 1.

    Args:
        slenderness: lambda_LT.
        k_c: correction factor of the moment diagram.

    Source: EN 1993-1-1:2005, 6.3.2.3(2).
    """
    return np.minimum(1.0 - 0.5 * (1.0 - k_c) * (1.0 - 2.0 * (slenderness - 0.8) ** 2), 1.0)


def modified_reduction_factor(chi_LT: Values, slenderness: Values, k_c: Values) -> Values:
    """Return chi_LT,mod = chi_LT / f <= 1 and <= 1 / lambda_LT2, f by `moment_distribution_factor`.

    Args:
        chi_LT: by `reduction_factor`.
        slenderness: lambda_LT.
        k_c: correction factor of the moment diagram.

    Source: EN 1993-1-1:2005 + AC:2009, 6.3.2.3(2), Eq. 6.58.
    """
    f = moment_distribution_factor(slenderness, k_c)
    return np.minimum(np.minimum(chi_LT / f, 1.0), _euler(slenderness))


def buckling_moment(chi_LT: float, modulus: float, yield_stress: float, gamma_M1: float = GAMMA_M1) -> float:
    """Return M_b,Rd = chi_LT W_y f_y / gamma_M1, N m.

    Args:
        chi_LT: reduction factor.
        modulus: W_y of the class of the section, m3.
        yield_stress: f_y, Pa.
        gamma_M1: partial factor.

    Source: EN 1993-1-1:2005, 6.3.2.1(3), Eq. 6.55.
    """
    return chi_LT * modulus * yield_stress / gamma_M1


def _checked(slenderness: float, curve: str) -> tuple[float, float]:
    """Return the slenderness and the imperfection factor of the curve."""
    if curve not in IMPERFECTION:
        raise unknown("buckling curve", curve, IMPERFECTION)
    if not slenderness >= 0.0:
        raise InputError(f"a slenderness of {slenderness:g} is negative [E-VALUE-02]")
    return slenderness, IMPERFECTION[curve]


def _reduction(slenderness: Values, imperfection: Values, plateau: float, beta: float) -> Values:
    over = np.maximum(slenderness - plateau, 0.0)
    phi = 0.5 * (1.0 + imperfection * over + beta * slenderness**2)
    chi = 1.0 / (phi + np.sqrt(np.maximum(phi**2 - beta * slenderness**2, 0.0)))
    found: Any = np.where(over > 0.0, np.minimum(np.minimum(chi, 1.0), _euler(slenderness)), 1.0)
    return found[()]  # a number of numbers


def _euler(slenderness: Values) -> Values:
    """1 / lambda2, beyond any reduction at lambda = 0."""
    return 1.0 / np.maximum(slenderness**2, np.finfo(float).tiny)


def _ratio(psi: float) -> float:
    if not -1.0 <= psi <= 1.0:
        raise InputError(
            f"psi: {psi:g} is not between -1 and 1; it is the smaller end moment by the larger [E-VALUE-02]"
        )
    return psi
