"""Tones in the force: known lines of a spectrum are taken out, the motion and noise are left."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import j0
from unit.calibrate.sine_trials import ROUNDING, W, noisy_forces, share_left, sine_sizes, sine_trial

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import hum
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.peaks import common_tones
from edesign.calibrate.dampers.trial import Sizes


def test_a_tone_is_taken_out_with_its_harmonics() -> None:
    trial = sine_trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tone = 25.0 * np.sin(W * 50.02 * since + 0.7) + 4.0 * np.sin(W * 100.04 * since - 1.1)
    p = {"frequency": 50.02}
    assert share_left(hum.Harmonics().columns(p, trial), tone) < ROUNDING
    # the second tone is left: 4 of sqrt(25^2 + 4^2)
    assert share_left(hum.Tone().columns(p, trial), tone) == pytest.approx(4.0 / np.hypot(25.0, 4.0), rel=1e-2)


def test_two_tones_have_frequencies_of_their_own() -> None:
    trial = sine_trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tones = 25.0 * np.sin(W * 9.3 * since + 0.7) + 14.0 * np.sin(W * 34.79 * since - 1.1)
    assert share_left(hum.TwoTones().columns({"frequency": 9.3, "second": 34.79}, trial), tones) < ROUNDING
    assert share_left(hum.Tone().columns({"frequency": 9.3}, trial), tones) == pytest.approx(
        14.0 / np.hypot(25.0, 14.0), rel=1e-2
    )


def test_three_tones_have_frequencies_of_their_own() -> None:
    trial = sine_trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tones = sum(a * np.sin(W * f * since + f) for a, f in ((9.0, 9.3), (5.0, 34.79), (2.0, 51.1)))
    p = {"frequency": 9.3, "second": 34.79, "third": 51.1}
    assert share_left(hum.ThreeTones().columns(p, trial), tones) < ROUNDING
    assert hum.ThreeTones().columns(p, trial).shape == (since.size, 6)


def test_a_tone_below_harmonics_of_the_motion_is_found_where_it_is_none_of_them() -> None:
    # sines of 1, 1.3 and 2 Hz leave their own odd harmonics; 8.6 Hz is none of them, though below seven times 2 Hz
    trials = [sine_trial(200.0, 20.0, f, i) for i, f in enumerate((1.0, 1.3, 2.0))]
    residuals = noisy_forces(trials, 9)
    for trial, residual, f in zip(trials, residuals, (1.0, 1.3, 2.0), strict=True):
        since = trial.motion.time - trial.motion.time[0]
        residual += sum(300.0 / n * np.sin(W * f * n * since) for n in (3, 5, 7))
    assert common_tones(trials, residuals) == ()
    for trial, residual in zip(trials, residuals, strict=True):
        residual += 60.0 * np.sin(W * 8.6 * trial.motion.time)
    assert common_tones(trials, residuals) == pytest.approx((8.6,), abs=0.25 / 20.0)


def test_a_tone_whose_frequency_hunts_is_taken_out_by_restless_alone() -> None:
    # sin(w t + cos(W f t)) has sidebands J_n(1) at n f = 0.15 n Hz (Jacobi, Anger): unsteady, up to 0.1 Hz, leaves all
    # but J_0^2 of the power; restless, up to 0.5 Hz, leaves 2 (J_4^2 + ...) = 1.2e-5
    trial = sine_trial(120.0, 20.0)
    since = trial.motion.time - trial.motion.time[0]
    hunting = 25.0 * np.sin(W * 50.02 * since + np.cos(W * 0.15 * since))

    def left(form: Form) -> float:
        columns = form.columns({"frequency": 50.02}, trial)
        assert columns is not None
        rest = hunting - columns @ np.linalg.lstsq(columns, hunting, rcond=None)[0]
        return float(rest @ rest / (hunting @ hunting))

    # sums over 2401 samples in place of integrals: 1/2401 of the power, a few times
    assert left(hum.Unsteady()) == pytest.approx(1.0 - j0(1.0) ** 2, abs=2e-3)
    assert left(hum.Restless()) < 5e-5


def test_a_tone_that_hunts_goes_where_harmonics_of_a_fast_motion_are_too() -> None:
    # between the fifth and the sixth harmonic of 4 Hz; sidebands as above, of which up to 0.5 Hz are taken out
    trial = sine_trial(400.0, 20.0, frequency=4.0)
    since = trial.motion.time - trial.motion.time[0]
    hunting = 25.0 * np.sin(W * 21.7 * since + np.cos(W * 0.15 * since))
    columns = hum.Restless().columns({"frequency": 21.7}, trial)
    rest = hunting - columns @ np.linalg.lstsq(columns, hunting, rcond=None)[0]
    assert float(rest @ rest / (hunting @ hunting)) < 5e-5


@pytest.mark.slow
def test_of_a_tone_that_wanders_more_cosines_leave_less() -> None:
    # amplitude 1 + 0.3 z, z with the spectrum 2 T / (1 + (2 pi f T)^2), T = 4 s: above f_c, for f_c T far above 1, the
    # share 1 / (pi^2 f_c T) of its power is left (Rice 1944, Bell Syst. Tech. J. 23, section 2.7)
    trial, duration, t0 = sine_trial(400.0, 20.0), 20.0, 4.0
    since = trial.motion.time - trial.motion.time[0]
    step = float(since[1])
    rest = {hum.Restless: 0.0, hum.Hunting: 0.0}
    random = np.random.default_rng(8)
    for _ in range(20):
        keep = np.exp(-step / t0)
        slow = lfilter([np.sqrt(1.0 - keep**2)], [1.0, -keep], random.standard_normal(since.size + 8000))[8000:]
        tone = 0.3 * slow * np.sin(W * 50.02 * since)
        for kind in rest:
            columns = kind().columns({"frequency": 50.02}, trial)
            assert columns is not None
            left = tone - columns @ np.linalg.lstsq(columns, tone, rcond=None)[0]
            rest[kind] += float(left @ left) / (20.0 * 0.045 * since.size)
    for kind, cosines in ((hum.Restless, 21), (hum.Hunting, 81)):
        corner = (cosines - 1) / (2.0 * duration)
        # 20 draws, and rows of cosines over 20 s end within 1/20 Hz: a tenth of the corner of the shorter one
        assert rest[kind] == pytest.approx(1.0 / (np.pi**2 * corner * t0), rel=0.25)


def test_differences_of_a_frequency_stay_within_its_peak() -> None:
    # out of step by 2 pi df T at the end: far below one turn
    (unknown,) = hum.Tone().unknowns(sine_sizes())
    x = unknown.coordinate(50.0)
    moved = unknown.value(x + unknown.step(x)) - unknown.value(x)
    assert 0.0 < W * moved * sine_sizes().duration < 0.05


def test_hum_below_the_noise_is_found_in_what_several_tests_have_in_common() -> None:
    trials = [sine_trial(rate, 20.0, f, i) for i, (rate, f) in enumerate(((120.0, 0.5), (125.0, 1.0), (150.0, 2.0)))]
    residuals = noisy_forces(trials, 1)
    for i, (trial, residual) in enumerate(zip(trials, residuals, strict=True)):
        residual += 8.0 * np.sin(W * 49.93 * trial.motion.time + i)
    starts = hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))
    # to a quarter of the resolution of 20 s
    assert starts[0][0] == pytest.approx(49.93, abs=0.25 / 20.0)


def test_hum_above_half_the_rate_is_told_from_its_alias() -> None:
    trials = [sine_trial(120.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    residuals = noisy_forces(trials, 2)
    for trial, residual in zip(trials, residuals, strict=True):
        residual += 8.0 * np.sin(W * 100.05 * trial.motion.time)
    assert common_tones(trials, residuals)[0] == pytest.approx(100.05, abs=0.25 / 20.0)


@pytest.mark.parametrize("tone", [150.02, 100.04, 40.04, 25.04])
def test_a_tone_above_the_rate_of_the_fit_is_told_by_the_record(tone: float) -> None:
    # 500 Hz thinned to 41.7 Hz: 150 Hz, 100 and 25 all look as 16.7; 40 Hz as 1.7, amid the motion
    whole = [sine_trial(500.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    added = noisy_forces(whole, 5)
    measured = []
    for trial, own in zip(whole, added, strict=True):
        own += 8.0 * np.sin(W * tone * trial.motion.time)
        measured.append(replace(trial, force=trial.force + own).thinned())
    assert [float(np.median(t.motion.steps)) for t in measured] == pytest.approx([0.024, 0.024], rel=1e-9)
    residuals = [own[::12] for own in added]
    assert common_tones(measured, residuals) == pytest.approx((tone,), abs=0.25 / 20.0)


def test_harmonics_start_from_the_lowest_peak() -> None:
    trials = [sine_trial(120.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    residuals = noisy_forces(trials, 6)
    for trial, residual in zip(trials, residuals, strict=True):
        residual += sum(12.0 * np.sin(W * 16.7 * n * trial.motion.time) for n in (1, 2, 3))
    ((start,),) = hum.Harmonics().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))
    assert start == pytest.approx(16.7, abs=0.25 / 20.0)
    assert len(hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))) == 3


def test_harmonics_of_the_motion_and_noise_are_no_hum() -> None:
    trials = [sine_trial(120.0, 20.0, f, i) for i, f in enumerate((2.0, 2.0, 2.0))]
    residuals = noisy_forces(trials, 4)
    assert common_tones(trials, residuals) == ()
    for trial, residual in zip(trials, residuals, strict=True):
        since = trial.motion.time - trial.motion.time[0]
        residual += sum(200.0 / n * np.sin(W * 2.0 * n * since) for n in (1, 3, 5, 7))
    assert common_tones(trials, residuals) == ()
    assert hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals)) == ()
