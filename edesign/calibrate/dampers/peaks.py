"""Narrow peaks that the spectra of several residuals have in common."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy.fft import next_fast_len
from scipy.interpolate import CubicSpline
from scipy.ndimage import median_filter
from scipy.special import gammainccinv

from edesign.calibrate.dampers.trial import Motion, Trial
from edesign.calibration.signals.windows import blackman_harris

ABOVE_ALL_MOTION = 2.5
"""Times its frequency, below which nothing is told from the motion itself."""
_ABOVE_MOTION = 7.5  # the first seven harmonics of a motion are below that times its frequency: they are the specimen's
_OF_THE_LAW = 10.0  # times its background: a peak of the predicted force
_MOST = 3
_HIGHEST = 200.0  # Hz
_FINENESS = 8  # points within 1 / duration
_NEIGHBOURS = 20.0  # half width of the background, in 1 / duration
_ONE_TEST = 30.0  # most that one test counts, so that a peak of its own is none of all
_FALSE_ALARM = 0.01
_SAME = 0.1  # difference of contrasts
_MAINS, _NEAR_MAINS = (50.0, 60.0, 100.0, 120.0, 150.0, 180.0, 200.0), 0.5  # Hz


def common_tones(trials: Sequence[Trial], residuals: Sequence[np.ndarray]) -> tuple[float, ...]:
    """Frequencies Hz of narrow peaks above the noise, the highest first.

    They are looked for at full rate: samples of a fit may fold a tone into the band of the motion. In each test what is
    above the seventh harmonic of its motion counts, and below it what is no multiple of the motion's frequency and no
    peak of the predicted force. Samples cannot tell a tone from its aliases: the one that
    stands out is taken.

    Args:
        trials: tests.
        residuals: (n_i,) N of each.
    """
    if not trials:
        return ()
    whole = [_whole(trial, residual) for trial, residual in zip(trials, residuals, strict=True)]
    lengths = [float(one.motion.time[-1] - one.motion.time[0]) for one in whole]
    longest, shortest = max(lengths), min(lengths)
    # records show no tone above their rate for what it is
    highest = min(_HIGHEST, max(1.0 / float(np.median(one.motion.steps)) for one in whole))
    grid = np.arange(1.0, highest * longest * _FINENESS) / (longest * _FINENESS)
    height, capped, tests = np.zeros_like(grid), np.zeros_like(grid), np.zeros(grid.size, dtype=int)
    for one in whole:
        own, counts = _heights(one, grid)
        height += own
        capped += np.minimum(own, _ONE_TEST)
        tests += counts
    # of noise alone the sum has a gamma distribution of as many tests as count
    limits = gammainccinv(np.arange(1, len(trials) + 1), _FALSE_ALARM / grid.size)
    limit = np.concatenate(([np.inf], limits))[tests]
    found: list[float] = []
    for _ in range(_MOST):
        excess = np.where(capped > limit, capped / limit, 0.0)
        if not np.any(excess):
            break
        top = grid[np.argmax(np.where(excess == excess.max(), height, 0.0))]  # strong ones stand out in all tests alike
        # more tests may count beside a peak than at it
        top = grid[np.argmax(np.where(np.abs(grid - top) < 4.0 / shortest, height / np.maximum(tests, 1), 0.0))]
        aliases = _aliases(top, whole[0].motion, highest)
        found.append(_true_one(aliases or [float(top)], whole))
        for alias in (top, *aliases):
            capped[np.abs(grid - alias) < 4.0 / shortest] = 0.0
    return tuple(found)


class _Whole(NamedTuple):
    """A test at full rate: its motion, what a model leaves and what it predicts, (m,) N."""

    motion: Motion
    residual: np.ndarray
    predicted: np.ndarray


def _heights(one: _Whole, grid: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Power of the residual over that of the background, 1 on average, at frequencies (m,) Hz; and whether the test
    counts there.
    """
    motion = one.motion
    step, n = float(np.median(motion.steps)), one.residual.size
    folded = np.abs(grid - np.round(grid * step) / step)
    height, _ = _over_background(one.residual, step, folded)
    fastest = motion.frequency
    width = 2.0 / (step * n)
    # at half the rate of the samples a spectrum has one degree of freedom in place of two
    counts = (folded > max(ABOVE_ALL_MOTION * fastest, width)) & (folded < 0.5 / step - width)
    low = counts & (folded <= _ABOVE_MOTION * fastest)
    if np.any(low):
        of_law, base = _over_background(one.predicted, step, folded)
        multiple = np.abs(folded - base * np.round(folded / base)) < 2.0 * width
        counts &= ~low | ~(multiple | (of_law > _OF_THE_LAW))
    return np.where(counts, height, 0.0), counts


