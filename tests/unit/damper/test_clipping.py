"""Forces at the end of a load cell's range are distinguished from peaks, converter steps, and devices that yield."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.damper.testing.clipping import clipped, clipping_notes, clipping_warning
from edesign.damper.testing.measured_histories import DamperTest
from edesign.report.check.damper_files import force_warnings

T = np.arange(0.0, 8.0, 1.0 / 200.0)
SINE = 40e3 * np.sin(2.0 * np.pi * 0.8 * T)  # N
NOISE = 50.0 * np.random.default_rng(3).standard_normal(T.size)


def in_steps(force: np.ndarray, step: float) -> np.ndarray:
    return step * np.round(force / step)


@pytest.mark.parametrize(("low", "high"), [(-30e3, 30e3), (-1e6, 25e3), (-39e3, 1e6), (-3e3, 3e3)])
def test_samples_beyond_the_range_are_clipped(low: float, high: float) -> None:
    true = SINE + NOISE
    found = clipped(np.clip(true, low, high))
    # a true value that is the end of the range to the last digit has no chance
    assert np.array_equal(found, (true > high) | (true < low))


def test_a_range_of_a_converter_is_reported_in_its_steps() -> None:
    true = in_steps(SINE + 0.2 * NOISE, 20.0)  # 12 bit, with half a step of noise
    found = clipped(np.clip(true, -30e3, 30e3))
    assert np.array_equal(found, np.abs(true) >= 30e3)


@pytest.mark.parametrize(
    "force",
    [
        SINE + NOISE,
        SINE,
        in_steps(SINE, 20.0),  # several samples of a peak are one step
        in_steps(SINE + NOISE, 400.0),
        np.clip(2.0 * SINE, -20e3, 20e3),  # an ideal plastic device, computed
        np.round(np.clip(2.0 * SINE, -20e3, 20e3), 1),  # and printed to six digits
        np.clip(2.0 * SINE, -20e3, 20e3) + NOISE,  # and measured
        np.where(T < 2.0, 0.0, SINE + NOISE),
        np.zeros_like(T),
    ],
    ids=["noise", "sine", "steps", "coarse", "plastic", "printed", "yields", "rest", "nothing"],
)
def test_other_forces_are_not(force: np.ndarray) -> None:
    assert not clipped(force).any()


def test_test_and_channel_are_named() -> None:
    force = np.clip(SINE + NOISE, -1e6, 30e3)
    tests = [DamperTest("a", T, 1e-6 * SINE, SINE + NOISE), DamperTest("b", T, 1e-6 * SINE, force)]
    (note,) = clipping_notes(tests)
    number = int(np.sum(SINE + NOISE > 30e3))
    first = T[np.argmax(SINE + NOISE > 30e3)]
    assert note.startswith(f"b: force: {number} samples stand at 30 kN exactly, the first at {first:.6g} s: ")
    assert clipping_warning(tests[1]) in force_warnings(tests[1]) and not clipping_warning(tests[0])
