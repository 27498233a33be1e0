"""Self-heating, degradation and ageing against loops over samples, written from their definitions, and closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from irregular_motion import (
    ROUNDING,
    STIFFNESS,
    SWEPT,
    U,
    close,
    factor,
    motion,
    shaken,
    sizes,
    steps,
    trial,
    two_tests,
)

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import (
    ageing,
    degradation,
    mullins,
    relaxation_branch,
    self_heating,
)
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes
from edesign.damper.amendments import Amendment
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS


def test_heat_step_by_step() -> None:
    beta, tau_h, kept, m = 2e-3, 1.5, 0.6, 0.5
    tests = two_tests()
    for form, carried, left in (
        (self_heating.Rate(), 0.0, lambda q: math.exp(-q)),
        (self_heating.Carried(), kept, lambda q: math.exp(-q)),
        (self_heating.Levelling(), kept, lambda q: (1.0 + max(q, 0.0) / m) ** -m),
    ):
        q, expected = 0.0, []
        for t in tests:
            q *= carried
            rows, force = [left(q)], left(q) * t.force[0]
            for i, h, du in steps(t.motion):
                phi = left(q)
                q = q * math.exp(-h / tau_h) + beta * 0.5 * (force + phi * t.force[i]) * du
                force = phi * t.force[i]
                rows.append(phi)
            expected.append(np.array(rows))
        assert expected[0].min() < 0.9
        p = {"beta": beta, "tau_h": tau_h, "kept": kept, "m": m}
        close(factor(form, p, tests), expected, SWEPT / ROUNDING)


def test_core_and_damper_are_two_nodes_step_by_step() -> None:
    # each node: what it keeps over a step, and its share of the step's work; both soften the same force
    nodes, expected = ((2e-3, 1.5), (1e-3, 0.2)), []
    tests = two_tests()
    for t in tests:
        heats, force, rows = [0.0, 0.0], float(t.force[0]), [1.0]
        for i, h, du in steps(t.motion):
            phi = math.exp(-sum(heats))
            done = 0.5 * (force + phi * t.force[i]) * du
            heats = [q * math.exp(-h / tau) + beta * done for q, (beta, tau) in zip(heats, nodes, strict=True)]
            force = phi * t.force[i]
            rows.append(phi)
        expected.append(np.array(rows))
    p = {"beta": 2e-3, "tau_h": 1.5, "beta_c": 1e-3, "tau_c": 0.2}
    found = factor(self_heating.Core(), p, tests)
    close(found, expected, SWEPT / ROUNDING)
    alone = factor(self_heating.Rate(), p, tests)
    assert np.max(np.abs(found[0] - alone[0])) > 0.01
    for a, b in zip(factor(self_heating.Core(), {**p, "beta_c": 0.0}, tests), alone, strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize(("resampled", "left"), [(False, 0.5), (True, 0.25)])
def test_heat_without_loss_comes_to_the_closed_form(resampled: bool, left: float) -> None:
    # exp(q) = 1 + beta X, X the work of the law; the explicit step is late by one sample: errors go with the step, and
    # with its square where samples are not the test's own
    beta, errors = 1e-2, []
    for n in (2000, 4000):
        t = np.linspace(0.0, 5.0, n)
        of = Motion(t, U * np.sin(5.0 * t), 5.0 * U * np.cos(5.0 * t), -25.0 * U * np.sin(5.0 * t), resampled=resampled)
        test = trial(of)
        w = 5.0
        damping = 2e4 * U * U * w * (w * t / 2.0 + np.sin(2.0 * w * t) / 4.0)
        exact = 1.0 / (1.0 + beta * (damping + 0.5 * STIFFNESS * of.displacement**2))
        (phi,) = factor(self_heating.Rate(), {"beta": beta, "tau_h": 1e12}, (test,))
        errors.append(float(np.max(np.abs(phi - exact))))
    assert errors[0] < 0.02
    assert errors[1] == pytest.approx(left * errors[0], rel=0.05)


@pytest.mark.parametrize(
    ("form", "p", "left"),
    [
        (degradation.Energy(), {"d": 0.4, "E0": 100.0}, lambda e: 1.0 - 0.4 * (1.0 - math.exp(-max(e, 0.0) / 100.0))),
        (degradation.Work(), {"d": 0.4, "p": 1.3, "W": 200.0}, lambda e: 1.0 - 0.4 * (max(e, 0.0) / 200.0) ** 1.3),
    ],
)
def test_degradation_by_energy_step_by_step_over_two_tests(
    form: Form, p: dict[str, float], left: Callable[[float], float]
) -> None:
    energy, expected = 0.0, []
    tests = two_tests()
    for t in tests:
        rows, force = [left(energy)], left(energy) * t.force[0]
        for i, _, du in steps(t.motion):
            phi = left(energy)
            energy += 0.5 * (force + phi * t.force[i]) * du
            force = phi * t.force[i]
            rows.append(phi)
        expected.append(np.array(rows))
    assert expected[1][0] == pytest.approx(expected[0][-1], abs=0.02) and expected[1][-1] < 0.95
    close(factor(form, p, tests), expected, SWEPT / ROUNDING)


def test_degradation_by_path_goes_on_in_the_next_test() -> None:
    tests = two_tests()
    s, expected = 0.0, []
    for t in tests:
        rows = [1.0 - 0.3 * (s / 0.9) ** 0.7]
        for _, _, du in steps(t.motion):
            s += abs(du)
            rows.append(1.0 - 0.3 * (s / 0.9) ** 0.7)
        expected.append(np.array(rows))
    close(factor(degradation.Path(), {"d": 0.3, "p": 0.7, "S": 0.9}, tests), expected)


def test_fatigue_counts_large_cycles_more_step_by_step() -> None:
    tests, damage, expected = two_tests(), 0.0, []
    for t in tests:
        u, rows = np.abs(t.motion.displacement) / U, [1.0 - 0.3 * damage**0.7]
        for i, _, du in steps(t.motion):
            damage += abs(du) * 0.5 * (u[i - 1] ** 2.5 + u[i] ** 2.5) / 0.9
            rows.append(1.0 - 0.3 * damage**0.7)
        expected.append(np.array(rows))
    p = {"d": 0.3, "q": 2.5, "p": 0.7, "S": 0.9, "U": U}
    close(factor(degradation.Fatigue(), p, tests), expected)
    by_path = factor(degradation.Path(), p, tests)
    close(factor(degradation.Fatigue(), {**p, "q": 0.0}, tests), by_path)


def test_fatigue_of_small_cycles_by_the_power_of_the_amplitude() -> None:
    # damage of a cycle: 4 A (A/U)^q / (q + 1)
    for amplitude in (U, 0.5 * U):
        of = shaken(amplitude * np.sin(np.linspace(0.0, 6.0 * np.pi, 3001)))
        (phi,) = factor(degradation.Fatigue(), {"d": 0.3, "q": 3.0, "p": 1.0, "S": 1.0, "U": U}, (trial(of),))
        expected = 0.3 * 3.0 * 4.0 * amplitude * (amplitude / U) ** 3 / 4.0
        assert 1.0 - phi[-1] == pytest.approx(expected, rel=1e-4)  # trapezoids over 1000 samples in a cycle


def test_ageing_along_a_course_passes_its_knots() -> None:
    course = {"a1": 0.3, "a2": -0.1, "a3": 0.2, "n1": 2.0, "n2": 4.0, "n3": 6.0}
    found = [factor(ageing.Course(), course, (trial(motion(1), n),))[0] for n in range(7)]
    assert all(len(set(phi)) == 1 for phi in found)
    expected = [1.0, 1.15, 1.3, 1.1, 0.9, 1.05, 1.2]  # knots at tests 0, 2, 4, 6 and half way between them
    np.testing.assert_allclose([phi[0] for phi in found], expected, rtol=ROUNDING)
    assert ageing.Course().fixed(sizes(7)) == {"n1": 2.0, "n2": 4.0, "n3": 6.0} and ageing.Course().unknowns(sizes(6))
    assert ageing.Course().unknowns(sizes(5)) == () and ageing.Course().starts(sizes(5)) == ()


def test_a_course_bends_among_the_tests_fitted_to_and_goes_on_straight_beyond() -> None:
    # the last tests are for validation: a knot there would be told by no test
    size = replace(sizes(9), fitted=(True, True, False, True, True, True, True, False, False))
    assert ageing.Course().fixed(size) == pytest.approx({"n1": 1.0 + 2.0 / 3.0 * 2.0, "n2": 3.0 + 4.0 / 3.0, "n3": 6.0})
    course = {"a1": 0.3, "a2": -0.1, "a3": 0.2, "n1": 2.0, "n2": 4.0, "n3": 6.0}
    found = [float(factor(ageing.Course(), course, (trial(motion(1), n),))[0][0]) for n in (7, 8)]
    np.testing.assert_allclose(found, [1.35, 1.5], rtol=ROUNDING)
    falling = {**course, "a2": 0.9, "a3": 0.0}
    assert factor(ageing.Course(), falling, (trial(motion(1), 9),))[0][0] == pytest.approx(0.1)  # no force turns round


def test_ageing_goes_with_the_order_of_the_tests() -> None:
    of = motion(1)
    for n in (0, 1, 7):
        (linear,) = factor(ageing.Linear(), {"rate": -0.02}, (trial(of, n),))
        (slowing,) = factor(ageing.Logarithmic(), {"rate": 0.05}, (trial(of, n),))
        assert set(linear) == {1.0 - 0.02 * n}
        assert set(slowing) == {1.0 + 0.05 * math.log1p(n)}
    pair = Sizes.of(two_tests())
    assert ageing.Linear().starts(pair) and not ageing.Logarithmic().starts(pair)


def test_heat_from_before_a_test_is_each_tests_own() -> None:
    # no heat by work (beta = 0): what was there fades, F = exp(-q0 exp(-t/tau)) F_law; the shares are linear in q0
    tests = two_tests()
    q0, tau, size = (1e-3, -0.4e-3), 3.0, sizes()
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, tests, size)
    forces = [f for f in solid.predict(solid.declared, (), ("fit", "validate")) if f is not None]
    warm = [
        np.exp(-q * np.exp(-(t.motion.time - t.motion.time[0]) / tau)) * f
        for t, q, f in zip(tests, q0, forces, strict=True)
    ]
    plain = candidate_of(self_heating.Rate(), size, Left())
    assert plain is not None
    begun = next(part for part in solid.finer((plain, np.array([0.0, tau]))) if part[0].form == "rate_begun_warm")
    for i, (force, law_force) in enumerate(zip(warm, forces, strict=True)):
        (column,) = solid.nuisance(solid.declared, [begun], i).T  # type: ignore[union-attr]
        left = force - law_force
        assert np.linalg.norm(left) > 1e-4 * np.linalg.norm(law_force)
        # second order of q0, 5e-7, and of the difference that the column is
        assert np.linalg.norm(left - column * (column @ left)) < 1e-6 * np.linalg.norm(law_force)


def test_a_test_begun_hot_is_predicted_from_there() -> None:
    # as above, far from linear in q0: two fifths of the first test's force are gone, or a share of its heat is carried
    # into the second one
    tests = two_tests()
    q0, tau, size = (0.5, -0.2), 3.0, sizes()
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, tests, size)
    forces = [f for f in solid.predict(solid.declared, (), ("fit", "validate")) if f is not None]
    warm = [
        np.exp(-q * np.exp(-(t.motion.time - t.motion.time[0]) / tau)) * f
        for t, q, f in zip(tests, q0, forces, strict=True)
    ]
    hot = replace(solid, trials=tuple(replace(t, force=f) for t, f in zip(tests, warm, strict=True)))
    for form, own in ((self_heating.Rate(), [0.0, tau]), (self_heating.Carried(), [0.0, tau, 0.7])):
        plain = candidate_of(form, size, Left())
        assert plain is not None
        begun = next(p for p in solid.finer((plain, np.array(own))) if p[0].effect[0].begins)
        for found, force, law_force in zip(
            hot.predict(hot.declared, [begun], ("fit", "validate")), warm, forces, strict=True
        ):
            # the state that the parabola asks for is off by what is of the third order in q0, 0.5^3/6
            assert np.linalg.norm(found - force) < 0.02 * np.linalg.norm(law_force - force)


def test_what_a_virgin_specimen_has_regained_is_each_tests_own() -> None:
    tests = two_tests()
    s0, size = 0.4 * float(tests[0].motion.path[-1]), sizes()
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, tests, size, fineness=0.0)
    forces = [f for f in solid.predict(solid.declared, (), ("fit", "validate")) if f is not None]
    candidate = candidate_of(mullins.Begun(), size, Left())
    assert candidate is not None
    for i, (t, x, force) in enumerate(zip(tests, (0.3, -0.1), forces, strict=True)):
        (column,) = solid.nuisance(solid.declared, [(candidate, np.array([s0]))], i).T  # type: ignore[union-attr]
        more = x * np.exp(-t.motion.path / s0) * force
        # linear in x: a difference is exact but for rounding, 1e-16 of the force over its step of 1e-3
        assert np.linalg.norm(more - column * (column @ more)) < 1e-11 * np.linalg.norm(more)


def test_work_that_springs_give_back_is_no_heat() -> None:
    # the power of a spring, k U^2 w/2 sin(2 w t), is smaller by 1/sqrt(1 + (2 w tau_w)^2) where it is behind by tau_w;
    # half of it is above zero, the mean of which is 1/pi of its size. Done and given back at once, it is none at all.
    form = next(other for other in self_heating.Rate().finer() if other.form == "rate_evened")
    w, tau, beta = 2.0 * math.pi, 0.4, 1e-9  # too little to soften the spring
    t = np.linspace(0.0, 20.0, 40001)
    u = U * np.sin(w * t)
    of = Motion(t, u, w * U * np.cos(w * t), -w * w * u)
    p = {"beta": beta, "tau_h": 1e12, "tau_w": tau}
    phi = form.factor(p, trial(of), of, STIFFNESS * u, {})
    assert phi is not None
    heat = -np.log(np.asarray(phi)) / beta
    size = 0.5 * STIFFNESS * U**2 * w / math.hypot(1.0, 2.0 * w * tau)
    # over the last ten of twenty periods: it has settled within exp(-10 s/tau) = 1e-11; steps of a 2000th of a period,
    # and what is late by one
    assert heat[-1] - heat[20000] == pytest.approx(10.0 * size / math.pi, rel=1e-3)
    del p["tau_w"]
    plain = self_heating.Rate().factor(p, trial(of), of, STIFFNESS * u, {})
    assert plain is not None
    assert abs(float(np.log(plain[-1]))) / beta < 1e-3 * heat[-1]


@pytest.mark.parametrize("form", [self_heating.Rate(), self_heating.Carried()])
def test_heat_is_that_of_springs_and_dashpots_as_they_are(form: Form) -> None:
    # F = phi k u + phi^loss c v by a loop over samples, q' = beta F v: what the dashpots have lost heats no more
    beta, tau, loss, k, c = 4e-3, 2.0, 3.0, STIFFNESS, 2e4
    (test,) = two_tests()[:1]
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": k, "c": c}, (test,), sizes(), fineness=0.0)
    u, v = test.motion.displacement, test.motion.velocity
    q, phi, force = 0.0, 1.0, [k * u[0] + c * v[0]]
    for i, h, du in steps(test.motion):
        phi = math.exp(-q)
        force.append(phi * k * u[i] + phi**loss * c * v[i])
        q = q * math.exp(-h / tau) + beta * 0.5 * (force[-1] + force[-2]) * du
    assert phi < 0.8
    candidate = candidate_of(form.sparing_loss(), Sizes.of(two_tests()), Left())
    assert candidate is not None
    values = {"beta": beta, "tau_h": tau, "kept": 0.5, "loss": loss}
    own = np.array([values[unknown.name] for unknown in candidate.unknowns])
    (found,) = solid.predict(solid.declared, [(candidate, own)], ("fit", "validate"))
    np.testing.assert_allclose(found, force, atol=1e-5 * float(np.max(np.abs(force))))  # a sweep that ends at 1e-6


@pytest.mark.parametrize("counted", [0.0, 0.5, 1.0])
def test_work_counted_by_its_size(counted: float) -> None:
    # a spring of a cosine: no work stays over a period, k U^2/2 is done and given back twice in it
    form = next(other for other in degradation.Work().finer() if other.form == "work_sized")
    t = np.linspace(0.0, 2.0, 4001)
    u = U * np.sin(2.0 * np.pi * t)
    of = Motion(t, u, np.gradient(u, t), np.zeros_like(t))
    d, p = 1e-9, {"d": 1e-9, "p": 1.0, "W": 1e3, "sized": counted}  # too little to soften the spring
    phi = form.factor(p, trial(of), of, STIFFNESS * u, {})
    assert phi is not None
    # the factor is of the beginning of a step, whose work is U k U w / 4000 at most
    assert 1e3 * (1.0 - np.asarray(phi)[-1]) / d == pytest.approx(counted * 4.0 * STIFFNESS * U**2, rel=1e-3, abs=1e-2)


@pytest.mark.parametrize(
    ("form", "values", "core"),
    [
        (degradation.Energy(), (0.4, 400.0), ("degradation", "energy", {"d": 0.4, "E0": 400.0})),
        (self_heating.Rate(), (1e-3, 3.0), ("self_heating", "rate", {"beta": 1e-3, "tau_h": 3.0})),
    ],
)
def test_what_stands_beside_the_law_works_too(
    form: Form, values: tuple[float, ...], core: tuple[str, str, dict[str, float]]
) -> None:
    # a branch beside a Zener law and a path that softens it, by the core, which steps through the same definitions
    test = trial(motion(11))
    zener = {"k0": STIFFNESS, "k1": 0.5 * STIFFNESS, "c1": 0.1 * STIFFNESS}
    problem = DamperProblem(LAWS["zener"], zener, (test,), sizes(), fineness=0.0)
    parts, branch = [], {"k": 0.8 * STIFFNESS, "tau": 0.2}
    for one, own in (
        (form, values),
        (relaxation_branch.Maxwell(), tuple(branch.values())),
        (mullins.Path(), (0.5, 0.1, 0.0)),
    ):
        candidate = candidate_of(one, problem.sizes, Left())
        assert candidate is not None and len(candidate.unknowns) == len(own)
        parts.append((candidate, np.array(own)))
    amendments = (
        Amendment(*core),
        Amendment("relaxation_branch", "maxwell", branch),
        Amendment("mullins", "path", {"m": 0.5, "s0": 0.1}),
    )
    of = test.motion
    expected = Damper(LAWS["zener"], zener, amendments=amendments).force(of.time, of.displacement, of.velocity)
    (found,) = problem.predict(problem.declared, parts, ("fit",))
    (alone,) = problem.predict(problem.declared, parts[1:], ("fit",))
    np.testing.assert_allclose(found, expected, atol=1e-6 * np.max(np.abs(expected)))
    assert np.max(np.abs(found - alone)) > 0.1 * np.max(np.abs(found))
