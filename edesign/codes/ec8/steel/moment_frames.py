"""Moment resisting frames of steel, EN 1998-1:2004, 6.6.

Columns take the amplified effects of `capacity`; joints must satisfy `strong_column`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.names import unknown
from edesign.codes.quantities import check_positive

AXIAL_LIMIT = 0.15
"""N_Ed / N_pl,Rd in hinges of beams. Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.3."""
SHEAR_LIMIT = 0.5
"""V_Ed / V_pl,Rd in hinges of beams, and in columns. Source: EN 1998-1:2004, Eqs. 6.4 and 6.7."""


def hinge_shear(M_pl_A: ArrayLike, M_pl_B: ArrayLike, L: ArrayLike) -> np.ndarray:
    """Return V_Ed,M = (M_pl,Rd,A + M_pl,Rd,B) / L, N: shear of a beam with hinges of opposite sign at both ends.

    Args:
        M_pl_A: plastic resistance at the start of the beam, N m.
        M_pl_B: plastic resistance at its end, N m.
        L: distance of the hinges, m.

    Returns:
        V_Ed,M, N, in the shape of the arguments.

    Raises:
        InputError: a resistance or a distance is not greater than zero.

    Source: EN 1998-1:2004, 6.6.2(2), Eq. 6.5.
    """
    check_positive(M_pl_A=M_pl_A, M_pl_B=M_pl_B, L=L)
    return np.asarray((np.asarray(M_pl_A, dtype=float) + np.asarray(M_pl_B, dtype=float)) / np.asarray(L, dtype=float))


def column_hinge_shear(M_pl_Rd: ArrayLike, M_Ed: ArrayLike, L: ArrayLike) -> np.ndarray:
    """Return V_Ed = (M_pl,Rd + M_Ed) / L, N: shear of a column with a hinge at one end.

    That is at the base of the frame; allowed are also the top of the uppermost storey and buildings of one storey.

    Args:
        M_pl_Rd: plastic resistance, which is the moment at the hinge, N m.
        M_Ed: moment at the other end from the analysis, which turns the column the same way, N m.
        L: length of the column, m.

    Source: EN 1998-1:2004, 6.6.3(2) with 6.6.1(1)P; equilibrium.
    """
    check_positive(M_pl_Rd=M_pl_Rd, L=L)
    return (np.asarray(M_pl_Rd, dtype=float) + np.abs(M_Ed)) / np.asarray(L, dtype=float)


def web_panel_shear(M_over_z: ArrayLike, V_columns: ArrayLike = 0.0) -> np.ndarray:
    """Return the shear of the web panel of a column at hinges of the adjacent beams, V_wp,Ed = sum M / z - V_c.

    Args:
        M_over_z: sum over the beams, which turn the joint the same way, of plastic resistance over lever arm, the
            distance between the centres of their flanges, N.
        V_columns: mean shear of the columns above and below, which relieves the panel, N; 0 is on the safe side.

    Returns:
        N, in the shape of the arguments.

    Source: EN 1998-1:2004, 6.6.3(6); EN 1993-1-8:2005, 5.3(3), Eq. 5.3.
    """
    return np.maximum(np.asarray(M_over_z, dtype=float) - np.asarray(V_columns, dtype=float), 0.0)


def web_panel_resistance(A_vc: ArrayLike, f_y: ArrayLike, gamma_M0: float = 1.0) -> np.ndarray:
    """Return the resistance of an unstiffened web panel to shear, V_wp,Rd = 0.9 f_y A_vc / (sqrt(3) gamma_M0).

    It holds as long as `web_panel_slenderness` is at most 1.

    Args:
        A_vc: shear area of the column, m2.
        f_y: yield stress of its web, Pa.
        gamma_M0: partial factor.

    Returns:
        N, in the shape of the arguments.

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

    Returns:
        Dimensionless, in the shape of the arguments.

    Source: EN 1993-1-8:2005, 6.2.6.1(1).
    """
    check_positive(d=d, t_w=t_w, f_y=f_y)
    epsilon = np.sqrt(235e6 / np.asarray(f_y, dtype=float))
    return np.asarray(np.asarray(d, dtype=float) / np.asarray(t_w, dtype=float) / (69.0 * epsilon))


def web_panel_area_with_doubler(A_vc: float, b_s: float, t_w: float) -> float:
    """Return the shear area of a column web with a supplementary web plate, m2: A_vc + b_s t_w.

    The plate is at least as thick as the web; what is beyond, and a second plate, do not count.

    Args:
        A_vc: shear area of the column, m2.
        b_s: width of the plate, m; between the fillets at least.
        t_w: thickness of the web, m.

    Source: EN 1993-1-8:2005, 6.2.6.1(6), and (11) of the thickness of the plate.
    """
    check_positive(A_vc=A_vc, b_s=b_s, t_w=t_w)
    return A_vc + b_s * t_w


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
