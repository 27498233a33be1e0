"""How response measures are shown: as columns of a table, and as its rows."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import NamedTuple

from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import Column, col
from edesign.report.tables.unit import CM, KN, M_S2, MM, MRAD, ONE, PERCENT, RAD, M, Unit

ROUNDING = 1e-9  # m, N, rad: far below what any measure means
Measures = Mapping[str, float | None]
"""Response measures by name, SI."""

_measure = partial(col, negligible=ROUNDING, optional=True)

FRAME_COLUMNS: tuple[Column[Measures], ...] = (
    _measure("roof u", M, "roof_displacement_m"),
    _measure("residual u", M, "residual_roof_displacement_m"),
    _measure("roof drift", PERCENT, "roof_drift"),
    _measure("storey drift", PERCENT, "interstorey_drift"),
    _measure("residual drift", PERCENT, "residual_interstorey_drift"),
    _measure("base shear", KN, "base_shear_N"),
    _measure("col. base shear", KN, "column_base_shear_N"),
    _measure("roof a", M_S2, "roof_acceleration_m_s2"),
    _measure("beam rot.", MRAD, "beam_plastic_rotation_rad"),
    _measure("col. rot.", MRAD, "column_plastic_rotation_rad"),
    _measure("col. N", KN, "column_axial_force_N"),
)
DAMPER_COLUMNS: tuple[Column[Measures], ...] = (
    _measure("damper strain", PERCENT, "damper_strain"),
    _measure("damper u", MM, "damper_deformation_m"),
    _measure("damper F", KN, "damper_force_N"),
)
BRACE_COLUMNS: tuple[Column[Measures], ...] = (
    _measure("brace ductility", ONE, "brace_ductility"),
    _measure("brace damage", ONE, "brace_damage"),
)
MEASURE_COLUMNS = (*FRAME_COLUMNS, *BRACE_COLUMNS, *DAMPER_COLUMNS)


class Measure(NamedTuple):
    """A measure that has a row of its own: its title, its name in results, and the unit that its row is in."""

    title: str
    name: str
    unit: Unit

    @property
    def head(self) -> str:
        """The title with the unit."""
        return f"{self.title} [{self.unit.name}]" if self.unit.name else self.title

    def cell(self, value: float | None) -> Quantity | None:
        """Return a value, SI, as it stands in the row."""
        return None if value is None else Quantity(value, self.unit, negligible=ROUNDING, beside=True)


MEASURE_ROWS = (  # those of the frame are in thesis Tables 5.8 and 5.9
    Measure("roof displacement", "roof_displacement_m", CM),
    Measure("residual roof displacement", "residual_roof_displacement_m", CM),
    Measure("roof drift", "roof_drift", PERCENT),
    Measure("interstorey drift", "interstorey_drift", PERCENT),
    Measure("residual interstorey drift", "residual_interstorey_drift", PERCENT),
    Measure("base shear, reactions", "base_shear_N", KN),
    Measure("base shear, columns", "column_base_shear_N", KN),
    Measure("roof acceleration", "roof_acceleration_m_s2", M_S2),
    Measure("beam plastic rotation", "beam_plastic_rotation_rad", RAD),
    Measure("column plastic rotation", "column_plastic_rotation_rad", RAD),
    Measure("column axial force", "column_axial_force_N", KN),
    Measure("brace ductility", "brace_ductility", ONE),
    Measure("brace damage", "brace_damage", ONE),
    Measure("damper strain", "damper_strain", PERCENT),
    Measure("damper deformation", "damper_deformation_m", MM),
    Measure("damper force", "damper_force_N", KN),
)


def measure_title(measure: str) -> tuple[str, str, float]:
    """Return a measure in words, its unit as shown ("" if it has no row in the tables), and that unit in SI."""
    row = next((row for row in MEASURE_ROWS if row.name == measure), Measure(measure, measure, ONE))
    return row.title, row.unit.name, row.unit.si
