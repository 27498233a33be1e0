"""Equivalent uniform moment factors C_m of members in bending and compression, EN 1993-1-1:2005, Tables A.2 and B.3."""

from __future__ import annotations

import math
from typing import Literal

from edesign.errors import InputError

SWAY = 0.9
"""C_m of a member that buckles in a sway mode. Source: EN 1993-1-1:2005, Table B.3."""
LEAST = 0.4
"""Least C_m of Table B.3 where it is bounded."""

Load = Literal["uniform", "point"]


def linear_moment_factor(psi: float) -> float:
    """Return C_m = 0.6 + 0.4 psi >= 0.4 of end moments M and psi M.

    Args:
        psi: -1 (double curvature) to 1.

    Raises:
        InputError: psi is not in that range.

    Source: EN 1993-1-1:2005, Table B.3.
    """
    return max(0.6 + 0.4 * _within("psi", psi), LEAST)


def moment_factor(M_start: float, M_middle: float, M_end: float, load: Load = "uniform") -> float:
    """Return C_m by Table B.3 of a member with a load between its ends; 1 without any moment.

    Args:
        M_start, M_middle, M_end: moments with one sign convention along the member, N m.
        load: uniform, or concentrated at the middle.

    Source: EN 1993-1-1:2005 + AC:2009, Table B.3. M_h is the larger end moment, M_s that at the middle.
    """
    M_h, smaller = (M_start, M_end) if abs(M_start) >= abs(M_end) else (M_end, M_start)
    if M_h == 0.0 and M_middle == 0.0:
        return 1.0
    psi = smaller / M_h if M_h != 0.0 else 1.0
    point = load == "point"
    if abs(M_middle) <= abs(M_h):
        alpha_s = M_middle / M_h
        if alpha_s >= 0.0:
            return max(0.2 + 0.8 * alpha_s, LEAST)
        if psi >= 0.0:
            return max((0.0 if point else 0.1) - 0.8 * alpha_s, LEAST)
        return max((-0.2 * psi if point else 0.1 * (1.0 - psi)) - 0.8 * alpha_s, LEAST)
    alpha_h = M_h / M_middle
    slope = 1.0 + 2.0 * psi if alpha_h < 0.0 and psi < 0.0 else 1.0
    return 0.90 + 0.10 * alpha_h * slope if point else 0.95 + 0.05 * alpha_h * slope


def linear_moment_factor_a(psi: float, N_Ed: float, N_cr: float) -> float:
    """Return C_m,0 = 0.79 + 0.21 psi + 0.36 (psi - 0.33) N_Ed / N_cr of end moments M and psi M.

    Args:
        psi: -1 to 1.
        N_Ed: compression, magnitude, N.
        N_cr: elastic critical force about the axis of the moments, N.

    Raises:
        InputError: psi is not in that range.

    Source: EN 1993-1-1:2005, Table A.2.
    """
    return 0.79 + 0.21 * _within("psi", psi) + 0.36 * (psi - 0.33) * N_Ed / N_cr


def loaded_moment_factor_a(load: Load, N_Ed: float, N_cr: float) -> float:
    """Return C_m,0 = 1 + 0.03 N_Ed / N_cr (uniform load) or 1 - 0.18 N_Ed / N_cr (load at the middle), pinned ends.

    Source: EN 1993-1-1:2005, Table A.2.
    """
    return 1.0 + (0.03 if load == "uniform" else -0.18) * N_Ed / N_cr


def deflection_moment_factor_a(
    modulus: float, inertia: float, length: float, deflection: float, M_Ed: float, N_Ed: float, N_cr: float
) -> float:
    """Return C_m,0 = 1 + (pi2 E I |delta| / (L2 |M_Ed|) - 1) N_Ed / N_cr of any moment diagram.

    Args:
        modulus, inertia: E (Pa), I (m4) about the axis of the moments.
        length: L, m.
        deflection: delta, the largest of the member between its ends, m.
        M_Ed: the largest moment, N m.
        N_Ed, N_cr: as for `linear_moment_factor_a`.

    Source: EN 1993-1-1:2005, Table A.2.
    """
    shape = math.pi**2 * modulus * inertia * abs(deflection) / (length**2 * abs(M_Ed))
    return 1.0 + (shape - 1.0) * N_Ed / N_cr


def _within(name: str, value: float) -> float:
    if not -1.0 <= value <= 1.0:
        raise InputError(f"{name}: {value:g} is not between -1 and 1; it is the smaller end moment by the larger")
    return value
