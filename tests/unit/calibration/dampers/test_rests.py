"""Rests of a motion that has noise: own signals, of which it is known when they stand still."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibration.dampers.noise_of_tests import smoothed_motion
from edesign.calibration.dampers.rests import at_rest
from edesign.calibration.signals.noise import smooth

RATE, PERIOD, AMPLITUDE = 400.0, 1.0, 0.010  # Hz, s, m
REST = 0.6  # s


def _moved(t: np.ndarray, first: float, last: float) -> tuple[np.ndarray, np.ndarray]:
    """Cycles (1 - cos) between two times, and their velocity: without corners where they begin and end."""
    on, omega = (t > first) & (t < last), 2.0 * np.pi / PERIOD
    phase = omega * (t - first)
    return 0.5 * AMPLITUDE * on * (1.0 - np.cos(phase)), 0.5 * AMPLITUDE * omega * on * np.sin(phase)


@pytest.mark.parametrize("noise", [1e-7, 1e-6, 5e-6])
def test_a_motion_stands_still_in_its_rests(noise: float) -> None:
    t = np.arange(0.0, 9.0, 1.0 / RATE)
    every = [_moved(t, REST, REST + 3.0), _moved(t, 2.0 * REST + 3.0, 2.0 * REST + 7.0)]
    u, v = (sum(parts) for parts in zip(*every, strict=True))
    measured = u + noise * np.random.default_rng(3).standard_normal(t.size)
    found, told = smoothed_motion(t, measured, 1e6 * u)
    still, rests = v == 0.0, at_rest(found)
    assert told == pytest.approx(noise, rel=0.2)
    assert np.mean(rests[still]) > 0.9  # but where the cycles begin and end gently
    assert np.max(np.abs(v[rests])) < 0.05 * np.max(np.abs(v))
    assert np.max(np.abs(found.displacement - u)[rests]) < noise
    # a damper of the power 0.3 of the velocity: most of what noise makes of its force in rests is gone
    smoothed = smooth(t, measured, beside=(1e6 * u,))[1]
    of, before, true = (np.sign(one) * np.abs(one) ** 0.3 for one in (found.velocity, smoothed, v))
    assert np.mean((of - true)[still] ** 2) < 0.4 * np.mean((before - true)[still] ** 2)


@pytest.mark.parametrize("amplitude", [0.02, 0.1, 1.0])
@pytest.mark.parametrize("noise", [1e-6, 1e-5])
def test_a_motion_that_turns_gently_does_not_rest(amplitude: float, noise: float) -> None:
    t = np.arange(0.0, 20.0, 1.0 / RATE)
    u = AMPLITUDE * np.where(t < 10.0, 1.0, amplitude) * np.sin(2.0 * np.pi * t / PERIOD)
    found, _ = smoothed_motion(t, u + noise * np.random.default_rng(4).standard_normal(t.size), 1e6 * u)
    assert not np.any(at_rest(found))


def test_a_motion_that_creeps_does_not_rest() -> None:
    t, noise = np.arange(0.0, 12.0, 1.0 / RATE), 2e-6
    u = np.where(t < 5.0, _moved(t, 0.0, 5.0)[0], 0.0) + 1e-5 * (t - 5.0) * (t > 5.0)
    found, _ = smoothed_motion(t, u + noise * np.random.default_rng(5).standard_normal(t.size), 1e6 * u)
    late = t > 5.5
    assert np.mean(at_rest(found)[late]) < 0.1
    assert np.mean(found.velocity[late]) == pytest.approx(1e-5, rel=0.1)
