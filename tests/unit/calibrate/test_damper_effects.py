"""Damper effects against loops over samples, written from their definitions, and against closed forms."""

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
    parallel,
    shaken,
    sizes,
    steps,
    trial,
    two_tests,
)

from edesign.calibrate.dampers.drivers import equivalent_cycles, fractional_rate, relaxed
from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import (
    ageing,
    degradation,
    hardening,
    mullins,
    one_sided,
    payne,
    relaxation_branch,
    self_heating,
    temperature_law,
    velocity_exponent,
)
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of, candidates
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes
from edesign.calibrate.fit import Model
from edesign.core.damper import CoreDamper
from edesign.damper.amendments import Amendment
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters

# --- springs ---


def test_springs_beside_the_law_by_their_formulas() -> None:
    t = trial(motion(4))
    u = t.motion.displacement
    power = [2e5 * x * (abs(x) / U) ** 2.5 for x in u]
    close(parallel(hardening.Power(), {"k": 2e5, "p": 3.5, "r": U}, (t,)), [np.array(power)], 2e5 * U)
    threshold = [3e5 * (abs(x) - 4e-3) * math.copysign(1.0, x) if abs(x) > 4e-3 else 0.0 for x in u]
    close(parallel(hardening.Threshold(), {"k": 3e5, "u0": 4e-3}, (t,)), [np.array(threshold)], 3e5 * U)
    exponential = [2e5 * x * (math.exp((x / 6e-3) ** 2) - 1.0) for x in u]
    close(parallel(hardening.Exponential(), {"k": 2e5, "u0": 6e-3}, (t,)), [np.array(exponential)], 2e5 * U)
    length = 1.2 * float(np.max(np.abs(u)))
    gent = [2e5 * x * (1.0 / (1.0 - (x / length) ** 2) - 1.0) for x in u]
    close(parallel(hardening.Gent(), {"k": 2e5, "u_m": length}, (t,)), [np.array(gent)], 2e5 * U)
    above = np.array([3e5 * (x - 2e-3) if x > 2e-3 else 0.0 for x in u])
    below = np.array([3e5 * (x + 2e-3) if x < -2e-3 else 0.0 for x in u])
    assert above.max() > 0.0 > below.min()
    spring = {"k": 3e5, "u0": 2e-3}
    close(parallel(one_sided.SpringPositive(), {**spring, "side": 1.0}, (t,)), [above], 3e5 * U)
    close(parallel(one_sided.SpringNegative(), {**spring, "side": -1.0}, (t,)), [below], 3e5 * U)


def test_chains_longer_than_their_length_keep_the_last_stiffness() -> None:
    t = trial(motion(4))
    (force,) = parallel(hardening.Gent(), {"k": 1.0, "u_m": 0.5 * np.max(np.abs(t.motion.displacement))}, (t,))
    beyond = np.argmax(np.abs(t.motion.displacement))
    assert force[beyond] == pytest.approx(99.0 * t.motion.displacement[beyond], rel=ROUNDING)  # 0.99/(1 - 0.99)


def test_a_factor_acts_on_its_side_alone() -> None:
    t = trial(motion(5))
    (positive,) = factor(one_sided.FactorPositive(), {"b": 0.2, "side": 1.0}, (t,))
    (negative,) = factor(one_sided.FactorNegative(), {"b": 0.2, "side": -1.0}, (t,))
    assert set(positive[t.motion.displacement > 0.0]) == {1.2} and set(positive[t.motion.displacement <= 0.0]) == {1.0}
    assert set(negative[t.motion.displacement < 0.0]) == {1.2} and set(negative[t.motion.displacement >= 0.0]) == {1.0}
    assert [form().fixed(sizes())["side"] for form in one_sided.FORMS] == [1.0, -1.0] * 4


def test_a_soft_factor_goes_over_from_side_to_side() -> None:
    t = trial(motion(5))
    u = t.motion.displacement
    for form, side in ((one_sided.SoftPositive(), 1.0), (one_sided.SoftNegative(), -1.0)):
        (phi,) = factor(form, {"b": 0.2, "side": side, "w": 2e-3}, (t,))
        np.testing.assert_allclose(phi, 1.0 + 0.2 / (1.0 + np.exp(-2.0 * side * u / 2e-3)), rtol=1e-12)
    (narrow,) = factor(one_sided.SoftPositive(), {"b": 0.2, "side": 1.0, "w": 1e-9}, (t,))
    (sharp,) = factor(one_sided.FactorPositive(), {"b": 0.2, "side": 1.0}, (t,))
    off = np.abs(u) > 1e-6
    np.testing.assert_allclose(narrow[off], sharp[off], rtol=1e-12)


