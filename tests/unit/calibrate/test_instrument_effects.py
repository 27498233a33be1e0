"""Gains, offsets and drifts of the instruments, and what all of their effects have in common."""

from __future__ import annotations

import pickle
from dataclasses import replace

import numpy as np
import pytest
from unit.calibrate.sine_trials import W, sine_sizes, sine_trial

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import drift, gain, hum, inertia, lag, offset
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.trial import Sizes
from edesign.calibrate.problem import Use

PARAMETRIC = [kind for module in (lag, gain, offset, drift, inertia, hum) for kind in module.FORMS]


@pytest.mark.parametrize("kind", PARAMETRIC)
def test_starts_are_complete_and_inside_the_bounds(kind: type[Form]) -> None:
    form, trial = kind(), sine_trial(120.0, 10.0)
    left = Left([trial], [sum(np.sin(W * f * trial.motion.time) for f in (50.0, 31.0, 21.0))])
    unknowns = form.unknowns(sine_sizes(4))
    starts = form.starts_from_residuals(sine_sizes(4), left) if form.name == "hum" else form.starts(sine_sizes(4))
    assert starts
    for start in starts:
        assert len(start) == len(unknowns)
        for value, unknown in zip(start, unknowns, strict=True):
            assert unknown.lower < value < unknown.upper
            assert unknown.value(unknown.coordinate(value)) == pytest.approx(value, rel=1e-12)
    if kind is drift.Swinging:
        assert form.starts(sine_sizes(2)) == ()  # too few tests for a period in common


def test_no_amplitude_leaves_the_force_unchanged() -> None:
    trial = sine_trial(100.0, 5.0)
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
    trial, rate = sine_trial(60.0, 5.0), 1e-4
    time = trial.motion.time - trial.motion.time[0]
    u, v = trial.motion.displacement + rate * time, trial.motion.velocity + rate
    made = drift.Displacement().actuator({"rate": rate}, trial, replace(trial.motion, displacement=u, velocity=v))
    np.testing.assert_allclose(made.displacement, trial.motion.displacement, atol=1e-16)
    np.testing.assert_allclose(made.velocity, trial.motion.velocity, atol=1e-14)


def test_gains_scale_their_channel() -> None:
    trial = sine_trial(100.0, 2.0)
    np.testing.assert_allclose(gain.Force().channel({"g": 0.04}, trial, trial.force), 1.04 * trial.force, rtol=1e-14)
    true = gain.Displacement().actuator({"g": 0.25}, trial, trial.motion)
    np.testing.assert_allclose(1.25 * true.displacement, trial.motion.displacement, rtol=1e-14)
    np.testing.assert_allclose(1.25 * true.velocity, trial.motion.velocity, rtol=1e-14)
    np.testing.assert_allclose(1.25 * true.acceleration, trial.motion.acceleration, rtol=1e-14)


def test_a_gain_that_changes_has_a_form_for_each_place() -> None:
    forms = gain.forms_of(sine_sizes(4))
    channels = ("force", "displacement")
    assert [form.form for form in forms] == [f"{one}_from_test_{k}" for one in channels for k in (2, 3, 4)]
    assert gain.forms_of(sine_sizes(1)) == ()
    for form in forms:
        first = form.fixed(sine_sizes(4))["first_test"]
        p = {"g": 0.1, **form.fixed(sine_sizes(4))}
        for order in range(4):
            trial = sine_trial(100.0, 1.0, order=order)
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
    sizes = Sizes.of([replace(sine_trial(100.0, 1.0, order=i), use=use) for i, use in enumerate(uses)])
    forms = [form for form in gain.forms_of(sizes) if isinstance(form, gain.ForceFromTest)]
    assert [form.first for form in forms] == [4, 5]
    assert [form.form for form in forms[0].elsewhere(sizes)] == ["force_from_test_2", "force_from_test_3"]
    assert forms[1].elsewhere(sizes) == () == gain.Force().elsewhere(sizes)


def test_lines_of_drift_begin_with_the_test_or_go_on_through_the_campaign() -> None:
    trials = [sine_trial(100.0, duration, order=i) for i, duration in enumerate((3.0, 5.0, 2.0))]
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
