"""Level of the noise in the spectrum of a channel: the first flat part above the motion."""

from __future__ import annotations

import numpy as np
from scipy.ndimage import median_filter

from edesign.calibrate.residual.sampling import rounding

MOTION = 20.0
"""Hz: motions of dampers and their loops live below."""

_BETA = 24.0  # of the window: leakage below 1e-8 of the amplitude
_LONGEST, _SHORTEST, _SEGMENTS = 256, 32, 24  # samples of a segment; their number, if the history is long enough
_BANDS = 16  # to the Nyquist frequency
_WIDTH = 4  # bands of a plateau at least
_FLAT = 1.5  # largest over smallest level of a plateau
_TONE = 3.0  # times the level about it
_MOTION_SHARE = 0.15  # of the Nyquist frequency, that the motion takes at most if the sampling is slow
_CORNER, _GAIN = 3.5, np.sqrt(70.0)  # standard deviations of a fourth difference; that of unit white noise
_LAST = 0.9  # of the Nyquist frequency: filters of a logger fall beyond it


def noise_power(values: np.ndarray, dt: float) -> float | None:
    """Mean square of the broadband noise in an evenly sampled channel.

    Args:
        values: (n,), n of at least 32.
        dt: s.

    Returns:
        The level of the plateau times the band up to its end, and what is measured beyond it; None if there are no
        segments without corners in which anything changes.
    """
    segments = _segments(values)
    if segments.size == 0:
        return None
    power = _spectra(segments)
    at = np.arange(power.shape[1]) / (power.shape[1] - 1.0)  # of the Nyquist frequency
    typical = np.median(power, axis=0)
    width = max(power.shape[1] // 6, 3)
    tone = typical > _TONE * median_filter(typical, size=width, mode="nearest")
    start = min(MOTION * 2.0 * dt, _MOTION_SHARE)
    band = np.minimum((at * _BANDS).astype(int), _BANDS - 1)
    levels = np.full(_BANDS, np.nan)
    for j in range(_BANDS):
        inside = (band == j) & (at < 1.0)
        inside = inside & ~tone if np.any(inside & ~tone) and j >= int(start * _BANDS) else inside
        if np.any(inside):
            levels[j] = np.median(power[:, inside]) / np.log(2.0)  # the median of an exponential distribution
    known = np.flatnonzero(~np.isnan(levels))
    levels = np.interp(np.arange(_BANDS), known, levels[known])
    scatter = 1.0 + 3.0 * 1.44 / np.sqrt(max(power.size / _BANDS / 12.0, 1.0))
    first, last = _plateau(levels, int(np.ceil(start * _BANDS)), _FLAT * scatter)
    chosen = (band >= first) & (band <= last) & (at < 1.0) & ~tone
    level = float(np.median(power[:, chosen])) / np.log(2.0) if np.any(chosen) else float(levels[first])
    below = (last + 1.0) / _BANDS
    return level * below + float(np.sum(np.minimum(levels[last + 1 :], level))) / _BANDS


def _plateau(levels: np.ndarray, start: int, flat: float) -> tuple[int, int]:
    """First and last band of the lowest-frequency run of flat levels, that with nothing flat is the upper half."""
    end = int(_LAST * _BANDS)
    for first in range(start, end - _WIDTH + 1):
        last = first + _WIDTH - 1
        if np.max(levels[first : last + 1]) > flat * np.min(levels[first : last + 1]):
            continue
        while last + 1 < _BANDS and np.max(levels[first : last + 2]) <= flat * np.min(levels[first : last + 2]):
            last += 1
        return first, last if last < end - 1 else _BANDS - 1
    return _BANDS // 2, _BANDS - 1


def _segments(values: np.ndarray) -> np.ndarray:
    """Overlapping segments (m, length) of second differences, the longest of which there are enough without corners.

    Corners and jumps (friction at a reversal, a ramp that ends) have no plateau but reach all frequencies. They show
    as few large fourth differences. Segments in which nothing changes at all, as of a digitiser at rest, are left out.
    """
    differences = np.diff(values, 2)
    fourth = np.abs(np.diff(differences, 2))
    least = max(_GAIN * rounding(values), 1e-12 * float(np.ptp(values)))
    large = fourth > _CORNER * max(float(np.median(fourth)) / 0.67449, least)
    corner = np.convolve(large, np.ones(3))[: differences.size] > 0.0
    length = _LONGEST
    while True:
        step = max(length // 4, 1)
        found = np.lib.stride_tricks.sliding_window_view(differences, min(length, differences.size))[::step]
        corners = np.lib.stride_tricks.sliding_window_view(corner, min(length, differences.size))[::step]
        kept = found[np.any(found != 0.0, axis=1) & ~np.any(corners, axis=1)]
        if len(kept) >= _SEGMENTS or length <= _SHORTEST:
            return np.asarray(kept, dtype=float)
        length //= 2


def _spectra(segments: np.ndarray) -> np.ndarray:
    """Spectra (m, bins) of the channel itself, scaled so that white noise of unit variance has a mean of one.

    Second differences take trends away and lower the motion, so that less of it leaks; their gain is known.
    """
    length = segments.shape[1]
    window = np.kaiser(length, _BETA)
    power = np.abs(np.fft.rfft(segments * window, axis=1)) ** 2 / np.sum(window**2)
    gain = (2.0 * np.sin(np.pi * np.arange(power.shape[1]) / length)) ** 4
    gain[0] = gain[1]
    return np.asarray(power / gain, dtype=float)
