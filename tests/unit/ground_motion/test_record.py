"""Scaling, resampling and padding of a record, against what they mean."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa

SAMPLES = [0.0, 1.0, -4.0, 2.0, 0.5]


def record(samples: object = SAMPLES, step: float = 0.02) -> Record:
    return Record("x", np.asarray(samples, dtype=float), step, "test")


def test_scaled() -> None:
    scaled = record().scaled(0.125)
    np.testing.assert_allclose(scaled.acceleration, np.array(SAMPLES) / 8.0, rtol=1e-15)
    assert scaled.pga == pytest.approx(0.5, rel=1e-15)
    assert scaled.checksum == record().checksum  # of the samples as read
    assert "times 0.125" in scaled.source


def test_half_the_step_puts_means_between_the_samples() -> None:
    fine = record().resampled(0.01)
    np.testing.assert_array_equal(fine.acceleration, [0, 0.5, 1, -1.5, -4, -1, 2, 1.25, 0.5])
    assert fine.duration == pytest.approx(0.08) and fine.time_step == 0.01


def test_twice_the_step_keeps_every_second_sample() -> None:
    coarse = record().resampled(0.04)
    np.testing.assert_array_equal(coarse.acceleration, [0.0, -4.0, 0.5])


def test_an_odd_step_interpolates_and_drops_less_than_a_step_at_the_end() -> None:
    odd = record().resampled(0.03)
    np.testing.assert_allclose(odd.acceleration, [0.0, -1.5, 1.0 + 1.0], atol=1e-12)  # at 0, 0.03, 0.06 s
    assert odd.duration == pytest.approx(0.06)


@given(st.lists(st.floats(-10, 10), min_size=2, max_size=40), st.sampled_from([2, 3, 5, 7, 10]))
def test_a_whole_division_of_the_step_keeps_all_samples_exactly(samples: list[float], parts: int) -> None:
    fine = record(samples, 0.01).resampled(0.01 / parts)
    assert fine.acceleration.size == parts * (len(samples) - 1) + 1
    np.testing.assert_array_equal(fine.acceleration[::parts], samples)
    assert fine.pga <= max(map(abs, samples))


def test_zeros_for_free_vibration() -> None:
    longer = record().with_zeros(0.1)
    np.testing.assert_array_equal(longer.acceleration, [*SAMPLES, 0, 0, 0, 0, 0])
    assert record().with_zeros(0.03).acceleration.size == 7  # whole steps, at least as long as asked for
    assert record().with_zeros(0.0).acceleration.size == 5


def test_the_checksum_distinguishes_samples_and_step() -> None:
    assert record().checksum == record().checksum
    assert len({record().checksum, record(step=0.01).checksum, record([0.0, 1.0]).checksum}) == 3


def test_a_record_does_not_change() -> None:
    made = record()
    with pytest.raises(ValueError, match="read-only"):
        made.acceleration[0] = 1.0


@pytest.mark.parametrize(
    ("samples", "step", "code"),
    [
        ([1.0], 0.01, "E-REC-21"),
        ([], 0.01, "E-REC-21"),
        ([1.0, np.nan], 0.01, "E-REC-08"),
        ([1.0, 2.0], 0.0, "E-REC-20"),
        ([1.0, 2.0], -0.1, "E-REC-20"),
        ([1.0, 2.0], np.nan, "E-REC-20"),
    ],
)
def test_impossible_records(samples: list[float], step: float, code: str) -> None:
    with pytest.raises(InputError, match=code):
        record(samples, step)


def test_impossible_changes() -> None:
    with pytest.raises(InputError, match="E-REC-20"):
        record().resampled(0.0)
    with pytest.raises(InputError, match="E-MOTION-03"):
        record().resampled(1.0)


@pytest.mark.parametrize("time_step", [0.01, 0.005, 0.008, 0.00317])
def test_a_band_limited_record_has_the_same_spectrum_at_a_shorter_step(time_step: float) -> None:
    """A wave of 5.3 Hz within 0.07 % of its response at 0.02 s; straight lines lose 3.4 % of it."""
    t = np.arange(0.0, 20.0, 0.02)
    samples = np.sin(np.pi * t / 20.0) ** 2 * np.sin(2 * np.pi * 5.3 * t)
    coarse = Record("wave", samples, 0.02, "made", band_limited=True)
    periods = np.array([1 / 5.3, 0.5, 1.0])
    reported = psa(coarse.acceleration, 0.02, periods)
    fine = coarse.resampled(time_step)
    assert "band-limited" in fine.source and fine.band_limited
    assert psa(fine.acceleration, time_step, periods) == pytest.approx(reported, rel=7e-4)  # what spectra err by
    lines = replace(coarse, band_limited=False).resampled(0.005)
    loss = 1.0 - psa(lines.acceleration, 0.005, periods) / reported
    # 1 - sin^2 x / (16 sin^2 (x / 4)) of lines at a quarter of the step, x = pi f dt; the wave is no endless one
    x = np.pi * 5.3 * 0.02
    assert loss == pytest.approx(1.0 - np.sin(x) ** 2 / (16.0 * np.sin(x / 4.0) ** 2), rel=0.02)


def test_a_band_limited_record_keeps_its_samples_and_is_the_wave_between_them() -> None:
    t = np.arange(0.0, 20.0, 0.02)
    wave = Record("wave", np.sin(2 * np.pi * 5.0 * t), 0.02, "made", band_limited=True)
    fine = wave.resampled(0.005)
    np.testing.assert_array_equal(fine.acceleration[::4], wave.acceleration)
    inner = slice(fine.acceleration.size // 4, -fine.acceleration.size // 4)  # the ends are continued by reflection
    np.testing.assert_allclose(fine.acceleration[inner], np.sin(2 * np.pi * 5.0 * fine.time[inner]), atol=1e-3)
    np.testing.assert_array_equal(wave.resampled(0.04).acceleration, wave.acceleration[::2])
