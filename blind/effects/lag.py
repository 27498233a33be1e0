"""The two channels do not show the same instant. The size is the delay, s."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.signal import lfilter

from blind.effects.base import Effect, Histories, TrueParameters
from blind.programme import Trial


class Lag(Effect):
    name, kind = "lag", "instrument"
    first, most = 0.004, 0.15
    sense = 1.0

    def true_parameters(self) -> TrueParameters:
        return {"delay": (self.sense * self.size, "s")}


class ForceLate(Lag):
    form = "force_late"

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [np.interp(test.t - self.size, test.t, f) for test, f in zip(tests, force, strict=True)]


class DisplacementLate(Lag):
    form, sense = "displacement_late", -1.0

    def displacement_channel(self, tests: Sequence[Trial], x: Histories) -> Histories:
        return [np.interp(test.t - self.size, test.t, y) for test, y in zip(tests, x, strict=True)]


class FirstOrder(Lag):
    """A resistor and a capacitor behind the load cell."""

    form = "first_order"

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        out = []
        for test, f in zip(tests, force, strict=True):
            e = float(np.exp(-test.h / self.size))
            out.append(lfilter([0.5 * (1.0 - e), 0.5 * (1.0 - e)], [1.0, -e], f, zi=[(0.5 + 0.5 * e) * f[0]])[0])
        return out


class SecondOrder(Lag):
    """An amplifier's low pass of second order, damping 0.87 (Bessel): a delay of 2 zeta/w at low frequencies."""

    form = "second_order"

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [
            f[0] + second_order(f - f[0], test.h, 2.0 * 0.87 / self.size, 0.87)
            for test, f in zip(tests, force, strict=True)
        ]


def second_order(signal: np.ndarray, h: float, w: float, damping: float) -> np.ndarray:
    """Signal (n,) through w^2/(s^2 + 2 damping w s + w^2), from rest; bilinear."""
    a, b = (w * h) ** 2, 4.0 * damping * w * h
    return lfilter([a, 2.0 * a, a], [4.0 + b + a, 2.0 * a - 8.0, 4.0 - b + a], signal)


FORMS = (ForceLate, DisplacementLate, FirstOrder, SecondOrder)
