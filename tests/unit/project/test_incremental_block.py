"""The block `incremental` of a study: values in SI, and what is wrong at its place."""

from __future__ import annotations

import pytest
from messages import says

from edesign.project import parse_project
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.base import Model
from edesign.project.reading.yaml_file import check_model
from edesign.project.study.checks_incremental import check_incremental
from edesign.project.study.incremental import Incremental, SpectralAccelerationStudy

TEXT = """\
study: test
incremental:
  - name: ida
    variants: [bare, damped]
    records: el_centro
    intensity: spectral_acceleration
    period: 2.8 s
    levels: {from: 0.1 g, to: 0.5 g, count: 5}
    collapse_drift: 8 %
    limits: {LS: {interstorey_drift: 2.5 %}, high: {roof_displacement: 400 mm}}
    free_vibration: 5 s
"""


class Study(Model):
    study: str
    incremental: tuple[Incremental, ...]


def problems_of(small: str, *changes: tuple[str, str]) -> list[str]:
    text = TEXT
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    study, problems = check_model(text, Study, "study file", "study: test")
    if study is not None:
        base = parse_project(small)
        check_incremental(("incremental", 0), study.incremental[0], base, ("bare", "damped"), problems)
    return [f"{p.mark.line}: {p}" for p in problems.found]


def test_values() -> None:
    study, problems = check_model(TEXT, Study, "study file", "study: test")
    assert study is not None, problems.found
    one = study.incremental[0]
    assert isinstance(one, SpectralAccelerationStudy)
    assert one.intensities == pytest.approx([g * STANDARD_GRAVITY for g in (0.1, 0.2, 0.3, 0.4, 0.5)])
    assert one.intensities[-1] == 0.5 * STANDARD_GRAVITY  # the ends exactly
    assert (one.variants, one.records) == (("bare", "damped"), ("el_centro",))
    assert (one.period, one.collapse_drift, one.free_vibration) == (2.8, 0.08, 5.0)
    assert (one.limits["LS"].measure, one.limits["LS"].value) == ("interstorey_drift", 0.025)
    assert (one.limits["high"].measure, one.limits["high"].value) == ("roof_displacement_m", 0.4)


def test_nothing_is_wrong_with_it(small: str) -> None:
    assert problems_of(small) == []
    listed = ("levels: {from: 0.1 g, to: 0.5 g, count: 5}", "levels: [0.1 g, 0.25 g, 0.3 g]")
    assert problems_of(small, listed) == []
    assert problems_of(small, ("[bare, damped]", "all")) == []


LEVELS = "levels: {from: 0.1 g, to: 0.5 g, count: 5}"
SPECTRAL = "intensity: spectral_acceleration\n    period: 2.8 s\n    levels: {from: 0.1 g, to: 0.5 g, count: 5}"


@pytest.mark.parametrize(
    "change, words",
    [
        (("[bare, damped]", "[bare, dampd]"), "4: incremental[0].variants[1]: `damped`? E-NAME-01"),
        (("records: el_centro", "records: el_center"), "5: incremental[0].records: `el_centro`? E-NAME-01"),
        ((LEVELS, "levels: [0.1 g, 0.1 g]"), "8: incremental[0].levels: E-VALUE-04"),
        ((LEVELS, "levels: {from: 0.5 g, to: 0.1 g, count: 5}"), "incremental[0].levels E-VALUE-04"),
        ((LEVELS, "levels: [0.1 g, 0.2]"), "incremental[0].levels[1] E-UNIT-01"),
        ((LEVELS, "levels: {from: 0.1 g, to: 0.5 g, count: 1}"), "incremental[0].levels.count E-VALUE-02"),
        (
            ("LS: {interstorey_drift: 2.5 %}", "LS: {interstory_drift: 2.5 %}"),
            "incremental[0].limits.LS `interstorey_drift` E-NAME-01",
        ),
        (("LS: {interstorey_drift: 2.5 %}", "LS: 2.5 %"), "incremental[0].limits.LS E-VALUE-01"),
        (("LS: {interstorey_drift: 2.5 %}", "LS: {interstorey_drift: 0 %}"), "incremental[0].limits.LS E-VALUE-02"),
        (
            ("LS: {interstorey_drift: 2.5 %}", "collapse: {interstorey_drift: 5 %}"),
            "incremental[0].limits.collapse E-NAME-03",
        ),
        (("400 mm", "4 %"), "10: incremental[0].limits.high: ratio length E-UNIT-02"),
        (("[bare, damped]", "[bare, bare]"), "4: incremental[0].variants[1]: E-NAME-02"),
        (("period: 2.8 s", "level: MCE"), "incremental[0].level E-NAME-01"),
        (
            ("spectral_acceleration", "spectral_aceleration"),
            "incremental[0].intensity `spectral_acceleration` E-VALUE-03",
        ),
        ((SPECTRAL, "intensity: level_factor\n    levels: [1, 2]"), "incremental[0].level E-KEY-02"),
        (
            (SPECTRAL, "intensity: level_factor\n    level: MCE\n    levels: [1, 2]"),
            "incremental[0].records E-SCALE-03",
        ),
        ((SPECTRAL, "intensity: pga\n    period: 2 s\n    levels: [0.1 g, 0.2 g]"), "incremental[0].period E-KEY-01"),
    ],
)
def test_what_is_wrong_is_reported(small: str, change: tuple[str, str], words: str) -> None:
    found = "\n".join(problems_of(small, change))
    assert says(found, words)


