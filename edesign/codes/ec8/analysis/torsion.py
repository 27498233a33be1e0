"""Accidental torsion, EN 1998-1:2004, 4.3.2 and 4.3.3.3.3."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive

ECCENTRICITY = 0.05
"""e_ai / L_i. Source: EN 1998-1:2004, 4.3.2(1)P, Eq. 4.3."""


def accidental_eccentricity(L: ArrayLike, ratio: float = ECCENTRICITY) -> np.ndarray:
    """Return e_ai = 0.05 L_i, m, in the shape of `L`; it acts to either side, and to the same side at all floors.

    Args:
        L: dimension of the floor at right angles to the seismic action, m.
        ratio: e_ai / L_i, if another one than that of the code is wanted.

    Raises:
        InputError: a length is not greater than zero, or the ratio is negative.

    Source: EN 1998-1:2004, 4.3.2(1)P, Eq. 4.3.
    """
    check_positive(L=L)
    check_not_negative(ratio=ratio)
    return ratio * np.asarray(L, dtype=float)


def accidental_moments(F: ArrayLike, L: ArrayLike, ratio: float = ECCENTRICITY) -> np.ndarray:
    """Return M_ai = e_ai F_i, N m: static moments about the vertical axis that stand for accidental torsion.

    Their effects are added to those of the seismic action with either sign, the same at all floors.

    Args:
        F: (n_floors,) horizontal forces of 4.3.3.2.3 in the direction of the action, N (`lateral_forces`).
        L: floor dimension at right angles to the action, m, see `accidental_eccentricity`.
        ratio: of the accidental eccentricity to L, see `accidental_eccentricity`.

    Returns:
        (n_floors,) M_ai, N m.

    Source: EN 1998-1:2004, 4.3.3.3.3(1), Eq. 4.17, and (2).
    """
    return np.asarray(F, dtype=float) * accidental_eccentricity(L, ratio)