def test_a_soft_threshold_is_none_at_rest_and_a_sharp_one_when_narrow() -> None:
    t = trial(motion(6))
    (soft,) = parallel(hardening.Soft(), {"k": 3.0, "u0": 4e-3, "w": 1e-7}, (t,))
    (sharp,) = parallel(hardening.Threshold(), {"k": 3.0, "u0": 4e-3}, (t,))
    np.testing.assert_allclose(soft, sharp, atol=3.0 * 1e-7)  # k w ln 2 at the threshold itself
    rest = replace(t, motion=Motion(*(np.zeros(8) for _ in range(4))), force=np.zeros(8))
    (none,) = parallel(hardening.Soft(), {"k": 3.0, "u0": 4e-3, "w": 3e-3}, (rest,))
    assert np.all(none == 0.0)


def test_a_row_of_branches_is_the_sum_of_its_branches() -> None:
    t = trial(motion(7))
    (row,) = parallel(relaxation_branch.Prony(), {"k": 2e6, "tau": 0.02, "r": 5.0, "p": 0.3}, (t,))
    each = [
        parallel(relaxation_branch.Maxwell(), {"k": 2e6 * 5.0 ** (-0.3 * i), "tau": 0.02 * 5.0**i}, (t,))[0]
        for i in range(4)
    ]
    np.testing.assert_allclose(row, sum(each), rtol=1e-12, atol=1e-6)


def test_an_equivalent_cycle_is_a_path_of_four_amplitudes() -> None:
    # a triangle of one amplitude from its tip on: each turn adds a cycle; the largest so far is the amplitude at once
    time = np.arange(401) / 100.0
    u = U * (2.0 * np.abs(2.0 * (time - np.floor(time + 0.5))) - 1.0) * -1.0
    found = equivalent_cycles(Motion(time, u, np.zeros(401), np.zeros(401)), 0.05 * U)
    np.testing.assert_allclose(found[::100], np.arange(5), atol=1e-12)


def test_a_transition_is_half_way_at_its_middle() -> None:
    t = trial(motion(8), temperature=np.linspace(20.0, 40.0, motion(8).time.size))
    (phi,) = factor(temperature_law.Transition(), {"d": 0.4, "Tc": 30.0, "w": 0.5, "T0": 20.0}, (t,))
    assert np.interp(30.0, t.temperature, phi) == pytest.approx(0.8, abs=1e-6)
    assert phi[0] == pytest.approx(1.0, abs=1e-12) and phi[-1] == pytest.approx(0.6, abs=1e-8)


def test_another_exponent_of_the_power_alone_is_a_law_with_that_exponent() -> None:
    # far above v0 the factor is |v/v0|^n: c_NL |v|^alpha becomes c_NL v0^-n |v|^(alpha + n)
    mgmm, values = LAWS["mgmm"], read_parameters(LAWS["mgmm"], "thesis_table_4_2")
    test = replace(trial(motion(9)), temperature=np.full(motion(9).time.size, 20.0))
    damper = DamperProblem(mgmm, values, None, (test,), sizes())
    form = velocity_exponent.Exponent().of_power_law()
    candidate = candidate_of(form, sizes(), Left())
    assert candidate is not None and candidate.label == "velocity_exponent.exponent_of_power"
    n, v0 = 0.2, 1e-7
    (found,) = damper.predict(damper.declared, [(candidate, np.array([n, v0]))], ("fit",))
    other = {**values, "c_NL": values["c_NL"] * v0**-n, "alpha": values["alpha"] + n}
    again = DamperProblem(mgmm, other, None, (test,), sizes())
    (expected,) = again.predict(again.declared, (), ("fit",))
    assert found is not None and expected is not None
    # the factor is linear between samples inside the relaxation, which bends where the velocity passes zero
    assert np.sqrt(np.mean((found - expected) ** 2)) < 3e-3 * np.sqrt(np.mean(expected**2))


