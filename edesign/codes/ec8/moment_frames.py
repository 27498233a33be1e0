"""Moment resisting frames of steel, EN 1998-1:2004, 6.6.

Columns take the amplified effects of `capacity`; joints must satisfy `strong_column`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.capacity import overstrength
from edesign.codes.names import unknown
from edesign.codes.quantities import check_positive
from edesign.errors import InputError

AXIAL_LIMIT = 0.15
"""N_Ed / N_pl,Rd in hinges of beams. Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.3."""
SHEAR_LIMIT = 0.5
"""V_Ed / V_pl,Rd in hinges of beams, and in columns. Source: EN 1998-1:2004, Eqs. 6.4 and 6.7."""


def beam_moment(M_Ed: ArrayLike, M_pl_Rd: ArrayLike) -> np.ndarray:
    """Return M_Ed / M_pl,Rd at the end of a beam, where a hinge is expected; at most 1.

    Args:
        M_Ed: moment in the seismic design situation, N m, any sign.
        M_pl_Rd: plastic moment resistance, N m.

    Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.2.
    """
    return _ratio(M_Ed, M_pl_Rd)


def beam_axial_force(N_Ed: ArrayLike, N_pl_Rd: ArrayLike) -> np.ndarray:
    """Return (N_Ed / N_pl,Rd) / 0.15 at the end of a beam; at most 1.

    Args:
        N_Ed: axial force in the seismic design situation, N, any sign.
        N_pl_Rd: plastic resistance, N.

    Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.3. Where it fails, (3) asks for the rules of EN 1993-1-1, 6.2.9.1.
    """
    return _ratio(N_Ed, N_pl_Rd) / AXIAL_LIMIT


def hinge_shear(M_pl_A: ArrayLike, M_pl_B: ArrayLike, L: ArrayLike) -> np.ndarray:
    """Return V_Ed,M = (M_pl,Rd,A + M_pl,Rd,B) / L, N: shear of a beam with hinges of opposite sign at both ends.

    Args:
        M_pl_A, M_pl_B: plastic resistances at the ends, N m.
        L: distance of the hinges, m.

    Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.5.
    """
    check_positive(M_pl_A=M_pl_A, M_pl_B=M_pl_B, L=L)
    return np.asarray((np.asarray(M_pl_A, dtype=float) + np.asarray(M_pl_B, dtype=float)) / np.asarray(L, dtype=float))


def beam_shear(V_G: ArrayLike, V_M: ArrayLike, V_pl_Rd: ArrayLike) -> np.ndarray:
    """Return ((V_Ed,G + V_Ed,M) / V_pl,Rd) / 0.5 at the end of a beam; at most 1.

    Args:
        V_G: shear by the non-seismic actions in the seismic combination, N, any sign.
        V_M: `hinge_shear`, N.
        V_pl_Rd: plastic shear resistance, N.

    Source: EN 1998-1:2004, 6.6.2(2), Eqs. 6.4 and 6.5.
    """
    return _ratio(np.abs(np.asarray(V_G, dtype=float)) + np.asarray(V_M, dtype=float), V_pl_Rd) / SHEAR_LIMIT


def frame_overstrength(M_pl_Rd: ArrayLike, M_Ed: ArrayLike) -> tuple[float, int]:
    """Return Omega, the least M_pl,Rd / M_Ed of all beam ends with hinges, and which one has it.

    Args:
        M_pl_Rd: (n,) N m.
        M_Ed: (n,) moments in the seismic design situation, N m, any sign.

    Raises:
        InputError: there are no beams, or no beam has a moment.

    Source: EN 1998-1:2004, 6.6.3(1)P.
    """
    ratios = np.atleast_1d(overstrength(M_pl_Rd, M_Ed))
    if not np.isfinite(ratios).any():
        raise InputError("Omega needs beams with moments in the seismic design situation: there are none")
    least = int(np.argmin(ratios))
    return float(ratios[least]), least


def column_shear(V_Ed: ArrayLike, V_pl_Rd: ArrayLike) -> np.ndarray:
    """Return (V_Ed / V_pl,Rd) / 0.5 of a column; at most 1.

    Args:
        V_Ed: shear from the analysis with amplified effects, N, any sign.
        V_pl_Rd: plastic shear resistance, N.

    Source: EN 1998-1:2004, 6.6.3(4), Eq. 6.7.
    """
    return _ratio(V_Ed, V_pl_Rd) / SHEAR_LIMIT


def column_hinge_moment(M_Ed: ArrayLike, M_pl_Rd: ArrayLike) -> np.ndarray:
    """Return the moment where a column is to have a hinge, N m: M_pl,Rd, with the sign of M_Ed.

    That is at the base of the frame, at the top of the uppermost storey, and in buildings of one storey.

    Args:
        M_Ed: from the analysis, N m.
        M_pl_Rd: plastic resistance, N m.

    Source: EN 1998-1:2004, 6.6.3(2) with 6.6.1(1)P.
    """
    check_positive(M_pl_Rd=M_pl_Rd)
    return np.copysign(np.asarray(M_pl_Rd, dtype=float), np.asarray(M_Ed, dtype=float))


def web_panel_shear(M_beams: ArrayLike, z: ArrayLike, V_columns: ArrayLike = 0.0) -> np.ndarray:
    """Return V_wp,Ed = sum M / z - V_c, N: shear of the web panel of a column at hinges of the adjacent beams.

    Args:
        M_beams: sum of the plastic resistances of the beams at the joint, which turn it the same way, N m.
        z: lever arm, distance between the centres of the beam flanges, m.
        V_columns: mean shear of the columns above and below, which relieves the panel, N; 0 is on the safe side.

    Source: EN 1998-1:2004, 6.6.3(6); EN 1993-1-8:2005, 5.3(3), Eq. 5.3.
    """
    check_positive(M_beams=M_beams, z=z)
    relieved = np.asarray(M_beams, dtype=float) / np.asarray(z, dtype=float) - np.asarray(V_columns, dtype=float)
    return np.asarray(relieved)


def web_panel_resistance(A_vc: ArrayLike, f_y: ArrayLike, gamma_M0: float = 1.0) -> np.ndarray:
    """Return V_wp,Rd = 0.9 f_y A_vc / (sqrt(3) gamma_M0), N, of an unstiffened web panel.

    It holds as long as `web_panel_slenderness` is at most 1.

    Args:
        A_vc: shear area of the column, m2.
        f_y: yield stress of its web, Pa.
        gamma_M0: partial factor.

    Source: EN 1993-1-8:2005, 6.2.6.1(1) and (2), Eq. 6.7; EN 1998-1:2004, 6.6.3(6), Eq. 6.8, asks for
        V_wp,Ed <= V_wp,Rd, and need not count axial force and bending.
    """
    check_positive(A_vc=A_vc, f_y=f_y, gamma_M0=gamma_M0)
    return np.asarray(0.9 * np.asarray(f_y, dtype=float) * np.asarray(A_vc, dtype=float) / (math.sqrt(3.0) * gamma_M0))


def web_panel_slenderness(d: ArrayLike, t_w: ArrayLike, f_y: ArrayLike) -> np.ndarray:
    """Return (d / t_w) / (69 epsilon) of a column web, epsilon = sqrt(235 MPa / f_y); at most 1 lest its shear buckles.

    Args:
        d: depth of the web between the fillets, m.
        t_w: thickness of the web, m.
        f_y: yield stress, Pa.

    Source: EN 1993-1-8:2005, 6.2.6.1(1).
    """
    check_positive(d=d, t_w=t_w, f_y=f_y)
    epsilon = np.sqrt(235e6 / np.asarray(f_y, dtype=float))
    return np.asarray(np.asarray(d, dtype=float) / np.asarray(t_w, dtype=float) / (69.0 * epsilon))


def stiffened_panel_resistance(M_pl_flange: float, M_pl_stiffener: float, d_s: float) -> float:
    """Return V_wp,add,Rd = 4 M_pl,fc,Rd / d_s <= 2 (M_pl,fc,Rd + M_pl,st,Rd) / d_s, N: what transverse stiffeners add.

    Args:
        M_pl_flange: plastic resistance of a column flange in bending, N m.
        M_pl_stiffener: that of a stiffener, N m.
        d_s: distance between the centres of the stiffeners, m.

    Source: EN 1993-1-8:2005, 6.2.6.1(4), Eq. 6.8.
    """
    check_positive(M_pl_flange=M_pl_flange, M_pl_stiffener=M_pl_stiffener, d_s=d_s)
    return min(4.0 * M_pl_flange, 2.0 * (M_pl_flange + M_pl_stiffener)) / d_s


def rotation_capacity(ductility: str, q: float) -> float:
    """Return the rotation that the hinge region of a beam to column connection must reach, rad; 0 without demand.

    Args:
        ductility: `low`, `medium` or `high`.
        q: behaviour factor.

    Raises:
        InputError: there is no such ductility class.

    Source: EN 1998-1:2004, 6.6.4(3): 35 mrad in class high, 25 mrad in class medium with q above 2.
    """
    if ductility not in ("low", "medium", "high"):
        raise unknown("ductility class", ductility, ("low", "medium", "high"))
    if ductility == "high":
        return 0.035
    return 0.025 if ductility == "medium" and q > 2.0 else 0.0


def _ratio(demand: ArrayLike, resistance: ArrayLike) -> np.ndarray:
    check_positive(resistance=resistance)
    return np.asarray(np.abs(np.asarray(demand, dtype=float)) / np.asarray(resistance, dtype=float))
