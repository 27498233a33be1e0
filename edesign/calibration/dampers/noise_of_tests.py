"""Noise of tests: motions freed of it, and what it makes of the force, through a model too."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import uniform_filter1d

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.rests import at_rest, held
from edesign.calibration.signals.corners import cornered
from edesign.calibration.signals.interpolation import CUBIC, SMOOTH, Interpolation
from edesign.calibration.signals.noise import MOST_NOISE, least_noise, smooth, white_noise
from edesign.estimation.differences import difference_noise
from edesign.estimation.model import PredictionError

_OF_EQUAL_RIGHT = 0.25  # of the power of the difference of two curves
_AGAIN = 6  # times that noise is added
_EVENED = 0.1  # s, over which its effect is evened out
_MOST_TIMES = 4.0  # its power over that by a model


def smoothed_motion(
    time: np.ndarray, displacement: np.ndarray, force: np.ndarray, known: tuple[Motion, float] | None = None
) -> tuple[Motion, float]:
    """Return a motion freed of noise, and the standard deviation of this noise, m.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
        force: (n,) N: what both share is motion.
        known: a motion of the same test, whose curve between samples it has, and the noise; None: both are found.
    """
    of, noise = known or (None, None)
    found, velocity, acceleration, noise = smooth(time, displacement, beside=(force,), noise=noise)
    if of is None:
        between = Interpolation.of(time, found)
        # a motion that ends below the Nyquist frequency has no corners
        degree = CUBIC if between is None else between.degree
        corners = degree == CUBIC and cornered(time, displacement, noise)
    else:
        degree, corners = of.degree, of.cornered
    if degree != CUBIC:
        return Motion.along(time, found, degree), noise
    if not corners:
        return held(Motion(time, found, velocity, acceleration), displacement, noise), noise
    cubics = PchipInterpolator(time, displacement)
    velocity = cubics(time, 1)
    return Motion(time, displacement, velocity, np.gradient(velocity, time), cornered=True), noise


def with_noise(
    problem: DamperProblem, predicted: Sequence[np.ndarray], forces_of: Callable[[DamperProblem], Sequence[np.ndarray]]
) -> list[Experiment]:
    """Return tests with their noise.

    The force channel's is estimated above the motion, in what a model leaves of the force too, or in rests. Where a
    test has no such place, that of the others stands for it, and if none has one the least (`least_noise`). Noise of
    the displacement makes force through the model: such noise is added and taken off again, as noise of this size: it
    is not measured again where there is twice of it. That is most where the damper is slow and its force steep over the
    velocity. The same noise is added whatever the model. It is added to motions that are at rest where no more than
    noise is left of them: what smoothing leaves of the noise there hides that of a second time from a law of a low
    power of the velocity. What is not known of the motion between its samples makes the difference of two predictions,
    along two splines.

    Args:
        problem: with all tests, at full rate.
        predicted: (n_i,) N of every test, with nuisance amplitudes.
        forces_of: forces (n_i,) N of the model in all tests of such a problem.

    Raises:
        PredictionError: the model cannot predict the tests with noise.
    """
    random = np.random.default_rng(len(problem.experiments))
    power, plain = [np.zeros_like(force) for force in predicted], forces_of(problem)
    for _ in range(_AGAIN if any(one.displacement_noise for one in problem.experiments) else 0):
        again = []
        for one in problem.experiments:
            motion = one.motion
            if one.displacement_noise > 0.0:
                noisy = motion.displacement + one.displacement_noise * random.standard_normal(motion.time.size)
                noise = one.displacement_noise
                motion, _ = smoothed_motion(motion.time, noisy, one.force, (motion, noise))
                if problem.law.rate_dependent and not motion.cornered:
                    # of what wavelets take off the velocity all may have been motion; a law of a power of it sees it
                    whole = smooth(motion.time, noisy, rests=False, noise=noise)[1]
                    motion = replace(motion, velocity=np.where(at_rest(motion), motion.velocity, whole))
            again.append(replace(one, motion=motion))
        for own, force, moved in zip(power, plain, forces_of(problem.with_experiments(again)), strict=True):
            own += (moved - force) ** 2 / _AGAIN
    between = _between_samples(problem, forces_of)
    tests = with_channel_noise(problem.experiments, predicted)
    return [_noisy(*each) for each in zip(tests, predicted, power, between, strict=True)]


def with_channel_noise(tests: Sequence[Experiment], predicted: Sequence[np.ndarray]) -> list[Experiment]:
    """Return tests with the noise of their force channels.

    A test that shows less than any load cell has, as the band above its motion is cut by a filter, has that of the
    others.

    Args:
        tests: of a campaign, with one load cell.
        predicted: (n_i,) N of every test.
    """
    measured = [_channel_noise(*each) for each in zip(tests, predicted, strict=True)]
    least = [least_noise(one.force) for one in tests]
    found = [one for one in measured if not math.isnan(one)]
    known = [(one, one / own) for one, own in zip(measured, least, strict=True) if one > own]
    stand_in = _of_others(known)
    noise = [one if one > own else max(stand_in(own), own) for one, own in zip(measured, least, strict=True)]
    return [_with_channel(*each, bool(found)) for each in zip(tests, noise, strict=True)]


def _with_channel(test: Experiment, noise: float, measured: bool) -> Experiment:
    """Return a test with another noise of the force channel, N, beside what its motion makes of the force."""
    local = test.local_noise
    local = None if local is None else np.sqrt(local**2 - test.channel_noise**2 + noise**2)
    return replace(test, channel_noise=noise, noise_measured=measured, local_noise=local)


def _of_others(known: Sequence[tuple[float, float]]) -> Callable[[float], float]:
    """Return the noise of a test whose record shows none, N, of the size of its force.

    Noise of a load cell is of one size in all tests, that of an amplifier whose range is set for each test grows with
    the force. Of these two the other tests show the one by which their noise scatters less: that has the larger normal
    likelihood of its logarithm. Where one test shows it alone, it is the smaller one of both, which is surely there.

    Args:
        known: noise of each other test, N, and the same in units of the size of its force.
    """
    if not known:
        return lambda size: 0.0
    of_one_size, in_proportion = np.median(known, axis=0).tolist()
    if len(known) == 1:
        return lambda size: min(of_one_size, in_proportion * size)
    scatter = np.std(np.log(known), axis=0)
    return lambda size: of_one_size if scatter[0] <= scatter[1] else in_proportion * size


def _between_samples(
    problem: DamperProblem, forces_of: Callable[[DamperProblem], Sequence[np.ndarray]]
) -> list[np.ndarray]:
    """Return the mean square (n_i,) N^2 of what the model makes of what is not known between samples, of every test."""
    others = [_along_another(one.motion) for one in problem.experiments]
    found = [np.zeros_like(one.force) for one in problem.experiments]
    if any(share is not None for _, share in others):
        moved = [replace(one, motion=motion) for one, (motion, _) in zip(problem.experiments, others, strict=True)]
        with suppress(PredictionError):  # a spline that is wrong may ask for what no law can do
            both = (forces_of(one) for one in (problem, problem.with_experiments(moved)))
            for own, (_, share), here, there in zip(found, others, *both, strict=True):
                own += 0.0 if share is None else share * (there - here) ** 2
    return found


def _along_another(motion: Motion) -> tuple[Motion, np.ndarray | None]:
    """Return a motion along another curve through its samples, and the share (n,) of the power of what that changes.

    Of two curves of equal right each is off by half of their difference. The share is None where samples are enough.
    """
    time, u = motion.time, motion.displacement
    if motion.cornered:
        return Motion.along(time, u, CUBIC), np.full(u.size, _OF_EQUAL_RIGHT)
    between = Interpolation.of(time, u)
    if between is None or not between.matters:
        return motion, None
    return Motion.along(time, u, SMOOTH if between.degree == CUBIC else CUBIC), between.of_difference(u.size)


def _channel_noise(test: Experiment, predicted: np.ndarray) -> float:
    """Return the noise of the force channel, N, beside a predicted force (n,) N; nan: the motion leaves it no place."""
    time, force, beside = test.motion.time, test.force, (test.motion.displacement, predicted)
    if test.clipped is not None:  # there is no noise at the end of a range
        return difference_noise(force, ~test.clipped)
    both = [white_noise(values, time, beside) for values in (force, force - predicted)]
    most = MOST_NOISE * float(np.std(force))
    return min((one for one in both if one <= most), default=math.nan)


def _noisy(test: Experiment, predicted: np.ndarray, power: np.ndarray, between: np.ndarray) -> Experiment:
    """Return a test with what noise of its motion, and what is not known between its samples, make of the force.

    Args:
        test: with the noise of the force channel.
        predicted: (n,) N.
        power, between: (n,) N^2, mean squares of both in the predicted force.
    """
    if not (np.any(power) or np.any(between)):
        return replace(test, motion_noise=0.0, interpolation_noise=0.0, local_noise=None)
    wide = min(max(int(_EVENED / float(np.median(test.motion.steps))), 1), test.force.size)
    # as many times larger as the force is than the law's
    times = float(test.force @ test.force) / max(float(predicted @ predicted), 1e-300)
    times = min(max(times, 1.0 / _MOST_TIMES), _MOST_TIMES)
    power, between = (times * uniform_filter1d(one, wide, mode="nearest") for one in (power, between))
    local = np.sqrt(power + between + test.channel_noise**2)
    of_motion, of_interpolation = (float(np.sqrt(np.mean(one))) for one in (power, between))
    return replace(test, motion_noise=of_motion, interpolation_noise=of_interpolation, local_noise=local)
