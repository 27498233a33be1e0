"""What a calibration by a property table found: tables and figures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.properties.residual_words import relative_errors
from edesign.damper.testing.steady_state import PropertyRows
from edesign.report.calibration.error_tables import STAGES
from edesign.report.calibration.units import percent
from edesign.report.damper.property_figures import QUANTITIES, property_figure, residual_figure
from edesign.report.tables.column import col, text
from edesign.report.tables.number import finite
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import PERCENT

if TYPE_CHECKING:
    from matplotlib.figure import Figure


PROPERTY_ERRORS = TableSpec[Row](
    "property_errors",
    "Relative errors of the properties, rms [%]",
    (
        text("law"),
        text("rows"),
        *(col(name, PERCENT, digits=3, silent=True) for name, _, _ in QUANTITIES.values()),
        col("all", PERCENT, digits=3, silent=True),
    ),
    keys=2,
)
EACH_GROUP = TableSpec[Row](
    "property_errors_by_condition",
    "Relative errors of each temperature and strain, rms [%]",
    (text("rows"), text("use"), *(col(label, PERCENT, digits=3, silent=True) for label in STAGES.values())),
    keys=2,
)


def property_errors_table(calibration: PropertyCalibration) -> Table:
    """Root mean square of the relative errors of each property before and after."""
    rows: list[Row] = []
    for stage, label in STAGES.items():
        residuals = relative_errors(calibration.rows[stage], calibration.campaign.table)
        for use, words in (("fit", "fitted"), ("validate", "held out")):
            of = np.concatenate([group.rows for group in calibration.campaign.groups if group.use == use])
            each = [float(np.sqrt(np.mean(r[of] ** 2))) for r in residuals.values()]
            rows.append((label, words, *map(finite, each), finite(float(np.sqrt(np.mean(np.square(each)))))))
    repeats = f"rows repeat to {percent(calibration.repeats)} %, as their smoothness over frequency and strain shows"
    return PROPERTY_ERRORS.of(rows, notes=[repeats])


def each_group_table(calibration: PropertyCalibration) -> Table:
    """Root mean square of the relative errors of each group of rows."""
    rows: list[Row] = []
    for group in calibration.campaign.groups:
        errors = (float(np.sqrt(calibration.errors[stage].tests[group.name])) for stage in STAGES)
        rows.append((group.name, group.use, *map(finite, errors)))
    return EACH_GROUP.of(rows)


def property_calibration_figures(calibration: PropertyCalibration) -> Iterator[tuple[str, str, Figure]]:
    """Name, caption and figure, one after the other."""
    table = calibration.campaign.table
    measured = PropertyRows(
        table.strain, table.frequency, table.temperature_C, table.G_storage, table.G_eq, table.G_loss, table.loss_factor
    )
    for stage, label in STAGES.items():
        yield (
            f"properties-{stage}",
            f"Properties over frequency, measured (points) and by the law {label} (lines).",
            property_figure(measured, calibration.rows[stage]),
        )
    for stage, label in STAGES.items():
        yield (
            f"residuals-{stage}",
            f"Relative residuals of the law {label}, means over temperature.",
            residual_figure(relative_errors(calibration.rows[stage], table), measured),
        )
