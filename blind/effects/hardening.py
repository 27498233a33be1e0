"""The rubber stiffens at large strain."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters
from blind.programme import Trial


class Polynomial(Effect):
    """An odd power of the deformation, 3 or 5, before the relaxation."""

    name, kind, form = "hardening", "damper", "polynomial"
    first, most = 0.5, 60.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.power = int(rng.choice([3, 5]))

    def right(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.size * x * (x / 6.0) ** (self.power - 1) for x in u]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness_at_6_mm": (self.size, "kN/mm"), "power": (self.power, "1")}


class Extensibility(Effect):
    """Chains that run out of length: k u x^2/(1 - x^2), x = u over the length."""

    name, kind, form = "hardening", "damper", "extensibility"
    first, most = 0.5, 60.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.length = rng.uniform(1.1, 1.6) * max(float(np.abs(test.x).max()) for test in tests)

    def right(self, tests: Sequence[Trial], u: Histories) -> Histories:
        squares = [np.minimum((x / self.length) ** 2, 0.95) for x in u]
        return [self.size * x * q / (1.0 - q) for x, q in zip(u, squares, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (self.size, "kN/mm"), "length": (self.length, "mm")}


class Exponential(Effect):
    """Fung's tissue: k u (exp((u/c)^2) - 1), beside the damper."""

    name, kind, form = "hardening", "damper", "exponential"
    first, most = 0.3, 60.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.scale = rng.uniform(3.5, 7.0)

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.size * x * np.expm1((x / self.scale) ** 2) for x in u]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (self.size, "kN/mm"), "scale": (self.scale, "mm")}


class Locking(Effect):
    """A second spring that engages softly at a deformation."""

    name, kind, form = "hardening", "damper", "locking"
    first, most = 1.0, 200.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        largest = max(float(np.abs(test.x).max()) for test in tests)
        self.at, self.width = rng.uniform(0.35, 0.65) * largest, rng.uniform(0.05, 0.5)

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        w = self.width
        return [
            self.size * w * np.sign(x) * np.logaddexp(0.0, (np.abs(x) - self.at) / w) * np.tanh(np.abs(x) / w)
            for x in u
        ]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (self.size, "kN/mm"), "at": (self.at, "mm")}


FORMS = (Polynomial, Extensibility, Exponential, Locking)