def test_hardening_inside_moves_the_law_by_the_stiffened_motion() -> None:
    # velocity and acceleration of u (1 + b (|u|/r)^p) against central differences of a fine sine: errors (w h)^2 times
    # 1/6 and the slopes' own growth, 4e-6 times a few
    t = np.linspace(0.0, 2.0, 10001)
    w = 10.0
    sine = Motion(t, U * np.sin(w * t), U * w * np.cos(w * t), -U * w * w * np.sin(w * t))
    seen = hardening.Inside().specimen({"b": 0.4, "p": 2.5, "r": U}, trial(sine), sine)
    expected = sine.displacement * (1.0 + 0.4 * np.abs(np.sin(w * t)) ** 2.5)
    np.testing.assert_allclose(seen.displacement, expected, rtol=0.0, atol=ROUNDING * U)
    inner = slice(1, -1)
    rate, bend = np.gradient(expected, t)[inner], np.gradient(np.gradient(expected, t), t)[2:-2]
    np.testing.assert_allclose(seen.velocity[inner], rate, rtol=0.0, atol=2e-5 * U * w)
    np.testing.assert_allclose(seen.acceleration[2:-2], bend, rtol=0.0, atol=2e-4 * U * w * w)


# --- relaxation ---


@pytest.mark.parametrize("tau", [1e-4, 0.03, 2.0, 500.0])
@pytest.mark.parametrize("uneven", [False, True])
def test_branch_is_exact_for_a_velocity_linear_between_samples(tau: float, uneven: bool) -> None:
    # Q' = k v - Q / tau with v linear in a step: particular solution k tau (v - tau v'), plus what decays
    of = motion(6, uneven=uneven)
    q, expected = 0.0, [0.0]
    for i, h, _ in steps(of):
        v0, v1 = of.velocity[i - 1], of.velocity[i]
        slope = (v1 - v0) / h
        q = tau * (v1 - tau * slope) + (q - tau * (v0 - tau * slope)) * math.exp(-h / tau)
        expected.append(q)
    # the solution by parts loses digits with (tau/h)^2, the branch itself does not
    np.testing.assert_allclose(relaxed(of, tau), expected, rtol=0.0, atol=U * (1e-12 + 1e-15 * (tau / 0.005) ** 2))


def test_slow_branch_is_a_spring() -> None:
    of = motion(6)
    trapezoid = np.concatenate(([0.0], np.cumsum(0.5 * (of.velocity[1:] + of.velocity[:-1]) * of.steps)))
    np.testing.assert_allclose(relaxed(of, 1e7), trapezoid, rtol=0.0, atol=1e-6 * U)  # duration / tau = 4e-7


def complex_stiffness(force: np.ndarray, t: np.ndarray, w: float) -> complex:
    """Of the last two cycles of a sine test, over the amplitude U."""
    last = t >= t[-1] - 4.0 * np.pi / w - 1e-12
    columns = np.column_stack((np.sin(w * t[last]), np.cos(w * t[last])))
    real, imaginary = np.linalg.lstsq(columns, force[last], rcond=None)[0]
    return complex(real, imaginary) / U


def sine(w: float, cycles: int, each: int) -> Motion:
    t = np.arange(cycles * each + 1) * (2.0 * np.pi / w / each)
    return Motion(t, U * np.sin(w * t), U * w * np.cos(w * t), -U * w * w * np.sin(w * t))


def test_branch_under_a_sine_has_the_complex_stiffness_of_maxwell() -> None:
    w, tau, k = 5.0, 0.4, 3e6
    of = sine(w, 12, 400)
    (q,) = parallel(relaxation_branch.Maxwell(), {"k": k, "tau": tau}, (trial(of),))
    expected = k * 1j * w * tau / (1.0 + 1j * w * tau)
    # v linear between samples: (w h)^2 / 12 = 2e-5 of the force
    assert abs(complex_stiffness(q, of.time, w) - expected) < 3e-5 * abs(expected)


@pytest.mark.parametrize("alpha", [0.2, 0.5, 0.8])
def test_springpot_under_a_sine(alpha: float) -> None:
    w, k = 5.0, 3e6
    of = sine(w, 30, 400)
    (q,) = parallel(relaxation_branch.Springpot(), {"k": k, "alpha": alpha, "T": 0.3}, (trial(of),))
    expected = k * (0.3j * w) ** alpha
    # scheme L1: (w h)^(2 - alpha), 0.7 % at 0.8; the start fades as (w t)^(-1 - alpha): below 0.2 %
    assert abs(complex_stiffness(q, of.time, w) - expected) < 0.01 * abs(expected)


@pytest.mark.parametrize("alpha", [0.1, 0.5, 0.9])
def test_fractional_rate_of_a_ramp_is_exact(alpha: float) -> None:
    t = np.linspace(3.0, 5.0, 301)
    ramp = Motion(t, 0.2 + 0.7 * (t - 3.0), np.full_like(t, 0.7), np.zeros_like(t))
    expected = 0.7 * (t - 3.0) ** (1.0 - alpha) / math.gamma(2.0 - alpha)
    np.testing.assert_allclose(fractional_rate(ramp, alpha), expected, rtol=0.0, atol=1e-11)


