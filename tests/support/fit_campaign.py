"""Synthetic damper tests for fits: short sweeps, sines and random motion, with noise of a known size."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.signals import random, sweep

RATE = 120.0  # Hz
BLOCKS = ((1.5, 0.5), (1.5, 1.0), (1.5, 0.25))


def motions(amplitude: float = 0.008) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Sweeps at three frequencies, whose reversals lie between samples as in a laboratory, and one random motion."""
    found = {f"sweep {f:g} Hz": sweep(amplitude, f, BLOCKS, sampling_rate=RATE) for f in (0.53, 1.57, 3.91)}
    found["random"] = random(5.0, (0.2, 4.0), seed=3, peak=amplitude, sampling_rate=RATE)
    return found


def measured(
    law: str,
    values: Mapping[str, float],
    noise: float = 0.01,
    seed: int = 7,
    temperature_C: float = 20.0,
    only: Sequence[str] | None = None,
    amplitude: float = 0.008,
) -> list[DamperTest]:
    """Forces of a law under `motions`, with white noise of `noise` times the peak force of each test."""
    generator = np.random.default_rng(seed)
    tests = []
    for name, (time, u) in motions(amplitude).items():
        force = Damper(LAWS[law], values).force(time, u)
        force = force + noise * np.max(np.abs(force)) * generator.standard_normal(force.size)
        if only is None or name in only:
            label = f"{name} {temperature_C:g} degC"
            tests.append(DamperTest(label, time, u, force, temperature_C, None, name, "fit", ""))
    return tests
