"""Extremes of what a specimen went through: laws that they soften may remember them from test to test."""

from __future__ import annotations

import numpy as np

from edesign.calibrate.dampers.trial import Motion
from edesign.calibrate.dampers.turning_points import with_turning_points
from edesign.damper.history import Extremes


def extremes_after(before: Extremes, motion: Motion) -> Extremes:
    """The extremes after a motion, along the cubics between its samples; it begins with a way from rest at zero."""
    deformations, _ = with_turning_points(motion)
    velocities = np.concatenate((motion.velocity, _fastest_between(motion)))
    return (
        max(before[0], float(deformations.max())),
        min(before[1], float(deformations.min())),
        max(before[2], float(velocities.max())),
        min(before[3], float(velocities.min())),
    )


def _fastest_between(motion: Motion) -> np.ndarray:
    """Velocities at which the acceleration of the cubics is zero between samples."""
    v, h = motion.velocity, motion.steps
    rate = motion.ways / h
    # over s = 0..1 the velocity is v0 + 2 b s + 3 c s^2 (cubic through displacement and velocity at both ends)
    b, c = 3.0 * rate - 2.0 * v[:-1] - v[1:], v[:-1] + v[1:] - 2.0 * rate
    inside = (np.abs(b) < np.abs(3.0 * c)) & (b * c < 0.0)
    s = -b[inside] / (3.0 * c[inside])
    return np.asarray(v[:-1][inside] + s * b[inside])
