"""Tests with a known residual: a spring and a dashpot of fractional power predicted, and a known force beside them."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.series import Residual
from edesign.calibration.residual.shape import describe_residual

RATE = 250.0  # Hz
K, C, ALPHA = 8e6, 30e3, 0.4  # N/m; N at 10 mm/s
NOISE = 300.0  # N

Extra = Callable[["Example"], np.ndarray | float]


class Example:
    """A sine with whole cycles, or a sum of four, with its exact velocity.

    Args:
        order: of the test.
        amplitude: m.
        frequencies: Hz; one is a steady sine.
        duration: s.
    """

    def __init__(self, order: int, amplitude: float, frequencies: tuple[float, ...], duration: float = 12.0) -> None:
        self.order, self.frequency = order, frequencies[0]
        self.time = np.arange(0.0, duration, 1.0 / RATE)
        omega = 2.0 * np.pi * np.array(frequencies)
        phase = np.arange(len(frequencies)) * 1.7
        scale = amplitude / len(frequencies)
        self._parts = (omega, phase, scale)
        self.displacement, self.velocity = self.at(self.time)
        self.predicted = force(self.displacement, self.velocity)

    def at(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Displacement and velocity at any time."""
        omega, phase, scale = self._parts
        angle = np.multiply.outer(time, omega) + phase
        return scale * np.sum(np.sin(angle), axis=-1), scale * np.cos(angle) @ omega


def force(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return K * u + C * np.sign(v) * np.abs(v / 0.01) ** ALPHA


MOTIONS = (
    *((8e-3, (0.5,)), (4e-3, (1.0,)), (12e-3, (1.0,)), (8e-3, (3.0,)), (8e-3, (0.25,))),
    (14e-3, (0.31, 0.83, 1.57, 2.9)),
)
"""Amplitude in m and frequencies in Hz of each test."""


@cache
def examples() -> tuple[Example, ...]:
    return tuple(Example(i, *motion) for i, motion in enumerate(MOTIONS))


@cache
def cycles() -> tuple[Cycles, ...]:
    """Cycles of each test, found once."""
    return tuple(Cycles(example.time, example.displacement) for example in examples())


def described(extra: Extra = lambda example: 0.0, noise: float = NOISE) -> str:
    """What is left of the campaign, in words."""
    return describe_residual(campaign(extra, noise), cycles())


def campaign(extra: Extra = lambda example: 0.0, noise: float = NOISE, seed: int = 3) -> list[Residual]:
    """Six tests: five sines of 0.25 to 3 Hz and a random motion."""
    rng = np.random.default_rng(seed)
    return [
        Residual(
            f"test {e.order}",
            e.order,
            "fit",
            e.time,
            e.displacement,
            e.velocity,
            e.predicted + extra(e) + noise * rng.standard_normal(e.time.size),
            e.predicted,
            20.0 + 5.0 * (e.order % 3),
        )
        for e in examples()
    ]
