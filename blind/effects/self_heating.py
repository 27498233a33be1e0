"""The work warms the rubber, which then is softer; it cools with time, and between tests."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, first_order, log_uniform
from blind.law import middle, velocity
from blind.programme import Trial

RUBBER = 1e-3 * 1.9e6  # J/K: two layers, 1 litre, heat capacity of the volume


def power(test: Trial, u: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Power in each step (n-1,) W (kN mm/s), smoothed over half a second so that springs do not heat."""
    rate = np.full(test.n - 1, 2.0)
    smooth = first_order(middle(force * velocity(u, test.h)) * rate, rate, test.h, 0.0)
    return np.maximum(middle(smooth), 0.0)


class Heating(Effect):
    name, kind, memory = "self_heating", "damper", True
    first, most = 0.05, 3.0  # 1/K
    loss: ClassVar[float] = 1.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.capacity, self.cooling = RUBBER * rng.uniform(0.4, 1.2), log_uniform(rng, 30.0, 900.0)

    def soft(self, warmer: np.ndarray) -> np.ndarray:
        return np.exp(-self.size * warmer)

    def warmth(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Histories:
        """Kelvin above ambient (n,)."""
        out, warmer = [], 0.0
        for test, x, f in zip(tests, u, force, strict=True):
            warmer *= float(np.exp(-test.pause / self.cooling))
            rate = np.full(test.n - 1, 1.0 / self.cooling)
            out.append(first_order(power(test, x, f) / self.capacity, rate, test.h, warmer))
            warmer = float(out[-1][-1])
        return out

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        return [(f, f, f) for f in (self.soft(w) for w in self.warmth(tests, u, force))]

    def true_parameters(self) -> TrueParameters:
        return {
            "softening": (self.size, "1/K"),
            "capacity": (self.capacity, "J/K"),
            "cooling_time": (self.cooling, "s"),
        }


class Exponential(Heating):
    form = "one_node"


class TwoNodes(Heating):
    """A core that hands its heat to the steel within seconds; softening 1/(1 + b T)."""

    form = "core_and_plates"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        super().shape(rng, tests)
        self.share, self.quick = rng.uniform(0.3, 0.7), log_uniform(rng, 5.0, 25.0)

    def soft(self, warmer: np.ndarray) -> np.ndarray:
        return 1.0 / (1.0 + self.size * warmer)

    def warmth(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Histories:
        slow = super().warmth(tests, u, force)
        core = [
            first_order(power(test, x, f) / self.capacity, np.full(test.n - 1, 1.0 / self.quick), test.h, 0.0)
            for test, x, f in zip(tests, u, force, strict=True)
        ]
        return [self.share * s + (1.0 - self.share) * c for s, c in zip(slow, core, strict=True)]


class LossFirst(Heating):
    """Dashpots lose more than springs."""

    form = "loss_first"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        super().shape(rng, tests)
        self.elastic = rng.uniform(0.2, 0.6)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        soft = [self.soft(w) for w in self.warmth(tests, u, force)]
        return [(f**self.elastic, f, f) for f in soft]


FORMS = (Exponential, TwoNodes, LossFirst)
