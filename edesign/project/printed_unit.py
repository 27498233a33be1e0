"""Units of printed values, such as `cm` and `%`, and what one of them is in SI."""

from __future__ import annotations

import re

from edesign.project.base import refuse
from edesign.project.units import ACCELERATION, AREA, FORCE, FREQUENCY, LENGTH, STIFFNESS, TIME, Kind, parse_quantity

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
        Kind("angle", "rad", "0.01 rad"),
        Kind("energy", "J", "1 kJ"),
    )
}


def unit_factor(unit: str, si_unit: str) -> float:
    """Return what one `unit` is in SI.

    Args:
        unit: as written; of a ratio `1` or `%`.
        si_unit: of the quantity, "m^2" or "m2"; "1" for a ratio.

    Raises:
        PydanticCustomError: unknown unit, or another dimension.
    """
    if si_unit == "1":
        if unit not in ("1", "%"):
            raise refuse(f"`{unit}` is no unit of a ratio; write `%`, or `1`")
        return 0.01 if unit == "%" else 1.0
    known = re.sub(r"([A-Za-z])([0-9])", r"\1^\2", si_unit)
    kind = _KINDS.get(known) or Kind("quantity", known, f"1 {known}")
    return parse_quantity(f"1 {unit}", kind)
