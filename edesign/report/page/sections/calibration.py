"""The sections of the report of a calibration by tests of a damper or records of a structure."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign._version import __version__
from edesign.calibration.residual.series import Series
from edesign.calibration.results.result import Subject
from edesign.report.calibration.effect_figures import effect_figures
from edesign.report.calibration.error_tables import (
    LAW_FILES,
    MODELS,
    NRMS_NOTES,
    each_test_table,
    errors_table,
    label_of,
    starts_table,
)
from edesign.report.calibration.figures import Figures
from edesign.report.calibration.history_figures import error_figures, loop_figures, residual_figures
from edesign.report.calibration.nuisance_tables import nuisance_tables
from edesign.report.calibration.residual_figures import curve_figures, dependence_figures, map_figures
from edesign.report.calibration.structure_figures import history_figures, peak_figures, spectrum_figures
from edesign.report.calibration.tables import effect_tables, law_table
from edesign.report.calibration.units import percent, scale_of
from edesign.report.calibration.verdict import no_next_test, verdict_paragraphs
from edesign.report.calibration.view import View
from edesign.report.calibration.words import name_of, searched
from edesign.report.html.section import Facts, Headline, Headlines, Part, Section
from edesign.report.page.source import drawn
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import DEGC, KN, MM, MM_S, ONE, S, Unit

_VERDICTS = {
    "none": ("None", "no effect is missing", "good"),
    "explained": ("Explained", "only noise is left", "good"),
    "partly_explained": ("Partly explained", "more than noise is left", ""),
    "nothing_found": ("Nothing found", "no effect known here explains what is left", "bad"),
    "not_searched": ("Not searched", "the search ended before all effects were tried", "bad"),
}
_OWN: dict[Subject, str] = {
    "damper": "; nuisance amplitudes, such as the phase of hum, are estimated from each test",
    "structure": "",
}
_NOISE: dict[Subject, str] = {
    "damper": "of each test the larger one of the noise of its channels and of what does not repeat from cycle to "
    "cycle or in a test made again; and what 0.2 K of the thermometer change",
    "structure": "of each channel its broadband noise, at least 0.2 % of its rms: steps of records and of the "
    "integration leave so much",
}


def _in_its_unit(value: Callable[[Series], float], digits: int) -> Callable[[Series], Quantity]:
    """A value of what a series measures, in the unit that stands in a column of its own."""

    def of(series: Series) -> Quantity:
        scale, unit = scale_of(series)
        return Quantity(value(series), Unit(unit, scale), digits, beside=True)

    return of


def _most(name: str) -> Callable[[Series], float]:
    return lambda series: float(np.max(np.abs(getattr(series, name))))


_OF_ANY_SERIES: tuple[Column[Series], ...] = (
    text("use"),
    col("duration", S, lambda series: float(np.ptp(series.time)), 3),
    count("samples", "time.size"),
)
LARGEST_OF_CHANNELS = TableSpec[Series](
    "largest_values_of_channels",
    "Largest absolute values",
    (
        text("channel", label_of),
        *_OF_ANY_SERIES,
        col("largest", ONE, _in_its_unit(_most("measured"), 3)),
        col("noise", ONE, _in_its_unit(lambda series: series.noise, 2)),
        text("unit", lambda series: scale_of(series)[1]),
    ),
    keys=2,
    named_as="largest_values",
)
LARGEST_OF_TESTS = TableSpec[Series](
    "largest_values_of_tests",
    "Largest absolute values",
    (
        text("test", label_of),
        *_OF_ANY_SERIES,
        col("displacement", MM, _most("displacement"), 3),
        col("velocity", MM_S, _most("velocity"), 3),
        col("force", KN, _most("measured"), 3),
        col("temperature", DEGC, lambda series: float(np.mean(series.temperature)), form=".1f"),
        col("noise of the force", KN, "noise", 3),
    ),
    keys=2,
    named_as="largest_values",
)


def verdict(view: View) -> Section:
    """Return what a reader should know who reads nothing else."""
    found = view.calibration
    word, detail, state = _VERDICTS[found.verdict]
    declared, corrected = (found.errors[stage].validate for stage in ("declared", "corrected"))
    effects = ", ".join(name_of(effect.name) for effect in found.effects)
    kinds = ", ".join(dict.fromkeys(effect.kind for effect in found.effects))
    changed = bool(found.effects) or not found.law_fixed
    error = f"{percent(declared)} → {percent(corrected)} %" if changed else f"{percent(declared)} %"
    file = found.law_file
    tiles = (
        Headline(word, "Verdict", detail, state),
        Headline(error, "Validation error (NRMS)", " → ".join(view.stages.values())),
        Headline(f"{percent(found.noise_floor)} %", "Noise floor", "what no model can predict, as estimated"),
        Headline(
            effects or "-",
            "Effects found",
            (f"kind: {kinds}" if kinds else "none was adopted")
            + (f"; law.yaml has {LAW_FILES[file.stage]}" if found.subject == "damper" else ""),
            "bad" if file.lacking else "",
        ),
    )
    return Section("verdict", "Verdict", verdict_paragraphs(found), (Headlines(tiles),))


def errors(view: View) -> Section:
    """Return errors before and after, by use and by test."""
    return Section(
        "errors", "Errors before and after", (), (errors_table(view.calibration), *_pictures(view, error_figures))
    )


def effects(view: View) -> Section:
    """Return effects, their parameters with intervals, and the models that were compared."""
    found = view.calibration
    text = () if found.effects else ("No effect was adopted.",)
    return Section(
        "effects", "Effects, and how sure they are", text, (*effect_tables(found), *_pictures(view, effect_figures))
    )


def open_questions(view: View) -> Section:
    """Return what is left, confounded effects, and the test that would separate them."""
    found = view.calibration
    left = percent(found.errors["corrected"].validate)
    rows = [
        ("Left", found.unexplained_shape or f"only noise, an NRMS of {left} %"),
        *(
            (name_of(one.name), "cannot be separated from " + " or ".join(map(name_of, one.indistinguishable_from)))
            for one in found.effects
            if one.indistinguishable_from
        ),
        *((f"{name_of(one.name)}, of what?", one.question) for one in found.effects if one.question),
    ]
    further = found.next_test
    if further is not None:
        names = " and ".join(map(name_of, further.separates))
        rows += [
            ("Next test", f"{further.text}: no larger, faster or warmer than the tests have shown the rig can make"),
            (
                "What it would decide",
                f"{names} would differ by an NRMS of {percent(further.difference)} %, against "
                f"{percent(further.largest)} % at most in the tests so far",
            ),
        ]
    elif no_next_test(found):
        rows.append(("Next test", no_next_test(found)))
    return Section("open", "What is left, and the next test", (), (Facts(tuple(rows)),))


def residuals(view: View) -> Section:
    """Return loops and residuals before and after; of a structure histories and spectra of its channels."""
    if view.calibration.subject == "structure":
        of_records = (peak_figures, history_figures, spectrum_figures)
        return Section("residual", "Records before and after", (), _pictures(view, *of_records))
    makers = (loop_figures, residual_figures, dependence_figures, curve_figures, map_figures)
    return Section("residual", "Residual before and after", (), _pictures(view, *makers))


def campaign(view: View) -> Section:
    """Return what was measured, and the error of each test."""
    largest = LARGEST_OF_CHANNELS if view.calibration.subject == "structure" else LARGEST_OF_TESTS
    tables: tuple[Table, ...] = (
        largest.of(view.calibration.series),
        each_test_table(view.calibration),
        starts_table(view.calibration),
        *nuisance_tables(view.calibration),
    )
    return Section("tests", "Tests", (), tuple(table for table in tables if table.rows))


def law(view: View) -> Section:
    """Return the parameters of the law or the building before and after."""
    title = "The building" if view.calibration.subject == "structure" else "The law"
    return Section("law", title, (), (law_table(view.calibration),))


def provenance(view: View) -> Section:
    """Return how the numbers were made."""
    found = view.calibration
    samples, model = sum(one.time.size for one in found.series), MODELS[found.subject]
    rows = (
        ("edesign", __version__),
        ("Measured", f"{len(found.tests)} tests, {samples:,} samples"),
        ("Time taken", f"{found.seconds:.1f} s"),
        ("Search", searched(found)),
        ("NRMS", NRMS_NOTES[found.subject].removeprefix("NRMS: ")),
        ("As declared", f"the {model} with the parameters it was given; no fit"),
        ("Refitted", f"the same {model} fitted to the tests for fitting, without effects"),
        ("Corrected", f"the {model} with the effects found, fitted to the tests for fitting{_OWN[found.subject]}"),
        ("Noise floor", _NOISE[found.subject]),
        (
            "Interval",
            "95 %: by the scatter within tests, for residuals as correlated as they are, or by that from test to test "
            "(Student's t), whichever is wider",
        ),
        (
            "Adoption",
            "an effect is adopted if tests left out of the fit are predicted better, by more than 4 in log density and "
            "than twice the error of that; its interval must not hold zero, and the validation tests must not be "
            f"predicted worse than by the refitted {model}",
        ),
        (
            "Probability",
            "of a model of the search: proportional to the exponential of its log density of tests left out",
        ),
    )
    return Section("provenance", "Provenance and definitions", (), (Facts(rows),))


def _pictures(view: View, *makers: Figures) -> tuple[Part, ...]:
    """Return the figures of makers, in their order."""
    return tuple(part for maker in makers for part in drawn(maker.__name__, lambda maker=maker: maker(view)))  # type: ignore[misc]


SECTIONS: tuple[Callable[[View], Section], ...] = (
    verdict,
    errors,
    effects,
    open_questions,
    residuals,
    campaign,
    law,
    provenance,
)
"""In the order of the page."""
