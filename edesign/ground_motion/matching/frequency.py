"""Matching by a factor on the Fourier spectrum, phase kept: the method of the thesis, with steps that converge."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy

from edesign.ground_motion.matching.closeness import Closeness, Closest
from edesign.ground_motion.matching.drift import DriftCorrection
from edesign.ground_motion.matching.fourier_factor import TRANSITION, FourierFactor
from edesign.ground_motion.matching.options import MatchOptions
from edesign.ground_motion.matching.result import Adjusted
from edesign.ground_motion.matching.sensitivity import Sensitivity
from edesign.ground_motion.response_spectrum import psa

_RATIO_STEPS = 3  # by the ratio itself, as in the thesis; after these it circles, and the sensitivity takes over
_RELAXATION = 0.8  # exponent of the ratio
_FIRST_DAMPING, _LEAST_DAMPING, _MOST_DAMPING = 0.1, 0.003, 1.0  # of the least-squares steps
_SMALL = 1e-3  # weight of the whole factor's size, so that the motion changes no more than it must
_EASED, _STIFFENED = 0.6, 2.0  # factor on that damping after a step that helped and one that did not
_LARGEST_LOG_RATIO = 0.3  # that one step tries to mend: beyond it, peaks move to other times
_PATIENCE = 8  # steps without a gain of one part in a hundred, after which it ends


def adjust(
    acceleration: np.ndarray,
    time_step: float,
    target: Callable[[np.ndarray], np.ndarray],
    periods: np.ndarray,
    options: MatchOptions,
    zero_period: float | None = None,
) -> Adjusted:
    """Multiply the Fourier spectrum by the ratio of target to response spectrum until they agree.

    The first steps are those of the thesis: the ratio over period becomes a factor over frequency, f = 1/T, with a
    relaxation, and a smooth passage to 1 at the ends of the band. As an ordinate is no matter of one frequency alone,
    such steps end by circling. Then the factor is found by damped least squares with the derivatives of the ordinates
    (Gauss-Newton steps after Levenberg and Marquardt), with a small weight on the whole factor. After each step what
    the factor added is tapered at the ends of the duration and loses its drift, within the iteration, so that the
    spectrum makes up for it. The closest motion of all steps is returned, the given one if none came closer.

    Arguments and result are those of `edesign.ground_motion.matching.result.Adjust`. If `zero_period` is given, the
    peak ground acceleration counts as one more ordinate, and frequencies up to an octave above the band may change.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        target: gives the target, m/s2, at periods, s.
        periods: (n_p,) s, at which the spectrum is matched.
        zero_period: target of the peak ground acceleration, m/s2; None: it is not matched.

    Source: thesis, section 5.3.3 and Fig. 5.6; Rizzo, Shaw and Jarecki (1975), Nuclear Engineering and Design 32, for
    the ratio; Marquardt (1963), Journal of SIAM 11, for the damping.
    """
    given = np.asarray(acceleration, dtype=float)
    wanted = np.concatenate(([zero_period or 1.0], target(periods)))
    weight = np.ones(wanted.size)
    weight[0] = 0.0 if zero_period is None else 1.0
    factor = _factor(given.size, time_step, periods, beyond=zero_period is not None)
    sensitivity = Sensitivity(factor, time_step, periods, options.damping)
    without_drift = DriftCorrection(given.size, time_step, float(periods[-1]))
    taper = _taper(given.size, time_step, float(periods[-1]))

    def log_ratio(motion: np.ndarray) -> tuple[np.ndarray, float]:
        peak = np.max(np.abs(motion))
        ratio = np.append(peak, psa(motion, time_step, periods, options.damping)) / wanted
        return -np.log(ratio), float(np.sqrt(np.average((ratio - 1.0) ** 2, weights=weight)))

    motion, whole = given, np.zeros(factor.nodes.size)
    closest = Closest(given, Closeness(target, periods, time_step, options.damping, zero_period))
    missing, error = log_ratio(given)
    history, damping = [error], _FIRST_DAMPING
    while len(history) <= options.iterations and min(history) > options.tolerance and not _stalled(history):
        if len(history) <= _RATIO_STEPS:
            theta = _ratio_step(factor, periods, missing, peak=weight[0] > 0.0)
        else:
            theta = _least_squares_step(sensitivity.matrix(motion), missing, weight, damping, whole)
        whole = whole + theta
        change = taper * factor.added(motion, theta)
        motion = given + without_drift(motion + change - given, given)
        missing, error = log_ratio(motion)
        if len(history) > _RATIO_STEPS:
            damping = max(_LEAST_DAMPING, _EASED * damping) if error < history[-1] else _STIFFENED * damping
            damping = min(damping, _MOST_DAMPING)
        closest.try_(motion)
        history.append(error)
    return Adjusted(closest.motion, len(history) - 1, tuple(history))


def _factor(samples: int, time_step: float, periods: np.ndarray, beyond: bool) -> FourierFactor:
    """The factor's band is that of the periods, a transition at each end, and an octave above for the ground's peak."""
    spacing = min(float(np.log(periods[-1] / periods[0])) / (periods.size - 1), 0.5 * TRANSITION)
    lowest = np.exp(-TRANSITION) / periods[-1]
    highest = max(2.0 if beyond else 0.0, np.exp(TRANSITION)) / periods[0]
    return FourierFactor(samples, time_step, float(lowest), float(highest), spacing)


def _taper(samples: int, time_step: float, longest: float) -> np.ndarray:
    """Half cosines over a quarter of the longest period at the start, half of it at the end; a fifth each at most."""
    window = np.ones(samples)
    for length, end in ((0.25 * longest, slice(None)), (0.5 * longest, slice(None, None, -1))):
        count = min(round(length / time_step), samples // 5)
        rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(count) + 0.5) / max(count, 1))
        window[end][:count] = rise
    return window


def _ratio_step(factor: FourierFactor, periods: np.ndarray, missing: np.ndarray, peak: bool) -> np.ndarray:
    """The log ratio over period, carried to the nodes; above the band it goes from the first period's to the peak's."""
    at, value = 1.0 / periods[::-1], missing[1:][::-1]
    if peak and factor.nodes[-2] > at[-1]:
        at, value = np.append(at, factor.nodes[-2]), np.append(value, missing[0])
    at = np.concatenate((factor.nodes[:1], at, factor.nodes[-1:]))
    value = np.concatenate(([0.0], value, [0.0]))
    rising = np.concatenate((np.diff(at) > 0.0, [True]))  # the band may reach the Nyquist frequency
    theta = _RELAXATION * np.interp(np.log(factor.nodes), np.log(at[rising]), value[rising])
    theta[[0, -1]] = 0.0
    return theta


def _least_squares_step(
    matrix: np.ndarray, missing: np.ndarray, weight: np.ndarray, damping: float, whole: np.ndarray
) -> np.ndarray:
    """Theta that mends most of what is missing while it and the whole factor stay small; none at the end nodes."""
    inner = weight[:, None] * matrix[:, 1:-1]
    goal = weight * np.clip(missing, -_LARGEST_LOG_RATIO, _LARGEST_LOG_RATIO)
    # |inner theta - goal|^2 + damping |theta|^2 + small |whole + theta|^2, with the last two squares made one
    back = _SMALL / (damping + _SMALL) * whole[1:-1]
    # by iteration: a direct solution of this size would wake the threads of the linear algebra library, for nothing
    moved = scipy.sparse.linalg.lsmr(
        inner, goal + inner @ back, damp=np.sqrt(damping + _SMALL), atol=1e-8, btol=1e-8, maxiter=500
    )[0]
    return np.concatenate(([0.0], moved - back, [0.0]))


def _stalled(history: list[float]) -> bool:
    return len(history) > _PATIENCE and min(history[-_PATIENCE:]) > 0.99 * min(history[:-_PATIENCE])
