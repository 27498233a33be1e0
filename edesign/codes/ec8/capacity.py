"""Capacity design of steel structures: what all types share, EN 1998-1:2004, 4.4.2.6, 6.5.5, 6.6.3(1), 6.7.4(1)."""

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

    Raises:
        InputError: a resistance is not greater than zero, or a demand is not a number.

    Source: EN 1998-1:2004, 6.6.3(1) and 6.7.4(1).
    """
    check_positive(resistance=resistance)
    check_not_negative(demand=np.abs(demand))
    R, E = np.broadcast_arrays(np.asarray(resistance, dtype=float), np.abs(np.asarray(demand, dtype=float)))
    return np.divide(R, E, out=np.full(R.shape, np.inf), where=E > 0.0)


def amplified_effect(E_G: ArrayLike, E_E: ArrayLike, Omega: float, gamma_ov: float = 1.25) -> np.ndarray:
    """Return E_Ed = E_Ed,G + 1.1 gamma_ov Omega E_Ed,E of members that must not yield, in the unit of the effects.

    Args:
        E_G: effect of the non-seismic actions in the seismic combination.
        E_E: effect of the design seismic action, with sign.
        Omega: least overstrength of the dissipative members, see `overstrength`.
        gamma_ov: material overstrength (`NationalParameters.gamma_ov`).

    Raises:
        InputError: a factor is not greater than zero or not finite.

    Source: EN 1998-1:2004, 6.6.3(1)P, Eq. 6.6 (columns of moment frames); 6.7.4(1), Eq. 6.12 (columns and beams of
        braced frames).
    """
    check_positive(Omega=Omega, gamma_ov=gamma_ov)
    return np.asarray(np.asarray(E_G, dtype=float) + OVERSTRENGTH * gamma_ov * Omega * np.asarray(E_E, dtype=float))


def connection_resistance(R_fy: ArrayLike, gamma_ov: float = 1.25) -> np.ndarray:
    """Return 1.1 gamma_ov R_fy: what a non-dissipative connection of a dissipative member must resist at least.

    Args:
        R_fy: plastic resistance of the connected member by its design yield stress.
        gamma_ov: material overstrength.

    Source: EN 1998-1:2004, 6.5.5(3), Eq. 6.1.
    """
    check_positive(R_fy=R_fy, gamma_ov=gamma_ov)
    return np.asarray(OVERSTRENGTH * gamma_ov * np.asarray(R_fy, dtype=float))


def foundation_effect(E_G: ArrayLike, E_E: ArrayLike, Omega: float, q: float) -> np.ndarray:
    """Return E_Fd = E_F,G + gamma_Rd Omega E_F,E, the effect on a foundation; gamma_Rd is 1.2 for q above 3, else 1.

    Args:
        E_G: effect of the non-seismic actions in the seismic combination.
        E_E: effect of the design seismic action, with sign.
        Omega: R_di / E_di <= q of the dissipative member that has most influence on the effect; larger values count
            as q.
        q: behaviour factor.

    Source: EN 1998-1:2004, 4.4.2.6(4), Eq. 4.30. For columns of moment frames Omega is M_Rd / M_Ed at the base (5), for
        concentric bracings the least of all diagonals (7).
    """
    check_positive(Omega=Omega, q=q)
    gamma_Rd = 1.2 if q > HIGH_Q else 1.0
    return np.asarray(np.asarray(E_G, dtype=float) + gamma_Rd * min(Omega, q) * np.asarray(E_E, dtype=float))
