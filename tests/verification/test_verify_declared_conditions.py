"""Conditions that tests declare: what depends on them is found, with its size, in forces of closed form."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, Hidden, K, campaign, lawful

from edesign.calibration import calibrate
from edesign.calibration.results.law_file import law_text
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign

VOLTS = (0.0, 2.0, 1.0, 2.0, 0.5, 1.5)  # four tests fitted to: a mean of 1.25, a range of 2
MEAN, RANGE = 1.25, 2.0


def _at_voltages(folder: Path, hidden: Hidden) -> Campaign:
    made = campaign(folder, hidden, tests=6)
    tests = [replace(one, conditions={"voltage_V": volts}) for one, volts in zip(made.tests, VOLTS, strict=True)]
    write_campaign(folder, made.specimen, tests, made.law)
    return load_campaign(folder / "campaign.yaml")


def _dashpot(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return np.asarray(K * u + C * (1.0 + 0.3 * (VOLTS[order] - MEAN)) * v)


def _push(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    return np.asarray(lawful(t, u, v, a, order) + 400.0 * (VOLTS[order] - MEAN))


@pytest.mark.parametrize(
    ("hidden", "labels", "size"),
    [
        (_dashpot, {"condition.factor_of_voltage_V_dashpots", "condition.c_of_voltage_V"}, 0.3 * RANGE),
        (_push, {"condition.force_of_voltage_V"}, 400.0 * RANGE),
    ],
    ids=["dashpot", "push"],
)
def test_what_goes_with_a_declared_condition_is_found(
    tmp_path: Path, hidden: Hidden, labels: set[str], size: float
) -> None:
    tests = _at_voltages(tmp_path, hidden)
    found = calibrate(tests, threads=1)
    (effect,) = found.effects
    assert effect.label in labels and found.verdict == "explained"
    estimate = next(iter(effect.parameters.values()))
    # the formula is the form's own: four standard errors, and a thousandth for the integration of the samples
    assert estimate.value == pytest.approx(size, abs=4.0 * estimate.standard_error + 1e-3 * size)
    assert found.errors["corrected"].validate < 1.2 * found.noise_floor < found.errors["declared"].validate
    text = law_text(found, tests)
    assert "as at the mean of the fitted tests, and nowhere else: " in text and "voltage_V, 0 to 2" in text
    assert "effects:" not in text


def test_a_condition_that_does_nothing_is_no_effect(tmp_path: Path) -> None:
    found = calibrate(_at_voltages(tmp_path, lawful), threads=1)
    assert not found.effects and found.verdict == "none"
