"""What each test has of its own: shares of columns."""

from __future__ import annotations

import numpy as np


def shares_of(columns: np.ndarray, residual: np.ndarray) -> np.ndarray:
    """Share (k,) of each column (n, k) in a residual (n,); columns that samples cannot tell apart share."""
    return np.asarray(np.linalg.lstsq(columns, residual, rcond=1e-8)[0])
