"""Laws of the wrong kind are told before effects are blamed, and laws of the right kind are not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, K, campaign

from edesign.calibrate.dampers.fitted_law import with_fitted_law
from edesign.calibrate.run import calibrate
from edesign.calibrate.write import calibration_json
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.report.calibration.tables import errors_table, law_kind_text, verdict_text

SECONDS = 1.0  # of the search: what is asked here comes after it


def steady(folder: Path, law: str) -> Campaign:
    """Sines of a Kelvin-Voigt device at three frequencies, two amplitudes; the last one validates."""
    random, made = np.random.default_rng(1), []
    for i, (f, x0) in enumerate(((0.5, 3e-3), (1.0, 3e-3), (2.0, 3e-3), (1.0, 6e-3), (1.5, 4e-3))):
        w = 2.0 * np.pi * f
        t = np.arange(0.0, 5.0 / f, 1.0 / (100.0 * f))
        force = x0 * (K * np.sin(w * t) + C * w * np.cos(w * t)) + 60.0 * random.standard_normal(t.size)
        use = "validate" if i == 4 else "fit"
        made.append(DamperTest(f"sine_{i}", t, x0 * np.sin(w * t), force, use=use, start="in_motion"))
    return write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), made, LawChoice(law))


def test_a_dashpot_for_a_device_with_a_spring(tmp_path: Path) -> None:
    """k = 4 kN/mm, c = 0.2 kN s/mm: k' / |k*| = 1 / sqrt(1 + (c w / k)^2), mean 0.94 over the fitted sines."""
    tests = with_fitted_law(steady(tmp_path, "viscous"))
    found = calibrate(tests, workers=1, seconds=SECONDS)
    kind = found.kind
    assert found.fitted_first and kind is not None and kind.rival == "kelvin_voigt"
    assert kind.share == pytest.approx(1.0, abs=0.01)  # noise: 60 N of 10 kN, 4e-5 of the force squared
    ratio = [1.0 / np.hypot(1.0, C * 2.0 * np.pi * f / K) for f in (0.5, 1.0, 2.0, 1.0)]
    assert f"k' is {100.0 * np.mean(ratio):.0f} % of the dynamic stiffness |k*|, that of the law 0 %" in kind.signs
    first = law_kind_text(found)
    assert first.startswith("The law viscous is of the wrong kind") and "`law: {type: kelvin_voigt}`" in first
    assert verdict_text(found).startswith(first)
    assert any("names no parameters" in note for note in errors_table(found).notes)
    assert calibration_json(found)["law_kind"]["better"]["rival"] == "kelvin_voigt"


def test_the_right_law_without_parameters_is_fitted_and_nothing_is_missing(tmp_path: Path) -> None:
    campaign(tmp_path, tests=4)
    named = load_campaign(tmp_path / "campaign.yaml")
    assert named.law is not None
    assert with_fitted_law(named) is named  # parameters that are declared are kept
    found = calibrate(with_fitted_law(replace(named, law=LawChoice("kelvin_voigt"))), workers=1, seconds=SECONDS)
    assert (found.verdict, found.kind) == ("none", None)
    # noise of 60 N on 3200 samples of some 10 kN: 1e-4 of a stiffness; ten times that
    assert found.parameters["declared"]["k"].value == pytest.approx(K, rel=1e-3)
    assert law_kind_text(found) == "" and verdict_text(found).startswith("None")


def test_friction_of_a_rig_is_no_other_kind_of_law(tmp_path: Path) -> None:
    """Friction of 1 kN beside a device of some 10 kN: the law follows its tests within 15 %."""

    def hidden(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
        return K * u + C * v + 1e3 * np.tanh(v / 1e-3)

    found = calibrate(campaign(tmp_path, hidden, tests=4), workers=1, seconds=SECONDS)
    assert found.verdict != "none" and found.kind is None  # also where the time was too short to find it
