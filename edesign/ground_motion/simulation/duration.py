"""Duration of the strong motion: of the rupture and of the waves' spreading on their way."""

from __future__ import annotations

import numpy as np

from edesign.ground_motion.simulation.distance import effective_distance
from edesign.ground_motion.simulation.parameters import Crust
from edesign.ground_motion.simulation.source import source_duration


def path_duration(distance: float, crust: Crust) -> float:
    """Return what the path adds to the duration, in s.

    Args:
        distance: point-source distance, m.
        crust: parameters of the crust.

    Source: Boore & Thompson (2014, BSSA 104, 2541-2552), Table 1.
    """
    distances, durations = zip(*crust.path_duration, strict=True)
    beyond = max(0.0, distance - distances[-1])
    return float(np.interp(distance, distances, durations)) + crust.path_duration_slope * beyond


def ground_motion_duration(magnitude: float, distance: float, crust: Crust) -> float:
    """Return the duration T_gm of the ground motion, in s.

    Args:
        magnitude: moment magnitude.
        distance: closest distance to the rupture, m.
        crust: parameters of the crust.
    """
    return source_duration(magnitude, crust) + path_duration(effective_distance(magnitude, distance, crust), crust)
