"""The rubber does not follow gamma_T of Table 4.4."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, TrueParameters, either
from blind.law import Parameters, stiffened
from blind.programme import Trial

_LOSSY = ("c1", "k1", "c_NL", "c_a", "c_b")


class Arrhenius(Effect):
    """All moduli times exp(b (1/T - 1/T0)) more or less than declared, absolute temperatures."""

    name, kind, form, needs = "temperature_law", "damper", "arrhenius", "temperatures"
    first, most = 2000.0, 20000.0  # K

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense = either(rng)

    def parameters(self, test: Trial, p: Parameters) -> Parameters:
        at = self.sense * self.size * (1.0 / (273.15 + test.temperature) - 1.0 / 293.15)
        return stiffened(p, float(np.exp(at)))

    def true_parameters(self) -> TrueParameters:
        # near 20 degC, per kelvin of warming
        return {"activation": (self.sense * self.size, "K"), "rate": (self.sense * self.size / 293.15**2, "1/K")}


class ShiftOfLoss(Effect):
    """Dashpots follow a WLF shift of their own, springs the table."""

    name, kind, form, needs = "temperature_law", "damper", "wlf_of_loss", "temperatures"
    first, most = 3.0, 60.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense, self.second = either(rng), rng.uniform(40.0, 100.0)

    def parameters(self, test: Trial, p: Parameters) -> Parameters:
        warmer = test.temperature - 20.0
        factor = float(np.exp(-self.sense * self.size * warmer / (self.second + warmer)))
        return {name: value * factor if name in _LOSSY else value for name, value in p.items()}

    def true_parameters(self) -> TrueParameters:
        return {"c1": (self.sense * self.size, "1"), "c2": (self.second, "K")}


class Transition(Effect):
    """Softer, or stiffer, above a temperature, over some degrees."""

    name, kind, form, needs = "temperature_law", "damper", "transition", "temperatures"
    most = 0.85

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense, self.width = either(rng), rng.uniform(2.0, 6.0)
        self.at = rng.uniform(24.0, 31.0)

    def parameters(self, test: Trial, p: Parameters) -> Parameters:
        def step(t: float) -> float:
            return 0.5 * (1.0 + float(np.tanh((t - self.at) / self.width)))

        return stiffened(p, 1.0 - self.sense * self.size * (step(test.temperature) - step(20.0)))

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.sense * self.size, "1"), "at": (self.at, "degC")}


FORMS = (Arrhenius, ShiftOfLoss, Transition)
