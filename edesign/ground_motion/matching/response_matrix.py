"""The wavelets of one iteration, and what they do to the peaks of the oscillators."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.ground_motion.matching.peaks import Peaks
from edesign.ground_motion.matching.wavelet import REACH, oscillator_response, wavelet, wavelet_pair

_ROOM = 3.0  # widths that a wavelet needs on either side of its centre
_LEAST_WIDTH = 0.5  # of the period: near an end wavelets get shorter rather than cut
_LONG = 4.0  # s: longer wavelets are used sparingly, as they move the ground far
_SLOW, _FAST = 6.0, 0.15  # of the oscillator's period: outside, its response is that to a steady wave
_GROUND = 1e-6  # s: an oscillator so stiff is the ground
_FORGOTTEN = 8.0  # free vibration below exp(-8) is left out


@dataclass(frozen=True)
class Wavelets:
    """A set of wavelet pairs (even and odd), scaled so that amplitude 1 means about the target as response.

    Attributes:
        period: shape (m,), s.
        width: shape (m,), s.
        centre: s from the first sample, shape (m,).
        size: m/s2, shape (m,).
    """

    period: np.ndarray
    width: np.ndarray
    centre: np.ndarray
    size: np.ndarray

    def motion(self, amplitudes: np.ndarray, samples: int, time_step: float) -> np.ndarray:
        """Return the sum of the wavelets.

        Args:
            amplitudes: of the even, then of the odd ones, shape (2 m,).
            time_step: s.

        Returns:
            shape (samples,), m/s2.
        """
        even, odd = amplitudes.reshape(2, -1) * self.size
        total = np.zeros(samples)
        first = np.maximum(0, np.ceil((self.centre - REACH * self.width) / time_step)).astype(int)
        last = np.minimum(samples, np.floor((self.centre + REACH * self.width) / time_step).astype(int) + 1)
        for j in np.flatnonzero((even != 0.0) | (odd != 0.0)):
            time = np.arange(first[j], last[j]) * time_step - self.centre[j]
            total[first[j] : last[j]] += wavelet(time, self.period[j], self.width[j], even[j], odd[j])
        return total


def wavelets_for(
    peak_time: np.ndarray,
    periods: np.ndarray,
    target: np.ndarray,
    damping: float,
    end: float,
    width_factor: float,
    lags: tuple[float, ...],
) -> Wavelets:
    """Set wavelet pairs for each period, one for each lag: so that they act on its oscillator's peak.

    Two bursts one after the other separate neighbouring periods better than one: where the peaks of neighbours fall
    at one time, one may have to be raised and the next lowered. Near the ends of the motion wavelets get shorter.

    Args:
        peak_time: when the oscillators have their peaks, shape (n_w,), s.
        periods: of oscillators and wavelets, shape (n_w,), s.
        target: of the oscillators, shape (n_w,), m/s2.
        damping: ratio of critical.
        end: duration of the motion, s.
        width_factor: on the widths of the source.
        lags: of the peak behind the wavelets' centres, in widths.

    Source: Al Atik & Abrahamson (2010), Earthquake Spectra 26(3), 601-617, for the width 1.178 f^-0.93.
    """
    lag = np.repeat(lags, periods.size)
    time, period, goal = (np.tile(array, len(lags)) for array in (peak_time, periods, target))
    width = width_factor * 1.178 * period**0.93
    centre = time - lag * width
    width = np.clip(np.minimum(centre, end - centre) / _ROOM, np.minimum(_LEAST_WIDTH * period, width), width)
    room = np.minimum(_ROOM * width, 0.5 * end)
    centre = np.clip(time - lag * width, room, end - room)
    even, odd = oscillator_response(period, damping, np.maximum(time - centre, 0.5 * width), period, width)
    return Wavelets(period, width, centre, goal / np.hypot(even, odd) / (1.0 + (period / _LONG) ** 2))


def response_matrix(peaks: Peaks, wavelets: Wavelets, periods: np.ndarray, damping: float) -> np.ndarray:
    """Return the response at the time of each peak to each wavelet of amplitude 1, shape (n_peaks, 2 m), m/s2.

    Args:
        peaks: of the oscillators; the last ordinate is the ground.
        wavelets: m pairs.
        periods: of the oscillators, shape (n_p,), s.
        damping: ratio of critical.

    Source: Lilhanand & Tseng (1988), 9WCEE, for the matrix; the closed form is in `wavelet`.
    """
    oscillator = np.append(periods, _GROUND)[peaks.ordinate][:, None]
    time = peaks.time[:, None] - wavelets.centre
    inside = np.abs(time) < REACH * wavelets.width
    ratio = wavelets.period / oscillator
    steady = (ratio > _SLOW) | (ratio < _FAST)
    natural = 2.0 * np.pi / oscillator
    apart = 0.5 * wavelets.width * (2.0 * np.pi / wavelets.period - natural)
    free = (time > 0.0) & (apart**2 + damping * natural * time < _FORGOTTEN)
    parts = np.zeros((2, *time.shape))
    row, column = np.nonzero((inside | free) & ~steady)
    parts[:, row, column] = oscillator_response(
        oscillator[row, 0], damping, time[row, column], wavelets.period[column], wavelets.width[column]
    )
    row, column = np.nonzero(inside & steady)
    pair = wavelet_pair(time[row, column], wavelets.period[column], wavelets.width[column])
    parts[:, row, column] = np.array(pair) / (1.0 - ratio[row, column] ** -2.0)
    return np.hstack(parts * wavelets.size)
