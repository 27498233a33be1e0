"""The loop on specimens whose force is a closed form of the motion: what is hidden is named, with its size, and
nothing else.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, Hidden, K, campaign, lawful

from edesign.calibrate.result import Effect, Estimate
from edesign.calibrate.run import calibrate
from edesign.calibrate.write import calibration_json, law_text


def _mass(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 400.0 * a


def _friction(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 500.0 * np.tanh(v / 5e-4)


def _cubic(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 3e10 * u**3  # forms differ by more than noise


def _ageing(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return (1.0 + 0.02 * order) * lawful(t, u, v, a, order)


def _hum(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 300.0 * np.sin(2.0 * np.pi * 50.0 * t + order)


def _offset(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 250.0


@pytest.mark.parametrize(
    ("hidden", "name", "kind", "parameter", "value"),
    [
        (_mass, "inertia", "instrument", "mass", 400.0),
        pytest.param(_friction, "friction", "rig", "F_c", 500.0, marks=pytest.mark.slow),
        pytest.param(_cubic, "hardening", "damper", "p", 3.0, marks=pytest.mark.slow),
        (_ageing, "ageing", "damper", "rate", 0.02),
        pytest.param(_hum, "hum", "instrument", "frequency", 50.0, marks=pytest.mark.slow),
        pytest.param(_offset, "offset", "instrument", "offset", 250.0, marks=pytest.mark.slow),
    ],
)
def test_what_is_hidden_is_found(
    tmp_path: Path, hidden: Hidden, name: str, kind: str, parameter: str, value: float
) -> None:
    found = calibrate(campaign(tmp_path, hidden), workers=1)
    assert [effect.name for effect in found.effects] == [name]
    effect = found.effects[0]
    assert effect.kind == kind
    assert found.verdict == "explained"
    estimate = effect.parameters[parameter]
    # the formula is the form's own (friction too): four standard errors, and a thousandth for the integration of
    # the samples
    assert estimate.value == pytest.approx(value, abs=4.0 * estimate.standard_error + 1e-3 * value)
    assert found.errors["corrected"].validate < 1.2 * found.noise_floor < found.errors["declared"].validate
    assert effect.delta_validate > 0.0


def test_a_late_force_is_a_lag(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, late=0.005), workers=1)
    assert [effect.name for effect in found.effects] == ["lag"]
    lag = found.effects[0].parameters["lag"]
    assert lag.value == pytest.approx(0.005, abs=4.0 * lag.standard_error + 1e-5)


def test_nothing_hidden_is_none_and_the_law_stays(tmp_path: Path) -> None:
    loaded = campaign(tmp_path)
    found = calibrate(loaded, workers=1)
    assert found.verdict == "none"
    assert not found.effects
    assert found.law_held
    assert {name: value.value for name, value in found.parameters["corrected"].items()} == pytest.approx(
        {"k": K, "c": C}
    )
    assert "effects" not in law_text(found, loaded)
    # the noise is 60 N in every test
    power = sum(float(s.measured @ s.measured) for s in found.series if s.use == "validate")
    count = sum(s.measured.size for s in found.series if s.use == "validate")
    assert found.noise_floor == pytest.approx(60.0**2 * count / power, rel=0.1)


def test_another_law_is_refitted_and_nothing_is_added(tmp_path: Path) -> None:
    def stiffer(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        return 1.1 * K * u + 0.85 * C * v

    found = calibrate(campaign(tmp_path, stiffer), workers=1)
    assert found.verdict == "none"
    assert not found.law_held
    corrected = found.parameters["corrected"]
    assert corrected["k"].value == pytest.approx(1.1 * K, abs=4.0 * corrected["k"].standard_error)
    assert corrected["c"].value == pytest.approx(0.85 * C, abs=4.0 * corrected["c"].standard_error)


@pytest.mark.slow
def test_what_nothing_known_explains_is_told_as_that(tmp_path: Path) -> None:
    random = np.random.default_rng(8)

    def stuck(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        """The load cell sticks to its value four times in a test for a quarter of a second."""
        force = lawful(t, u, v, a, order)
        for start in random.integers(200, t.size - 100, 4):
            force[start : start + 60] = force[start]
        return force

    found = calibrate(campaign(tmp_path, stuck), workers=1)
    assert found.verdict in ("unexplained", "partly_explained")
    assert found.unexplained_share > 0.2
    assert found.unexplained_shape
    told = calibration_json(found)
    assert json.loads(json.dumps(told, allow_nan=False)) == told


def test_two_forms_of_an_effect_are_one_entry(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, lawful), workers=1)
    drift = {"offset": Estimate(3.0, 0.1, "N")}
    lag, more, other = (
        Effect(name, form, "instrument", form, "", parameters, {}, delta, form, 0.9, alike)
        for name, form, parameters, delta, alike in (
            ("lag", "delay", {"delay": Estimate(1e-3, 1e-5, "s")}, 0.2, ("velocity_exponent",)),
            ("lag", "filter", {"tau": Estimate(2e-3, 1e-5, "s")}, 0.3, ("inertia", "velocity_exponent")),
            ("offset", "constant", drift, 0.1, ()),
        )
    )
    first, second = calibration_json(replace(found, effects=(lag, other, more)))["effects"]
    assert (first["name"], first["form"], second["name"]) == ("lag", "delay + filter", "offset")
    assert {name: value["value"] for name, value in first["parameters"].items()} == {"delay": 1e-3, "filter.tau": 2e-3}
    assert first["delta_validate"] == 0.3 and first["indistinguishable_from"] == ["velocity_exponent", "inertia"]
