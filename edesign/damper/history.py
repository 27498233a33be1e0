"""Deformation histories as the laws see them."""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike

Extremes = tuple[float, float, float, float]
"""Largest and smallest deformation, m, largest and smallest velocity, m/s."""
NONE: Extremes = (0.0, 0.0, 0.0, 0.0)
"""Of a damper that has not moved."""


def spline_velocity(time: ArrayLike, deformation: ArrayLike) -> np.ndarray:
    """Return the velocity at the samples of the cubic spline through a deformation.

    With less than four samples it is that of the polynomial through them.

    Args:
        time: (n,) s, ascending.
        deformation: (n,) m.

    Returns:
        (n,) m/s.
    """
    t, u = np.asarray(time, dtype=float), np.asarray(deformation, dtype=float)
    if t.size < 2:
        return np.zeros_like(u)
    return np.asarray(scipy.interpolate.CubicSpline(t, u)(t, 1), dtype=float)


_PHASE = 0.05
"""Share of the work in what force and motion could do at most, below which a sign is left open. Of a sine it is pi/2
times the sine of the phase: 1.8 degrees, which a filter of a load cell shifts by 5 ms at 1 Hz."""


def sign_questionable(displacement: np.ndarray, force: np.ndarray) -> bool:
    """Return whether the force or the displacement of a passive device seems to have the other sign.

    A passive device gives back no more than it has stored when the test starts, which is at most what a spring of its
    first force gives over the whole range. Nor does it push the way it is pushed.

    Args:
        displacement: (n,) m.
        force: (n,) N.
    """
    steps, means = np.diff(displacement), 0.5 * (force[1:] + force[:-1])
    at_most = max(float(np.sum(np.abs(means * steps))), 1e-300)
    work = float(np.sum(means * steps))
    least = _PHASE * at_most + 0.5 * abs(float(force[0])) * float(np.ptp(displacement))
    if work < -least:
        return True
    moved = displacement - np.mean(displacement)
    along = float(np.dot(force, moved)) / max(float(np.dot(np.abs(force), np.abs(moved))), 1e-300)
    return along < -_PHASE and work < least
