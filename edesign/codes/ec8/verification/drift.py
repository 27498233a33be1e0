"""Storey drift for damage limitation, EN 1998-1:2004, 4.4.3.2."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.names import unknown
from edesign.codes.quantities import check_positive

DRIFT_LIMITS = {"brittle": 0.005, "ductile": 0.0075, "none_attached": 0.010}
"""Limits of nu d_r / h by the non-structural elements: brittle, ductile, or none attached (or free to move).

Source: EN 1998-1:2004, 4.4.3.2(1) a, b, c, Eqs. 4.31-4.33.
"""


def drift_limit(elements: str) -> float:
    """Return the limit of nu d_r / h for non-structural elements.

    Args:
        elements: `brittle`, `ductile` or `none_attached`.

    Raises:
        InputError: there is no such kind.

    Source: EN 1998-1:2004, 4.4.3.2(1).
    """
    if elements not in DRIFT_LIMITS:
        raise unknown("kind of non-structural elements", elements, DRIFT_LIMITS)
    return DRIFT_LIMITS[elements]


def reduced_drift(d_r: ArrayLike, h: ArrayLike, nu: float) -> np.ndarray:
    """Return nu d_r / h, to be compared with `drift_limit`.

    Args:
        d_r: design storey drift, m, any sign.
        h: storey height, m.
        nu: for the lower return period of this requirement (`NationalParameters.nu`).

    Returns:
        Dimensionless, in the shape of the arguments.

    Raises:
        InputError: a height or nu is not greater than zero.

    Source: EN 1998-1:2004, 4.4.3.2(1) and (2).
    """
    check_positive(h=h, nu=nu)
    return np.asarray(nu * np.abs(np.asarray(d_r, dtype=float)) / np.asarray(h, dtype=float))
