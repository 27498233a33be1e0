"""Units of acceleration in record files."""

from __future__ import annotations

from edesign.project.notation.units import STANDARD_GRAVITY

ACCELERATION_UNITS = {"g": STANDARD_GRAVITY, "m/s^2": 1.0, "cm/s^2": 1e-2, "mm/s^2": 1e-3}
"""Factor to m/s2 of every unit that a record may be in."""
