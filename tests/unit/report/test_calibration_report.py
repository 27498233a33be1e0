"""Report of a calibration: numbers in tables, verdict, figures and page against closed forms of the example.

Reference: a gain of 5 % on a force F leaves 0.05 F, so the NRMS as declared is (0.05^2 p + s^2) / (1.05^2 p + s^2) with
the mean square p of the law's force over whole cycles, U^2 (k^2 + (omega c)^2) / 2, and that of the noise s^2.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from unit.report import calibration_example as example
from unit.report.calibration_example import estimate

from edesign.calibration.residual.series import Worst
from edesign.calibration.results.law_file import law_lines
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import (
    Calibration,
    Estimate,
    Hypothesis,
    OfTest,
    OfTests,
    OtherLaw,
)
from edesign.calibration.write import calibration_json
from edesign.report.calibration.effect_figures import effect_figures
from edesign.report.calibration.error_tables import errors_table
from edesign.report.calibration.figures import calibration_figures
from edesign.report.calibration.nuisance_tables import nuisance_tables
from edesign.report.calibration.residual_figures import telling_dependences
from edesign.report.calibration.tables import (
    effect_parameters_table,
    effects_table,
    hypotheses_table,
    law_table,
    models_table,
    tables_of,
)
from edesign.report.calibration.units import interval_text, percent, plus_minus, value_text
from edesign.report.calibration.verdict import verdict_text
from edesign.report.calibration.view import View, outline
from edesign.report.calibration.words import searched
from edesign.report.html.render import render
from edesign.report.page.calibration import calibration_page
from edesign.report.tables.table import Table
from edesign.report.tables.text import plain

SHOWN = 5e-3  # relative: three digits are shown


def page_text_of(calibration: Calibration) -> str:
    """The report of a calibration as HTML."""
    page = calibration_page(calibration)
    return render(page.cover, page.sections)


def closed_form(frequency: float, amplitude: float, gain: float) -> float:
    """NRMS (ratio) of a law that lacks so much of the gain; noise of alternating sign is orthogonal to the sines."""
    omega = 2.0 * math.pi * frequency
    power = amplitude**2 * (example.K**2 + (omega * example.C) ** 2) / 2.0
    return (gain**2 * power + example.NOISE**2) / ((1.0 + example.GAIN) ** 2 * power + example.NOISE**2)


def row(table: Table, first: str) -> list[str]:
    return next(cells for cells in table.texts if cells[0] == first)


def text_of(page: str) -> str:
    """What a reader sees, without figures."""
    words = re.sub(r"<svg.*?</svg>|<style.*?</style>", " ", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", words))


@pytest.mark.parametrize(
    ("label", "gain"), [("as declared", 0.05), ("refitted", 0.01), ("corrected", 0.0), ("noise floor", 0.0)]
)
def test_errors_are_those_of_the_closed_form_in_per_cent(label: str, gain: float) -> None:
    cells = row(errors_table(example.calibration()), label)
    for cell, (_, frequency, amplitude, _) in zip(cells[1:], example.TESTS, strict=True):
        assert float(cell) == pytest.approx(100.0 * closed_form(frequency, amplitude, gain), rel=SHOWN)


def test_errors_of_each_test_stand_beside_its_noise() -> None:
    table = next(table for table in tables_of(example.calibration()) if "each test" in table.title)
    expected = [100.0 * closed_form(2.0, 0.002, gain) for gain in (0.05, 0.01, 0.0, 0.0)]
    cells = row(table, "fast: 2 Hz")
    assert cells[1] == "validate"
    assert [float(cell) for cell in cells[2:]] == pytest.approx(expected, rel=SHOWN)


@pytest.mark.parametrize(
    ("estimate", "text", "interval"),
    [
        (estimate(0.004, 1e-4, "s"), "4.00 ± 0.10 ms", "3.80 to 4.20"),
        (estimate(5.0, 0.5, "s"), "5.00 ± 0.50 s", "4.00 to 6.00"),
        (estimate(1500.0, 25.0, "N"), "1.500 ± 0.025 kN", "1.450 to 1.550"),
        (estimate(2.0e6, 3.0e3, "N/m"), "2.0000 ± 0.0030 kN/mm", "1.9940 to 2.0060"),
        (estimate(-3.0e-4, 2.0e-4, "m"), "-0.30 ± 0.20 mm", "-0.70 to 0.10"),
        (estimate(6.15, 0.5, "N/m"), "0.00615 ± 0.00050 N/mm", "0.00515 to 0.00715"),
        (estimate(0.0, 25.0, "N"), "0.000 ± 0.025 kN", "-0.050 to 0.050"),
        (estimate(150.0, 12.0, "kg"), "150 ± 12 kg", "126 to 174"),
        (estimate(2.0e-4, 1e-5, "1/J"), "0.200 ± 0.010 1/kJ", "0.180 to 0.220"),
        (estimate(25.0, 0.5, "degC"), "25.00 ± 0.50 degC", "24.00 to 26.00"),
    ],
)
def test_numbers_are_shown_in_units_of_a_laboratory(estimate: Estimate, text: str, interval: str) -> None:
    shown = practical(estimate, {})
    assert (plus_minus(shown), interval_text(shown)) == (text, interval)


def test_stages_of_a_parameter_stand_in_the_unit_of_the_declared_one() -> None:
    times = {"declared": 0.12, "refit": 0.08, "corrected": 0.05}  # s; alone the last two would be printed in ms
    stages = {stage: {"tau": estimate(value, 1e-3, "s")} for stage, value in times.items()}
    cells = row(law_table(replace(example.calibration(), parameters=stages)), "tau")  # type: ignore[arg-type]
    assert cells[1:4] == ["s", "0.12", "0.0800"] and cells[5] == "0.0500"


def test_a_unit_with_an_exponent_takes_that_of_its_sibling() -> None:
    # 1 N (s/m)^0.5 = 1e-3 kN (1e-3 s/mm)^0.5 = 10^-4.5 kN (s/mm)^0.5
    siblings = {"alpha": estimate(0.5, 0.01, "")}
    shown = practical(estimate(1e4, 1e3, "N*(s/m)^alpha"), siblings)
    assert shown.unit == "kN*(s/mm)^alpha"
    assert shown.value == pytest.approx(1e4 * 10.0**-4.5, rel=1e-12)
    assert shown.standard_error == pytest.approx(1e3 * 10.0**-4.5, rel=1e-12)


@pytest.mark.parametrize("error", [math.nan, math.inf])
def test_an_error_that_is_not_finite_is_named(error: float) -> None:
    found = example.calibration((example.gain(error),))
    cells = row(effect_parameters_table(found), "gain.force")
    assert cells[2:4] == ["0.05", "not determined"]
    assert "g = 0.05 (uncertainty not determined)" in verdict_text(found)
    assert not re.search(r"\b(nan|inf)\b", "\n".join(plain(table) for table in tables_of(found)))


def test_digits_follow_the_error_and_lost_signs_are_no_minus_zero() -> None:
    assert value_text(estimate(1234.567, 250.0, "")) == "1230"
    assert value_text(estimate(-0.004, 0.1, "")) == "0.00"
    assert value_text(estimate(3.0e9, 1.0, "")) == "3e+09"
    assert (percent(0.012), percent(2.4e-5), percent(math.nan)) == ("1.20", "0.00240", "-")


def test_an_effect_is_reported_with_its_evidence_and_confounded_effects() -> None:
    found = example.confounded()
    cells = row(effects_table(found), "softening with amplitude of the whole force")
    assert cells[1:3] == ["payne.whole", "damper"]
    without = 100.0 * (closed_form(2.0, 0.002, 0.0) + 1.1e-4)
    assert float(cells[3]) == pytest.approx(without, rel=SHOWN)
    assert cells[4:] == ["120.0 ± 9.0", "97.0 %", "mullins (2.00 %), self heating (under 0.0100 %)"]
    parameters = [row[1:5] for row in effect_parameters_table(found).texts]
    assert parameters == [
        ["d", "0.200", "0.180 to 0.220", "-"],
        ["a0", "3.00", "2.60 to 3.40", "mm"],
        ["m", "1.00", "0.80 to 1.20", "-"],
        ["tau_a", "5.00", "4.00 to 6.00", "s"],
    ]
    assert effect_parameters_table(found).texts[0][5] == "share of the force that goes; negative: that comes"


def test_models_are_reported_with_how_far_the_search_looked() -> None:
    table = models_table(example.calibration())
    assert [cells[0] for cells in table.texts] == ["gain.force", "inertia.mass", "the law alone"]
    assert table.texts[1][2:] == ["31.0 ± 4.0", "under 0.0100 %", "-"]
    assert "2 rounds over up to 90 of 93 forms of effects, 26 models fitted; effort 1462 of 20000" in table.notes


@pytest.mark.parametrize("ending", ["effort_spent", "interrupted"])
def test_a_search_that_did_not_come_to_its_end_says_so(ending: str) -> None:
    found = replace(example.calibration(), ending=ending)  # type: ignore[arg-type]
    for text in (verdict_text(found), text_of(page_text_of(found))):
        assert "there may be more effects, and others like these" in text
    nothing = replace(example.more_is_left(), verdict="not_searched", ending=ending, depths=())  # type: ignore[arg-type]
    text = verdict_text(nothing)
    assert text.startswith("Not searched: something is missing") and "no effect known here" not in text
    assert "effects may have been missed. So far: no effect was screened to the end; effort 1462 of 20000" in text
    page = text_of(page_text_of(nothing))
    assert "Not searched" in page and "no effect known here" not in page
    assert nothing.verdict_words.startswith("not searched, the search ")


def test_a_hypothesis_stands_beside_the_effects_with_its_reason() -> None:
    one = Hypothesis(example.payne(), "its 95 % interval holds zero")
    found = replace(example.calibration(), hypotheses=(one,))
    (cells,) = hypotheses_table(found).texts
    assert cells[0] == "softening with amplitude of the whole force (payne.whole)"
    assert cells[1].startswith("d = 0.200 ± 0.010") and cells[2] == one.why
    assert "A hypothesis, no part of the law: softening with amplitude of the whole force" in verdict_text(found)
    assert "Hypotheses: found, no part of the law" in text_of(page_text_of(found))
    assert hypotheses_table(example.calibration()).rows == []


def test_a_law_at_the_end_of_what_it_can_do_is_told_where_more_is_left() -> None:
    found = example.more_is_left()
    stage = found.law_file.stage
    name, *_ = found.parameters[stage]
    bound = {**found.parameters[stage], name: estimate(1.0, math.inf, "", not_determined="at its lower bound")}
    told = f"The law {found.law} is at the end of what it can do: {name} at its lower bound."
    assert told in verdict_text(replace(found, parameters={**found.parameters, stage: bound}))
    assert "at the end of what it can do" not in verdict_text(found)
    fine = example.calibration()
    assert fine.verdict == "explained"
    at_bound = {each: bound for each in fine.parameters}
    assert "at the end of what it can do" not in verdict_text(replace(fine, parameters=at_bound))


def test_what_the_tests_do_not_determine_is_reported_with_the_reason() -> None:
    bound = estimate(0.5, math.inf, "", not_determined="at its upper bound")
    effect = replace(example.gain(), parameters={"g": bound})
    found = example.calibration((effect,))
    table = effect_parameters_table(found)
    assert table.texts[0][2:4] == ["0.5", "not determined"]
    assert table.notes == ["gain.force: g not determined, at its upper bound"]
    text = verdict_text(found)
    assert "(instrument, g = 0.5 (not determined))" in text
    assert "g of gain.force is at the end of what is likely" in text
    assert "at the end of what is likely" not in verdict_text(example.calibration())
    # an interval need not be symmetric
    time = replace(example.lag(), parameters={"lag": Estimate(0.004, 1e-4, "s", (0.0037, 0.0044))})
    assert effect_parameters_table(example.calibration((time,))).texts[0][3] == "3.70 to 4.40"


def test_a_law_that_is_another_one_with_the_effects_is_questionable() -> None:
    found = replace(example.calibration(), law_fixed=False)
    times = {name: estimate(7.0 * one.value, 1.0, one.unit) for name, one in found.parameters["refit"].items()}
    text = verdict_text(replace(found, parameters={**found.parameters, "corrected": times}))
    assert "With the effects the law is another one: k is 7 times, c is 7 times that of the one fitted alone" in text
    assert "is another one" not in verdict_text(found)


def test_another_law_that_does_better_is_reported_first() -> None:
    other = OtherLaw("maxwell", "spring and dashpot in series", 250.0, 20.0, 1e-5, 1e-3, 2e-5, 2e-3)
    fixed = replace(example.calibration(), other_law=other)
    assert "the law kelvin_voigt fixed as declared" in verdict_text(fixed)
    assert "Calibrate without `refit: false` first" in verdict_text(fixed)
    assert any("`refit: false`" in note for note in errors_table(fixed).notes)
    text = verdict_text(replace(fixed, law_fixed=False))
    assert text.startswith("Another law does better: maxwell (spring and dashpot in series), without any effect")
    assert (
        "Calibrate with `law: {type: maxwell}`" in text and "gain of the force channel (instrument): that may" in text
    )


def test_an_effect_that_makes_the_validation_tests_worse_is_questionable() -> None:
    effect = replace(example.gain(), delta_validate=-0.5 * example.calibration().errors["corrected"].validate)
    found = replace(example.calibration((effect,)), verdict="partly_explained")
    assert "Without gain the validation tests are predicted better" in verdict_text(found)


def test_parameters_that_others_make_needless_are_reported() -> None:
    found = replace(example.calibration(), fixed={"N": "only the slip force mu N acts on the damper"})
    notes = law_table(found).notes
    assert "N is fixed as declared: only the slip force mu N acts on the damper" in notes
    moved = replace(found, fixed={"c": "it is held at A - beta"})
    assert "c is not fitted: it is held at A - beta" in law_table(moved).notes


def test_what_belongs_to_single_tests_stands_by_their_names_with_errors() -> None:
    zeros = OfTests("offset.per_test", "zero", "N", {"slow": OfTest(-310.0, 2.0), "fast": OfTest(42.0, 3.0)})
    wave = {"fast": OfTest(1500.0, 20.0, math.pi / 3.0, math.radians(2.0))}
    hum = OfTests("hum.tone", "hum", "N", wave, estimate(49.983, 0.002, "Hz"))
    start = OfTests("start", "force", "N", {"fast": OfTest(-2500.0, 100.0)})
    found = replace(example.calibration(), nuisances=(zeros, hum, start))
    of_zeros, of_hum, of_start = nuisance_tables(found)
    assert of_zeros.title == "offset.per_test: zero of each test"
    assert [row(of_zeros, name) for name in ("slow", "fast")] == [
        ["slow", "-0.3100", "0.0020", "kN"],
        ["fast", "0.0420", "0.0030", "kN"],
    ]
    assert row(of_hum, "fast") == ["fast", "1.500", "0.020", "kN", "60.0", "2.0", "°"]
    assert of_hum.notes[0].startswith("frequency 49.9830 ± 0.0020 Hz")
    assert row(of_start, "fast") == ["fast", "-2.50", "0.10", "kN"]
    page = text_of(page_text_of(found))
    assert all(table.title in page for table in (of_zeros, of_hum, of_start))
    of_programs = calibration_json(found)["nuisances"]
    assert of_programs[0]["tests"]["slow"] == {"value": -310.0, "standard_error": 2.0}
    assert of_programs[1]["frequency"]["value"] == 49.983 and of_programs[1]["unit"] == "N"
    assert of_programs[1]["tests"]["fast"]["phase"] == pytest.approx(math.pi / 3.0)


def test_law_parameters_stand_with_their_intervals_or_as_fixed() -> None:
    table = law_table(example.calibration())
    assert row(table, "k") == ["k", "kN/mm", "2", "2.0800", "2.0740 to 2.0860", "2", "fixed"]
    assert any("declared parameters fixed" in note for note in table.notes)
    assert row(law_table(example.more_is_left()), "k")[5:] == ["2.0800", "2.0740 to 2.0860"]


def test_what_a_law_file_cannot_carry_is_reported() -> None:
    found = example.confounded()
    lacks = replace(found, law_file=replace(found.law_file, lacking=("payne.whole",)))
    assert "law.yaml has the corrected law, but lacks payne.whole, which law files cannot carry" in verdict_text(lacks)
    why = "with the effects the validation tests are predicted worse (0.2 %) than without them (0.1 %)"
    withheld = replace(found, law_file=replace(found.law_file, stage="refit", withheld=why), law_fixed=False)
    assert f"law.yaml has the refitted law: {why}" in verdict_text(withheld)


def test_the_verdict_says_effect_errors_and_confounded_effects() -> None:
    first, errors, file = verdict_text(example.calibration((example.lag(),))).split("\n")
    assert first == (
        "Explained: the tests show lag between the channels of force and displacement (instrument, lag = 4.00 ± 0.10 "
        "ms). Only noise is left."
    )
    # of the closed form: its root is 0.65 %
    assert (
        "the corrected law leaves an NRMS of 0.00427 % of the force (0.65 % in rms), as declared it leaves 0." in errors
    )
    assert errors.endswith("what no model can predict is 0.00427 %.")
    assert file == "law.yaml has the corrected law; what the rig and the instruments did is no part of it."
    verdict = verdict_text(example.confounded())
    assert (
        "cannot separate payne from mullins (2.00 %, if it is one of the two) or self heating (under 0.0100 %"
        in verdict
    )
    assert "in its place" not in verdict  # neither is near
    assert "The next test, to separate payne from self heating: 12 cycles of 2 mm at 5 Hz, 35 degC." in verdict


def test_a_law_kept_as_declared_is_compared_with_the_fitted_one_alike() -> None:
    """The error of the law fitted without effects says nothing of a law with effects."""
    found = replace(example.calibration(), as_declared=True)
    assert "Its parameters are kept as declared." in verdict_text(found)
    alone = verdict_text(replace(found, effects=(), fitted_first=True))
    assert "kept as declared: fitted ones leave" in alone and "as declared it leaves" not in alone
    assert "those called declared were fitted to the tests first" in alone


def test_weights_are_explained_where_a_fit_is_worse_in_the_digits_shown() -> None:
    found = example.calibration()
    declared = found.errors["declared"]
    for factor, said in ((1.5, True), (1.0 + 1e-6, False)):
        refit = replace(declared, fit=declared.fit * factor)
        text = verdict_text(replace(found, errors={**found.errors, "refit": refit}))
        assert ("weighs each test by its own size" in text) == said


def test_an_effect_as_probable_is_named_in_one_sentence_with_the_one_found() -> None:
    titles = {"offset": "zero of the force channel, the same in all tests (instrument)"}
    confounded = replace(example.gain(), indistinguishable_from={"offset": 0.497, "lag": 0.02}, titles=titles)
    found = replace(example.calibration((confounded,)), next_test=None)
    text = verdict_text(found)
    assert text.startswith("Explained: the tests show gain of the force channel (instrument, g = ")
    assert f"), or {titles['offset']} in its place. Only noise is left." in text
    none = "No test within the amplitudes and frequencies of these would separate them better: look at the rig"
    assert f"{none}." in text and none in text_of(page_text_of(found))
    assert "the tests cannot separate gain.force (instrument) from offset or lag: it may be either" in law_lines(found)
    many = replace(
        confounded, titles={}, indistinguishable_from={"offset": 0.497, "lag": 0.4, "hum": 0.3, "drift": 0.04}
    )
    assert "), or offset, or lag, or others in its place." in verdict_text(example.calibration((many,)))
    assert none not in verdict_text(replace(found, ending="interrupted"))  # none was sought then


def test_a_law_that_leaves_noise_is_not_reported_as_a_search_that_failed() -> None:
    alone = replace(example.calibration().models[-1], probability=1.0)
    found = replace(example.nothing_found(), depths=(), models=(alone,))
    assert not models_table(found).rows
    assert searched(found).startswith("no effect was screened, as the law alone leaves noise")


def test_the_verdict_on_nothing_names_no_effect() -> None:
    first, errors, _ = verdict_text(example.nothing_found()).split("\n")
    assert first == "None: no effect is missing from the law kelvin_voigt."
    assert "the law leaves an NRMS of 0.00427 % of the force (0.65 % in rms)" in errors


def test_the_verdict_on_what_is_left_says_its_shape_and_the_worst_test() -> None:
    found = replace(example.more_is_left(), worst=Worst("fast", 1.3e-4, 4e-5))
    text = verdict_text(found)
    assert text.startswith("Nothing found: something is missing, and no effect known here passes")
    assert "the law fitted again leaves an NRMS of 0.0133 % of the force (1.2 % in rms)" in text
    assert "100 % is left. 0.0091 % of the squared force of all tests is left, 85 % of it structure" in text
    assert "fast leaves most: an NRMS of 0.0130 %, 3.25 times its noise floor of 0.00400 %" in text


def test_the_verdict_says_where_no_test_was_fitted() -> None:
    found = example.more_is_left()
    assert "degC" not in verdict_text(found)
    warm = [replace(one, temperature=one.temperature + 4.0) if one.use == "validate" else one for one in found.series]
    (name,) = [one.of_test for one in found.series if one.use == "validate"]
    text = verdict_text(replace(found, series=tuple(warm)))
    assert f"No test fitted to is within 1 K of {name} (24 degC): what the law does there" in text


def test_the_gain_shows_as_a_slope_over_displacement_and_is_gone_after() -> None:
    view = View(example.calibration())
    stages = next(one for one in telling_dependences(view) if one["declared"].driver == "displacement")
    rising = stages["declared"].mean[np.argsort(stages["declared"].centre)]
    assert np.all(np.diff(rising) > 0.0)
    # noise of alternating sign: means over bins of tens of samples are below a tenth of it
    assert np.max(np.abs(stages["corrected"].mean)) < 0.02 * np.max(np.abs(rising))


def test_a_thinned_history_keeps_its_extremes() -> None:
    values = np.random.default_rng(3).standard_normal(20_000)
    time = np.arange(values.size) * 1e-3
    at, kept = outline(time, values)
    assert at.size <= 800 and np.all(np.diff(at) > 0.0)
    assert (kept.min(), kept.max()) == (values.min(), values.max())


@pytest.mark.parametrize(
    ("found", "curves"),
    [(example.calibration(), True), (example.nothing_found(), False)],
    ids=["explained", "none"],
)
def test_every_case_has_its_figures(found: Calibration, curves: bool) -> None:
    figures = {name: (caption, figure) for name, caption, figure in calibration_figures(found)}
    # where nothing but noise is left, the residual depends on nothing
    assert ("dependences" in figures) == curves
    assert set(figures) - {"dependences"} == {"errors", "loops", "residuals", "map"}
    (loop, *_) = figures["loops"][1].axes
    assert len(loop.get_lines()) == (3 if curves else 2)  # measured, as declared, and after if anything changed
    marks = {line.get_label(): line.get_xdata() for line in figures["errors"][1].axes[0].get_lines()}
    expected = [100.0 * found.errors["corrected"].tests[name] for name in ("slow", "fast")]
    assert list(marks["corrected"]) == pytest.approx(expected)


def test_an_effect_of_the_damper_is_drawn_as_its_factor() -> None:
    ((_, _, figure),) = effect_figures(View(example.confounded()))
    line = figure.axes[0].get_lines()[0]
    amplitude, factor = line.get_xdata(), line.get_ydata()
    assert (amplitude[0], factor[0]) == (0.0, 1.0)
    assert amplitude[-1] == pytest.approx(4.0, rel=1e-2)  # mm; samples may miss the peak
    assert factor[-1] == pytest.approx(1.0 - 0.2 * amplitude[-1] / (3.0 + amplitude[-1]), rel=1e-12)


def test_the_page_has_all_numbers_without_script_or_links() -> None:
    page = page_text_of(example.confounded())
    assert "<script" not in page and not re.search(r"(?:src|href)=\"(?!#|data:)", page)
    ids = re.findall(r'<section id="([^"]+)"', page)
    assert ids == ["verdict", "errors", "effects", "open", "residual", "tests", "law", "provenance"]
    text = text_of(page)
    for reported in (
        "0.231 → 0.00427 %",
        "2.60 to 3.40",
        "cannot be separated from mullins or self heating",
        "would differ by an NRMS of 2.00 %, against 0.0100 % at most in the tests so far",
        "12 cycles of 2 mm at 5 Hz, 35 °C",
        "inertia.mass 0.00810 31.0 ± 4.0",
    ):
        assert reported in text
    pictures = re.findall(r'<figure class="picture".*?</figure>', page, flags=re.DOTALL)
    assert len(pictures) == 6
    assert all(re.search(r"<svg .*<figcaption>[^<]{80}", picture, flags=re.DOTALL) for picture in pictures)


def test_a_page_says_what_is_left_and_not_the_floor() -> None:
    found = replace(example.calibration(), noise_floor=0.0327)
    left = percent(found.errors["corrected"].validate)
    assert f"only noise, an NRMS of {left} %" in text_of(page_text_of(found))


def test_a_page_without_effects_shows_what_is_left() -> None:
    found = example.more_is_left()
    page = page_text_of(replace(found, campaign=replace(found.campaign, title="<b>a & b</b>")))  # type: ignore[type-var]
    assert "&lt;b&gt;a &amp; b&lt;/b&gt;" in page and "<b>a" not in page
    text = text_of(page)
    assert "Nothing found" in text and "no effect known here explains what is left" in text
    assert "85 % of it structure" in text and "No effect was adopted." in text
