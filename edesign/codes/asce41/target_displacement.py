"""Target displacement by the coefficient method, ASCE/SEI 41-17, 7.4.3.3.2, and its limit of strength, 7.3.2."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from edesign.codes.capacity_curve import DESCENT, CapacityCurve, fitting
from edesign.codes.fema356.idealisation import Bilinear
from edesign.codes.fema356.target_displacement import CoefficientTarget, demand
from edesign.codes.quantities import STANDARD_GRAVITY
from edesign.codes.spectrum import Spectrum

SITE_FACTORS = {"A": 130.0, "B": 130.0, "C": 90.0, "D": 60.0, "E": 60.0, "F": 60.0}
"""a by site class. Source: ASCE/SEI 41-17, Eq. 7-29."""

SITE_CLASSES = {"A": "B", "B": "C", "C": "D", "D": "E", "E": "D"}
"""Site class by ground type of EN 1998-1, Table 3.1: the class of ASCE/SEI 7 with most of its shear wave velocities.

Ground A, above 800 m/s, is B (760 to 1500 m/s); B, 360 to 800 m/s, is C; C, 180 to 360 m/s, is D; D, below 180 m/s, is
E. Ground E, a soft layer on rock, has no counterpart and takes D: from there on the factor is the same.
"""

SHORT_PERIOD, NO_C_1, NO_C_2 = 0.2, 1.0, 0.7  # s
DEGRADED = 0.6  # of the yield strength, where the third line ends

NEAR_FAULT = 0.6
"""S_X1 of the BSE-2N, g, from which on a site counts as near a fault. Source: ASCE/SEI 41-17, Eq. 7-33."""


@dataclass(frozen=True)
class StrengthLimit:
    """Check that a negative slope after yielding leaves the frame stable.

    Attributes:
        alpha_2: slope from the largest base shear down to 60 % of V_y over K_e; None without a descent.
        alpha_PDelta: what vertical loads have of it; None without a descent, or where it is not known.
        alpha_e: effective negative slope over K_e; None without a descent.
        mu_max: largest ratio of demand to strength for which the procedure is permitted; infinite without a descent.
    """

    alpha_2: float | None
    alpha_PDelta: float | None
    alpha_e: float | None
    mu_max: float


def inelastic_factor(mu_strength: float, T_e: float, a: float) -> float:
    """Return C_1 = 1 + (mu_strength - 1) / (a T_e^2); 1 above 1 s, below 0.2 s that at 0.2 s.

    Args:
        mu_strength: ratio of elastic demand to yield strength.
        T_e: effective period, s.
        a: factor of the site class.

    Source: ASCE/SEI 41-17, Eq. 7-29.
    """
    if T_e > NO_C_1:
        return 1.0
    return 1.0 + max(mu_strength - 1.0, 0.0) / (a * max(T_e, SHORT_PERIOD) ** 2)


def degradation_factor(mu_strength: float, T_e: float) -> float:
    """Return C_2 = 1 + ((mu_strength - 1) / T_e)^2 / 800; 1 above 0.7 s.

    Args:
        mu_strength: ratio of elastic demand to yield strength.
        T_e: effective period, s.

    Source: ASCE/SEI 41-17, Eq. 7-30.
    """
    return 1.0 if T_e > NO_C_2 else 1.0 + (max(mu_strength - 1.0, 0.0) / T_e) ** 2 / 800.0


def near_fault_factor(S_X1: float) -> float:
    """Return lambda: 0.8 near a fault, where S_X1 of the BSE-2N is at least 0.6 g, else 0.2.

    Args:
        S_X1: m/s2.

    Source: ASCE/SEI 41-17, Eq. 7-33.
    """
    return 0.8 if S_X1 >= NEAR_FAULT * STANDARD_GRAVITY else 0.2


def strength_limit(
    curve: CapacityCurve,
    lines: Bilinear,
    T_e: float,
    factor: float,
    second_order: Callable[[float, float], float | None],
) -> StrengthLimit:
    """Return mu_max = D_d / D_y + |alpha_e|^-h / 4 with h = 1 + 0.15 ln T_e.

    alpha_e is alpha_PDelta + lambda (alpha_2 - alpha_PDelta). Where alpha_PDelta is not known, it is alpha_2.

    Args:
        curve: base shear against displacement of the control node.
        lines: its first two lines, up to the largest base shear or the target.
        T_e: effective fundamental period, s.
        second_order: of two displacements (m), the slope between them that is due to vertical loads, N/m, not positive;
            None if that is not known.

    Source: ASCE/SEI 41-17, 7.4.3.2.4 and Eqs. 7-32 to 7-34.
    """
    level = DEGRADED * lines.V_y
    beyond = curve.displacement > curve.peak
    d, f = curve.displacement[beyond], curve.force[beyond]
    V_top = curve.force_at(curve.peak)
    if not d.size or not f[-1] < V_top * (1.0 - DESCENT):
        return StrengthLimit(None, None, None, math.inf)
    D_3, V_3 = float(d[-1]), float(f[-1])
    if V_3 < level:
        at = int((f <= level).argmax())
        before = (curve.peak, V_top) if at == 0 else (float(d[at - 1]), float(f[at - 1]))
        D_3, V_3 = before[0] + (level - before[1]) * (d[at] - before[0]) / (f[at] - before[1]), level
    alpha_2 = alpha_e = float((V_3 - V_top) / (D_3 - curve.peak) / lines.K_e)
    slope = second_order(curve.peak, float(D_3))
    alpha_PDelta = None if slope is None else slope / lines.K_e
    if alpha_PDelta is not None:
        alpha_e = alpha_PDelta + factor * (alpha_2 - alpha_PDelta)
    h = 1.0 + 0.15 * math.log(T_e)
    D_d = min(lines.D_d, curve.peak)
    return StrengthLimit(alpha_2, alpha_PDelta, alpha_e, D_d / lines.D_y + abs(alpha_e) ** -h / 4.0)


def target_displacement(
    curve: CapacityCurve,
    period: float,
    C_0: float,
    mass: float,
    storeys: int,
    spectrum: Spectrum,
    site_class: str,
    factor: float,
    second_order: Callable[[float, float], float | None],
) -> tuple[CoefficientTarget, StrengthLimit]:
    """Return the target displacement, and the limit of strength of a frame with a descent.

    The curve is idealised up to the target itself, or to the largest base shear if that comes earlier.

    Args:
        curve: base shear against displacement of the control node.
        period: elastic fundamental period T_i, s.
        C_0: first participation factor, with the shape 1 at the control node; 7.4.3.3.2 permits it.
        mass: of the frame, kg.
        spectrum: of the hazard level.
        site_class: a key of `SITE_FACTORS`.
        factor: see `strength_limit`.
        second_order: see `strength_limit`.

    Returns:
        The target displacement with its coefficients; the limit of strength.

    Source: ASCE/SEI 41-17, 7.4.3.3.2, Eqs. 7-27 to 7-34.
    """

    def found(D_d: float) -> CoefficientTarget:
        at = demand(curve, D_d, period, mass, storeys, spectrum)
        C_1 = inelastic_factor(at.ratio, at.T_e, SITE_FACTORS[site_class])
        return at.target(C_0, C_1, degradation_factor(at.ratio, at.T_e))

    target = found(fitting(lambda D_d: found(D_d).d_t, curve.peak))
    return target, strength_limit(curve, target.idealisation, target.T_e, factor, second_order)
