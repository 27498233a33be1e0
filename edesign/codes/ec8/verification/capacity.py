"""Capacity design of steel structures: what all types share, EN 1998-1:2004, 4.4.2.6, 6.6.3(1), 6.7.4(1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive

OVERSTRENGTH = 1.1
"""Factor beside gamma_ov. Source: EN 1998-1:2004, Eqs. 6.1, 6.6 and 6.12."""
HIGH_Q = 3.0
"""q above which gamma_Rd of foundations is 1.2. Source: EN 1998-1:2004, 4.4.2.6(4)."""


def overstrength(resistance: ArrayLike, demand: ArrayLike) -> np.ndarray:
    """Return Omega_i = R_pl,Rd,i / E_Ed,i of dissipative members; infinite where there is no demand.

    Args:
        resistance: plastic resistance: M_pl,Rd of beams (N m), N_pl,Rd of diagonals (N).
        demand: design value in the seismic design situation, gravity included, in the same unit, any sign.

    Returns:
        Omega_i, dimensionless, in the shape of the arguments.

    Raises:
        InputError: a resistance is not greater than zero, or a demand is not a number.

    Source: EN 1998-1:2004, 6.6.3(1) and 6.7.4(1).
    """
    check_positive(resistance=resistance)
    check_not_negative(demand=np.abs(demand))
    R, E = np.broadcast_arrays(np.asarray(resistance, dtype=float), np.abs(np.asarray(demand, dtype=float)))
    return np.divide(R, E, out=np.full(R.shape, np.inf), where=E > 0.0)


def foundation_factor(Omega: ArrayLike, q: float) -> np.ndarray:
    """Return gamma_Rd Omega, the factor of seismic effects on foundations: E_F,d = E_F,G + gamma_Rd Omega E_F,E.

    gamma_Rd is 1.2 for q above 3, else 1.

    Args:
        Omega: R_di / E_di of the dissipative member that has most influence on the effect; values above q count as q,
            values below 1, of members that fail their own check, as 1.
        q: behaviour factor.

    Returns:
        Dimensionless, in the shape of the arguments.

    Source: EN 1998-1:2004, 4.4.2.6(4), Eq. 4.30. For columns of moment frames Omega is M_Rd / M_Ed at the base, the
        less of both directions (5); for concentric bracings the least of all diagonals (6).
    """
    check_positive(q=q)
    return np.asarray((1.2 if q > HIGH_Q else 1.0) * np.clip(np.asarray(Omega, dtype=float), 1.0, max(q, 1.0)))
