"""How a specimen follows its target: a delay, that may change, and a second order behind it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from scipy.linalg import expm

from blind.effects.base import either

LONGEST = 0.020  # s
FADES = 2.0  # s: of the envelope that a delay grows with
REACH = 6.0  # mm: amplitude at which it has grown by its share


@dataclass(frozen=True)
class Rig:
    """A rig.

    Attributes:
        delay: pure, at the beginning and at small amplitudes, s.
        growth: share by which it is longer at an amplitude of REACH.
        drift: by which it is longer after a second of tests, s/s.
        frequency, damping: of a second order behind the delay, Hz and of critical; 0: there is none.
        gain: the encoder shows (1 + gain) of the displacement, which the controller holds.
        force_delay: of the load cell, s.
    """

    delay: float = 0.0
    growth: float = 0.0
    drift: float = 0.0
    frequency: float = 0.0
    damping: float = 0.0
    gain: float = 0.0
    force_delay: float = 0.0

    @property
    def of_order(self) -> float:
        """Delay of slow motions by the second order, s."""
        return self.damping / (math.pi * self.frequency) if self.frequency else 0.0


def draw_rig(rng: Generator, kind: str, seconds: float) -> Rig:
    """Draw a rig of a kind for a campaign of so many seconds; slow motions are late by 0 to 20 ms in all."""
    if kind == "none":
        return Rig()
    if kind == "second_order":
        while True:
            order = Rig(frequency=float(np.exp(rng.uniform(np.log(10.0), np.log(40.0)))), damping=rng.uniform(0.3, 0.9))
            if order.of_order < LONGEST:
                pure = rng.uniform(0.0, LONGEST - order.of_order)
                return Rig(delay=pure, frequency=order.frequency, damping=order.damping)
    delay = rng.uniform(0.0, LONGEST)
    if kind == "with_amplitude":
        return Rig(delay=delay / 1.4, growth=rng.uniform(0.1, 0.4))
    if kind == "drifting":
        return Rig(delay=delay, drift=either(rng) * rng.uniform(0.1, 0.4) * delay / seconds)
    if kind == "encoder_gain":
        return Rig(delay=delay, gain=either(rng) * rng.uniform(0.005, 0.05))
    if kind == "force_delay":
        late = min(rng.uniform(0.0002, 0.003), delay)
        return Rig(delay=delay - late, force_delay=late)
    return Rig(delay=delay)


def envelope(target: np.ndarray, h: float, fades: float) -> np.ndarray:
    """Amplitude (n,) of a target (n,): the largest size before, fading with a time, s, or that now if it is larger."""
    kept, amplitude = math.exp(-h / fades), [abs(float(target[0]))]
    for u in np.abs(target[1:]).tolist():
        amplitude.append(max(u, amplitude[-1] * kept))
    return np.array(amplitude)


class Follower:
    """A specimen behind its target, step by step, from rest.

    Args:
        rig: that moves it.
        h: step, s.
        before: s of tests before this one.
    """

    def __init__(self, rig: Rig, h: float, before: float) -> None:
        self._rig, self._h = rig, h
        self._target, self._late = [0.0], [rig.delay + rig.drift * before]
        self._before, self._envelope, self._fades = before, 0.0, math.exp(-h / FADES)
        self._x, self._v, self._last = 0.0, 0.0, 0.0
        if rig.frequency:
            w = 2.0 * math.pi * rig.frequency
            # x, x', r, r' of x'' + 2 zeta w x' + w^2 x = w^2 r, r linear over the step
            rates = np.array([[0, 1, 0, 0], [-w * w, -2.0 * rig.damping * w, w * w, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
            self._over = expm(rates * h)[:2].tolist()

    def step(self, target: float) -> float:
        """The specimen's displacement, mm, when the target, mm, is there; this is the next one."""
        self._target.append(target)
        k, rig, h = len(self._target) - 1, self._rig, self._h
        self._envelope = max(abs(target), self._envelope * self._fades)
        late = rig.delay * (1.0 + rig.growth * self._envelope / REACH) + rig.drift * (self._before + k * h)
        self._late.append(late)
        at = k - max(late, 0.0) / h
        i = math.floor(at)
        given = self._target[i] + (at - i) * (self._target[i + 1] - self._target[i]) if 0 <= i < k else 0.0
        given = target if i >= k else given
        if rig.frequency:
            a, b = self._over
            rate = (given - self._last) / h
            x, v, r = self._x, self._v, self._last
            self._x, self._v = (row[0] * x + row[1] * v + row[2] * r + row[3] * rate for row in (a, b))
            self._last, given = given, self._x
        return given / (1.0 + rig.gain)

    @property
    def late(self) -> np.ndarray:
        """By which slow motions of the force have been late at all steps (n,), s."""
        return np.maximum(self._late, 0.0) + self._rig.of_order + self._rig.force_delay
