"""The levels of a hazard as response spectrum functions."""

from __future__ import annotations

import numpy as np

from edesign.exchange.sap2000.model import SpectrumFunction
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.project.actions.hazard_base import Hazard
from edesign.project.notation.units import STANDARD_GRAVITY

_POINTS = 200  # 3.3 % apart: a line between two of them is within 0.1 % of 1 / T2, from 6 / 8 of its square
_LONGEST = 10.0  # s, of functions of spectra without an end; no building has a longer period


def spectrum_functions(hazard: Hazard) -> list[SpectrumFunction]:
    """Return the horizontal elastic spectrum of each level, as periods and accelerations in g."""
    found = []
    for level in hazard.levels:
        spectrum = elastic_spectrum(hazard, level)
        last = min(spectrum.last_period, _LONGEST)
        corners = [T for T in spectrum.corners.values() if 0.0 < T < last]
        first = min([*corners, last]) / 10.0
        periods = np.unique(np.round([0.0, *np.geomspace(first, last, _POINTS), *corners], 9))
        accelerations = np.asarray(spectrum.acceleration(periods)) / STANDARD_GRAVITY
        found.append(SpectrumFunction(level, periods, accelerations, spectrum.damping))
    return found
