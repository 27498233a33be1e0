"""The load cell also moves a mass. The size is the mass in tonnes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters
from blind.effects.lag import second_order
from blind.law import velocity
from blind.programme import Trial


class Rigid(Effect):
    name, kind, form = "inertia", "instrument", "rigid"
    first, most = 0.3, 100.0

    def rig(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + 1e-3 * self.size * self.acceleration(test) for test, f in zip(tests, force, strict=True)]

    def acceleration(self, test: Trial) -> np.ndarray:
        """Of the mass (n,), mm/s2: t mm/s2 is 1e-3 kN."""
        return velocity(test.v, test.h)

    def true_parameters(self) -> TrueParameters:
        return {"mass": (self.size, "t")}


class Flexible(Rigid):
    """The mass is held by a spring of its own, 25 to 60 Hz."""

    form = "flexible"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency, self.damping = rng.uniform(25.0, 60.0), rng.uniform(0.1, 0.4)

    def acceleration(self, test: Trial) -> np.ndarray:
        return second_order(super().acceleration(test), test.h, 2.0 * np.pi * self.frequency, self.damping)


class Unbalanced(Rigid):
    """More mass moves in one direction of travel's half than in the other (a fixture that lifts off a stop)."""

    form = "two_masses"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.more = rng.uniform(0.1, 0.4)

    def acceleration(self, test: Trial) -> np.ndarray:
        return super().acceleration(test) * (1.0 + self.more * np.tanh(test.x / 0.5))


FORMS = (Rigid, Flexible, Unbalanced)
