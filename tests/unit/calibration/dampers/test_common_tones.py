"""Tones in the force that several tests have in common: known lines of spectra beside noise and harmonics."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, lfilter

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.tones import common_tones

W = 2.0 * np.pi
DURATION = 20.0  # s: a line is as wide as 0.05 Hz, of which a quarter is asked for
NOISE = 10.0  # N


def sine(rate: float, frequency: float, order: int) -> Motion:
    """A sine of 5 mm, sampled from a time of its own on."""
    t = np.arange(0.0, DURATION, 1.0 / rate) + 0.37 * order
    a, w = 5e-3, W * frequency
    return Motion(t, a * np.sin(w * t), a * w * np.cos(w * t), -a * w**2 * np.sin(w * t))


def tones(motions: list[Motion], left: list[np.ndarray]) -> tuple[float, ...]:
    """Tones of tests of a spring of 1 kN/mm, of which a law leaves something."""
    of_law = [1e6 * one.displacement for one in motions]
    return common_tones(motions, [a + b for a, b in zip(of_law, left, strict=True)], of_law)


def butterworth(values: np.ndarray, cut: float, rate: float) -> np.ndarray:
    b, a = butter(4, cut, fs=rate)
    return np.asarray(lfilter(b, a, values))


def noise(motions: list[Motion], seed: int) -> list[np.ndarray]:
    random = np.random.default_rng(seed)
    return [NOISE * random.standard_normal(one.time.size) for one in motions]


def test_hum_below_the_noise_is_found_in_what_several_tests_have_in_common() -> None:
    motions = [sine(rate, f, i) for i, (rate, f) in enumerate(((120.0, 0.5), (125.0, 1.0), (150.0, 2.0)))]
    left = noise(motions, 1)
    for i, (one, residual) in enumerate(zip(motions, left, strict=True)):
        residual += 0.8 * NOISE * np.sin(W * 49.93 * one.time + i)
    assert tones(motions, left) == pytest.approx((49.93,), abs=0.25 / DURATION)


def test_harmonics_of_the_motion_and_noise_are_no_tones() -> None:
    motions = [sine(120.0, 2.0, i) for i in range(3)]
    left = noise(motions, 4)
    assert tones(motions, left) == ()
    for one, residual in zip(motions, left, strict=True):
        residual += sum(200.0 / n * np.sin(W * 2.0 * n * one.time) for n in (1, 3, 5, 7))
    assert tones(motions, left) == ()


def test_a_tone_above_harmonics_of_the_motion_is_found() -> None:
    # sines of 1, 1.3 and 2 Hz leave their own odd harmonics: up to 14 Hz
    frequencies = (1.0, 1.3, 2.0)
    motions = [sine(200.0, f, i) for i, f in enumerate(frequencies)]
    left = noise(motions, 9)
    for one, residual, f in zip(motions, left, frequencies, strict=True):
        residual += sum(300.0 / n * np.sin(W * f * n * one.time) for n in (3, 5, 7))
    assert tones(motions, left) == ()
    for one, residual in zip(motions, left, strict=True):
        residual += 60.0 * np.sin(W * 17.3 * one.time)
    assert tones(motions, left) == pytest.approx((17.3,), abs=0.25 / DURATION)


def test_a_tone_below_harmonics_of_the_fastest_motion_is_found_by_slower_tests() -> None:
    frequencies = (1.0, 1.3, 2.0)
    motions = [sine(200.0, f, i) for i, f in enumerate(frequencies)]
    left = noise(motions, 9)
    for one, residual, f in zip(motions, left, frequencies, strict=True):
        residual += sum(300.0 / n * np.sin(W * f * n * one.time) for n in (3, 5, 7))
        residual += 60.0 * np.sin(W * 12.3 * one.time)
    assert tones(motions, left) == pytest.approx((12.3,), abs=0.25 / DURATION)


def test_tones_are_reported_in_the_order_of_their_size() -> None:
    motions = [sine(200.0, f, i) for i, f in enumerate((0.5, 1.0))]
    left = noise(motions, 6)
    for one, residual in zip(motions, left, strict=True):
        residual += sum(a * np.sin(W * f * one.time) for a, f in ((8.0, 16.7), (24.0, 34.79), (14.0, 51.1)))
    assert tones(motions, left) == pytest.approx((34.79, 51.1, 16.7), abs=0.25 / DURATION)


def test_a_tone_between_harmonics_of_all_motions_is_found() -> None:
    """Its frequency is 5.55, 4.27 and 3.26 times those of the sines, and amid those of a random motion."""
    frequencies = (1.1, 1.43, 1.87)
    motions = [sine(200.0, f, i) for i, f in enumerate(frequencies)]
    shaken = np.random.default_rng(3).standard_normal(motions[0].time.size)
    motions.append(motions[0].each(lambda _: 2e-3 * butterworth(shaken, 8.0, 200.0)))
    left = noise(motions, 9)
    for residual, one, f in zip(left, motions, frequencies, strict=False):
        residual += sum(300.0 / n * np.sin(W * f * n * one.time) for n in range(2, 8))
    assert tones(motions, left) == ()
    for one, residual in zip(motions, left, strict=True):
        residual += 60.0 * np.sin(W * 6.1 * one.time)
    assert tones(motions, left) == pytest.approx((6.1,), abs=0.25 / DURATION)


def test_a_tone_above_half_the_rate_of_slow_tests_is_found_by_its_images() -> None:
    """60 Hz, sampled with 25 and 50 Hz, stands at 10 Hz (Shannon 1949), and at 60 Hz in the test of 200 Hz."""
    motions = [sine(rate, 0.5, i) for i, rate in enumerate((25.0, 50.0, 50.0, 200.0))]
    left = noise(motions, 7)
    for i, (one, residual) in enumerate(zip(motions, left, strict=True)):
        residual += 3.0 * NOISE * np.sin(W * 60.0 * one.time + i)
    assert tones(motions, left) == pytest.approx((60.0,), abs=0.25 / DURATION)
    for one, residual in zip(motions, left, strict=True):
        residual += 2.0 * NOISE * np.sin(W * 8.3 * one.time)
    assert tones(motions, left) == pytest.approx((60.0, 8.3), abs=0.25 / DURATION)


def test_what_a_motion_of_two_tones_makes_of_a_wrong_law_is_no_tone() -> None:
    """The cube of 2 and 2.9 Hz has 6 and 8.7 Hz, and 6.8 and 7.8 Hz that are harmonics of neither."""
    both = [(sine(200.0, 2.0, i), sine(200.0, 2.9, i)) for i in range(3)]
    motions = [Motion(one.time, *np.add(one.samples[1:], other.samples[1:])) for one, other in both]
    left = [n + 4e9 * one.displacement**3 for n, one in zip(noise(motions, 5), motions, strict=True)]
    assert tones(motions, left) == ()


def test_bursts_of_one_frequency_with_a_rest_between_leave_no_tone_but_their_harmonics() -> None:
    motions = []
    for i in range(3):
        one = sine(200.0, 1.6, i)
        on = (one.since < 6.0) | (one.since > 12.0 + i)
        motions.append(one.each(lambda u, on=on: u * on))
    left = [n + 4e9 * one.displacement**3 for n, one in zip(noise(motions, 5), motions, strict=True)]
    assert tones(motions, left) == ()
