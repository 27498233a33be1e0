"""Structural regularity and what follows from it, EN 1998-1:2004, 4.2.3."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.quantities import check_not_negative, check_positive
from edesign.codes.rule_check import RuleCheck, at_least, at_most
from edesign.errors import InputError

LARGEST_SLENDERNESS = 4.0
"""L_max / L_min. Source: EN 1998-1:2004, 4.2.3.2(5)."""
LARGEST_ECCENTRICITY = 0.30
"""e_0 / r. Source: EN 1998-1:2004, 4.2.3.2(6), Eq. 4.1a."""
LARGEST_RECESS = 0.05
"""Area between outline and convex hull over floor area. Source: EN 1998-1:2004, 4.2.3.2(3)."""
SYMMETRIC_SETBACK = 0.20
"""Of the previous plan dimension. Source: EN 1998-1:2004, 4.2.3.3(5) a."""
LOW_SETBACK, LOW_ZONE = 0.50, 0.15
"""A single setback within the lower 15 % of the height. Source: EN 1998-1:2004, 4.2.3.3(5) b."""
FACE_SETBACKS, SINGLE_SETBACK = 0.30, 0.10
"""Sum on one face over the lowest plan dimension, and each over the previous one. Source: 4.2.3.3(5) c."""
IRREGULAR_Q = 0.8
"""Factor on q for irregularity in elevation. Source: EN 1998-1:2004, 4.2.3.1(7)."""

_SAME = 1e-6  # setbacks of both faces that differ by less, relative to the plan, are symmetric: rounding of coordinates


@dataclass(frozen=True)
class ChangeLimits:
    """Changes from one storey to the next above that still are gradual. EN 1998-1 has no figures.

    Attributes:
        mass: largest change of mass either way, over that of the storey below.
        stiffness_fall, stiffness_rise: largest fall and rise of the stiffness, over that of the storey below.
    """

    mass: float
    stiffness_fall: float
    stiffness_rise: float


NTC_2018 = ChangeLimits(0.25, 0.30, 0.10)
"""Source: Norme tecniche per le costruzioni, DM 17 January 2018 (Italy), 7.2.1."""


def slenderness(L_x: float, L_y: float) -> RuleCheck:
    """Check L_max / L_min <= 4 of the plan.

    Args:
        L_x: dimension of the building in plan along x, m.
        L_y: dimension along y, m.

    Returns:
        The criterion with its value and its limit.

    Raises:
        InputError: a dimension is not greater than zero.

    Source: EN 1998-1:2004, 4.2.3.2(5).
    """
    check_positive(L_x=L_x, L_y=L_y)
    ratio = max(L_x, L_y) / min(L_x, L_y)
    return at_most("4.2.3.2(5)", "slenderness of the plan, L_max / L_min", LARGEST_SLENDERNESS, ratio)


def recess(missing_area: float, floor_area: float) -> RuleCheck:
    """Check that re-entrant corners take at most 5 % of the floor.

    Args:
        missing_area: between the outline of the floor and the convex polygon around it, of one set-back, m2.
        floor_area: m2.

    Source: EN 1998-1:2004, 4.2.3.2(3).
    """
    check_positive(floor_area=floor_area)
    check_not_negative(missing_area=missing_area)
    return at_most("4.2.3.2(3)", "area of a set-back in plan", LARGEST_RECESS, missing_area / floor_area)


def torsional_radius(K_theta: ArrayLike, K: ArrayLike) -> np.ndarray:
    """Return r = sqrt(K_theta / K), m: r_x with the lateral stiffness along y, r_y with that along x.

    Args:
        K_theta: torsional stiffness about the centre of stiffness, N m/rad.
        K: lateral stiffness in the direction of analysis, N/m.

    Returns:
        m, in the shape of the arguments.

    Source: EN 1998-1:2004, 4.2.3.2(6).
    """
    check_positive(K_theta=K_theta, K=K)
    return np.sqrt(np.asarray(K_theta, dtype=float) / np.asarray(K, dtype=float))


def eccentricity_and_radius(
    e_0: ArrayLike, r: ArrayLike, l_s: ArrayLike, direction: str
) -> tuple[RuleCheck, RuleCheck]:
    """Check e_0 <= 0.30 r and r >= l_s at all floors for one direction of analysis; the worst floor counts.

    Args:
        e_0: (n_floors,) distance between centre of stiffness and centre of mass at right angles to the direction, m.
        r: (n_floors,) torsional radius of the direction, m.
        l_s: (n_floors,) radius of gyration of the floor mass in plan, m.
        direction: of analysis, for the text: `x` or `y`.

    Returns:
        The criterion of the eccentricity, and that of the torsional radius (r / l_s at least 1).

    Source: EN 1998-1:2004, 4.2.3.2(6), Eqs. 4.1a and 4.1b.
    """
    check_positive(r=r, l_s=l_s)
    e_0, r, l_s = np.broadcast_arrays(*(np.atleast_1d(np.asarray(v, dtype=float)) for v in (e_0, r, l_s)))
    ratios, radii = np.abs(e_0) / r, r / l_s
    worst, least = int(np.argmax(ratios)), int(np.argmin(radii))
    clause = "4.2.3.2(6)"
    return (
        at_most(
            clause, f"e_0 / r, direction {direction}", LARGEST_ECCENTRICITY, float(ratios[worst]), f"floor {worst + 1}"
        ),
        at_least(clause, f"r / l_s, direction {direction}", 1.0, float(radii[least]), f"floor {least + 1}"),
    )


def gradual_mass(mass: ArrayLike, limits: ChangeLimits | None = None) -> RuleCheck:
    """Check that the masses of the floors stay constant or change gradually.

    Args:
        mass: (n_floors,) from the lowest floor up, kg.
        limits: None leaves the judgement to the engineer, as EN 1998-1 does.

    Source: EN 1998-1:2004, 4.2.3.3(3).
    """
    change = _changes(mass)
    worst = int(np.argmax(np.abs(change))) if change.size else 0
    value = float(abs(change[worst])) if change.size else 0.0
    return _gradual("change of mass", limits.mass if limits else None, value, worst)


def gradual_stiffness(stiffness: ArrayLike, limits: ChangeLimits | None = None) -> tuple[RuleCheck, RuleCheck]:
    """Check that the lateral stiffness of the storeys stays constant or changes gradually.

    Args:
        stiffness: (n_storeys,) in one direction, from the lowest storey up, N/m.
        limits: None leaves the judgement to the engineer, as EN 1998-1 does.

    Returns:
        The criterion of the largest fall going up, and that of the largest rise.

    Source: EN 1998-1:2004, 4.2.3.3(3).
    """
    change = _changes(stiffness)
    low = int(np.argmin(change)) if change.size else 0
    high = int(np.argmax(change)) if change.size else 0
    fall = max(0.0, -float(change[low])) if change.size else 0.0
    rise = max(0.0, float(change[high])) if change.size else 0.0
    return (
        _gradual("fall of stiffness", limits.stiffness_fall if limits else None, fall, low),
        _gradual("rise of stiffness", limits.stiffness_rise if limits else None, rise, high),
    )


def setbacks(lower: ArrayLike, upper: ArrayLike, top: ArrayLike) -> tuple[RuleCheck, ...]:
    """Check the setbacks of the building in one horizontal direction.

    Args:
        lower: (n_storeys,) coordinate of the lower face of each storey, from the lowest storey up, m.
        upper: (n_storeys,) coordinate of the upper face of each storey, m.
        top: (n_storeys,) level of the top of each storey, m.

    Returns:
        One criterion a rule that applies; one that only informs where a storey stands out over the one below.

    Raises:
        InputError: a storey has no width, or the numbers of storeys differ.

    Source: EN 1998-1:2004, 4.2.3.3(5) and Figure 4.1.
    """
    if not np.shape(lower) == np.shape(upper) == np.shape(top):
        raise InputError("each storey has a lower face, an upper face and a top [E-VALUE-01]")
    faces = np.array([lower, upper], dtype=float)
    width = faces[1] - faces[0]
    if not (width > 0.0).all():
        raise InputError("the upper face of a storey must lie beyond its lower face [E-VALUE-04]")
    steps = np.array([np.diff(faces[0]), -np.diff(faces[1])])  # (2, n - 1), positive inwards
    inwards = np.maximum(steps, 0.0)
    relative = inwards.sum(axis=0) / width[:-1]
    found: list[RuleCheck] = []
    if (steps < -_SAME * width[:-1]).any():
        text = "a storey stands out over the one below: 4.2.3.3(5) does not cover it"
        found.append(RuleCheck("4.2.3.3(5)", text, None, None, "", None))
    where = np.flatnonzero(relative > _SAME)
    if not where.size:
        return tuple(found)
    levels = np.asarray(top, dtype=float)
    worst = int(np.argmax(relative))
    detail = f"above storey {worst + 1}"
    if where.size == 1 and levels[worst] <= LOW_ZONE * levels[-1]:
        detail += "; the inner part of the base must resist 75 % of the shear of a building without the enlargement"
        text = "single setback in the lower 15 % of the height, over the plan below"
        return (*found, at_most("4.2.3.3(5)b", text, LOW_SETBACK, float(relative[worst]), detail))
    if (np.abs(inwards[0] - inwards[1]) <= _SAME * width[:-1]).all():
        text = "symmetric setback over the plan below"
        return (*found, at_most("4.2.3.3(5)a", text, SYMMETRIC_SETBACK, float(relative[worst]), detail))
    single = inwards / width[:-1]
    face, storey = np.unravel_index(int(np.argmax(single)), single.shape)
    return (
        *found,
        at_most(
            "4.2.3.3(5)c",
            "sum of the setbacks on one face over the lowest plan",
            FACE_SETBACKS,
            float(inwards.sum(axis=1).max() / width[0]),
        ),
        at_most(
            "4.2.3.3(5)c",
            "setback on one face over the plan below",
            SINGLE_SETBACK,
            float(single[face, storey]),
            f"above storey {int(storey) + 1}",
        ),
    )


def _changes(values: ArrayLike) -> np.ndarray:
    check_positive(**{"the value of a storey": values})
    array = np.atleast_1d(np.asarray(values, dtype=float))
    return np.diff(array) / array[:-1]


def _gradual(what: str, limit: float | None, value: float, storey: int) -> RuleCheck:
    detail = f"from storey {storey + 1} to {storey + 2}" if value else "no change"
    text = f"largest {what} from storey to storey upwards"
    if limit is None:
        return RuleCheck("4.2.3.3(3)", text, None, value, "", None, detail)
    return at_most("4.2.3.3(3)", text, limit, value, detail)
