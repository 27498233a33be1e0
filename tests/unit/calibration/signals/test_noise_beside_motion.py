"""What is all noise counts as noise in a force, and as motion in a displacement."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibration.signals.noise import smooth, white_noise
from edesign.core.damper import CoreDamper

RATE, SAMPLES = 250.0, 2000  # Hz, and samples
TIME = np.arange(SAMPLES) / RATE


@pytest.mark.parametrize("seed", range(8))
def test_what_a_law_that_is_right_leaves_of_a_force_is_noise(seed: int) -> None:
    left = 60.0 * np.random.default_rng(seed).standard_normal(SAMPLES)
    # estimated from a spectrum of some thirty segments: by chance above or below the deviation of the samples
    assert white_noise(left, TIME) == pytest.approx(60.0, rel=0.15)


@pytest.mark.parametrize("seed", range(4))
def test_noise_of_a_rest_does_not_make_a_law_creep(seed: int) -> None:
    """A specimen is pulled in a tenth of a second and held. Noise makes it unload steeper than it loads.

    The path of noise is 2 / sqrt(pi) = 1.1 deviations a sample. Beside the corners, which no frequency separates from
    noise, deviations of it are left: 2 % of the elastic displacement at the force that is held.
    """
    noise, held = 6e-6, 10e-3
    motion = held * np.clip((TIME - 1.0) / 0.1, 0.0, 1.0)
    found, _, _, _ = smooth(TIME, motion + noise * np.random.default_rng(seed).standard_normal(SAMPLES))
    rest = TIME > 2.0
    assert np.sum(np.abs(np.diff(found[rest]))) < 0.02 * 1.1 * noise * np.count_nonzero(rest)
    values = {"Fy": 2e5, "Y": 2e-3, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.1}
    specimen = CoreDamper("bouc_wen", tuple(values.values()))
    force, true = (specimen.force(TIME, u, np.gradient(u, TIME)) for u in (found, motion))
    assert np.max(np.abs(force - true)[rest]) < 0.03 * np.max(true)


@pytest.mark.parametrize("seed", range(3))
def test_a_motion_up_to_the_highest_frequency_is_left_as_it_is(seed: int) -> None:
    random = np.random.default_rng(seed)
    frequencies = np.linspace(0.05, 0.49, 80) * RATE
    phases = random.uniform(0.0, 2.0 * np.pi, frequencies.size)
    motion = 1e-3 * np.sum(np.sin(2.0 * np.pi * np.outer(TIME, frequencies) + phases), axis=1)
    found, _, _, noise = smooth(TIME, motion)
    assert noise == 0.0 and np.array_equal(found, motion)


def test_times_that_are_not_even_keep_no_more_noise() -> None:
    """Stamps that are off by up to a fifth of a step: a velocity by differences has 500 Hz * 5 um, or 2.5 mm/s, of it.

    What is kept follows from the band: 1.0 Hz of 250 Hz, differentiated, is (1/250)^1.5 of it, or 2.5e-4. Few lines of
    the spectrum above it stand out by chance; at even times they leave 0.012 of the noise.
    """
    random = np.random.default_rng(0)
    w, size = 2.0 * np.pi, 5e-3
    t = (np.arange(5000) + 0.2 * random.uniform(-1.0, 1.0, 5000)) / 500.0
    noise = 5e-6 * random.standard_normal(t.size)
    velocity = smooth(t, size * np.sin(w * t) + noise)[1]
    left = (velocity - size * w * np.cos(w * t))[20:-20]
    plain = np.gradient(noise, t)[20:-20]
    assert np.std(left) < 0.06 * np.std(plain)


def test_a_corner_that_an_even_grid_does_not_resolve_stays() -> None:
    """A ramp that ends between two samples 0.2 ms apart, in a record that has 20 ms elsewhere."""
    fine = 1.0 + 2e-4 * np.arange(-50, 51)
    t = np.concatenate((np.arange(0.0, 0.98, 0.02), fine, np.arange(1.02, 3.0, 0.02)))
    clean = 1e-3 * np.minimum(t, 1.0)
    found = smooth(t, clean + 1e-8 * np.random.default_rng(1).standard_normal(t.size))[0]
    assert np.max(np.abs(found - clean)) < 1e-7
