"""A campaign of random motion to 30 Hz at 100 samples a second, made here: what is found, and the floor, against truth.

A Kelvin-Voigt damper with 150 kg between it and the load cell, in closed form; noise of 0.23 % of the rms force. Half a
second of rest stands before and after each motion.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest
from shared_records import SHARED

from edesign.calibration import calibrate
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.results.floor import _from_test_to_test
from edesign.damper.laws import law
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.report.calibration.verdict import verdict_text

HANDED = SHARED.parent / "cases" / "noise_floor_broadband" / "campaign.yaml"
DT, N, OVER = 0.01, 1630, 8
K, C, MASS = 5.0e6, 5.0e4, 150.0  # N/m, N s/m, kg
NOISE = 2.3e-3  # of the rms force
SPECIMEN = Specimen("s", 2, 0.0414, 0.012)


def made(
    number: int, top: float = 30.0, mass: float = MASS, rest: float = 0.5, motion: int | None = None
) -> DamperTest:
    """A test of a random motion whose power falls about a frequency, Hz, and is even below it."""
    random = np.random.default_rng(number if motion is None else motion)
    frequency = np.fft.rfftfreq(N * OVER, DT / OVER)
    size = 1.0 / np.sqrt(1.0 + (frequency / top) ** 40)
    size[0] = 0.0
    u = np.fft.irfft(size * np.exp(2j * np.pi * random.random(size.size)))
    time = DT / OVER * np.arange(u.size)
    ramp = np.clip((np.minimum(time, time[-1] - time) - rest) / 0.5, 0.0, 1.0) if rest else np.ones(time.size)
    u *= 1.5e-3 / np.std(u) * ramp**3 * (10.0 - 15.0 * ramp + 6.0 * ramp**2)
    omega = 2j * np.pi * frequency
    v, a = np.fft.irfft(omega * np.fft.rfft(u)), np.fft.irfft(omega**2 * np.fft.rfft(u))
    force = (K * u + C * v + mass * a)[::OVER]
    force += NOISE * np.sqrt(np.mean(force**2)) * np.random.default_rng(100 + number).standard_normal(N)
    displacement = u[::OVER] + 2e-7 * np.random.default_rng(200 + number).standard_normal(N)
    use = "validate" if number > 3 else "fit"
    return DamperTest(f"test_{number}", DT * np.arange(N), displacement, force, 20.0, use=use)  # type: ignore[arg-type]


def campaign(folder: Path, tests: list[DamperTest], off: float) -> Campaign:
    declared = write_parameters(law("kelvin_voigt"), {"k": K * off, "c": C / off})
    return load_campaign(write_campaign(folder, SPECIMEN, tests, LawChoice("kelvin_voigt", declared)).path)


@pytest.mark.slow  # 20 s
def test_the_mass_is_found_and_no_branch(tmp_path: Path) -> None:
    """Before: a floor of 2000 times the true one, 106 kg, and a relaxation branch in law.yaml."""
    found = calibrate(campaign(tmp_path, [made(i) for i in range(6)], 1.04), threads=1)
    assert [effect.name for effect in found.effects] == ["inertia"] and not found.law_file.effects
    assert found.effects[0].parameters["mass"].value == pytest.approx(MASS, rel=0.01)
    assert found.parameters["corrected"]["k"].value == pytest.approx(K, rel=0.005)
    assert 0.7 * NOISE**2 < found.noise_floor < 10.0 * NOISE**2  # most of it is the motion between samples
    assert 0.3 * found.noise_floor < found.interpolation < found.noise_floor
    assert found.errors["corrected"].validate < 3.0 * NOISE**2


@pytest.mark.skipif(not HANDED.exists(), reason="the case that was handed in is not part of the repository")
def test_the_case_that_was_handed_in(tmp_path: Path) -> None:
    """Its true noise is an NRMS of 5.5e-6: a quarter of it is what noise of few samples in rests scatters by."""
    shutil.copytree(HANDED.parent, tmp_path / "case")
    problem = damper_problem(load_campaign(tmp_path / "case" / "campaign.yaml"), threads=1).full_rate
    noise = sum(one.force.size * one.channel_noise**2 for one in problem.experiments)
    assert noise / sum(float(one.force @ one.force) for one in problem.experiments) == pytest.approx(5.5e-6, rel=0.5)


@pytest.mark.parametrize("top", [45.0, 60.0])  # Hz; the Nyquist frequency is 50 Hz
def test_motion_up_to_the_nyquist_frequency_has_no_measured_noise(top: float, tmp_path: Path) -> None:
    """Nothing rests, and the motion leaves no place in the spectrum: the least noise is assumed."""
    tests = [made(i, top, 0.0, 0.0) for i in range(6)]
    for one in damper_problem(campaign(tmp_path, tests, 1.04), threads=1).experiments:
        assert not one.noise_measured and one.displacement_noise == 0.0
        assert one.channel_noise == pytest.approx(1e-3 * np.sqrt(np.mean(one.force**2)), rel=0.01)
        assert one.interpolation_noise > 0.1 * np.sqrt(np.mean(one.force**2))


@pytest.mark.parametrize("again", [False, True])
def test_a_test_made_again_measures_what_the_motion_hides(again: bool, tmp_path: Path) -> None:
    """Motions of 0.9 of the Nyquist frequency, of which each is made once or twice."""
    tests = [made(i, 45.0, 0.0, 0.0, i // 2 if again else i) for i in range(6)]
    problem = damper_problem(campaign(tmp_path, tests, 1.0), threads=1).full_rate
    left = [NOISE * 1e4 * np.random.default_rng(i).standard_normal(N) for i in range(6)]
    found = _from_test_to_test(problem.experiments, left)
    assert found == pytest.approx([NOISE * 1e4] * 6, rel=0.1) if again else np.all(np.isnan(found))


@pytest.mark.slow  # 20 s
def test_what_is_left_beyond_noise_that_was_assumed_is_not_called_missing(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, [made(i, 45.0, 0.0, 0.0) for i in range(6)], 1.0), threads=1)
    assert found.verdict == "nothing_found" and "of what is not known of the motion between samples" in found.doubtful
    assert not found.law_file.effects and all(one.assumed for one in found.series)
    assert "Whether more than noise is left cannot be said" in verdict_text(found)
