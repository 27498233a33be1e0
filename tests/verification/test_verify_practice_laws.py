"""Laws of devices that practice uses (oil dampers with valves, bearings, self-centring devices, stops) against closed
forms and against return mapping in small steps that this file does itself."""

from __future__ import annotations

from math import asin, log, pi, sin

import numpy as np
import pytest
from damper_examples import EXAMPLES
from damper_motions import Motion
from scipy.optimize import brentq

from edesign.core import Analysis, Channel, LawValues, Model
from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.errors import InputError

Array = np.ndarray
OMEGA, SAMPLES = 2.0 * pi, 4000
"""rad/s; samples a cycle: the trapezoidal rule then errs by (2 pi / SAMPLES)^2 / 12 = 2e-7 of the work."""


def loop(law: str, amplitude: float, **changes: float) -> tuple[Array, Array]:
    """Deformation and force of the second cycle of a sine."""
    t = np.arange(2 * SAMPLES + 1) / SAMPLES * 2.0 * pi / OMEGA
    u, v = amplitude * np.sin(OMEGA * t), amplitude * OMEGA * np.cos(OMEGA * t)
    force = Damper(LAWS[law], EXAMPLES[law] | changes).core.force(t, u, v)
    return u[SAMPLES:], force[SAMPLES:]


def energy(u: Array, force: Array) -> float:
    return float(np.trapezoid(force, u))


@pytest.mark.parametrize("ratio", [0.0, 0.05, 0.6, 1.0])
def test_oil_damper_dissipates_the_integral_of_its_force(ratio: float) -> None:
    """c v0 u0 (p pi + (1 - p) (2 theta + sin 2 theta)), sin theta = F_r / (c v0): the integral of p c v + (1 - p)
    min(c v, F_r) over a sine."""
    c, relief = EXAMPLES["bilinear_oil"]["c"], EXAMPLES["bilinear_oil"]["F_r"]
    amplitude = 0.02
    theta = asin(relief / (c * amplitude * OMEGA))
    expected = c * OMEGA * amplitude**2 * (ratio * pi + (1.0 - ratio) * (2.0 * theta + sin(2.0 * theta)))
    assert energy(*loop("bilinear_oil", amplitude, p=ratio)) == pytest.approx(expected, rel=1e-6)


def test_oil_damper_is_a_dashpot_with_the_valve_closed() -> None:
    u, force = loop("bilinear_oil", 0.005)
    np.testing.assert_array_equal(force, loop("viscous", 0.005, c=EXAMPLES["bilinear_oil"]["c"])[1])
    assert np.max(np.abs(force)) < EXAMPLES["bilinear_oil"]["F_r"]


def test_asymmetric_dashpot_is_one_dashpot_each_way() -> None:
    values = EXAMPLES["asymmetric_viscous"]
    force = loop("asymmetric_viscous", 0.01)[1]
    for side, c in ((1.0, values["c_plus"]), (-1.0, values["c_minus"])):
        alone = loop("viscous_power", 0.01, c=c, alpha=values["alpha"])[1]
        there = side * alone > 0.0
        np.testing.assert_array_equal(force[there], alone[there])


