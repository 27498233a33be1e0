"""Hum of the mains in the force channel: narrow-band tones with each test's own phase."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import ClassVar

import numpy as np
from numpy.polynomial.chebyshev import chebvander

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.peaks import ABOVE_ALL_MOTION
from edesign.calibrate.dampers.trial import Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LOWEST, _HIGHEST = 5.0, 1000.0  # Hz
_SLOW = 5  # half cycles over a test, and none, in which the amplitude may change
_QUICK, _QUICKEST = 21, 81


@dataclass(frozen=True)
class Frequency(Unknown):
    """A frequency that data of long duration tell sharply: differences are taken in its size, not in its value."""

    def step(self, coordinate: float) -> float:
        step = 1e-2
        return step if coordinate + step <= self.span[1] else -step


class _Hum(Form):
    has_columns: bool = True
    name: ClassVar[str] = "hum"
    kind: ClassVar[Kind] = "instrument"
    source: ClassVar[str] = "Lomb (1976), Astrophys. Space Sci. 39, 447-462 (least squares of sines); EN 50160 (mains)"
    _orders: ClassVar[tuple[int, ...]] = (1,)

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        # a tone that is off by 0.3 / duration is out of step by a third of a turn at the end
        return (Frequency("frequency", "Hz", _LOWEST, _HIGHEST, 0.3 / sizes.duration),)

    def starts_from_residuals(self, sizes: Sizes, left: Left) -> tuple[tuple[float, ...], ...]:
        """Frequencies of narrow peaks; none: no hum."""
        return tuple((f,) for f in left.tones if _LOWEST < f < _HIGHEST)

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        angle = 2.0 * np.pi * p["frequency"] * (trial.motion.time - trial.motion.time[0])
        return np.column_stack([wave(order * angle) for order in self._orders for wave in (np.sin, np.cos)])


class Tone(_Hum):
    """One tone: a sin(2 pi f t + phase), f the same in all tests, a and phase each test's own."""

    form: ClassVar[str] = "tone"
    title: ClassVar[str] = "hum of one frequency in the force channel"
    signature: ClassVar[str] = "a narrow peak of the spectrum at one frequency in all tests, far above the motion"


class Harmonics(_Hum):
    """A tone with twice and three times its frequency, as rectifiers make them."""

    form: ClassVar[str] = "harmonics"
    title: ClassVar[str] = "hum with harmonics in the force channel"
    signature: ClassVar[str] = "narrow peaks of the spectrum at a frequency, twice and three times it, in all tests"
    _orders: ClassVar[tuple[int, ...]] = (1, 2, 3)

    def starts_from_residuals(self, sizes: Sizes, left: Left) -> tuple[tuple[float, ...], ...]:
        """The lowest of the peaks: the others may be its harmonics."""
        return tuple(sorted(super().starts_from_residuals(sizes, left))[:1])


class TwoTones(_Hum):
    """Two tones at frequencies of their own, as of a pump and of a floor."""

    form: ClassVar[str] = "two_tones"
    title: ClassVar[str] = "hum of two frequencies in the force channel"
    signature: ClassVar[str] = "two narrow peaks of the spectrum at the same frequencies in all tests"
    _names: ClassVar[tuple[str, ...]] = ("frequency", "second")

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        (one,) = super().unknowns(sizes)
        return tuple(replace(one, name=name) for name in self._names)

    def starts_from_residuals(self, sizes: Sizes, left: Left) -> tuple[tuple[float, ...], ...]:
        """Each so many of the peaks; none: there are fewer."""
        return tuple(combinations((f for (f,) in super().starts_from_residuals(sizes, left)), len(self._names)))

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        each = super().columns
        return np.hstack([each({"frequency": p[name]}, trial) for name in self._names])


class ThreeTones(TwoTones):
    """Three tones at frequencies of their own."""

    form: ClassVar[str] = "three_tones"
    title: ClassVar[str] = "hum of three frequencies in the force channel"
    signature: ClassVar[str] = "three narrow peaks of the spectrum at the same frequencies in all tests"
    _names: ClassVar[tuple[str, ...]] = ("frequency", "second", "third")


class Unsteady(_Hum):
    """One tone whose amplitude and phase change slowly within a test, as a motor's do under load."""

    form: ClassVar[str] = "unsteady"
    title: ClassVar[str] = "hum of one frequency and changing amplitude in the force channel"
    signature: ClassVar[str] = "a narrow peak of the spectrum with shoulders, at one frequency in all tests"
    _slow: ClassVar[int] = _SLOW

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        waves = super().columns(p, trial)
        time = trial.motion.time - trial.motion.time[0]
        # cos(j x) is Chebyshev's polynomial of cos x
        slow = chebvander(np.cos(np.pi * time / time[-1]), self._rows(p["frequency"], trial) - 1)
        return np.asarray(waves[:, :, np.newaxis] * slow[:, np.newaxis, :]).reshape(time.size, -1)

    def _rows(self, frequency: float, trial: Trial) -> int:
        """Half cycles, and none, of the changes: no more than leave the peak, which samples of a fit may fold, above
        the motion.
        """
        motion = trial.motion
        rate = 1.0 / float(np.median(motion.steps))
        folded = abs(frequency - round(frequency / rate) * rate)
        room = folded - ABOVE_ALL_MOTION * motion.frequency
        return min(self._slow, max(1, int(2.0 * room * (motion.time[-1] - motion.time[0]))))


class Restless(Unsteady):
    """As `unsteady`, with changes within seconds: a motor that hunts."""

    form: ClassVar[str] = "restless"
    title: ClassVar[str] = "hum in the force channel whose frequency and amplitude hunt"
    signature: ClassVar[str] = "a peak of the spectrum some tenths of a hertz wide, about one frequency in all tests"
    _slow: ClassVar[int] = _QUICK


class Hunting(Unsteady):
    """As `restless`, with changes within tenths of a second."""

    form: ClassVar[str] = "hunting"
    title: ClassVar[str] = "hum in the force channel whose frequency and amplitude hunt quickly"
    signature: ClassVar[str] = "a peak of the spectrum some hertz wide, about one frequency in all tests"
    _slow: ClassVar[int] = _QUICKEST


FORMS = (Tone, Harmonics, TwoTones, ThreeTones, Unsteady, Restless, Hunting)
