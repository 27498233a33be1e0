"""The block `incremental` of a study: values in SI, and what is wrong at its place."""

from __future__ import annotations

import pytest

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
        (
            ("[bare, damped]", "[bare, dampd]"),
            "4: incremental[0].variants[1]: there is no variant `dampd`; did you mean",
        ),
        (("records: el_centro", "records: el_center"), "5: incremental[0].records: there is no record `el_center`"),
        ((LEVELS, "levels: [0.1 g, 0.1 g]"), "8: incremental[0].levels: intensities must ascend"),
        ((LEVELS, "levels: {from: 0.5 g, to: 0.1 g, count: 5}"), "must ascend"),
        ((LEVELS, "levels: [0.1 g, 0.2]"), "the bare number `0.2` needs a unit"),
        ((LEVELS, "levels: {from: 0.1 g, to: 0.5 g, count: 1}"), "count"),
        (("LS: {interstorey_drift: 2.5 %}", "LS: {interstory_drift: 2.5 %}"), "did you mean `interstorey_drift`"),
        (("LS: {interstorey_drift: 2.5 %}", "LS: 2.5 %"), "for example `{interstorey_drift: 2.5 %}`"),
        (("LS: {interstorey_drift: 2.5 %}", "LS: {interstorey_drift: 0 %}"), "greater than zero"),
        (("LS: {interstorey_drift: 2.5 %}", "collapse: {interstorey_drift: 5 %}"), "choose another name"),
        (("400 mm", "4 %"), "10: incremental[0].limits.high: `4 %` is a ratio, but a length is needed"),
        (("[bare, damped]", "[bare, bare]"), "4: incremental[0].variants[1]: `bare` comes twice"),
        (("period: 2.8 s", "level: MCE"), "there is no level `MCE`"),
        (("spectral_acceleration", "spectral_aceleration"), "spectral_acceleration"),
        ((SPECTRAL, "intensity: level_factor\n    levels: [1, 2]"), "level"),
        ((SPECTRAL, "intensity: level_factor\n    level: MCE\n    levels: [1, 2]"), "not fitted to the spectrum"),
        ((SPECTRAL, "intensity: pga\n    period: 2 s\n    levels: [0.1 g, 0.2 g]"), "period"),
    ],
)
def test_what_is_wrong_is_reported(small: str, change: tuple[str, str], words: str) -> None:
    found = "\n".join(problems_of(small, change))
    assert words in found


CURVE = "hazard_curve: {intensities: [0.1 g, 0.4 g], return_periods: [95 years, 975 years]}"


@pytest.mark.parametrize(
    "life_cycle, words",
    [
        (CURVE, ""),
        (f"{CURVE}, losses: {{LS: 20 %, collapse: 100 %}}, years: 50 years, dispersion: 0.3, discount: 3 %", ""),
        ("losses: {LS: 20 %}", "12: incremental[0].life_cycle.hazard_curve: this key is missing"),
        ("hazard_curve: {levels: {MCE: 475 years, DBE: 95 years}}", "levels.MCE: there is no level `MCE`"),
        ("hazard_curve: {levels: {MCE: 475 years}}", "12: incremental[0].life_cycle.hazard_curve.levels: "),
        (CURVE.replace("95 years", "95"), "the bare number `95` needs a unit"),
        (CURVE.replace("95 years", "95 s"), "return_periods[0]: this is shorter than a year"),
        (CURVE.replace("95 years, ", ""), "return_periods: "),
        (CURVE.replace("95 years", "2000 years"), "return_periods: they must ascend"),
        (CURVE.replace("0.1 g", "0.5 g"), "intensities: they must ascend"),
        (CURVE.replace("95 years", "95 years, 475 years"), "3 return periods for 2 intensities"),
        (f"{CURVE}, losses: {{LSS: 20 %}}", "losses.LSS: there is no limit `LSS`; did you mean `LS`?"),
        (f"{CURVE}, losses: {{LS: 120 %}}", "120 %"),
        (f"{CURVE}, years: 1 month", "this is shorter than a year"),
        (f"{CURVE}, dispersion: 2.5", "12: incremental[0].life_cycle.dispersion: "),
        (
            "hazard_curve: {levels: {MCE: 475 years, DBE: 475 years}}",
            "levels.DBE: 475 years are the return period of `MCE` too",
        ),
        (f"{CURVE}, disperson: 0.3", "did you mean `dispersion`?"),
    ],
)
def test_the_life_cycle(small: str, life_cycle: str, words: str) -> None:
    after = "    free_vibration: 5 s\n"
    found = "\n".join(problems_of(small, (after, f"{after}    life_cycle: {{{life_cycle}}}\n")))
    assert words in found and bool(found) == bool(words)


def test_intensities_of_factors_come_from_levels(small: str) -> None:
    change = (SPECTRAL, f"intensity: level_factor\n    level: MCE\n    levels: [1, 2]\n    life_cycle: {{{CURVE}}}")
    assert "intensities are factors of a level here" in "\n".join(problems_of(small, change))
