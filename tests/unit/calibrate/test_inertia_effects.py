"""Masses of the rig, and fixtures that carry them, against accelerations and oscillators."""

from __future__ import annotations

import numpy as np
import pytest
from unit.calibrate.sine_trials import W, sine_trial

from edesign.calibrate.dampers.effects import inertia


def test_inertia_is_mass_times_acceleration() -> None:
    trial = sine_trial(100.0, 2.0)
    force = inertia.Mass().carriage({"mass": 40.0}, trial, trial.motion, trial.force)
    np.testing.assert_allclose(force, -40.0 * W**2 * trial.motion.displacement, rtol=1e-12)


def test_more_mass_on_one_side_is_another_mass_there() -> None:
    trial = sine_trial(100.0, 2.0)
    p = {"mass": 40.0, "s": 0.25, "w": 1e-6}
    force = inertia.OneSided().carriage(p, trial, trial.motion, trial.force)
    off = np.abs(trial.motion.displacement) > 2e-5  # tanh(20) is 1
    on = np.where(trial.motion.displacement > 0.0, 50.0, 30.0)
    assert np.count_nonzero(off) > 0.9 * off.size
    np.testing.assert_allclose(force[off], (on * trial.motion.acceleration)[off], atol=1e-12)


@pytest.mark.parametrize("rate", [40.0, 100.0, 1000.0])
def test_a_mass_on_a_fixture_swings_as_an_oscillator(rate: float) -> None:
    trial = sine_trial(rate, 20.0, frequency=2.0)
    f, zeta = 15.0, 0.3
    force = inertia.Sprung().carriage({"mass": 40.0, "f": f, "zeta": zeta}, trial, trial.motion, trial.force)
    # support motion of a sine, Chopra section 3.6: the mass swings by H more than the support, later by its angle
    h = 1.0 / (1.0 - (2.0 / f) ** 2 + 2.0j * zeta * 2.0 / f)
    turned = 0.01 * np.exp(1j * W * 2.0 * (trial.motion.time - trial.motion.time[0]))
    exact = -40.0 * (W * 2.0) ** 2 * (h * turned).imag
    late = trial.motion.time > trial.motion.time[0] + 2.0  # from rest: gone after 9 periods of the fixture
    # a cubic of 20 samples in a cycle between samples, linear over quarters of these: (w h / 4)^2 / 12 = 5e-4
    np.testing.assert_allclose(force[late][:-5], exact[late][:-5], atol=6e-4 * np.max(np.abs(exact)))


def test_a_stiff_fixture_carries_the_mass_as_it_is() -> None:
    trial = sine_trial(200.0, 5.0)
    p = {"mass": 40.0, "f": 400.0, "zeta": 0.1}
    force = inertia.Sprung().carriage(p, trial, trial.motion, trial.force)
    plain = inertia.Mass().carriage({"mass": 40.0}, trial, trial.motion, trial.force)
    # 2 zeta f / f_0 = 5e-4 of a turn in phase
    np.testing.assert_allclose(force[20:-5], plain[20:-5], atol=1e-3 * np.max(np.abs(plain)))
