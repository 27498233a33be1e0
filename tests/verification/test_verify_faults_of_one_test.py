"""A fault of an instrument in one test is found and named, with its size: tests of which another program made the
forces. The size is the one that was put in.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from one_test_faults import Columns, Fault, campaign, late_force, more_displacement, more_force, none, slow_clock

from edesign.calibration import calibrate
from edesign.calibration.results.result import Calibration, OutlyingTest
from edesign.calibration.write import calibration_json
from edesign.errors import InputError
from edesign.report.calibration.verdict import verdict_text
from edesign.report.check import damper_files

CASE = Path(os.environ.get("EDESIGN_SHARED") or Path(__file__).parents[3] / "shared") / "cases/one_test_clock"


def inches(of: Columns) -> Columns:
    """Displacement in inches, where millimetres are declared."""
    return of[0], of[1] / 25.4, of[2]


def told(found: Calibration, name: str) -> OutlyingTest:
    """What is said of the one test that does not agree with the others."""
    (one,) = found.outlying
    assert one.name == name and one.chance < 0.01
    return one


def check_size(one: OutlyingTest, label: str, value: float) -> None:
    fault = next(each for each in one.faults if each.label == label)
    (size,) = fault.parameters.values()
    assert abs(size.value - value) < 3.0 * size.standard_error < 0.05


def test_the_clock_of_one_test_is_found_and_not_spread_over_the_law(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, "kelvin_voigt", slow_clock(0.25), 4), threads=1)
    assert found.verdict == "explained" and [effect.label for effect in found.effects] == ["clock.of_test_4"]
    check_size(told(found, "run_04"), "clock.of_test_4", 0.25)
    own = found.parameters["corrected"]
    for name, true in (("k", 2.0e6), ("c", 0.27e6)):  # that of the other tests
        assert abs(own[name].value - true) < 3.0 * own[name].standard_error
    text = verdict_text(found)
    assert "run_04 does not agree with the other tests: without it only noise is left in them." in text
    assert "its time column reads 25.0" in text and "too much" in text
    (written,) = calibration_json(found)["outlying_tests"]
    assert written["test"] == "run_04" and written["only_noise_without"]
    assert [one["name"] for one in written["faults"]] == ["clock"]


CASES: list[tuple[str, Fault, int, str, float]] = [
    ("kelvin_voigt", more_force(0.12), 3, "gain.force_of_test_3", 0.12),
    ("kelvin_voigt", more_force(-0.08), 1, "gain.force_of_test_1", -0.08),
    ("kelvin_voigt", late_force(0.02), 3, "lag.delay_of_test_3", 0.02),
    ("kelvin_voigt", late_force(0.22), 3, "lag.delay_of_test_3", 0.22),  # a ninth of its period
    ("kelvin_voigt", inches, 2, "gain.displacement_of_test_2", 1.0 / 25.4 - 1.0),
    ("bouc_wen", more_force(0.12), 4, "gain.force_of_test_4", 0.12),
    ("bouc_wen", more_displacement(0.08), 2, "gain.displacement_of_test_2", 0.08),
    ("bouc_wen", inches, 2, "gain.displacement_of_test_2", 1.0 / 25.4 - 1.0),
    ("viscous_power", more_force(0.12), 3, "gain.force_of_test_3", 0.12),
    ("viscous_power", slow_clock(0.25), 2, "clock.of_test_2", 0.25),
]


@pytest.mark.slow
@pytest.mark.parametrize(("law", "fault", "number", "label", "size"), CASES)
def test_a_fault_is_named_with_its_size(
    tmp_path: Path, law: str, fault: Fault, number: int, label: str, size: float
) -> None:
    found = calibrate(campaign(tmp_path, law, fault, number), threads=1)
    assert found.verdict == "explained" and len(found.effects) == 1
    (effect,) = found.effects
    assert effect.kind == "instrument" and effect.form.endswith(f"of_test_{number}")
    one = told(found, f"run_{number:02d}")
    check_size(one, label, size)
    # a power of the velocity has one gain: force, displacement and time are one; a linear force is proportional to both
    alike = {"viscous_power": {"gain", "clock"}}.get(law, {effect.name}) if effect.name != "lag" else {"lag"}
    assert effect.name in alike and {fault.name for fault in one.faults} <= alike
    assert {other.split(".")[0] for other in found.effects[0].indistinguishable_from} <= alike


@pytest.mark.slow
@pytest.mark.parametrize("law", ["kelvin_voigt", "bouc_wen"])
def test_a_faulty_validation_test_is_told(tmp_path: Path, law: str) -> None:
    found = calibrate(campaign(tmp_path, law, more_force(0.12), 6), threads=1)
    assert not found.effects
    one = told(found, "run_06")
    assert one.use == "validate" and one.only_noise
    check_size(one, "gain.force_of_test_6", 0.12)
    assert "The validation test run_06 does not agree with the other tests" in verdict_text(found)


@pytest.mark.slow
def test_one_of_three_fitted_tests_is_told(tmp_path: Path) -> None:
    """Two agree by chance (1 %) to 1/190 of what the third is off by: a fault of 12 % is told, but not adopted."""
    found = calibrate(campaign(tmp_path, "kelvin_voigt", more_force(0.25), 2, tests=4, validation=1), threads=1)
    assert [effect.name for effect in found.effects] == ["gain"]
    check_size(told(found, "run_02"), "gain.force_of_test_2", 0.25)


@pytest.mark.slow
def test_what_no_instrument_does_is_told_without_a_name(tmp_path: Path) -> None:
    """Force that saturates in one test is no gain, clock, lag or temperature."""

    def limited(of: Columns) -> Columns:
        top = 0.35 * np.max(np.abs(of[2]))
        return of[0], of[1], top * np.tanh(of[2] / top)

    found = calibrate(campaign(tmp_path, "kelvin_voigt", limited, 3), threads=1)
    one = told(found, "run_03")
    assert one.faults == () and one.only_noise
    assert "No fault of an instrument that is known here explains all of it." in verdict_text(found)
    assert found.verdict != "explained"


@pytest.mark.slow
def test_a_fault_is_told_though_validation_tests_withhold_the_effect(tmp_path: Path) -> None:
    """A lag hardly moves a power law: the validation tests, both times at their noise, cannot judge it."""
    found = calibrate(campaign(tmp_path, "viscous_power", late_force(0.02), 3), threads=1)
    check_size(told(found, "run_03"), "lag.delay_of_test_3", 0.02)


@pytest.mark.parametrize("law", ["kelvin_voigt", "bouc_wen", "viscous_power"])
def test_tests_that_agree_are_told_nothing_of(tmp_path: Path, law: str) -> None:
    found = calibrate(campaign(tmp_path, law, none, 0), threads=1)
    assert found.verdict == "none" and found.outlying == () and "agree" not in verdict_text(found)


@pytest.mark.parametrize("swapped", [more_force(-2.0), more_displacement(-2.0)])
def test_a_wrong_sign_in_one_test_is_refused_and_checked_by_name(tmp_path: Path, swapped: Fault) -> None:
    path = campaign(tmp_path, "bouc_wen", swapped, 2)
    with pytest.raises(InputError, match=r"run_02\.csv: the force is negative .*E-CALIB-07"):
        calibrate(path, threads=1)
    assert "run_02: the damper gives energy instead of taking it" in damper_files.tests_summary(path)["warnings"]


@pytest.mark.skipif(not CASE.is_dir(), reason="no cases beside the repository")
@pytest.mark.slow
def test_the_handed_case_is_named() -> None:
    found = calibrate(CASE / "campaign.yaml", threads=1)
    assert found.verdict == "explained" and [effect.label for effect in found.effects] == ["clock.of_test_4"]
    check_size(told(found, "test_04"), "clock.of_test_4", 0.25)


def test_a_gain_that_changed_before_the_last_fitted_test_is_no_fault_of_it_alone(tmp_path: Path) -> None:
    """The tests that validate follow it, and have the gain too."""
    path = campaign(tmp_path, "kelvin_voigt", more_force(0.12), 4)
    for number in (5, 6):
        file = tmp_path / f"run_{number:02d}.csv"
        columns = np.loadtxt(file, delimiter=",", skiprows=1) * (1.0, 1.0, 1.12)
        np.savetxt(file, columns, "%.7g", ",", header="time_s,displacement_mm,force_kN", comments="")
    found = calibrate(path, threads=1)
    assert [effect.label for effect in found.effects] == ["gain.force_from_test_4"]
    assert not found.failed and found.outlying == ()
