"""Modes that count and how their responses add up, EN 1998-1:2004, 4.3.3.3.1 and 4.3.3.3.2."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive
from edesign.codes.rule_check import RuleCheck
from edesign.errors import InputError

LEAST_MASS = 0.90
"""Sum of the effective modal masses that is enough. Source: EN 1998-1:2004, 4.3.3.3.1(3)."""
LARGE_MODE = 0.05
"""Effective modal mass above which each mode must be taken. Source: the same."""
INDEPENDENCE = 0.9
"""Modes are independent if T_j <= 0.9 T_i. Source: EN 1998-1:2004, 4.3.3.3.2(1), Eq. 4.15."""


def needed_modes(mass_ratio: ArrayLike, enough: float = LEAST_MASS) -> int | None:
    """Return how many of the first modes have 90 % of the mass in each direction; None where all together have less.

    Args:
        mass_ratio: (n_modes, n_directions) effective modal mass over total mass, in order of falling period.
        enough: share of the mass.

    Raises:
        InputError: a ratio is negative.

    Source: EN 1998-1:2004, 4.3.3.3.1(3), first rule, and (4).
    """
    sums = np.cumsum(_ratios(mass_ratio), axis=0)
    reached = np.flatnonzero((sums >= enough).all(axis=1))
    return int(reached[0]) + 1 if reached.size else None


def check_modes(
    mass_ratio: ArrayLike, taken: int, direction: str = "", enough: float = LEAST_MASS, both: bool = False
) -> RuleCheck:
    """Check the modes taken in one direction: 90 % of the mass, or every mode above 5 %.

    Modes that were never computed cannot have more mass than is missing in total, so with at most 5 % missing the
    second rule holds whatever they are.

    Args:
        mass_ratio: (n_known,) effective modal mass over total mass of the modes that are known, by falling period.
        taken: so many of the first of them are used.
        direction: for the text, such as `x`.
        enough: sum of the effective modal masses that is enough.
        both: every mode above 5 % is asked for as well (NTC 2018, 7.3.3.1).

    Returns:
        The criterion; its detail says what is missing.

    Raises:
        InputError: a ratio is negative, or more modes are taken than are known.

    Source: EN 1998-1:2004, 4.3.3.3.1(3) and (4).
    """
    ratios = _ratios(mass_ratio)[:, 0]
    if not 0 <= taken <= ratios.size:
        raise InputError(f"{taken} modes cannot be taken of {ratios.size} that are known [E-VALUE-02]")
    total = float(ratios[:taken].sum())
    left = [float(ratio) for ratio in ratios[taken:]]
    largest_left = max([*left, 1.0 - float(ratios.sum())])
    rules = total >= enough, largest_left <= LARGE_MODE
    passed = all(rules) if both else any(rules)
    where = f" in {direction}" if direction else ""
    detail = f"{taken} modes have {total:.1%} of the mass{where}"
    if passed and total < enough:
        detail += f"; no other mode can have more than {LARGE_MODE:.0%}"
    if not passed:
        needed = needed_modes(ratios, enough)
        known = (
            f"{needed} modes are needed" if needed else f"more modes than the {ratios.size} that are known are needed"
        )
        missing = f"{enough - total:.1%} are missing; {known}"
        detail += f", {missing}" if not rules[0] else f"; another mode may have {largest_left:.1%}"
    text = f"effective modal mass{where}: {100.0 * enough:g} %, {'and' if both else 'or'} every mode above 5 %"
    return RuleCheck("4.3.3.3.1(3)", text, enough, total, "", passed, detail)


def close_modes(periods: ArrayLike) -> tuple[tuple[int, int], ...]:
    """Return the neighbouring modes that are not independent, as pairs of indices (i, j), T_j <= T_i.

    With none of them the modal responses may be combined by SRSS; otherwise a more accurate rule such as CQC is needed.

    Args:
        periods: (n_modes,) s, any order.

    Source: EN 1998-1:2004, 4.3.3.3.2(1), Eq. 4.15; (2) and (3)P.
    """
    T = np.asarray(periods, dtype=float)
    check_positive(periods=T)
    order = np.argsort(-T, kind="stable")
    close = T[order[1:]] > INDEPENDENCE * T[order[:-1]]
    return tuple((int(i), int(j)) for i, j in zip(order[:-1][close], order[1:][close], strict=True))


def cqc_coefficients(periods: ArrayLike, damping: ArrayLike = 0.05) -> np.ndarray:
    """Return the correlation coefficients rho of the modes for complete quadratic combination, (n_modes, n_modes).

    rho_ij = 8 sqrt(z_i z_j) (z_i + r z_j) r^1.5 / ((1 - r2)2 + 4 z_i z_j r (1 + r2) + 4 (z_i2 + z_j2) r2), r = T_i/T_j;
    with one damping z it is 8 z2 (1 + r) r^1.5 / ((1 - r2)2 + 4 z2 r (1 + r)2).

    Args:
        periods: (n_modes,) s.
        damping: ratio of critical damping, one number or (n_modes,).

    Raises:
        InputError: a period or a damping is not greater than zero.

    Source: Der Kiureghian, Earthquake Engineering and Structural Dynamics 9 (1981) 419; Wilson, Der Kiureghian & Bayo,
        same journal 9 (1981) 187. EN 1998-1:2004, 4.3.3.3.2(3)P names the method without its formula.
    """
    T = np.asarray(periods, dtype=float)
    zeta = np.broadcast_to(np.asarray(damping, dtype=float), T.shape)
    check_positive(periods=T, damping=zeta)
    r = T[:, None] / T[None, :]  # omega_j / omega_i
    z_i, z_j = zeta[:, None], zeta[None, :]
    above = 8.0 * np.sqrt(z_i * z_j) * (z_i + r * z_j) * r**1.5
    below = (1.0 - r**2) ** 2 + 4.0 * z_i * z_j * r * (1.0 + r**2) + 4.0 * (z_i**2 + z_j**2) * r**2
    return np.asarray(above / below)


def cqc(modal: ArrayLike, rho: np.ndarray) -> np.ndarray:
    """Return the largest response sqrt(sum_ij rho_ij E_i E_j), at least 0, in the shape of one mode.

    Args:
        modal: (n_modes, ...) response quantities of each mode, with sign. Combine what is asked for itself: member
            forces and storey drifts of the modes, never differences of combined values.
        rho: (n_modes, n_modes) from `cqc_coefficients`.

    Source: as `cqc_coefficients`.
    """
    E = np.asarray(modal, dtype=float)
    flat = E.reshape(E.shape[0], -1)
    squares = np.einsum("ik,ik->k", flat, rho @ flat)
    return np.asarray(np.sqrt(np.maximum(squares, 0.0)).reshape(E.shape[1:]))


def _ratios(mass_ratio: ArrayLike) -> np.ndarray:
    ratios = np.asarray(mass_ratio, dtype=float)
    ratios = ratios[:, None] if ratios.ndim == 1 else ratios
    check_not_negative(mass_ratio=ratios)
    return ratios
