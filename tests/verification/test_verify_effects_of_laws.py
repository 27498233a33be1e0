"""Laws with effects: histories against their definitions, frames against another integrator, sizes, braces."""

from __future__ import annotations

import damper_effects as definitions
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from edesign.core import Analysis, Channel, CoreDamper, CoreError, EffectValues, LawValues, Model
from edesign.core.damper import PLACEMENTS
from edesign.damper.damper import Damper
from edesign.damper.effects import LawEffect
from edesign.damper.harmonic import complex_stiffness
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters

ZENER = {"k0": 3e6, "k1": 6e6, "c1": 6e5}
BOUC_WEN = {"Fy": 2e4, "Y": 2e-3, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 2.0}
MGMM = read_parameters(law("mgmm"), "thesis_table_4_2")
LAWS = {"zener": ZENER, "mgmm": MGMM, "bouc_wen": BOUC_WEN}
TIME = np.cumsum(np.concatenate(([0.3], np.tile([0.01, 0.004, 0.02], 150))))
U = 6e-3 * np.sin(3.0 * TIME) * np.exp(-0.1 * TIME) + 1e-3 * np.sin(11.0 * TIME + 0.4)
V = np.gradient(U, TIME)  # not zero at the start


TAU = {"mgmm": MGMM["c1"] / MGMM["k1"], "zener": 0.0, "bouc_wen": 0.0}
PLACED_IN = {"mgmm": PLACEMENTS, "zener": ("whole", "springs", "dashpots"), "bouc_wen": ("whole",)}


def check_law_with(name: str, effects: tuple[LawEffect, ...], temperature_C: float | None = None) -> None:
    plain = Damper(law(name), LAWS[name])
    damper = Damper(law(name), LAWS[name], effects=effects, temperature_C=temperature_C)
    own = plain.force(TIME, U, V)
    springs, tau = None, TAU[name]
    if any(one.placement in ("springs", "dashpots") for one in effects):
        of, values = definitions.springs_of(name, LAWS[name])
        springs = Damper(law(of), values).force(TIME, U, V)
    expected = definitions.with_effects(effects, own, TIME, U, V, temperature_C, tau, springs)
    peak = np.max(np.abs(expected))
    # rounding over 450 steps, a jump in 1e-9 of a step; inside, what is left of coming to the beginning within 1e7 tau
    tolerance = 1e-6 if tau and any(one.placement != "whole" for one in effects) else 1e-11
    assert np.max(np.abs(damper.force(TIME, U, V) - expected)) < tolerance * peak
    assert np.max(np.abs(expected - own)) > 1e-3 * peak


@pytest.mark.parametrize(("name", "form", "placement"), definitions.PLACED)
def test_a_history_is_that_of_the_definition_on_the_samples(name, form, placement):
    for of in ("zener", "mgmm"):
        if placement in PLACED_IN[of]:
            check_law_with(of, (definitions.example(name, form, placement),), 30.0)


@pytest.mark.parametrize("name", LAWS)
def test_all_effects_act_together(name):
    every = tuple(definitions.example(*one) for one in definitions.PLACED if one[2] in PLACED_IN[name])
    check_law_with(name, every, 12.0)


def test_the_equations_of_a_law_give_the_same_as_its_exact_step():
    every = tuple(definitions.example(*placed) for placed in definitions.PLACED)
    damper = Damper(law("mgmm"), MGMM, effects=every)
    exact = damper.force(TIME, U, V)
    # relative tolerance of SUNDIALS 1e-6; the work is counted with its force
    assert np.max(np.abs(damper.force(TIME, U, V, method="ode") - exact)) < 1e-5 * np.max(np.abs(exact))


def test_a_damper_held_at_a_deformation_has_gone_no_way():
    path = Damper(law("zener"), ZENER, effects=(definitions.example("mullins", "path"),))
    force = path.force([0.0, 0.5], [2e-3, 2e-3], [0.0, 0.0])
    assert force == pytest.approx(np.full(2, 1.4 * 2e-3 * ZENER["k0"]), rel=1e-5)  # the spring alone, virgin


