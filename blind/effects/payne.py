"""Amplitude softening that heals: moduli fall while the strains are large and come back when they fade."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Factors, Histories, TrueParameters, faded_peak, first_order, log_uniform
from blind.law import middle, velocity
from blind.programme import Trial
from blind.signals import rise


class LogEnvelope(Effect):
    """In proportion to the logarithm of the fading envelope, between two strains (filled rubber's S-curve)."""

    name, kind, form = "payne", "damper", "log_envelope"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.low, self.high = rng.uniform(0.2, 0.6), rng.uniform(3.0, 7.0)
        self.fade, self.loss = log_uniform(rng, 1.0, 20.0), rng.uniform(0.0, 1.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, deformation in zip(tests, u, strict=True):
            a = faded_peak(deformation, float(np.exp(-test.h / self.fade)))
            s = rise(np.log(np.maximum(a, 1e-6) / self.low) / np.log(self.high / self.low))
            out.append((1.0 - self.size * s, 1.0 - self.loss * self.size * s, 1.0 - self.loss * self.size * s))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "low": (self.low, "mm"), "high": (self.high, "mm"), "fade": (self.fade, "s")}


class Network(Effect):
    """A share of the filler network breaks with the path and heals with time: x' = (1 - x)/heal - x |v|/path."""

    name, kind, form = "payne", "damper", "network"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.heal, self.path = log_uniform(rng, 1.5, 12.0), log_uniform(rng, 15.0, 80.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, deformation in zip(tests, u, strict=True):
            breaking = np.abs(np.diff(deformation)) / test.h / self.path
            whole = first_order(np.full(test.n - 1, 1.0 / self.heal), 1.0 / self.heal + breaking, test.h, 1.0)
            f = 1.0 - self.size * (1.0 - whole)
            out.append((f, f, f))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "heal": (self.heal, "s"), "path": (self.path, "mm")}


class RmsMemory(Effect):
    """With the root mean square of the strain over the last seconds: 1 - d x^2/(1 + x^2)."""

    name, kind, form = "payne", "damper", "rms_memory"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.memory_time, self.half = log_uniform(rng, 0.8, 6.0), rng.uniform(0.7, 3.5)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, deformation in zip(tests, u, strict=True):
            rate = np.full(test.n - 1, 1.0 / self.memory_time)
            square = first_order(middle(deformation) ** 2 * rate, rate, test.h, 0.0)
            x = 2.0 * square / self.half**2
            f = 1.0 - self.size * x / (1.0 + x)
            out.append((f, np.sqrt(f), np.sqrt(f)))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "memory": (self.memory_time, "s"), "half": (self.half, "mm")}


class LossHump(Effect):
    """Softening with the envelope of the velocity's path, and the loss largest half-way down."""

    name, kind, form = "payne", "damper", "loss_hump"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.fade, self.half = log_uniform(rng, 1.5, 10.0), rng.uniform(0.8, 3.0)
        self.power, self.hump = rng.uniform(0.8, 1.6), rng.uniform(0.2, 1.0)

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors:
        out: Factors = []
        for test, deformation in zip(tests, u, strict=True):
            keep = float(np.exp(-test.h / self.fade))
            peak = faded_peak(deformation, keep)
            x = (peak / self.half) ** self.power
            broken = x / (1.0 + x)
            loss = 1.0 - self.size * (broken - 2.0 * self.hump * broken * (1.0 - broken))
            fast = np.abs(velocity(deformation, test.h)) > 0.5
            out.append((1.0 - self.size * broken, loss, np.where(fast, loss, 1.0)))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"depth": (self.size, "1"), "half": (self.half, "mm"), "fade": (self.fade, "s")}


FORMS = (LogEnvelope, Network, RmsMemory, LossHump)