# --- velocity ---


def test_dashpot_and_flow_by_their_formulas() -> None:
    t = trial(motion(7))
    v = t.motion.velocity
    expected = np.array([1e5 * abs(x) ** 0.6 * math.copysign(1.0, x) for x in v])
    close(parallel(velocity_exponent.Dashpot(), {"c": 1e5, "alpha": 0.6}, (t,)), [expected], 1e5)
    slow = parallel(velocity_exponent.Flow(), {"f": 2e3, "v0": 1e4}, (t,))[0]
    np.testing.assert_allclose(slow, 2e3 * v / 1e4, rtol=1e-8)  # a dashpot: next term (v/v0)^2 / 6
    fast = parallel(velocity_exponent.Flow(), {"f": 2e3, "v0": 1e-9}, (t,))[0]
    np.testing.assert_allclose(fast, 2e3 * np.sign(v) * np.log(2.0 * np.abs(v) / 1e-9), rtol=1e-8)


def test_carreau_is_a_dashpot_when_slow_and_a_power_when_fast() -> None:
    # limits of Carreau (1972): next terms (alpha - 1)/2 of (v/v0)^2, or of (v0/v)^2
    t, c = trial(motion(7)), 1e5
    v = t.motion.velocity
    form, moving = velocity_exponent.Carreau(), np.abs(v) > 1e-3
    close(parallel(form, {"c": c, "v0": 0.02, "alpha": 1.0}, (t,)), [c * v], c)
    (slow,) = parallel(form, {"c": c, "v0": 1e4, "alpha": 0.4}, (t,))
    np.testing.assert_allclose(slow, c * v, rtol=1e-8)
    for alpha in (0.4, 2.0):
        (fast,) = parallel(form, {"c": c, "v0": 1e-8, "alpha": alpha}, (t,))
        expected = c * 1e-8 ** (1.0 - alpha) * np.sign(v) * np.abs(v) ** alpha
        np.testing.assert_allclose(fast[moving], expected[moving], rtol=1e-9)
    at = Motion(np.arange(2.0), np.zeros(2), np.array([-0.02, 0.02]), np.zeros(2))
    expected = c * at.velocity * 2.0**-0.3
    close(parallel(form, {"c": c, "v0": 0.02, "alpha": 0.4}, (trial(at),)), [expected], c)


def test_dashpot_dissipates_what_a_sine_tells() -> None:
    # work of a cycle = 4 2^alpha Gamma(1 + alpha/2)^2 / Gamma(2 + alpha)
    # c w^alpha U^(1 + alpha): Soong & Constantinou (1994)
    alpha, w = 0.5, 5.0
    of = sine(w, 1, 4000)
    (force,) = parallel(velocity_exponent.Dashpot(), {"c": 1e5, "alpha": alpha}, (trial(of),))
    work = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(of.displacement)))
    shape = 4.0 * 2.0**alpha * math.gamma(1.0 + alpha / 2.0) ** 2 / math.gamma(2.0 + alpha)
    assert work == pytest.approx(shape * 1e5 * w**alpha * U ** (1.0 + alpha), rel=1e-4)  # trapezoids at the root of v


# --- temperature ---


def test_exponential_follows_the_temperature_within_a_test() -> None:
    of = motion(8)
    warm = np.linspace(18.0, 32.0, of.time.size)
    (phi,) = factor(temperature_law.Exponential(), {"b": 0.03, "T0": 20.0}, (trial(of, 0, warm),))
    close([phi], [np.array([math.exp(-0.03 * (x - 20.0)) for x in warm])])


def test_curved_fall_by_its_formula() -> None:
    of = motion(8)
    warm = np.linspace(12.0, 32.0, of.time.size)
    tests = (trial(of, 0, warm),)
    expected = [np.array([math.exp(-0.03 * (x - 20.0) - 0.001 * (x - 20.0) ** 2) for x in warm])]
    close(factor(temperature_law.Curved(), {"b": 0.03, "c": 0.001, "T0": 20.0}, tests), expected)
    straight = factor(temperature_law.Exponential(), {"b": 0.03, "T0": 20.0}, tests)
    close(factor(temperature_law.Curved(), {"b": 0.03, "c": 0.0, "T0": 20.0}, tests), straight)


