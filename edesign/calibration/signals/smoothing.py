"""A motion freed from its noise: by a gain that decreases with frequency, then of what is noise in its time.

Where a motion turns fast once and rests then, its spectrum keeps the noise of all times. A law that yields does not let
such noise pass: it unloads steeper than it loads, and creeps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.fft import dst, idst
from scipy.optimize import isotonic_regression

_SHORTEST = 6  # samples of what is fitted at an end
_FITS = 1.2  # times the noise
_SIGNIFICANT = 3.0  # standard errors
_LEAST_GAIN = 0.1  # less is chance, which two differentiations would turn into an acceleration
_WAVELET = "sym8"  # a smooth one: eight vanishing moments
_COARSEST = 32  # coefficients of the coarsest level at least; 16 or 8 change errors of forces by 5 % at most


def smoothed(values: np.ndarray, noise: float, rests: bool = True) -> np.ndarray:
    """Return values (n,) without noise, for even sampling.

    Of all gains that decrease with frequency the one with the least expected squared error of the velocity, estimated
    without bias from the spectrum P and the known noise N: the antitonic regression of 1 - N/P with weights w^2 P (a
    Wiener filter without a model of the spectrum). At the ends the motion is continued with its value, slope and
    curvature. Wavelets of what is left are set to zero where noise alone would make as much.

    Args:
        values: (n,) in any unit, evenly sampled.
        noise: standard deviation of theirs, in that unit.
        rests: whether noise of rests is taken off by wavelets too.

    Source: Stein, Ann. Statist. 9 (1981) 1135; Barlow et al., Statistical Inference under Order Restrictions (1972);
    Donoho and Johnstone, Biometrika 81 (1994) 425 (threshold); Coifman and Donoho, Lecture Notes in Statistics 103
    (1995) 125 (the same at any shift in time).
    """
    n = values.size
    ends = _ends(values, noise)
    spectrum = dst((values - ends)[1:-1], type=1, norm="ortho")
    omega = np.arange(1, n - 1) / (n - 1.0)
    power, level = spectrum**2, noise**2
    power = np.maximum(power, 1e-300)
    gain = isotonic_regression(1.0 - level / power, weights=omega**2 * power, increasing=False).x
    gain[gain < _LEAST_GAIN] = 0.0
    found = ends.copy()
    found[1:-1] += idst(gain * spectrum, type=1, norm="ortho")
    return _shrunk(found, noise) if rests else found


def _shrunk(values: np.ndarray, noise: float) -> np.ndarray:
    """Set wavelet coefficients to zero that are below the largest that noise makes."""
    import pywt

    n = values.size
    levels = int(np.log2(max(n // _COARSEST, 1)))
    if levels < 1:
        return values
    beyond = min(2 ** (levels + 1), n - 1)
    before, after = 2.0 * values[0] - values[beyond:0:-1], 2.0 * values[-1] - values[-2 : -beyond - 2 : -1]
    every = np.concatenate((before, values, after))
    every = np.append(every, np.full(-every.size % 2**levels, every[-1]))
    coarse, *details = pywt.swt(every, _WAVELET, level=levels, norm=True, trim_approx=True)
    for level, detail in zip(range(levels, 0, -1), details, strict=True):
        detail[np.abs(detail) < noise * 2.0 ** (-0.5 * level) * np.sqrt(2.0 * np.log(n))] = 0.0
    return np.asarray(pywt.iswt([coarse, *details], _WAVELET, norm=True)[beyond : beyond + n], dtype=float)


def _ends(values: np.ndarray, noise: float) -> np.ndarray:
    """A straight line through both end values plus, at each end, a bump with the curvature there."""
    n = values.size
    at = np.arange(n, dtype=float)
    left, right = _End.of(values, noise), _End.of(values[::-1], noise)
    line = left.value + (right.value - left.value) * at / (n - 1.0)
    return np.asarray(line + left.bump(at) + right.bump(at)[::-1], dtype=float)


@dataclass(frozen=True)
class _End:
    """Value and second derivative (per sample squared) at the first sample, and over how many samples they hold."""

    value: float
    curvature: float
    reach: float

    @staticmethod
    def of(values: np.ndarray, noise: float) -> _End:
        """By a cubic over the longest window that it fits up to the noise."""
        found = _End(float(values[0]), 0.0, 1.0)
        window = _SHORTEST
        while window <= max(values.size // 4, _SHORTEST):
            part = values[: window + 1]
            rows = np.vander(np.arange(part.size) / window, 4, increasing=True)
            inverse = np.linalg.inv(rows.T @ rows)
            cubic = inverse @ (rows.T @ part)
            misfit = float(np.sqrt(np.mean((part - rows @ cubic) ** 2)))
            if window > _SHORTEST and misfit > _FITS * noise:
                break
            curvature = 2.0 * float(cubic[2])
            if abs(curvature) < _SIGNIFICANT * 2.0 * noise * np.sqrt(inverse[2, 2]):
                curvature = 0.0
            found = _End(float(cubic[0]), curvature / window**2, float(window))
            window *= 2
        return found

    def bump(self, at: np.ndarray) -> np.ndarray:
        """A function of value and slope zero and this curvature at the end, that fades away from it."""
        return np.asarray(0.5 * self.curvature * at**2 * np.exp(-((at / self.reach) ** 2)), dtype=float)
