"""Friction of guides and bearings of the rig: between the load cell and the fixed world."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters, log_uniform
from blind.programme import Trial


class Guides(Effect):
    name, kind = "friction", "rig"
    first, most = 1.0, 60.0

    def rig(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.guide(test, f) for test, f in zip(tests, force, strict=True)]

    def guide(self, test: Trial, force: np.ndarray) -> np.ndarray:
        """Friction (n,) kN."""
        raise NotImplementedError

    def true_parameters(self) -> TrueParameters:
        return {"force": (self.size, "kN")}


class Smoothed(Guides):
    """Coulomb, the sign smoothed by a velocity."""

    form = "coulomb"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.smooth = log_uniform(rng, 0.1, 2.0)

    def guide(self, test: Trial, force: np.ndarray) -> np.ndarray:
        return self.size * np.tanh(test.v / self.smooth)


class Dahl(Guides):
    """Asperities bend before they slip: dF/dx = (F_c/z)(1 - F sgn v/F_c)."""

    form = "dahl"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.presliding = log_uniform(rng, 0.01, 0.2)

    def guide(self, test: Trial, force: np.ndarray) -> np.ndarray:
        f, out = 0.0, [0.0]
        for dx in (np.diff(test.x) / self.presliding).tolist():
            limit = self.size if dx > 0.0 else -self.size
            f = limit + (f - limit) * math.exp(-abs(dx))
            out.append(f)
        return np.array(out)

    def true_parameters(self) -> TrueParameters:
        return {"force": (self.size, "kN"), "presliding": (self.presliding, "mm")}


class LuGre(Guides):
    """Bristles with Stribeck's curve: more when it sticks than when it slides."""

    form = "lugre"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.presliding, self.stick, self.stribeck = (
            log_uniform(rng, 0.01, 0.1),
            rng.uniform(1.05, 1.5),
            rng.uniform(2.0, 15.0),
        )

    def guide(self, test: Trial, force: np.ndarray) -> np.ndarray:
        speed = np.diff(test.x) / test.h
        level = self.size * (1.0 + (self.stick - 1.0) * np.exp(-((speed / self.stribeck) ** 2)))
        forget = np.exp(-self.size / self.presliding * np.abs(speed) * test.h / level)
        f, out = 0.0, [0.0]
        for steady, e in zip((level * np.sign(speed)).tolist(), forget.tolist(), strict=True):
            f = steady + (f - steady) * e
            out.append(f)
        return np.array(out)


class SideLoad(Guides):
    """The guides carry a share of the force: friction with |F| beside a constant."""

    form = "side_load"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.smooth, self.coefficient = log_uniform(rng, 0.1, 1.0), log_uniform(rng, 0.005, 0.04)

    def guide(self, test: Trial, force: np.ndarray) -> np.ndarray:
        return self.size * (1.0 + self.coefficient * np.abs(force)) * np.tanh(test.v / self.smooth)


FORMS = (Smoothed, Dahl, LuGre, SideLoad)
