"""Baseline, filter, step and length of records, against closed forms and invariants."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.errors import InputError
from edesign.ground_motion.intensity import displacement, husid, velocity
from edesign.ground_motion.processing import (
    band_pass,
    correct_baseline,
    pad,
    remove_drift,
    resample_band_limited,
    taper,
    trim,
    trim_to_significant,
)
from edesign.ground_motion.record import Record

STEP = 0.01


def record(samples: np.ndarray, step: float = STEP) -> Record:
    return Record("x", samples, step, "test")


def pulse(time: np.ndarray, frequency: float = 2.0, centre: float = 10.0, width: float = 1.5) -> np.ndarray:
    """A Gaussian wave packet; 6 / (2 pi width) from its frequency the spectrum is exp(-18) = 1.5e-8 of its peak."""
    return np.exp(-0.5 * ((time - centre) / width) ** 2) * np.cos(2.0 * np.pi * frequency * (time - centre))


TIME = np.arange(2001) * STEP


# ---- baseline ----


@pytest.mark.parametrize("order", [0, 1, 2, 3])
def test_a_polynomial_of_acceleration_is_found_exactly(order: int) -> None:
    """Least squares on what is a polynomial leaves nothing: to rounding, relative to its largest sample."""
    line = np.polynomial.Polynomial([0.3, -0.02, 0.004, -0.0002][: order + 1])(TIME)
    left = correct_baseline(record(line), order, "acceleration")
    assert left.pga < 1e-12 * np.max(np.abs(line))
    assert f"order {order} fitted to the acceleration" in left.source


@pytest.mark.parametrize("order", [0, 1])
def test_a_polynomial_is_found_from_the_velocity(order: int) -> None:
    """A constant and a line have integrals by the trapezoidal rule that the fit reproduces."""
    line = np.polynomial.Polynomial([0.3, -0.02][: order + 1])(TIME)
    assert correct_baseline(record(line), order, "velocity").pga < 1e-12


def test_the_velocity_shows_a_small_offset_better_than_the_acceleration() -> None:
    """A packet at one end, whose sum is not zero over the record, misleads the mean of the acceleration."""
    motion = pulse(TIME, frequency=0.3, centre=19.0)
    offset = 0.01
    by_velocity = np.mean(motion + offset - correct_baseline(record(motion + offset), 0, "velocity").acceleration)
    by_acceleration = np.mean(
        motion + offset - correct_baseline(record(motion + offset), 0, "acceleration").acceleration
    )
    assert abs(by_velocity - offset) < 0.5 * abs(by_acceleration - offset)


@pytest.mark.parametrize("order", [3, 4, 6, 8])
def test_without_drift_the_motion_ends_at_rest(order: int) -> None:
    raw = record(pulse(TIME) + 0.02 - 0.003 * TIME + 1e-4 * TIME**2)
    still = remove_drift(raw, order)
    v, d = (integrate(still.acceleration, STEP) for integrate in (velocity, displacement))
    v0, d0 = (np.max(np.abs(integrate(raw.acceleration, STEP))) for integrate in (velocity, displacement))
    assert abs(v[-1]) < 1e-12 * v0  # rounding of a sum of 2000 terms
    assert abs(d[-1]) < 1e-12 * d0
    assert f"order {order}" in still.source


@pytest.mark.parametrize("order", [4, 6])
def test_a_drift_of_the_order_is_removed_whole(order: int) -> None:
    """Packet without drift + polynomial: the packet comes back, but for what the fit itself takes of it."""
    clean = pulse(TIME)  # its velocity and displacement at the end are below 1e-8
    drift = np.polynomial.Polynomial([0.05, -0.02, 1e-3, 2e-4, -1e-5][: order - 1])(TIME)
    of_both, of_clean = (remove_drift(record(samples), order).acceleration for samples in (clean + drift, clean))
    np.testing.assert_allclose(of_both, of_clean, atol=1e-11 * np.max(np.abs(drift)))
    assert np.max(np.abs(of_clean - clean)) < 2e-3  # a packet of 2 Hz looks like no polynomial over 20 s


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(-5.0, 5.0), min_size=7, max_size=60), st.sampled_from([3, 6]))
def test_any_record_ends_at_rest(samples: list[float], order: int) -> None:
    raw = np.array(samples)
    still = remove_drift(record(raw), order).acceleration
    scale = max(1e-300, np.max(np.abs(raw))) * STEP * raw.size  # a velocity
    assert abs(velocity(still, STEP)[-1]) <= 1e-10 * scale
    assert abs(displacement(still, STEP)[-1]) <= 1e-10 * scale * STEP * raw.size


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda r: correct_baseline(r, -1), "E-VALUE-02"),
        (lambda r: correct_baseline(r, 9), "E-VALUE-02"),
        (lambda r: correct_baseline(r, 1, "displacement"), "E-VALUE-03"),
        (lambda r: remove_drift(r, 2), "E-VALUE-02"),
        (lambda r: remove_drift(record(np.ones(4)), 6), "from 3 to 3.*E-VALUE-02"),
    ],
)
def test_impossible_baselines(change: Callable[[Record], Record], code: str) -> None:
    with pytest.raises(InputError, match=code):
        change(record(pulse(TIME)))


# ---- resampling ----


@pytest.mark.parametrize("new", [0.005, 0.004, 0.0075, 0.02, 0.03, 0.01 / 3.0, 0.025])
def test_a_band_limited_motion_keeps_its_closed_form(new: float) -> None:
    """2 Hz packet, no energy above 3 Hz, all steps carry 18 Hz: error within the ripple of the filter, 1e-5."""
    moved = resample_band_limited(record(pulse(TIME)), new)
    assert moved.time_step == new and moved.duration <= 20.0 + 1e-9 < moved.duration + new
    np.testing.assert_allclose(moved.acceleration, pulse(moved.time), atol=2e-5)
    assert f"resampled to {new:.9g} s as a band-limited signal" in moved.source


def test_linear_interpolation_is_far_worse() -> None:
    """Of a 8 Hz packet sampled at 0.01 s, straight lines lose up to (2 pi f dt)^2 / 8 = 3 % of the peak."""
    fine = np.arange(8001) * STEP / 4
    exact = pulse(fine, frequency=8.0)
    coarse = record(pulse(TIME, frequency=8.0))
    by_lines = np.max(np.abs(coarse.resampled(STEP / 4).acceleration - exact))
    by_band = np.max(np.abs(resample_band_limited(coarse, STEP / 4).acceleration - exact))
    assert 0.02 < by_lines < 0.035
    assert by_band < 2e-5


def test_what_the_larger_step_cannot_carry_does_not_come_back_as_something_else() -> None:
    """A 40 Hz packet at a step of 0.05 s (Nyquist 10 Hz) would alias to 0 Hz; it must vanish to 100 dB."""
    high = record(pulse(np.arange(4001) * 0.005, frequency=40.0), 0.005)
    assert resample_band_limited(high, 0.05).pga < 1e-4
    assert high.resampled(0.05).pga > 0.9  # every tenth sample of it looks like a slow wave


def test_there_and_back() -> None:
    start = record(pulse(TIME))
    back = resample_band_limited(resample_band_limited(start, 0.004), STEP)
    np.testing.assert_allclose(back.acceleration, start.acceleration, atol=4e-5)
    assert resample_band_limited(start, STEP) is start


@pytest.mark.parametrize(
    ("step", "code"),
    [
        (0.0, "E-REC-20"),
        (np.nan, "E-REC-20"),
        (30.0, "E-MOTION-03"),
        (np.pi / 300, "E-MOTION-03"),
    ],
)
def test_impossible_steps(step: float, code: str) -> None:
    with pytest.raises(InputError, match=code):
        resample_band_limited(record(pulse(TIME)), step)


# ---- length ----


def test_a_taper_is_half_a_cosine() -> None:
    tapered = taper(record(np.ones(101)), 0.2, 0.4)
    assert tapered.acceleration[0] == 0.0 and tapered.acceleration[-1] == pytest.approx(0.0, abs=1e-15)
    assert tapered.acceleration[10] == pytest.approx(0.5) and tapered.acceleration[80] == pytest.approx(0.5)
    np.testing.assert_array_equal(tapered.acceleration[20:60], 1.0)
    np.testing.assert_array_equal(taper(record(np.ones(5)), 0.0, 0.0).acceleration, np.ones(5))


def test_a_cut_keeps_the_samples_between_its_tapers() -> None:
    part = trim(record(pulse(TIME)), 5.0, 15.0, 0.5)
    assert part.duration == pytest.approx(10.0) and part.acceleration[0] == 0.0
    assert abs(part.acceleration[-1]) < 1e-15
    np.testing.assert_array_equal(part.acceleration[50:951], record(pulse(TIME)).acceleration[550:1451])
    assert "cut to 5 s to 15 s" in part.source and "tapered over 0.5 s" in part.source
    assert trim(record(pulse(TIME)), -3.0, 99.0).acceleration.size == TIME.size


def test_the_significant_part_keeps_its_share_of_the_arias_intensity() -> None:
    whole = record(pulse(TIME, centre=8.0))
    part = trim_to_significant(whole, (0.05, 0.95), lead=1.0, tail=1.0, taper_length=1.0)
    growth = husid(whole.acceleration, STEP)
    start, end = np.searchsorted(growth, 0.05) * STEP - 1.0, np.searchsorted(growth, 0.95) * STEP + 1.0
    assert part.duration == pytest.approx(end - start, abs=2.1 * STEP)
    kept = np.sum(part.acceleration**2) / np.sum(whole.acceleration**2)
    assert 0.90 <= kept < 1.0
    # a Gaussian envelope squared holds 90 % within 1.645 of its standard deviations, width / sqrt(2)
    assert part.duration - 2.0 == pytest.approx(2 * 1.645 * 1.5 / np.sqrt(2.0), abs=0.1)


def test_pads() -> None:
    longer = pad(record(np.ones(3)), 0.015, 0.03)
    np.testing.assert_array_equal(longer.acceleration, [0, 0, 1, 1, 1, 0, 0, 0])
    assert "0.02 s in front, 0.03 s behind" in longer.source
    whole = record(np.ones(3))
    assert pad(whole) is whole


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda r: taper(r, -1.0, 0.0), "E-MOTION-02"),
        (lambda r: taper(r, 15.0, 6.0), "E-MOTION-02"),
        (lambda r: trim(r, 10.0, 5.0), "E-MOTION-02"),
        (lambda r: trim(r, 30.0, 50.0), "E-MOTION-02"),
        (lambda r: trim(r, np.nan, 50.0), "E-MOTION-02"),
        (lambda r: trim(r, 5.0, 5.5, 0.5), "E-MOTION-02"),
        (lambda r: trim_to_significant(r, (0.9, 0.1)), "E-VALUE-04"),
        (lambda r: trim_to_significant(r, (0.1, 1.1)), "E-VALUE-04"),
        (lambda r: trim_to_significant(r, lead=-1.0), "E-VALUE-02"),
        (lambda r: trim_to_significant(record(np.zeros(9))), "E-REC-23"),
        (lambda r: pad(r, -1.0), "E-VALUE-02"),
        (lambda r: pad(r, 0.0, np.inf), "E-VALUE-02"),
    ],
)
def test_impossible_lengths(change: Callable[[Record], Record], code: str) -> None:
    with pytest.raises(InputError, match=code):
        change(record(pulse(TIME)))


# ---- filter ----


@pytest.mark.parametrize(("low", "high"), [(0.5, None), (None, 4.0), (0.5, 4.0), (0.1, 25.0)])
@pytest.mark.parametrize("order", [2, 4])
@pytest.mark.parametrize("frequency", [0.5, 1.0, 4.0])
def test_gain_and_phase_of_a_long_wave(low: float | None, high: float | None, order: int, frequency: float) -> None:
    """In the middle of 200 s of a sine: gain 1 / (1 + (f_low/f)^2n) times 1 / (1 + (f/f_high)^2n), no phase.

    Both at the frequencies tan(pi f dt) that the bilinear transform puts for f. Two passes square the amplitude of one.
    """
    time = np.arange(20001) * STEP
    filtered = band_pass(record(np.sin(2.0 * np.pi * frequency * time)), low, high, order)
    front = (filtered.acceleration.size - time.size) // 2
    middle = slice(8000, 12000)
    warp = lambda f: np.tan(np.pi * f * STEP)  # noqa: E731
    gain = 1.0
    if low is not None:
        gain /= 1.0 + (warp(low) / warp(frequency)) ** (2 * order)
    if high is not None:
        gain /= 1.0 + (warp(frequency) / warp(high)) ** (2 * order)
    expected = gain * np.sin(2.0 * np.pi * frequency * time[middle])
    # what starts at the ends of the sine has decayed 80 s later: exp(-2 pi 0.1 Hz 0.38 80 s) for the lowest corner
    np.testing.assert_allclose(filtered.acceleration[front:][middle], expected, atol=1e-6)


def test_kept_pads_hold_the_drift() -> None:
    """A low-cut filter has no gain at 0 Hz: velocity and displacement end at rest, if the pads stay (Boore 2005)."""
    raw = record(taper(record(pulse(TIME, frequency=0.4, centre=4.0) + 0.02), 1.0, 1.0).acceleration)
    kept, stripped = (band_pass(raw, 0.2, None, keep_pads=keep) for keep in (True, False))
    np.testing.assert_array_equal(stripped.acceleration, kept.acceleration[3000:-3000])  # 1.5 * 4 / 0.2 Hz = 30 s
    assert stripped.acceleration.size == raw.acceleration.size and "zero pads removed" in stripped.source
    ends = [np.abs(displacement(r.acceleration, STEP))[-1] for r in (kept, stripped)]
    assert ends[0] < 1e-3 * ends[1]
    peak = np.max(np.abs(velocity(kept.acceleration, STEP)))
    assert abs(velocity(kept.acceleration, STEP)[-1]) < 1e-4 * peak


@pytest.mark.parametrize(
    ("arguments", "code"),
    [
        ((None, None), "E-MOTION-01"),
        ((0.0, None), "E-MOTION-01"),
        ((None, 50.0), "E-MOTION-01"),
        ((5.0, 1.0), "E-MOTION-01"),
        ((1.0, 5.0, 0), "E-VALUE-02"),
        ((np.nan, 5.0), "E-MOTION-01"),
    ],
)
def test_impossible_filters(arguments: tuple, code: str) -> None:
    with pytest.raises(InputError, match=code):
        band_pass(record(pulse(TIME)), *arguments)


# ---- all ----


def test_what_was_done_is_reported_and_the_checksum_stays() -> None:
    raw = record(pulse(TIME) + 0.01)
    done = band_pass(remove_drift(trim_to_significant(correct_baseline(raw, 0))), 0.1, 20.0)
    assert done.checksum == raw.checksum
    for said in ("fitted to the velocity", "cut to", "tapered", "removed", "Butterworth", "0.1 Hz to 20 Hz"):
        assert said in done.source
