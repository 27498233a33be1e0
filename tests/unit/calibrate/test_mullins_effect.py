"""Forms of Mullins softening, and what drives them, step by step and by closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from irregular_motion import ROUNDING, U, close, factor, motion, parallel, shaken, sizes, steps, trial, two_tests
from scipy.special import erf

from edesign.calibrate.dampers.drivers import cycles, weighted_path
from edesign.calibrate.dampers.effects import (
    mullins,
)
from edesign.calibrate.dampers.trial import Sizes, Trial

# --- Mullins ---


def virgin_share(tests: tuple[Trial, ...], s0: float, recovery: float) -> list[np.ndarray]:
    left, found = 1.0, []
    for n, t in enumerate(tests):
        left = left + recovery * (1.0 - left) if n else left
        rows = [left]
        for _, _, du in steps(t.motion):
            left *= math.exp(-abs(du) / s0)
            rows.append(left)
        found.append(np.array(rows))
    return found


@pytest.mark.parametrize("recovery", [0.0, 0.3, 1.0])
def test_mullins_by_path_wears_off_over_two_tests(recovery: float) -> None:
    tests, s0 = two_tests(), 0.2
    share = virgin_share(tests, s0, recovery)
    assert share[0][-1] < 0.5  # the first test wears much off: the memory matters
    close(factor(mullins.Path(), {"m": 0.3, "s0": s0, "recovery": recovery}, tests), [1.0 + 0.3 * s for s in share])
    spring = [5e5 * s * t.motion.displacement for s, t in zip(share, tests, strict=True)]
    close(parallel(mullins.Elastic(), {"k": 5e5, "s0": s0, "recovery": recovery}, tests), spring, 5e5 * U)


def test_full_recovery_begins_as_virgin_and_none_goes_on() -> None:
    again = (trial(motion(1)), trial(motion(1), 1))
    first, second = factor(mullins.Path(), {"m": 0.3, "s0": 0.1, "recovery": 1.0}, again)
    assert np.array_equal(first, second) and first[0] == 1.3
    first, second = factor(mullins.Path(), {"m": 0.3, "s0": 0.1, "recovery": 0.0}, again)
    assert second[0] == first[-1] < 1.05


def test_finer_forms_below_the_largest_have_a_hyperbolic_tangent() -> None:
    # Dorfmann & Ogden (2004): tanh in the place of erf
    t = trial(motion(9))
    u = np.abs(t.motion.displacement)
    most = np.maximum.accumulate(u)
    for form, p, expected in (
        (mullins.Maximum(), {"r": 3e-3}, np.tanh((most - u) / 3e-3)),
        (mullins.PseudoElastic(), {"e": 2e-3, "b": 0.4}, np.tanh((most**2 - u**2) / (4e-6 + 0.4 * most**2))),
    ):
        (finer,) = form.finer()
        assert finer.form == f"{form.form}_tanh" and finer.finer() == () and not finer.amendment
        close(factor(finer, {"m": 0.3, "recovery": 0.0, **p}, (t,)), [1.0 - 0.3 * expected])


@pytest.mark.parametrize("recovery", [0.0, 0.4, 1.0])
def test_forgotten_cycles_are_counted_from_there(recovery: float) -> None:
    tests, least = two_tests(), 0.05 * U
    gone = [cycles(t.motion, least) for t in tests]
    before = (1.0 - recovery) * gone[0][-1]
    expected = [1.0 + 0.3 * np.exp(-gone[0] / 4.0), 1.0 + 0.3 * np.exp(-(before + gone[1]) / 4.0)]
    found = factor(mullins.Forgotten(), {"m": 0.3, "N0": 4.0, "recovery": recovery, "least": least}, tests)
    close(found, expected)


@pytest.mark.parametrize("recovery", [0.0, 0.4])
def test_mullins_by_largest_deformation(recovery: float) -> None:
    tests, largest = two_tests(), 0.0
    below, damaged = [], []
    for n, t in enumerate(tests):
        largest *= 1.0 - recovery if n else 1.0
        rows = []
        for u in t.motion.displacement:
            largest = max(largest, abs(u))
            gone = 1.0 - math.exp(-((largest / 4e-3) ** 1.7))
            rows.append((1.0 - 0.2 * erf((largest - abs(u)) / 3e-3), 1.0 - 0.2 * gone))
        below.append(np.array([a for a, _ in rows]))
        damaged.append(np.array([b for _, b in rows]))
    close(factor(mullins.Maximum(), {"m": 0.2, "r": 3e-3, "recovery": recovery}, tests), below)
    close(factor(mullins.Damage(), {"m": 0.2, "r": 4e-3, "p": 1.7, "recovery": recovery}, tests), damaged)


@pytest.mark.parametrize("recovery", [0.0, 0.4, 1.0])
def test_a_forgotten_path_is_counted_from_there(recovery: float) -> None:
    first, second = two_tests()
    before = (1.0 - recovery) * first.motion.path[-1]
    expected = [1.0 + 0.3 * np.exp(-first.motion.path / 0.2), 1.0 + 0.3 * np.exp(-(before + second.motion.path) / 0.2)]
    found = factor(mullins.ForgottenPath(), {"m": 0.3, "s0": 0.2, "recovery": recovery}, (first, second))
    close(found, expected)


@pytest.mark.parametrize("recovery", [0.0, 0.4])
def test_scragging_follows_the_path_towards_what_the_largest_deformation_allows(recovery: float) -> None:
    tests, largest, damage, expected = two_tests(), 0.0, 0.0, []
    for t in tests:
        u, rows = t.motion.displacement, []
        largest, damage = (1.0 - recovery) * largest, (1.0 - recovery) * damage
        for i, value in enumerate(u):
            largest = max(largest, abs(value))
            above = 1.0 - math.exp(-largest / 4e-3) - damage
            way = abs(value - u[i - 1]) if i else 0.0
            damage += above * (1.0 - math.exp(-way / 0.05)) if above > 0.0 else 0.0
            rows.append(1.0 - 0.2 * damage)
        expected.append(np.array(rows))
    p = {"m": 0.2, "r": 4e-3, "s0": 0.05, "recovery": recovery}
    close(factor(mullins.Scragging(), p, tests), expected)
    # of no way it is the damage at once, of an endless one there is none
    quick = factor(mullins.Scragging(), {**p, "s0": 1e-12}, tests)
    damaged = factor(mullins.Damage(), {"m": 0.2, "r": 4e-3, "p": 1.0, "recovery": recovery}, tests)
    for one, other in zip(quick[:1], damaged[:1], strict=True):
        np.testing.assert_allclose(one[1:], other[1:], rtol=1e-9)
    close(factor(mullins.Scragging(), {**p, "s0": 1e12}, tests), [np.ones(t.motion.time.size) for t in tests])


def test_a_single_test_has_no_recovery() -> None:
    single = Sizes.of((trial(motion(1)),))
    for form in (kind() for kind in mullins.FORMS if kind is not mullins.Begun):  # which needs none
        assert "recovery" not in [u.name for u in form.unknowns(single)]
        assert form.fixed(single)["recovery"] == 0.0
        assert "recovery" not in form.fixed(sizes())


# --- drivers of virgin softening ---


def test_cycles_of_a_sine_are_its_periods_and_a_half_each_way() -> None:
    t = np.linspace(0.0, 10.0, 1001)
    counted = cycles(shaken(U * np.cos(2.0 * np.pi * t)), 0.05 * U)
    np.testing.assert_allclose(counted[::50], 0.5 * np.arange(21), rtol=0.0, atol=1e-12)
    # between two reversals with the path: a quarter where the deformation passes zero
    np.testing.assert_allclose(counted[25::50], 0.5 * np.arange(20) + 0.25, rtol=0.0, atol=1e-12)
    # from zero on, the first way and the last one are ways as well
    assert cycles(shaken(U * np.sin(2.0 * np.pi * t)), 0.05 * U)[-1] == pytest.approx(10.5, abs=1e-12)


def test_ripples_are_no_cycles_and_small_cycles_are() -> None:
    t = np.linspace(0.0, 10.0, 4001)
    large = U * np.cos(2.0 * np.pi * 0.5 * t)
    rippled = large + 0.02 * U * np.sin(2.0 * np.pi * 13.0 * t)  # ways back of at most 0.04 U
    assert cycles(shaken(rippled), 0.05 * U)[-1] == 5.0
    small = np.where(t < 4.0, large, U - 0.1 * U * (1.0 - np.cos(2.0 * np.pi * (t - 4.0))))  # 2 large ones, 6 small
    assert cycles(shaken(small), 0.05 * U)[-1] == 8.0


@pytest.mark.parametrize("size", [1.02, 1.5, 1.98, 2.02, 5.0])
def test_cycles_count_from_the_least_way_on(size: float) -> None:
    t = np.linspace(0.0, 10.0, 4001)
    least = 0.05 * U
    assert cycles(shaken(0.5 * size * least * np.cos(2.0 * np.pi * t)), least)[-1] == 10.0
    assert cycles(shaken(0.49 * least * np.cos(2.0 * np.pi * t)), least)[-1] == 0.5  # one way, however it goes


@pytest.mark.parametrize("q", [0.0, 1.0, 3.0])
def test_weighted_path_of_a_quarter_of_a_sine(q: float) -> None:
    # integral of (u/U)^q over u from 0 to U; trapezoids over steps of at most 0.002 U: q (q - 1)/12 of their square
    quarter = shaken(U * np.sin(np.linspace(0.0, 0.5 * np.pi, 1001)))
    weight = np.abs(quarter.displacement / U) ** q
    assert weighted_path(quarter, weight)[-1] == pytest.approx(U / (q + 1.0), rel=1e-5)


# --- later forms of Mullins ---


@pytest.mark.parametrize("recovery", [0.0, 0.3, 1.0])
def test_mullins_by_work_step_by_step(recovery: float) -> None:
    tests, s0, left, expected = two_tests(), 0.1, 1.0, []
    for n, t in enumerate(tests):
        left, rows = (left + recovery * (1.0 - left) if n else left), []
        rows.append(1.0 + 0.3 * left)
        u = t.motion.displacement
        for i, _, du in steps(t.motion):
            left *= math.exp(-abs(du) * 0.5 * (abs(u[i - 1]) + abs(u[i])) / U / s0)
            rows.append(1.0 + 0.3 * left)
        expected.append(np.array(rows))
    close(factor(mullins.Work(), {"m": 0.3, "s0": s0, "U": U, "recovery": recovery}, tests), expected)
    assert mullins.Work().fixed(sizes())["U"] == sizes().displacement


def test_mullins_by_cycles_is_the_same_at_all_amplitudes_and_goes_on() -> None:
    t = np.linspace(0.0, 4.0, 401)
    tests = tuple(trial(shaken(a * np.cos(2.0 * np.pi * t)), n) for n, a in enumerate((U, 0.2 * U)))
    for recovery in (0.0, 0.6):
        p = {"m": 0.3, "N0": 3.0, "recovery": recovery, "least": 0.05 * U}
        first, second = factor(mullins.Cycles(), p, tests)
        again = math.exp(-4.0 / 3.0) + recovery * (1.0 - math.exp(-4.0 / 3.0))
        wearing = np.exp(-np.arange(5) / 3.0)
        np.testing.assert_allclose(first[::100], 1.0 + 0.3 * wearing, rtol=ROUNDING)
        np.testing.assert_allclose(second[::100], 1.0 + 0.3 * again * wearing, rtol=ROUNDING)


@pytest.mark.parametrize("recovery", [0.0, 0.4])
def test_pseudo_elastic_softening_is_whole_at_the_largest_deformation(recovery: float) -> None:
    tests, largest, expected, at_most = two_tests(), 0.0, [], []
    for n, t in enumerate(tests):
        largest *= 1.0 - recovery if n else 1.0
        rows = []
        for u in t.motion.displacement:
            largest = max(largest, abs(u))
            at_most.append(abs(u) == largest)
            rows.append(1.0 - 0.2 * erf((largest**2 - u**2) / (3e-3**2 + 0.5 * largest**2)))
        expected.append(np.array(rows))
    found = factor(mullins.PseudoElastic(), {"m": 0.2, "e": 3e-3, "b": 0.5, "recovery": recovery}, tests)
    close(found, expected)
    whole = np.concatenate(found)
    assert set(whole[at_most]) == {1.0} and whole[~np.array(at_most)].max() < 1.0 and whole.min() < 0.85
