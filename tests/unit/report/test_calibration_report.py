"""Report of a calibration: numbers in tables, verdict, figures and page against closed forms of the example.

Reference: a gain of 5 % on a force F leaves 0.05 F, so the NRMS as declared is (0.05^2 p + s^2) / (1.05^2 p + s^2) with
the mean square p of the law's force over whole cycles, U^2 (k^2 + (omega c)^2) / 2, and that of the noise s^2.
"""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from unit.report import calibration_example as example

from edesign.calibrate.result import Calibration, CarriedLaw, Coverage, Estimate, Hypothesis
from edesign.damper.amendments import Amendment
from edesign.errors import ArchiveError, InputError
from edesign.report.calibration.effect_figures import effect_figures
from edesign.report.calibration.effect_tables import effect_parameters_table, effects_table, hypotheses_table
from edesign.report.calibration.figures import calibration_figures
from edesign.report.calibration.residual_figures import harmonic_figures, telling_dependences
from edesign.report.calibration.tables import errors_table, law_parameters_table, tables_of, verdict_text
from edesign.report.calibration.units import interval_text, percent, plus_minus, practical, value_text
from edesign.report.calibration.view import View, outline
from edesign.report.page.calibration import calibration_page_text, write_calibration_page
from edesign.report.tables.table import Table
from edesign.report.tables.text import plain

SHOWN = 5e-3  # relative: three digits are shown


def closed_form(frequency: float, amplitude: float, gain: float) -> float:
    """NRMS (ratio) of a law that lacks so much of the gain; noise of alternating sign is orthogonal to the sines."""
    omega = 2.0 * math.pi * frequency
    power = amplitude**2 * (example.K**2 + (omega * example.C) ** 2) / 2.0
    return (gain**2 * power + example.NOISE**2) / ((1.0 + example.GAIN) ** 2 * power + example.NOISE**2)


def row(table: Table, first: str) -> list[str]:
    return next(cells for cells in table.rows if cells[0] == first)


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
        (Estimate(0.004, 1e-4, "s"), "4.00 ± 0.10 ms", "3.80 to 4.20"),
        (Estimate(5.0, 0.5, "s"), "5.00 ± 0.50 s", "4.02 to 5.98"),
        (Estimate(1500.0, 25.0, "N"), "1.500 ± 0.025 kN", "1.451 to 1.549"),
        (Estimate(2.0e6, 3.0e3, "N/m"), "2.0000 ± 0.0030 kN/mm", "1.9941 to 2.0059"),
        (Estimate(-3.0e-4, 2.0e-4, "m"), "-0.30 ± 0.20 mm", "-0.69 to 0.09"),
        (Estimate(150.0, 12.0, "kg"), "150 ± 12 kg", "126 to 174"),
        (Estimate(2.0e-4, 1e-5, "1/J"), "0.000200 ± 0.000010 1/J", "0.000180 to 0.000220"),
        (Estimate(25.0, 0.5, "degC"), "25.00 ± 0.50 degC", "24.02 to 25.98"),
    ],
)
def test_numbers_are_shown_in_units_of_a_laboratory(estimate: Estimate, text: str, interval: str) -> None:
    shown = practical(estimate, {})
    assert (plus_minus(shown), interval_text(shown)) == (text, interval)


def test_a_unit_with_an_exponent_takes_that_of_its_sibling() -> None:
    # 1 N (s/m)^0.5 = 1e-3 kN (1e-3 s/mm)^0.5 = 10^-4.5 kN (s/mm)^0.5
    siblings = {"alpha": Estimate(0.5, 0.01, "")}
    shown = practical(Estimate(1.0, 0.1, "N*(s/m)^alpha"), siblings)
    assert shown.unit == "kN*(s/mm)^alpha"
    assert shown.value == pytest.approx(10.0**-4.5, rel=1e-12)
    assert shown.standard_error == pytest.approx(10.0**-5.5, rel=1e-12)


