"""White noise of a history from its differences, to which smooth motions add little."""

from __future__ import annotations

import math

import numpy as np

_MEDIAN = 0.67449  # of the absolute value of a standard normal number


def robust_deviation(values: np.ndarray) -> float:
    """Return the standard deviation of normal numbers about zero, by the median of their absolute values.

    Args:
        values: (n,) in any unit.
    """
    return float(np.median(np.abs(values))) / _MEDIAN


def difference_gain(order: int) -> float:
    """Return the standard deviation of a difference of unit white noise: the root of a central binomial coefficient."""
    return math.sqrt(math.comb(2 * order, order))


def difference_noise(values: np.ndarray, within: np.ndarray, order: int = 4) -> float:
    """Return the standard deviation of the white noise of even samples; 0 if there are too few.

    Args:
        values: (n,) in any unit.
        within: (n,) which samples count.
        order: of the differences: they end all polynomials below it.
    """
    if values.size <= order:
        return 0.0
    differences = np.diff(values, order)[np.convolve(within, np.ones(order + 1), "valid") > order + 0.5]
    return robust_deviation(differences) / difference_gain(order) if differences.size else 0.0


def divided_difference_noise(values: np.ndarray, time: np.ndarray, order: int = 4) -> float:
    """Return the standard deviation of the white noise of uneven samples, each difference over its own gain.

    Args:
        values: (n,) in any unit.
        time: (n,) s, ascending.
        order: of the divided differences: they end all polynomials below it.
    """
    windows = np.lib.stride_tricks.sliding_window_view(time, order + 1)
    gaps = windows[:, :, None] - windows[:, None, :]
    gaps[:, np.arange(order + 1), np.arange(order + 1)] = np.mean(np.diff(time))
    weights = 1.0 / np.prod(gaps, axis=2)
    weights /= np.linalg.norm(weights, axis=1, keepdims=True)
    return robust_deviation(np.sum(weights * np.lib.stride_tricks.sliding_window_view(values, order + 1), axis=1))
