"""Displacement histories of damper tests: amplitudes, cycles, rest at both ends, continuous velocity."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.damper.testing.cycles import find_blocks
from edesign.damper.testing.signals import SWEEP_4_4, from_record, random, sine, sweep, sweep_4_4
from edesign.errors import InputError


def largest_jump_of_velocity(t: np.ndarray, u: np.ndarray, omega: float) -> float:
    """Beyond what the largest acceleration of a sine makes, as a share of its largest velocity."""
    velocity = np.diff(u) / np.diff(t)
    return float(np.max(np.abs(np.diff(velocity)))) / (omega * float(np.max(np.abs(u))))


@settings(max_examples=40, deadline=None)
@given(
    st.floats(1e-4, 0.1), st.floats(0.1, 8.0), st.integers(3, 25), st.integers(0, 6), st.sampled_from([250.0, 1000.0])
)
def test_a_sine_has_the_cycles_asked_for(amplitude: float, f: float, cycles: int, half_ramps: int, rate: float) -> None:
    ramp = 0.5 * half_ramps
    t, u = sine(amplitude, f, cycles, ramp, ramp, rate)
    longest = max(find_blocks(t, u), key=lambda block: block.cycles)
    assert longest.cycles >= cycles and longest.cycles <= cycles + ramp
    assert longest.amplitude == pytest.approx(amplitude, rel=0.02)
    assert u[0] == 0.0 and u[-1] == 0.0
    assert np.max(np.abs(u)) <= amplitude * (1 + 1e-12)
    assert t[-1] - 1.0 / rate < (cycles + 2.0 * ramp) / f <= t[-1] * (1.0 + 1e-9)


def test_the_thesis_sine() -> None:
    """18 full cycles between two ramps of two (3.2); the velocity has no jump, and is zero at the ends."""
    t, u = sine(0.006, 2.0)
    assert t[-1] == pytest.approx(11.0) and t[1] == 0.001
    (block,) = find_blocks(t, u)
    assert block.cycles == 18 and block.bounds[0] == pytest.approx(1.0, abs=1e-4)
    # a jump of the amplitude by a tenth would make 0.1
    assert largest_jump_of_velocity(t, u, 4.0 * np.pi) < 1.2 * 2.0 * np.pi * 2.0 * 0.001
    assert abs(u[1]) < 1e-4 * 0.006


def test_the_sweep_of_the_thesis() -> None:
    """Blocks of 4.4: u_max times 1/2, 1, 1/3, 1/6, 1/2, 2/3, 5/6, 1 (3 cycles), 5/6, 2/3, 1/2, 1/3, 1/6."""
    shares = [1 / 2, 1, 1 / 3, 1 / 6, 1 / 2, 2 / 3, 5 / 6, 1, 5 / 6, 2 / 3, 1 / 2, 1 / 3, 1 / 6]
    assert [share for _, share in SWEEP_4_4] == pytest.approx(shares)
    assert [cycles for cycles, _ in SWEEP_4_4] == [1.5] * 7 + [3.0] + [1.5] * 5
    t, u = sweep_4_4(0.006, 3.0)
    assert t[-1] == pytest.approx(7.0)
    blocks = find_blocks(t, u)
    assert [block.amplitude / 0.006 for block in blocks] == pytest.approx(shares, rel=1e-3)
    assert [block.cycles for block in blocks] == [1] * 7 + [3] + [1] * 5


def test_the_blend_takes_the_jump_out_of_the_velocity_and_leaves_peaks_and_zeros() -> None:
    t, blended = sweep_4_4(1.0, 1.0)
    _, bare = sweep_4_4(1.0, 1.0, blend=0.0)
    omega = 2.0 * np.pi
    assert largest_jump_of_velocity(t, bare, omega) > 0.6  # 1 to 1/3 at the end of the second block
    assert largest_jump_of_velocity(t, blended, omega) < 0.02
    peaks = np.isclose(np.abs(np.sin(omega * t)), 1.0, atol=1e-12)
    assert blended[peaks] == pytest.approx(bare[peaks], rel=1e-12)
    zeros = np.isclose(np.sin(omega * t), 0.0, atol=1e-9)
    assert np.max(np.abs(blended[zeros])) < 1e-9


def test_random_is_of_its_seed_level_and_band() -> None:
    t, u = random(60.0, (0.2, 4.0), 7, rms=0.002)
    assert np.sqrt(np.mean(u**2)) == pytest.approx(0.002)
    assert u[0] == 0.0 and u[-1] == 0.0
    again = random(60.0, (0.2, 4.0), 7, peak=0.006)[1]
    assert np.max(np.abs(again)) == pytest.approx(0.006)
    assert again / np.max(np.abs(again)) == pytest.approx(u / np.max(np.abs(u)), abs=1e-12)
    assert not np.allclose(random(60.0, (0.2, 4.0), 8, rms=0.002)[1], u)
    power = np.abs(np.fft.rfft(u)) ** 2
    frequency = np.fft.rfftfreq(u.size, t[1])
    outside = (frequency < 0.1) | (frequency > 4.1)  # the fading spreads the edges of the band by some 1/6 Hz
    assert power[outside].sum() < 1e-3 * power.sum()


def test_a_record_is_resampled_and_scaled() -> None:
    given_time = 5.0 + 0.02 * np.arange(500)
    t, u = from_record(given_time, 3.0 * np.sin(given_time - 5.0), peak=0.01)
    assert t[0] == 0.0 and t[1] == 0.001 and t[-1] == pytest.approx(9.98)
    assert u == pytest.approx(0.01 * np.sin(t), abs=1e-8)
    assert np.max(np.abs(from_record(given_time, np.sin(given_time))[1])) == pytest.approx(1.0, rel=1e-5)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: sine(0.0, 1.0), "amplitude: .*E-PROG-02"),
        (lambda: sine(1.0, float("nan")), "frequency"),
        (lambda: sine(1.0, 1.0, cycles=0), "cycles: .*E-PROG-02"),
        (lambda: sine(1.0, 1.0, ramp_up=0.3), "ramp_up: .*E-PROG-02"),
        (lambda: sweep(1.0, 1.0, ((1.2, 1.0),)), "blocks: .*E-PROG-02"),
        (lambda: sweep_4_4(1.0, 1.0, blend=0.7), "blend: .*E-PROG-02"),
        (lambda: random(10.0, (4.0, 1.0), 1, rms=1.0), "band: 4 Hz to 1 Hz .*E-PROG-03"),
        (lambda: random(10.0, (1.0, 4.0), 1), "random: .*E-PROG-02"),
        (lambda: random(0.1, (1.0, 2.0), 1, rms=1.0), r"band: 0\.1 s .*E-PROG-03"),
        (lambda: from_record([0.0, 1.0, 1.0], [0.0, 1.0, 2.0]), "record: .*ascend.*E-SIGNAL-02"),
        (lambda: from_record([0.0, 1.0], [0.0, 0.0], peak=1.0), "record: .*zero.*E-SIGNAL-02"),
    ],
)
def test_what_cannot_be(make: object, said: str) -> None:
    with pytest.raises(InputError, match=said):
        make()  # type: ignore[operator]
