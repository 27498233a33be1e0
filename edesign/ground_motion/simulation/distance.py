"""Distance of the point source that stands for a whole fault."""

from __future__ import annotations

import math

from edesign.ground_motion.simulation.parameters import Crust


def pseudo_depth(magnitude: float, crust: Crust) -> float:
    """Return the depth h(M), in m, that keeps the motion near a fault of finite size finite.

    Two straight lines of log10 h over magnitude, joined by a parabola that has the slope of each at its ends.

    Args:
        magnitude: moment magnitude.
        crust: parameters of the crust.

    Source: Yenier & Atkinson (2014; 2015, BSSA 105, 1989-2009); joined as by Boore & Thompson (2015).
    """
    (intercept_small, slope_small), (intercept_large, slope_large) = crust.pseudo_depth
    if slope_small == slope_large:
        return float(1e3 * 10.0 ** (intercept_small + slope_small * magnitude))
    crossing = (intercept_large - intercept_small) / (slope_small - slope_large)
    start, end = crossing - 0.5 * crust.pseudo_depth_blend, crossing + 0.5 * crust.pseudo_depth_blend
    if magnitude >= end:
        log_depth = intercept_large + slope_large * magnitude
    else:
        log_depth = intercept_small + slope_small * magnitude
        if magnitude > start:
            bend = (slope_large - slope_small) / (2.0 * crust.pseudo_depth_blend)
            log_depth += bend * (magnitude - start) ** 2
    return float(1e3 * 10.0**log_depth)


def effective_distance(magnitude: float, distance: float, crust: Crust) -> float:
    """Return the point-source distance R_ps = sqrt(R^2 + h^2), in m.

    Args:
        magnitude: moment magnitude.
        distance: closest distance R to the rupture, m.
        crust: whose pseudo-depth h is taken.

    Source: Boore & Thompson (2015), after Atkinson & Silva (2000, BSSA 90, 255-274).
    """
    return math.hypot(distance, pseudo_depth(magnitude, crust))
