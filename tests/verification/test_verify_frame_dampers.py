"""Dampers in a frame: oscillators with closed forms, identities between laws, energy, independence of history."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from edesign.core import HHT, Analysis, Channel, LawValues, Model, Newmark

MASS, STIFFNESS = 1000.0, 1000.0 * (2.0 * np.pi) ** 2  # T = 1 s
CHANNELS = (
    Channel("u", ((1.0, "displacement", 1, 0),)),
    Channel("force", ((1.0, "damper_force", 0, 0),)),
    Channel("own", ((1.0, "damper_deformation", 0, 1),)),
)


def oscillator(
    law: LawValues, brace: float = 0.0, force_scale: float = 1.0, deformation_scale: float = 1.0
) -> Analysis:
    """A mass on a spring with a damper beside it."""
    model = Model()
    ground, mass = model.node("ground", 0.0, 0.0), model.node("mass", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(mass, False, True, True)
    model.mass(mass, MASS)
    model.link("spring", ground, mass, (STIFFNESS, 0.0, 0.0))
    model.damper("damper", law, ((1.0, mass, 0), (-1.0, ground, 0)), brace, force_scale, deformation_scale)
    analysis = Analysis(model, tolerance=1e-10)
    analysis.install_dampers()
    return analysis


def shaking(n: int = 400, dt: float = 0.01) -> np.ndarray:
    t = np.arange(n + 1) * dt
    return 2.0 * np.sin(5.0 * t) * np.exp(-0.3 * t) + 1.0 * np.sin(17.0 * t + 0.3)


@pytest.mark.parametrize(("method", "order"), [(Newmark(), 2.0), (HHT(-0.1), 2.0)])
def test_free_vibration_with_a_kelvin_damper_converges_to_the_closed_form(method, order):
    k, c, v0 = 0.6 * STIFFNESS, 0.1 * 2.0 * MASS * 2.0 * np.pi, 0.3
    omega = np.sqrt((STIFFNESS + k) / MASS)
    zeta = c / (2.0 * MASS * omega)
    damped = omega * np.sqrt(1.0 - zeta**2)
    errors = []
    for n in (100, 200):
        dt = 2.0 / n
        analysis = oscillator(LawValues("kelvin_voigt", (k, c)))
        analysis.initial_velocity([v0])
        found = analysis.history(np.zeros(n + 1), dt, method=method, channels=CHANNELS)
        exact = v0 / damped * np.exp(-zeta * omega * found.time) * np.sin(damped * found.time)
        errors.append(np.max(np.abs(found.values["u"] - exact)) / (v0 / damped))
    assert errors[1] < 5e-3  # period elongation (omega dt)^2 / 12 over two and a half cycles
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)


def test_a_linear_oscillator_with_a_zener_damper_follows_its_differential_equation():
    k0, k1, c1 = 0.2 * STIFFNESS, 0.5 * STIFFNESS, 0.05 * STIFFNESS
    dt = 0.0025
    ground = shaking(1600, dt)
    t = np.arange(ground.size) * dt

    def rates(time, y):
        u, v, q = y
        force = k0 * u + q
        return [v, -(STIFFNESS * u + force) / MASS - np.interp(time, t, ground), k1 * v - k1 / c1 * q]

    exact = solve_ivp(rates, (0.0, t[-1]), [0.0] * 3, t_eval=t, rtol=1e-9, atol=1e-12, max_step=dt)
    found = oscillator(LawValues("zener", (k0, k1, c1))).history(ground, dt, channels=CHANNELS)
    # Newmark at 400 steps a period of the structure, 150 of the load: (omega dt)^2 / 12 a cycle
    assert np.max(np.abs(found.values["u"] - exact.y[0])) < 1e-3 * np.max(np.abs(exact.y[0]))


def run(law: LawValues, **options: float):
    return oscillator(law, **options).history(shaking(), 0.01, channels=CHANNELS)


def same(a, b, tolerance: float) -> None:
    for name in ("u", "force"):
        peak = np.max(np.abs(b.values[name]))
        assert np.max(np.abs(a.values[name] - b.values[name])) < tolerance * peak


def test_a_spring_damper_is_a_spring():
    model = Model()
    ground, mass = model.node("ground", 0.0, 0.0), model.node("mass", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(mass, False, True, True)
    model.mass(mass, MASS)
    model.link("spring", ground, mass, (1.5 * STIFFNESS, 0.0, 0.0))
    stiff = Analysis(model, tolerance=1e-10).history(shaking(), 0.01, channels=CHANNELS[:1])
    found = run(LawValues("kelvin_voigt", (0.5 * STIFFNESS, 0.0)))
    # the same equations; equilibrium to 1e-10 of the forces
    assert np.max(np.abs(found.values["u"] - stiff.values["u"])) < 1e-8 * np.max(np.abs(stiff.values["u"]))


def test_a_brace_with_a_maxwell_damper_is_a_softer_maxwell_damper():
    c, k, brace = 0.1 * STIFFNESS, 0.8 * STIFFNESS, 1.5 * STIFFNESS
    together = 1.0 / (1.0 / k + 1.0 / brace)
    found = run(LawValues("maxwell", (c, c / k)), brace=brace)
    exact = run(LawValues("maxwell", (c, c / together)))
    # collocation of order 3 at h / tau = 0.1: the error of a step is (h / tau)^4 / 72 = 1e-6
    same(found, exact, 2e-5)


def test_a_brace_with_a_kelvin_damper_is_a_zener_damper():
    k, c, brace = 0.5 * STIFFNESS, 0.05 * STIFFNESS, 3.0 * STIFFNESS
    rest = k * brace / (k + brace)
    branch = brace - rest
    zener = LawValues("zener", (rest, branch, branch * c / (k + brace)))
    same(run(LawValues("kelvin_voigt", (k, c)), brace=brace), run(zener), 1e-4)  # h / tau = 0.7


def test_a_brace_with_an_elastic_plastic_damper_is_a_softer_one():
    k, fy, b, brace = 0.8 * STIFFNESS, 300.0, 0.05, 1.2 * STIFFNESS
    soft = k * brace / (k + brace)
    after = b * k * brace / (b * k + brace)
    found = run(LawValues("elastic_plastic", (k, fy, b)), brace=brace)
    exact = run(LawValues("elastic_plastic", (soft, fy, after / soft)))
    assert np.max(np.abs(exact.values["force"])) > 1.05 * fy  # it does yield
    same(found, exact, 1e-7)  # both exact, equilibrium to 1e-10


def test_a_dashpot_behind_a_stiff_spring_goes_through_rest_like_the_dashpot_alone():
    c, alpha = 0.1 * STIFFNESS, 0.35
    found = run(LawValues("maxwell_power", (c, alpha, 1e7 * STIFFNESS)))
    limit = run(LawValues("viscous_power", (c, alpha)))
    same(found, limit, 2e-3)  # the spring stretches by 1e-7 of the structure's displacement; about rest its force lags
    # Newton's method on tangents alone oscillates about rest: 10 trials a step, steps that are begun anew
    assert found.statistics["fallbacks"] == 0
    assert found.statistics["damper_updates"] <= 1.1 * limit.statistics["damper_updates"]


def test_scales_change_force_and_deformation():
    law = LawValues("maxwell", (0.1 * STIFFNESS, 0.2))
    scaled = LawValues("maxwell", (3.0 * 0.25 * 0.1 * STIFFNESS, 0.2))
    same(run(law, force_scale=3.0, deformation_scale=0.25), run(scaled), 1e-9)


LAWS = {
    "zener": (0.2 * STIFFNESS, 0.5 * STIFFNESS, 0.05 * STIFFNESS),
    "fractional_kelvin": (0.3 * STIFFNESS, 0.1, 0.5),
    "elastic_plastic": (STIFFNESS, 300.0, 0.02),
    "bouc_wen": (300.0, 300.0 / STIFFNESS, 0.05, 1.0, 0.5, 0.5, 1.0),
    "maxwell_power": (2000.0, 0.5, 2.0 * STIFFNESS),
    "mgmm": (5e3, 150.0, 1e3, 400.0, 0.374, 1.2e4, 1.2e4, 0.008, 9e2, 2e2, 0.0135, 0.0),
}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("brace", [0.0, 5.0 * STIFFNESS])
def test_energy_closes_and_steps_leave_nothing_behind(law, brace):
    analysis = oscillator(LawValues(law, LAWS[law]), brace=brace)
    first = analysis.history(shaking(), 0.01, channels=CHANNELS)
    assert first.status == "completed", first.reason
    # trapezoidal works of average acceleration: equilibrium at both ends of each step makes the balance close
    assert first.statistics["energy_error"] < 1e-6
    work = np.trapezoid(first.values["force"], first.values["u"])
    assert first.energy["dampers"][-1] == pytest.approx(work, rel=1e-9)
    assert work > 0.0
    if brace:
        lost = first.values["u"] - first.values["own"]
        assert np.allclose(lost, first.values["force"] / brace, atol=1e-12)
    again = oscillator(LawValues(law, LAWS[law]), brace=brace).history(shaking(), 0.01, channels=CHANNELS)
    assert np.array_equal(first.values["u"], again.values["u"])


def test_dampers_carry_nothing_before_they_are_installed():
    model = Model()
    ground, mass = model.node("ground", 0.0, 0.0), model.node("mass", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(mass, False, True, True)
    model.mass(mass, MASS)
    model.link("spring", ground, mass, (STIFFNESS, 0.0, 0.0))
    model.damper("damper", LawValues("kelvin_voigt", (STIFFNESS, 0.0)), ((1.0, mass, 0),))
    load = model.pattern()
    model.nodal_load(load, mass, STIFFNESS * 0.01)
    analysis = Analysis(model)
    before = analysis.static(load, 1.0, 2, CHANNELS)
    assert before.final["u"] == pytest.approx(0.01)
    assert before.final["force"] == 0.0
    analysis.install_dampers()
    after = analysis.static(load, 3.0, 2, CHANNELS)  # 0.02 more on twice the stiffness
    assert after.final["u"] == pytest.approx(0.02)
    assert after.final["force"] == pytest.approx(0.01 * STIFFNESS)


def test_natural_modes_take_the_stiffness_of_dampers():
    analysis = oscillator(LawValues("viscous", (1.0,)))
    assert analysis.modes(1).period[0] == pytest.approx(1.0)
    assert analysis.modes(1, [3.0 * STIFFNESS]).period[0] == pytest.approx(0.5)


@pytest.mark.parametrize("beam", [False, True])
def test_masses_on_dampers_alone(beam):
    """Masses on Kelvin dampers in a constant acceleration, in closed form. Members carry nothing.

    A beam that moves along as a whole, as floors do whose columns are all replaced, has rounding alone in its ends.
    """
    omega, zeta, g, dt = 2.0 * np.pi, 0.1, 3.0, 0.005
    law = LawValues("kelvin_voigt", (MASS * omega**2, 2.0 * zeta * omega * MASS))
    model = Model()
    ends = [model.node(name, x, 4.0) for name, x in (("left", 0.0), ("right", 6.0))]
    for end in ends:
        ground = model.node(f"under {end}", 6.0 * end, 0.0)
        model.fix(ground, True, True, True)
        model.fix(end, False, True, not beam)
        model.mass(end, MASS)
        model.damper(f"D{end}", law, ((1.0, end, 0), (-1.0, ground, 0)), carries=True)
    if beam:
        model.beam_column("beam", *ends, model.elastic_section(2e9, 1e7))
    channels = [Channel("u", ((1.0, "displacement", ends[1], 0),))]
    found = Analysis(model).history(np.full(401, g), dt, channels=channels)
    assert found.status == "completed", found.reason
    damped, t = omega * np.sqrt(1.0 - zeta**2), found.time
    swing = np.cos(damped * t) + zeta * omega / damped * np.sin(damped * t)
    exact = -g / omega**2 * (1.0 - np.exp(-zeta * omega * t) * swing)
    error = (omega * dt) ** 2 / 12.0 * omega * t[-1]  # the period elongation of two cycles
    np.testing.assert_allclose(found.values["u"], exact, rtol=0, atol=error * g / omega**2)
