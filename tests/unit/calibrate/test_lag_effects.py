"""Delays, actuators and filters against sines, transfer functions and convolutions."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.signal import lsim
from unit.calibrate.sine_trials import W, sine_sizes, sine_trial

from edesign.calibrate.dampers.effects import lag
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.start import Start


def test_a_delay_is_that_of_a_sine() -> None:
    # not-a-knot cubics of 60 samples in a cycle: (w h)^4 / 384 = 3e-7 inside, ten times that at the ends
    trial = sine_trial(60.0, 5.0)
    late = lag.Delay().actuator({"lag": 0.0123}, trial, trial.motion)
    time = trial.motion.time - trial.motion.time[0]
    np.testing.assert_allclose(late.displacement[1:], 0.01 * np.sin(W * (time[1:] - 0.0123)), atol=0.01 * 5e-6)
    np.testing.assert_allclose(late.velocity[1:], 0.01 * W * np.cos(W * (time[1:] - 0.0123)), atol=0.01 * W * 5e-6)
    assert late.displacement[0] == 0.0 == late.velocity[0]  # at rest, before the record
    moving = replace(trial, start=Start(0.0, 0.01 * W, 0.1, True))
    gone_on = lag.Delay().actuator({"lag": 0.0123}, moving, trial.motion)
    assert gone_on.displacement[0] == pytest.approx(-0.0123 * trial.motion.velocity[0])  # as it began


@pytest.mark.parametrize("from_rest", [True, False])
def test_an_actuator_makes_the_motion_of_its_transfer_function(from_rest: bool) -> None:
    """x'' + 2 zeta w x' + w2 x = w2 u(t - tau), from rest or long after the beginning, at 60 samples in a cycle."""
    trial, p = sine_trial(60.0, 5.0), {"lag": 0.0102, "f": 21.4, "zeta": 0.4}
    time, w = trial.motion.time - trial.motion.time[0], W * p["f"]
    delay = p["lag"] - p["zeta"] / (np.pi * p["f"])
    response = np.exp(-1j * W * delay) / (1.0 + 2j * p["zeta"] * W / w - (W / w) ** 2)
    exact = [0.01 * np.imag((1j * W) ** order * response * np.exp(1j * W * time)) for order in (0, 1)]
    if not from_rest:
        trial = replace(trial, start=Start(0.0, 0.01 * W, 0.1, True))
    made = lag.Actuator().actuator(p, trial, trial.motion)
    settled = time > 0.5
    np.testing.assert_allclose(made.displacement[settled], exact[0][settled], atol=0.01 * 2e-5)
    np.testing.assert_allclose(made.velocity[settled], exact[1][settled], atol=0.01 * W * 2e-5)
    if from_rest:
        fine = np.linspace(0.0, 0.5, 50_001)
        sine = np.where(fine > delay, 0.01 * np.sin(W * (fine - delay)), 0.0)
        _, begun, _ = lsim(([w**2], [1.0, 2.0 * p["zeta"] * w, w**2]), sine, fine)
        # between its samples a swing of 21 Hz from rest is a cubic
        np.testing.assert_allclose(made.displacement[:30], np.interp(time[:30], fine, begun), atol=0.01 * 5e-3)


def test_a_stiff_actuator_is_a_plain_delay() -> None:
    trial = sine_trial(60.0, 5.0)
    stiff = lag.Actuator().actuator({"lag": 0.0102, "f": 200.0, "zeta": 0.7}, trial, trial.motion)
    plain = lag.Delay().actuator({"lag": 0.0102}, trial, trial.motion)
    np.testing.assert_allclose(stiff.displacement[2:], plain.displacement[2:], atol=0.01 * 1e-3)  # begun from rest


def test_an_actuator_is_asked_for_where_a_delay_was_found() -> None:
    """No candidate of a search by itself; as simple as a delay where it is stiff."""
    assert lag.Actuator not in lag.FORMS
    for found in (lag.Delay(), lag.SecondOrder()):  # which take an actuator for their own
        assert lag.Actuator in [type(form) for form in found.finer()]
    unknowns = lag.Actuator().unknowns(sine_sizes())
    for start in lag.Actuator().starts(sine_sizes()):
        assert all(u.lower < value < u.upper for u, value in zip(unknowns, start, strict=True))
    ((simpler, values),) = lag.Actuator().simpler({"lag": 0.01, "f": 150.0, "zeta": 0.5})
    assert type(simpler) is lag.Delay and values["lag"] == 0.01


