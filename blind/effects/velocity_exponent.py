"""Another dependence on velocity than the power of the law."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, either, log_uniform
from blind.law import velocity
from blind.programme import Trial


class Dashpot(Effect):
    """An oil dashpot beside the damper, c |v|^p."""

    name, kind, form = "velocity_exponent", "damper", "dashpot"
    first, most = 0.1, 30.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.power = float(rng.choice([rng.uniform(0.12, 0.25), rng.uniform(0.6, 1.0), rng.uniform(1.2, 2.0)]))

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        speeds = [velocity(x, test.h) / 20.0 for test, x in zip(tests, u, strict=True)]
        return [self.size * np.abs(v) ** self.power * np.sign(v) for v in speeds]

    def true_parameters(self) -> TrueParameters:
        return {"force_at_20_mm_s": (self.size, "kN"), "exponent": (self.power, "1")}


class Kink(Effect):
    """Above a velocity the exponent of the law's dashpot is another one; the force is continuous."""

    name, kind, form = "velocity_exponent", "damper", "kink"
    first, most = 0.2, 1.5

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.at, self.sense = rng.uniform(8.0, 40.0), either(rng)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, x in zip(tests, u, strict=True):
            over = np.maximum(np.abs(velocity(x, test.h)) / self.at, 1.0)
            out.append((1.0, 1.0, over ** (self.sense * self.size)))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"velocity": (self.at, "mm/s"), "change_of_exponent": (self.sense * self.size, "1")}


class Eyring(Effect):
    """Thermally activated flow, c asinh(v/v0), through the relaxation."""

    name, kind, form = "velocity_exponent", "damper", "eyring"
    first, most = 0.3, 60.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.scale = log_uniform(rng, 2.0, 30.0)

    def right(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [self.size * np.arcsinh(velocity(x, test.h) / self.scale) for test, x in zip(tests, u, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {"force": (self.size, "kN"), "velocity": (self.scale, "mm/s")}


FORMS = (Dashpot, Kink, Eyring)
