"""The four branches that all acceleration spectra of EN 1998-1:2004 share."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError


def four_branches(period: ArrayLike, corners: tuple[float, float, float], start: float, plateau: float) -> np.ndarray:
    """Return the ordinates: straight line, plateau, falling as 1/T, falling as 1/T2.

    Args:
        period: s, at least 0, any shape.
        corners: T_B, T_C, T_D, s.
        start: ordinate at period zero.
        plateau: ordinate between T_B and T_C.

    Returns:
        The ordinates in the shape of `period`. The last branch has no end: what holds beyond 4 s is for the caller.

    Raises:
        InputError: a period is negative or not finite.

    Source: EN 1998-1:2004, Eqs. 3.2-3.5 (start 1, plateau 2.5 eta), 3.8-3.11 (1, 3.0 eta), 3.13-3.16 (2/3, 2.5/q).
    """
    T = checked_periods(period)
    T_B, T_C, T_D = corners
    rising = start + T / T_B * (plateau - start)
    longer = np.maximum(T, T_C)  # the falling branches without a division by zero where they do not apply
    falling = plateau * np.where(T <= T_D, T_C / longer, T_C * T_D / longer**2)
    return np.where(T < T_B, rising, np.where(T <= T_C, plateau, falling))


def checked_periods(period: ArrayLike) -> np.ndarray:
    """Return the periods as an array of floats.

    Args:
        period: s, of any shape; not negative.

    Returns:
        s, in the shape of `period`.

    Raises:
        InputError: a period is negative or not finite.
    """
    T = np.asarray(period, dtype=float)
    wrong = T[~(np.isfinite(T) & (T >= 0.0))]
    if wrong.size:
        raise InputError(f"a period must be finite and at least zero, not {wrong.flat[0]:g} s [E-VALUE-02]")
    return T


def displacement_of(acceleration: np.ndarray, period: ArrayLike) -> np.ndarray:
    """Return S_De = S_e (T / 2 pi)2, m.

    Args:
        acceleration: S_e, m/s2.
        period: s, of any shape; not negative.

    Returns:
        m, in the shape of `acceleration`.

    Source: EN 1998-1:2004, Eq. 3.7.
    """
    return acceleration * (np.asarray(period, dtype=float) / (2.0 * math.pi)) ** 2


def checked_action(a_gR: float, gamma_I: float) -> None:
    """Check reference ground acceleration and importance factor.

    Args:
        a_gR: m/s2.
        gamma_I: dimensionless.

    Raises:
        InputError: one of them is not greater than zero.
    """
    for name, value, unit in (("a_gR", a_gR, " m/s2"), ("gamma_I", gamma_I, "")):
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{name} must be greater than zero, not {value:g}{unit} [E-VALUE-02]")
