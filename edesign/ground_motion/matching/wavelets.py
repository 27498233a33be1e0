"""Matching in the time domain: wavelets added where the oscillators have their peaks."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.ground_motion.matching.closeness import SPREAD, Closeness, Closest
from edesign.ground_motion.matching.drift import DriftCorrection
from edesign.ground_motion.matching.options import MatchOptions
from edesign.ground_motion.matching.ordinates import Ordinates, State, ordinates
from edesign.ground_motion.matching.peaks import PeakFinder
from edesign.ground_motion.matching.result import Adjusted
from edesign.ground_motion.matching.wavelet_step import Step

_WAYS = (1.5, 0.8, 0.4)  # damping of the first step of up to three ways from the scaled motion
_SETTLED = 1.45  # times the tolerance: no other way is tried


def adjust(
    acceleration: np.ndarray,
    time_step: float,
    target: Callable[[np.ndarray], np.ndarray],
    periods: np.ndarray,
    options: MatchOptions,
    zero_period: float | None = None,
) -> Adjusted:
    """Add wavelets until the response spectrum is the target.

    In each iteration the peaks of the oscillators are found, wavelets of each period are set where they bring about
    those peaks, the response of every oscillator at its peaks to every wavelet is a matrix in closed form, and damped
    least squares give the smallest amplitudes that bring the largest peaks to their targets and no other above. If that
    ends in a local minimum, it is tried again from the start with another first step. The closest motion of all steps
    is returned, the given one if none came closer.

    Arguments and result are those of `edesign.ground_motion.matching.result.Adjust`.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        target: gives the target, m/s2, at periods, s.
        periods: (n_p,) s, at which the spectrum is matched.
        zero_period: target of the peak ground acceleration, m/s2; None: it is not matched.

    Source: Lilhanand & Tseng (1988), 9WCEE; Hancock et al. (2006), Journal of Earthquake Engineering 10; Al Atik &
    Abrahamson (2010), Earthquake Spectra 26(3), 601-617; Marquardt (1963), Journal of SIAM 11, for the damping.
    """
    given = np.asarray(acceleration, dtype=float)
    goal = ordinates(periods, target, options.damping, zero_period)
    correction, nothing = DriftCorrection(given.size, time_step, float(periods[-1])), np.zeros(given.size)
    find = PeakFinder(time_step, goal.periods, options.damping)
    closeness = Closeness(target, periods, time_step, options.damping, zero_period)

    def state_of(motion: np.ndarray) -> State:
        at_rest = motion + correction(nothing, motion)
        return State(at_rest, find(at_rest), goal)

    start = state_of(given)
    closest = Closest(given, closeness)
    closest.try_(start.motion)
    history = [start.rms]
    for damping in _WAYS:
        way = _Way(start, goal, time_step, damping)
        while len(history) <= options.iterations and not way.over and not _within(way.state, options.tolerance):
            before = way.state
            history.append(way.go(state_of))
            if way.state is not before:
                closest.try_(way.state.motion)
        if way.state is start or closest.misfit <= _SETTLED * options.tolerance:
            break
    return Adjusted(closest.motion, len(history) - 1, tuple(history))


def _within(state: State, tolerance: float) -> bool:
    """Say whether the rms is within the tolerance and no ordinate stays far behind."""
    return state.rms <= tolerance and state.largest <= SPREAD * tolerance


class _Way:
    """A sequence of steps, each from the best state so far."""

    WAVELETS = ((1.3, (1.0, 2.0)), (1.0, (0.7, 1.6)), (1.7, (1.0, 2.0)), (1.0, (1.0, 3.0)))
    """Factor on the widths, and lags, of the wavelets; the next when the last ones are of no more use."""
    LEAST_DAMPING = 0.1
    EASED, STIFFENED = 0.5, 3.0  # factor on the damping after a step that helped and one that did harm
    LOOSENED, LOOSEST = 0.3, 0.01  # after a step that did little: the linear model holds, but the damping is in the way
    LITTLE, HARM = 0.03, 0.1  # gain below which a step is idle; loss above which the step was too long
    PATIENCE, CREDIT = 4, 2  # idle steps after which the way is over; how many a good step makes up for

    def __init__(self, start: State, goal: Ordinates, time_step: float, damping: float) -> None:
        self.state = start
        self._goal, self._time_step, self._damping = goal, time_step, damping
        self._step: Step | None = None
        self._idle = self._variant = 0

    @property
    def over(self) -> bool:
        """True if the last steps were of no use."""
        return self._idle >= self.PATIENCE

    def go(self, state_of: Callable[[np.ndarray], State]) -> float:
        """Try one step and keep it if it helps; the rms of the trial."""
        wavelets = self.WAVELETS[self._variant % len(self.WAVELETS)]
        step = self._step or Step.at(self.state, self._goal, *wavelets, self._time_step)
        tried = step.amplitudes(self._damping)
        trial = state_of(self.state.motion + step.wavelets.motion(tried, self.state.motion.size, self._time_step))
        gain = 1.0 - trial.badness / self.state.badness
        if gain > 0.0:
            self.state, self._step = trial, None
            self._damping = max(self.LEAST_DAMPING, self.EASED * self._damping)
        if gain > self.LITTLE:
            self._idle = max(self._idle - self.CREDIT, 0)
            return trial.rms
        self._idle += 1
        if gain > -self.HARM or self._idle % 2 == 0:
            self._variant, self._step = self._variant + 1, None
            self._damping = max(self.LOOSEST, self.LOOSENED * self._damping)
        else:
            self._step = step.taught_by(trial, tried)
            self._damping *= self.STIFFENED
        return trial.rms
