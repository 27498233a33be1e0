"""How close a motion is to its target, between the matching periods too."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.ground_motion.response_spectrum import psa

SPREAD = 4.0
"""Largest misfit over the rms that is asked for."""
_FEWEST, _PER_POINT = 300, 3  # periods on which a motion is judged: at least so many, and so many a matching period


def judging_periods(periods: np.ndarray) -> np.ndarray:
    """Return periods between and beside the matching ones, increasing, shape (n,), s.

    Args:
        periods: matching periods, increasing, s.
    """
    return np.geomspace(periods[0], periods[-1], max(_FEWEST, _PER_POINT * periods.size))


class Closeness:
    """One number for the misfit of motions: the rms, or a quarter of the largest if that is more."""

    def __init__(
        self,
        target: Callable[[np.ndarray], np.ndarray],
        periods: np.ndarray,
        time_step: float,
        damping: float,
        zero_period: float | None,
    ) -> None:
        """Prepare.

        Args:
            target: ordinates wanted at periods (s), m/s2; asked at each period, so that a jagged one is not smoothed.
            periods: matching periods, increasing, s.
            time_step: of the motions, s.
            damping: ratio of critical.
            zero_period: the target's ordinate at period zero, m/s2; None: not matched.
        """
        self._periods, self._time_step, self._damping = judging_periods(periods), time_step, damping
        self._target, self._zero_period = np.asarray(target(self._periods), dtype=float), zero_period

    def __call__(self, motion: np.ndarray) -> float:
        """Return the misfit of a motion, shape (n,), m/s2."""
        ratio = psa(motion, self._time_step, self._periods, self._damping) / self._target
        if self._zero_period is not None:
            ratio = np.append(ratio, np.max(np.abs(motion)) / self._zero_period)
        error = np.abs(ratio - 1.0)
        return max(float(np.sqrt(np.mean(error**2))), float(np.max(error)) / SPREAD)


class Closest:
    """The closest of motions that are tried one after another.

    Attributes:
        motion: the closest so far, m/s2.
        misfit: of it.
    """

    def __init__(self, given: np.ndarray, closeness: Closeness) -> None:
        self._closeness = closeness
        self.motion, self.misfit = given, closeness(given)

    def try_(self, motion: np.ndarray) -> None:
        """Take a motion if it is closer than those before.

        Args:
            motion: (n,) m/s2.
        """
        misfit = self._closeness(motion)
        if misfit < self.misfit:
            self.motion, self.misfit = motion, misfit
