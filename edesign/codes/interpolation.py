"""Interpolation of curves that are straight in logarithms of both axes: spectra of hazard analyses, hazard curves."""

from __future__ import annotations

import numpy as np


def exponents(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the exponents (n - 1,) of the power laws between points of a curve.

    Args:
        x: (n,) ascending, greater than zero.
        y: (n,) greater than zero.
    """
    return np.asarray(np.diff(np.log(y)) / np.diff(np.log(x)))


def log_log(at: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the ordinates at places greater than zero, in their shape; beyond the points the outermost lines go on.

    Args:
        x: places of the points of the curve, see `exponents`.
        y: ordinates of the points, see `exponents`.

    Returns:
        Ordinates in the shape of `at`.
    """
    line = np.clip(np.searchsorted(x, at) - 1, 0, x.size - 2)
    return np.asarray(y[line] * (at / x[line]) ** exponents(x, y)[line])