@pytest.mark.parametrize("error", [math.nan, math.inf])
def test_an_error_that_is_not_finite_is_named(error: float) -> None:
    found = example.calibration((example.gain(error),))
    cells = row(effect_parameters_table(found), "gain")
    assert cells[2:5] == ["0.05", "not determined", "not determined"]
    assert "g = 0.05 (uncertainty not determined)" in verdict_text(found)
    assert not re.search(r"\b(nan|inf)\b", "\n".join(plain(table) for table in tables_of(found)))


def test_digits_follow_the_error_and_lost_signs_are_no_minus_zero() -> None:
    assert value_text(Estimate(1234.567, 250.0, "")) == "1230"
    assert value_text(Estimate(-0.004, 0.1, "")) == "0.00"
    assert value_text(Estimate(3.0e9, 1.0, "")) == "3e+09"
    assert (percent(0.012), percent(2.4e-5), percent(math.nan)) == ("1.20", "0.00240", "-")


def test_an_effect_is_told_with_kind_reduction_and_look_alikes() -> None:
    found = example.look_alikes()
    cells = row(effects_table(found), "softening with amplitude of the whole force")
    assert cells[1:3] == ["payne.whole", "damper"]
    without = 100.0 * (closed_form(2.0, 0.002, 0.0) + 1.1e-4)
    assert float(cells[3]) == pytest.approx(without, rel=SHOWN)
    assert cells[4:] == ["0.0110", "99.0", "mullins, self heating"]
    parameters = [row[1:6] for row in effect_parameters_table(found).rows]
    assert parameters == [
        ["d", "0.200", "0.010", "0.180 to 0.220", "-"],
        ["a0", "3.00", "0.20", "2.61 to 3.39", "mm"],
        ["m", "1.00", "0.10", "0.80 to 1.20", "-"],
        ["tau_a", "5.00", "0.50", "4.02 to 5.98", "s"],
    ]


@pytest.mark.slow
def test_look_alikes_that_were_not_asked_for_are_not_said_to_be_none() -> None:
    found = example.calibration((replace(example.payne(), indistinguishable_from=()),))
    for ending, cell in (("complete", "nothing known"), ("out_of_time", "not all others"), ("interrupted", "not all")):
        table = effects_table(replace(found, ending=ending))
        assert table.rows[0][-1].startswith(cell)
        page = text_of(calibration_page_text(replace(found, ending=ending)))
        assert ("no other known effect explains" in page) == (ending == "complete")
        assert ("there may be more effects" in page) == (ending != "complete")


def test_a_search_that_found_nothing_before_its_end_says_what_it_looked_at() -> None:
    coverage = Coverage(("lag.delay", "play.gap", "play.closing"), frozenset({"lag.delay"}), frozenset())
    found = replace(example.unexplained(), verdict="not_searched", ending="out_of_time", coverage=coverage)
    text = verdict_text(found)
    assert text.startswith("Not searched:") and "no effect known here explains" not in text
    assert "1 of 3 forms of effects were screened, 0 fitted. Not screened, or not in all forms: play." in text
    assert found.verdict_words.startswith("not searched, the search out of time: 1 of 3 forms")
    page = text_of(calibration_page_text(found))
    assert "Not searched" in page and "no effect known here explains" not in page


def test_a_hypothesis_stands_beside_the_effects_with_its_reason() -> None:
    one = Hypothesis(example.payne(), "its 95 % interval reaches to nothing")
    found = replace(example.calibration(), hypotheses=(one,))
    cells = row(hypotheses_table(found), "payne.whole")
    assert cells[1].startswith("d = 0.200 ± 0.010") and cells[2] == one.why
    assert "A hypothesis, no part of the law: softening with amplitude of the whole force" in verdict_text(found)
    assert "Hypotheses: found, no part of the law" in text_of(calibration_page_text(found))
    assert hypotheses_table(example.calibration()).rows == []


