"""The mean cycle of a steady test: the residual over displacement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.calibration.residual.motion import Motion
from edesign.calibration.residual.record import Residual

POINTS = 64


@dataclass(frozen=True)
class Loop:
    """A cycle averaged at equal phase, which runs from a zero of the displacement.

    Attributes:
        displacement: (p,) m.
        residual: (p,) N.
    """

    displacement: np.ndarray
    residual: np.ndarray


def residual_loop(test: Residual, motion: Motion, points: int = POINTS) -> Loop | None:
    """Mean cycle of the longest steady part of a test; None if it is not periodic or sampled too coarsely."""
    part = motion.longest()
    if part is None:
        return None
    inside = part.samples(test.time)
    phase = np.mod((test.time[inside] - part.start) / part.period, 1.0)
    points = min(points, int(phase.size / part.cycles / 2.0))
    number = np.minimum((phase * points).astype(int), points - 1)
    count = np.bincount(number, minlength=points) if points else np.zeros(1)
    if np.min(count) < 1:
        return None

    def mean(values: np.ndarray) -> np.ndarray:
        return np.asarray(np.bincount(number, values[inside], points) / count)

    return Loop(mean(test.displacement), mean(test.residual))
