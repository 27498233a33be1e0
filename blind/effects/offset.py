"""A channel's zero is wrong."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters, either
from blind.programme import Trial


class Force(Effect):
    name, kind, form = "offset", "instrument", "force"
    first, most = 1.0, 100.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.side * self.size for f in force]

    def true_parameters(self) -> TrueParameters:
        return {"force": (self.side * self.size, "kN")}


class Displacement(Effect):
    name, kind, form = "offset", "instrument", "displacement"
    first, most = 0.1, 4.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def displacement_channel(self, tests: Sequence[Trial], x: Histories) -> Histories:
        return [y + self.side * self.size for y in x]

    def true_parameters(self) -> TrueParameters:
        return {"displacement": (self.side * self.size, "mm")}


class EachTest(Effect):
    """The load cell is set to zero before each test, never quite."""

    name, kind, form = "offset", "instrument", "force_each_test"
    first, most = 1.0, 100.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.values = {test.index: rng.standard_normal() for test in tests}

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.size * self.values[test.index] for test, f in zip(tests, force, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {"standard_deviation": (self.size, "kN")}


FORMS = (Force, Displacement, EachTest)
