"""Second-order effects (P-Delta) in the seismic design situation, EN 1998-1:2004, 4.4.2.2."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive
from edesign.errors import InputError

Treatment = Literal["none", "amplify", "analyse", "refuse"]

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

    Raises:
        InputError: a storey has no shear or no height, or a load is negative.

    Source: EN 1998-1:2004, 4.4.2.2(2), Eq. 4.28; Dlubal, knowledge base 001866.
    """
    V = np.abs(np.asarray(V_tot, dtype=float))
    check_not_negative(P_tot=P_tot)
    check_positive(V_tot=V, h=h)
    return np.asarray(np.asarray(P_tot) * np.abs(np.asarray(d_r, dtype=float)) / (V * np.asarray(h)))


def treatment(theta: float) -> Treatment:
    """Return what theta asks for: `none`, `amplify` by 1/(1 - theta), `analyse` with second order, or `refuse`.

    Source: EN 1998-1:2004, 4.4.2.2(2)-(4); the same three limits in Dlubal, knowledge base 001866.
    """
    check_not_negative(theta=theta)
    if theta <= NEGLIGIBLE:
        return "none"
    if theta <= AMPLIFIED:
        return "amplify"
    return "analyse" if theta <= LARGEST else "refuse"


def amplification(theta: ArrayLike) -> np.ndarray:
    """Return the factor on the effects of the seismic action: 1 up to theta = 0.1, 1/(1 - theta) up to 0.2.

    Raises:
        InputError: a theta is above 0.2, where the factor does not do; above 0.3 nothing does.

    Source: EN 1998-1:2004, 4.4.2.2(2)-(4).
    """
    values = np.asarray(theta, dtype=float)
    check_not_negative(theta=values)
    worst = float(values.max(initial=0.0))
    if worst > LARGEST:
        raise InputError(f"theta = {worst:.3g} is above {LARGEST}: the structure is too flexible (4.4.2.2(4))")
    if worst > AMPLIFIED:
        raise InputError(f"theta = {worst:.3g} is above {AMPLIFIED}: 1/(1 - theta) does not do (4.4.2.2(3))")
    return np.where(values > NEGLIGIBLE, 1.0 / (1.0 - values), 1.0)