CURVE = "hazard_curve: {intensities: [0.1 g, 0.4 g], return_periods: [95 years, 975 years]}"


@pytest.mark.parametrize(
    "life_cycle, words",
    [
        (CURVE, ""),
        (f"{CURVE}, losses: {{LS: 20 %, collapse: 100 %}}, years: 50 years, dispersion: 0.3, discount: 3 %", ""),
        ("losses: {LS: 20 %}", "12: incremental[0].life_cycle.hazard_curve: E-KEY-02"),
        (
            "hazard_curve: {levels: {MCE: 475 years, DBE: 95 years}}",
            "incremental[0].life_cycle.hazard_curve.levels.MCE E-NAME-01",
        ),
        ("hazard_curve: {levels: {MCE: 475 years}}", "12: incremental[0].life_cycle.hazard_curve.levels: E-VALUE-01"),
        (CURVE.replace("95 years", "95"), "incremental[0].life_cycle.hazard_curve.return_periods[0] E-UNIT-01"),
        (CURVE.replace("95 years", "95 s"), "incremental[0].life_cycle.hazard_curve.return_periods[0] E-VALUE-02"),
        (CURVE.replace("95 years, ", ""), "incremental[0].life_cycle.hazard_curve.return_periods E-VALUE-01"),
        (CURVE.replace("95 years", "2000 years"), "incremental[0].life_cycle.hazard_curve.return_periods E-VALUE-04"),
        (CURVE.replace("0.1 g", "0.5 g"), "incremental[0].life_cycle.hazard_curve.intensities E-VALUE-04"),
        (
            CURVE.replace("95 years", "95 years, 475 years"),
            "incremental[0].life_cycle.hazard_curve.return_periods E-VALUE-04",
        ),
        (f"{CURVE}, losses: {{LSS: 20 %}}", "incremental[0].life_cycle.losses.LSS `LS` E-NAME-01"),
        (f"{CURVE}, losses: {{LS: 120 %}}", "incremental[0].life_cycle.losses.LS E-VALUE-02"),
        (f"{CURVE}, years: 1 month", "incremental[0].life_cycle.years E-VALUE-02"),
        (f"{CURVE}, dispersion: 2.5", "12: incremental[0].life_cycle.dispersion: E-VALUE-02"),
        (
            "hazard_curve: {levels: {MCE: 475 years, DBE: 475 years}}",
            "incremental[0].life_cycle.hazard_curve.levels.DBE E-NAME-02",
        ),
        (f"{CURVE}, disperson: 0.3", "incremental[0].life_cycle.disperson `dispersion` E-KEY-01"),
    ],
)
def test_the_life_cycle(small: str, life_cycle: str, words: str) -> None:
    after = "    free_vibration: 5 s\n"
    found = "\n".join(problems_of(small, (after, f"{after}    life_cycle: {{{life_cycle}}}\n")))
    assert says(found, words) and bool(found) == bool(words)


def test_intensities_of_factors_come_from_levels(small: str) -> None:
    change = (SPECTRAL, f"intensity: level_factor\n    level: MCE\n    levels: [1, 2]\n    life_cycle: {{{CURVE}}}")
    assert says("\n".join(problems_of(small, change)), "incremental[0].life_cycle.hazard_curve.intensities E-HAZ-04")
