"""Error of the response of the structure in a test against its direct analysis."""

from __future__ import annotations

import math

import numpy as np


def response_error(found: np.ndarray, direct: np.ndarray) -> float:
    """Return the root mean square of the difference over that of the direct response; NaN: that is zero.

    Where the test ended early, the direct response is cut at the same sample.

    Args:
        found: (n, ...) of the test.
        direct: (m, ...) of the direct analysis, m >= n, in the same unit.
    """
    same = direct[: len(found)]
    scale = float(np.sqrt(np.mean(same**2)))
    return float(np.sqrt(np.mean((found - same) ** 2))) / scale if scale > 0.0 else math.nan


def peak_error(found: np.ndarray, direct: np.ndarray) -> float:
    """Return the relative error of the largest magnitude; NaN: that of the direct response is zero.

    Args:
        found: (n,) response of the test.
        direct: (n,) response without a test, in the same unit.

    Returns:
        The relative error, dimensionless.
    """
    peak = float(np.max(np.abs(direct)))
    return float(np.max(np.abs(found))) / peak - 1.0 if peak > 0.0 else math.nan
