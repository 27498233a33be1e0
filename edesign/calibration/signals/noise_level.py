"""Level of the noise in the spectrum of a channel: the first flat part above the motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.ndimage import median_filter, uniform_filter1d
from scipy.special import gammainccinv, hyp2f1

from edesign.calibration.signals.sampling import rounding
from edesign.estimation.differences import difference_gain, robust_deviation
from edesign.estimation.left_out import PRIOR_FREEDOM

MOTION = 20.0
"""Hz: motions of dampers and their loops live below."""

_BETA = 24.0  # of the window: leakage below 1e-8 of the amplitude
_LONGEST, _SHORTEST, _SEGMENTS = 256, 32, 24  # samples of a segment; their number, if the history is long enough
_EVENED = 5  # bins over which a spectrum is evened
_OCTAVE = math.sqrt(2.0)  # last over first frequency of a plateau at least
_FLAT = 1.5  # largest over smallest level of a plateau
_FEWEST = 8  # bins without tones
_PHI = np.linspace(0.0, 0.9, 46)  # correlations from sample to sample
_HIGH = 0.12  # of the Nyquist frequency, above which a motion has no share in what a correlation is estimated from
_ALIKE = 0.2  # mean difference of logarithms of spectra that are the same
_TONE = 3.0  # times the level about it
_MOTION_SHARE = 0.4  # of the Nyquist frequency, that the motion takes at most if the sampling is slow
_CORNER = 3.5  # standard deviations of a fourth difference
_LAST = 0.9  # of the Nyquist frequency: filters of a logger fall beyond it
_LOCKED_OVER = 9  # bins over which it is averaged how far phases of two channels keep together
_CHANCE = 0.01  # that those of independent channels do so at any frequency


class Level(NamedTuple):
    """Noise of a channel.

    Attributes:
        power: its mean square; nan: the motion leaves no part of the spectrum to it.
        density: mean square of white noise that is as strong next to the motion.
    """

    power: float
    density: float


NOT_MEASURED = Level(math.nan, math.nan)


def noise_level(values: np.ndarray, dt: float, beside: Sequence[np.ndarray] = ()) -> Level | None:
    """Return the broadband noise in an evenly sampled channel.

    Two channels of one test share its motion, and not their noise. So the motion reaches up to the highest frequency at
    which their phases keep together, and noise is what stands above it.

    Args:
        values: (n,), n of at least 32.
        dt: s.
        beside: (n,) of each other channel with the same motion; (): the motion is taken to end at `MOTION`.

    Returns:
        The level of the plateau up to its end, and what is measured beyond it; where the noise falls from there as
        noise with a correlation from sample to sample does, the level of that. None if there are no segments without
        corners in which anything changes.

    Source: Bendat & Piersol, Random Data, 6.1 (coherence); Mardia & Jupp, Directional Statistics, 6.3 (Rayleigh test).
    """
    segments, at_rows = _segments(values)
    if segments.size == 0:
        return None
    own = transforms(segments)
    spectra = np.abs(own) ** 2
    free = np.ones(spectra.shape[1], dtype=bool)
    for one in beside:
        free &= ~_locked(own, transforms(_windows(np.diff(one, 2), *at_rows)))
    at = np.arange(spectra.shape[1]) / (spectra.shape[1] - 1.0)  # of the Nyquist frequency
    typical = np.median(spectra, axis=0) / np.log(2.0)  # the median of an exponential distribution
    moved = _end_of_motion(free, typical)
    if moved is None:
        return NOT_MEASURED
    tone = typical > _TONE * median_filter(typical, size=max(at.size // 6, 3), mode="nearest")
    tone[[0, -1]] = True  # of a spectrum that ends there
    if np.count_nonzero(~tone) < _FEWEST:
        tone[1:-1] = False
    power = np.exp(np.interp(at, at[~tone], np.log(np.maximum(typical[~tone], 1e-300))))
    even = np.exp(uniform_filter1d(np.log(power), _EVENED, mode="nearest"))
    flat = _FLAT * (1.0 + 3.0 * 1.44 / np.sqrt(max(_EVENED * len(spectra) / 4.0, 1.0)))
    start = float(at[moved]) if moved else min(MOTION * 2.0 * dt, _MOTION_SHARE)
    first, last = _plateau(even, at, start, flat)
    level = float(np.median(spectra[:, first : last + 1][:, ~tone[first : last + 1]])) / np.log(2.0)
    if not math.isfinite(level):
        level = float(even[first])
    beyond = np.minimum(power[last:], level) if at[last] < _LAST else np.array([level])
    found = Level(level * at[last] + float(np.mean(beyond)) * (1.0 - at[last]), level)
    high = max(first, int(_HIGH * at.size))
    coloured = _coloured(power[high:-1], at[high:-1]) if at[last] < _LAST else None
    return coloured or found


def _plateau(even: np.ndarray, at: np.ndarray, start: float, flat: float) -> tuple[int, int]:
    """Return the first and last bin of the first flat part of an evened spectrum, half an octave wide at least.

    With nothing flat it is the upper half, or what stands above the start if that is less.
    """
    for first in range(int(np.searchsorted(at, start)), at.size):
        last = max(int(np.searchsorted(at, _OCTAVE * at[first])), first + _EVENED)
        if last >= at.size:
            break
        low, high = float(np.min(even[first : last + 1])), float(np.max(even[first : last + 1]))
        if high > flat * low:
            continue
        while last + 1 < at.size and max(high, even[last + 1]) <= flat * min(low, even[last + 1]):
            last += 1
            low, high = min(low, float(even[last])), max(high, float(even[last]))
        return first, last
    return max(at.size // 2, int(np.searchsorted(at, start))), at.size - 1


def _locked(own: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the bins (bins,) at which transforms (m, bins) of two channels keep their phases together."""
    both = (own * np.conj(other))[:, :-_EVENED]  # beside the Nyquist frequency transforms are real, and alike by chance
    together = len(both) * np.abs(np.mean(both / np.maximum(np.abs(both), 1e-300), axis=0)) ** 2
    least = max(_locked_by_chance(own.shape[1]), 1.0 + _shared() * len(both))
    found = uniform_filter1d(together, _LOCKED_OVER, mode="nearest") > least
    return np.append(found, np.full(_EVENED, found[-1]))


