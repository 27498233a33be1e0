"""From test to test the rubber is another one, whatever was done to it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, TrueParameters, either
from blind.law import Parameters, stiffened
from blind.programme import Trial

_SPRINGS = ("k0", "k_a", "k_b")


class Ageing(Effect):
    name, kind = "ageing", "damper"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense, self.springs_only = either(rng), rng.random() < 0.4
        self.draw(rng, tests)

    def draw(self, rng: Generator, tests: Sequence[Trial]) -> None:
        """Draw the course."""

    def course(self, test: Trial) -> float:
        """From 0 to 1."""
        raise NotImplementedError

    def parameters(self, test: Trial, p: Parameters) -> Parameters:
        factor = 1.0 + self.sense * self.size * self.course(test)
        if self.springs_only:
            return {name: value * factor if name in _SPRINGS else value for name, value in p.items()}
        return stiffened(p, factor)

    def true_parameters(self) -> TrueParameters:
        return {"change_at_end": (self.sense * self.size, "1")}


class Linear(Ageing):
    form = "linear"

    def course(self, test: Trial) -> float:
        return test.index / (test.count - 1)


class Logarithm(Ageing):
    """Fast at first."""

    form = "logarithm"

    def draw(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.scale = rng.uniform(0.5, 3.0)

    def course(self, test: Trial) -> float:
        return float(np.log1p(test.index / self.scale) / np.log1p((test.count - 1) / self.scale))


class Clock(Ageing):
    """With the hours in the laboratory, towards an end."""

    form = "clock"

    def draw(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.hours = np.cumsum([test.pause for test in tests])
        self.hours -= self.hours[0]
        self.scale = rng.uniform(0.3, 1.5) * float(self.hours[-1])
        self.at = {test.index: hour for test, hour in zip(tests, self.hours, strict=True)}

    def course(self, test: Trial) -> float:
        return float(-np.expm1(-self.at[test.index] / self.scale) / -np.expm1(-self.hours[-1] / self.scale))


FORMS = (Linear, Logarithm, Clock)