def test_what_the_tests_do_not_determine_is_told_with_the_reason() -> None:
    bound = Estimate(0.5, math.inf, "", untold="at its upper bound")
    effect = replace(example.gain(), parameters={"g": bound})
    cells = effect_parameters_table(example.calibration((effect,))).rows[0]
    assert cells[2:5] == ["0.5", "not determined", "not determined: at its upper bound"]
    # half the width of an interval is of its own, in the unit that is shown
    time = replace(example.lag(), parameters={"lag": Estimate(0.004, 1e-4, "s", half_width=4.3e-4)})
    assert effect_parameters_table(example.calibration((time,))).rows[0][4] == "3.57 to 4.43"


def test_an_effect_that_makes_the_validation_tests_worse_is_doubted() -> None:
    effect = replace(example.gain(), delta_validate=-0.5 * example.calibration().errors["corrected"].validate)
    found = replace(example.calibration((effect,)), verdict="partly_explained")
    assert "Without gain the validation tests are predicted better" in verdict_text(found)


def test_parameters_that_others_make_needless_are_told() -> None:
    found = replace(example.calibration(), held={"N": "only the slip force mu N acts on the damper"})
    notes = law_parameters_table(found).notes
    assert "N is held as declared: only the slip force mu N acts on the damper" in notes


def test_law_parameters_stand_with_their_errors_or_as_held() -> None:
    table = law_parameters_table(example.calibration())
    assert row(table, "k") == ["k", "kN/mm", "2", "2.0800", "0.0030", "2", "held"]
    assert any("declared parameters were kept" in note for note in table.notes)
    assert row(law_parameters_table(example.unexplained()), "k")[5:] == ["2.0800", "0.0030"]


def test_what_a_law_file_cannot_carry_is_told_with_the_error_of_the_one_it_can() -> None:
    energy = Amendment("degradation", "energy", {"d": 0.2, "E0": 1e4})
    carried = CarriedLaw({}, (energy,), ("degradation.work",), 1.25e-3)
    (note,) = law_parameters_table(replace(example.unexplained(), carried=carried)).notes
    assert (
        note == "law file: it cannot carry degradation.work; with degradation.energy, fitted again, it leaves 0.125 %"
    )
    whole = replace(carried, replaced=())
    assert not law_parameters_table(replace(example.unexplained(), carried=whole)).notes


def test_the_verdict_tells_effect_errors_and_doubts() -> None:
    text = verdict_text(example.calibration((example.lag(),)))
    assert text.startswith(
        "Explained: lag between the channels of force and displacement (instrument, lag = 4.00 ± 0.10 ms)."
    )
    assert "falls from 0.231 % as declared to 0.00427 %" in text and text.endswith("at the noise floor of 0.00427 %.")
    doubts = verdict_text(example.look_alikes())
    assert "cannot tell payne from mullins or self heating" in doubts
    assert "To tell payne from self heating: 12 cycles of 2 mm at 5 Hz, 35 degC." in doubts


def test_the_verdict_on_nothing_names_no_effect() -> None:
    text = verdict_text(example.nothing_found())
    assert text == (
        "None: no effect is missing from the law kelvin_voigt. The validation error (NRMS) is 0.00427 %, at the noise "
        "floor of 0.00427 %."
    )


def test_the_verdict_on_the_unexplained_tells_what_is_left() -> None:
    text = verdict_text(example.unexplained())
    assert text.startswith("Unexplained: something is missing")
    assert "to 0.0133 % with the law fitted again, above the noise floor of 0.00427 %" in text
    assert "100 % is left in the validation tests: 0.0091 % of the squared force is left" in text


