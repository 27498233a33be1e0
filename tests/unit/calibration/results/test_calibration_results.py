"""What a calibration says of campaigns whose forces are closed forms: verdict, intervals, files, what is withheld."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, K, campaign, lawful

from edesign.calibration import calibrate
from edesign.calibration.results import outcome
from edesign.calibration.results.evidence import verdict_of
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.law_file import law_text
from edesign.calibration.results.result import Calibration
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.search import Search
from edesign.calibration.search.settings import SETTINGS
from edesign.calibration.write import calibration_json
from edesign.damper.damper import Damper
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.errors import InputError
from edesign.estimation.left_out import difference
from edesign.report.calibration.tables import tables_of
from edesign.report.calibration.verdict import verdict_text

FOURTH = 1.2e12  # N/m4


def hardening(t, u, v, a, order):
    return lawful(t, u, v, a, order) + FOURTH * u * np.abs(u) ** 3


@pytest.fixture(scope="module")
def hard(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, Calibration]:
    tests = campaign(tmp_path_factory.mktemp("hard"), hardening)
    return tests, calibrate(tests, threads=1)


def test_intervals_hold_what_the_specimen_has(hard):
    _, found = hard
    (effect,) = found.effects
    assert (found.verdict, effect.label, effect.kind) == ("explained", "hardening.power", "damper")
    truth = {"k": FOURTH * effect.fixed["r"] ** 3, "p": 4.0}
    for name, value in truth.items():
        low, high = effect.parameters[name].interval
        # beside another stiffness it makes 0.8 % of the force, and noise is 1 %
        assert low < value < high and high - low < 0.25 * value
    for name, value in {"k": K, "c": C}.items():
        low, high = found.parameters["corrected"][name].interval
        assert low < value < high
    # nothing else was fitted
    assert found.parameters["declared"]["k"].interval == (K, K)


def test_the_errors_are_those_of_the_specimen(hard):
    _, found = hard
    missing = 0.0
    power = 0.0
    for series in found.series:
        if series.use == "validate":
            force = (
                K * series.displacement
                + C * series.velocity
                + FOURTH * series.displacement * np.abs(series.displacement) ** 3
            )
            missing += float(np.sum((FOURTH * series.displacement * np.abs(series.displacement) ** 3) ** 2))
            power += float(np.sum(force**2))
    # noise is 4e-5 of the force squared, and adds to what is missing
    assert found.errors["declared"].validate == pytest.approx(missing / power + found.noise_floor, rel=0.02)
    assert found.errors["corrected"].validate == pytest.approx(
        found.noise_floor, rel=0.1
    )  # of 4000 samples, correlated
    assert found.effects[0].gain > 2.0 * found.effects[0].gain_error
    # a spring whose stiffness grows with the amplitude, and fades slowly, does nearly the same
    assert found.effects[0].probability > 0.8
    assert found.effects[0].delta_validate == pytest.approx(
        found.errors["refit"].validate - found.errors["corrected"].validate, rel=0.3
    )  # the law alone, fitted under another noise and at another sampling


def test_models_are_told_with_the_errors_that_the_report_has_of_them(hard):
    _, found = hard
    stands, *others = found.models
    assert stands.nrms == found.errors["corrected"].fit
    alone = {one.refit: one.nrms for one in others if not one.effects}
    for refit, stage in ((False, "declared"), (True, "refit")):
        # fitted at the sampling of the search, not to all samples
        assert refit not in alone or alone[refit] == pytest.approx(found.errors[stage].fit, rel=0.05)


def test_the_law_file_makes_the_corrected_force_by_the_ordinary_path(hard, tmp_path: Path):
    tests, found = hard
    path = tmp_path / "law.yaml"
    path.write_text(law_text(found, tests), encoding="utf-8")
    law = resolve(*read_law_file(path), 20.0)
    damper = Damper(law.law, law.values, effects=law.effects, temperature_C=20.0)
    for series in found.series:
        force = damper.force(series.time, series.displacement, series.velocity)
        # parameters stand in the file with twelve digits
        assert force == pytest.approx(series.predicted["corrected"], abs=1e-9 * abs(force).max())
    assert found.law_file.stage == "corrected" and not found.law_file.lacking and not found.law_file.measurement_effects


def test_what_people_read_names_the_effect_and_the_file(hard):
    _, found = hard
    text = verdict_text(found)
    assert text.startswith("Explained: the tests show elastic hardening at large strain (damper, k = ")
    assert "law.yaml has the corrected law with hardening.power." in text
    assert [table.title for table in tables_of(found)][0] == "Errors"
    reported = calibration_json(found)
    assert (
        reported["effects"][0]["parameters"]["p"]["interval"][0] < 4.0 and reported["law_file"]["stage"] == "corrected"
    )
    assert reported["coverage"]["depths"][0]["adopted"] == ("hardening.power",)


@pytest.mark.parametrize(
    ("reached", "effects", "ending", "word"),
    [
        (True, False, "complete", "none"),
        (True, False, "effort_spent", "none"),
        (True, True, "interrupted", "explained"),
        (False, True, "complete", "partly_explained"),
        (False, False, "complete", "nothing_found"),
        (False, False, "effort_spent", "not_searched"),
        (False, False, "interrupted", "not_searched"),
    ],
)
def test_words_of_verdicts(reached, effects, ending, word):
    assert verdict_of(reached, effects, ending) == word


def test_effects_that_predict_validation_tests_worse_are_hypotheses_and_in_no_law_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    def in_fitted_tests(t, u, v, a, order):
        return hardening(t, u, v, a, order) if order < 3 else lawful(t, u, v, a, order)

    tests = campaign(tmp_path, in_fitted_tests, tests=5)
    monkeypatch.setattr(outcome, "other_law", lambda *_: None)
    found = calibrate(tests, replace(SETTINGS, depth=1), threads=1)
    better = min(("declared", "refit"), key=lambda stage: found.errors[stage].validate)
    assert found.effects == () and found.errors["corrected"] == found.errors[better]
    (one,) = found.hypotheses
    assert one.effect.name == "hardening" and "the validation tests are predicted worse" in one.why
    # that is known of this model alone: the others were not asked
    why = {each.effects: each.why_not for each in found.models if each.effects and each.why_not}
    assert why.pop((one.effect.label,)) == one.why and not any("validation" in each for each in why.values())
    assert found.verdict == "nothing_found" and found.worst is not None
    assert found.law_file.stage == better and not found.law_file.effects and found.law_file.withheld == one.why
    text = law_text(found, tests)
    assert "effects:" not in text and "# hypothesis, not in this law: hardening" in text
    assert np.array_equal(found.series[0].predicted["corrected"], found.series[0].predicted[better])


def test_a_search_without_effort_says_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    tests = campaign(tmp_path, hardening, tests=4)
    with pytest.raises(InputError, match="--effort 2: .*E-CALIB-06"):
        calibrate(tests, replace(SETTINGS, effort=2.0), threads=1)
    monkeypatch.setattr(outcome, "other_law", lambda *_: None)
    found = calibrate(tests, replace(SETTINGS, effort=60.0), threads=1)
    assert (found.verdict, found.ending) == ("not_searched", "effort_spent")
    assert "ended with its effort of 60 (--effort)" in verdict_text(found)


def test_an_interrupt_keeps_what_was_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    tests = campaign(tmp_path, hardening, tests=4)
    whole, calls = Search._depth, []

    def once(self, best):
        if calls:
            raise KeyboardInterrupt
        calls.append(best)
        return whole(self, best)

    monkeypatch.setattr(Search, "_depth", once)
    monkeypatch.setattr(FittedModel, "at_floor", False)  # else the search ends by itself
    found = calibrate(tests, threads=1)
    assert found.ending == "interrupted" and [one.name for one in found.effects] == ["hardening"]
    assert "The search was interrupted: there may be more effects" in verdict_text(found)


def test_a_law_without_a_spring_is_reported_to_be_another(tmp_path: Path):
    tests = campaign(tmp_path, tests=4)
    viscous = replace(tests, law=LawChoice("viscous", {"c": f"{C / 1e6} kN*s/mm"}))
    found = calibrate(viscous, replace(SETTINGS, depth=0), threads=1)
    assert found.other_law is not None
    assert found.other_law.gain > 2.0 * found.other_law.error
    # noise alone is left: 60 N of some 10 kN
    assert found.other_law.validate < 2.0 * found.noise_floor
    assert verdict_text(found).startswith(f"Another law does better: {found.other_law.law}")


@pytest.mark.parametrize(("share", "told"), [(1.0, True), (0.0, False)], ids=["worse", "better"])
def test_a_law_that_few_tests_leave_open_is_told_if_it_predicts_validation_tests(
    share: float, told: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Only if these are predicted worse by the model that stands."""
    tests = campaign(tmp_path, tests=4)
    viscous = replace(tests, law=LawChoice("viscous", {"c": f"{C / 1e6} kN*s/mm"}))
    asked = outcome.other_law
    monkeypatch.setattr(outcome, "other_law", lambda *of: asked(*of[:3], share * of[3], of[4]))
    unsure = "edesign.calibration.results.other_law.difference"
    monkeypatch.setattr(unsure, lambda one, other: replace(difference(one, other), error=math.inf))
    found = calibrate(viscous, replace(SETTINGS, depth=0), threads=1)
    assert (found.other_law is not None) == told
    if found.other_law is not None:
        assert not found.other_law.sure and found.other_law.validate < found.errors["corrected"].validate
        text = verdict_text(found)
        assert text.startswith("Another law may do better: ") and "(log density), which is not sure." in text


