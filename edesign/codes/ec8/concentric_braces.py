"""Frames with concentric bracings of steel, EN 1998-1:2004, 6.7.

Columns and beams take the amplified effects of `capacity`, with the least overstrength of all diagonals.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.capacity import overstrength
from edesign.codes.ec8.criterion import Criterion, at_most
from edesign.codes.names import unknown
from edesign.codes.quantities import check_not_negative, check_positive
from edesign.errors import InputError

BraceKind = Literal["x", "diagonal", "v"]
"""Crossing diagonals; diagonals that do not cross; V or inverted V."""

ASYMMETRY = 0.05
"""|A+ - A-| / (A+ + A-). Source: EN 1998-1:2004, 6.7.1(3), Eq. 6.11."""
SLENDERNESS = {"x": (1.3, 2.0), "diagonal": (0.0, 2.0), "v": (0.0, 2.0)}
"""Lower limit, exclusive, and upper limit of the slenderness. Source: EN 1998-1:2004, 6.7.3(1)-(3)."""
FEW_STOREYS = 2
"""Up to so many storeys there is no limit of slenderness. Source: EN 1998-1:2004, 6.7.3(4)."""
HOMOGENEITY = 0.25
"""(max Omega_i - Omega) / Omega. Source: EN 1998-1:2004, 6.7.3(8)."""


def asymmetry(A_plus: float, A_minus: float, storey: int) -> Criterion:
    """Check that a braced frame behaves alike in both senses of a direction: |A+ - A-| / (A+ + A-) <= 0.05.

    Args:
        A_plus, A_minus: sum over the diagonals of a storey that are in tension under an action in the positive, and in
            the negative sense: cross-section area times cosine of the slope against the horizontal, m2.
        storey: its number, for the text.

    Raises:
        InputError: an area is negative, or both are zero.

    Source: EN 1998-1:2004, 6.7.1(2)P and (3), Eq. 6.11, Figure 6.12.
    """
    check_not_negative(A_plus=A_plus, A_minus=A_minus)
    total = A_plus + A_minus
    check_positive(A_plus_and_A_minus=total)
    value = abs(A_plus - A_minus) / total
    text = "|A+ - A-| / (A+ + A-) of the tension diagonals"
    return at_most("6.7.1(3)", text, ASYMMETRY, value, f"storey {storey}")


def diagonals_that_count(kind: str) -> Literal["tension", "both"]:
    """Return which diagonals an elastic analysis for the seismic action counts.

    Args:
        kind: `x`, `diagonal` or `v`.

    Raises:
        InputError: there is no such kind.

    Source: EN 1998-1:2004, 6.7.2(2)P: tension diagonals in frames with diagonal bracings, both in V bracings; (3) both
        in any bracing if a nonlinear analysis, or a model with pre- and post-buckling behaviour, justifies it.
    """
    _check_kind(kind)
    return "both" if kind == "v" else "tension"


def slenderness(value: float, kind: str, storeys: int, member: str = "") -> Criterion:
    """Check the non-dimensional slenderness of a diagonal.

    Args:
        value: sqrt(A f_y / N_cr) (EN 1993-1-1, 6.3.1.2).
        kind: `x` (1.3 < slenderness <= 2.0), `diagonal` or `v` (<= 2.0).
        storeys: of the building; up to two there is no limit.
        member: its name, for the text.

    Raises:
        InputError: there is no such kind.

    Source: EN 1998-1:2004, 6.7.3(1)-(4).
    """
    _check_kind(kind)
    check_positive(slenderness=value)
    low, high = SLENDERNESS[kind]
    clause = {"x": "6.7.3(1)", "diagonal": "6.7.3(2)", "v": "6.7.3(3)"}[kind]
    if storeys <= FEW_STOREYS:
        return Criterion("6.7.3(4)", "slenderness of a diagonal", None, value, "", None, member)
    if value <= low:
        text = f"slenderness of a diagonal, above {low:g} so that its buckling does not overload the column"
        return Criterion(clause, text, low, value, "", False, member)
    return at_most(clause, "slenderness of a diagonal", high, value, member)


def tension_resistance(N_Ed: ArrayLike, N_pl_Rd: ArrayLike) -> np.ndarray:
    """Return N_Ed / N_pl,Rd of diagonals in tension; at most 1.

    Args:
        N_Ed: in the seismic design situation, N, any sign.
        N_pl_Rd: plastic resistance of the gross section, N.

    Source: EN 1998-1:2004, 6.7.3(5).
    """
    check_positive(N_pl_Rd=N_pl_Rd)
    return np.asarray(np.abs(np.asarray(N_Ed, dtype=float)) / np.asarray(N_pl_Rd, dtype=float))


def brace_overstrength(N_pl_Rd: ArrayLike, N_Ed: ArrayLike) -> tuple[float, int, Criterion]:
    """Return Omega, the least N_pl,Rd / N_Ed of all diagonals, which one has it, and the criterion of homogeneity.

    Args:
        N_pl_Rd: (n,) N.
        N_Ed: (n,) forces in the seismic design situation, N, any sign.

    Returns:
        Omega; index of its diagonal; criterion that the others exceed it by at most 25 %.

    Raises:
        InputError: there are no diagonals, or one has no force.

    Source: EN 1998-1:2004, 6.7.4(1) and 6.7.3(8).
    """
    ratios = np.atleast_1d(overstrength(N_pl_Rd, N_Ed))
    if not ratios.size or not np.isfinite(ratios).all():
        raise InputError("Omega needs diagonals, each with a force in the seismic design situation")
    least = int(np.argmin(ratios))
    return float(ratios[least]), least, homogeneity(ratios)


def homogeneity(ratios: ArrayLike, where: str = "") -> Criterion:
    """Check that the overstrength of diagonals exceeds the least one by at most 25 %.

    Args:
        ratios: (n,) N_pl,Rd / N_Ed.
        where: for the text, such as `, direction y`.

    Source: EN 1998-1:2004, 6.7.3(8).
    """
    values = np.asarray(ratios, dtype=float)
    Omega, most = float(values.min()), float(values.max())
    text = f"overstrength of the diagonals over the least one{where}"
    return at_most("6.7.3(8)", text, HOMOGENEITY, most / Omega - 1.0, f"Omega from {Omega:.3g} to {most:.3g}")


def v_brace_forces(
    N_pl_tension: float, N_pl_compression: float, slope_tension: float, slope_compression: float, gamma_pb: float = 0.3
) -> tuple[float, float]:
    """Return the forces on the beam at the point of a V bracing after the diagonal in compression has buckled.

    The beam must also carry all non-seismic actions without the support of the diagonals.

    Args:
        N_pl_tension, N_pl_compression: N_pl,Rd of the two diagonals, N.
        slope_tension, slope_compression: their angles against the horizontal, rad, 0 to pi/2.
        gamma_pb: share of N_pl,Rd left in compression (`NationalParameters.gamma_pb`).

    Returns:
        Unbalanced vertical force, N, downwards for an inverted V, and horizontal force along the beam, N.

    Raises:
        InputError: a number is out of its range.

    Source: EN 1998-1:2004, 6.7.4(2): N_pl,Rd in tension, gamma_pb N_pl,Rd in compression.
    """
    check_positive(N_pl_tension=N_pl_tension, N_pl_compression=N_pl_compression)
    check_not_negative(gamma_pb=gamma_pb)
    for slope in (slope_tension, slope_compression):
        if not 0.0 < slope < math.pi / 2.0:
            raise InputError(f"the slope of a diagonal lies between 0 and pi/2 rad, not {slope:g}")
    left = gamma_pb * N_pl_compression
    vertical = N_pl_tension * math.sin(slope_tension) - left * math.sin(slope_compression)
    horizontal = N_pl_tension * math.cos(slope_tension) + left * math.cos(slope_compression)
    return vertical, horizontal


def adjacent_column_force(N_b_Rd: float, slope: float) -> float:
    """Return the vertical force, N, of a buckling diagonal on the column beside it, where diagonals do not cross.

    Args:
        N_b_Rd: design buckling resistance of the diagonal, N.
        slope: its angle against the horizontal, rad.

    Source: EN 1998-1:2004, 6.7.4(3).
    """
    check_positive(N_b_Rd=N_b_Rd, slope=slope)
    return N_b_Rd * math.sin(slope)


def _check_kind(kind: str) -> None:
    if kind not in SLENDERNESS:
        raise unknown("kind of bracing", kind, SLENDERNESS)
