"""Displacements of the design seismic action, EN 1998-1:2004, 4.3.4."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_positive


def design_displacement(d_e: ArrayLike, q_d: float, d_elastic: ArrayLike | None = None) -> np.ndarray:
    """Return d_s = q_d d_e, in the unit and shape of `d_e`; also storey drifts, which are differences of such.

    Args:
        d_e: displacement from the linear analysis with the design spectrum, any sign.
        q_d: behaviour factor of displacements, q unless said otherwise.
        d_elastic: the same displacement from the elastic spectrum; d_s need not be larger. None takes q_d d_e as it is.

    Raises:
        InputError: q_d is not greater than zero.

    Source: EN 1998-1:2004, 4.3.4(1)P, Eq. 4.23, and (3). Where beta a_g bounds the design spectrum, q_d d_e exceeds the
        elastic value, and (3) takes that excess away. For T_1 < T_C the note to (1)P expects q_d above q.
    """
    check_positive(q_d=q_d)
    d_s = q_d * np.asarray(d_e, dtype=float)
    if d_elastic is None:
        return d_s
    return np.sign(d_s) * np.minimum(np.abs(d_s), np.abs(np.asarray(d_elastic, dtype=float)))
