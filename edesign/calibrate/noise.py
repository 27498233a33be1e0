"""Noise of measured channels: how much there is, a motion without it, and the error no model can go below."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from edesign.calibration.residual.motion import Motion
from edesign.calibration.residual.repeatability import repeatability
from edesign.calibration.residual.tones import without_tones
from edesign.calibration.signals.noise_level import noise_level
from edesign.calibration.signals.sampling import even, evenly, rounding, step
from edesign.calibration.signals.smoothing import smoothed

_FEWEST = 64  # samples, for a spectrum
_LEAST = 5e-4  # of a test's rms force: no load cell is better, and no integration of a law is asked to be
NONE = 1e-8
"""Of the range: noise below it is rounding or leakage; no instrument is as good."""


def least_noise(force: np.ndarray) -> float:
    """Standard deviation that noise of a force (n,) N is taken for at least, N."""
    return _LEAST * float(np.sqrt(np.mean(force**2)))


def white_noise(values: np.ndarray, time: np.ndarray) -> float:
    """Standard deviation of the broadband noise in a channel.

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

    Returns:
        In the unit of the values; 0 if the channel has none.
    """
    return _noise(values, time)[0]


def _noise(values: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    """Standard deviation of the noise, and that of white noise that is as strong next to the motion."""
    values, time = np.asarray(values, dtype=float), np.asarray(time, dtype=float)
    if values.size < 8 or np.ptp(values) == 0.0:
        return 0.0, 0.0
    level = noise_level(values, step(time)) if values.size >= _FEWEST and evenly(time) else None
    both = (
        (_from_differences(values, time),) * 2 if level is None else (math.sqrt(level.power), math.sqrt(level.density))
    )
    least, none = rounding(values), NONE * float(np.ptp(values))
    all_of_it, near = (max(one, least) if max(one, least) > none else 0.0 for one in both)
    return all_of_it, near


def _from_differences(values: np.ndarray, time: np.ndarray, order: int = 4) -> float:
    """Median of divided differences, each over its own gain for white noise."""
    windows = np.lib.stride_tricks.sliding_window_view(time, order + 1)
    gaps = windows[:, :, None] - windows[:, None, :]
    gaps[:, np.arange(order + 1), np.arange(order + 1)] = np.mean(np.diff(time))
    weights = 1.0 / np.prod(gaps, axis=2)
    weights /= np.linalg.norm(weights, axis=1, keepdims=True)
    differences = np.sum(weights * np.lib.stride_tricks.sliding_window_view(values, order + 1), axis=1)
    return float(np.median(np.abs(differences))) / 0.67449


def smooth(time: np.ndarray, displacement: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """A motion freed from its noise before it is differentiated.

    The low-pass filter follows from the motion's spectrum and the noise (`signals.smoothing`); velocity and
    acceleration are those of the cubic spline through the result. A motion without noise is left as it is. Uneven
    samples pass through an even grid.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.

    Returns:
        Displacement (n,) m, velocity (n,) m/s, acceleration (n,) m/s^2, and the standard deviation of white noise that
        is as strong next to the motion as that of the channel, m.
    """
    time, displacement = np.asarray(time, dtype=float), np.asarray(displacement, dtype=float)
    found, noise, _ = _without_noise(time, displacement)
    if time.size < 4:
        velocity = np.gradient(found, time) if time.size > 1 else np.zeros_like(found)
        return found, velocity, np.zeros_like(found), noise
    spline = CubicSpline(time, found)
    return found, np.asarray(spline(time, 1)), np.asarray(spline(time, 2)), noise


def _without_noise(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, float, float]:
    """The values without noise, the standard deviation of white noise that is as strong next to the motion as that
    was, and what is left of it.
    """
    noise = _noise(values, time)[1]
    if noise == 0.0 or time.size < _FEWEST:
        return values.copy(), noise, noise
    grid, resampled = even(time, values)
    found, left = smoothed(resampled, noise)
    if grid is not time:
        found = np.asarray(CubicSpline(grid, found)(time), dtype=float)
    return found, noise, noise * float(np.sqrt(left))


@dataclass(frozen=True)
class NoiseFloor:
    """The error that no model of a test can go below.

    Attributes:
        force: standard deviation of what cannot be predicted, N: the repeatability if there is one, else the channel's
            noise and that of the displacement.
        repeatability: from successive steady cycles, without tones, N; None if the test is not periodic.
        nrms: square of `force` over the mean square of the measured force.
        channel: broadband noise of the force, or of the residual if one was given, N.
        displacement: noise of the displacement through the stiffness, what is left of it after `smooth`, N.
    """

    force: float
    repeatability: float | None
    nrms: float
    channel: float
    displacement: float


def noise_floor(
    time: np.ndarray,
    displacement: np.ndarray,
    force: np.ndarray,
    residual: np.ndarray | None = None,
    stiffness: float | None = None,
) -> NoiseFloor:
    """Noise floor of a test.

    The channel's noise is measured above the motion and continued into its band as if it were white. If the noise is
    stronger there (drift, play of the actuator, 1/f noise) that is too little; if it is weaker, too much. What differs
    between successive cycles at the same phase is measured in the band, whatever its colour, so it is preferred. It
    holds no error that comes back each cycle, nor tones, which a model can have; it does hold motions of the actuator
    that do not come back, unless the residual of a good model is given.

    Args:
        time: (n,) s.
        displacement: measured, (n,) m.
        force: measured, (n,) N.
        residual: measured less predicted force of a good model (n,), N; better than the force, as the model has taken
            the signal away.
        stiffness: of the test, N/m; without it the slope of the force over the displacement.
    """
    force = np.asarray(force, dtype=float)
    values = force if residual is None else np.asarray(residual, dtype=float)
    channel = white_noise(values, time)
    u = displacement - np.mean(displacement)
    slope = abs(float(force @ u) / float(u @ u)) if stiffness is None else abs(stiffness)
    through = slope * _without_noise(time, displacement)[2]
    motion = Motion(time, displacement)
    repeated = repeatability(motion, without_tones(motion, values))
    if repeated is not None:
        chosen = repeated
    elif residual is None:
        chosen = float(np.hypot(channel, through))
    else:
        chosen = channel
    power = float(np.mean(force**2))
    return NoiseFloor(chosen, repeated, chosen**2 / power if power > 0.0 else 0.0, channel, through)
