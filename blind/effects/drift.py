"""The zero of the load cell moves."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator
from scipy.signal import lfilter

from blind.effects.base import Effect, Histories, TrueParameters, either
from blind.programme import Trial


class Drift(Effect):
    name, kind = "drift", "instrument"
    first, most = 2.0, 200.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)
        self.draw(rng)

    def draw(self, rng: Generator) -> None:
        """Draw the course."""

    def course(self, test: Trial) -> np.ndarray:
        """Zero (n,), of order one."""
        raise NotImplementedError

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.side * self.size * self.course(test) for test, f in zip(tests, force, strict=True)]


class EachTest(Drift):
    """In proportion to time, from zero in each test."""

    form = "linear_each_test"

    def course(self, test: Trial) -> np.ndarray:
        return test.t / 15.0

    def true_parameters(self) -> TrueParameters:
        return {"rate": (self.side * self.size / 15.0, "kN/s")}


class Campaign(Drift):
    """In proportion to the time of testing, over all tests."""

    form = "linear_campaign"

    def course(self, test: Trial) -> np.ndarray:
        return (test.index + test.t / test.t[-1]) / test.count

    def true_parameters(self) -> TrueParameters:
        return {"at_end": (self.side * self.size, "kN")}


class Warming(Drift):
    """The amplifier warms up in each test."""

    form = "warming"

    def draw(self, rng: Generator) -> None:
        self.time = rng.uniform(2.0, 12.0)

    def course(self, test: Trial) -> np.ndarray:
        return -np.expm1(-test.t / self.time)

    def true_parameters(self) -> TrueParameters:
        return {"end": (self.side * self.size, "kN"), "time": (self.time, "s")}


class Wandering(Drift):
    """A random walk that is pulled back."""

    form = "wandering"

    def draw(self, rng: Generator) -> None:
        self.time = rng.uniform(2.0, 10.0)

    def course(self, test: Trial) -> np.ndarray:
        e = float(np.exp(-test.h / self.time))
        walk = lfilter([np.sqrt(1.0 - e * e)], [1.0, -e], self.random(test).standard_normal(test.n))
        quick = float(np.exp(-test.h / 0.2))
        return lfilter([1.0 - quick], [1.0, -quick], walk)

    def true_parameters(self) -> TrueParameters:
        return {"standard_deviation": (self.size, "kN"), "time": (self.time, "s")}


FORMS = (EachTest, Campaign, Warming, Wandering)
