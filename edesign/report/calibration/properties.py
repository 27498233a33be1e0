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
from edesign.report.tables.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def property_errors_table(calibration: PropertyCalibration) -> Table:
    """Root mean square of the relative errors of each property before and after."""
    columns = ("law", "rows", *(name for name, _, _ in QUANTITIES.values()), "all")
    table = Table("Relative errors of the properties, rms [%]", columns, left=2, name="property_errors")
    for stage, label in STAGES.items():
        residuals = relative_errors(calibration.rows[stage], calibration.campaign.table)
        for use, words in (("fit", "fitted"), ("validate", "held out")):
            rows = np.concatenate([group.rows for group in calibration.campaign.groups if group.use == use])
            each = [float(np.sqrt(np.mean(r[rows] ** 2))) for r in residuals.values()]
            table.rows.append([label, words, *map(percent, each), percent(float(np.sqrt(np.mean(np.square(each)))))])
    table.notes.append(
        f"rows repeat to {percent(calibration.repeats)} %, as their smoothness over frequency and strain shows"
    )
    return table


def each_group_table(calibration: PropertyCalibration) -> Table:
    """Root mean square of the relative errors of each group of rows."""
    table = Table(
        "Relative errors of each temperature and strain, rms [%]",
        ("rows", "use", *STAGES.values()),
        left=2,
        name="property_errors_by_condition",
    )
    for group in calibration.campaign.groups:
        errors = [calibration.errors[stage].tests[group.name] for stage in STAGES]
        table.rows.append([group.name, group.use, *(percent(float(np.sqrt(e))) for e in errors)])
    return table


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
