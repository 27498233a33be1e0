"""Units of acceleration in record files."""

from __future__ import annotations

from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.tables.quantities import scaled_unit

ACCELERATION_UNITS = {"g": STANDARD_GRAVITY, "m/s^2": 1.0, "cm/s^2": 1e-2, "mm/s^2": 1e-3}
"""Factor to m/s2 of every unit that a record may be in."""


def acceleration_factor(unit: str) -> float | None:
    """Return the factor to m/s2 of a unit; None: it is none.

    Args:
        unit: also with a number: `g/10`, `0.5 g`.
    """
    return scaled_unit(unit, ACCELERATION_UNITS)