def test_the_verdict_tells_where_the_correction_does_not_reach() -> None:
    found = example.unexplained()
    reaches = verdict_text(found)
    assert "worse" not in reaches and "degC" not in reaches
    refit = found.errors["refit"]
    errors = {**found.errors, "corrected": replace(refit, validate=3.0 * refit.validate)}
    warm = [replace(one, temperature=one.temperature + 4.0) if one.use == "validate" else one for one in found.series]
    text = verdict_text(replace(found, errors=errors, series=tuple(warm)))
    assert "predicts the validation tests worse (0.0400 %) than the law alone fitted again (0.0133 %)" in text
    (name,) = [one.of_test for one in found.series if one.use == "validate"]
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
    # where nothing but noise is left, the residual goes with nothing
    assert ("dependences" in figures) == curves
    assert set(figures) - {"dependences"} == {"errors", "loops", "residuals", "harmonics", "map"}
    (loop, *_) = figures["loops"][1].axes
    assert len(loop.get_lines()) == (3 if curves else 2)  # measured, as declared, and after if anything changed
    marks = {line.get_label(): line.get_xdata() for line in figures["errors"][1].axes[0].get_lines()}
    expected = [100.0 * found.errors["corrected"].tests[name] for name in ("slow", "fast")]
    assert list(marks["corrected"]) == pytest.approx(expected)


def test_harmonics_of_the_gain_are_a_share_of_the_first() -> None:
    ((_, _, figure),) = harmonic_figures(View(example.calibration()))
    for axis in figure.axes:
        declared = axis.containers[0]
        assert declared[1].get_height() == pytest.approx(100.0 * 0.05 / 1.05, rel=1e-3)  # of the measured force
        # smaller ones lie on the floor of the axis, four decades below
        assert max(bar.get_height() for bar in [declared[0], *declared[2:]]) < 1e-3 * declared[1].get_height()


def test_an_effect_of_the_damper_is_drawn_as_its_factor() -> None:
    ((_, _, figure),) = effect_figures(View(example.look_alikes()))
    line = figure.axes[0].get_lines()[0]
    amplitude, factor = line.get_xdata(), line.get_ydata()
    assert (amplitude[0], factor[0]) == (0.0, 1.0)
    assert amplitude[-1] == pytest.approx(4.0, rel=1e-2)  # mm; samples may miss the peak
    assert factor[-1] == pytest.approx(1.0 - 0.2 * amplitude[-1] / (3.0 + amplitude[-1]), rel=1e-12)


def test_the_page_tells_all_numbers_without_script_or_links(tmp_path: Path) -> None:
    path = write_calibration_page(example.look_alikes(), tmp_path / "calibration.html")
    page = path.read_text(encoding="utf-8")
    assert "<script" not in page and not re.search(r"(?:src|href)=\"(?!#|data:)", page)
    ids = re.findall(r'<section id="([^"]+)"', page)
    assert ids == ["verdict", "errors", "effects", "left", "open", "residual", "tests", "law", "provenance"]
    text = text_of(page)
    for told in (
        "0.231 → 0.00427 %",
        "2.61 to 3.39",
        "cannot be told from mullins or self heating",
        "would differ by an NRMS of 2.00 %, against 0.0100 % at most in the tests so far",
        "12 cycles of 2 mm at 5 Hz, 35 °C",
        "removes 3.1 % of the excess",
    ):
        assert told in text
    pictures = re.findall(r'<figure class="picture".*?</figure>', page, flags=re.DOTALL)
    assert len(pictures) == 7
    assert all(re.search(r"<svg .*<figcaption>[^<]{80}", picture, flags=re.DOTALL) for picture in pictures)


def test_a_page_of_the_unexplained_shows_what_is_left() -> None:
    page = calibration_page_text(replace(example.unexplained(), title="<b>a & b</b>"))
    assert "&lt;b&gt;a &amp; b&lt;/b&gt;" in page and "<b>a" not in page
    text = text_of(page)
    assert "Unexplained no effect known here explains what is left" in text
    assert "Share left 100 % of the error of the refitted law above noise" in text
    assert "85 % of it structure" in text and "none was adopted" in text


def test_a_page_goes_nowhere_else(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"ends in \.html"):
        write_calibration_page(example.calibration(), tmp_path / "calibration.h5")
    with pytest.raises(ArchiveError, match="does not exist"):
        write_calibration_page(example.calibration(), tmp_path / "no" / "calibration.html")
