"""Friction and its like are of the damper or of the rig by one equation: the campaign says it, or is asked for it.

Forces are closed forms of the motion: a dashpot with a power of the velocity, or a Kelvin-Voigt specimen, and friction
F_c tanh(v/v0).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from damper_problems import problem
from kelvin_voigt_campaign import campaign, lawful

from edesign.calibration import calibrate
from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.law_file import law_file, law_lines, law_text, why_not_carried
from edesign.calibration.results.result import Calibration, Effect
from edesign.calibration.search.settings import SETTINGS
from edesign.calibration.write import calibration_json
from edesign.damper.damper import Damper
from edesign.damper.law_file import read_law_file, resolve
from edesign.damper.testing.campaign import BelongsTo, Campaign, load_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.errors import InputError
from edesign.estimation.noise import Noise
from edesign.report.calibration.tables import effects_table
from edesign.report.calibration.verdict import verdict_text

C, ALPHA = 120e3, 0.5  # N (s/m)^alpha
F_C, V0 = 4100.0, 2e-3  # N, m/s


def friction(v: np.ndarray) -> np.ndarray:
    return F_C * np.tanh(v / V0)


def sealed(t, u, v, a, order):
    return C * np.sign(v) * np.abs(v) ** ALPHA + friction(v)


def guided(t, u, v, a, order):
    return lawful(t, u, v, a, order) + friction(v)


@pytest.fixture(scope="module")
def fluid(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, Calibration]:
    law = LawChoice("viscous_power", {"c": "110 kN*(s/m)^0.5", "alpha": 0.5})
    tests = replace(campaign(tmp_path_factory.mktemp("fluid"), sealed, tests=5), law=law)
    return tests, calibrate(tests, threads=1)


@pytest.fixture(scope="module")
def elastomer(tmp_path_factory: pytest.TempPathFactory) -> tuple[Campaign, Calibration]:
    tests = campaign(tmp_path_factory.mktemp("elastomer"), guided, tests=5)
    return tests, calibrate(tests, threads=1)


def of_file(text: str, folder: Path) -> Damper:
    path = folder / "law.yaml"
    path.write_text(text, encoding="utf-8")
    law = resolve(*read_law_file(path), 20.0)
    return Damper(law.law, law.values, effects=law.effects, temperature_C=20.0)


def found_friction(found: Calibration) -> Effect:
    (effect,) = found.effects
    assert (found.verdict, effect.label) == ("explained", "friction.coulomb")
    low, high = effect.parameters["F_c"].interval
    assert low < F_C < high and high - low < 0.03 * F_C
    return effect


def test_in_a_fluid_damper_it_is_the_seals_and_its_law_file_has_it(fluid, tmp_path: Path):
    tests, found = fluid
    effect = found_friction(found)
    assert (effect.kind, effect.other_kind, effect.not_carried) == ("damper", "rig", "")
    damper = of_file(law_text(found, tests), tmp_path)
    for series in found.series:
        force = damper.force(series.time, series.displacement, series.velocity)
        assert force == pytest.approx(series.predicted["corrected"], abs=1e-9 * abs(force).max())


def test_the_other_reading_is_the_same_file_without_it(fluid, tmp_path: Path):
    tests, found = fluid
    text = law_text(found, tests)
    assert "take its entry out of `effects`" in text
    before, _, after = text.partition("effects:\n")
    law = of_file(before + after[after.index("tested:") :], tmp_path)
    p = {name: one.value for name, one in found_friction(found).parameters.items()}
    for series in found.series:
        beside = p["F_c"] * np.tanh(series.velocity / p["v0"])
        force = law.force(series.time, series.displacement, series.velocity) + beside
        assert force == pytest.approx(series.predicted["corrected"], abs=1e-9 * abs(force).max())


def test_in_an_elastomer_it_is_the_rig_and_the_file_has_the_other_reading_as_a_comment(elastomer, tmp_path: Path):
    tests, found = elastomer
    effect = found_friction(found)
    assert (effect.kind, effect.other_kind) == ("rig", "damper")
    assert [*found.law_file.otherwise] == ["friction.coulomb"] and not found.law_file.effects
    text = law_text(found, tests)
    law = of_file(text, tmp_path)
    lines = text.splitlines()
    first = lines.index("# effects:")
    both = of_file("\n".join([*lines[:first], *(line.removeprefix("# ") for line in lines[first:])]), tmp_path)
    for series in found.series:
        motion_of = series.time, series.displacement, series.velocity
        beside = series.predicted["corrected"]
        assert both.force(*motion_of) == pytest.approx(beside, abs=1e-9 * abs(beside).max())
        assert abs(law.force(*motion_of) - beside).max() > 0.9 * F_C


@pytest.mark.parametrize("which", ["fluid", "elastomer"])
def test_people_and_programs_are_told_both_readings(which, request: pytest.FixtureRequest):
    _, found = request.getfixturevalue(which)
    (effect,) = found.effects
    asked = "in the guides, or " if which == "elastomer" else "as of its seals, or "
    for text in (verdict_text(found), "\n".join(law_lines(found)), "\n".join(effects_table(found).notes)):
        assert asked in text and "`belongs_to: {friction: damper}` or `{friction: rig}`" in text
    (row,) = effects_table(found).rows
    assert "nothing known" not in row and f"friction of the {effect.other_kind}" in row
    (told,) = calibration_json(found)["effects"]
    assert told["kind"] == effect.kind and told["may_be"] == {"kind": effect.other_kind, "title": effect.other_title}
    others = calibration_json(found)["law_file"]["if_of_the_damper"]
    assert [one["name"] for one in others] == (["friction"] if which == "elastomer" else [])


@pytest.mark.parametrize("law", ["kelvin_voigt", "viscous_power"])
@pytest.mark.parametrize(("said", "kind"), [("damper", "damper"), ("rig", "rig")])
def test_what_the_campaign_says_is_not_asked(law, said, kind):
    tests = replace(problem(law, threads=1), belongs_to={"friction": said})
    own = [one for one in tests.effects if one.name == "friction"]
    assert len(own) == 4 and all(one.kind == kind and one.data.twin is None for one in own)
    usual = [one for one in problem(law, threads=1).effects if one.name == "friction"]
    assert all(one.data.twin is not None for one in usual)


def test_a_zero_of_the_load_cell_is_asked_for_where_there_may_be_gas_alone():
    asked = {
        law: [one.data.twin for one in problem(law, threads=1).effects if one.label == "offset.constant"]
        for law in ("kelvin_voigt", "viscous_power")
    }
    assert asked["kelvin_voigt"] == [None] and asked["viscous_power"] != [None]
    said = replace(problem("kelvin_voigt", threads=1), belongs_to={"offset": "damper"})
    assert [one.kind for one in said.effects if one.label == "offset.constant"] == ["damper"]


def test_a_project_has_flexible_parts_of_the_damper_as_its_brace():
    tests = replace(problem("kelvin_voigt", threads=1), belongs_to={"series_flexibility": "damper"})
    flexible = next(one for one in tests.effects if one.label == "series_flexibility.linear")
    values = np.array([*(one.centre for one in tests.base), 2e7])
    (made,) = tests.model((flexible,), ("fit", "validate")).forces(values)
    tests = tests.with_experiments([replace(e, force=f) for e, f in zip(tests.experiments, made, strict=True)])
    fitter, noise = unbounded(tests, SETTINGS), Noise.white([100.0] * 3)
    final, refit = fitter.fit((flexible,), values, noise), fitter.fit((), values[:-1], noise)
    assert final is not None and refit is not None
    found = law_file(tests, final, refit)
    assert (found.stage, found.lacking, found.brace) == ("corrected", (), "brace: {stiffness: 20 kN/mm}")
    assert why_not_carried(tests, final, 0).endswith("in series with the law: `brace: {stiffness: 20 kN/mm}`")
    damper = Damper(tests.law, found.parameters, 2e7)
    for one, force in zip(tests.experiments, made, strict=True):
        own = damper.force(one.motion.time, one.motion.displacement, one.motion.velocity)
        assert own == pytest.approx(force, abs=2e-5 * abs(force).max())  # by steps of other lengths


def test_the_key_has_what_may_be_either():
    assert {form.name for table in TABLES for form in table.FORMS if form.twin} == set(BelongsTo.model_fields)


def test_names_and_values_of_the_key_are_checked(tmp_path: Path):
    path = campaign(tmp_path, tests=4).path
    text = path.read_text(encoding="utf-8")
    path.write_text(text + "belongs_to: {friction: damper, play: rig}\n", encoding="utf-8")
    assert load_campaign(path).belongs_to == {"friction": "damper", "play": "rig"}
    path.write_text(text + "belongs_to: {frction: damper, gain: rig, offset: cell}\n", encoding="utf-8")
    with pytest.raises(InputError) as raised:
        load_campaign(path)
    told = str(raised.value)
    assert "did you mean `friction`?" in told and "belongs_to.gain: unknown key" in told
    assert "`cell` is unknown (allowed: `damper`, `rig`)" in told
