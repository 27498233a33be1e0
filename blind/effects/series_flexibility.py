"""Rig and braces give way: the damper deforms less than the actuator moves. The size is the flexibility, mm/kN."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.random import Generator

from blind.effects.base import Effect, TrueParameters
from blind.programme import Trial
from blind.series import Joint


class Linear(Effect):
    name, kind, form = "series_flexibility", "rig", "linear"
    first, most = 0.005, 0.5

    def joint(self) -> Joint:
        k = 1.0 / self.size
        return lambda w: (k * w, k)

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (1.0 / self.size, "kN/mm")}


class Stiffening(Effect):
    """Bolts that bed in: k w (1 + (w/w0)^2), doubled at a force."""

    name, kind, form = "series_flexibility", "rig", "stiffening"
    first, most = 0.005, 0.5

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.bedded = rng.uniform(60.0, 200.0)

    def joint(self) -> Joint:
        k = 1.0 / self.size
        curve = k / (0.5 * self.bedded * self.size) ** 2
        return lambda w: (k * w + curve * w**3, k + 3.0 * curve * w * w)

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (1.0 / self.size, "kN/mm"), "bedded": (self.bedded, "kN")}


class Shims(Effect):
    """Soft until the shims are closed, then stiffer, to both sides."""

    name, kind, form = "series_flexibility", "rig", "shims"
    first, most = 0.005, 0.5

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.closed, self.stiffer = rng.uniform(5.0, 25.0), rng.uniform(1.3, 3.0)

    def joint(self) -> Joint:
        k, end = 1.0 / self.size, self.closed * self.size

        def force(w: float) -> tuple[float, float]:
            over = abs(w) - end
            if over <= 0.0:
                return k * w, k
            return (1.0 if w > 0.0 else -1.0) * (self.closed + self.stiffer * k * over), self.stiffer * k

        return force

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (1.0 / self.size, "kN/mm"), "closed": (self.closed, "kN")}


FORMS = (Linear, Stiffening, Shims)
