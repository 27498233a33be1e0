"""Narrow peaks in the spectrum of a residual that do not come from the motion, such as hum of the mains."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import maximum_filter1d, median_filter
from scipy.optimize import minimize_scalar

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.signals.sampling import even, step
from edesign.calibration.signals.windows import blackman_harris

CHANCE = 1e-4
"""Probability with which noise alone makes such a peak anywhere in the spectrum."""

_MOST = 6  # tones of a test
_AROUND = 61  # bins: the level beside a peak
_MAIN_LOBE = 4  # bins on each side, of the window
_HARMONICS = 9  # of the motion, none of which is a tone
_STANDS_OUT = 4.0  # times the power one and two base frequencies away
_BAND = 3.0  # of the motion's, above which motions without a base frequency leave no peaks
_FEWEST = 128  # samples


@dataclass(frozen=True)
class Tone:
    """A sine in a residual.

    Attributes:
        frequency: Hz.
        amplitude: N.
    """

    frequency: float
    amplitude: float


def find_tones(motion: Cycles, values: np.ndarray) -> tuple[Tone, ...]:
    """Tones in a channel, strongest first.

    Only above the band of the motion (three times the band if it has no base frequency). In a test of one frequency
    at none of its first nine harmonics, and only where the power is four times that one and two harmonics away.

    Args:
        motion: of the test, which shows what it explains.
        values: (n,) N.
    """
    return _search(motion, values)[0]


def without_tones(motion: Cycles, values: np.ndarray) -> np.ndarray:
    """The channel (n,) less its tones."""
    return _search(motion, values)[1]


def _search(motion: Cycles, values: np.ndarray) -> tuple[tuple[Tone, ...], np.ndarray]:
    grid, rest = even(motion.time, values)
    if rest.size < _FEWEST:
        return (), np.asarray(values, dtype=float)
    dt, n = step(grid), rest.size
    window = blackman_harris(n, periodic=True)
    frequency = np.fft.rfftfreq(n, dt)
    tones: list[Tone] = []
    found = np.zeros(values.size)
    power = np.abs(np.fft.rfft((rest - np.mean(rest)) * window)) ** 2
    allowed = _allowed(frequency, power, motion)
    while len(tones) < _MOST:
        ratio = power / (median_filter(power, size=_AROUND, mode="nearest") / np.log(2.0) + 1e-300)
        at = int(np.argmax(np.where(allowed, power * (ratio > _least(n)), 0.0)))
        if not allowed[at] or ratio[at] <= _least(n):
            break
        exact = _refined(grid, rest * window, frequency[at], frequency[1])
        rows = _sine(grid, exact)
        cos_sin = np.linalg.lstsq(rows * window[:, None], rest * window, rcond=None)[0]
        tones.append(Tone(exact, float(np.hypot(*cos_sin))))
        rest = rest - rows @ cos_sin
        found += _sine(motion.time, exact) @ cos_sin
        power = np.abs(np.fft.rfft((rest - np.mean(rest)) * window)) ** 2
        allowed[max(at - _MAIN_LOBE, 0) : at + _MAIN_LOBE + 1] = False
    tones.sort(key=lambda tone: -tone.amplitude)
    return tuple(tones), np.asarray(values - found)


def _least(samples: int) -> float:
    """Power over the mean level that one of n/2 exponential variables passes with the probability of `CHANCE`."""
    return float(np.log(0.5 * samples / CHANCE))


def _allowed(frequency: np.ndarray, power: np.ndarray, motion: Cycles) -> np.ndarray:
    """Bins (m,) in which a peak does not come from the motion.

    Harmonics of a periodic motion, and their images at sampling, come in combs: as far from a peak as the base
    frequency, or a multiple that the window separates, there are others.
    """
    bin_width = float(frequency[1])
    lobe = (_MAIN_LOBE + 1) * bin_width
    base = motion.base_frequency
    above = motion.upper_frequency if base is not None else _BAND * motion.upper_frequency
    allowed = (frequency > max(above, lobe)) & (frequency < frequency[-1] - lobe)
    if base is None:
        return np.asarray(allowed)
    near = np.abs(frequency - base * np.round(frequency / base)) < max(0.25 * base, 2.0 * bin_width)
    allowed &= ~(near & (frequency < (_HARMONICS + 0.5) * base))
    widened = maximum_filter1d(power, 3, mode="constant")
    spacing = base * np.ceil(lobe / base) / bin_width
    for distance in (-2.0, -1.0, 1.0, 2.0):
        beside = np.arange(power.size) + int(round(distance * spacing))
        inside = (beside >= 0) & (beside < power.size)
        allowed[inside] &= power[inside] > _STANDS_OUT * widened[beside[inside]]
    return np.asarray(allowed)


def _sine(time: np.ndarray, frequency: float) -> np.ndarray:
    phase = 2.0 * np.pi * frequency * (time - time[0])
    return np.column_stack((np.cos(phase), np.sin(phase)))


def _refined(time: np.ndarray, windowed: np.ndarray, near: float, bin_width: float) -> float:
    """Frequency of the maximum of the spectrum between the bins."""
    at = time - time[0]

    def minus_power(frequency: float) -> float:
        return -float(np.abs(np.exp(-2j * np.pi * frequency * at) @ windowed) ** 2)

    result = minimize_scalar(
        minus_power, bounds=(near - bin_width, near + bin_width), method="bounded", options={"xatol": 1e-5 * bin_width}
    )
    return float(result.x)
