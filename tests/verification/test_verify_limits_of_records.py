"""What records cannot show: forces beyond the load cell, and noise of records that have none; closed forms."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import NOISE, C, K, campaign

from edesign.calibration import calibrate
from edesign.calibration.write import calibration_json
from edesign.report.calibration.error_tables import each_test_table
from edesign.report.tables.text import plain

END = 11e3  # N, of the load cell: four of the tests go beyond, up to twice as far


def test_clipped_samples_have_no_weight(tmp_path: Path) -> None:
    whole = campaign(tmp_path, tests=6)
    tests = [one.with_force(np.clip(one.measured_force(), -END, END)) for one in whole.tests]
    found = calibrate(replace(whole, tests=tuple(tests)), threads=1)
    assert found.verdict == "none" and not found.effects
    estimates = found.parameters["refit"]
    for name, value in (("k", K), ("c", C)):
        assert estimates[name].value == pytest.approx(value, abs=4.0 * estimates[name].standard_error)
    beyond = {
        one.name: int(np.sum(np.abs(one.measured_force()) > END))
        for one in whole.tests
        if np.any(np.abs(one.measured_force()) > END)
    }
    assert len(beyond) >= 3 and calibration_json(found)["clipped_samples"] == beyond
    # the error is that of the noise in the samples that are left; a spectrum gives it to a fifth
    left = [f[np.abs(f) < END] for one in tests if one.use == "validate" for f in [one.measured_force()]]
    noise = sum(f.size for f in left) * NOISE**2 / sum(float(f @ f) for f in left)
    assert found.errors["refit"].validate == pytest.approx(noise, rel=0.1)
    assert found.noise_floor == pytest.approx(noise, rel=0.2)
    assert not any(one.assumed for one in found.series)
    assert f"{next(iter(beyond))} {next(iter(beyond.values()))}" in plain(each_test_table(found))


def test_a_floor_that_no_record_shows_is_reported(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, tests=4, noise=0.0), threads=1)
    names = [one.name for one in found.series]
    assert found.verdict == "none" and calibration_json(found)["noise_assumed"] == names
    for one in found.series:  # ISO 376: reproducibility of 0.1 % of what is measured, here of its rms
        assert one.noise == pytest.approx(1e-3 * float(np.sqrt(np.mean(one.measured**2))))
    assert "noise floor of all tests: not measured" in plain(each_test_table(found))


def test_spikes_have_no_weight_and_those_of_the_motion_are_interpolated(tmp_path: Path) -> None:
    whole = campaign(tmp_path, tests=6)
    random, tests, of_force, of_motion = np.random.default_rng(8), [], {}, {}
    for one in whole.tests:
        force, motion = one.measured_force().copy(), one.displacement.copy()
        at = np.sort(random.choice(np.arange(20, force.size - 20, 25), 6, replace=False))
        force[at[:4]] += 12e3 * random.choice([-1.0, 1.0], 4)
        motion[at[4:]] += 0.4 * np.ptp(motion)
        tests.append(replace(one, force=force, displacement=motion))
        of_force[one.name], of_motion[one.name] = one.time[np.sort(at[:4])], one.time[np.sort(at[4:])]
    found = calibrate(replace(whole, tests=tuple(tests)), threads=1)
    assert found.verdict == "none" and not found.effects
    for name, value in (("k", K), ("c", C)):
        estimate = found.parameters["refit"][name]
        assert estimate.value == pytest.approx(value, abs=4.0 * estimate.standard_error)
    told = calibration_json(found)["spikes"]
    assert told["force"] == {name: pytest.approx(times) for name, times in of_force.items()}
    assert told["displacement"] == {name: pytest.approx(times) for name, times in of_motion.items()}
    text = " ".join(plain(each_test_table(found)).split())
    assert "spikes of the force are not judged (samples): test_01 4, test_02 4" in text
    assert "spikes of the displacement were interpolated" in text