@pytest.mark.parametrize(
    ("law", "values"),
    [
        ("zener", {"k0": 1e6, "k1": 2e6, "c1": 2e5}),
        ("fractional_kelvin", {"k0": 1e6, "c": 0.3, "alpha": 0.4}),
        ("maxwell_power", {"c": 4e4, "alpha": 0.5, "k": 5e6}),
        ("bouc_wen", {"Fy": 1e4, "Y": 2e-3, "alpha": 0.1}),
        (
            "mgmm",
            {
                **{"k1": 5.15e5, "c1": 1.51e4, "k0": 1.07e5, "c_NL": 2.1e4, "alpha": 0.374, "k_a": 3.7e6},
                **{"k_b": 3.6e6, "u_ref": 8e-3, "c_a": 9e5, "c_b": 1.9e5, "v_ref": 0.0135, "consistent": 1.0},
            },
        ),
    ],
)
def test_shifted_law_is_the_law_on_another_clock(law: str, values: dict[str, float]) -> None:
    # time-temperature superposition (Ferry 1980, chapter 11): force at T over time t = force at T0 over time t / a_T
    of = motion(9)
    complete = LAWS[law].complete(values)
    a_t = math.exp(-0.06 * 9.0)
    shifted = temperature_law.Shift().law({"b": 0.06, "T0": 20.0}, trial(of, 0, 29.0), complete)
    assert list(shifted) == list(complete)
    warm = CoreDamper(law, tuple(shifted.values())).force(of.time, of.displacement, of.velocity)
    cold = CoreDamper(law, tuple(complete.values())).force(of.time / a_t, of.displacement, of.velocity * a_t)
    # the core sums exponentials over absolute times for fractional derivatives: between clocks 3e-5 here
    np.testing.assert_allclose(warm, cold, rtol=0.0, atol=1e-4 * np.max(np.abs(cold)))
    if law != "bouc_wen":
        plain = CoreDamper(law, tuple(complete.values())).force(of.time, of.displacement, of.velocity)
        assert np.max(np.abs(warm - plain)) > 0.01 * np.max(np.abs(plain))


def test_another_gamma_multiplies_every_parameter_in_the_units_of_the_thesis() -> None:
    # Table 4.2 by hand: c_NL is in kN (s/mm)^alpha there, and alpha changes too
    printed = {
        "k1": 0.515,
        "c1": 0.0151,
        "k0": 0.107,
        "k_a": 3.741,
        "k_b": 3.613,
        "c_a": 0.902,
        "c_b": 0.190,
    }  # kN, mm, s
    rest = {"u_ref": 7.966e-3, "v_ref": 13.468e-3, "alpha": 0.374, "consistent": 0.0}
    values = {**{name: 1e6 * value for name, value in printed.items()}, **rest}
    values["c_NL"] = 1.585e3 * 1e3**0.374
    b, c, of = 0.02, -5e-4, motion(3)
    for form, gamma in (
        (temperature_law.Gamma(), math.exp(-b * 9.0)),
        (temperature_law.GammaCurved(), math.exp(-b * 9.0 - c * 81.0)),
    ):
        found = form.law({"b": b, "c": c, "T0": 20.0}, trial(of, 0, 29.0), values)
        assert found.keys() == values.keys()
        for name in (*printed, "u_ref", "v_ref", "alpha"):
            assert found[name] == pytest.approx(gamma * values[name], rel=1e-12)
        assert found["c_NL"] == pytest.approx(1.585e3 * gamma * 1e3 ** (0.374 * gamma), rel=1e-12)
        assert found["consistent"] == 0.0
        other = {"k": 1e6, "c": 2e4}
        assert form.law({"b": b, "c": c, "T0": 20.0}, trial(of, 0, 29.0), other) == other


def test_one_temperature_shows_no_temperature_law() -> None:
    alike = Sizes.of((trial(motion(1), 0, 20.0), trial(motion(2), 1, 20.5)))
    for form in (kind() for kind in temperature_law.FORMS):
        assert form.unknowns(alike) == () and form.starts(alike) == ()
        assert form.unknowns(sizes())


# --- work ---


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