def test_a_damper_with_effects_and_a_brace_balances_with_it():
    """Spring k and hardening one, in series with a brace: the root of kb (u - x) = k x + kh x (|x|/r)^(p-1)."""
    k, kb, hardening = 4e6, 5e6, definitions.example("hardening", "power")
    damper = Damper(law("kelvin_voigt"), {"k": k, "c": 0.0}, brace=kb, effects=(hardening,))
    p = hardening.values
    for i, force in enumerate(damper.force(TIME, U, V)):
        u = U[i]
        x = brentq(
            lambda x, u=u: k * x + p["k"] * x * (abs(x) / p["r"]) ** (p["p"] - 1.0) - kb * (u - x),
            -1.0,
            1.0,
            xtol=1e-16,
        )
        assert force == pytest.approx(kb * (u - x), abs=1e-8 * kb * 7e-3)  # balance to 1e-9


def test_a_law_of_equations_refuses_effects_with_a_brace():
    constant = (EffectValues("constant", (0.9,)),)
    with pytest.raises(CoreError, match="effect constant: law maxwell_power .* the brace must be rigid"):
        CoreDamper("maxwell_power", [3e5, 0.5, 4e7], 1e7, constant)


def test_inside_a_law_that_does_not_relax_all_of_its_forces_there_is_no_place():
    hardening = (EffectValues("hardening.power", (1e6, 3.0, 5e-3), "inside"),)
    with pytest.raises(CoreError, match="effect hardening.power: it can stand inside .* but law zener does not"):
        CoreDamper("zener", list(ZENER.values()), effects=hardening)


def test_a_power_of_the_velocity_inside_the_mgmm_is_its_own():
    """c |v|^alpha sgn v inside is c_NL |v|^alpha sgn v (thesis Eq. 4.23), but for taking it as linear over a step."""
    without = MGMM | {"c_NL": 0.0}
    dashpot = LawEffect("velocity_exponent", "dashpot", {"c": MGMM["c_NL"], "alpha": MGMM["alpha"]}, "inside")
    errors = []
    for dt in (4e-3, 5e-4):
        t = np.arange(round(3.0 / dt) + 1) * dt
        u, v = 6e-3 * (1.0 - np.cos(5.0 * t)), 3e-2 * np.sin(5.0 * t)
        own = Damper(law("mgmm"), MGMM).force(t, u, v)
        found = Damper(law("mgmm"), without, effects=(dashpot,)).force(t, u, v)
        errors.append(np.max(np.abs(found - own)) / np.max(np.abs(own)))
    assert errors[0] < 1e-3
    # of order 1 + alpha = 1.37 where the velocity passes zero: 0.06 by an eighth of the step, and by where in it
    assert errors[1] < 0.15 * errors[0]
    plain = Damper(law("mgmm"), without).force(t, u, v)
    assert np.max(np.abs(plain - own)) > 0.05 * np.max(np.abs(own))


# ---- closed forms of effects of the deformation


def cycles(amplitude: float, n: int = 4000) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Five cycles of a sine of 1 rad/s."""
    t = np.linspace(0.0, 10.0 * np.pi, 5 * n + 1)
    return t, amplitude * np.sin(t), amplitude * np.cos(t)


def beside_a_spring(effect: LawEffect, t: np.ndarray, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Force (n,) N of what stands beside a spring of 1 MN/m, or of that spring with a factor."""
    return Damper(law("kelvin_voigt"), {"k": 1e6, "c": 0.0}, effects=(effect,)).force(t, u, v)


def work_of_last_cycle(force: np.ndarray, u: np.ndarray) -> float:
    n = (u.size - 1) // 5
    return float(np.trapezoid(force[-n - 1 :], u[-n - 1 :]))


