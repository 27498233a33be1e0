"""What campaigns say of their tests: conditions, and whether the order is known in which they were made."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from damper_problems import problem
from kelvin_voigt_campaign import campaign

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.search.problem import Effect
from edesign.damper.testing.campaign import CampaignError, load_campaign

VOLTS = (0.0, 2.0, 1.0, 3.0)


def offered(tests: DamperProblem, label: str) -> Effect:
    (found,) = (one for one in tests.effects if one.label == label)
    return found


def forces(tests: DamperProblem, effect: Effect, values: tuple[float, ...]) -> list[np.ndarray]:
    model = tests.model((effect,), ("fit", "validate"))
    (found,) = model.forces(np.array([[*(one.centre for one in tests.base), *values]]))
    assert isinstance(found, list)
    return found


def test_a_parameter_of_the_law_goes_with_a_condition() -> None:
    """c of F = c |v|^alpha sign v, beside alpha, which is no factor."""
    tests = problem("viscous_power", 4, conditions={"V": VOLTS})
    of_c, of_alpha = (offered(tests, f"condition.{name}_of_V") for name in ("c", "alpha"))
    law = tests.declared
    for i, (found, other) in enumerate(zip(forces(tests, of_c, (0.4,)), forces(tests, of_alpha, (0.4,)), strict=True)):
        v, x = tests.experiments[i].motion.velocity, (VOLTS[i] - 1.0) / 2.0  # three tests are fitted to
        both = ((1.0 + 0.4 * x) * law["c"], law["alpha"]), (law["c"], (1.0 + 0.4 * x) * law["alpha"])
        for force, (c, alpha) in zip((found, other), both, strict=True):
            assert np.max(np.abs(force - c * np.abs(v) ** alpha * np.sign(v))) < 1e-9 * tests.typical.force


def test_gas_at_the_pressure_of_each_test_pushes_the_rod() -> None:
    tests = problem("viscous_power", 4, conditions={"MPa": (1.0, 0.5, 1.5, 2.0)})
    found = forces(tests, offered(tests, "condition.gas_of_MPa"), (300.0, 20.0))
    (plain,) = tests.model((), ("fit", "validate")).forces(np.array([[one.centre for one in tests.base]]))
    for one, other, test, pressure in zip(found, plain, tests.experiments, (1.0, 0.5, 1.5, 2.0), strict=True):
        gas = 300.0 * pressure * (1.0 - 20.0 * test.motion.displacement) ** -1.2  # P V^n = constant
        assert np.max(np.abs(one - other - gas)) < 1e-9 * tests.typical.force


def test_conditions_that_two_tests_or_one_value_show_are_not_sought() -> None:
    for volts, tests in (((1.0, 1.0, 1.0, 5.0), 4), ((1.0, 2.0, 3.0), 3)):
        assert not [one for one in problem(tests=tests, conditions={"V": volts}).effects if one.name == "condition"]


def test_without_a_known_order_nothing_acts_from_test_to_test() -> None:
    tests = problem("mgmm", tests=6)
    unknown = replace(tests, typical=replace(tests.typical, ordered=False))
    gone = {one.label for one in tests.effects} - {one.label for one in unknown.effects}
    assert {one.partition(".")[0] for one in gone} == {"extremes", "self_heating", "ageing", "gain", "drift", "lag"}
    assert {"self_heating.carried", "drift.campaign", "lag.growing", "extremes.lasting"} <= gone
    assert {"gain.force", "self_heating.rate", "drift.each_own", "degradation.energy"} & gone == set()


@pytest.mark.parametrize("label", ["degradation.path", "mullins.maximum"])
def test_without_a_known_order_each_test_has_a_fresh_specimen(label: str) -> None:
    tests = problem(tests=5)
    effect = offered(tests, label)
    unknown = replace(tests, typical=replace(tests.typical, ordered=False))
    values = effect.starts[0]
    one, other = forces(tests, effect, values), forces(unknown, effect, values)
    assert np.array_equal(one[0], other[0])
    # the last test by itself is the first one of a campaign
    alone = replace(tests, experiments=tests.experiments[-1:])
    assert np.array_equal(forces(alone, effect, values)[0], other[-1])
    assert np.max(np.abs(one[-1] - other[-1])) > 1e-3 * tests.typical.force


def test_a_campaign_says_conditions_and_that_its_order_is_unknown(tmp_path: Path) -> None:
    campaign(tmp_path, tests=4)
    path = tmp_path / "campaign.yaml"
    text = path.read_text(encoding="utf-8")
    lines = [
        line.replace("file:", f"conditions: {{gas_pressure_MPa: {0.1 * i}}}, file:")
        for i, line in enumerate(text.splitlines())
    ]
    path.write_text("order: unknown\n" + "\n".join(lines) + "\n", encoding="utf-8")
    loaded = load_campaign(path)
    assert not loaded.ordered and len({one.conditions["gas_pressure_MPa"] for one in loaded.tests}) == 4
    tests = damper_problem(loaded)
    assert not tests.typical.ordered and not tests.full_rate.typical.ordered
    assert [one.name for one in tests.typical.conditions] == ["gas_pressure_MPa"]
    assert all(dict(one.conditions) for one in tests.full_rate.experiments)


@pytest.mark.parametrize(
    ("first", "message"),
    [
        ("", r"tests\[0\]\.conditions: `clicks` .*E-TEST-02"),
        ("conditions: {volts: 1}, ", r"tests\[0\]\.conditions: `clicks` .*E-TEST-02"),
        ("conditions: {clicks: 0.69 MPa}, ", "0.69 MPa"),
        ("conditions: {gas pressure: 1, clicks: 1}, ", "gas pressure"),
        ("conditions: {clicks: 1, temperature: 20}, ", r"tests\[0\]\.conditions\.temperature: .*E-KEY-03"),
    ],
)
def test_conditions_that_do_not_go_together_are_refused(tmp_path: Path, first: str, message: str) -> None:
    campaign(tmp_path, tests=3)
    path = tmp_path / "campaign.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text.replace("{file: test_01", "{" + first + "file: test_01").replace(
            "{file: test_02", "{conditions: {clicks: 4}, file: test_02"
        ),
        encoding="utf-8",
    )
    with pytest.raises(CampaignError, match=message):
        load_campaign(path)


def test_lasting_extremes_need_the_order(tmp_path: Path) -> None:
    campaign(tmp_path, tests=3)
    path = tmp_path / "campaign.yaml"
    text = path.read_text(encoding="utf-8").replace("law:\n", "order: unknown\nlaw:\n  extremes: lasting\n", 1)
    path.write_text(text, encoding="utf-8")
    with pytest.raises(CampaignError, match=r"law\.extremes: .*E-TEST-02"):
        load_campaign(path)
