"""Sinusoidal tests that effects of the instruments are applied to."""

from __future__ import annotations

import numpy as np

from edesign.calibrate.dampers.trial import Motion, Sizes, Trial

ROUNDING = 1e-9
W = 2.0 * np.pi


def sine_trial(rate: float, duration: float, frequency: float = 1.0, order: int = 0, amplitude: float = 0.01) -> Trial:
    """A test under a sine, Hz and m, with the force of a spring of 1e7 N/m, so many samples a second."""
    time = 0.37 + np.arange(int(round(duration * rate)) + 1) / rate
    angle = W * frequency * (time - time[0])
    u = amplitude * np.sin(angle)
    v = amplitude * W * frequency * np.cos(angle)
    motion = Motion(time, u, v, -((W * frequency) ** 2) * u)
    return Trial(f"test {order + 1}", "fit", order, motion, 1e7 * u, np.full(time.size, 20.0))


def sine_sizes(tests: int = 1) -> Sizes:
    """Sizes of so many tests under a sine of 10 s."""
    return Sizes.of([sine_trial(100.0, 10.0, order=i) for i in range(tests)])


def noisy_forces(trials: list[Trial], seed: int) -> list[np.ndarray]:
    """White noise of 20 N in place of the force of each test."""
    rng = np.random.default_rng(seed)
    return [rng.normal(scale=20.0, size=t.force.size) for t in trials]


def share_left(columns: np.ndarray, values: np.ndarray) -> float:
    """What a sum of columns leaves of values, of their norm."""
    rest = values - columns @ np.linalg.lstsq(columns, values, rcond=None)[0]
    return float(np.linalg.norm(rest) / np.linalg.norm(values))
