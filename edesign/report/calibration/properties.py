"""What a calibration by a property table found: tables and figures."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.calibrate.properties.result import PropertyCalibration
from edesign.calibrate.properties.shape import relative
from edesign.damper.testing.steady_state import PropertyRows
from edesign.report.calibration.effect_tables import effect_name, effect_tables
from edesign.report.calibration.tables import (
    NOT_SEARCHED,
    STAGES,
    effect_text,
    ended,
    hypothesis_text,
    law_parameters_table,
    worst_text,
)
from edesign.report.calibration.units import percent
from edesign.report.damper.property_figures import QUANTITIES, property_figure, residual_figure
from edesign.report.tables.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_VERDICTS = {
    "none": "No effect is missing from the law.",
    "explained": "Explained: ",
    "partly_explained": "Partly explained: ",
    "unexplained": "Unexplained: something is missing, and no effect known here explains it.",
    "not_searched": NOT_SEARCHED,
}


def property_tables(calibration: PropertyCalibration) -> list[Table]:
    """All tables, in the order of a report on a terminal."""
    return [
        property_errors_table(calibration),
        each_group_table(calibration),
        *effect_tables(calibration.found),
        law_parameters_table(calibration.found),
    ]


def property_errors_table(calibration: PropertyCalibration) -> Table:
    """Root mean square of the relative errors of each property before and after."""
    columns = ("law", "rows", *(name for name, _, _ in QUANTITIES.values()), "all")
    table = Table("Relative errors of the properties, rms [%]", columns, left=2, name="property_errors")
    for stage, label in STAGES.items():
        residuals = relative(calibration.rows[stage], calibration.campaign.table)
        for use, words in (("fit", "fitted"), ("validate", "held out")):
            rows = np.concatenate([group.rows for group in calibration.campaign.groups if group.use == use])
            each = [float(np.sqrt(np.mean(r[rows] ** 2))) for r in residuals.values()]
            table.rows.append([label, words, *map(percent, each), percent(float(np.sqrt(np.mean(np.square(each)))))])
    table.notes.append(
        f"rows repeat to {percent(calibration.noise)} %, as their smoothness over frequency and strain shows"
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
        errors = [calibration.found.errors[stage].tests[group.name] for stage in STAGES]
        table.rows.append([group.name, group.use, *(percent(float(np.sqrt(e))) for e in errors)])
    return table


def property_verdict(calibration: PropertyCalibration) -> str:
    """The verdict in a plain paragraph."""
    found = calibration.found
    declared, refit, corrected = (percent(float(np.sqrt(found.errors[stage].validate))) for stage in STAGES)
    texts = [_VERDICTS[found.verdict] + "; and ".join(effect_text(effect) for effect in found.effects)]
    if found.effects:
        texts[0] += "."
    texts.append(
        f"The rms relative error of properties held out is {declared} % as declared, {refit} % with the law alone "
        f"fitted again, {corrected} % corrected; rows repeat to {percent(calibration.noise)} %."
    )
    texts += [*worst_text(found.worst), *ended(found), *map(hypothesis_text, found.hypotheses)]
    if found.unexplained_shape:
        texts.append(f"What is left: {found.unexplained_shape}")
    for effect in found.effects:
        if effect.indistinguishable_from:
            alike = " or ".join(effect_name(name) for name in effect.indistinguishable_from)
            texts.append(f"This table cannot tell {effect_name(effect.name)} from {alike}.")
    if found.next_test is not None:
        names = " from ".join(effect_name(name) for name in found.next_test.separates)
        texts.append(f"To tell {names}: {found.next_test.text}.")
    return " ".join(texts)


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
            residual_figure(relative(calibration.rows[stage], table), measured),
        )
