"""Effects of the instruments against analytic signals, loops over samples and known spectra."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline
from scipy.signal import lfilter, lsim
from scipy.special import j0

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import drift, gain, hum, inertia, lag, offset
from edesign.calibrate.dampers.effects.drift import slowest_frequency
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.peaks import common_tones
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.calibrate.problem import Part, PredictionError, Use
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.start import Start

ROUNDING = 1e-9
W = 2.0 * np.pi
PARAMETRIC = [kind for module in (lag, gain, offset, drift, inertia, hum) for kind in module.FORMS]


def _trial(rate: float, duration: float, frequency: float = 1.0, order: int = 0, amplitude: float = 0.01) -> Trial:
    time = 0.37 + np.arange(int(round(duration * rate)) + 1) / rate
    angle = W * frequency * (time - time[0])
    u = amplitude * np.sin(angle)
    v = amplitude * W * frequency * np.cos(angle)
    motion = Motion(time, u, v, -((W * frequency) ** 2) * u)
    return Trial(f"test {order + 1}", "fit", order, motion, 1e7 * u, np.full(time.size, 20.0))


def _sizes(tests: int = 1) -> Sizes:
    return Sizes.of([_trial(100.0, 10.0, order=i) for i in range(tests)])


@pytest.mark.parametrize("kind", PARAMETRIC)
def test_starts_are_complete_and_inside_the_bounds(kind: type[Form]) -> None:
    form, trial = kind(), _trial(120.0, 10.0)
    left = Left([trial], [sum(np.sin(W * f * trial.motion.time) for f in (50.0, 31.0, 21.0))])
    unknowns = form.unknowns(_sizes(4))
    starts = form.starts_from_residuals(_sizes(4), left) if form.name == "hum" else form.starts(_sizes(4))
    assert starts
    for start in starts:
        assert len(start) == len(unknowns)
        for value, unknown in zip(start, unknowns, strict=True):
            assert unknown.lower < value < unknown.upper
            assert unknown.value(unknown.coordinate(value)) == pytest.approx(value, rel=1e-12)
    if kind is drift.Swinging:
        assert form.starts(_sizes(2)) == ()  # too few tests for a period in common


def test_no_amplitude_leaves_the_force_unchanged() -> None:
    trial = _trial(100.0, 5.0)
    for form, p in (
        (gain.Force(), {"g": 0.0}),
        (gain.ForceFromTest(2), {"g": 0.0, "first_test": 2.0}),
        (offset.Constant(), {"offset": 0.0}),
        (drift.PerTestLine(), {"rate": 0.0}),
    ):
        np.testing.assert_array_equal(form.channel(p, trial, trial.force), trial.force)
    # a spline at its own knots: rounding
    unmoved = lag.Delay().actuator({"lag": 0.0}, trial, trial.motion)
    np.testing.assert_allclose(unmoved.displacement, trial.motion.displacement, atol=1e-14)
    same = gain.Displacement().actuator({"g": 0.0}, trial, trial.motion)
    np.testing.assert_array_equal(same.velocity, trial.motion.velocity)
    np.testing.assert_array_equal(same.displacement, trial.motion.displacement)
    np.testing.assert_array_equal(drift.Campaign().parallel({"rate": 0.0}, trial, trial.motion, {}), 0.0)
    np.testing.assert_array_equal(inertia.Mass().carriage({"mass": 0.0}, trial, trial.motion, trial.force), 0.0)


def test_a_displacement_that_drifts_is_set_right() -> None:
    trial, rate = _trial(60.0, 5.0), 1e-4
    time = trial.motion.time - trial.motion.time[0]
    u, v = trial.motion.displacement + rate * time, trial.motion.velocity + rate
    made = drift.Displacement().actuator({"rate": rate}, trial, replace(trial.motion, displacement=u, velocity=v))
    np.testing.assert_allclose(made.displacement, trial.motion.displacement, atol=1e-16)
    np.testing.assert_allclose(made.velocity, trial.motion.velocity, atol=1e-14)


def test_a_delay_is_that_of_a_sine() -> None:
    # not-a-knot cubics of 60 samples in a cycle: (w h)^4 / 384 = 3e-7 inside, ten times that at the ends
    trial = _trial(60.0, 5.0)
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
    trial, p = _trial(60.0, 5.0), {"lag": 0.0102, "f": 21.4, "zeta": 0.4}
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
    trial = _trial(60.0, 5.0)
    stiff = lag.Actuator().actuator({"lag": 0.0102, "f": 200.0, "zeta": 0.7}, trial, trial.motion)
    plain = lag.Delay().actuator({"lag": 0.0102}, trial, trial.motion)
    np.testing.assert_allclose(stiff.displacement[2:], plain.displacement[2:], atol=0.01 * 1e-3)  # begun from rest


def test_an_actuator_is_asked_for_where_a_delay_was_found() -> None:
    """No candidate of a search by itself; as simple as a delay where it is stiff."""
    assert lag.Actuator not in lag.FORMS
    for found in (lag.Delay(), lag.SecondOrder()):  # which take an actuator for their own
        assert lag.Actuator in [type(form) for form in found.finer()]
    unknowns = lag.Actuator().unknowns(_sizes())
    for start in lag.Actuator().starts(_sizes()):
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
    fine = _trial(2000.0, 5.0)
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
        sizes = Sizes.of([_trial(50.0 * frequency, 10.0 / frequency, frequency)])
        for form in (lag.Delay(), lag.Growing(), lag.Actuator()):
            assert form.unknowns(sizes)[0].upper == pytest.approx(longest, rel=0.02)


def test_a_motion_sets_out_from_rest_without_swinging() -> None:
    """Between the samples around an onset the velocity of the cubic rises from 0 to its own and not beyond."""
    late = lag.Delay().actuator({"lag": 0.0063}, _trial(25.0, 5.0), _trial(25.0, 5.0).motion)
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
        trial = replace(_trial(60.0, 5.0), order=order)
        late = 1e7 * lag.Growing().actuator(values, trial, trial.motion).displacement
        time = trial.motion.time - trial.motion.time[0]
        exact = 1e5 * np.sin(W * (time * (1.0 - 2e-4) - 0.004 - 0.006 * order / 9.0))
        np.testing.assert_allclose(late[1:], exact[1:], atol=1e5 * 5e-6)  # as of a plain delay


def test_a_delay_grows_with_an_amplitude_that_fades() -> None:
    """Of a swelling sine by each sample; of one that is over by what is left of its largest size."""
    trial, p = _trial(60.0, 8.0), {"lag": 0.004, "per_amplitude": 0.6, "memory": 2.0}
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
    trial = _trial(60.0, 5.0)
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
    trial, tau = _trial(100.0, 10.0), 0.03
    found = lag.Filter().channel({"time_constant": tau}, trial, trial.force)
    time = trial.motion.time - trial.motion.time[0]
    response = 1.0 / (1.0 + 1j * W * tau)
    exact = 1e5 * np.imag(response * np.exp(1j * W * time))
    settled = time > 20.0 * tau
    np.testing.assert_allclose(found[settled], exact[settled], atol=1e5 * 4e-4)


def test_what_a_filtered_displacement_shows_is_undone() -> None:
    # sin(w t) is shown as Im(e^{i w t} / (1 + i w tau)); differences of the third derivative: (w h)^2 / 6 = 7e-4
    tau, u0 = 0.03, 0.01
    trial = _trial(100.0, 10.0)
    time = trial.motion.time - trial.motion.time[0]
    true = [u0 * np.imag((1j * W) ** order * np.exp(1j * W * time)) for order in range(3)]
    shown = [u0 * np.imag((1j * W) ** order * np.exp(1j * W * time) / (1.0 + 1j * W * tau)) for order in range(3)]
    form = lag.DisplacementFilter()
    found = form.actuator({"time_constant": tau}, trial, Motion(trial.motion.time, *shown))
    np.testing.assert_allclose(found.displacement, true[0], atol=1e-12 * u0)
    np.testing.assert_allclose(found.velocity, true[1], atol=1e-12 * u0 * W)
    np.testing.assert_allclose(found.acceleration[1:-1], true[2][1:-1], atol=2e-4 * u0 * W**2)
    np.testing.assert_array_equal(form.channel({"time_constant": tau}, trial, trial.force), trial.force)


def test_gains_scale_their_channel() -> None:
    trial = _trial(100.0, 2.0)
    np.testing.assert_allclose(gain.Force().channel({"g": 0.04}, trial, trial.force), 1.04 * trial.force, rtol=1e-14)
    true = gain.Displacement().actuator({"g": 0.25}, trial, trial.motion)
    np.testing.assert_allclose(1.25 * true.displacement, trial.motion.displacement, rtol=1e-14)
    np.testing.assert_allclose(1.25 * true.velocity, trial.motion.velocity, rtol=1e-14)
    np.testing.assert_allclose(1.25 * true.acceleration, trial.motion.acceleration, rtol=1e-14)


def test_a_gain_that_changes_has_a_form_for_each_place() -> None:
    forms = gain.forms_of(_sizes(4))
    channels = ("force", "displacement")
    assert [form.form for form in forms] == [f"{one}_from_test_{k}" for one in channels for k in (2, 3, 4)]
    assert gain.forms_of(_sizes(1)) == ()
    for form in forms:
        first = form.fixed(_sizes(4))["first_test"]
        p = {"g": 0.1, **form.fixed(_sizes(4))}
        for order in range(4):
            trial = _trial(100.0, 1.0, order=order)
            shown = 1.1 if order + 1 >= first else 1.0
            of_force = isinstance(form, gain.ForceFromTest)
            force, motion = form.channel(p, trial, trial.force), form.actuator(p, trial, trial.motion)
            np.testing.assert_allclose(force, (shown if of_force else 1.0) * trial.force, rtol=1e-14)
            made = trial.motion.displacement / (1.0 if of_force else shown)
            np.testing.assert_allclose(motion.displacement, made, rtol=1e-14)
    copied = pickle.loads(pickle.dumps(forms[1]))
    assert (copied.form, copied.first) == ("force_from_test_3", 3)


def test_a_gain_has_forms_where_fitted_tests_tell_it_and_others_where_the_rest_does() -> None:
    uses: tuple[Use, ...] = ("fit", "validate", "validate", "fit", "fit", "validate")
    sizes = Sizes.of([replace(_trial(100.0, 1.0, order=i), use=use) for i, use in enumerate(uses)])
    forms = [form for form in gain.forms_of(sizes) if isinstance(form, gain.ForceFromTest)]
    assert [form.first for form in forms] == [4, 5]
    assert [form.form for form in forms[0].elsewhere(sizes)] == ["force_from_test_2", "force_from_test_3"]
    assert forms[1].elsewhere(sizes) == () == gain.Force().elsewhere(sizes)


def test_lines_of_drift_begin_with_the_test_or_go_on_through_the_campaign() -> None:
    trials = [_trial(100.0, duration, order=i) for i, duration in enumerate((3.0, 5.0, 2.0))]
    memory: dict[str, float] = {}
    before = 0.0
    for trial, duration in zip(trials, (3.0, 5.0, 2.0), strict=True):
        since = np.arange(trial.force.size) / 100.0
        own = drift.PerTestLine().channel({"rate": 7.0}, trial, trial.force) - trial.force
        np.testing.assert_allclose(own, 7.0 * since, atol=1e-9 * 1e5)
        through = drift.Campaign().parallel({"rate": 7.0}, trial, trial.motion, memory)
        np.testing.assert_allclose(through, 7.0 * (before + since), atol=1e-9)
        before += duration
    assert drift.Campaign.remembers


def _left(columns: np.ndarray, values: np.ndarray) -> float:
    """What a sum of columns leaves of values, of their norm."""
    rest = values - columns @ np.linalg.lstsq(columns, values, rcond=None)[0]
    return float(np.linalg.norm(rest) / np.linalg.norm(values))


def test_own_columns_take_out_what_is_each_tests_own() -> None:
    trial = _trial(100.0, 4.0)
    since = trial.motion.time - trial.motion.time[0]
    line = 120.0 - 30.0 * since
    assert _left(drift.EachOwn().columns({}, trial), line) < ROUNDING
    assert _left(offset.PerTest().columns({}, trial), 0.0 * since + 60.0) < ROUNDING
    # the mean goes: a line from 120 to 0 keeps its triangle, 60/sqrt(3) of 120/sqrt(3)
    assert _left(offset.PerTest().columns({}, trial), line) == pytest.approx(0.5, abs=2e-3)
    assert _left(drift.Wandering().columns({}, trial), 5.0 + np.cos(np.pi * since / 4.0)) < ROUNDING
    assert _left(drift.Warming().columns({"tau": 0.7}, trial), 3.0 - 8.0 * np.exp(-since / 0.7)) < ROUNDING
    assert (
        _left(drift.Swinging().columns({"period": 22.0}, trial), 3.0 - 8.0 * np.sin(W * since / 22.0 + 0.3)) < ROUNDING
    )
    assert _left(drift.EachOwn().columns({}, trial), 3.0 - 8.0 * np.exp(-since / 0.7)) > 0.1


def test_a_course_of_its_own_is_not_told_where_tests_are_not_left_out_as_a_whole() -> None:
    # of fewer tests quarters are left out, and a line through the rest of a relaxing test goes on in them
    own = (drift.EachOwn(), drift.Warming(), drift.Swinging(), drift.Wandering())
    for few, offered in (((True,) * 2 + (False,), False), ((True,) * 3 + (False,), True)):
        sizes = replace(_sizes(len(few)), fitted=few)
        assert all(bool(form.starts(sizes)) == offered for form in own)


def test_wandering_leaves_the_motion_alone() -> None:
    # a sine of 12 cycles: slowest frequency 1 Hz less the Hann window's width of 2 / duration
    trial = _trial(100.0, 12.0)
    assert 1.0 - 2.0 / 12.0 <= slowest_frequency(trial.motion) <= 1.0
    columns = drift.Wandering().columns({}, trial)
    since = (trial.motion.time - trial.motion.time[0]) / 12.0
    for j in range(columns.shape[1]):
        np.testing.assert_allclose(columns[:, j], np.cos(np.pi * j * since), atol=1e-12)
    assert columns.shape[1] == 9
    share = columns @ np.linalg.lstsq(columns, trial.force, rcond=None)[0]
    # whole cycles are orthogonal to the even cosines, nearly so to the odd ones
    assert np.sum(share**2) < 0.03 * np.sum(trial.force**2)
    # half a cycle in the test: the motion is as slow as anything, and only the constant is left
    assert drift.Wandering().columns({}, _trial(100.0, 0.5)).shape[1] <= 2


def test_inertia_is_mass_times_acceleration() -> None:
    trial = _trial(100.0, 2.0)
    force = inertia.Mass().carriage({"mass": 40.0}, trial, trial.motion, trial.force)
    np.testing.assert_allclose(force, -40.0 * W**2 * trial.motion.displacement, rtol=1e-12)


def test_more_mass_on_one_side_is_another_mass_there() -> None:
    trial = _trial(100.0, 2.0)
    p = {"mass": 40.0, "s": 0.25, "w": 1e-6}
    force = inertia.OneSided().carriage(p, trial, trial.motion, trial.force)
    off = np.abs(trial.motion.displacement) > 2e-5  # tanh(20) is 1
    on = np.where(trial.motion.displacement > 0.0, 50.0, 30.0)
    assert np.count_nonzero(off) > 0.9 * off.size
    np.testing.assert_allclose(force[off], (on * trial.motion.acceleration)[off], atol=1e-12)


@pytest.mark.parametrize(("f", "zeta"), [(8.0, 0.87), (20.0, 0.71)])
def test_a_filter_of_second_order_turns_a_sine_by_its_transfer_function(f: float, zeta: float) -> None:
    trial = _trial(200.0, 20.0, frequency=2.0)
    t = trial.motion.time - trial.motion.time[0]
    found = lag.SecondOrder().channel({"f": f, "zeta": zeta}, trial, np.sin(W * 2.0 * t))
    h = 1.0 / (1.0 - (2.0 / f) ** 2 + 2.0j * zeta * 2.0 / f)  # Chopra, Eq. 3.2.10
    late = t > 3.0
    # linear over quarters of the 100 samples of a cycle between a cubic: (w h / 4)^2 / 12 = 2e-5
    np.testing.assert_allclose(found[late][:-5], (h * np.exp(1j * W * 2.0 * t)).imag[late][:-5], atol=1e-4)
    steady = lag.SecondOrder().channel({"f": f, "zeta": zeta}, trial, np.full(t.size, 7.0))
    np.testing.assert_allclose(steady, 7.0, rtol=1e-12)


@pytest.mark.parametrize("rate", [40.0, 100.0, 1000.0])
def test_a_mass_on_a_fixture_swings_as_an_oscillator(rate: float) -> None:
    trial = _trial(rate, 20.0, frequency=2.0)
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
    trial = _trial(200.0, 5.0)
    p = {"mass": 40.0, "f": 400.0, "zeta": 0.1}
    force = inertia.Sprung().carriage(p, trial, trial.motion, trial.force)
    plain = inertia.Mass().carriage({"mass": 40.0}, trial, trial.motion, trial.force)
    # 2 zeta f / f_0 = 5e-4 of a turn in phase
    np.testing.assert_allclose(force[20:-5], plain[20:-5], atol=1e-3 * np.max(np.abs(plain)))


def test_a_tone_is_taken_out_with_its_harmonics() -> None:
    trial = _trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tone = 25.0 * np.sin(W * 50.02 * since + 0.7) + 4.0 * np.sin(W * 100.04 * since - 1.1)
    p = {"frequency": 50.02}
    assert _left(hum.Harmonics().columns(p, trial), tone) < ROUNDING
    # the second tone is left: 4 of sqrt(25^2 + 4^2)
    assert _left(hum.Tone().columns(p, trial), tone) == pytest.approx(4.0 / np.hypot(25.0, 4.0), rel=1e-2)


def test_two_tones_have_frequencies_of_their_own() -> None:
    trial = _trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tones = 25.0 * np.sin(W * 9.3 * since + 0.7) + 14.0 * np.sin(W * 34.79 * since - 1.1)
    assert _left(hum.TwoTones().columns({"frequency": 9.3, "second": 34.79}, trial), tones) < ROUNDING
    assert _left(hum.Tone().columns({"frequency": 9.3}, trial), tones) == pytest.approx(
        14.0 / np.hypot(25.0, 14.0), rel=1e-2
    )


def test_three_tones_have_frequencies_of_their_own() -> None:
    trial = _trial(120.0, 10.0)
    since = trial.motion.time - trial.motion.time[0]
    tones = sum(a * np.sin(W * f * since + f) for a, f in ((9.0, 9.3), (5.0, 34.79), (2.0, 51.1)))
    p = {"frequency": 9.3, "second": 34.79, "third": 51.1}
    assert _left(hum.ThreeTones().columns(p, trial), tones) < ROUNDING
    assert hum.ThreeTones().columns(p, trial).shape == (since.size, 6)


def test_a_tone_below_harmonics_of_the_motion_is_found_where_it_is_none_of_them() -> None:
    # sines of 1, 1.3 and 2 Hz leave their own odd harmonics; 8.6 Hz is none of them, though below seven times 2 Hz
    trials = [_trial(200.0, 20.0, f, i) for i, f in enumerate((1.0, 1.3, 2.0))]
    residuals = _noise(trials, 9)
    for trial, residual, f in zip(trials, residuals, (1.0, 1.3, 2.0), strict=True):
        since = trial.motion.time - trial.motion.time[0]
        residual += sum(300.0 / n * np.sin(W * f * n * since) for n in (3, 5, 7))
    assert common_tones(trials, residuals) == ()
    for trial, residual in zip(trials, residuals, strict=True):
        residual += 60.0 * np.sin(W * 8.6 * trial.motion.time)
    assert common_tones(trials, residuals) == pytest.approx((8.6,), abs=0.25 / 20.0)


def test_a_tone_whose_frequency_hunts_is_taken_out_by_restless_alone() -> None:
    # sin(w t + cos(W f t)) has sidebands J_n(1) at n f = 0.15 n Hz (Jacobi, Anger): unsteady, up to 0.1 Hz, leaves all
    # but J_0^2 of the power; restless, up to 0.5 Hz, leaves 2 (J_4^2 + ...) = 1.2e-5
    trial = _trial(120.0, 20.0)
    since = trial.motion.time - trial.motion.time[0]
    hunting = 25.0 * np.sin(W * 50.02 * since + np.cos(W * 0.15 * since))

    def left(form: Form) -> float:
        columns = form.columns({"frequency": 50.02}, trial)
        assert columns is not None
        rest = hunting - columns @ np.linalg.lstsq(columns, hunting, rcond=None)[0]
        return float(rest @ rest / (hunting @ hunting))

    # sums over 2401 samples in place of integrals: 1/2401 of the power, a few times
    assert left(hum.Unsteady()) == pytest.approx(1.0 - j0(1.0) ** 2, abs=2e-3)
    assert left(hum.Restless()) < 5e-5


def test_a_tone_that_hunts_goes_where_harmonics_of_a_fast_motion_are_too() -> None:
    # between the fifth and the sixth harmonic of 4 Hz; sidebands as above, of which up to 0.5 Hz are taken out
    trial = _trial(400.0, 20.0, frequency=4.0)
    since = trial.motion.time - trial.motion.time[0]
    hunting = 25.0 * np.sin(W * 21.7 * since + np.cos(W * 0.15 * since))
    columns = hum.Restless().columns({"frequency": 21.7}, trial)
    rest = hunting - columns @ np.linalg.lstsq(columns, hunting, rcond=None)[0]
    assert float(rest @ rest / (hunting @ hunting)) < 5e-5


@pytest.mark.slow
def test_of_a_tone_that_wanders_more_cosines_leave_less() -> None:
    # amplitude 1 + 0.3 z, z with the spectrum 2 T / (1 + (2 pi f T)^2), T = 4 s: above f_c, for f_c T far above 1, the
    # share 1 / (pi^2 f_c T) of its power is left (Rice 1944, Bell Syst. Tech. J. 23, section 2.7)
    trial, duration, t0 = _trial(400.0, 20.0), 20.0, 4.0
    since = trial.motion.time - trial.motion.time[0]
    step = float(since[1])
    rest = {hum.Restless: 0.0, hum.Hunting: 0.0}
    random = np.random.default_rng(8)
    for _ in range(20):
        keep = np.exp(-step / t0)
        slow = lfilter([np.sqrt(1.0 - keep**2)], [1.0, -keep], random.standard_normal(since.size + 8000))[8000:]
        tone = 0.3 * slow * np.sin(W * 50.02 * since)
        for kind in rest:
            columns = kind().columns({"frequency": 50.02}, trial)
            assert columns is not None
            left = tone - columns @ np.linalg.lstsq(columns, tone, rcond=None)[0]
            rest[kind] += float(left @ left) / (20.0 * 0.045 * since.size)
    for kind, cosines in ((hum.Restless, 21), (hum.Hunting, 81)):
        corner = (cosines - 1) / (2.0 * duration)
        # 20 draws, and rows of cosines over 20 s end within 1/20 Hz: a tenth of the corner of the shorter one
        assert rest[kind] == pytest.approx(1.0 / (np.pi**2 * corner * t0), rel=0.25)


def test_differences_of_a_frequency_stay_within_its_peak() -> None:
    # out of step by 2 pi df T at the end: far below one turn
    (unknown,) = hum.Tone().unknowns(_sizes())
    x = unknown.coordinate(50.0)
    moved = unknown.value(x + unknown.step(x)) - unknown.value(x)
    assert 0.0 < W * moved * _sizes().duration < 0.05


def _noise(trials: list[Trial], seed: int) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [rng.normal(scale=20.0, size=t.force.size) for t in trials]


def test_hum_below_the_noise_is_found_in_what_several_tests_have_in_common() -> None:
    trials = [_trial(rate, 20.0, f, i) for i, (rate, f) in enumerate(((120.0, 0.5), (125.0, 1.0), (150.0, 2.0)))]
    residuals = _noise(trials, 1)
    for i, (trial, residual) in enumerate(zip(trials, residuals, strict=True)):
        residual += 8.0 * np.sin(W * 49.93 * trial.motion.time + i)
    starts = hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))
    # to a quarter of the resolution of 20 s
    assert starts[0][0] == pytest.approx(49.93, abs=0.25 / 20.0)


def test_hum_above_half_the_rate_is_told_from_its_alias() -> None:
    trials = [_trial(120.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    residuals = _noise(trials, 2)
    for trial, residual in zip(trials, residuals, strict=True):
        residual += 8.0 * np.sin(W * 100.05 * trial.motion.time)
    assert common_tones(trials, residuals)[0] == pytest.approx(100.05, abs=0.25 / 20.0)


@pytest.mark.parametrize("tone", [150.02, 100.04, 40.04, 25.04])
def test_a_tone_above_the_rate_of_the_fit_is_told_by_the_record(tone: float) -> None:
    # 500 Hz thinned to 41.7 Hz: 150 Hz, 100 and 25 all look as 16.7; 40 Hz as 1.7, amid the motion
    whole = [_trial(500.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    added = _noise(whole, 5)
    measured = []
    for trial, own in zip(whole, added, strict=True):
        own += 8.0 * np.sin(W * tone * trial.motion.time)
        measured.append(replace(trial, force=trial.force + own).thinned())
    assert [float(np.median(t.motion.steps)) for t in measured] == pytest.approx([0.024, 0.024], rel=1e-9)
    residuals = [own[::12] for own in added]
    assert common_tones(measured, residuals) == pytest.approx((tone,), abs=0.25 / 20.0)


def test_harmonics_start_from_the_lowest_peak() -> None:
    trials = [_trial(120.0, 20.0, f, i) for i, f in enumerate((0.5, 1.0))]
    residuals = _noise(trials, 6)
    for trial, residual in zip(trials, residuals, strict=True):
        residual += sum(12.0 * np.sin(W * 16.7 * n * trial.motion.time) for n in (1, 2, 3))
    ((start,),) = hum.Harmonics().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))
    assert start == pytest.approx(16.7, abs=0.25 / 20.0)
    assert len(hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals))) == 3


def _nuisance(trial: Trial, parts: list[tuple[Form, tuple[float, ...]]]) -> tuple[np.ndarray, np.ndarray]:
    """Columns of a problem with these parts, and those of the forms side by side."""
    sizes, rest = Sizes.of((trial,) * 4), [np.sin(W * 50.0 * trial.motion.time)]
    problem = DamperProblem(law("kelvin_voigt"), {"k": 1e7, "c": 0.0}, (trial,), sizes)
    given: list[Part] = []
    columns = []
    for form, values in parts:
        candidate = candidate_of(form, sizes, Left((trial,), rest))
        assert candidate is not None
        given.append((candidate, np.array(values)))
        columns.append(form.columns({u.name: v for u, v in zip(candidate.unknowns, values, strict=True)}, trial))
    found = problem.nuisance(problem.declared, given, 0)
    assert found is not None and problem.nuisance(problem.declared, given, 0) is found  # kept
    return found, np.hstack([c for c in columns if c is not None])


def test_nuisance_is_an_orthonormal_basis_of_the_columns() -> None:
    trial = _trial(120.0, 10.0)
    found, columns = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ()), (gain.Force(), (0.1,))])
    assert found.shape == columns.shape == (trial.force.size, 44)
    np.testing.assert_allclose(found.T @ found, np.eye(44), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found @ (found.T @ columns), columns, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("parts", "rank"),
    [
        ([(offset.PerTest(), ()), (drift.EachOwn(), ())], 2),  # both have the constant
        ([(hum.Restless(), (50.0,)), (hum.Hunting(), (50.0,))], 162),  # 42 columns stand twice
        ([(hum.Tone(), (120.0,))], 1),  # at the rate of the samples a tone is a constant
    ],
)
def test_nuisance_takes_nothing_out_that_is_in_no_column(
    parts: list[tuple[Form, tuple[float, ...]]], rank: int
) -> None:
    found, columns = _nuisance(_trial(120.0, 10.0), parts)
    assert np.linalg.matrix_rank(columns, tol=1e-9) == rank == found.shape[1]
    np.testing.assert_allclose(found @ (found.T @ columns), columns, rtol=0.0, atol=1e-9)


def test_nuisance_that_is_not_finite_is_no_prediction() -> None:
    trial = _trial(120.0, 10.0)
    broken = replace(trial, weight=np.where(np.arange(trial.force.size) == 7, np.nan, 1.0))
    for bad in (broken, replace(trial, weight=np.full(trial.force.size, 1e200))):
        with pytest.raises(PredictionError, match="each test's own is not finite"):
            _nuisance(bad, [(hum.Tone(), (50.0,)), (drift.EachOwn(), ())])


def test_nuisance_does_without_eigenvalues_that_do_not_converge(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise np.linalg.LinAlgError("Eigenvalues did not converge")

    trial = _trial(120.0, 10.0)
    expected, _ = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ())])
    monkeypatch.setattr(np.linalg, "eigh", fails)
    found, _ = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ())])
    np.testing.assert_allclose(found @ found.T, expected @ expected.T, rtol=0.0, atol=1e-12)


def test_harmonics_of_the_motion_and_noise_are_no_hum() -> None:
    trials = [_trial(120.0, 20.0, f, i) for i, f in enumerate((2.0, 2.0, 2.0))]
    residuals = _noise(trials, 4)
    assert common_tones(trials, residuals) == ()
    for trial, residual in zip(trials, residuals, strict=True):
        since = trial.motion.time - trial.motion.time[0]
        residual += sum(200.0 / n * np.sin(W * 2.0 * n * since) for n in (1, 3, 5, 7))
    assert common_tones(trials, residuals) == ()
    assert hum.Tone().starts_from_residuals(Sizes.of(trials), Left(trials, residuals)) == ()
