"""Lateral force method of analysis, EN 1998-1:2004, 4.3.3.2."""

from __future__ import annotations

import numpy as np

from edesign.errors import InputError

LONGEST_PERIOD = 2.0  # s, Eq. 4.4


def correction_factor(period: float, T_C: float, storeys: int) -> float:
    """Return lambda: 0.85 if T_1 <= 2 T_C and there are more than two storeys, else 1.

    Args:
        period: T_1, s.
        T_C: corner period of the spectrum, s.
        storeys: of the building.

    Source: EN 1998-1:2004, 4.3.3.2.2(1)P.
    """
    return 0.85 if period <= 2.0 * T_C and storeys > 2 else 1.0


def is_applicable(period: float, T_C: float) -> bool:
    """Say whether the first period allows the method: T_1 <= 4 T_C and 2 s.

    Args:
        period: T_1 in the direction of the action, s.
        T_C: upper corner period of the constant acceleration, s.

    Source: EN 1998-1:2004, 4.3.3.2.1(2) a, Eq. 4.4.
    """
    return period <= min(4.0 * T_C, LONGEST_PERIOD)


def base_shear(acceleration: float, mass: float, period: float, T_C: float, storeys: int) -> float:
    """Return F_b = S_d(T_1) m lambda, N.

    Args:
        acceleration: S_d(T_1), m/s2.
        mass: m, of all that is above the foundation, kg.
        period: T_1 in the direction of the action, s.
        T_C: corner period of the spectrum, s.
        storeys: of the building.

    Source: EN 1998-1:2004, 4.3.3.2.2(1)P, Eq. 4.5.
    """
    return acceleration * mass * correction_factor(period, T_C, storeys)


def lateral_forces(base_shear: float, mass: np.ndarray, shape: np.ndarray) -> np.ndarray:
    """Return F_i = F_b s_i m_i / sum(s_j m_j), N, in the shape of `mass`.

    Args:
        base_shear: F_b = S_d(T_1) m lambda (Eq. 4.5), N.
        mass: kg.
        shape: displacements s_i of the masses in the fundamental mode, or their heights z_i (Eq. 4.11), any scale.

    Raises:
        InputError: the masses do not move.

    Source: EN 1998-1:2004, 4.3.3.2.3, Eqs. 4.10 and 4.11.
    """
    weights = mass * shape
    total = float(weights.sum())
    if total == 0.0:
        raise InputError("the masses have no displacement in the shape that lateral forces follow [E-EC8-06]")
    return base_shear * weights / total
