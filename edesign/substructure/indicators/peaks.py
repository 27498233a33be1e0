"""Amplitude errors of the peaks, half-cycle by half-cycle."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.substructure.indicators.channels import channel, time_step
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.half_cycles import half_cycles, threshold_of
from edesign.substructure.indicators.undetermined import Undetermined

CAP = 0.9
"""Share of a target's peak above which a parabola is laid through the samples: many average noise out, and a sine is
still a parabola there within 0.2 % of its peak, alike for target and measured channel."""


@dataclass(frozen=True)
class PeakErrors:
    """Errors of the peaks: measured over target peak, less 1.

    Attributes:
        mean: with sign, 1.
        largest: the one of largest magnitude, with sign, 1.
        errors: of each half-cycle, (k,).
    """

    mean: float
    largest: float
    errors: np.ndarray


def peak_errors(
    target: ArrayLike, measured: ArrayLike, step: float, threshold: float | None = None, expected: float | None = None
) -> PeakErrors:
    """Compare the peaks of each half-cycle of the target with the measured ones, the delay taken off.

    A peak is the top of the least-squares parabola through the samples where the target is above `CAP` of its largest,
    at least three. Half-cycles that stay within the threshold do not count, nor those which the record cuts. In
    noise-like motion small half-cycles make these errors noisy; the amplitude of `frequency_index` is not.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.
        step: s.
        threshold: m; None: `QUIET` of the largest target.
        expected: delay to take off, s; None: that of `correlation_delay`.

    Raises:
        InputError: lengths that differ, NaN, a step out of range.
        Undetermined: no whole half-cycle; a measured channel that does not follow the target.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    time_step(step)
    late = (correlation_delay(x_t, x_m, step).delay if expected is None else expected) / step
    cycles, shift = half_cycles(x_t, threshold_of(x_t, threshold)), round(late)
    before = np.concatenate(([0], cycles.last[:-1]))
    after = np.concatenate((cycles.first[1:], [x_t.size - 1]))
    ratios = []
    for sign, begin, end in zip(cycles.sign, before, after, strict=True):
        low, high = (begin + cap for cap in _cap(sign * x_t[begin : end + 1]))
        if high >= low and low + shift >= 0 and high + shift < x_t.size:
            got = _top(sign * x_m[low + shift : high + shift + 1])
            ratios.append(got / _top(sign * x_t[low : high + 1]) - 1.0)
    if not ratios:
        raise Undetermined("no half-cycle of the target has its peak and the measured one within the record")
    errors = np.array(ratios)
    return PeakErrors(float(np.mean(errors)), float(errors[np.argmax(np.abs(errors))]), errors)


def _cap(values: np.ndarray) -> tuple[int, int]:
    """First and last sample about the largest one that are above `CAP` of it; (0, -1) if the ends cut the peak."""
    top = int(np.argmax(values))
    below = np.flatnonzero(values < CAP * values[top])
    after = int(np.searchsorted(below, top))
    if after in (0, below.size):
        return 0, -1
    return min(int(below[after - 1]) + 1, top - 1), max(int(below[after]) - 1, top + 1)


def _top(values: np.ndarray) -> float:
    """Height of the parabola of least squares through values; their largest if its top is not among them."""
    z = np.linspace(-1.0, 1.0, values.size)
    second, fourth = float(np.sum(z**2)), float(np.sum(z**4))
    total, curved = float(np.sum(values)), float(np.sum(z**2 * values))
    square = (z.size * curved - second * total) / (z.size * fourth - second**2)
    slope, middle = float(np.sum(z * values)) / second, (total - square * second) / z.size
    if not square < 0.0 or abs(slope) > -2.0 * square:
        return float(np.max(values))
    return middle - slope**2 / (4.0 * square)
