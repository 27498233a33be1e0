"""Equivalent uniform moment factors C_m of members in bending and compression, EN 1993-1-1:2005, Tables A.2 and B.3."""

from __future__ import annotations

from edesign.errors import InputError

SWAY = 0.9
"""C_m of a member that buckles in a sway mode. Source: EN 1993-1-1:2005, Table B.3."""


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


def _within(name: str, value: float) -> float:
    if not -1.0 <= value <= 1.0:
        raise InputError(
            f"{name}: {value:g} is not between -1 and 1; it is the smaller end moment by the larger [E-VALUE-02]"
        )
    return value
