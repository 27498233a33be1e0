"""The programme of a campaign: which motions, in which order, at which temperatures, how often sampled."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.random import Generator

from blind import law
from blind.signals import SIGNALS

INNER = 2000.0  # Hz: least rate of the integration


@dataclass(frozen=True)
class Trial:
    """A test as it is made.

    Attributes:
        index: 0, 1, .. in the order of the campaign.
        count: tests of the campaign.
        use: fit or validate.
        title: for people.
        x: displacement of the actuator (n,) mm.
        h: step of x, s.
        every: each so many steps a sample is taken.
        temperature: ambient, degC.
        pause: time without motion before the test, s.
    """

    index: int
    count: int
    use: str
    title: str
    x: np.ndarray
    h: float
    every: int
    temperature: float
    pause: float

    @property
    def n(self) -> int:
        return self.x.size

    @cached_property
    def t(self) -> np.ndarray:
        """Times (n,) s."""
        return self.h * np.arange(self.n)

    @cached_property
    def v(self) -> np.ndarray:
        """Velocity of the actuator (n,) mm/s."""
        return law.velocity(self.x, self.h)

    @property
    def name(self) -> str:
        return f"test_{self.index + 1:02d}"


def programme(rng: Generator, temperatures: bool) -> list[Trial]:
    """Draw the tests of a campaign.

    Args:
        rng: random numbers.
        temperatures: whether several are needed.
    """
    fits, validates = (8, 3) if rng.random() < 0.6 else (int(rng.integers(4, 11)), int(rng.integers(2, 5)))
    rate = 500.0 if rng.random() < 0.7 else float(rng.choice([200.0, 250.0, 256.0, 400.0, 1000.0]))
    every = int(np.ceil(INNER / rate))
    kinds = _kinds(rng, fits, ("staircase", "swelling"), ("random", "earthquake"))
    kinds += _kinds(rng, validates, ("earthquake", "random"), ("sine", "chirp", "staircase", "two_tones"))
    uses = ["fit"] * fits + ["validate"] * validates
    order = rng.permutation(len(kinds))
    warmth = _temperatures(rng, [uses[i] for i in order], temperatures)
    largest = rng.uniform(0.4, 0.5)  # strain
    return [
        _trial(rng, index, len(kinds), kinds[i], uses[i], 1.0 / (rate * every), every, warmth[index], largest)
        for index, i in enumerate(order)
    ]


def _kinds(rng: Generator, count: int, *at_least: tuple[str, ...]) -> list[str]:
    """So many kinds of motion, at least one of each group."""
    share = {"sine": 4, "staircase": 2, "swelling": 1.5, "chirp": 1.5, "random": 2, "earthquake": 2, "two_tones": 0.7}
    share["hold"] = 0.7
    weights = np.array(list(share.values()))
    kinds = [str(rng.choice(group)) for group in at_least][:count]
    return kinds + [str(kind) for kind in rng.choice(list(share), count - len(kinds), p=weights / weights.sum())]


def _temperatures(rng: Generator, uses: list[str], needed: bool) -> list[float]:
    if not needed and rng.random() < 0.7:
        return [20.0] * len(uses)
    steps = [20.0, 25.0, 30.0, 35.0]
    while True:
        if rng.random() < 0.6:
            drawn = rng.choice(steps, len(uses))
            if rng.random() < 0.5:
                drawn = np.sort(drawn)  # the chamber is heated once
        else:
            drawn = np.round(rng.uniform(20.0, 35.0, len(uses)), 1)
        fit = drawn[[use == "fit" for use in uses]]
        if np.unique(fit).size >= 3 and fit.max() - fit.min() >= 9.0 and drawn[[u != "fit" for u in uses]].max() > 24.0:
            return [float(value) for value in drawn]


def _trial(
    rng: Generator, index: int, count: int, kind: str, use: str, h: float, every: int, warmth: float, largest: float
) -> Trial:
    length = rng.uniform(13.0, 17.0)
    rest = rng.uniform(0.5, 3.0) if rng.random() < 0.15 else 0.0
    steps = every * int(length / (h * every))
    strain = largest * rng.choice([0.2, 0.4, 0.6, 0.8, 1.0], p=[0.12, 0.18, 0.2, 0.25, 0.25])
    if kind in ("staircase", "swelling", "earthquake"):
        strain = max(strain, 0.6 * largest)
    x, title = SIGNALS[kind](rng, h * np.arange(steps + 1), strain * law.THICKNESS_MM)
    if rest:
        x = np.concatenate([np.zeros(every * int(rest / (h * every))), x])
        title = f"rest, then {title}"
    return Trial(
        index, count, use, title, x, h, every, warmth, float(np.exp(rng.uniform(np.log(120.0), np.log(7200.0))))
    )
