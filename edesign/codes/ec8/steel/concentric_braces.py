"""Frames with concentric bracings of steel, EN 1998-1:2004, 6.7.

Columns and beams take the amplified effects of `capacity`, with the least overstrength of all diagonals.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.names import unknown
from edesign.codes.quantities import check_not_negative, check_positive
from edesign.codes.rule_check import RuleCheck, at_most, first_of_largest

BraceKind = Literal["x", "diagonal", "v"]
"""Crossing diagonals; diagonals that do not cross; V or inverted V."""

ASYMMETRY = 0.05
"""|A+ - A-| / (A+ + A-). Source: EN 1998-1:2004, 6.7.1(3), Eq. 6.11."""
SLENDERNESS = {"x": (1.3, 2.0), "diagonal": (0.0, 2.0), "v": (0.0, 2.0)}
"""Lower limit, exclusive, and upper limit of the slenderness. Source: EN 1998-1:2004, 6.7.3(1)-(3)."""
SLENDERNESS_CLAUSES = {"x": "6.7.3(1)", "diagonal": "6.7.3(2)", "v": "6.7.3(3)"}
FEW_STOREYS = 2
"""Up to so many storeys there is no limit of slenderness. Source: EN 1998-1:2004, 6.7.3(4)."""
HOMOGENEITY = 0.25
"""(max Omega_i - Omega) / Omega. Source: EN 1998-1:2004, 6.7.3(8)."""


def asymmetry(A_plus: float, A_minus: float, storey: int) -> RuleCheck:
    """Check that a braced frame behaves alike in both senses of a direction: |A+ - A-| / (A+ + A-) <= 0.05.

    Args:
        A_plus: sum over the diagonals of a storey that are in tension under an action in the positive sense:
            cross-section area times cosine of the slope against the horizontal, m2.
        A_minus: the sum over those in tension under an action in the negative sense, m2.
        storey: its number, for the text.

    Returns:
        The criterion with its value and its limit.

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


def slenderness(value: float, kind: str, storeys: int, member: str = "") -> RuleCheck:
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
    clause = SLENDERNESS_CLAUSES[kind]
    if storeys <= FEW_STOREYS:
        return RuleCheck("6.7.3(4)", "slenderness of a diagonal", None, value, "", None, member)
    if value <= low:
        text = f"slenderness of a diagonal, above {low:g} so that its buckling does not overload the column"
        return RuleCheck(clause, text, low, value, "", False, member)
    return at_most(clause, "slenderness of a diagonal", high, value, member)


def homogeneity(ratios: ArrayLike, where: str = "", members: Sequence[str] = ()) -> RuleCheck:
    """Check that the overstrength of diagonals exceeds the least one by at most 25 %.

    Args:
        ratios: (n,) N_pl,Rd / N_Ed.
        where: for the text, such as `, direction y`.
        members: names of the diagonals, for the text.

    Source: EN 1998-1:2004, 6.7.3(8).
    """
    values = np.asarray(ratios, dtype=float)
    text = f"overstrength of the diagonals over the least one{where}"
    least, most = float(values.min()), float(values.max())
    return at_most("6.7.3(8)", text, HOMOGENEITY, most / least - 1.0, least_and_most(values, members))


def least_and_most(ratios: ArrayLike, members: Sequence[str] = ()) -> str:
    """Return the least and the largest Omega in words, with the members that have them.

    Args:
        ratios: (n,) of them.
        members: (n,) their names; none: they are not told.
    """
    values = np.asarray(ratios, dtype=float)
    ends = (first_of_largest(-values), first_of_largest(values))
    said = [f"{values[at]:.3g}{f' ({members[at]})' if len(members) else ''}" for at in ends]
    return f"Omega from {' to '.join(said)}"


def post_buckling_forces(N_pl_Rd: ArrayLike, in_tension: ArrayLike, gamma_pb: float = 0.3) -> np.ndarray:
    """Return the forces of the diagonals of a V bracing after those in compression have buckled, N, tension positive.

    Args:
        N_pl_Rd: plastic resistances, N.
        in_tension: whether each of them is in tension.
        gamma_pb: share of N_pl,Rd left in compression (`NationalParameters.gamma_pb`).

    Raises:
        InputError: a number is out of its range.

    Source: EN 1998-1:2004, 6.7.4(2): N_pl,Rd in tension, gamma_pb N_pl,Rd in compression.
    """
    check_positive(N_pl_Rd=N_pl_Rd)
    check_not_negative(gamma_pb=gamma_pb)
    return np.where(np.asarray(in_tension, dtype=bool), 1.0, -gamma_pb) * np.asarray(N_pl_Rd, dtype=float)


def _check_kind(kind: str) -> None:
    if kind not in SLENDERNESS:
        raise unknown("kind of bracing", kind, SLENDERNESS)
