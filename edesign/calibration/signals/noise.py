"""Noise of measured channels: how much there is, and a motion without it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from edesign.calibration.signals.noise_level import noise_level
from edesign.calibration.signals.sampling import even, evenly, rounding, step
from edesign.calibration.signals.smoothing import smoothed
from edesign.estimation.differences import difference_noise, divided_difference_noise

MOST_NOISE = 0.3
"""Of the rms of a channel: no transducer has so much, and what is more is motion."""

_FEWEST = 64  # samples, for a spectrum
_LEAST = 1e-3  # of a test's rms force: reproducibility of a force transducer of class 0.5 (ISO 376:2011, table 2)
_STILL, _FEWEST_AT_REST = 16, 32  # samples that move by less than that together; of all rests, for 15 % of the noise
_STICKS_OUT = 3.0  # standard deviations; noise at times that are up to 40 % of a step off stays below 2.4
_NONE = 1e-8  # of the range: noise below it is rounding or leakage; no instrument is as good


def least_noise(force: np.ndarray) -> float:
    """Return the standard deviation that noise of a force is taken for at least, N.

    Args:
        force: (n,) N.
    """
    return _LEAST * float(np.sqrt(np.mean(force**2)))


def white_noise(values: np.ndarray, time: np.ndarray, beside: Sequence[np.ndarray] = ()) -> float:
    """Return the standard deviation of the broadband noise in a channel.

    Spectra of short segments of second differences (Kaiser window), the median over segments, without narrow peaks: the
    first part that is flat over half an octave, above 20 Hz (or 40 % of the Nyquist frequency where sampling is slow).
    The density there is taken for all frequencies up to its end, so noise that a logger's filter has cut keeps its true
    deviation; what falls as noise does that is correlated from sample to sample counts as that. Without a flat part it
    is the median of the upper half. Unevenly sampled channels, and those below 64 samples: fourth divided differences,
    which end all cubics. Where all values are multiples of a step the noise is at least that of rounding to it,
    step / sqrt(12).

    Args:
        values: (n,) in any unit.
        time: (n,) s, ascending.
        beside: (n,) of other channels, which share the motion: noise is then looked for above what both share.

    Returns:
        In the unit of the values; 0 if the channel has none. Where it shares something up to the highest frequency it
        is that of rests, nan if there are none.
    """
    return _noise(values, time, beside)[0]


def _noise(values: np.ndarray, time: np.ndarray, beside: Sequence[np.ndarray]) -> tuple[float, float]:
    """Standard deviation of the noise, and that of white noise that is as strong next to the motion."""
    values, time = np.asarray(values, dtype=float), np.asarray(time, dtype=float)
    if values.size < 8 or np.ptp(values) == 0.0:
        return 0.0, 0.0
    level = None
    if values.size >= _FEWEST and evenly(time):
        level = noise_level(values, step(time), beside)
    both = (
        (divided_difference_noise(values, time),) * 2
        if level is None
        else (math.sqrt(level.power), math.sqrt(level.density))
    )
    least, none = rounding(values), _NONE * float(np.ptp(values))
    if math.isnan(both[0]):
        return (_in_rests(values, (values, *beside)),) * 2
    all_of_it, near = (max(one, least) if max(one, least) > none else 0.0 for one in both)
    return all_of_it, near


def _in_rests(values: np.ndarray, channels: Sequence[np.ndarray]) -> float:
    """Return the standard deviation of noise where one of the channels (n,) rests; nan: none does for long."""
    rests = np.zeros(values.size, dtype=bool)
    for one in channels:
        still = maximum_filter1d(one, _STILL) - minimum_filter1d(one, _STILL) <= _LEAST * float(np.std(one))
        rests |= maximum_filter1d(still.astype(np.uint8), _STILL).astype(bool)
    return difference_noise(values, rests) if np.count_nonzero(rests) >= _FEWEST_AT_REST else math.nan


def smooth(
    time: np.ndarray,
    displacement: np.ndarray,
    rests: bool = True,
    beside: Sequence[np.ndarray] = (),
    noise: float | None = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Return a motion freed from its noise before it is differentiated.

    The low-pass filter follows from the motion's spectrum and the noise (`smoothing`); velocity and
    acceleration are those of the cubic spline through the result. A motion without noise is left as it is. Uneven
    samples pass through an even grid.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
        rests: whether noise of rests is taken off too.
        beside: (n,) of other channels, as the force: what both share is motion.
        noise: standard deviation of white noise as strong next to the motion, m; None: it is measured.

    Returns:
        Displacement (n,) m, velocity (n,) m/s, acceleration (n,) m/s^2, and the standard deviation of white noise that
        is as strong next to the motion as that of the channel, m.
    """
    time, displacement = np.asarray(time, dtype=float), np.asarray(displacement, dtype=float)
    noise = _next_to_motion(time, displacement, beside) if noise is None else noise
    found = _without_noise(time, displacement, rests, noise)
    if time.size < 4:
        velocity = np.gradient(found, time) if time.size > 1 else np.zeros_like(found)
        return found, velocity, np.zeros_like(found), noise
    spline = CubicSpline(time, found)
    return found, np.asarray(spline(time, 1)), np.asarray(spline(time, 2)), noise


def _next_to_motion(time: np.ndarray, values: np.ndarray, beside: Sequence[np.ndarray]) -> float:
    """Return the standard deviation of white noise as strong next to the motion; 0 if motion has all of the band."""
    noise = _noise(values, time, beside)[1]
    return 0.0 if math.isnan(noise) or noise > MOST_NOISE * float(np.std(values)) else noise


def _without_noise(time: np.ndarray, values: np.ndarray, rests: bool, noise: float) -> np.ndarray:
    """Return values without noise of a standard deviation."""
    if noise == 0.0 or time.size < _FEWEST:
        return values.copy()
    grid, resampled = even(time, values)
    found = smoothed(resampled, noise, rests)
    if grid is not time:
        # what the even grid does not resolve is noise as well, unless more of it sticks out
        unresolved = values - np.asarray(CubicSpline(grid, resampled)(time), dtype=float)
        found = np.asarray(CubicSpline(grid, found)(time), dtype=float)
        if np.max(np.abs(unresolved)) > _STICKS_OUT * noise:
            found += unresolved
    return found
