"""Second-order effects (P-Delta) in the seismic design situation, EN 1998-1:2004, 4.4.2.2."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive

NEGLIGIBLE = 0.1
"""theta up to which second-order effects need not be counted. Source: EN 1998-1:2004, 4.4.2.2(2)."""
AMPLIFIED = 0.2
"""theta up to which 1/(1 - theta) stands for them. Source: EN 1998-1:2004, 4.4.2.2(3)."""
LARGEST = 0.3
"""theta that must not be exceeded. Source: EN 1998-1:2004, 4.4.2.2(4)."""


def drift_sensitivity(P_tot: ArrayLike, d_r: ArrayLike, V_tot: ArrayLike, h: ArrayLike) -> np.ndarray:
    """Return theta = P_tot d_r / (V_tot h) of each storey.

    Args:
        P_tot: gravity load at and above the storey in the seismic design situation, N.
        d_r: design storey drift, difference of the mean d_s at its top and bottom, m, any sign.
        V_tot: seismic storey shear, N, any sign.
        h: storey height, m.

    Returns:
        Dimensionless, in the shape of the arguments.

    Raises:
        InputError: a storey has no shear or no height, or a load is negative.

    Source: EN 1998-1:2004, 4.4.2.2(2), Eq. 4.28; Dlubal, knowledge base 001866.
    """
    V = np.abs(np.asarray(V_tot, dtype=float))
    check_not_negative(P_tot=P_tot)
    check_positive(V_tot=V, h=h)
    return np.asarray(np.asarray(P_tot) * np.abs(np.asarray(d_r, dtype=float)) / (V * np.asarray(h)))
