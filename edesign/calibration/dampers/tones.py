"""Narrow peaks that the spectra of tests have in common and that are not of their motion, such as hum of the mains."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import median_filter

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.signals.windows import blackman_harris

_ABOVE_MOTION = 7.5  # the first seven harmonics of a motion are below that times its frequency: they are the specimen's
_LOWEST = 5.0  # Hz
_SEEN = 0.45  # of the rate of sampling: above it the window meets the image of what it shows
_MOST = 3
_FINENESS = 4  # frequencies within 1 / duration
_NEIGHBOURS = 20  # of the background, in 1 / duration to each side
_ONE_TEST = 30.0  # most that one test counts, so that a peak of its own is none of all
_STANDS_OUT = 12.0  # times the background, on average over the tests: of noise alone one in 1e5
_OF_THE_LAW = 10.0  # times its background: a peak of the predicted force is none of the channel
_OF_THE_MOTION = 20.0  # times its background: the motion has a tone; of noise alone one in 1e8
_WIDTH = 4.0  # of the main lobe of the window, in 1 / duration


def common_tones(
    motions: Sequence[Motion], forces: Sequence[np.ndarray], predicted: Sequence[np.ndarray]
) -> tuple[float, ...]:
    """Return the frequencies of narrow peaks above the noise, Hz, the strongest first.

    Up to half the highest rate of sampling. A slower test shows a tone at its image, where its samples have it
    (Shannon 1949). Of each test the frequencies above the seventh harmonic of its motion count, and below it those that
    are no harmonic of its motion. A motion of several tones makes all their sums and differences in a law that is not
    linear, so of such a test no lower ones count. A peak must stand out in the mean of power over background, over
    those tests, half of all or more, whose law has no peak there.

    Args:
        motions: of the tests, at full rate.
        forces: (n_i,) N, measured in each.
        predicted: (n_i,) N, by a law.
    """
    if not motions:
        return ()
    longest = max(float(one.since[-1]) for one in motions)
    shortest = min(float(one.since[-1]) for one in motions)
    rates = [1.0 / float(np.median(one.steps)) for one in motions]
    highest = _SEEN * max(rates)
    if highest <= _LOWEST:
        return ()
    grid = np.arange(_LOWEST, highest, 1.0 / (_FINENESS * longest))
    images = [np.abs(grid - rate * np.round(grid / rate)) for rate in rates]
    residuals = [force - of_law for force, of_law in zip(forces, predicted, strict=True)]
    heights = np.array([_over_background(*each) for each in zip(motions, residuals, images, strict=True)])
    of_law = np.array([_over_background(*each) for each in zip(motions, predicted, images, strict=True)])
    own = [(one >= _LOWEST) & (one <= _SEEN * rate) for one, rate in zip(images, rates, strict=True)]
    counts = (
        (of_law < _OF_THE_LAW) & own & np.array([_not_of_motion(*each) for each in zip(motions, images, strict=True)])
    )
    number = np.maximum(counts.sum(axis=0), 1)
    enough = counts.sum(axis=0) >= 0.5 * len(motions)
    found: list[float] = []
    while len(found) < _MOST:
        each = np.where(counts, heights, 0.0)
        common = np.where(enough, np.sum(np.minimum(each, _ONE_TEST), axis=0) / number, 0.0)
        if not np.any(common > _STANDS_OUT):
            break
        top = int(np.argmax(np.where(common > _STANDS_OUT, np.sum(each, axis=0) / number, 0.0)))
        found.append(_finer(motions, residuals, float(grid[top]), 1.0 / longest))
        for own_heights, image in zip(heights, images, strict=True):
            own_heights[np.abs(image - image[top]) < _WIDTH / shortest] = 0.0
    return tuple(found)


def _not_of_motion(motion: Motion, grid: np.ndarray) -> np.ndarray:
    """Return whether frequencies (m,) Hz are above the seventh harmonic of a motion, or no harmonic of it."""
    highest = _ABOVE_MOTION * motion.frequency
    lobe = _WIDTH / float(motion.since[-1])
    below = np.arange(lobe, highest, lobe / (_WIDTH * _FINENESS))
    if not below.size:
        return np.asarray(grid >= highest)
    heights = _over_background(motion, motion.displacement, below)
    lines = below[heights > _OF_THE_MOTION]
    if not lines.size:
        return np.ones(grid.size, dtype=bool)
    base = float(below[np.argmax(heights)])
    about = lines[np.abs(lines - base) < 0.5 * base] - base
    low, high = float(about[0]) - lobe, float(about[-1]) + lobe

    def harmonic(frequencies: np.ndarray) -> np.ndarray:
        beside = frequencies - base * np.maximum(np.round(frequencies / base), 1.0)
        return np.asarray((beside >= low) & (beside <= high))

    return np.asarray((grid >= highest) | (~harmonic(grid) & np.all(harmonic(lines))))


def _windowed(residual: np.ndarray) -> np.ndarray:
    return np.asarray((residual - residual.mean()) * blackman_harris(residual.size))


def _over_background(motion: Motion, residual: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """Return the power of a residual (n,) over that about it, 1 on average, at frequencies (m,) Hz."""
    n, step = residual.size, float(np.median(motion.steps))
    size = _FINENESS * n
    power = np.abs(np.fft.rfft(_windowed(residual), size)) ** 2
    coarse = power[::_FINENESS]
    background = median_filter(coarse, 2 * _NEIGHBOURS + 1, mode="nearest") / np.log(2.0)
    frequencies = np.arange(power.size) / (size * step)
    least = 1e-12 * float(power.max()) + 1e-300
    level = np.interp(grid, frequencies[::_FINENESS], np.maximum(background, least))
    return np.interp(grid, frequencies, power) / level


def _finer(motions: Sequence[Motion], residuals: Sequence[np.ndarray], frequency: float, width: float) -> float:
    """Return the frequency near one, Hz, with the largest power in all tests."""
    windowed = [_windowed(one) for one in residuals]

    def power(f: float) -> float:
        return sum(
            abs(np.exp(-2j * np.pi * f * m.since) @ r) ** 2 / float(r @ r)
            for m, r in zip(motions, windowed, strict=True)
        )

    for _ in range(6):
        near = frequency + width * np.array((-1.0, -0.5, 0.0, 0.5, 1.0))
        frequency = float(max(near, key=power))
        width *= 0.5
    return frequency