def _over_background(values: np.ndarray, step: float, at: np.ndarray) -> tuple[np.ndarray, float]:
    """Power of (n,) values over that about it at frequencies (m,) Hz below half their rate; and the frequency, Hz, at
    which the power is largest.
    """
    size = next_fast_len(_FINENESS * values.size, real=True)
    power = np.abs(np.fft.rfft((values - values.mean()) * blackman_harris(values.size), size)) ** 2
    around = int(2.0 * _NEIGHBOURS * size / values.size)
    thin = max(1, size // values.size // 2)  # neighbours of finer spacing than that are one
    background = median_filter(power[::thin], max(3, around // thin), mode="nearest") / np.log(2.0)
    frequencies = np.arange(power.size) / (size * step)
    level = np.interp(at, frequencies[::thin], np.maximum(background, 1e-12 * power.max() + 1e-300))
    return np.interp(at, frequencies, power) / level, float(frequencies[max(int(np.argmax(power)), 1)])


def _aliases(frequency: float, motion: Motion, highest: float) -> list[float]:
    """The frequency and others that the samples of a motion cannot tell from it, up to the highest."""
    rate = 1.0 / float(np.median(motion.steps))
    orders = np.arange(np.ceil(highest / rate) + 1.0) * rate
    folded = abs(frequency - round(frequency / rate) * rate)
    return [float(f) for f in np.unique(np.concatenate((orders - folded, orders + folded))) if 0.0 < f <= highest]


def _true_one(frequencies: Sequence[float], whole: Sequence[_Whole]) -> float:
    """Of frequencies Hz that samples cannot tell apart the one that stands out most in the residuals; of those that are
    one there too, one near a multiple of the mains, else the lowest.
    """
    contrast = np.array([sum(_contrast(one.motion.time, one.residual, f) for one in whole) for f in frequencies])
    same = [f for f, own in zip(frequencies, contrast, strict=True) if own >= contrast.max() - _SAME]
    return min(same, key=lambda f: (min(abs(f - own) for own in _MAINS) > _NEAR_MAINS, f))


def _whole(trial: Trial, residual: np.ndarray) -> _Whole:
    """A test at full rate, what was predicted a cubic between samples."""
    if trial.whole is None:
        return _Whole(trial.motion, residual, trial.force - residual)
    motion = trial.whole.motion
    predicted = CubicSpline(trial.motion.time, trial.force - residual)(np.minimum(motion.time, trial.motion.time[-1]))
    return _Whole(motion, trial.whole.force - predicted, predicted)


def _contrast(time: np.ndarray, residual: np.ndarray, frequency: float) -> float:
    """Logarithm of a residual's power at a frequency Hz over that beside it."""
    at = time - time[0]
    windowed = (residual - residual.mean()) * blackman_harris(time.size)
    near = frequency + np.array([0.0, -7.0, -5.0, -4.0, 4.0, 5.0, 7.0]) / at[-1]
    power = np.abs(np.exp(-2j * np.pi * np.outer(near, at)) @ windowed) ** 2
    return float(np.log(power[0] / np.median(power[1:])))
