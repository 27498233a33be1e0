"""Noise of tests that show none of it, and of motions that reach over all of the band. Own signals, closed forms."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import C, K, campaign, motion

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.noise_of_tests import smoothed_motion, with_channel_noise


@pytest.mark.parametrize("hidden", [0, 1], ids=["of a large force", "of a small force"])
@pytest.mark.parametrize("proportional", [False, True])
def test_noise_of_a_test_that_shows_none_is_that_of_the_others(tmp_path: Path, hidden: int, proportional: bool) -> None:
    problem = damper_problem(campaign(tmp_path, tests=8), threads=1)
    tests = [one.full or one for one in problem.experiments]
    lawful = [K * u + C * v for _, u, v, _ in (motion(order) for order in range(8))]
    sizes = [float(np.sqrt(np.mean(one**2))) for one in lawful]
    at = int(np.argmin(sizes) if hidden else np.argmax(sizes))
    random = np.random.default_rng(5)
    noise = [0.01 * size if proportional else 100.0 for size in sizes]
    made = [
        replace(one, force=force + (0.0 if i == at else own) * random.standard_normal(force.size))
        for i, (one, force, own) in enumerate(zip(tests, lawful, noise, strict=True))
    ]
    found = with_channel_noise(made, lawful)
    assert [one.channel_noise for one in found] == pytest.approx(noise, rel=0.25)


def test_noise_of_a_motion_is_not_measured_in_twice_of_it() -> None:
    t, random = np.arange(0.0, 6.0, 1.0 / 400.0), np.random.default_rng(4)
    f = np.arange(0.3, 195.0, 0.31)
    amplitudes = random.uniform(0.5, 1.5, f.size) / (1.0 + (f / 3.0) ** 2.7)  # over the noise up to 150 Hz
    u = (1.0 - np.exp(-3.0 * t)) * (np.sin(2.0 * np.pi * np.outer(t, f) + 6.0 * random.random(f.size)) @ amplitudes)
    u, noise = 5e-3 * u / np.max(np.abs(u)), 4e-7
    known = smoothed_motion(t, u + noise * random.standard_normal(t.size), K * u)[0]
    again, told = smoothed_motion(t, known.displacement + noise * random.standard_normal(t.size), K * u, (known, noise))
    assert told == noise and (again.degree, again.cornered) == (known.degree, known.cornered)
    assert np.std(again.displacement - known.displacement) < 2.0 * noise
