"""Map of residuals over displacement and velocity, all tests together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.residual.record import Residual

CELLS = 20  # even: no cell lies across zero


@dataclass(frozen=True)
class ResidualMap:
    """Mean residual of each cell.

    Attributes:
        displacement: (d + 1,) edges, m.
        velocity: (v + 1,) edges, m/s, closer where it is small: tests of all frequencies fill the map.
        mean: (d, v) of the rms force of the tests; nan in cells without samples.
    """

    displacement: np.ndarray
    velocity: np.ndarray
    mean: np.ndarray


def residual_map(tests: Sequence[Residual]) -> ResidualMap:
    """Mean residual over displacement and velocity, each test over its own rms force."""
    u, v = (np.concatenate([getattr(test, name) for test in tests]) for name in ("displacement", "velocity"))
    error = np.concatenate([test.residual / test.rms_force for test in tests])
    even = np.linspace(-1.0, 1.0, CELLS + 1)
    edges = (even * _reach(u), even * np.abs(even) * _reach(v))
    count = np.histogram2d(u, v, edges)[0]
    total = np.histogram2d(u, v, edges, weights=error)[0]
    mean = np.divide(total, count, out=np.full_like(total, np.nan), where=count > 0.0)
    return ResidualMap(*edges, mean)


def _reach(values: np.ndarray) -> float:
    return max(float(np.max(np.abs(values))) * (1.0 + 1e-12), float(np.finfo(float).tiny))
