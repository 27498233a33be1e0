"""The specimen is mounted under load: pre-sheared, or with a mass that hangs on it."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters, either
from blind.programme import Trial


class PreShear(Effect):
    """The damper works about a deformation of its own; the load cell shows its force."""

    name, kind, form = "static_offset", "rig", "pre_shear"
    first, most = 0.2, 6.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def deformation(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [x + self.side * self.size for x in u]

    def true_parameters(self) -> TrueParameters:
        return {"pre_shear": (self.side * self.size, "mm")}


class Tared(PreShear):
    """Pre-sheared, and the load cell set to zero before each test."""

    form = "pre_shear_tared"

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f - f[0] for f in force]


class HangingMass(Effect):
    """A mass hangs between load cell and damper."""

    name, kind, form = "static_offset", "rig", "hanging_mass"
    first, most = 1.0, 100.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.side = either(rng)

    def rig(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.side * self.size for f in force]

    def true_parameters(self) -> TrueParameters:
        return {"force": (self.side * self.size, "kN")}


FORMS = (PreShear, Tared, HangingMass)
