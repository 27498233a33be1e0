"""The sections of the report of a calibration."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign._version import __version__
from edesign.calibrate.result import Calibration
from edesign.calibrate.side_by_side import side_by_side
from edesign.report.calibration.effect_figures import effect_figures
from edesign.report.calibration.effect_tables import (
    NOT_ASKED,
    effect_name,
    effect_parameters_table,
    effects_table,
    hypotheses_table,
    refused_table,
)
from edesign.report.calibration.figures import Figures
from edesign.report.calibration.history_figures import error_figures, loop_figures, residual_figures
from edesign.report.calibration.residual_figures import dependence_figures, harmonic_figures, map_figures
from edesign.report.calibration.structure_figures import history_figures, peak_figures, spectrum_figures
from edesign.report.calibration.tables import (
    MODELS,
    NRMS_NOTES,
    each_test_table,
    errors_table,
    label_of,
    law_parameters_table,
    starts_table,
    verdict_text,
)
from edesign.report.calibration.units import Calibrated, percent, scale_of
from edesign.report.calibration.view import View
from edesign.report.page.section import Facts, Headline, Headlines, Part, Picture, Section
from edesign.report.page.source import picture_of
from edesign.report.tables.table import Table, formatted, number, whole

_VERDICTS = {
    "none": ("None", "no effect is missing", "good"),
    "explained": ("Explained", "only noise is left", "good"),
    "partly_explained": ("Partly explained", "more than noise is left", ""),
    "unexplained": ("Unexplained", "no effect known here explains what is left", "bad"),
    "not_searched": ("Not searched", "the search ended before all effects were tried", "bad"),
}


def verdict(view: View) -> Section:
    """What a reader should know who reads nothing else."""
    found = _found(view)
    word, detail, state = _VERDICTS[found.verdict]
    declared, corrected = (found.errors[stage].validate for stage in ("declared", "corrected"))
    effects = ", ".join(effect_name(effect.name) for effect in found.effects)
    kinds = ", ".join(dict.fromkeys(effect.kind for effect in found.effects))
    changed = bool(found.effects) or not found.law_held
    error = f"{percent(declared)} → {percent(corrected)} %" if changed else f"{percent(declared)} %"
    tiles = (
        Headline(word, "Verdict", detail, state),
        Headline(error, "Validation error (NRMS)", " → ".join(view.stages.values())),
        Headline(
            f"{percent(found.noise_floor)} %",
            "Noise floor",
            "the error that noise and thermometers leave, as estimated",
        ),
        Headline(effects or "-", "Effects found", f"kind: {kinds}" if kinds else "none was adopted"),
    )
    return Section("verdict", "Verdict", (verdict_text(found),), (Headlines(tiles),))


def errors(view: View) -> Section:
    """Errors before and after, by use and by test."""
    return Section(
        "errors", "Errors before and after", (), (errors_table(_found(view)), *pictures(view, error_figures))
    )


def effects(view: View) -> Section:
    """Effects, their parameters with intervals, and candidates that were not adopted."""
    found = _found(view)
    parts: list[Part] = [effects_table(found)]
    tables = (effect_parameters_table(found), hypotheses_table(found), refused_table(found))
    parts += [table for table in tables if table.rows]
    return Section("effects", "Effects, and how sure they are", (), (*parts, *pictures(view, effect_figures)))


def left(view: View) -> Section:
    """What is left unexplained."""
    found = _found(view)
    rows: tuple[tuple[str, str], ...]
    if found.unexplained_shape:
        share, model = percent(found.unexplained_share, 2), MODELS[found.subject]
        rows = (
            ("Share left", f"{share} % of the error of the refitted {model} above noise"),
            ("Shape", found.unexplained_shape),
        )
    else:
        rows = (
            (
                "Left",
                f"only noise, {percent(found.noise_floor)} % of what was measured, squared, in the validation tests",
            ),
        )
    return Section("left", "What is left", (), (Facts(rows),))


def open_questions(view: View) -> Section:
    """Look-alikes and the test that would separate them."""
    found = _found(view)
    rows = [
        (
            effect_name(effect.name),
            "cannot be told from " + " or ".join(map(effect_name, effect.indistinguishable_from)),
        )
        for effect in found.effects
        if effect.indistinguishable_from
    ]
    further = found.next_test
    if further is not None:
        names = " and ".join(map(effect_name, further.separates))
        rows.append(("Next test", further.text))
        rows.append(
            (
                "What it would tell",
                f"{names} would differ by an NRMS of {percent(further.difference)} %, against "
                f"{percent(further.largest)} % at most in the tests so far",
            )
        )
    if not rows:
        none = "no other known effect explains the tests as well" if found.ending == "complete" else NOT_ASKED
        rows.append(("Look-alikes", none if found.effects else "no effect was adopted"))
    return Section("open", "What the data cannot tell, and the next test", (), (Facts(tuple(rows)),))


def residuals(view: View) -> Section:
    """Loops and residuals before and after; of a structure histories and spectra of its channels."""
    if _found(view).subject == "structure":
        return Section(
            "residual", "Records before and after", (), pictures(view, peak_figures, history_figures, spectrum_figures)
        )
    makers = (loop_figures, residual_figures, dependence_figures, harmonic_figures, map_figures)
    return Section("residual", "Residual before and after", (), pictures(view, *makers))


def campaign(view: View) -> Section:
    """What was measured, and the error of each test."""
    found = _found(view)
    ranges = channels_table(found) if found.subject == "structure" else tests_table(found)
    started = [table for table in (starts_table(found),) if table.rows]
    return Section("tests", "Tests", (), (ranges, each_test_table(found), *started))


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


def tests_table(found: Calibrated) -> Table:
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


def law(view: View) -> Section:
    """Parameters of the law or the building before and after."""
    title = "The building" if _found(view).subject == "structure" else "The law"
    return Section("law", title, (), (law_parameters_table(_found(view)),))


def provenance(view: View) -> Section:
    """How the numbers were made."""
    found = _found(view)
    samples = sum(one.time.size for one in found.series)
    model = MODELS[found.subject]
    rows = (
        ("edesign", __version__),
        ("Measured", f"{len(found.tests)} tests, {samples:,} samples"),
        ("Time taken", f"{found.seconds:.1f} s"),
        ("NRMS", NRMS_NOTES[found.subject].removeprefix("NRMS: ")),
        ("As declared", f"the {model} with the parameters it was given; no fit"),
        ("Refitted", f"the same {model} fitted to the tests for fitting, without effects: the rival of every effect"),
        (
            "Corrected",
            f"the {model} with the effects found, fitted to the tests for fitting; shares that are each test's own, "
            "such as the phase of hum, are taken from that test",
        ),
        (
            "Interval",
            "95 %: by the scatter within tests, for residuals as correlated as they are, or by that from test to test "
            "(Student's t), whichever is wider",
        ),
        (
            "Adoption",
            "an effect is adopted if it lowers the error of tests left out of the fit by more than chance, the "
            "information criterion (BIC) agrees, and its interval does not reach to nothing",
        ),
    )
    return Section("provenance", "Provenance and definitions", (), (Facts(rows),))


def _found(view: View) -> Calibration:
    assert isinstance(view.calibration, Calibration)
    return view.calibration


def pictures(view: View, *makers: Figures) -> tuple[Picture, ...]:
    """Return the figures of makers, drawn side by side."""

    def drawn(maker: Figures) -> list[Picture]:
        return [picture_of(*item) for item in maker(view)]

    return tuple(picture for own in side_by_side(drawn, makers, view.workers) for picture in own)


SECTIONS: tuple[Callable[[View], Section], ...] = (
    verdict,
    errors,
    effects,
    left,
    open_questions,
    residuals,
    campaign,
    law,
    provenance,
)
"""In the order of the page."""