def test_heat_without_loss_comes_to_the_closed_form() -> None:
    # exp(q) = 1 + beta X, X the work of the law; the explicit step is late by one sample: errors go with the step
    beta, errors = 1e-2, []
    for n in (2000, 4000):
        t = np.linspace(0.0, 5.0, n)
        of = Motion(t, U * np.sin(5.0 * t), 5.0 * U * np.cos(5.0 * t), -25.0 * U * np.sin(5.0 * t))
        test = trial(of)
        w = 5.0
        damping = 2e4 * U * U * w * (w * t / 2.0 + np.sin(2.0 * w * t) / 4.0)
        exact = 1.0 / (1.0 + beta * (damping + 0.5 * STIFFNESS * of.displacement**2))
        (phi,) = factor(self_heating.Rate(), {"beta": beta, "tau_h": 1e12}, (test,))
        errors.append(float(np.max(np.abs(phi - exact))))
    assert errors[0] < 0.02
    assert errors[1] == pytest.approx(0.5 * errors[0], rel=0.05)


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
    course = {"a1": 0.3, "a2": -0.1, "a3": 0.2, "N": 6.0}
    found = [factor(ageing.Course(), course, (trial(motion(1), n),))[0] for n in range(7)]
    assert all(len(set(phi)) == 1 for phi in found)
    expected = [1.0, 1.15, 1.3, 1.1, 0.9, 1.05, 1.2]  # knots at tests 0, 2, 4, 6 and half way between them
    np.testing.assert_allclose([phi[0] for phi in found], expected, rtol=ROUNDING)
    assert ageing.Course().fixed(sizes(7)) == {"N": 6.0} and ageing.Course().unknowns(sizes(6))
    assert ageing.Course().unknowns(sizes(5)) == () and ageing.Course().starts(sizes(5)) == ()


def test_ageing_goes_with_the_order_of_the_tests() -> None:
    of = motion(1)
    for n in (0, 1, 7):
        (linear,) = factor(ageing.Linear(), {"rate": -0.02}, (trial(of, n),))
        (slowing,) = factor(ageing.Logarithmic(), {"rate": 0.05}, (trial(of, n),))
        assert set(linear) == {1.0 - 0.02 * n}
        assert set(slowing) == {1.0 + 0.05 * math.log1p(n)}
    pair = Sizes.of(two_tests())
    assert ageing.Linear().starts(pair) and not ageing.Logarithmic().starts(pair)


# --- springs and dashpots apart ---


def test_kraus_softens_springs_and_gives_dashpots_a_hump() -> None:
    test = trial(motion(11))
    p = {"d": 0.3, "a0": 4e-3, "m": 1.4, "tau_a": 2.0, "h": 0.5}
    a, broken = 0.0, []
    for i, u in enumerate(test.motion.displacement):
        h = test.motion.time[i] - test.motion.time[i - 1] if i else 0.0
        a = max(abs(u), a * math.exp(-h / p["tau_a"]))
        broken.append((a / p["a0"]) ** p["m"] / (1.0 + (a / p["a0"]) ** p["m"]))
    g = np.array(broken)
    phi, phi2 = 1.0 - 0.3 * g, (1.0 - 0.3 * g) * (1.0 + 2.0 * 0.5 * np.sqrt(g * (1.0 - g)))
    size, rest = sizes(), [np.zeros_like(test.force)]
    (kraus,) = (c for c in candidates(size, Left((test,), rest), False, True) if c.label == "payne.kraus")
    assert not [c for c in candidates(size, Left((test,), rest), False, False) if c.label == "payne.kraus"]
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, None, (test,), size)
    values = np.array([p[unknown.name] for unknown in kraus.unknowns])
    (found,) = solid.predict(solid.declared, [(kraus, values)], ("fit",))
    expected = STIFFNESS * test.motion.displacement * phi + 2e4 * test.motion.velocity * phi2
    assert found is not None and g.max() - g.min() > 0.2
    # the core's first sample is that of a law at rest before: 1e-6 N
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_of_loss_changes_dashpots_alone() -> None:
    warm = replace(trial(motion(11)), temperature=np.full(motion(11).time.size, 26.0))
    size, rest = replace(sizes(), temperatures=(20.0, 26.0)), [np.zeros_like(warm.force)]
    found = {c.label: c for c in candidates(size, Left((warm,), rest), False, True)}
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, None, (warm,), size)
    springs, dashpots = STIFFNESS * warm.motion.displacement, 2e4 * warm.motion.velocity
    phi = math.exp(-0.03 * 6.0)
    for label, values, expected in (
        ("temperature_law.exponential", (0.03,), phi * (springs + dashpots)),
        ("temperature_law.exponential_of_loss", (0.03,), springs + phi * dashpots),
        ("temperature_law.exponential_loss", (0.03, 2.0), phi * springs + phi**2 * dashpots),
    ):
        (force,) = solid.predict(solid.declared, [(found[label], np.array(values))], ("fit",))
        np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_a_curve_of_its_own_bends_all_of_a_law_that_has_no_sides() -> None:
    test = replace(trial(motion(12)), temperature=np.full(motion(12).time.size, 26.0))
    size = replace(sizes(), temperatures=(20.0, 26.0))
    zener = LAWS["zener"]
    values = {parameter.name: 1e6 for parameter in zener.parameters}
    solid = DamperProblem(zener, values, None, (test,), size)
    plain = candidate_of(temperature_law.Exponential(), size, Left())
    assert plain is not None
    (fine,) = solid.finer((plain, np.array([0.03])))
    assert [unknown.name for unknown in fine[0].unknowns] == ["b", "c"]  # springs and dashpots are not told apart
    (law_force,) = solid.predict(solid.declared, (), ("fit",))
    s = math.exp(-0.03 * 6.0) - 1.0
    for c in (0.0, 2.0):
        (force,) = solid.predict(solid.declared, [(fine[0], np.array([0.03, c]))], ("fit",))
        np.testing.assert_allclose(force, (1.0 + s + c * s**2) * law_force, rtol=1e-12)


