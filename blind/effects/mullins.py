"""First cycles stiffer than the later ones, or softening below the largest strain; partly healed between tests."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, log_uniform
from blind.programme import Trial


class Scragging(Effect):
    """Virgin stiffness that depends on the work of a spring: D = exp(-sum |u| |du| / w)."""

    name, kind, form, memory = "mullins", "damper", "scragging", True
    most = 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.work, self.heals = log_uniform(rng, 20.0, 150.0), rng.uniform(0.3, 0.95)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        virgin = 1.0
        for deformation in u:
            work = np.concatenate([[0.0], np.cumsum(np.abs(deformation[1:] * np.diff(deformation)))])
            left = virgin * np.exp(-work / self.work)
            virgin = left[-1] + self.heals * (1.0 - left[-1])
            f = 1.0 + self.size * left
            out.append((f, f, f))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"excess": (self.size, "1"), "work": (self.work, "mm^2"), "heals": (self.heals, "1")}


class Damage(Effect):
    """Below the largest energy W = u^2 the rubber is softer: 1 - s tanh((W_max - W)/(b + 0.3 W_max))."""

    name, kind, form, memory = "mullins", "damper", "pseudo_elastic", True

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.base, self.heals, self.loss = rng.uniform(0.5, 6.0), rng.uniform(0.3, 0.95), rng.uniform(0.0, 0.6)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        kept = 0.0
        for deformation in u:
            energy = deformation**2
            largest = np.maximum.accumulate(np.maximum(energy, kept))
            kept = (1.0 - self.heals) * float(largest[-1])
            s = self.size * np.tanh((largest - energy) / (self.base + 0.3 * largest))
            out.append((1.0 - s, 1.0 - self.loss * s, 1.0 - self.loss * s))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "base": (self.base, "mm^2"), "heals": (self.heals, "1")}


class CycleCount(Effect):
    """Excess stiffness that depends on the number of cycles, counted by path over four times the largest strain."""

    name, kind, form, memory = "mullins", "damper", "cycle_count", True
    most = 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.cycles, self.heals, self.loss = rng.uniform(0.6, 3.0), rng.uniform(0.4, 0.95), rng.uniform(0.3, 1.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        count = 0.0
        for deformation in u:
            largest = np.maximum.accumulate(np.maximum(np.abs(deformation[1:]), 0.3))
            counted = count + np.concatenate([[0.0], np.cumsum(np.abs(np.diff(deformation)) / (4.0 * largest))])
            count = (1.0 - self.heals) * float(counted[-1])
            s = self.size * np.exp(-counted / self.cycles)
            out.append((1.0 + s, 1.0 + self.loss * s, 1.0 + self.loss * s))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"excess": (self.size, "1"), "cycles": (self.cycles, "1"), "heals": (self.heals, "1")}


FORMS = (Scragging, Damage, CycleCount)