def test_friction_that_grows_with_the_deformation_dissipates_a_bow_tie():
    """Sliding at once: 4 times the area under F_y (u/r)^n up to a, 4 F_y a^(n+1)/((n+1) r^n)."""
    f, r, a = 5e3, 4e-3, 6e-3
    for n in (1.0, 2.0):
        one = LawEffect("hysteresis", "stretch", {"F_y": f, "Y": 1e-7, "n": n, "r": r})
        t, u, v = cycles(a)
        found = work_of_last_cycle(beside_a_spring(one, t, u, v), u)
        # trapezia over 4000 steps, and the way 1e-7 m after each turn
        assert found == pytest.approx(4.0 * f * a ** (n + 1.0) / ((n + 1.0) * r**n), rel=1e-3)


def test_a_dashpot_of_the_position_dissipates_as_that_of_van_der_pol():
    """c (u/r)^2 u' at a sin(w t): pi c w a^4/(4 r^2) in a cycle."""
    c, r, a = 3e5, 4e-3, 6e-3
    one = LawEffect("velocity_exponent", "position", {"c": c, "alpha": 1.0, "q": 2.0, "r": r})
    t, u, v = cycles(a)
    found = work_of_last_cycle(beside_a_spring(one, t, u, v), u)
    assert found == pytest.approx(np.pi * c * a**4 / (4.0 * r**2), rel=1e-6)  # trapezia of a periodic function


@pytest.mark.parametrize(("beta", "gamma"), [(-900.0, 700.0), (300.0, 300.0), (0.0, 500.0), (-500.0, 500.0)])
def test_a_bouc_wen_branch_bends_as_its_equation_says(beta, gamma):
    """dz/du = 1 - gamma |z| sgn(z du) - beta |z| by another integrator; from zero (1 - exp(-s u))/s, s their sum."""
    one = LawEffect("hysteresis", "bouc_wen", {"k": 2e6, "beta": beta, "gamma": gamma})
    t, u, v = cycles(2e-3, 400)
    found = (beside_a_spring(one, t, u, v) - 1e6 * u) / 2e6
    out, s = 100, beta + gamma
    way = u[1 : out + 1]  # a history comes to its first sample within 1e-9 of a step
    assert found[1 : out + 1] == pytest.approx(-np.expm1(-s * way) / s if s else way, rel=1e-8)

    def rate(x: float, z: np.ndarray) -> np.ndarray:
        w = 2e-3 * np.cos(x)
        return w - gamma * abs(w) * z - beta * w * abs(z)

    exact = solve_ivp(rate, (0.0, t[-1]), [0.0], t_eval=t, rtol=1e-9, atol=1e-13, max_step=0.01).y[0]
    # cubics with exact velocities follow the sine to h^4/384 of its amplitude
    assert np.max(np.abs(found - exact)) < 1e-6 * np.max(np.abs(exact))


def test_slip_widens_with_the_largest_deformation():
    """At rest the share d is gone, at the largest deformation exp(-1/w^2) of it; small cycles are slack after large
    ones alone."""
    one = LawEffect("pinching", "slip", {"d": 0.6, "w": 0.3})
    t = np.linspace(0.0, 6.0 * np.pi, 6001)
    sizes = np.where((t >= 2.0 * np.pi) & (t < 4.0 * np.pi), 5e-3, 1e-3)
    factor = beside_a_spring(one, t, sizes * np.sin(t), sizes * np.cos(t)) / np.where(
        t > 0.0, 1e6 * sizes * np.sin(t), 1.0
    )
    first, last = (int(round((turns + 0.25) * 2000)) for turns in (0.0, 2.0))
    assert factor[first] == pytest.approx(1.0 - 0.6 * np.exp(-1.0 / 0.09), rel=1e-9)
    assert factor[last] == pytest.approx(1.0 - 0.6 * np.exp(-((0.2 / 0.3) ** 2)), rel=1e-6)  # a fifth of the largest