def test_heat_from_before_a_test_is_each_tests_own() -> None:
    # no heat by work (beta = 0): what was there fades, F = exp(-q0 exp(-t/tau)) F_law; the shares are linear in q0
    tests = two_tests()
    q0, tau, size = (1e-3, -0.4e-3), 3.0, sizes()
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, None, tests, size)
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


def test_work_that_springs_give_back_is_evened_out() -> None:
    # q = a t acts as a (t - tau_w (1 - exp(-t/tau_w))), and a swing of q is smaller by 1/sqrt(1 + (w tau_w)^2)
    form = next(other for other in self_heating.Rate().finer() if other.form == "rate_evened")
    of = motion(13)
    t, tau = of.time - of.time[0], 0.3
    soft = form._of_heat({"tau_w": tau}, of)  # type: ignore[attr-defined]
    step = float(np.max(of.steps))
    np.testing.assert_allclose(soft(0.1 * t), np.exp(-0.1 * (t + tau * np.expm1(-t / tau))), atol=0.1 * step)
    assert soft(np.full(t.size, 0.2)) == pytest.approx(math.exp(-0.2), rel=1e-12)


def test_an_error_of_the_thermometer_is_no_residual() -> None:
    # forces 0.2 K off by the law's own gamma_T: all of the residual, and what such an error is taken to leave
    test = replace(trial(motion(11)), temperature=np.full(motion(11).time.size, 25.0))
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, None, (test,), sizes())
    change = 0.002 * STIFFNESS * test.motion.displacement
    size = 1e-4 * STIFFNESS * U
    noisy = change + size * np.random.default_rng(1).standard_normal(change.size)
    (solid_force,) = solid.predict(solid.declared, (), ("fit",))
    assert solid_force is not None
    known = replace(test, force=solid_force + noisy, warmth=change)
    for one, low, high in ((replace(known, warmth=None), 10.0, math.inf), (known, 0.8, 1.2)):
        problem = replace(solid, trials=(one,))
        (residual,) = Model(problem, (size,)).residuals(Model(problem, (size,)).coordinates())
        assert low < problem.left([residual], [size]) < high  # noise in the few bins of the band of the motion


def test_hump_of_kraus_is_h_where_half_is_broken() -> None:
    held = shaken(np.full(3, 4e-3))
    p = {"d": 0.3, "a0": 4e-3, "m": 1.4, "tau_a": 2.0, "h": 0.5}
    form = payne.Kraus()
    (phi,) = factor(form, p, (trial(held),))
    dashpots = form.dashpot_factor(p, held, phi)
    assert phi[0] == pytest.approx(1.0 - 0.5 * 0.3, rel=ROUNDING)
    assert np.asarray(dashpots)[0] == pytest.approx((1.0 - 0.5 * 0.3) * (1.0 + 0.5), rel=ROUNDING)


def test_mean_square_forgets_a_held_deformation_exponentially() -> None:
    """a^2 = 2 u^2 (1 - exp(-t/tau)) of u held since the test began; in steady cycles far faster than tau, a = u0."""
    p = {"d": 1.0, "a0": 4e-3, "m": 2.0, "tau_a": 3.0}
    held = shaken(np.full(300, 4e-3))
    (phi,) = factor(payne.MeanSquare(), p, (trial(held),))
    square = 2.0 * -np.expm1(-(held.time - held.time[0]) / 3.0)
    np.testing.assert_allclose(phi, 1.0 / (1.0 + square), rtol=ROUNDING)
    cycles = shaken(4e-3 * np.sin(2.0 * math.pi * np.arange(4001) / 20.0))
    (phi,) = factor(payne.MeanSquare(), p | {"tau_a": 1.0}, (trial(cycles),))  # 200 cycles in 10 s
    # of the beginning exp(-10) is left, and a^2 swings by 1/(2 w tau) = 0.4 %
    assert np.mean(phi[-100:]) == pytest.approx(0.5, rel=5e-3)


