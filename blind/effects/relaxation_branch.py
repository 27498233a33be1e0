"""More relaxation than the law has: slow or fast Maxwell branches beside the damper."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator
from scipy.signal import lfilter

from blind.effects.base import Effect, Histories, TrueParameters, log_uniform
from blind.programme import Trial


def branch(u: np.ndarray, h: float, stiffness: float, tau: float) -> np.ndarray:
    """Force (n,) of spring and dashpot in series, exact for a velocity held over each step."""
    e = np.exp(-h / tau)
    force = lfilter([stiffness * tau * (1.0 - e) / h], [1.0, -e], np.diff(u))
    return np.concatenate([[0.0], force])


class Maxwell(Effect):
    name, kind = "relaxation_branch", "damper"
    most = 60.0
    tau: float

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        return [branch(x, test.h, self.size, self.tau) for test, x in zip(tests, u, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {"stiffness": (self.size, "kN/mm"), "relaxation_time": (self.tau, "s")}


class Slow(Maxwell):
    form = "slow"
    first = 1.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.tau = log_uniform(rng, 0.15, 5.0)


class Fast(Maxwell):
    form = "fast"
    first, most = 3.0, 400.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.tau = log_uniform(rng, 0.006, 0.02)


class Spectrum(Effect):
    """Four branches over three decades, weights falling as a power of the time (a springpot over a band)."""

    name, kind, form = "relaxation_branch", "damper", "spectrum"
    first, most = 1.0, 200.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.times = log_uniform(rng, 0.01, 0.04) * 10.0 ** np.arange(4)
        self.power = rng.uniform(0.1, 0.5)
        self.weights = self.times**-self.power / np.sum(self.times**-self.power)

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories:
        each = list(zip(self.weights, self.times, strict=True))
        return [
            self.size * np.sum([branch(x, test.h, w, tau) for w, tau in each], axis=0)
            for test, x in zip(tests, u, strict=True)
        ]

    def true_parameters(self) -> TrueParameters:
        return {"sum_of_stiffness": (self.size, "kN/mm"), "shortest": (float(self.times[0]), "s")}


FORMS = (Slow, Fast, Spectrum)
