"""Deformation histories as the laws see them."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike


def spline_velocity(time: ArrayLike, deformation: ArrayLike) -> np.ndarray:
    """Velocity (n,) at the samples of the cubic spline through a deformation (n,) at ascending times (n,).

    With less than four samples it is that of the polynomial through them.
    """
    t, u = np.asarray(time, dtype=float), np.asarray(deformation, dtype=float)
    if t.size < 2:
        return np.zeros_like(u)
    return np.asarray(scipy.interpolate.CubicSpline(t, u)(t, 1), dtype=float)
