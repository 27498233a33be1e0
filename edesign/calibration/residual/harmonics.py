"""Harmonics of force and residual in the steady cycles of periodic tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.calibration.residual.motion import Motion, Steady
from edesign.calibration.residual.record import Residual

HIGHEST = 7
_PER_CYCLE = 4 * HIGHEST  # samples at least


@dataclass(frozen=True)
class Harmonics:
    """Fourier coefficients over whole cycles; the displacement is U sin(theta).

    Attributes:
        test: name.
        frequency: Hz.
        amplitude: U, m.
        force, residual: (8, 2) N: of sin(k theta), in phase with the displacement, and of cos(k theta), in
            quadrature (k = 1: in phase with the velocity); of k = 0 the mean, and 0.
    """

    test: str
    frequency: float
    amplitude: float
    force: np.ndarray
    residual: np.ndarray


def harmonics(test: Residual, motion: Motion) -> tuple[Harmonics, ...]:
    """Harmonics 0 to 7 of each steady part of a test; none if it is not periodic."""
    parts = (_of_part(test, part) for part in motion.steady_parts())
    return tuple(part for part in parts if part is not None)


def _of_part(test: Residual, part: Steady) -> Harmonics | None:
    inside = part.samples(test.time)
    time = test.time[inside]
    if time.size < _PER_CYCLE * part.cycles:
        return None
    phase = 2.0 * np.pi * (time - part.start) / part.period
    displacement = coefficients(phase, test.displacement[inside])[0]
    shift = float(np.arctan2(displacement[1, 1], displacement[1, 0]))
    theta = phase + shift
    force, prediction = coefficients(theta, test.measured[inside], test.predicted[inside])
    amplitude = float(np.hypot(*displacement[1]))
    return Harmonics(test.name, 1.0 / part.period, amplitude, force, force - prediction)


def coefficients(phase: np.ndarray, *channels: np.ndarray) -> np.ndarray:
    """Least squares coefficients (channels, 8, 2) of sin(k phase) and cos(k phase); of k = 0 the mean, and 0.

    Over whole cycles the functions are all but orthogonal, so the normal equations lose no digits.
    """
    angle = np.multiply.outer(np.arange(1, HIGHEST + 1), phase)
    rows = np.vstack((np.ones((1, phase.size)), np.sin(angle), np.cos(angle)))
    found = np.linalg.solve(rows @ rows.T, rows @ np.array(channels).T).T
    result = np.zeros((len(channels), HIGHEST + 1, 2))
    result[:, 0, 0] = found[:, 0]
    result[:, 1:, 0], result[:, 1:, 1] = found[:, 1 : HIGHEST + 1], found[:, HIGHEST + 1 :]
    return result
