"""Combination of the effects of the components of the seismic action, EN 1998-1:2004, 4.3.3.5."""

from __future__ import annotations

from itertools import product
from typing import Literal

from edesign.codes.names import unknown

DirectionRule = Literal["30 %", "srss"]

SHARE = 0.3
"""Factor of the components that do not lead. Source: EN 1998-1:2004, Eqs. 4.18-4.22."""
VERTICAL_ACCELERATION = 2.5
"""a_vg above which the vertical component counts, m/s2 (0.25 g). Source: EN 1998-1:2004, 4.3.3.5.2(1)."""
LONG_SPAN = 20.0
"""Least span of nearly horizontal members for which it counts, m. Source: the same."""
LONG_CANTILEVER = 5.0
"""Length of cantilevers above which it counts, m. Source: the same."""


def direction_factors(rule: str, vertical: bool = False) -> tuple[tuple[float, float, float], ...]:
    """Return the factors of E_x, E_y, E_z of each combination, with signs.

    Args:
        rule: `30 %`: each component leads once, the others with 0.3, all signs; `srss`: the components count alike,
            with one sign for the root of the sum of their squares.
        vertical: the vertical component acts too; otherwise its factor is 0.

    Raises:
        InputError: there is no such rule.

    Source: EN 1998-1:2004, 4.3.3.5.1(2) and (3), Eqs. 4.18 and 4.19, with the most unfavourable sign of each
        component (4); 4.3.3.5.2(4), Eqs. 4.20-4.22.
    """
    _checked(rule)
    axes = 3 if vertical else 2
    if rule == "srss":
        size = (1.0, 1.0, 1.0 if vertical else 0.0)
        return size, (-size[0], -size[1], -size[2] if vertical else 0.0)
    rows = []
    for leading in range(axes):
        sizes = [1.0 if axis == leading else SHARE if axis < axes else 0.0 for axis in range(3)]
        others = [axis for axis in range(axes) if axis != leading]
        for signs in product((1.0, -1.0), repeat=axes):
            row = list(sizes)
            for axis, sign in zip((leading, *others), signs, strict=True):
                row[axis] *= sign
            rows.append((row[0], row[1], row[2]))
    return tuple(rows)


def vertical_component_counts(
    a_vg: float,
    span: float = 0.0,
    cantilever: float = 0.0,
    prestressed: bool = False,
    supports_column: bool = False,
    isolated: bool = False,
) -> bool:
    """Return whether a member needs the vertical component of the seismic action.

    Args:
        a_vg: peak vertical ground acceleration, m/s2.
        span: of a horizontal or nearly horizontal member between supports, m.
        cantilever: its length if it is a cantilever, m.
        prestressed: a prestressed horizontal member.
        supports_column: a beam on which a column stands.
        isolated: the structure is base-isolated.

    Source: EN 1998-1:2004, 4.3.3.5.2(1).
    """
    concerned = span >= LONG_SPAN or cantilever > LONG_CANTILEVER or prestressed or supports_column or isolated
    return a_vg > VERTICAL_ACCELERATION and concerned


def _checked(rule: str) -> None:
    if rule not in ("30 %", "srss"):
        raise unknown("rule of directions", rule, ("30 %", "srss"))
