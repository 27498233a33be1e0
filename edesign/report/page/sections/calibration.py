"""What sections of the report of a calibration are made of: figures, tables of what was measured."""

from __future__ import annotations

import numpy as np

from edesign.calibration.results.result import Calibration
from edesign.report.calibration.figures import Figures
from edesign.report.calibration.tables import label_of
from edesign.report.calibration.units import scale_of
from edesign.report.calibration.view import View
from edesign.report.page.section import Picture
from edesign.report.page.source import picture_of
from edesign.report.tables.table import Table, formatted, number, whole


def channels_table(found: Calibration) -> Table:
    """Largest values and noise of each channel."""
    columns = ("channel", "use", "duration [s]", "samples", "largest", "noise", "unit")
    table = Table("Largest absolute values", columns, left=2, name="largest_values")
    for one in found.series:
        scale, unit = scale_of(one)
        row = [label_of(one), one.use, number(float(np.ptp(one.time)), 3), whole(one.time.size)]
        largest = float(np.max(np.abs(one.measured)))
        table.rows.append([*row, number(largest, 3, scale), number(one.noise, 2, scale), unit])
    return table


def tests_table(found: Calibration) -> Table:
    """Range and noise of each test."""
    columns = ("test", "use", "duration [s]", "samples", "displacement [mm]", "velocity [mm/s]", "force [kN]")
    table = Table(
        "Largest absolute values",
        (*columns, "temperature [degC]", "noise of the force [kN]"),
        left=2,
        name="largest_values",
    )
    for one in found.series:
        largest = [float(np.max(np.abs(values))) for values in (one.displacement, one.velocity, one.measured)]
        row = [label_of(one), one.use, number(float(np.ptp(one.time)), 3), whole(one.time.size)]
        row += [number(value, 3, scale) for value, scale in zip(largest, (1e-3, 1e-3, 1e3), strict=True)]
        table.rows.append([*row, formatted(float(np.mean(one.temperature)), ".1f"), number(one.noise, 3, 1e3)])
    return table


def pictures(view: View, *makers: Figures) -> tuple[Picture, ...]:
    """Return the figures of makers, in their order."""
    return tuple(picture_of(*item) for maker in makers for item in maker(view))
