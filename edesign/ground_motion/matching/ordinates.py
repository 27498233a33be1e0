"""Where a spectrum is matched, and how far a motion is from it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.ground_motion.matching.amplitudes import badness
from edesign.ground_motion.matching.peaks import Peaks

_COARSE = 0.03  # of log period: beyond it the spectrum has room for notches between matching periods
_SEAT = 0.05  # spacing of wavelets, in log period


@dataclass(frozen=True)
class Ordinates:
    """The ordinates to be matched: oscillators and the ground.

    Attributes:
        periods: of the oscillators, increasing, shape (n_p,), s.
        target: of the oscillators and, last, the ground (infinite if it is not matched), shape (n_p + 1,), m/s2.
        seats: indices of the oscillators that get wavelets.
        damping: ratio of critical.
    """

    periods: np.ndarray
    target: np.ndarray
    seats: np.ndarray
    damping: float

    @property
    def with_ground(self) -> bool:
        """True if the peak of the ground is matched."""
        return bool(np.isfinite(self.target[-1]))


def ordinates(
    periods: np.ndarray, target: Callable[[np.ndarray], np.ndarray], damping: float, zero_period: float | None
) -> Ordinates:
    """Return the matching periods and, if they are far apart, ordinates between them.

    Where the peak of an oscillator passes from one time to another with the period, the spectrum has a notch that is
    narrower than the usual spacing of periods.

    Args:
        periods: matching periods, increasing, shape (n,), s.
        target: ordinates wanted at periods, m/s2; asked at each period, not interpolated.
        damping: ratio of critical.
        zero_period: target of the ground, m/s2; None: not matched.
    """
    spacing = float(np.log(periods[-1] / periods[0])) / (periods.size - 1)
    parts = int(np.ceil(spacing / _COARSE - 1e-9))
    position = np.arange(parts * (periods.size - 1) + 1) / parts
    periods = np.exp(np.interp(position, np.arange(periods.size), np.log(periods)))
    seats = np.arange(0, periods.size, max(1, round(_SEAT * parts / spacing)))
    ground = np.inf if zero_period is None else zero_period
    return Ordinates(periods, np.append(target(periods), ground), seats, damping)


class State:
    """A motion and its misfit.

    Attributes:
        motion: acceleration, shape (n,), m/s2.
        peaks: of the oscillators under it.
        error: |peak|/target - 1 of each ordinate, shape (n_p + 1,).
        rms: root mean square of the errors.
        largest: largest absolute error.
        badness: mean of a higher power of the errors; what the iteration brings down.
    """

    def __init__(self, motion: np.ndarray, peaks: Peaks, ordinates: Ordinates) -> None:
        self.motion, self.peaks = motion, peaks
        self.error = np.abs(peaks.value[peaks.largest]) / ordinates.target - 1.0
        size = np.abs(self.error if ordinates.with_ground else self.error[:-1])
        self.rms = float(np.sqrt(np.mean(size**2)))
        self.largest = float(np.max(size))
        self.badness = badness(size)
