"""How a channel was sampled: in time, evenly or not, and in value, in steps of a digitiser or of printed digits."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline

_EVEN = 1e-3  # of a step: departure from even times that means nothing
_MOST_STEPS = 1e9  # of a digitiser or of printed digits over the range: 30 bit
_FEWEST_GAPS = 8  # between values: with fewer, steps cannot be separated from chance
_INTEGER = 1e-2  # of a step
_DIVISORS = 8  # the smallest gap may be that many steps
_BENDS = 0.2  # of the changes between samples: fewer are ramps


def step(time: np.ndarray) -> float:
    """Return the mean time between samples, s.

    Args:
        time: (n,) s, ascending.
    """
    return float(time[-1] - time[0]) / max(time.size - 1, 1)


def evenly(time: np.ndarray) -> bool:
    """Say whether samples are evenly spaced, up to the rounding of printed times.

    Args:
        time: (n,) s, ascending.
    """
    dt = step(time)
    departure = float(np.max(np.abs(time - time[0] - dt * np.arange(time.size))))
    if departure <= _EVEN * dt:
        return True
    printed = quantisation(time)
    return printed < 0.5 * dt and departure <= 0.76 * printed  # half a digit at each sample, half at each end


def quantisation(values: np.ndarray) -> float:
    """Return the step of which all values are multiples, up to one offset; 0 if there is none.

    Args:
        values: (n,) in any unit.
    """
    distinct = np.unique(values)
    if distinct.size <= _FEWEST_GAPS:
        return 0.0
    rounding = 1e-13 * float(np.max(np.abs(distinct)))
    gaps = np.diff(distinct)
    gaps = gaps[gaps > max(rounding, float(np.ptp(distinct)) / _MOST_STEPS)]
    if gaps.size < _FEWEST_GAPS:
        return 0.0
    least = float(np.min(gaps))
    for divisor in range(1, _DIVISORS + 1):
        multiples = gaps / least * divisor
        whole = np.round(multiples)
        if np.max(np.abs(multiples - whole)) <= _INTEGER:
            return float(np.sum(gaps) / np.sum(whole))
    return 0.0


def rounding(values: np.ndarray) -> float:
    """Return the standard deviation of the rounding of a channel to its steps, step / sqrt(12).

    A straight ramp sampled evenly also has values in steps, but the same one from sample to sample: it has no rounding.

    Args:
        values: (n,) in any unit.
    """
    least = 1e-9 * float(np.ptp(values))
    changes, bends = (int(np.count_nonzero(np.abs(np.diff(values, order)) > least)) for order in (1, 2))
    return quantisation(values) / np.sqrt(12.0) if bends > _BENDS * changes else 0.0


def even(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the channel at as many evenly spaced times, by a cubic spline where they are not so already.

    Args:
        time: (n,) s, ascending.
        values: (n,) in any unit.
    """
    if evenly(time) or time.size < 4:
        return time, values
    grid = np.linspace(time[0], time[-1], time.size)
    return grid, np.asarray(CubicSpline(time, values)(grid), dtype=float)
