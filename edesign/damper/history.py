"""Deformation histories as the laws see them."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike


def spline_velocity(time: ArrayLike, deformation: ArrayLike) -> np.ndarray:
    """Return the velocity at the samples of the cubic spline through a deformation.

    With less than four samples it is that of the polynomial through them.

    Args:
        time: (n,) s, ascending.
        deformation: (n,) m.

    Returns:
        (n,) m/s.
    """
    t, u = np.asarray(time, dtype=float), np.asarray(deformation, dtype=float)
    if t.size < 2:
        return np.zeros_like(u)
    return np.asarray(scipy.interpolate.CubicSpline(t, u)(t, 1), dtype=float)
