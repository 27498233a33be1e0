"""Units of printed values, such as `cm` and `%`, what one of them is in SI, and values printed beside their limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from edesign.project.notation.quantities import (
    ACCELERATION,
    AREA,
    ENERGY,
    FORCE,
    FREQUENCY,
    LENGTH,
    ROTATION,
    STIFFNESS,
    TIME,
    Kind,
)
from edesign.project.notation.units import parse_quantity
from edesign.project.reading.base import refuse

_KINDS = {
    kind.unit: kind
    for kind in (
        LENGTH,
        AREA,
        FORCE,
        STIFFNESS,
        TIME,
        ACCELERATION,
        Kind("frequency", "Hz", "1 Hz"),
        FREQUENCY,
        ROTATION,
        ENERGY,
    )
}


def unit_factor(unit: str, si_unit: str) -> float:
    """Return the factor of a unit to SI.

    Args:
        unit: as written; of a ratio `1` or `%`.
        si_unit: of the quantity, such as "m^2"; "1" for a ratio.

    Raises:
        PydanticCustomError: unknown unit, or another dimension.
    """
    if si_unit == "1":
        if unit not in ("1", "%"):
            raise refuse(f"`{unit}` is no unit of a ratio; write `%`, or `1` [E-UNIT-02]")
        return 0.01 if unit == "%" else 1.0
    kind = _KINDS.get(si_unit) or Kind("quantity", si_unit, f"1 {si_unit}")
    return parse_quantity(f"1 {unit}", kind)


MOST_DIGITS = 7
"""Of values and limits that are nearly equal; the checks have no more that mean anything."""
V = TypeVar("V", float, float | None)


def told_apart(value: V, limit: V, text: Callable[[V, int], str], digits: int = 3) -> tuple[str, str]:
    """Return a value and its limit in words, with more digits where rounding makes different ones look equal.

    Args:
        text: writes a number with significant digits.
        digits: to begin with.
    """
    for count in range(digits, MOST_DIGITS + 1):
        texts = text(value, count), text(limit, count)
        if value == limit or texts[0] != texts[1]:
            break
    return texts
