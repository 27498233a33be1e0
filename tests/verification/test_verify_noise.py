"""Noise estimates and motions without noise, against noise of a known deviation and motions known in closed form.

The scatter of a deviation from n samples is about 2/sqrt(n), 2 % for 7500, as part of the spectrum is used."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from scipy.signal import butter, lfilter, sosfilt

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.repeatability import repeatability
from edesign.calibration.residual.tones import without_tones
from edesign.calibration.signals.noise import smooth, white_noise

A = 0.01  # m
Values = tuple[np.ndarray, np.ndarray]  # displacement and velocity


def sine(t: np.ndarray) -> Values:
    w = 2.0 * np.pi * 0.53
    return A * np.sin(w * t), A * w * np.cos(w * t)


def cut_sine(t: np.ndarray) -> Values:
    """Begins and ends in the middle of the motion."""
    w = 2.0 * np.pi * 0.5
    return A * np.cos(w * t + 0.7), -A * w * np.sin(w * t + 0.7)


def sweep(t: np.ndarray) -> Values:
    phase, rate = 2.0 * np.pi * (0.2 * t + 0.1 * t * t), 2.0 * np.pi * (0.2 + 0.2 * t)
    return A * np.sin(phase), A * rate * np.cos(phase)


def triangle(t: np.ndarray) -> Values:
    phase = np.mod(0.5 * t + 0.0131, 1.0)
    up = phase < 0.5
    return A * np.where(up, 4.0 * phase - 1.0, 3.0 - 4.0 * phase), 2.0 * A * np.where(up, 1.0, -1.0)


def ramp_hold(t: np.ndarray) -> Values:
    at, value = np.array([0.0, 3.003, 5.0, 9.001, 12.0, 15.0]), A * np.array([0.0, 1.0, 1.0, -1.0, 0.0, 0.0])
    slope = np.append(np.diff(value) / np.diff(at), 0.0)
    return np.interp(t, at, value), slope[np.searchsorted(at, t, side="right") - 1]


def earthquake(t: np.ndarray) -> Values:
    rng = np.random.default_rng(5)
    u, v = np.zeros_like(t), np.zeros_like(t)
    for w, phase in zip(2.0 * np.pi * rng.uniform(0.2, 6.0, 60), rng.uniform(0.0, 6.0, 60), strict=True):
        u += np.sin(w * t + phase) / w
        v += np.cos(w * t + phase)
    scale = A / np.max(np.abs(u))
    return scale * u, scale * v


MOTIONS = [sine, cut_sine, sweep, triangle, ramp_hold, earthquake]
CORNERS = [triangle, ramp_hold]


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("rate", [100.0, 200.0, 500.0, 1000.0])
def test_white_noise_beside_a_motion(motion: object, rate: float) -> None:
    t = np.arange(0.0, 15.0, 1.0 / rate)
    u = motion(t)[0]  # type: ignore[operator]
    rng = np.random.default_rng(int(rate))
    for deviation in (1e-6, 5e-6, 1e-4):
        found = white_noise(u + deviation * rng.standard_normal(t.size), t)
        # four times the scatter of 2/sqrt(n); corners just above the noise cannot be separated from it and add to it
        assert found == pytest.approx(deviation, rel=0.2 if motion in CORNERS else 8.0 / np.sqrt(t.size))


@pytest.mark.parametrize("motion", MOTIONS)
def test_a_motion_without_noise_has_none_and_stays(motion: object) -> None:
    t = np.arange(0.0, 15.0, 1.0 / 200.0)
    u = motion(t)[0]  # type: ignore[operator]
    assert white_noise(u, t) == 0.0
    smoothed, velocity, _, noise = smooth(t, u)
    assert noise == 0.0
    assert np.array_equal(smoothed, u)
    assert velocity == pytest.approx(CubicSpline(t, u)(t, 1), abs=1e-12)


def test_white_noise_without_bias() -> None:
    t = np.arange(2000) / 500.0
    rng = np.random.default_rng(1)
    found = [white_noise(rng.standard_normal(t.size), t) for _ in range(200)]
    assert np.mean(found) == pytest.approx(1.0, abs=0.012)  # scatter of one 4 %: of the mean of 200 0.3 %
    assert np.std(found) < 0.06


def test_hum_and_jumps_count_for_nothing() -> None:
    """Friction jumps by 2 x 1 % of the force at each reversal, hum is ten times the noise."""
    t = np.arange(0.0, 15.0, 1.0 / 500.0)
    rng = np.random.default_rng(2)
    noise = 100.0 * rng.standard_normal(t.size)
    hum = 1000.0 * np.sin(2.0 * np.pi * 50.0 * t) + 500.0 * np.sin(2.0 * np.pi * 150.0 * t)
    jumps = 5e3 * np.sign(np.cos(2.0 * np.pi * 1.03 * t))
    assert white_noise(8e4 * np.sin(2.0 * np.pi * 1.03 * t) + noise + hum, t) == pytest.approx(100.0, rel=0.1)
    assert white_noise(jumps + noise, t) == pytest.approx(100.0, rel=0.1)


@pytest.mark.parametrize("step", [1e-6, 5e-6, 2e-5])
def test_rounding_to_steps(step: float) -> None:
    """Rounding to steps has a deviation of step/sqrt(12) (Widrow & Kollar, Quantization Noise, 2008, 1.3)."""
    t = np.arange(0.0, 15.0, 1.0 / 200.0)
    for motion in (sine, sweep, earthquake):
        found = white_noise(np.round(motion(t)[0] / step) * step, t)
        # slow parts round to a saw tooth below the plateau, never less than step/sqrt(12) by definition
        assert found == pytest.approx(step / np.sqrt(12.0), rel=0.1)


def test_noise_that_a_logger_has_filtered_keeps_its_deviation() -> None:
    t = np.arange(0.0, 15.0, 1.0 / 500.0)
    rng = np.random.default_rng(3)
    filtered = sosfilt(butter(6, 0.5, output="sos"), rng.standard_normal(t.size + 500))[500:] * 5e-6
    for motion in (sine, sweep, earthquake, triangle):
        assert white_noise(motion(t)[0] + filtered, t) == pytest.approx(float(np.std(filtered)), rel=0.15)


def test_uneven_sampling() -> None:
    rng = np.random.default_rng(4)
    even = np.arange(0.0, 15.0, 1.0 / 500.0)
    t = even + rng.uniform(-0.3, 0.3, even.size) / 500.0
    u, v = sweep(t)
    noisy = u + 5e-6 * rng.standard_normal(t.size)
    assert white_noise(noisy, t) == pytest.approx(5e-6, rel=0.06)  # 8/sqrt(n) would be 9 %
    raw = CubicSpline(t, noisy)(t, 1)
    # what an even grid does not resolve stays, noise that changes from sample to sample too: a third here
    assert _rms(smooth(t, noisy)[1] - v) < 0.4 * _rms(raw - v)


@pytest.mark.parametrize("motion", MOTIONS)
@pytest.mark.parametrize("rate", [200.0, 1000.0])
@pytest.mark.parametrize("deviation", [1e-6, 2e-6, 5e-6])
def test_velocity_of_a_smoothed_motion(motion: object, rate: float, deviation: float) -> None:
    """Never worse than the spline through the noisy samples; without corners the rms error falls to at most 0.4."""
    t = np.arange(0.0, 15.0, 1.0 / rate)
    u, v = motion(t)  # type: ignore[operator]
    noisy = u + deviation * np.random.default_rng(7).standard_normal(t.size)
    found, velocity, acceleration, noise = smooth(t, noisy)
    raw = CubicSpline(t, noisy)
    assert noise == pytest.approx(deviation, rel=0.15)
    share = _rms(velocity - v) / _rms(raw(t, 1) - v)
    # a spline through a corner misses it as well, by more than the noise at 200 Hz: nothing to win, nothing lost
    assert share < (1.01 if motion in CORNERS else 0.4 if rate == 200.0 else 0.1)
    assert _rms(found - u) < 1.01 * deviation
    assert _rms(acceleration) < 1.01 * _rms(raw(t, 2))
    if motion not in CORNERS and rate == 1000.0:  # no ringing: the last 2 % of the samples are no worse
        end = t.size // 50
        worst = max(np.max(np.abs(velocity - v)[:end]), np.max(np.abs(velocity - v)[-end:]))
        assert worst < 0.5 * np.max(np.abs(raw(t, 1) - v))


@pytest.mark.parametrize("motion", [sine, cut_sine, sweep, earthquake])
@pytest.mark.parametrize("rate", [200.0, 1000.0])
@pytest.mark.parametrize("deviation", [1e-6, 1e-5])
def test_acceleration_of_a_smoothed_motion(motion: object, rate: float, deviation: float) -> None:
    t = np.arange(0.0, 15.0, 1.0 / rate)
    rng = np.random.default_rng(int(rate))
    found = smooth(t, motion(t)[0] + deviation * rng.standard_normal(t.size))[2]  # type: ignore[operator]
    h = 1e-5
    exact = (motion(t + h)[1] - motion(t - h)[1]) / (2.0 * h)  # type: ignore[operator]
    inside = slice(t.size // 20, -t.size // 20)
    # of a motion in a band B, noise leaves deviation (2 pi B)^2 sqrt(2 B / rate), about B = 2 Hz beside the slowest
    # motion here: 2.2e-4 m/s2 of 0.08 m/s2 at 200 Hz and 10 micrometres, 0.3 %; ten times that, as it is not known
    assert np.sqrt(np.mean((found - exact)[inside] ** 2) / np.mean(exact[inside] ** 2)) < 0.03


def test_what_does_not_repeat_from_cycle_to_cycle() -> None:
    """White noise s, and in the band of the motion a noise of an autoregression with deviation 2 s, at once."""
    rng = np.random.default_rng(8)
    rate, s = 200.0, 400.0
    t = np.arange(0.0, 40.0, 1.0 / rate)
    motion = Cycles(t, A * np.sin(2.0 * np.pi * 0.5 * t))
    signal = 8e6 * motion.displacement + 1e10 * motion.displacement**3
    white = s * rng.standard_normal(t.size)
    assert white_noise(signal + white, t) == pytest.approx(s, rel=0.08)
    assert repeatability(motion, signal + white) == pytest.approx(s, rel=0.06)  # 8000 samples, three a difference
    a = 0.9
    coloured = np.zeros(t.size)
    for i in range(1, t.size):
        coloured[i] = a * coloured[i - 1] + 2.0 * s * np.sqrt(1.0 - a * a) * rng.standard_normal()
    # effective samples 8000 (1 - a^2)/(1 + a^2) = 840: scatter 1/sqrt(2 x 840/3) = 4 %
    assert repeatability(motion, signal + white + coloured) == pytest.approx(np.sqrt(5.0) * s, rel=0.12)
    # the channel's noise is less: slow scatter is no noise of a load cell
    assert white_noise(signal + white + coloured, t) < 0.6 * np.sqrt(5.0) * s


def test_what_a_model_can_have_repeats() -> None:
    """Hum, a change with each cycle, a constant: none of it is noise."""
    rng = np.random.default_rng(9)
    t = np.arange(0.0, 30.0, 1.0 / 200.0)
    motion = Cycles(t, A * np.sin(2.0 * np.pi * 0.5 * t))
    hum = 900.0 * np.sin(2.0 * np.pi * 50.2 * t)
    left = 8e6 * motion.displacement * (1.0 - 0.01 * t) + 2e3 + hum + 400.0 * rng.standard_normal(t.size)
    assert repeatability(motion, without_tones(motion, left)) == pytest.approx(400.0, rel=0.08)


def test_a_test_without_cycles_does_not_show_what_repeats() -> None:
    t = np.arange(0.0, 15.0, 1.0 / 500.0)
    assert repeatability(Cycles(t, earthquake(t)[0]), np.random.default_rng(10).standard_normal(t.size)) is None


def test_a_sweep_does_not_repeat() -> None:
    """A force of the displacement alone that the model lacks returns at another phase: it is no noise."""
    t = np.arange(0.0, 20.0, 1.0 / 100.0)
    f0, f1 = 0.3, 2.5
    u = A * np.sin(2.0 * np.pi * (f0 * t + (f1 - f0) / 40.0 * t * t))
    left = 2e3 * np.sin(2.0 * np.pi * u / 0.005) + 100.0 * np.random.default_rng(3).standard_normal(t.size)
    assert Cycles(t, u).steady_parts()
    assert repeatability(Cycles(t, u), left) is None


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


@pytest.mark.parametrize("phi", [0.3, 0.5, 0.7])
def test_noise_that_is_correlated_from_sample_to_sample_keeps_its_deviation(phi: float) -> None:
    """x_i = phi x_(i-1) + e_i: the density far above is (1 - phi)/(1 + phi) of its mean, 0.18 for 0.7."""
    t = np.arange(0.0, 15.0, 1.0 / 500.0)
    rng = np.random.default_rng(4)
    for motion in (sine, sweep, earthquake):
        noise = lfilter([np.sqrt(1.0 - phi**2)], [1.0, -phi], rng.standard_normal(t.size)) * 5e-6
        # twelve draws scatter by 2 % (0.3) to 6 % (0.7) about 1.02; by the density high up it would be less by 27 %
        # to 58 %
        assert white_noise(motion(t)[0] + noise, t) == pytest.approx(5e-6, rel=0.15)


@pytest.mark.parametrize("cut", [45.0, 70.0])
def test_a_filter_below_the_upper_half_of_the_band_hides_no_noise_of_a_motion(cut: float) -> None:
    """Noise of 5 micrometres as dense as white noise up to 45 Hz at 500 Hz: what differentiation makes of it is known
    by the density, not by its deviation, and far above the cut there is nothing."""
    t = np.arange(0.0, 15.0, 1.0 / 500.0)
    rng = np.random.default_rng(5)
    low = butter(4, cut / 250.0, output="sos")
    for motion in (sine, sweep, earthquake):
        noise = 5e-6 * sosfilt(low, rng.standard_normal(t.size + 500))[500:]
        noisy = motion(t)[0] + noise
        # a part of the spectrum of half an octave: some 20 independent values in each of the segments
        assert smooth(t, noisy)[3] == pytest.approx(5e-6, rel=0.2)
        assert white_noise(noisy, t) == pytest.approx(float(np.std(noise)), rel=0.2)


def test_what_a_building_does_below_20_hz_is_no_noise_of_a_slow_logger() -> None:
    """At 100 Hz: storeys that answer alike from 7 to 13 Hz beside the motion of a base; noise of 30 N that passes a
    filter at 25 Hz."""
    t = np.arange(0.0, 60.0, 1.0 / 100.0)
    for seed in (6, 7, 8):
        rng = np.random.default_rng(seed)
        band, filtered = butter(4, (0.14, 0.26), "bandpass", output="sos"), butter(10, 0.5, output="sos")
        storeys = 2000.0 * sosfilt(band, rng.standard_normal(t.size + 500))[500:]
        base = 5e4 * earthquake(t)[1] / np.max(np.abs(earthquake(t)[1]))
        noise = 30.0 * sosfilt(filtered, rng.standard_normal(t.size + 500))[500:]
        # twice the noise that passes; the storeys were taken for 1000 of it
        assert white_noise(base + storeys + noise, t) < 60.0