@pytest.mark.parametrize("late", [0.0063, 0.04, 0.04 - 1e-6, 0.0799])
def test_a_late_motion_makes_a_late_force(late: float) -> None:
    """A law does not know the time: its force is that of the motion itself, so much later, and none before. The sine
    sets out at full speed between samples 40 ms apart, at one of them, and just beside them.
    """
    # at the rate of a fit the force of the MGMM has cusps between samples; that of a late motion is exact
    mgmm = law("mgmm")
    values = read_parameters(mgmm, "thesis_table_4_2")
    sizes = 4
    fine = sine_trial(2000.0, 5.0)
    force = Damper(mgmm, values).force(fine.motion.time, fine.motion.displacement, fine.motion.velocity)
    coarse = replace(fine, motion=fine.motion.thinned(80), force=force[::80], temperature=fine.temperature[::80])
    problem = DamperProblem(mgmm, values, (coarse,), Sizes.of([coarse] * sizes))
    candidate = candidate_of(lag.Delay(), problem.sizes, Left())
    assert candidate is not None
    (found,) = problem.predict(problem.declared, [(candidate, np.array([late]))], ("fit",))
    exact = np.interp(coarse.motion.time - late, fine.motion.time, force, left=0.0)
    assert found is not None
    # motion to 6e-6 of it at 25 samples a cycle, and cusps
    np.testing.assert_allclose(found, exact, atol=2e-3 * np.max(np.abs(exact)))


def test_a_rig_may_be_late_by_30_ms_however_fast_its_tests_are() -> None:
    """Bonnet et al., in thesis 6.2.1; no more than a quarter of the slowest period, and slow loggers a twentieth."""
    for frequency, longest in ((5.0, 0.03), (20.0, 0.0125), (0.5, 0.1)):
        sizes = Sizes.of([sine_trial(50.0 * frequency, 10.0 / frequency, frequency)])
        for form in (lag.Delay(), lag.Growing(), lag.Actuator()):
            assert form.unknowns(sizes)[0].upper == pytest.approx(longest, rel=0.02)


def test_a_motion_sets_out_from_rest_without_swinging() -> None:
    """Between the samples around an onset the velocity of the cubic rises from 0 to its own and not beyond."""
    late = lag.Delay().actuator({"lag": 0.0063}, sine_trial(25.0, 5.0), sine_trial(25.0, 5.0).motion)
    assert late.onset is not None and late.with_onset is not None
    assert late.onset == pytest.approx((late.time[0] + 0.0063, 0.01 * W))
    whole, own = late.with_onset
    np.testing.assert_array_equal(whole.time[own], late.time)
    between = CubicHermiteSpline(whole.time, whole.displacement, whole.velocity)(
        np.linspace(whole.time[0], whole.time[4], 10_001), 1
    )
    assert np.min(between) >= 0.0 and np.max(between) <= 0.01 * W * (1.0 + 1e-6)  # cubics of a sine
    smaller = late.times(0.5)
    assert smaller.onset == (late.onset[0], 0.5 * late.onset[1])
    assert smaller.moved(0.4 * late.displacement).onset is None  # what gives way takes the jump


def test_a_delay_that_grows_is_later_in_later_tests_and_seconds() -> None:
    values = {"lag": 0.004, "grown": 0.006, "skew": 2e-4, "N": 9.0}
    for order in (0, 3):
        trial = replace(sine_trial(60.0, 5.0), order=order)
        late = 1e7 * lag.Growing().actuator(values, trial, trial.motion).displacement
        time = trial.motion.time - trial.motion.time[0]
        exact = 1e5 * np.sin(W * (time * (1.0 - 2e-4) - 0.004 - 0.006 * order / 9.0))
        np.testing.assert_allclose(late[1:], exact[1:], atol=1e5 * 5e-6)  # as of a plain delay


def test_a_delay_grows_with_an_amplitude_that_fades() -> None:
    """Of a swelling sine by each sample; of one that is over by what is left of its largest size."""
    trial, p = sine_trial(60.0, 8.0), {"lag": 0.004, "per_amplitude": 0.6, "memory": 2.0}
    time = trial.motion.time - trial.motion.time[0]
    swell = np.minimum(time / 4.0, 1.0)

    def sine(at: np.ndarray) -> np.ndarray:
        return np.where((at > 0.0) & (at < 6.0), 0.01 * np.clip(at / 4.0, 0.0, 1.0) * np.sin(W * at), 0.0)

    u = sine(time)
    inside = (time > 0.0) & (time < 6.0)
    v = np.where(inside, 0.01 * (W * swell * np.cos(W * time) + 0.25 * (time < 4.0) * np.sin(W * time)), 0.0)
    motion = Motion(trial.motion.time, u, v, np.gradient(v, time))
    made = lag.WithAmplitude().actuator(p, trial, motion)
    amplitude = np.zeros_like(u)
    for i in range(1, u.size):
        amplitude[i] = max(abs(u[i]), amplitude[i - 1] * np.exp(-(time[i] - time[i - 1]) / 2.0))
    late = 0.004 + 0.6 * amplitude
    smooth = (time > 0.5) & (np.abs(time - 4.0) > 0.1) & (np.abs(time - 6.0) > 0.1)
    # cubics of 60 samples in a cycle, 3e-7 inside, of a sine that has corners where it begins, is full and ends
    np.testing.assert_allclose(made.displacement[smooth], sine(time - late)[smooth], atol=0.01 * 2e-4)
    # where the amplitude rises, or fades, on both sides the velocity is the derivative of the displacement
    slopes, rises = np.gradient(made.displacement, time), amplitude == np.abs(u)
    steady = smooth & (rises == np.roll(rises, 1)) & (rises == np.roll(rises, -1))
    assert np.count_nonzero(steady) > 50
    np.testing.assert_allclose(made.velocity[steady], slopes[steady], atol=0.01 * W * 4e-3)  # (w h)^2 / 6 = 2e-3


