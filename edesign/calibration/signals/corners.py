"""Whether a motion turns between its samples faster than a spline through them can follow."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

_BETTER = 0.93  # errors of cubics without overshoot over those of a spline: noise alone makes 0.95, waves above 1
_UNKNOWN, _NOT_WORSE = 0.015, 1.5
"""Share of the range by which a spline misses samples that show too little of a motion for either to be right, and how
many times as large the other errors may be there: for a sine at six samples in a cycle they are 2.6 times.
"""
_ABOVE_NOISE = 2.0  # times: a spline between noisy samples is off by 1.2 to 1.4 times the noise
_FEWEST = 8  # samples


def cornered(time: np.ndarray, values: np.ndarray, noise: float) -> bool:
    """Say whether cubics that do not overshoot their samples predict every other sample better than a spline does.

    Where neither predicts them, as there are too few, cubics that do not overshoot are the safer ones.

    Records that were digitised from figures, or taken at a few points of each ramp, turn at their samples. A spline
    overshoots these, and a law that yields follows.

    Args:
        time: (n,) s, ascending.
        values: (n,) in any unit.
        noise: standard deviation of theirs, in that unit.

    Source: Fritsch & Carlson (1980), SIAM J. Numer. Anal. 17, 238-246 (monotone cubics).
    """
    if time.size < _FEWEST:
        return False
    spline = _left_out(time, values, CubicSpline)
    if spline <= _ABOVE_NOISE * noise:
        return False
    most = _NOT_WORSE if spline > _UNKNOWN * float(np.ptp(values)) else _BETTER
    return _left_out(time, values, PchipInterpolator) < most * spline


def _left_out(time: np.ndarray, values: np.ndarray, through: Callable[..., Callable[..., np.ndarray]]) -> float:
    """Return the root mean square error at every other sample, of what goes through the others."""
    errors = []
    for first in (1, 2):
        known = np.ones(time.size, dtype=bool)
        known[first:-1:2] = False
        errors.append(through(time[known], values[known])(time[~known]) - values[~known])
    return float(np.sqrt(np.mean(np.concatenate(errors) ** 2)))
