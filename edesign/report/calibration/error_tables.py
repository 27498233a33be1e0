"""The errors of a calibration as tables, for the terminal and the page; how its tests start."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from edesign.calibration.residual.series import Series, Stage
from edesign.calibration.results.result import Calibration, Subject
from edesign.report.tables.column import col, text
from edesign.report.tables.number import finite
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import MM, MM_S, PERCENT, S

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


def _matters_longer(series: Series) -> str:
    return "" if series.start is None or series.start.dies_away else " (matters longer)"


def _softened(number: int) -> Callable[[Series], float | None]:
    """What had softened the law before, displacement or velocity."""
    return lambda series: (series.start.before[number] or None) if series.start is not None else None


ERRORS = TableSpec[Row](
    "errors",
    "Errors",
    (text("{model}"), col("fitted tests: NRMS", PERCENT, digits=3), col("validation tests: NRMS", PERCENT, digits=3)),
)
EACH_TEST = TableSpec[Row](
    "errors_of_each_test",
    "NRMS of each {what}",
    (
        text("test"),
        text("use"),
        *(col(label, PERCENT, digits=3) for label in STAGES.values()),
        col("noise floor", PERCENT, digits=3),
    ),
    keys=2,
    named_by_title=True,
)
STARTS = TableSpec[Series](
    "displaced_starts",
    "Tests that start away from rest",
    (
        text("test", "name"),
        col("first sample", MM, "start.displacement", form=".3g"),
        col("[]", MM_S, "start.velocity", form=".3g"),
        col("judged from", S, "start.judged_from", form=".3g", mark=_matters_longer),
        col("before: largest", MM, _softened(0), form=".3g"),
        col("largest", MM_S, _softened(1), form=".3g"),
    ),
    notes=(
        "judged from: samples before depend on how the specimen came to the first one (campaign key `start`)",
        "before: what had softened the law by then: at least so much, found from the force of each test; or as "
        "`start: at_rest` has it; -: no more than the test itself shows",
    ),
)


def errors_table(calibration: Calibration) -> Table:
    """Errors of the law before and after, and the noise floor."""
    errors = {label: calibration.errors[stage] for stage, label in STAGES.items()}
    rows: list[Row] = [(label, finite(one.fit), finite(one.validate)) for label, one in errors.items()]
    rows.append(("noise floor", finite(calibration.noise_floor_fit), finite(calibration.noise_floor)))
    if calibration.interpolation or calibration.interpolation_fit:
        both = finite(calibration.interpolation_fit), finite(calibration.interpolation)
        rows.append(("of it: motion between samples", *both))
    notes = [NRMS_NOTES[calibration.subject]]
    if calibration.doubtful:
        notes.append(f"noise floor: {calibration.doubtful}")
    if calibration.law_fixed:
        notes.append("refitted: as declared, as the campaign keeps the parameters fixed (`refit: false`)")
    if calibration.fitted_first:
        notes.append("as declared: the campaign names no parameters, so the law was fitted to the tests first")
    return ERRORS.of(rows, notes=notes, model=MODELS[calibration.subject])


def each_test_table(calibration: Calibration) -> Table:
    """Errors of each test in the order in which they were made."""
    rows: list[Row] = []
    for series in calibration.series:
        errors = (calibration.errors[stage].of(series) for stage in STAGES)
        rows.append((label_of(series), series.use, *map(finite, errors), finite(noise_of(series))))
    notes = []
    if assumed := [label_of(one) for one in calibration.series if one.assumed]:
        which = "all tests" if len(assumed) == len(calibration.series) else ", ".join(assumed)
        notes.append(
            f"noise floor of {which}: not measured, but the reproducibility of a transducer of class 0.5 (0.1 % rms); "
            "the record shows less, as one that was averaged, smoothed or computed does, and errors of that stay "
            "unseen; or its motion reaches up to the highest frequency, where noise has no place of its own"
        )
    clipped = [f"{one.name} {np.count_nonzero(one.clipped)}" for one in calibration.series if one.clipped is not None]
    if clipped:
        notes.append(
            f"clipped samples of the force, at the end of the load cell's range, are not judged: {', '.join(clipped)}"
        )
    for name, words in (
        ("spikes", "of the force are not judged"),
        ("motion_spikes", "of the displacement were interpolated, as the law needs all of it, and are not judged"),
    ):
        of_tests = [(one.name, getattr(one, name)) for one in calibration.series]
        spikes = [f"{test} {np.count_nonzero(at)}" for test, at in of_tests if at is not None]
        if spikes:
            notes.append(f"spikes {words} (samples): {', '.join(spikes)}")
    return EACH_TEST.of(rows, notes=notes, what="channel" if calibration.subject == "structure" else "test")


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
    return STARTS.of(series for series in calibration.series if series.start is not None)
