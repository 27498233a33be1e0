"""Half-cycles of a displacement history and the instants at which it crosses zero between them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.substructure.indicators.undetermined import Undetermined

QUIET = 0.02
"""Threshold as a share of the largest target: 0.1 mm of 5 mm, at which the thesis lets adaptation begin (6.2.4)."""


@dataclass(frozen=True)
class HalfCycles:
    """Half-cycles of one channel; instants are in samples from the first one.

    Attributes:
        sign: +1 or -1 of each half-cycle, (k,).
        first, last: samples beyond the threshold at both of its ends, (k,).
        crossing: zero crossing between a half-cycle and the next, (k - 1,).
    """

    sign: np.ndarray
    first: np.ndarray
    last: np.ndarray
    crossing: np.ndarray

    @property
    def rising(self) -> np.ndarray:
        """True for each crossing that goes from below to above zero, (k - 1,)."""
        return np.asarray(self.sign[1:] > 0.0)

    @property
    def dwell(self) -> np.ndarray:
        """Samples from threshold to threshold at each crossing, (k - 1,)."""
        return np.asarray(self.first[1:] - self.last[:-1])


def half_cycles(channel: np.ndarray, threshold: float) -> HalfCycles:
    """Part a channel where it goes from one threshold to the opposite one.

    Wiggles within the thresholds make no half-cycle, so neither a quiet start nor noise about zero counts.

    Args:
        channel: (n,), m.
        threshold: m, above zero.

    Raises:
        Undetermined: the channel stays within the threshold.
    """
    beyond = np.flatnonzero(np.abs(channel) >= threshold)
    if not beyond.size:
        raise Undetermined(f"no sample is beyond the threshold of {threshold:g} m")
    signs = np.sign(channel[beyond])
    turns = np.flatnonzero(np.diff(signs))
    first = beyond[np.concatenate(([0], turns + 1))]
    last = beyond[np.concatenate((turns, [beyond.size - 1]))]
    return HalfCycles(np.sign(channel[first]), first, last, _crossings(channel, last[:-1], first[1:]))


def threshold_of(target: np.ndarray, threshold: float | None) -> float:
    """Return the threshold asked for, or `QUIET` of the largest target.

    Args:
        target: (n,) m.
        threshold: m, or None.

    Returns:
        m.

    Raises:
        Undetermined: the target is zero throughout.
    """
    if threshold is not None:
        return threshold
    largest = float(np.max(np.abs(target)))
    if largest == 0.0:
        raise Undetermined("the target is zero throughout")
    return QUIET * largest


def quarter_period(target: np.ndarray) -> float:
    """Return a quarter of the period at the rms frequency of a target (rms velocity over rms displacement), in samples.

    A sine of that frequency passes within it from threshold to threshold if its amplitude is 1.4 thresholds or more.

    Args:
        target: (n,) m.
    """
    motion = target - np.mean(target)
    velocity = float(np.mean(np.diff(motion) ** 2))
    return 0.5 * math.pi * math.sqrt(float(np.mean(motion**2)) / velocity) if velocity > 0.0 else math.inf


def _crossings(channel: np.ndarray, begin: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Zero crossing between samples `begin` and `end`, by linear interpolation.

    Where noise makes several, it is that of the straight line of least squares through all samples between.
    """
    above = channel >= 0.0
    before = np.flatnonzero(above[:-1] != above[1:])
    instants = before + channel[before] / (channel[before] - channel[before + 1])
    found, count = np.searchsorted(before, begin), np.searchsorted(before, end)
    crossing = instants[found]
    for several in np.flatnonzero(count - found > 1):
        low, high = int(begin[several]), int(end[several])
        crossing[several] = low + _zero_of_line(channel[low : high + 1])
    return np.asarray(crossing)


def _zero_of_line(values: np.ndarray) -> float:
    """Where the straight line of least squares through values crosses zero, samples from the first; within them."""
    at = np.arange(values.size) - 0.5 * (values.size - 1)
    slope = float(at @ values) / float(at @ at)
    middle = 0.5 * (values.size - 1)
    if slope == 0.0:
        return middle
    return float(np.clip(middle - float(np.mean(values)) / slope, 0.0, values.size - 1.0))