@lru_cache(maxsize=8)
def _locked_by_chance(bins: int) -> float:
    """Return how far phases of independent channels keep together at one of all bins, by chance of one in a hundred.

    The squared sum of n random directions over n is distributed as 1/2 chi-square of two degrees of freedom. Those of
    segments that overlap, and of bins beside each other, are correlated as the window makes them. Their mean over bins
    is a gamma variable with its own mean and variance; of all bins, Bonferroni's bound.
    """
    length = 2 * (bins - 1)
    window = np.kaiser(length, _BETA)
    power, every = float(window @ window), length // 4
    of_segments = [float(window[every * s :] @ window[: length - every * s]) / power for s in (1, 2, 3)]
    of_bins = (np.abs(np.fft.fft(window**2)[1:_LOCKED_OVER]) / power) ** 4
    mean = 1.0 + 2.0 * sum(one**2 for one in of_segments)
    apart = 1.0 - np.arange(1, _LOCKED_OVER) / _LOCKED_OVER
    shape = _LOCKED_OVER / (1.0 + 2.0 * float(apart @ of_bins))
    return mean * float(gammainccinv(shape, _CHANCE / bins)) / shape


@lru_cache(maxsize=1)
def _shared() -> float:
    """Return the squared mean direction of two channels of which motion makes too much of the power.

    That is as much as the variance of the noise is not known by (`PRIOR_FREEDOM`). Of normal channels of the coherence
    c^2, the share of the motion, the mean direction is pi/4 c F(1/2, 1/2; 2; c^2).

    Source: Lee, Hoppel, Mango & Miller (1994), IEEE Trans. Geosci. Remote Sensing 32, 1017-1028 (phase differences).
    """
    adds = math.sqrt(2.0 / PRIOR_FREEDOM)
    share = adds / (1.0 + adds)
    return (0.25 * math.pi) ** 2 * share * float(hyp2f1(0.5, 0.5, 2.0, share)) ** 2


