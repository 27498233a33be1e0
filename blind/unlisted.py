"""Effects no list of ours has, in the damper and in the rig; the instruments' stand in unlisted_channels."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, either, first_order, log_uniform
from blind.law import velocity
from blind.programme import Trial


class StickSlip(Effect):
    """Bursts of ringing at some reversals."""

    name, kind, form = "stick_slip", "rig", "bursts"
    first, most = 2.0, 300.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency, self.decay, self.share = rng.uniform(12.0, 40.0), rng.uniform(0.05, 0.3), rng.uniform(0.2, 0.6)

    def rig(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.size * self.bursts(test) for test, f in zip(tests, force, strict=True)]

    def bursts(self, test: Trial) -> np.ndarray:
        rng, out = self.random(test), np.zeros(test.n)
        for i in np.flatnonzero(np.diff(np.sign(test.v)) != 0.0):
            if rng.random() < self.share:
                t = test.t[i:] - test.t[i]
                out[i:] += rng.uniform(0.4, 1.0) * np.exp(-t / self.decay) * np.sin(2.0 * np.pi * self.frequency * t)
        return out

    def true_parameters(self) -> TrueParameters:
        return {"amplitude": (self.size, "kN"), "frequency": (self.frequency, "Hz")}


class StiffnessJumps(Effect):
    """The modulus jumps at random times (a layer that debonds and grips again)."""

    name, kind, form = "stiffness_jumps", "damper", "telegraph"
    most = 0.8

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.between = rng.uniform(1.0, 4.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test in tests:
            rng = self.random(test)
            times = np.cumsum(rng.exponential(self.between, 60))
            level = rng.uniform(-1.0, 1.0, 61)[np.searchsorted(times, test.t)]
            f = 1.0 + self.size * level
            out.append((f, f, f))
        return out


class DirectionDamping(Effect):
    """The dashpots give more on the way out than on the way home."""

    name, kind, form = "direction_damping", "damper", "out_and_home"
    most = 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense = either(rng)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, x in zip(tests, u, strict=True):
            way = np.tanh(x * velocity(x, test.h) / 5.0)
            f = 1.0 + self.size * 0.5 * (1.0 + self.sense * way)
            out.append((1.0, f, f))
        return out


class Rheopexy(Effect):
    """The modulus builds up with fast shear and is lost at rest, within a test."""

    name, kind, form = "rheopexy", "damper", "build_up"
    most = 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.speed, self.loss_time = rng.uniform(20.0, 80.0), log_uniform(rng, 0.4, 3.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, x in zip(tests, u, strict=True):
            fast = (np.diff(x) / test.h / self.speed) ** 2
            built = first_order(fast / self.loss_time, (1.0 + fast) / self.loss_time, test.h, 0.0)
            out.append((1.0 + self.size * built, 1.0, 1.0))
        return out


class EvenVelocity(Effect):
    """A force with the square of the velocity, to one side."""

    name, kind, form = "even_velocity", "damper", "square"
    first, most = 1.0, 200.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.side * self.size * (velocity(x, t.h) / 60.0) ** 2 for t, x in zip(tests, u, strict=True)]


FORMS = (StickSlip, StiffnessJumps, DirectionDamping, Rheopexy, EvenVelocity)