# --- all ---

MODULES = (
    *(payne, mullins, hardening, one_sided, relaxation_branch, velocity_exponent),
    *(temperature_law, self_heating, degradation, ageing),
)
AMPLITUDES = {"d", "k", "m", "b", "c", "f", "n", "beta", "rate", "a1"}
FURTHER = {
    "self_heating.core": ("beta_c",),
    "temperature_law.curved": ("c",),
    "temperature_law.gamma_curved": ("c",),
    "ageing.course": ("a2", "a3"),
}


FORMS = [kind() for module in MODULES for kind in module.FORMS]


@pytest.mark.parametrize("form", FORMS, ids=lambda form: f"{form.name}.{form.form}")
def test_an_amplitude_of_zero_changes_nothing(form: Form) -> None:
    size = sizes(7)
    p = {u.name: v for u, v in zip(form.unknowns(size), form.starts(size)[0], strict=True)} | dict(form.fixed(size))
    first = form.unknowns(size)[0].name
    assert first in AMPLITUDES and p[first] != 0.0
    p.update(dict.fromkeys((first, *FURTHER.get(f"{form.name}.{form.form}", ())), 0.0))
    memory: dict[str, float] = {}
    for t in two_tests():
        beside, phi = form.parallel(p, t, t.motion, memory), form.factor(p, t, t.motion, t.force, memory)
        assert beside is None or not np.any(beside)
        assert phi is None or np.all(np.asarray(phi) == 1.0)
        seen = form.specimen(p, t, t.motion)
        assert np.array_equal(seen.displacement, t.motion.displacement)
        assert np.array_equal(seen.velocity, t.motion.velocity)
        values = LAWS["zener"].complete({"k0": 1e6, "k1": 2e6, "c1": 2e5})
        assert form.law(p, t, values) == values


@pytest.mark.parametrize(
    "form", [form for form in FORMS if form.amendment], ids=lambda form: f"{form.name}.{form.form}"
)
def test_a_law_file_carries_the_same_effect_into_the_core(form: Form) -> None:
    size = sizes(5) if form.name == "ageing" else sizes()
    p = {u.name: v for u, v in zip(form.unknowns(size), form.starts(size)[-1], strict=True)} | dict(form.fixed(size))
    of = motion(10)
    values = LAWS["zener"].complete({"k0": 1e6, "k1": 2e6, "c1": 2e5})
    law = Damper(LAWS["zener"], values).force(of.time, of.displacement, of.velocity)
    test = trial(of, int(p.get("n", 0)), 26.0)
    phi, beside = form.factor(p, test, of, law, {}), form.parallel(p, test, of, {})
    expected = (1.0 if phi is None else phi) * law + (0.0 if beside is None else beside)
    amendment = Amendment(form.name, getattr(form, "amendment_form", form.form), p)
    amended = Damper(LAWS["zener"], values, amendments=(amendment,), temperature_C=26.0)
    found = amended.force(of.time, of.displacement, of.velocity)
    # independent code in C that takes step by step: but for effects by work, rounding
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=SWEPT * np.max(np.abs(law)))
    assert np.max(np.abs(found - law)) > 1e-3 * np.max(np.abs(law))


def test_a_bend_of_another_exponent_goes_from_a_smooth_one_to_a_corner() -> None:
    test = trial(motion(3))
    v = np.abs(test.motion.velocity) / 0.1
    (smooth,) = factor(velocity_exponent.Bend(), {"n": -0.3, "v0": 0.1, "a": 2.0}, (test,))
    (same,) = factor(velocity_exponent.Exponent(), {"n": -0.3, "v0": 0.1}, (test,))
    np.testing.assert_allclose(smooth, same, rtol=1e-12)
    (sharp,) = factor(velocity_exponent.Bend(), {"n": -0.3, "v0": 0.1, "a": 20.0}, (test,))
    # largest at the corner: 2^(n/a)
    np.testing.assert_allclose(sharp, np.maximum(v, 1.0) ** -0.3, rtol=1.0 - 2.0 ** (-0.3 / 20.0) + 1e-9)
    at_rest = replace(test, motion=replace(test.motion, velocity=np.zeros_like(v)))
    np.testing.assert_array_equal(factor(velocity_exponent.Bend(), {"n": 0.5, "v0": 0.1, "a": 3.0}, (at_rest,))[0], 1.0)
