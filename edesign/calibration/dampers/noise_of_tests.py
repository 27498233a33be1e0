"""Noise of tests: motions freed of it, and what it makes of the force, through a model too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import maximum_filter1d, minimum_filter1d, uniform_filter1d

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.signals.corners import cornered
from edesign.calibration.signals.noise import least_noise, smooth, white_noise
from edesign.estimation.differences import difference_noise

_AGAIN = 6  # times that noise is added
_EVENED = 0.1  # s, over which its effect is evened out
_MOST_TIMES = 4.0  # its power over that by a model
_REST = 0.5  # s, that a rest lasts at least
_STRAYS = 2.0  # standard deviations of the noise, within which a motion at rest stays meanwhile
_SLOW = 0.01  # of the largest velocity, which no motion at rest has


def smoothed_motion(time: np.ndarray, displacement: np.ndarray) -> tuple[Motion, float]:
    """Return a motion freed of noise, and the standard deviation of this noise, m.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
    """
    found, velocity, acceleration, noise = smooth(time, displacement)
    if not cornered(time, displacement, noise):
        return Motion(time, found, velocity, acceleration), noise
    cubics = PchipInterpolator(time, displacement)
    velocity = cubics(time, 1)
    return Motion(time, displacement, velocity, np.gradient(velocity, time), cornered=True), noise


def with_noise(
    problem: DamperProblem, predicted: Sequence[np.ndarray], forces_of: Callable[[DamperProblem], Sequence[np.ndarray]]
) -> list[Experiment]:
    """Return tests with their noise.

    The force channel's is estimated above the motion, in what a model leaves of the force too. Noise of the
    displacement makes force through the model: such noise is added and taken off again. That is most where the damper
    is slow and its force steep over the velocity. The same noise is added whatever the model. It is added to motions
    that are at rest where no more than noise is left of them: what smoothing leaves of the noise there hides that of a
    second time from a law of a low power of the velocity.

    Args:
        problem: with all tests, at full rate.
        predicted: (n_i,) N of every test, with nuisance amplitudes.
        forces_of: forces (n_i,) N of the model in all tests of such a problem.

    Raises:
        PredictionError: the model cannot predict the tests with noise.
    """
    random = np.random.default_rng(len(problem.experiments))
    rests = [_rests(one.motion, one.displacement_noise) for one in problem.experiments]
    still = [replace(one, motion=_still(one.motion, at)) for one, at in zip(problem.experiments, rests, strict=True)]
    power, plain = [np.zeros_like(force) for force in predicted], forces_of(problem.with_experiments(still))
    for _ in range(_AGAIN if any(one.displacement_noise for one in still) else 0):
        again = []
        for one, at in zip(still, rests, strict=True):
            motion = one.motion
            if one.displacement_noise > 0.0:
                noisy = motion.displacement + one.displacement_noise * random.standard_normal(motion.time.size)
                motion, _ = smoothed_motion(motion.time, noisy)
                if problem.law.rate_dependent and not motion.cornered:
                    # of what wavelets take off the velocity all may have been motion; a law of a power of it sees it
                    whole = smooth(motion.time, noisy, rests=False)[1]
                    motion = replace(motion, velocity=np.where(at, motion.velocity, whole))
            again.append(replace(one, motion=motion))
        for own, force, moved in zip(power, plain, forces_of(problem.with_experiments(again)), strict=True):
            own += (moved - force) ** 2 / _AGAIN
    return [_noisy(*each) for each in zip(problem.experiments, predicted, power, strict=True)]


def _rests(motion: Motion, noise: float) -> np.ndarray:
    """Return whether samples (n,) are of rests: they move by no more than noise, m, and slowly beside the fastest."""
    wide = round(_REST / float(np.median(motion.steps)))
    if motion.cornered or noise == 0.0 or not 1 < wide < motion.time.size:
        return np.zeros(motion.time.size, dtype=bool)
    u, speed = motion.displacement, np.abs(motion.velocity)
    strayed = maximum_filter1d(u, wide) - minimum_filter1d(u, wide)
    fast = maximum_filter1d(speed, wide) > _SLOW * float(np.max(speed))
    return np.asarray(maximum_filter1d(((strayed <= _STRAYS * noise) & ~fast).astype(np.uint8), wide), dtype=bool)


def _still(motion: Motion, rests: np.ndarray) -> Motion:
    """Return a motion without what it moves in rests (n,), which the displacement loses from there on."""
    if not np.any(rests):
        return motion
    lost = cumulative_trapezoid(np.where(rests, motion.velocity, 0.0), motion.time, initial=0.0)
    velocity, acceleration = (np.where(rests, 0.0, values) for values in (motion.velocity, motion.acceleration))
    return replace(motion, displacement=motion.displacement - lost, velocity=velocity, acceleration=acceleration)


def _noisy(test: Experiment, predicted: np.ndarray, power: np.ndarray) -> Experiment:
    """Return a test with its noise; that of the motion makes power (n,) N^2 of the predicted force (n,) N."""
    time, force = test.motion.time, test.force
    if test.clipped is None:
        channel = min(white_noise(force, time), white_noise(force - predicted, time))
    else:  # there is no noise at the end of a range
        channel = difference_noise(force, ~test.clipped)
    channel = max(channel, least_noise(force))
    if not np.any(power):
        return replace(test, channel_noise=channel)
    wide = min(max(int(_EVENED / float(np.median(test.motion.steps))), 1), time.size)
    # as many times larger as the force is than the law's
    times = float(force @ force) / max(float(predicted @ predicted), 1e-300)
    power = min(max(times, 1.0 / _MOST_TIMES), _MOST_TIMES) * uniform_filter1d(power, wide, mode="nearest")
    all_of_it = power + channel**2
    weight = np.sqrt(np.mean(all_of_it) / all_of_it)
    return replace(test, channel_noise=channel, motion_noise=float(np.sqrt(np.mean(power))), weight=weight)
