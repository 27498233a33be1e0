"""What belongs to single tests, as their zeros and hum, as tables for the terminal and the page: one a kind."""

from __future__ import annotations

import math

from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Calibration, Estimate, OfTests
from edesign.report.calibration.units import error_text, value_cell, value_text
from edesign.report.calibration.words import name_of
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import ONE

_NAMES = {
    "start": "Force at the first sample, by what no record shows",
    "temperature": "Error of the thermometer",
    "deformation before": "Softening by deformations before the tests",
    "velocity before": "Softening by velocities before the tests",
}
_NOTES = {
    "start": "beside the force after long rest at the first displacement; damage lasts in the tests that follow",
    "temperature": "as the force of each test asks for, within 0.2 K (one standard deviation)",
    "deformation before": "beyond what was found; 1: as if it had gone as far as in the test",
    "velocity before": "beyond what was found; 1: as if it had been as fast as in the test",
}
NUMBERS = TableSpec[Row](
    "numbers_of_tests",
    "{title}",
    (text("test"), col("value", ONE), text("standard error"), text("unit")),
    named_by_title=True,
)
WAVES = TableSpec[Row](
    "waves_of_tests",
    "{title}",
    (
        text("test"),
        col("amplitude", ONE),
        text("standard error"),
        text("unit"),
        col("phase", ONE),
        text("standard error"),
        text("unit"),
    ),
    named_by_title=True,
)


def nuisance_tables(calibration: Calibration) -> list[Table]:
    """Return what belongs to single tests, one table for each number that they have."""
    return [_table(one) for one in calibration.nuisances]


def _table(one: OfTests) -> Table:
    largest = max((abs(number.value) for number in one.tests.values()), default=0.0)
    rows: list[Row] = []
    for test, number in one.tests.items():
        shown = practical(_estimate(number.value, number.error, one.unit), {}, largest)
        rows.append((test, value_cell(shown), error_text(shown), shown.unit or None))
        if one.frequency is not None:
            phase = _estimate(math.degrees(number.phase), math.degrees(number.phase_error), "°")
            rows[-1] = (*rows[-1], value_cell(phase), error_text(phase), phase.unit)
    title = _NAMES.get(one.of, f"{name_of(one.of)}: {one.name} of each test")
    notes = [_NOTES[one.of]] if one.of in _NOTES else []
    if one.frequency is None:
        return NUMBERS.of(rows, notes=notes, title=title)
    hertz = f"{value_text(one.frequency)} ± {error_text(one.frequency)} Hz"
    return WAVES.of(rows, notes=[f"frequency {hertz}; phase of its sine at the first sample"], title=title)


def _estimate(value: float, error: float, unit: str) -> Estimate:
    return Estimate(value, error, unit, (math.nan, math.nan))
