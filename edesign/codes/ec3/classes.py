"""Classes of cross-sections, EN 1993-1-1:2005, 5.5 and Table 5.2.

A part is internal (a web, a wall of a hollow section) or an outstand (half a flange). Stresses are positive in
compression here, as in Table 5.2. Class 4 is the answer for a part beyond the limits of class 3.
"""

from __future__ import annotations

import math

from edesign.errors import InputError


def epsilon(yield_stress: float) -> float:
    """Return sqrt(235 MPa / f_y).

    Args:
        yield_stress: f_y, Pa.

    Raises:
        InputError: the yield stress (Pa) is not greater than zero.

    Source: EN 1993-1-1:2005, Table 5.2.
    """
    if not yield_stress > 0.0:
        raise InputError(f"f_y: {yield_stress:g} Pa is not greater than zero [E-VALUE-02]")
    return math.sqrt(235e6 / yield_stress)


def plastic_part_in_compression(N_Ed: float, depth: float, thickness: float, yield_stress: float) -> float:
    """Return alpha: the part of webs in compression when the section is fully plastic under N and bending.

    Args:
        N_Ed: axial force, positive in compression, N.
        depth: c of a web, m.
        thickness: of all webs together, m.
        yield_stress: f_y, Pa.

    Returns:
        0 to 1: 0.5 without axial force.

    Source: equilibrium of a web of which alpha c carries f_y in compression and the rest f_y in tension; SCI P362;
        Steel Buildings in Europe, MSB08, worked example 2.
    """
    alpha = 0.5 * (1.0 + N_Ed / (depth * thickness * yield_stress))
    return min(max(alpha, 0.0), 1.0)


def elastic_stress_ratio(N_Ed: float, area: float, yield_stress: float) -> float:
    """Return psi: stress at one end of a web by that at the other, where it is f_y in compression.

    Args:
        N_Ed: axial force, positive in compression, N.
        area: A, m2.
        yield_stress: f_y, Pa.

    Returns:
        -1 without axial force, 1 in pure compression; below -1 with tension.

    Source: sigma = N / A +- sigma_b of a doubly symmetric section; SCI P362.
    """
    return min(2.0 * N_Ed / (area * yield_stress) - 1.0, 1.0)


def internal_part_limits(epsilon: float, alpha: float = 1.0, psi: float = 1.0) -> tuple[float, float, float]:
    """Return the largest c/t of classes 1, 2 and 3 of an internal part.

    Args:
        epsilon: sqrt(235 MPa / f_y).
        alpha: part of c that is in compression when plastic: 1 in pure compression, 0.5 in pure bending.
        psi: stress ratio when elastic: 1 in pure compression, -1 in pure bending.

    Source: EN 1993-1-1:2005, Table 5.2, sheet 1. Without compression (alpha 0) there is no limit.
    """
    if alpha <= 0.0:
        first = second = math.inf
    elif alpha > 0.5:
        first, second = 396.0 / (13.0 * alpha - 1.0), 456.0 / (13.0 * alpha - 1.0)
    else:
        first, second = 36.0 / alpha, 41.5 / alpha
    third = 42.0 / (0.67 + 0.33 * psi) if psi > -1.0 else 62.0 * (1.0 - psi) * math.sqrt(-psi)
    return first * epsilon, second * epsilon, max(third, second) * epsilon  # a part of class 2 is not of class 4


def outstand_limits(epsilon: float) -> tuple[float, float, float]:
    """Return the largest c/t of classes 1, 2 and 3 of an outstand flange in uniform compression.

    Bending about the weak axis, with the tip in compression, allows more; these limits are safe for it.

    Args:
        epsilon: by `epsilon`.

    Source: EN 1993-1-1:2005, Table 5.2, sheet 2.
    """
    return 9.0 * epsilon, 10.0 * epsilon, 14.0 * epsilon


def tubular_limits(epsilon: float) -> tuple[float, float, float]:
    """Return the largest d/t of classes 1, 2 and 3 of a circular hollow section.

    Args:
        epsilon: by `epsilon`.

    Source: EN 1993-1-1:2005, Table 5.2, sheet 3.
    """
    return 50.0 * epsilon**2, 70.0 * epsilon**2, 90.0 * epsilon**2


def angle_limits(epsilon: float) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return the largest h/t and the largest (b + h) / 2t of classes 1, 2 and 3 of an angle in compression.

    Sheet 3 has class 3 alone; classes 1 and 2 are those of outstand flanges, to which it refers, of the whole leg.

    Args:
        epsilon: by `epsilon`.

    Source: EN 1993-1-1:2005, Table 5.2, sheets 2 and 3.
    """
    first, second, _ = outstand_limits(epsilon)
    return (first, second, 15.0 * epsilon), (first, second, 11.5 * epsilon)


def class_of_part(slenderness: float, limits: tuple[float, float, float]) -> int:
    """Return the class 1 to 4 of a part by its c/t and the limits of classes 1, 2 and 3.

    Args:
        slenderness: c/t.
        limits: largest c/t of classes 1, 2 and 3.
    """
    return 1 + sum(slenderness > limit for limit in limits)
