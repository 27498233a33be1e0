"""Peaks in the responses of many oscillators, with their times."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.core.spectrum import recursion_peaks
from edesign.ground_motion.band_limited import polygon_samples, upsampled
from edesign.ground_motion.oscillators import upsampling_factors

_SHARE = 0.75  # of an ordinate's largest response, from which on its other peaks are kept
_MOST = 8  # peaks of one ordinate: short periods have many of nearly the same size


@dataclass(frozen=True)
class Peaks:
    """Local peaks of response, those of one ordinate together, the largest of each first.

    Attributes:
        ordinate: index of the oscillator, ascending, shape (m,); one more than the last is the ground itself.
        time: s from the first sample, shape (m,).
        value: signed pseudo acceleration, m/s2, shape (m,); acceleration for the ground.
        largest: whether the peak is the first of its ordinate, shape (m,).
    """

    ordinate: np.ndarray
    time: np.ndarray
    value: np.ndarray
    largest: np.ndarray

    def where(self, kept: np.ndarray) -> Peaks:
        """Return the peaks chosen by a mask.

        Args:
            kept: (m,) bool.
        """
        return Peaks(self.ordinate[kept], self.time[kept], self.value[kept], self.largest[kept])


class PeakFinder:
    """Finds the peaks of oscillators under motions of one time step; the motion is read as `psa` reads it."""

    def __init__(self, time_step: float, periods: np.ndarray, damping: float) -> None:
        """Prepare.

        Args:
            time_step: s.
            periods: of the oscillators, greater than zero, shape (n_p,), s.
            damping: ratio of critical.
        """
        self._time_step, self._count = time_step, periods.size
        self._after = int(np.ceil(np.max(periods) / time_step))  # a peak may come after the motion's end
        factors = upsampling_factors(time_step, periods)
        self._groups = []
        for factor in np.unique(factors).tolist():
            at = np.flatnonzero(factors == factor)
            filters = [recursion(period / (time_step / factor), damping) for period in periods[at]]
            numerator, denominator = (np.array(part) for part in zip(*filters, strict=True))
            self._groups.append((at, factor, numerator, denominator[:, 1:]))

    def __call__(self, acceleration: np.ndarray) -> Peaks:
        """Return the peaks under a motion, shape (n,), m/s2."""
        motions = upsampled(acceleration, [factor for _, factor, _, _ in self._groups])
        found = []
        for motion, (at, factor, numerator, denominator) in zip(motions, self._groups, strict=True):
            corners = np.concatenate((polygon_samples(motion), np.zeros(self._after * factor)))
            which, place, value = recursion_peaks(corners, numerator, denominator, _SHARE, _MOST)
            found.append((at[which], place * (self._time_step / factor), value))
        place, value = _ground_peaks(acceleration)
        found.append((np.full(value.size, self._count), place * self._time_step, value))
        ordinate, time, value = (np.concatenate(part) for part in zip(*found, strict=True))
        order = np.argsort(ordinate, kind="stable")
        ordinate, time, value = ordinate[order], time[order], value[order]
        return Peaks(ordinate, time, value, np.diff(ordinate, prepend=-1) > 0)


def recursion(period: float, damping: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the filter from acceleration, linear between samples, to pseudo acceleration: numerator and denominator.

    Args:
        period: in time steps.
        damping: ratio of critical.

    Source: Nigam & Jennings (1969), Bulletin of the Seismological Society of America 59(2); the velocity is
    eliminated.
    """
    h = 2.0 * np.pi / period
    damped = h * np.sqrt(1.0 - damping**2)
    decay, cosine, sine = np.exp(-damping * h), np.cos(damped), np.sin(damped) / damped
    denominator = np.array([1.0, -2.0 * decay * cosine, decay**2])
    ramp, turn = 2.0 * damping / h, (2.0 * damping**2 - 1.0) * sine
    first = 1.0 - ramp + decay * (ramp * cosine + turn)
    last = decay**2 * (1.0 + ramp) + decay * (turn - ramp * cosine)  # the first with time, so the damping, reversed
    return np.array([first, np.sum(denominator) - first - last, last]), denominator  # a lasting one gives itself


def _ground_peaks(acceleration: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place (in samples) and value of the maxima of |acceleration| at samples, the largest first."""
    size = np.abs(acceleration)
    at = np.flatnonzero(size[1:-1] >= _SHARE * np.max(size)) + 1
    at = at[(size[at] >= size[at - 1]) & (size[at] > size[at + 1])]
    at = at[np.argsort(-size[at], kind="stable")][:_MOST]
    return at, acceleration[at]
