"""Coefficients of Rayleigh damping."""

from __future__ import annotations

import math

from edesign.errors import InputError


def rayleigh_coefficients(omega_i: float, omega_j: float, ratio: float) -> tuple[float, float]:
    """Return a0 (1/s) and a1 (s) of C = a0 M + a1 K that give two modes the same damping ratio.

    Args:
        omega_i, omega_j: circular frequencies of the two modes, rad/s.
        ratio: of critical damping, dimensionless.

    Raises:
        InputError: a frequency is not greater than zero, or both are the same.

    Source: a0 = 2 zeta w_i w_j / (w_i + w_j), a1 = 2 zeta / (w_i + w_j); Chopra, Dynamics of Structures, Eq. (11.4.10).
    """
    if not (0.0 < omega_i < math.inf and 0.0 < omega_j < math.inf):
        raise InputError(f"Rayleigh damping needs frequencies greater than zero, not {omega_i:g} and {omega_j:g} rad/s")
    if omega_i == omega_j:
        raise InputError(f"Rayleigh damping needs two different frequencies, not twice {omega_i:g} rad/s")
    a1 = 2.0 * ratio / (omega_i + omega_j)
    return a1 * omega_i * omega_j, a1