def _end_of_motion(free: np.ndarray, power: np.ndarray) -> int | None:
    """Return the last bin below the first half octave that is free of the motion; None: there is none.

    Channels may keep together again above it. Where that has less power than the noise below, the noise there is less:
    a logger's filter has cut it. Where it has more, motion goes on.

    Args:
        free: (bins,) whether channels do not keep together.
        power: (bins,) spectrum.
    """
    edges = np.flatnonzero(np.diff(np.concatenate(([0], free.astype(np.int8), [0]))))
    for first, end in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        wide = end - first >= 2 * _EVENED and (end == free.size or end > _OCTAVE * first)
        if wide and not np.any(power[end:] > np.mean(power[first:end])):
            return max(first - 1, 0)
    return None


def _coloured(power: np.ndarray, at: np.ndarray) -> Level | None:
    """Return noise that is correlated from sample to sample, x_i = phi x_(i-1) + e_i; None if the spectrum is another.

    Where the motion ends high in the band, its own tail falls like that. Noise below is taken to be as strong as at the
    lowest frequency that is seen, not stronger.

    Args:
        power: (n,) spectrum.
        at: (n,) frequencies, in shares of the Nyquist frequency.
    """
    logarithm, turn = np.log(power), np.cos(np.pi * at)
    left = []
    for phi in _PHI:
        own = logarithm + np.log(1.0 - 2.0 * phi * turn + phi**2)
        left.append((float(np.mean(np.abs(own - np.median(own)))), phi, float(np.exp(np.median(own)))))
    misfit, phi, drive = min(left)
    if misfit > _ALIKE:
        return None
    first = float(at[0])
    density = drive / (1.0 - 2.0 * phi * math.cos(math.pi * first) + phi**2)
    below = math.atan((1.0 + phi) / (1.0 - phi) * math.tan(0.5 * math.pi * first)) * 2.0 / math.pi  # of all, by phi
    return Level(drive / (1.0 - phi**2) * (1.0 - below) + density * first, density)


def _segments(values: np.ndarray) -> tuple[np.ndarray, tuple[int, np.ndarray]]:
    """Return segments (m, length) of second differences, the longest of which there are enough without corners.

    With it, their length and which (k,) of all segments they are.

    Corners and jumps (friction at a reversal, a ramp that ends) have no plateau but reach all frequencies. They show
    as few large fourth differences. Segments in which nothing changes at all, as of a digitiser at rest, are left out.
    """
    differences = np.diff(values, 2)
    fourth = np.diff(differences, 2)
    least = max(difference_gain(4) * rounding(values), 1e-12 * float(np.ptp(values)))
    large = np.abs(fourth) > _CORNER * max(robust_deviation(fourth), least)
    corner = np.convolve(large, np.ones(3))[: differences.size] > 0.0
    length = _LONGEST
    while True:
        found = _windows(differences, length)
        which = np.any(found != 0.0, axis=1) & ~np.any(_windows(corner, length), axis=1)
        if np.count_nonzero(which) >= _SEGMENTS or length <= _SHORTEST:
            return np.asarray(found[which], dtype=float), (length, which)
        length //= 2


def _windows(values: np.ndarray, length: int, which: np.ndarray | slice = slice(None)) -> np.ndarray:
    """Return segments (m, length) that overlap by three quarters."""
    every = np.lib.stride_tricks.sliding_window_view(values, min(length, values.size))
    return np.asarray(every[:: max(length // 4, 1)][which])


def transforms(segments: np.ndarray) -> np.ndarray:
    """Return transforms (m, bins) of a channel, scaled so that white noise of unit variance has a power of one.

    Args:
        segments: (m, length) of its second differences.

    Second differences take trends away and lower the motion, so that less of it leaks; their gain is known.
    """
    length = segments.shape[1]
    window = np.kaiser(length, _BETA)
    found = np.fft.rfft(segments * window, axis=1) / np.sqrt(np.sum(window**2))
    gain = (2.0 * np.sin(np.pi * np.arange(found.shape[1]) / length)) ** 2
    gain[0] = gain[1]
    return np.asarray(found / gain)
