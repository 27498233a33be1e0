"""Effects no list of ours has, in instruments."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator
from scipy.signal import lfilter

from blind.effects.base import Effect, Histories, TrueParameters, either
from blind.effects.lag import second_order
from blind.programme import Trial


class Clipping(Effect):
    """The load cell saturates. The size is the share of the largest force that is lost."""

    name, kind, form = "clipping", "instrument", "saturation"
    memory = True  # the limit depends on all tests

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        limit = (1.0 - self.size) * max(float(np.abs(f).max()) for f in force)
        return [np.clip(f, -limit, limit) for f in force]


class Resonance(Effect):
    """The load cell's frame rings, hardly damped, in a share of the force."""

    name, kind, form = "rig_resonance", "instrument", "second_order"
    first, most = 0.5, 10.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency, self.damping = rng.uniform(10.0, 25.0), rng.uniform(0.01, 0.06)

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        w = 2.0 * np.pi * self.frequency
        return [f + self.size * (second_order(f, t.h, w, self.damping) - f) for t, f in zip(tests, force, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {"share": (self.size, "1"), "frequency": (self.frequency, "Hz"), "damping": (self.damping, "1")}


class Beat(Effect):
    """The amplifier's gain oscillates slowly."""

    name, kind, form = "beat", "instrument", "modulation"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency = rng.uniform(0.15, 1.3)

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        out = []
        for test, f in zip(tests, force, strict=True):
            phase = self.random(test).uniform(0.0, 2.0 * np.pi)
            out.append(f * (1.0 + self.size * np.sin(2.0 * np.pi * self.frequency * test.t + phase)))
        return out


class Freeze(Effect):
    """The channel holds its last value for some time. The size is the time in s."""

    name, kind, form = "freeze", "instrument", "missing_samples"
    first, most = 0.1, 4.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.times = int(rng.integers(1, 5))

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        out = []
        for test, f in zip(tests, force, strict=True):
            held = f.copy()
            for at in self.random(test).uniform(0.1, 0.8, self.times) * test.n:
                end = min(int(at) + round(self.size / test.h), test.n)
                held[int(at) : end] = held[int(at)]
            out.append(held)
        return out


class Shelf(Effect):
    """The gain is another one above a frequency."""

    name, kind, form = "frequency_gain", "instrument", "shelf"
    first, most = 0.2, 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.corner, self.sense = rng.uniform(1.0, 6.0), either(rng)

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        out = []
        for test, f in zip(tests, force, strict=True):
            e = float(np.exp(-2.0 * np.pi * self.corner * test.h))
            out.append(
                f
                + self.sense * min(self.size, 0.95 if self.sense < 0 else 9.0) * (f - lfilter([1.0 - e], [1.0, -e], f))
            )
        return out


class Spikes(Effect):
    """Single samples far off."""

    name, kind, form = "spikes", "instrument", "outliers"
    first, most = 20.0, 5000.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.share = rng.uniform(0.002, 0.01)

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        out = []
        for test, f in zip(tests, force, strict=True):
            rng, hit = self.random(test), np.arange(0, test.n, test.every)
            hit = hit[rng.random(hit.size) < self.share]
            wrong = f.copy()
            wrong[hit] += self.size * rng.standard_normal(hit.size)
            out.append(wrong)
        return out


FORMS = (Clipping, Resonance, Beat, Freeze, Shelf, Spikes)
