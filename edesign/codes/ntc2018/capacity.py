"""Capacity design of steel buildings, NTC 2018, 7.2.5 and 7.5."""

from __future__ import annotations

from collections.abc import Iterable
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_positive

_HIGH_STRENGTH = 420e6  # Pa, f_y of S420
FOUNDATIONS = MappingProxyType({"low": 1.0, "medium": 1.1, "high": 1.3})
"""Factor on what the superstructure brings to foundations, by class. Source: NTC 2018, 7.2.5."""
BASE_AXIAL_LIMIT = 0.3
"""N_Ed / N_pl,Rd of columns of frames where hinges are expected. Source: NTC 2018, 7.5.3.2, Eq. 7.5.3."""
HOLLOW_BRACES = (18.0, 36.0)
"""Largest width over thickness of the walls of rectangular hollow diagonals, and diameter over thickness of round ones.

Source: NTC 2018, 7.5.5.
"""


def material_overstrength(yield_strengths: Iterable[float]) -> float:
    """Return gamma_ov: 1.25 of S235, S275 and S355, 1.15 of S420 and S460; of several steels the larger one.

    Args:
        yield_strengths: nominal f_y of the steels, Pa.

    Source: NTC 2018, 7.5.1. Steels below S420 that it does not name count as S355.
    """
    return 1.15 if min(yield_strengths) >= _HIGH_STRENGTH else 1.25


def overstrength_beside_gravity(resistance: ArrayLike, gravity: ArrayLike, seismic: ArrayLike) -> np.ndarray:
    """Return Omega_i = (M_pl,Rd - M_Ed,G) / M_Ed,E of beams; infinite where there is no seismic moment.

    Gravity counts against the beam in the sense in which the earthquake adds to it.

    Args:
        resistance: M_pl,Rd, N m.
        gravity: M_Ed,G of the other actions in the seismic combination, N m, any sign.
        seismic: M_Ed,E, N m, any sign.

    Returns:
        Dimensionless; not above zero where gravity alone takes all of the resistance.

    Raises:
        InputError: a resistance is not greater than zero.

    Source: NTC 2018, 7.5.4.2.
    """
    check_positive(resistance=resistance)
    left = np.asarray(resistance, dtype=float) - np.abs(np.asarray(gravity, dtype=float))
    left, E = np.broadcast_arrays(left, np.abs(np.asarray(seismic, dtype=float)))
    return np.divide(left, E, out=np.full(left.shape, np.inf), where=E > 0.0)
