"""The errors of a calibration as tables, for the terminal and the page; how its tests start."""

from __future__ import annotations

import math

import numpy as np

from edesign.calibration.residual.series import Series, Stage
from edesign.calibration.results.result import Calibration, Subject
from edesign.report.calibration.units import percent
from edesign.report.tables.table import Table, formatted

STAGES: dict[Stage, str] = {"declared": "as declared", "refit": "refitted", "corrected": "corrected"}
"""Of a law, in words."""

LAW_FILES: dict[Stage, str] = {
    "declared": "the declared law",
    "refit": "the refitted law",
    "corrected": "the corrected law",
}
"""What law.yaml has, by whose parameters it has."""

MODELS: dict[Subject, str] = {"damper": "law", "structure": "building", "table": "law"}
"""What is calibrated, in a word."""

NRMS_NOTES: dict[Subject, str] = {
    "damper": "NRMS: sum of squared errors over sum of squared measured forces, no root",
    "structure": "NRMS: sum of squared errors over sum of squared measured values, no root; of several channels each "
    "over the root mean square of its kind (accelerations, displacements) in the fitted tests",
    "table": "NRMS: mean square of the relative errors of G', G_eq and loss factor",
}


def errors_table(calibration: Calibration) -> Table:
    """Errors of the law before and after, and the noise floor."""
    table = Table(
        "Errors", (MODELS[calibration.subject], "fitted tests: NRMS [%]", "validation tests: NRMS [%]"), name="errors"
    )
    for stage, label in STAGES.items():
        errors = calibration.errors[stage]
        table.rows.append([label, percent(errors.fit), percent(errors.validate)])
    table.rows.append(["noise floor", percent(calibration.noise_floor_fit), percent(calibration.noise_floor)])
    table.notes.append(NRMS_NOTES[calibration.subject])
    if calibration.law_held:
        table.notes.append("refitted: as declared, as the campaign has the parameters held (`refit: false`)")
    if calibration.fitted_first:
        table.notes.append("as declared: the campaign names no parameters, so the law was fitted to the tests first")
    return table


def each_test_table(calibration: Calibration) -> Table:
    """Errors of each test in the order in which they were made."""
    columns = ("test", "use", *(f"{label} [%]" for label in STAGES.values()), "noise floor [%]")
    table = Table(
        "NRMS of each channel" if calibration.subject == "structure" else "NRMS of each test", columns, left=2
    )
    for series in calibration.series:
        errors = [percent(calibration.errors[stage].of(series)) for stage in STAGES]
        table.rows.append([label_of(series), series.use, *errors, percent(noise_of(series))])
    clipped = [f"{one.name} {np.count_nonzero(one.clipped)}" for one in calibration.series if one.clipped is not None]
    if assumed := [label_of(one) for one in calibration.series if one.assumed]:
        which = "all tests" if len(assumed) == len(calibration.series) else ", ".join(assumed)
        table.notes.append(
            f"noise floor of {which}: not measured, but the reproducibility of a transducer of class 0.5 (0.1 % rms); "
            "the record shows less, as one that was averaged, smoothed or computed does, and errors of that stay unseen"
        )
    if clipped:
        table.notes.append(
            f"clipped samples of the force, at the end of the load cell's range, are not judged: {', '.join(clipped)}"
        )
    return table


def label_of(series: Series) -> str:
    """Name of a test, or of a channel, and the title of the test, if it has one."""
    if series.test:
        return series.name
    return f"{series.name}: {series.title}" if series.title and series.title != series.name else series.name


def noise_of(series: Series) -> float:
    """NRMS of the noise of a test, over the samples that are judged."""
    power = float(np.mean(series.measured[series.counted] ** 2))
    return series.noise**2 / power if power > 0.0 else math.nan


def starts_table(calibration: Calibration) -> Table:
    """Tests that start away from rest; no rows if all start at rest."""
    table = Table(
        "Tests that start away from rest",
        ("test", "first sample [mm]", "[mm/s]", "judged from [s]", "before: largest [mm]", "largest [mm/s]"),
        name="displaced_starts",
    )
    started = [(series.name, series.start) for series in calibration.series if series.start is not None]
    for name, start in started:
        softened = [formatted(1e3 * value, ".3g") if value else "-" for value in start.before]
        from_then = formatted(start.judged_from, ".3g") + ("" if start.dies_away else " (matters longer)")
        table.rows.append(
            [
                name,
                formatted(1e3 * start.displacement, ".3g"),
                formatted(1e3 * start.velocity, ".3g"),
                from_then,
                *softened,
            ]
        )
    if started:
        table.notes.append(
            "judged from: samples before depend on how the specimen came to the first one (campaign key `start`)"
        )
        table.notes.append(
            "before: what had softened the law by then: at least so much, found from the force of each test; or as "
            "`start: at_rest` has it; -: no more than the test itself shows"
        )
    return table
