"""Spectrum of the earthquake source: one corner frequency, or two where the crust has them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.ground_motion.simulation.parameters import Crust

_REFERENCE_DISTANCE = 1.0e3  # m: where the source spectrum is taken


@dataclass(frozen=True)
class Corners:
    """Corner frequencies of a source, Hz, equal if only one, and the share of the moment that has the upper one."""

    lower: float
    upper: float
    upper_share: float


def seismic_moment(magnitude: float) -> float:
    """Return the seismic moment M_0, N m.

    Source: Hanks & Kanamori (1979), as Boore (2003) has it for dyn cm: M = 2/3 log10 M_0 - 10.7.
    """
    return float(10.0 ** (1.5 * (magnitude + 10.7) - 7.0))


def corner_frequency(magnitude: float, crust: Crust) -> float:
    """Return the corner frequency f_c that belongs to the stress drop, in Hz.

    Args:
        magnitude: moment magnitude.
        crust: parameters of the crust.

    Source: Brune (1970, 1971), as in Boore (2003): 4.906e6 beta (stress drop / M_0)^(1/3) in km/s, bar and dyn cm.
    """
    return float(0.4906 * crust.shear_velocity * (crust.stress_drop / seismic_moment(magnitude)) ** (1.0 / 3.0))


def corners(magnitude: float, crust: Crust) -> Corners:
    """Return the corners; of two, the upper one is such that high frequencies are those of the stress drop.

    Args:
        magnitude: moment magnitude.
        crust: parameters of the crust.

    Source: Boore, Di Alessandro & Abrahamson (2014, BSSA 104, 2387-2398), additive double-corner-frequency spectrum.
    """
    single = corner_frequency(magnitude, crust)
    if crust.double_corner is None:
        return Corners(single, single, 1.0)
    (corner, corner_slope), (share, share_slope) = crust.double_corner
    lower = 10.0 ** (corner + corner_slope * magnitude)
    upper_share = 10.0 ** (share + share_slope * magnitude)
    upper = math.sqrt((single**2 - (1.0 - upper_share) * lower**2) / upper_share)
    return Corners(lower, upper, upper_share)


def source(frequency: np.ndarray, magnitude: float, crust: Crust) -> np.ndarray:
    """Return the acceleration spectrum of the source at 1 km.

    Args:
        frequency: (n,) Hz, above zero.
        magnitude: moment magnitude.
        crust: parameters of the crust.

    Returns:
        In the shape of `frequency`, m/s.

    Source: omega-square spectrum of Brune (1970), as in Boore (2003); two corners: Atkinson & Silva (2000).
    """
    scale = crust.radiation * crust.partition * crust.free_surface
    scale /= 4.0 * math.pi * crust.density * crust.shear_velocity**3 * _REFERENCE_DISTANCE
    c = corners(magnitude, crust)
    shape = (1.0 - c.upper_share) / (1.0 + (frequency / c.lower) ** 2)
    shape += c.upper_share / (1.0 + (frequency / c.upper) ** 2)
    return np.asarray((2.0 * math.pi * frequency) ** 2 * scale * seismic_moment(magnitude) * shape)


def source_duration(magnitude: float, crust: Crust) -> float:
    """Return the duration of the source, in s: 1 / f_c of one corner, the mean of both reciprocals of two.

    Args:
        magnitude: moment magnitude.
        crust: parameters of the crust.

    Source: Hanks & McGuire (1981); Boore (2003); equal weights: Boore & Thompson (2015).
    """
    c = corners(magnitude, crust)
    return 0.5 / c.lower + 0.5 / c.upper