def test_lead_rubber_bearing_has_the_strength_and_stiffness_it_is_given() -> None:
    q, k_d, y = (EXAMPLES["lead_rubber"][name] for name in ("Q", "K_d", "Y"))
    u, force = loop("lead_rubber", 0.02)
    assert energy(u, force) == pytest.approx(4.0 * q * (0.02 - y), rel=1e-6)
    assert np.max(force) / 0.02 == pytest.approx(k_d + q / 0.02, rel=1e-12)  # effective stiffness, EN 15129, 8.2
    assert force[SAMPLES // 2] == pytest.approx(-q, rel=1e-9)  # on the way back through zero
    k = k_d + q / y
    same = {"k": k, "Fy": q + k_d * y, "b": k_d / k}
    np.testing.assert_allclose(force, loop("elastic_plastic", 0.02, **same)[1], atol=1e-12 * np.max(force))


def test_friction_pendulum_swings_with_its_radius_and_rubs_with_its_speed() -> None:
    """Speed is largest at zero deformation, where the dish gives nothing: the force there is mu(v0) W."""
    p = EXAMPLES["friction_pendulum"]
    amplitude = 0.05
    u, force = loop("friction_pendulum", amplitude)
    mu = p["f_fast"] - (p["f_fast"] - p["f_slow"]) * np.exp(-p["a"] * amplitude * OMEGA)
    assert abs(force[0]) == pytest.approx(mu * p["W"], rel=1e-12)
    assert force[SAMPLES // 4] == pytest.approx(p["W"] / p["R"] * amplitude + p["f_slow"] * p["W"], rel=1e-9)
    slow = loop("friction_pendulum", amplitude, a=0.0)
    assert energy(*slow) == pytest.approx(4.0 * p["f_slow"] * p["W"] * (amplitude - p["Y"]), rel=1e-5)


def pendulum_in_small_steps(p: dict[str, float], motion: Motion, parts: int) -> Array:
    """Return mapping at `parts` times as many instants."""
    t = np.linspace(0.0, motion.time[-1], parts * (motion.time.size - 1) + 1)
    u, v = motion.u(t), motion.v(t)
    limit = (p["f_fast"] - (p["f_fast"] - p["f_slow"]) * np.exp(-p["a"] * np.abs(v))) * p["W"]
    k, slip, force = p["f_slow"] * p["W"] / p["Y"], 0.0, np.zeros_like(t)
    for i in range(t.size):
        friction = min(max(k * (u[i] - slip), -limit[i]), limit[i])
        slip = u[i] - friction / k
        force[i] = p["W"] / p["R"] * u[i] + friction
    return force[::parts]


@pytest.mark.parametrize("amplitude", [0.002, 0.02])
def test_friction_pendulum_in_one_step_or_in_many(amplitude: float) -> None:
    p, motion = EXAMPLES["friction_pendulum"], Motion(amplitude, seed=8, duration=2.0, rate=500.0)
    parts = 100
    expected = pendulum_in_small_steps(p, motion, parts)
    found = Damper(LAWS["friction_pendulum"], p).core.force(motion.time, motion.u(motion.time), motion.v(motion.time))
    # the reference misses turns by dt/2 at most; friction there falls by a (f_fast - f_slow) W times the velocity left
    v = motion.v(motion.time)
    left = np.max(np.abs(np.diff(v))) / (2.0 * parts)
    assert np.max(np.abs(found - expected)) < p["a"] * (p["f_fast"] - p["f_slow"]) * p["W"] * left


@pytest.mark.parametrize(("b", "beta"), [(0.0, 0.0), (0.05, 0.8), (0.1, 1.0), (0.3, 0.3)])
def test_self_centring_device_draws_its_flag(b: float, beta: float) -> None:
    p = EXAMPLES["self_centring"] | {"b": b, "beta": beta}
    k, fy, amplitude = p["k"], p["Fy"], 0.01
    u, force = loop("self_centring", amplitude, b=b, beta=beta)
    assert energy(u, force) == pytest.approx(2.0 * (1.0 - b) * beta * fy * (amplitude - fy / k), rel=2e-4, abs=1e-4)
    top = (1.0 - b) * fy + b * k * amplitude
    assert np.max(force) == pytest.approx(top, rel=1e-12)
    # back from the peak: down with k to the lower side of the flag, then along it, then to the origin
    down = np.arange(SAMPLES // 4, SAMPLES // 2 + 1)
    lower = (1.0 - b) * (1.0 - beta) * fy + b * k * u[down]
    expected = np.maximum(np.maximum(top - k * (amplitude - u[down]), lower), 0.0)
    expected = np.minimum(expected, k * u[down])
    np.testing.assert_allclose(force[down], expected, atol=1e-9 * top)
    assert abs(force[SAMPLES // 2]) < 1e-9 * top  # no force at no deformation


def test_flag_of_no_height_is_a_spring_with_a_corner() -> None:
    motion = Motion(8e-3, seed=2)
    p = EXAMPLES["self_centring"]
    u = motion.u(motion.time)
    force = Damper(LAWS["self_centring"], p | {"beta": 0.0}).core.force(motion.time, u, motion.v(motion.time))
    opened = np.maximum(np.abs(u) - p["Fy"] / p["k"], 0.0)
    np.testing.assert_allclose(force, p["k"] * (u - np.sign(u) * (1.0 - p["b"]) * opened), atol=1e-9 * p["Fy"])


@pytest.mark.parametrize("side", [0.0, 1.0, -1.0])
def test_gap_without_loss_is_a_spring_beyond_it(side: float) -> None:
    motion = Motion(8e-3, seed=2)
    p, u = EXAMPLES["gap"], motion.u(motion.time)
    core = Damper(LAWS["gap"], p | {"d": 0.0, "side": side}).core
    expected = np.zeros_like(u)
    for s in (1.0, -1.0) if side == 0.0 else (side,):
        expected += s * p["k"] * np.maximum(s * u - p["gap"], 0.0)
    np.testing.assert_allclose(core.force(motion.time, u, motion.v(motion.time)), expected, atol=1e-6, rtol=1e-12)


@pytest.mark.parametrize("speed", [0.1, 1.0])
def test_rebound_from_a_stop(speed: float) -> None:
    """A free mass meets a stop at v0 and leaves it at v1: m v' v = -k x (1 + d v) parts into functions of v and of x,
    so that v/d - ln(1 + d v)/d^2 is at the end what it was at the start (Hunt & Crossley 1975)."""
    d, mass, k = 0.8, 1000.0, 4e6

    def kept(v: float) -> float:
        return v / d - log(1.0 + d * v) / d**2

    expected = brentq(lambda v: kept(v) - kept(speed), -speed, -1e-6)
    model = Model()
    ground, body = model.node("ground", 0.0, 0.0), model.node("body", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(body, False, True, True)
    model.mass(body, mass)
    model.link("free", ground, body, (1e-6, 0.0, 0.0))
    model.damper("stop", LawValues("gap", (k, 0.01, d, 1.0)), ((1.0, body, 0), (-1.0, ground, 0)))
    analysis = Analysis(model, tolerance=1e-10)
    analysis.install_dampers()
    analysis.initial_velocity([speed])
    contact = pi * (mass / k) ** 0.5
    dt = contact / 2000.0
    n = round((0.012 / speed + 2.0 * contact) / dt)
    found = analysis.history(np.zeros(n + 1), dt, channels=(Channel("v", ((1.0, "velocity", 1, 0),)),))
    assert found.values["v"][-1] == pytest.approx(expected, rel=1e-4)  # steps of 1/2000 of the contact


@pytest.mark.parametrize(
    ("law", "wrong", "message"),
    [
        ("bilinear_oil", {"p": 1.5}, "p = 1.5 .*E-LAW-03"),
        ("asymmetric_viscous", {"c_minus": 0.0}, "c_minus = 0"),
        ("lead_rubber", {"Q": -1.0}, "Q = -1"),
        ("friction_pendulum", {"f_fast": 0.01}, "f_fast = 0.01 .* f_slow.*E-CORE-02"),
        ("self_centring", {"beta": 1.2}, "beta = 1.2"),
        ("gap", {"side": 0.5}, "side = 0.5 .*: -1, 0 or 1 .*E-LAW-03"),
    ],
)
def test_wrong_parameters_are_refused(law: str, wrong: dict[str, float], message: str) -> None:
    with pytest.raises((InputError, CoreError), match=message):
        assert Damper(LAWS[law], EXAMPLES[law] | wrong).core


@pytest.mark.parametrize("law", ["bilinear_oil", "asymmetric_viscous", "friction_pendulum", "gap"])
def test_with_a_brace_against_small_steps(law: str) -> None:
    """k_b (u - x) = F(x): the same with steps of 1/40 of the length, which is converged to 1e-5."""
    values, brace = LAWS[law].complete(EXAMPLES[law]), 60e6
    motion = Motion(12e-3, 11, 1.6, 200.0)
    core = CoreDamper(law, list(values.values()), brace)
    fine = np.linspace(0.0, motion.time[-1], 40 * (motion.time.size - 1) + 1)
    expected = core.force(fine, motion.u(fine), motion.v(fine))[::40]
    found = core.force(motion.time, motion.u(motion.time), motion.v(motion.time))
    assert np.max(np.abs(found - expected)) < 0.02 * np.max(np.abs(expected))