def test_a_spring_that_saturates_has_its_stiffness_and_its_force():
    one = LawEffect("hardening", "saturating", {"k": 4e6, "u0": 1e-4})
    t, u, v = cycles(5e-3, 400)
    force = beside_a_spring(one, t, u, v) - 1e6 * u
    assert np.max(force) == pytest.approx(400.0, rel=1e-9)  # k u0
    near = np.abs(u) < 1e-6
    # (u/u0)^2/3, and what a history begins with, 1e-9 of a step
    assert force[near] == pytest.approx(4e6 * u[near], rel=1e-4, abs=1e-6)


# ---- in a frame

MASS, STIFFNESS = 1000.0, 1000.0 * (2.0 * np.pi) ** 2  # T = 1 s
CHANNELS = (
    Channel("u", ((1.0, "displacement", 1, 0),)),
    Channel("v", ((1.0, "velocity", 1, 0),)),
    Channel("force", ((1.0, "damper_force", 0, 0),)),
)
FRAME_LAW = (0.3 * STIFFNESS, 0.5 * STIFFNESS, 0.05 * STIFFNESS)
FRAME_EFFECTS = (
    LawEffect("payne", "whole", {"d": 0.3, "a0": 0.04, "m": 1.2, "tau_a": 3.0}),
    LawEffect("mullins", "path", {"m": 0.5, "s0": 0.5}),
    LawEffect("degradation", "energy", {"d": 0.3, "E0": 100.0}),
    LawEffect("self_heating", "rate", {"beta": 2e-3, "tau_h": 5.0}),
    LawEffect("hardening", "power", {"k": 0.2 * STIFFNESS, "p": 3.0, "r": 0.05}),
    LawEffect("relaxation_branch", "maxwell", {"k": 0.2 * STIFFNESS, "tau": 0.3}),
    LawEffect("velocity_exponent", "dashpot", {"c": 0.005 * STIFFNESS, "alpha": 1.5}),
)


def shaking(dt: float, duration: float = 4.0) -> np.ndarray:
    t = np.arange(round(duration / dt) + 1) * dt
    return 2.0 * np.sin(5.0 * t) * np.exp(-0.3 * t) + np.sin(17.0 * t + 0.3)


