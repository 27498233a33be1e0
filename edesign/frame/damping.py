"""Inherent damping: coefficients of Rayleigh damping, ratios of modes."""

from __future__ import annotations

import math

import numpy as np

from edesign.errors import InputError
from edesign.project.analysis.damping import (
    CaugheyDamping,
    Damping,
    MassDamping,
    ModalDamping,
    ProportionalDamping,
    RayleighDamping,
    StiffnessDamping,
)


def modes_needed(damping: Damping | None, most: int) -> int:
    """Return how many of the `most` modes of a structure must be known to damp it.

    Args:
        damping: of the project.
    """
    match damping:
        case RayleighDamping(periods=None):
            return max(damping.modes)
        case MassDamping(period=None) | StiffnessDamping(period=None):
            return damping.mode
        case ModalDamping():
            return damping.count
        case CaugheyDamping():
            return max(most, *(damping.modes or ()), 1)
    return 0


def proportional_factors(damping: ProportionalDamping, omega: np.ndarray) -> tuple[float, float]:
    """Return a0 (1/s) and a1 (s) of C = a0 M + a1 K.

    Args:
        damping: as the project gives it.
        omega: circular frequencies of the lowest modes, as many as `modes_needed` says, rad/s.

    Returns:
        a0, 1/s, and a1, s.

    Raises:
        InputError: a frequency is not greater than zero, or both are the same.

    Source: zeta = a0 / (2 omega) + a1 omega / 2; Chopra, Dynamics of Structures, Eqs. (11.4.8) and (11.4.10).
    """
    if isinstance(damping, RayleighDamping):
        if damping.periods is not None:
            first, second = (2.0 * math.pi / period for period in damping.periods)
        else:
            first, second = (float(omega[number - 1]) for number in damping.modes)
        return rayleigh_coefficients(first, second, damping.ratio)
    at = float(omega[damping.mode - 1]) if damping.period is None else 2.0 * math.pi / damping.period
    return (2.0 * damping.ratio * at, 0.0) if isinstance(damping, MassDamping) else (0.0, 2.0 * damping.ratio / at)


def modal_ratios(damping: ModalDamping | CaugheyDamping, omega: np.ndarray) -> np.ndarray:
    """Return the ratio of critical (n,) in each of the lowest modes.

    Args:
        damping: as the project gives it.
        omega: (n,) circular frequencies of these modes, as many as `modes_needed` says, rad/s.

    Raises:
        InputError: Caughey's series would give a mode a negative ratio.

    Source: modal damping of Wilson and Penzien (1972), Chopra, Dynamics of Structures, Eq. (11.4.5). Caughey's series,
        zeta = sum a_b omega^(2b - 1) / 2 with as many terms as ratios, from b = 0, Eq. (11.4.15).
    """
    if isinstance(damping, ModalDamping):
        return np.broadcast_to(np.asarray(damping.ratio, dtype=float), omega.shape)
    if damping.periods is not None:
        anchors = 2.0 * np.pi / np.array(damping.periods)
    else:
        anchors = omega[np.array(damping.modes) - 1]
    # of frequencies over the first, so that high powers keep their digits
    powers = 2.0 * np.arange(anchors.size) - 1.0
    terms = (anchors[:, None] / anchors[0]) ** powers
    coefficients = np.linalg.solve(terms, np.broadcast_to(damping.ratio, anchors.shape))
    ratios: np.ndarray = (omega[:, None] / anchors[0]) ** powers @ coefficients
    lowest = int(np.argmin(ratios))
    if ratios[lowest] < 0.0:
        way = "an even number of terms leaves the highest modes positive" if anchors.size % 2 else "take other anchors"
        raise InputError(
            f"Caughey damping through {anchors.size} modes would give mode {lowest + 1} "
            f"(T = {2.0 * math.pi / omega[lowest]:.3g} s) a ratio of {100.0 * ratios[lowest]:.3g} %, which feeds in "
            f"energy; {way}, or give `modal` ratios mode by mode [E-DAMPING-01]"
        )
    return ratios


def rayleigh_coefficients(omega_i: float, omega_j: float, ratio: float) -> tuple[float, float]:
    """Return a0 (1/s) and a1 (s) of C = a0 M + a1 K that give two modes the same damping ratio.

    Args:
        omega_i: circular frequency of the first of the two modes, rad/s.
        omega_j: circular frequency of the other mode, rad/s.
        ratio: of critical damping, dimensionless.

    Returns:
        a0, 1/s, and a1, s.

    Raises:
        InputError: a frequency is not greater than zero, or both are the same.

    Source: a0 = 2 zeta w_i w_j / (w_i + w_j), a1 = 2 zeta / (w_i + w_j); Chopra, Dynamics of Structures, Eq. (11.4.10).
    """
    if not (0.0 < omega_i < math.inf and 0.0 < omega_j < math.inf):
        raise InputError(
            f"Rayleigh damping needs frequencies greater than zero, not {omega_i:g} and {omega_j:g} rad/s [E-VALUE-02]"
        )
    if omega_i == omega_j:
        raise InputError(f"Rayleigh damping needs two different frequencies, not twice {omega_i:g} rad/s [E-VALUE-04]")
    a1 = 2.0 * ratio / (omega_i + omega_j)
    return a1 * omega_i * omega_j, a1
