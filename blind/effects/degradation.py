"""The damper is worn by what it has dissipated, for good."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, log_uniform
from blind.programme import Trial


def work(u: Histories, force: Histories) -> Histories:
    """Largest work done so far (n,) J over all tests."""
    out, before = [], 0.0
    for x, f in zip(u, force, strict=True):
        done = np.concatenate([[0.0], np.cumsum(0.5 * (f[1:] + f[:-1]) * np.diff(x))])
        out.append(np.maximum.accumulate(before + np.maximum(done, 0.0)))
        before = float(out[-1][-1])
    return out


class Linear(Effect):
    """In proportion to the work; the size is the loss at 10 kJ."""

    name, kind, form, memory = "degradation", "damper", "linear", True
    most = 5.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.loss = rng.uniform(0.2, 1.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        worn = [np.minimum(self.size * w / 1e4, 0.9) for w in work(u, force)]
        return [(1.0 - d, 1.0 - self.loss * d, 1.0 - self.loss * d) for d in worn]

    def true_parameters(self) -> TrueParameters:
        return {"loss_at_10_kJ": (self.size, "1")}


class Saturating(Effect):
    """1 - d E/(E + E_half)."""

    name, kind, form, memory = "degradation", "damper", "saturating", True

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.half = log_uniform(rng, 2e3, 2e4)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        worn = [1.0 - self.size * w / (w + self.half) for w in work(u, force)]
        return [(f, f, f) for f in worn]

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "half": (self.half, "J")}


class Fatigue(Effect):
    """Cracks by strain: the stiffness falls with a sum of |u|^m |du|, as a power of it."""

    name, kind, form, memory = "degradation", "damper", "fatigue", True

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.slope, self.power = rng.uniform(1.0, 3.0), rng.uniform(0.6, 1.0)
        self.whole = sum(float(self._damage(test.x)[-1]) for test in tests)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        before = 0.0
        for x in u:
            damage = before + self._damage(x)
            before = float(damage[-1])
            f = 1.0 - self.size * np.minimum(damage / self.whole, 1.2) ** self.power
            out.append((f, 0.5 + 0.5 * f, 0.5 + 0.5 * f))
        return out

    def _damage(self, x: np.ndarray) -> np.ndarray:
        return np.concatenate([[0.0], np.cumsum(np.abs(x[1:]) ** self.slope * np.abs(np.diff(x)))])

    def true_parameters(self) -> TrueParameters:
        return {"loss_at_end": (self.size, "1"), "slope": (self.slope, "1")}


FORMS = (Linear, Saturating, Fatigue)
