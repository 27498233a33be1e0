"""Noise and resolution of the channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from scipy.signal import lfilter

from blind.effects.base import Histories, log_uniform


@dataclass(frozen=True)
class Noise:
    """Of a campaign.

    Attributes:
        force: standard deviation over the root mean square of the force.
        colour: correlation from sample to sample; 0: white.
        resolution: of the force, kN; 0: fine.
        displacement: standard deviation, mm.
    """

    force: float
    colour: float
    resolution: float
    displacement: float


def draw_noise(rng: Generator) -> Noise:
    kind = rng.random()
    return Noise(
        force=log_uniform(rng, 0.001, 0.01),
        colour=rng.uniform(0.2, 0.7) if kind < 0.15 else 0.0,
        resolution=float(rng.choice([0.01, 0.02, 0.05])) if kind > 0.85 else 0.0,
        displacement=float(rng.choice([0.0, rng.uniform(0.0, 0.002)])),
    )


def noisy_force(rng: Generator, noise: Noise, forces: Sequence[np.ndarray]) -> Histories:
    """Samples of the force (m,) kN of each test with noise; its size is the same in all tests."""
    level = noise.force * float(np.sqrt(np.mean(np.concatenate(list(forces)) ** 2)))
    out = []
    for force in forces:
        e = level * rng.standard_normal(force.size)
        if noise.colour:
            e = lfilter([np.sqrt(1.0 - noise.colour**2)], [1.0, -noise.colour], e)
        recorded = force + e
        out.append(noise.resolution * np.round(recorded / noise.resolution) if noise.resolution else recorded)
    return out


def noisy_displacement(rng: Generator, noise: Noise, x: Sequence[np.ndarray]) -> Histories:
    """Samples of the displacement (m,) mm of each test with noise."""
    return [y + noise.displacement * rng.standard_normal(y.size) for y in x]


def thermometer(rng: Generator, ambient: float, n: int) -> np.ndarray:
    """A thermocouple that reads to a tenth (n,) degC."""
    return np.round(ambient + 0.15 * rng.standard_normal() + 0.03 * rng.standard_normal(n), 1)
