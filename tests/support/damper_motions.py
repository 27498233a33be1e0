"""Smooth random deformation histories for dampers."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

Array = np.ndarray


class Motion:
    """Sum of five sines from rest in the origin, and its turns.

    Args:
        amplitude: about the largest deformation, m.
        seed: of the sines; their frequencies are 0.3 to 4 Hz.
        duration: s.
        rate: samples a second.
    """

    def __init__(self, amplitude: float, seed: int, duration: float = 3.0, rate: float = 1000.0) -> None:
        rng = np.random.default_rng(seed)
        self.omega = 2.0 * np.pi * rng.uniform(0.3, 4.0, 5)
        self.phase = rng.uniform(0.0, 2.0 * np.pi, 5)
        self.size = 0.4 * amplitude * rng.uniform(0.5, 1.5, 5)
        self.time = np.arange(0.0, duration, 1.0 / rate)

    def u(self, t: Array | float) -> Array:
        """Deformation, m."""
        t = np.asarray(t)
        return (1.0 - np.exp(-3.0 * t * t)) * (np.sin(np.multiply.outer(t, self.omega) + self.phase) @ self.size)

    def v(self, t: Array | float) -> Array:
        """Velocity, m/s."""
        t = np.asarray(t)
        angle, fading = np.multiply.outer(t, self.omega) + self.phase, np.exp(-3.0 * t * t)
        return (1.0 - fading) * (np.cos(angle) @ (self.size * self.omega)) + 6.0 * t * fading * (
            np.sin(angle) @ self.size
        )

    def turns(self) -> list[float]:
        """Times at which the velocity changes sign."""
        v = self.v(self.time)
        changes = np.flatnonzero(v[1:] * v[:-1] < 0.0)
        return [brentq(self.v, self.time[i], self.time[i + 1], xtol=1e-15) for i in changes]

    def pieces(self) -> list[tuple[float, float]]:
        """Start and end of each monotone piece."""
        ends = [0.0, *self.turns(), float(self.time[-1])]
        return list(zip(ends[:-1], ends[1:], strict=True))
