"""What a hidden effect is: where it acts, what it draws, and what the judge knows of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from numpy.random import Generator

from blind.law import Parameters
from blind.programme import Trial
from blind.series import Joint

Histories = list[np.ndarray]
Factors = list[tuple[np.ndarray | float, np.ndarray | float, np.ndarray | float]]
TrueParameters = dict[str, tuple[float, str]]
"""Parameters with unit."""


class Effect:
    """An effect in one of its forms. A form overrides the places where it acts; `size` scales it, 0 is none.

    Each hook takes all tests of a campaign, in order, so that a form may remember.

    Attributes:
        name, kind, form: what the judge wants to hear.
        needs: what the campaign must have: "temperatures" (several), "trusted" (the declared law is true and kept).
        memory: whether a test depends on those before it.
        first, most: size from which the search starts, and the largest that means anything.
    """

    name: ClassVar[str]
    kind: ClassVar[str]
    form: ClassVar[str]
    needs: ClassVar[str] = ""
    memory: ClassVar[bool] = False
    first: ClassVar[float] = 0.1
    most: ClassVar[float] = 0.9

    def __init__(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.size = self.first
        self.seed = int(rng.integers(2**31))
        self.shape(rng, tests)

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        """Draw what is not the size."""

    def parameters(self, test: Trial, p: Parameters) -> Parameters:
        """Parameters of the law in a test."""
        return p

    def deformation(self, tests: Sequence[Trial], u: Histories) -> Histories:
        """Deformation of the damper (n,) mm for the displacement."""
        return u

    def factors(self, tests: Sequence[Trial], u: Histories, force: Histories) -> Factors | None:
        """Factors at samples on what moduli, dashpots, and the power-law dashpot give before relaxation."""
        return None

    def right(self, tests: Sequence[Trial], u: Histories) -> Histories | None:
        """Force at samples (n,) kN that passes the relaxation too."""
        return None

    def parallel(self, tests: Sequence[Trial], u: Histories) -> Histories | None:
        """Force at samples (n,) kN beside the damper, in its deformation."""
        return None

    def joint(self) -> Joint | None:
        """What is in series."""
        return None

    def rig(self, tests: Sequence[Trial], force: Histories) -> Histories:
        """Force at the load cell."""
        return force

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        """Force as recorded."""
        return force

    def displacement_channel(self, tests: Sequence[Trial], x: Histories) -> Histories:
        """Displacement as recorded."""
        return x

    def true_parameters(self) -> TrueParameters:
        """Parameters for the truth file."""
        return {"size": (self.size, "1")}

    def random(self, test: Trial) -> Generator:
        """Random numbers of this effect in a test, the same each time."""
        return np.random.default_rng((self.seed, test.index))


def log_uniform(rng: Generator, low: float, high: float) -> float:
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def either(rng: Generator) -> float:
    """1 or -1."""
    return 1.0 if rng.random() < 0.5 else -1.0


def faded_peak(x: np.ndarray, keep: float) -> np.ndarray:
    """Envelope (n,): the larger of |x| and what is kept of the envelope one sample ago."""
    out, a = [], 0.0
    for value in np.abs(x).tolist():
        a = max(value, a * keep)
        out.append(a)
    return np.array(out)


def first_order(gain: np.ndarray, rate: np.ndarray, h: float, start: float) -> np.ndarray:
    """y (n,) of y' = gain - rate y, both (n-1,) held over each step."""
    e = np.exp(-rate * h)
    add = np.where(rate * h > 1e-9, gain * (1.0 - e) / np.maximum(rate, 1e-30), gain * h)
    out, y = [start], start
    for a, b in zip(e.tolist(), add.tolist(), strict=True):
        y = a * y + b
        out.append(y)
    return np.array(out)
