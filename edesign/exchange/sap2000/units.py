"""The units of a SAP2000 file, which its `CurrUnits` names: force, length, temperature."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.errors import InputError
from edesign.exchange.sap2000.tables import Tables
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import listed

_POUND = 0.45359237 * STANDARD_GRAVITY
_FORCES = {
    "lb": _POUND,
    "kip": 1e3 * _POUND,
    "n": 1.0,
    "kn": 1e3,
    "kgf": STANDARD_GRAVITY,
    "tonf": 1e3 * STANDARD_GRAVITY,
}
_LENGTHS = {"in": 0.0254, "ft": 0.3048, "mm": 1e-3, "cm": 1e-2, "m": 1.0}


@dataclass(frozen=True)
class Units:
    """Factors to SI.

    Attributes:
        force: N.
        length: m.
    """

    force: float
    length: float

    @property
    def mass(self) -> float:
        """kg: SAP2000's mass is a force over an acceleration."""
        return self.force / self.length

    @property
    def stress(self) -> float:
        """Pa."""
        return self.force / self.length**2

    @property
    def moment(self) -> float:
        """N m."""
        return self.force * self.length


def units_of(tables: Tables) -> Units:
    """Return the units of a file.

    Raises:
        InputError: the file does not state its units, or has others than SAP2000.
    """
    rows = tables.of("PROGRAM CONTROL")
    row = next((row for row in rows if row.has("CurrUnits")), None)
    if row is None:
        raise InputError(
            f"{tables.path}: no units: the table PROGRAM CONTROL with the field `CurrUnits` is missing [E-SAP-04]"
        )
    parts = [part.strip().lower() for part in row.text("CurrUnits").split(",")]
    if len(parts) not in (2, 3) or parts[0] not in _FORCES or parts[1] not in _LENGTHS:
        allowed = f"force {listed(_FORCES)}; length {listed(_LENGTHS)}"
        raise row.error(f'`CurrUnits="{row.text("CurrUnits")}"` are no units of SAP2000: {allowed} [E-SAP-04]')
    return Units(_FORCES[parts[0]], _LENGTHS[parts[1]])