def test_the_worst_part_is_that_farthest_over_its_own_floor() -> None:
    # 1.4 times its floor is noise, with however many values; of few values more is
    every = ("quiet", 1.4e-4, 1e-4, 5000), ("few", 2.2e-4, 1e-4, 12), ("many", 2.6e-4, 1e-4, 5000)
    parts = [Part(*one) for one in every]
    found = worst_of(parts)
    assert found is not None and (found.name, found.times) == ("many", pytest.approx(2.6))
    assert worst_of(parts[:2]) is None


@pytest.mark.parametrize(("declared", "kept"), [(1.0, True), (1.2, False)], ids=["true", "20 % off"])
def test_a_law_is_kept_as_declared_where_the_tests_ask_for_no_change(tmp_path: Path, declared: float, kept: bool):
    tests = campaign(tmp_path, lawful, tests=5)
    assert tests.law is not None
    stated = {"k": f"{declared * K} N/m", "c": f"{declared * C} N*s/m"}
    found = calibrate(replace(tests, law=replace(tests.law, parameters=stated)), threads=1)
    assert (found.verdict, found.effects, found.as_declared) == ("none", (), kept)
    assert found.law_file.stage == ("declared" if kept else "refit") and found.models[0].refit is not kept
    low, high = found.parameters["corrected"]["k"].interval
    assert low <= K <= high and low < high
