"""Residual response: what remains when the free vibration after a record has been averaged out."""

from __future__ import annotations

import numpy as np

DEFINITION = "mean over the last whole fundamental period (under gravity) of the analysed time"


def residual(values: np.ndarray, time_step: float, period: float) -> np.ndarray:
    """Return the mean over the last whole period; over all values if they are shorter than that.

    Args:
        values: (nt, ...), at a constant step.
        time_step: s.
        period: s.
    """
    count = min(max(round(period / time_step), 1), values.shape[0])
    return np.asarray(values[-count:].mean(axis=0))
