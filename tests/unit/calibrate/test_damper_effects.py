"""Damper effects against loops over samples, written from their definitions, and against closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from irregular_motion import (
    ROUNDING,
    SWEPT,
    U,
    close,
    factor,
    motion,
    parallel,
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
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion
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
    even = np.array([3e5 * x * x / 5e-3 for x in u])  # Helmholtz' spring: to one side, whatever the side of u
    close(parallel(one_sided.Even(), {"k": 3e5, "n": 2.0, "r": 5e-3}, (t,)), [even], 3e5 * U)
    # with a spring of power 2 that is odd it is a contact of twice the stiffness
    odd = parallel(hardening.Power(), {"k": 3e5, "p": 2.0, "r": 5e-3}, (t,))[0]
    contact = {"k": 6e5, "u0": 0.0, "n": 2.0, "side": 1.0, "r": 5e-3}
    close(parallel(one_sided.ContactPositive(), contact, (t,)), [even + odd], 6e5 * U)


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
    sides = [form().fixed(sizes())["side"] for form in one_sided.FORMS if "even" not in form.form]
    assert sides == [1.0, -1.0] * 4


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


def test_another_exponent_of_the_power_alone_is_a_law_with_that_exponent() -> None:
    # far above v0 the factor is |v/v0|^n: c_NL |v|^alpha becomes c_NL v0^-n |v|^(alpha + n)
    mgmm, values = LAWS["mgmm"], read_parameters(LAWS["mgmm"], "thesis_table_4_2")
    test = replace(trial(motion(9)), temperature=np.full(motion(9).time.size, 20.0))
    damper = DamperProblem(mgmm, values, (test,), sizes())
    form = velocity_exponent.Exponent().of_power_law()
    candidate = candidate_of(form, sizes(), Left())
    assert candidate is not None and candidate.label == "velocity_exponent.exponent_of_power"
    n, v0 = 0.2, 1e-7
    (found,) = damper.predict(damper.declared, [(candidate, np.array([n, v0]))], ("fit",))
    other = {**values, "c_NL": values["c_NL"] * v0**-n, "alpha": values["alpha"] + n}
    again = DamperProblem(mgmm, other, (test,), sizes())
    (expected,) = again.predict(again.declared, (), ("fit",))
    assert found is not None and expected is not None
    # the factor is linear between samples inside the relaxation, which bends where the velocity passes zero
    assert np.sqrt(np.mean((found - expected) ** 2)) < 3e-3 * np.sqrt(np.mean(expected**2))


def test_a_contact_that_stiffens_on_both_sides_is_a_power_of_the_depth() -> None:
    of = motion(5)
    found = hardening.Contact().parallel({"k": 3e6, "u0": 0.2 * U, "n": 1.5, "r": U}, trial(of), of, {})
    depth = [max(abs(u) - 0.2 * U, 0.0) for u in of.displacement]
    tips = [3e6 * U * (x / U) ** 1.5 for x in depth]
    expected = [math.copysign(tip, u) for tip, u in zip(tips, of.displacement, strict=True)]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=ROUNDING * 3e6 * U)
    assert np.min(found) < 0.0 < np.max(found)


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


# --- all ---

MODULES = (
    *(payne, mullins, hardening, one_sided, relaxation_branch, velocity_exponent),
    *(temperature_law, self_heating, degradation, ageing),
)
AMPLITUDES = {"d", "k", "m", "b", "c", "f", "n", "beta", "rate", "a1"}
FURTHER = {
    "self_heating.core": ("beta_c",),
    "ageing.course": ("a2", "a3"),
}


FORMS = [kind() for module in MODULES for kind in module.FORMS if not kind.begins]  # those have no amplitude


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


def test_softening_that_goes_exponentially_with_amplitude() -> None:
    t = trial(motion(6))
    p = {"d": 0.3, "a0": 4e-3, "m": 1.4, "tau_a": 1e9}  # an envelope that does not fade: the largest so far
    largest = np.maximum.accumulate(np.abs(t.motion.displacement))
    expected = [1.0 - 0.3 * (1.0 - math.exp(-((a / 4e-3) ** 1.4))) for a in largest]
    (found,) = factor(payne.Exponential(), p, (t,))
    np.testing.assert_allclose(found, expected, rtol=1e-6)  # 4 s of 1e9 s, as a share of the amplitude


def test_the_law_with_another_exponent_of_its_own_is_that_law() -> None:
    mgmm, values = LAWS["mgmm"], read_parameters(LAWS["mgmm"], "thesis_table_4_2")
    of = motion(9)
    warm = replace(trial(of), temperature=np.full(of.time.size, 31.0))  # gamma_T takes alpha + n
    damper = DamperProblem(mgmm, values, (warm,), sizes())
    candidate = candidate_of(velocity_exponent.OwnExponent(), sizes(), Left())
    assert candidate is not None
    n, v0 = -0.1, 0.04
    (found,) = damper.predict(damper.declared, [(candidate, np.array([n, v0]))], ("fit",))
    other = {**values, "c_NL": values["c_NL"] * v0**-n, "alpha": values["alpha"] + n}
    again = DamperProblem(mgmm, other, (warm,), sizes())
    (expected,) = again.predict(again.declared, (), ("fit",))
    np.testing.assert_array_equal(found, expected)
