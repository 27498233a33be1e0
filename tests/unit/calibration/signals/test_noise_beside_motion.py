"""What is all noise counts as noise in a force, and as motion in a displacement."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibration.signals.noise import smooth, white_noise

RATE, SAMPLES = 250.0, 2000  # Hz, and samples
TIME = np.arange(SAMPLES) / RATE


@pytest.mark.parametrize("seed", range(8))
def test_what_a_law_that_is_right_leaves_of_a_force_is_noise(seed: int) -> None:
    left = 60.0 * np.random.default_rng(seed).standard_normal(SAMPLES)
    # estimated from a spectrum of some thirty segments: by chance above or below the deviation of the samples
    assert white_noise(left, TIME) == pytest.approx(60.0, rel=0.15)


@pytest.mark.parametrize("seed", range(3))
def test_a_motion_up_to_the_highest_frequency_is_left_as_it_is(seed: int) -> None:
    random = np.random.default_rng(seed)
    frequencies = np.linspace(0.05, 0.49, 80) * RATE
    phases = random.uniform(0.0, 2.0 * np.pi, frequencies.size)
    motion = 1e-3 * np.sum(np.sin(2.0 * np.pi * np.outer(TIME, frequencies) + phases), axis=1)
    found, _, _, noise = smooth(TIME, motion)
    assert noise == 0.0 and np.array_equal(found, motion)
