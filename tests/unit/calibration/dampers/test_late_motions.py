"""A motion that is late: its force, its onset between samples, and how late it may be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from damper_problems import LAW_VALUES, RATE, problem
from scipy.interpolate import CubicHermiteSpline

from edesign.calibration.dampers.effects.lag import later
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS

W = 2.0 * np.pi
FULL_SPEED = 0.01 * W  # m/s, with which a sine of 10 mm and 1 Hz sets out


def sine(rate: float, duration: float = 5.0, frequency: float = 1.0) -> Motion:
    t = 0.37 + np.arange(round(duration * rate) + 1) / rate
    w = W * frequency
    angle = w * (t - t[0])
    return Motion(t, 0.01 * np.sin(angle), 0.01 * w * np.cos(angle), -0.01 * w**2 * np.sin(angle))


def one_test(motion: Motion, force: np.ndarray, law: str = "mgmm", validates: bool = False) -> DamperProblem:
    test = Experiment("test 1", "validate" if validates else "fit", 0, 0.0, motion, force, 20.0, channel_noise=10.0)
    chosen = LAWS[law]
    return DamperProblem(chosen, chosen.complete(LAW_VALUES[law]), (test,), Sizes.of([test]), threads=1)


@pytest.mark.parametrize("late", [0.0063, 0.04, 0.04 - 1e-6, 0.0799])
def test_a_late_motion_makes_a_late_force(late: float) -> None:
    """A law does not know the time: its force is that of the motion itself, so much later, and none before. The sine
    sets out at full speed between samples 40 ms apart, at one of them, and just beside them.
    """
    fine = sine(2000.0)
    force = Damper(LAWS["mgmm"], LAW_VALUES["mgmm"]).force(fine.time, fine.displacement, fine.velocity)
    tests = one_test(fine.thinned(80), force[::80])
    (delay,) = (one for one in tests.effects if one.label == "lag.delay")
    (found,) = tests.model((delay,)).forces(np.array([[*(one.centre for one in tests.base), late]]))
    exact = np.interp(fine.time[::80] - late, fine.time, force, left=0.0)
    # motion to 6e-6 of it at 25 samples a cycle, and cusps of the force between samples
    np.testing.assert_allclose(found[0], exact, atol=2e-3 * np.max(np.abs(exact)))


def test_a_motion_sets_out_from_rest_without_swinging() -> None:
    """Between the samples around an onset the velocity of the cubic rises from 0 to its own and not beyond."""
    late = later(sine(25.0), 0.0063, from_rest=True)
    assert late.onset is not None and late.with_onset is not None
    assert late.onset == pytest.approx((late.time[0] + 0.0063, FULL_SPEED))
    whole, own = late.with_onset
    np.testing.assert_array_equal(whole.time[own], late.time)
    between = CubicHermiteSpline(whole.time, whole.displacement, whole.velocity)(
        np.linspace(whole.time[0], whole.time[4], 10_001), 1
    )
    assert np.min(between) >= 0.0 and np.max(between) <= FULL_SPEED * (1.0 + 1e-6)  # cubics of a sine
    assert late.scaled(0.5).onset == (late.onset[0], 0.5 * late.onset[1])


@pytest.mark.parametrize(("frequency", "longest"), [(5.0, 0.03), (20.0, 0.0125), (0.5, 0.1)])
def test_a_rig_may_be_late_by_30_ms_however_fast_its_tests_are(frequency: float, longest: float) -> None:
    """Bonnet et al., in thesis 6.2.1; no more than a quarter of the slowest period, and slow loggers a twentieth."""
    motion = sine(50.0 * frequency, 10.0 / frequency, frequency)
    tests = one_test(motion, 1e7 * motion.displacement, "kelvin_voigt")
    lags = [one for one in tests.effects if one.label in ("lag.delay", "lag.growing")]
    assert lags and all(one.parameters[0].upper == pytest.approx(longest, rel=0.02) for one in lags)


def test_one_test_may_be_late_by_a_quarter_of_the_slowest_period() -> None:
    """A fault is no error of a class: beyond a quarter of a period the force goes against the motion."""
    tests = problem("kelvin_voigt", tests=4)
    lags = [one.parameters[0] for one in tests.effects if one.label.startswith("lag.delay_of_test_")]
    assert len(lags) == 3  # those that are fitted to
    assert all(one.upper == -one.lower == pytest.approx(0.25 * tests.typical.lag_period) for one in lags)


@pytest.mark.parametrize("samples", [2, 3, 9, 12])
def test_a_test_of_a_few_samples_is_predicted_behind_a_rig(samples: int) -> None:
    t = np.arange(samples) / RATE
    motion = Motion(t, 0.1 * t, np.full(samples, 0.1), np.zeros(samples))
    tests = problem("kelvin_voigt", values={"c": 1e-3})
    short = replace(tests.experiments[0], motion=motion, force=np.zeros(samples))
    tests = tests.with_experiments([short, *tests.experiments[1:]])
    (linear,) = (one for one in tests.effects if one.label == "series_flexibility.linear")
    (found,) = tests.model((linear,)).forces(np.array([[*(one.centre for one in tests.base), 12e6]]))
    # 4 kN/mm of the damper behind 12 kN/mm of the rig
    np.testing.assert_allclose(found[0], 3e6 * motion.displacement, atol=1.0)
