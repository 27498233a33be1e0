"""The way a motion goes, with the turning points between its samples: for operators that remember reversals."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from edesign.calibrate.dampers.trial import Motion

_KEPT = 32  # motions


@lru_cache(maxsize=_KEPT)
def with_turning_points(motion: Motion) -> tuple[np.ndarray, np.ndarray]:
    """Displacements in order, monotone from one to the next: the samples, and extremes of the cubics between them.

    At 30 samples in a cycle the largest sample may be 0.5 % short of the extreme, which matters beside a play of 1 %.

    Returns:
        Displacements (m,) m, and the index (n,) of each sample among them.
    """
    u, v, h = motion.displacement, motion.velocity, motion.steps
    turned = np.flatnonzero(v[:-1] * v[1:] < 0.0)
    index = np.arange(u.size)
    if not turned.size:
        return u, index
    u0, u1, step = u[turned], u[turned + 1], h[turned]
    v0, v1 = v[turned] * step, v[turned + 1] * step
    # velocity of the cubic over s = 0..1: v0 + 2 b s + 3 c s^2; it has one root there, by the form that never cancels
    b, c = 3.0 * (u1 - u0) - 2.0 * v0 - v1, 2.0 * (u0 - u1) + v0 + v1
    root = np.sqrt(np.maximum(b**2 - 3.0 * c * v0, 0.0))
    s = np.clip(-v0 / (b - np.sign(v0) * root), 0.0, 1.0)
    points = np.insert(u, turned + 1, u0 + s * (v0 + s * (b + s * c)))
    index[1:] += np.cumsum(v[:-1] * v[1:] < 0.0)
    return points, index