def test_a_delay_that_does_not_grow_with_the_amplitude_is_plain() -> None:
    trial = sine_trial(60.0, 5.0)
    same = lag.WithAmplitude().actuator({"lag": 0.0123, "per_amplitude": 0.0, "memory": 1.0}, trial, trial.motion)
    plain = lag.Delay().actuator({"lag": 0.0123}, trial, trial.motion)
    np.testing.assert_array_equal(same.displacement, plain.displacement)
    np.testing.assert_array_equal(same.velocity, plain.velocity)
    grown = {"lag": 0.0123, "grown": 0.004, "skew": 1e-4, "N": 9.0, "per_amplitude": 0.0, "memory": 1.0}
    both = lag.GrowingWithAmplitude().actuator(grown, trial, trial.motion)
    np.testing.assert_array_equal(both.velocity, lag.Growing().actuator(grown, trial, trial.motion).velocity)
    larger = {**grown, "grown": 0.0, "skew": 0.0, "per_amplitude": 0.5}
    both = lag.GrowingWithAmplitude().actuator(larger, trial, trial.motion)
    np.testing.assert_array_equal(both.velocity, lag.WithAmplitude().actuator(larger, trial, trial.motion).velocity)
    ((simpler, values),) = lag.WithAmplitude().simpler({"lag": 0.01, "per_amplitude": 0.0, "memory": 1.0})
    assert isinstance(simpler, lag.Delay) and values["lag"] == 0.01


def test_a_filter_has_the_gain_and_phase_of_first_order() -> None:
    # H = 1 / (1 + i w tau) once the start has died out; linear between 100 samples in a cycle: (w h)^2 / 12 = 3e-4
    trial, tau = sine_trial(100.0, 10.0), 0.03
    found = lag.Filter().channel({"time_constant": tau}, trial, trial.force)
    time = trial.motion.time - trial.motion.time[0]
    response = 1.0 / (1.0 + 1j * W * tau)
    exact = 1e5 * np.imag(response * np.exp(1j * W * time))
    settled = time > 20.0 * tau
    np.testing.assert_allclose(found[settled], exact[settled], atol=1e5 * 4e-4)


def test_what_a_filtered_displacement_shows_is_undone() -> None:
    # sin(w t) is shown as Im(e^{i w t} / (1 + i w tau)); differences of the third derivative: (w h)^2 / 6 = 7e-4
    tau, u0 = 0.03, 0.01
    trial = sine_trial(100.0, 10.0)
    time = trial.motion.time - trial.motion.time[0]
    true = [u0 * np.imag((1j * W) ** order * np.exp(1j * W * time)) for order in range(3)]
    shown = [u0 * np.imag((1j * W) ** order * np.exp(1j * W * time) / (1.0 + 1j * W * tau)) for order in range(3)]
    form = lag.DisplacementFilter()
    found = form.actuator({"time_constant": tau}, trial, Motion(trial.motion.time, *shown))
    np.testing.assert_allclose(found.displacement, true[0], atol=1e-12 * u0)
    np.testing.assert_allclose(found.velocity, true[1], atol=1e-12 * u0 * W)
    np.testing.assert_allclose(found.acceleration[1:-1], true[2][1:-1], atol=2e-4 * u0 * W**2)
    np.testing.assert_array_equal(form.channel({"time_constant": tau}, trial, trial.force), trial.force)


@pytest.mark.parametrize(("f", "zeta"), [(8.0, 0.87), (20.0, 0.71)])
def test_a_filter_of_second_order_turns_a_sine_by_its_transfer_function(f: float, zeta: float) -> None:
    trial = sine_trial(200.0, 20.0, frequency=2.0)
    t = trial.motion.time - trial.motion.time[0]
    found = lag.SecondOrder().channel({"f": f, "zeta": zeta}, trial, np.sin(W * 2.0 * t))
    h = 1.0 / (1.0 - (2.0 / f) ** 2 + 2.0j * zeta * 2.0 / f)  # Chopra, Eq. 3.2.10
    late = t > 3.0
    # linear over quarters of the 100 samples of a cycle between a cubic: (w h / 4)^2 / 12 = 2e-5
    np.testing.assert_allclose(found[late][:-5], (h * np.exp(1j * W * 2.0 * t)).imag[late][:-5], atol=1e-4)
    steady = lag.SecondOrder().channel({"f": f, "zeta": zeta}, trial, np.full(t.size, 7.0))
    np.testing.assert_allclose(steady, 7.0, rtol=1e-12)
