"""Stiffer to one side than to the other."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, either
from blind.programme import Trial


class TwoModuli(Effect):
    """The modulus goes over from one side to the other about zero."""

    name, kind, form = "one_sided", "damper", "two_moduli"
    most = 4.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side, self.width, self.loss = either(rng), rng.uniform(0.05, 0.6), rng.uniform(0.0, 1.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for x in u:
            s = 0.5 * self.size * (1.0 + np.tanh(self.side * x / self.width))
            out.append((1.0 + s, 1.0 + self.loss * s, 1.0 + self.loss * s))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"excess": (self.size, "1"), "side": (self.side, "1")}


class SquareSpring(Effect):
    """A force with the square of the deformation, always to one side."""

    name, kind, form = "one_sided", "damper", "square_spring"
    most = 30.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def right(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.side * self.size * x * x / 6.0 for x in u]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness_at_6_mm": (self.size, "kN/mm"), "side": (self.side, "1")}


class Buffer(Effect):
    """A rubber buffer touched on one side: k (u - gap)^1.5."""

    name, kind, form = "one_sided", "damper", "buffer"
    first, most = 0.5, 300.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side, largest = either(rng), max(float(np.abs(test.x).max()) for test in tests)
        self.gap = rng.uniform(0.05, 0.45) * largest

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.side * self.size * np.maximum(self.side * x - self.gap, 0.0) ** 1.5 for x in u]

    def true_parameters(self) -> TrueParameters:
        return {"coefficient": (self.size, "kN/mm^1.5"), "gap": (self.gap, "mm"), "side": (self.side, "1")}


FORMS = (TwoModuli, SquareSpring, Buffer)
