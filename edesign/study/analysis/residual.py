"""Residual response: what remains when the free vibration after a record has been averaged out."""

from __future__ import annotations

import numpy as np

DEFINITION = "mean over the last whole fundamental period (under gravity) of the analysed time"


def period_steps(time_step: float, period: float) -> int:
    """Return the number of time steps in a whole period, at least one.

    Args:
        time_step: s.
        period: s.
    """
    return max(round(period / time_step), 1)


def residual(values: np.ndarray, time_step: float, period: float) -> np.ndarray:
    """Return the mean over the last whole period; over all values if they are shorter than that.

    Args:
        values: (nt, ...), at a constant step.
        time_step: s.
        period: s.
    """
    count = min(period_steps(time_step, period), values.shape[0])
    return np.asarray(values[-count:].mean(axis=0))
