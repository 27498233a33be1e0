"""The calibration on specimens whose force is a closed form of the motion: what is hidden is named, with its size, and
nothing else.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import NOISE, C, Hidden, K, campaign, lawful

from edesign.calibration import calibrate
from edesign.calibration.results import outcome
from edesign.calibration.results.law_file import law_text
from edesign.calibration.write import calibration_json
from edesign.report.calibration.verdict import verdict_text

MASS, OFFSET, LATE = 400.0, 250.0, 0.005  # kg, N, s


def _mass(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + MASS * a


def _friction(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 500.0 * np.tanh(v / 5e-4)


def _ageing(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return (1.0 + 0.02 * order) * lawful(t, u, v, a, order)


def _hum(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + 300.0 * np.sin(2.0 * np.pi * 50.0 * t + order)


def _offset(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return lawful(t, u, v, a, order) + OFFSET


def _filter_of_a_mass() -> float:
    """Time constant T of a filtered displacement, of which K (u + T v) + c (v + T a) = K u + C v + MASS a."""
    return (C - np.sqrt(C**2 - 4.0 * K * MASS)) / (2.0 * K)


@pytest.mark.parametrize(
    ("hidden", "equations"),
    [
        # equations that are one and the same beside a spring and a dashpot
        (_mass, {"inertia.mass": ("mass", MASS), "lag.displacement_filter": ("time_constant", _filter_of_a_mass())}),
        (_offset, {"offset.constant": ("offset", OFFSET), "static_offset.pre_shear": ("offset", OFFSET / K)}),
        (_ageing, {"ageing.linear": ("rate", 0.02)}),
        (_friction, {"friction.coulomb": ("F_c", 500.0)}),
        (_hum, {"hum.tone": ("", 50.0)}),
    ],
    ids=["mass", "offset", "ageing", "friction", "hum"],
)
def test_what_is_hidden_is_found(tmp_path: Path, hidden: Hidden, equations: Mapping[str, tuple[str, float]]) -> None:
    # two of them validate, and three would not separate ageing from scatter
    found = calibrate(campaign(tmp_path, hidden, tests=6 if hidden is _ageing else 5), threads=1)
    (effect,) = found.effects
    assert effect.label in equations and found.verdict == "explained"
    names = {label.partition(".")[0] for label in equations}
    assert effect.name in names and names <= {effect.name, *effect.indistinguishable_from}
    reported = {
        "offset": "zero of the force channel, the same in all tests (instrument",
        "static_offset": "shear of the ",
    }
    for name in names & set(reported):  # one of them is as good as the other, and the verdict says both
        assert reported[name] in verdict_text(found).partition(". ")[0]
    parameter, value = equations[effect.label]
    if parameter:
        estimate = effect.parameters[parameter]
        # the formula is the form's own: four standard errors, and a thousandth for the integration of the samples
        assert estimate.value == pytest.approx(value, abs=4.0 * estimate.standard_error + 1e-3 * value)
    else:
        # a hundredth of the width of a line over 8 s
        assert effect.fixed["f1_1"] == pytest.approx(value, abs=2e-3)
    assert found.errors["corrected"].validate < 1.2 * found.noise_floor < found.errors["declared"].validate
    assert effect.delta_validate > 0.0


def test_a_late_force_is_a_lag(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, tests=5, late=LATE), threads=1)
    (effect,) = found.effects
    lag = effect.parameters["lag"]
    assert effect.name == "lag" and lag.value == pytest.approx(LATE, abs=4.0 * lag.standard_error + 1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("late", [0.002, LATE])
def test_a_short_lag_is_reported_though_others_do_as_well(tmp_path: Path, late: float) -> None:
    """Eight tests at up to 3 Hz: a lag of some milliseconds is a phase, which masses and filters have too."""
    found = calibrate(campaign(tmp_path, late=late), threads=1)
    (effect,) = found.effects
    assert "lag" in {effect.name, *effect.indistinguishable_from} and found.verdict == "explained"


def test_nothing_hidden_is_none_and_the_law_stays(tmp_path: Path) -> None:
    loaded = campaign(tmp_path)
    found = calibrate(loaded, threads=1)
    assert (found.verdict, found.effects, found.hypotheses, found.worst) == ("none", (), (), None)
    for name, value in {"k": K, "c": C}.items():
        low, high = found.parameters["corrected"][name].interval
        assert low < value < high and high - low < 0.01 * value
    assert "effects" not in law_text(found, loaded)
    power = sum(float(s.measured @ s.measured) for s in found.series if s.use == "validate")
    count = sum(s.measured.size for s in found.series if s.use == "validate")
    assert found.noise_floor == pytest.approx(NOISE**2 * count / power, rel=0.1)


def test_another_law_is_refitted_and_nothing_is_added(tmp_path: Path) -> None:
    def stiffer(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        return 1.1 * K * u + 0.85 * C * v

    found = calibrate(campaign(tmp_path, stiffer), threads=1)
    assert (found.verdict, found.effects) == ("none", ())
    corrected = found.parameters["corrected"]
    assert corrected["k"].value == pytest.approx(1.1 * K, abs=4.0 * corrected["k"].standard_error)
    assert corrected["c"].value == pytest.approx(0.85 * C, abs=4.0 * corrected["c"].standard_error)


def test_a_law_that_is_not_to_be_fitted_again_stays_beside_what_is_found(tmp_path: Path) -> None:
    loaded = campaign(tmp_path, _ageing, tests=6)
    assert loaded.law is not None
    found = calibrate(replace(loaded, law=replace(loaded.law, refit=False)), threads=1)
    assert found.law_fixed and [effect.label for effect in found.effects] == ["ageing.linear"]
    assert {name: one.value for name, one in found.parameters["corrected"].items()} == {"k": K, "c": C}


def test_what_nothing_known_explains_is_reported_as_that(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    random = np.random.default_rng(8)

    def stuck(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        """The load cell sticks to its value four times in a test for a quarter of a second."""
        force = lawful(t, u, v, a, order)
        for start in random.integers(200, t.size - 100, 4):
            force[start : start + 60] = force[start]
        return force

    monkeypatch.setattr(outcome, "other_law", lambda *_: None)
    found = calibrate(campaign(tmp_path, stuck, tests=5), threads=1)
    assert found.verdict in ("nothing_found", "partly_explained") and found.ending == "complete"
    assert found.more_is_left and found.worst is not None
    assert found.unexplained_share > 0.2
    assert found.unexplained_shape
    reported = json.loads(json.dumps(calibration_json(found), allow_nan=False))
    assert reported["verdict"] == found.verdict and reported["effects"] == []