def run(law_values: LawValues, dt: float, brace: float = 0.0, scales: tuple[float, float] = (1.0, 1.0)):
    """A mass on a spring with a damper beside it."""
    model = Model()
    ground, mass = model.node("ground", 0.0, 0.0), model.node("mass", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(mass, False, True, True)
    model.mass(mass, MASS)
    model.link("spring", ground, mass, (STIFFNESS, 0.0, 0.0))
    model.damper("damper", law_values, ((1.0, mass, 0), (-1.0, ground, 0)), brace, *scales)
    analysis = Analysis(model, tolerance=1e-10)
    analysis.install_dampers()
    return analysis.history(shaking(dt), dt, channels=CHANNELS)


def core_law(effects: tuple[LawEffect, ...]) -> LawValues:
    return LawValues("zener", FRAME_LAW, tuple(one.for_core() for one in effects))


def test_an_oscillator_follows_the_differential_equations_of_its_damper_with_effects():
    """The definitions for short steps: s' = |v|, E' = F v, q' = beta F v - q/tau_h with all of the force F, a' = |v| or
    -a/tau_a."""
    k0, k1, c1 = FRAME_LAW
    payne, mullins, degradation, heating, hardening, branch, dashpot = (one.values for one in FRAME_EFFECTS)

    def rates(time, y):
        u, v, q1, s, energy, heat, q2, a = y
        ratio = (max(a, abs(u), 0.0) / payne["a0"]) ** payne["m"]
        phi = 1.0 - payne["d"] * ratio / (1.0 + ratio)
        phi *= 1.0 + mullins["m"] * np.exp(-s / mullins["s0"])
        phi *= 1.0 - degradation["d"] * (1.0 - np.exp(-max(energy, 0.0) / degradation["E0"]))
        law_force = phi * np.exp(-heat) * (k0 * u + q1)
        beside = hardening["k"] * u * (abs(u) / hardening["r"]) ** 2 + q2
        beside += dashpot["c"] * abs(v) ** 1.5 * np.sign(v)
        ground = 2.0 * np.sin(5.0 * time) * np.exp(-0.3 * time) + np.sin(17.0 * time + 0.3)
        acceleration = -(STIFFNESS * u + law_force + beside) / MASS - ground
        grows = abs(u) >= a and u * v > 0.0
        return [
            v,
            acceleration,
            k1 * v - k1 / c1 * q1,
            abs(v),
            (law_force + beside) * v,
            heating["beta"] * (law_force + beside) * v - heat / heating["tau_h"],
            branch["k"] * v - q2 / branch["tau"],
            abs(v) if grows else -a / payne["tau_a"],
        ]

    dt = 0.0025
    t = np.arange(1601) * dt
    exact = solve_ivp(rates, (0.0, t[-1]), [0.0] * 8, t_eval=t, rtol=1e-7, atol=1e-10, max_step=dt)
    found = run(core_law(FRAME_EFFECTS), dt)
    peak = np.max(np.abs(exact.y[0]))
    # Newmark: (omega dt)^2 / 12 a cycle; drivers of the step's beginning: dt over the seconds in which they change
    assert np.max(np.abs(found.values["u"] - exact.y[0])) < 1e-3 * peak
    plain = run(core_law(()), dt)
    assert np.max(np.abs(plain.values["u"] - exact.y[0])) > 0.1 * peak


def test_an_oscillator_follows_the_equations_of_springs_dashpots_and_friction():
    """m u'' + K u + phi_s k u + phi_d c u' + F_c z/x0 = -m a, s' = |u'|, z' = u' - |u'| z/x0."""
    k, c = 0.4 * STIFFNESS, 0.03 * STIFFNESS
    softer = LawEffect("mullins", "path", {"m": 0.6, "s0": 0.3}, "springs")
    weaker = LawEffect("degradation", "path", {"d": 0.3, "s0": 0.5}, "dashpots")
    friction = LawEffect("friction", "presliding", {"F_c": 4e-3 * STIFFNESS, "x0": 8e-3})
    p = friction.values

    def rates(time, y):
        u, v, s, z = y
        worn = 1.0 - 0.3 * (1.0 - np.exp(-s / 0.5))
        force = (1.0 + 0.6 * np.exp(-s / 0.3)) * k * u + worn * c * v + p["F_c"] * z / p["x0"]
        ground = 2.0 * np.sin(5.0 * time) * np.exp(-0.3 * time) + np.sin(17.0 * time + 0.3)
        return [v, -(STIFFNESS * u + force) / MASS - ground, abs(v), v - abs(v) * z / p["x0"]]

    dt = 0.0025
    t = np.arange(1601) * dt
    exact = solve_ivp(rates, (0.0, t[-1]), [0.0] * 4, t_eval=t, rtol=1e-7, atol=1e-10, max_step=dt)
    values = LawValues("kelvin_voigt", (k, c), tuple(one.for_core() for one in (softer, weaker, friction)))
    found = run(values, dt).values["u"]
    peak = np.max(np.abs(exact.y[0]))
    # Newmark: (omega dt)^2 / 12 a cycle; friction changes within a few steps at a turn
    assert np.max(np.abs(found - exact.y[0])) < 1e-3 * peak
    for left in range(3):
        others = tuple(one for i, one in enumerate(values.effects) if i != left)
        other = run(LawValues("kelvin_voigt", (k, c), others), dt).values["u"]
        assert np.max(np.abs(other - exact.y[0])) > 5e-3 * peak


def inside_law() -> LawValues:
    """An MGMM of the same sizes, tau = 0.1 s, with effects inside, on its sides and beside it."""
    k = STIFFNESS
    values = (0.5 * k, 0.05 * k, 0.3 * k, 0.002 * k, 0.6, 0.1 * k, 0.05 * k, 0.05, 0.01 * k, 0.01 * k, 0.3, 0.0)
    inside = (
        LawEffect("payne", "network", {"d": 0.3, "s0": 0.1, "tau": 1.0}, "inside"),
        LawEffect("mullins", "path", {"m": 0.5, "s0": 0.5}, "inside"),
        LawEffect("hardening", "power", {"k": 0.2 * k, "p": 3.0, "r": 0.05}, "inside"),
        LawEffect("velocity_exponent", "flow", {"f": 1e-3 * k, "v0": 0.05}, "inside"),
        LawEffect("payne", "exponential", {"d": 0.3, "a0": 0.04, "m": 1.2, "tau_a": 3.0}, "springs"),
        LawEffect("mullins", "damage", {"m": 0.3, "r": 0.05, "p": 1.4}, "dashpots"),
        LawEffect("friction", "presliding", {"F_c": 2e-3 * k, "x0": 5e-3}),
        LawEffect("friction", "coulomb", {"F_c": 1e-3 * k, "v0": 0.05}),
    )
    return LawValues("mgmm", values, tuple(one.for_core() for one in (*FRAME_EFFECTS, *inside)))


@pytest.mark.parametrize("brace", [0.0, 2.0 * STIFFNESS])
@pytest.mark.parametrize("values", [core_law(FRAME_EFFECTS), inside_law()], ids=["beside", "inside"])
def test_a_damper_in_a_frame_has_the_force_of_its_history(values, brace):
    found = run(values, 0.01, brace)
    own = CoreDamper(values.law, values.values, brace, values.effects).force(
        found.time, found.values["u"], found.values["v"]
    )
    # the same steps: equilibrium to 1e-10, with a brace its balance to 1e-9 a step
    assert np.max(np.abs(found.values["force"] - own)) < (1e-8 if brace else 1e-10) * np.max(np.abs(own))


def test_the_size_of_a_device_changes_its_effects_with_it():
    """F = a F_p(b u): forces of the prototype times a, deformations over b, works times a/b."""
    a, b = 3.0, 0.25
    units = {"N/m": a * b, "m": 1.0 / b, "J": a / b, "1/J": b / a, "s": 1.0, "": 1.0}
    scaled = tuple(
        LawEffect(
            one.name,
            one.form,
            {
                p.name: one.values[p.name] * units.get(p.unit, a * b ** one.values.get("alpha", 0.0))
                for p in one.definition.parameters
            },
        )
        for one in FRAME_EFFECTS
    )
    law_scaled = LawValues("zener", tuple(a * b * p for p in FRAME_LAW), tuple(one.for_core() for one in scaled))
    device, direct = run(core_law(FRAME_EFFECTS), 0.01, scales=(a, b)), run(law_scaled, 0.01)
    for name in ("u", "force"):
        peak = np.max(np.abs(direct.values[name]))
        assert np.max(np.abs(device.values[name] - direct.values[name])) < 1e-8 * peak  # equilibrium to 1e-10


def test_natural_modes_see_the_stiffness_of_effects():
    """A hardening spring k u (u/r)^2 answers a sine of amplitude A with 3/4 k (A/r)^2 in its first harmonic."""
    values = LawValues("kelvin_voigt", (4e6, 1e5), (EffectValues("hardening.power", (1e6, 3.0, 5e-3)),))
    found = complex_stiffness(values, 4e-3, 1.5)
    assert found.real == pytest.approx(4e6 + 0.75 * 1e6 * 0.64, rel=1e-6)
    assert found.imag == pytest.approx(2.0 * np.pi * 1.5 * 1e5, rel=1e-6)
