"""Responses of shear buildings: closed forms, SciPy's integrator, and what passes from test to test."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from edesign.calibration.structures.building import Building, Damping, DampingKind, System
from edesign.calibration.structures.effects.channel import FORMS
from edesign.calibration.structures.isolation import IsolationLaw
from edesign.calibration.structures.response import Link, respond, transition
from edesign.estimation.model import PredictionError

STEP = 0.01
HYSTERESIS = Link(0, 1e7, "bouc_wen", (5e4, 5e-3, 0.0, 1.0, 0.5, 0.5, 1.0))


def one_floor(mass: float = 2.0, omega: float = 7.0, ratio: float = 0.05) -> Building:
    return Building(np.array([mass]), np.array([mass * omega**2]), Damping("modal", ratio), np.zeros(1))


def isolated(floors: int = 3) -> Building:
    stiffness, dashpots = np.full(floors, 2e8), np.zeros(floors)
    stiffness[0], dashpots[0] = 4e6, 1e5
    return Building(np.full(floors, 1e5), stiffness, Damping("modal", 0.03), dashpots, isolated=True)


def shaking(samples: int = 400, size: float = 2.0) -> np.ndarray:
    time = STEP * np.arange(samples)
    return size * (np.sin(5.0 * time) + 0.7 * np.sin(3.1 * time + 1.0) + 0.4 * np.sin(17.0 * time)) * np.exp(-time / 8)


def test_an_oscillator_under_a_step_of_acceleration_is_exact() -> None:
    # Chopra 4.3: u = -a/w^2 (1 - e^(-zwt) (cos wd t + z/sqrt(1-z^2) sin wd t)); a constant is linear between samples
    omega, ratio, time = 7.0, 0.05, 0.2 * np.arange(60)
    (found,) = respond(one_floor(omega=omega, ratio=ratio).system(), [(np.ones(60), 0.2)])
    damped, decay = omega * np.sqrt(1.0 - ratio**2), np.exp(-ratio * omega * time)
    exact = -(1 - decay * (np.cos(damped * time) + ratio * omega / damped * np.sin(damped * time))) / omega**2
    assert np.allclose(found.displacement[:, 0], exact, atol=1e-13)


def test_the_transition_of_a_free_mass() -> None:
    # no spring: x = a0 t^2/2 + (a1 - a0) t^3 / (6 h)
    free = System(np.array([2.0]), np.zeros((1, 1)), np.zeros((1, 1)), np.eye(1))
    a, b0, b1 = transition(free, np.array([[1.0]]), 0.1)
    assert np.allclose(a, [[1.0, 0.1], [0.0, 1.0]])
    assert np.allclose(b0[:, 0], [0.1**2 / 3.0, 0.05]) and np.allclose(b1[:, 0], [0.1**2 / 6.0, 0.05])


@pytest.mark.parametrize("ratio", [0.3, 1.0])
def test_modes_and_steps_are_one_response(ratio: float) -> None:
    # a link of no stiffness leads through every step; critical damping has no basis of eigenvectors
    for building in (one_floor(ratio=ratio), isolated()):
        nothing = Link(0, 0.0, "kelvin_voigt", (0.0, 0.0))
        modes, steps = (respond(building.system(), [(shaking(), STEP)], links)[0] for links in ((), (nothing,)))
        assert np.allclose(modes.displacement, steps.displacement, rtol=0, atol=1e-10)
        assert np.allclose(modes.acceleration, steps.acceleration, rtol=0, atol=1e-8)


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("modal", lambda w: np.full(w.size, 0.04)),
        ("stiffness", lambda w: 0.04 * w / w[0]),
        ("mass", lambda w: 0.04 * w[0] / w),
        ("rayleigh", lambda w: 0.04 / (w[0] + w[2]) * (w[0] * w[2] / w + w)),
    ],
)
def test_damping_ratios_of_modes(kind: DampingKind, expected: Callable[[np.ndarray], np.ndarray]) -> None:
    # Chopra 11.4, eqs. 11.4.5-11.4.8 and 11.4.20; of a share of another kind that share
    masses, stiffness = np.array([3.0, 2.0, 2.0, 1.0]), np.array([900.0, 700.0, 500.0, 300.0])
    for damping, share in ((Damping(kind, 0.04, (1, 3)), 1.0), (Damping("modal", 0.04, (1, 3), kind, 0.3), 0.3)):
        system = Building(masses, stiffness, damping, np.zeros(4)).system()
        squares, shapes = eigh(system.stiffness, np.diag(masses))
        modal, omega = shapes.T @ system.damping @ shapes, np.sqrt(squares)
        ratios = (1.0 - share) * 0.04 + share * expected(omega)
        assert np.allclose(np.diag(modal) / (2.0 * omega), ratios, rtol=1e-10)
        assert np.allclose(modal, np.diag(np.diag(modal)), atol=1e-10)


def test_ground_under_one_floor_adds_flexibilities() -> None:
    # Veletsos & Meek (1974): (T~/T)^2 = 1 + k/k_x + k h^2/k_theta
    mass, k, height, sway, rocking = 2e5, 3e7, 9.0, 8e7, 5e9
    building = Building(np.array([mass]), np.array([k]), Damping(), np.zeros(1), heights=np.array([height]))
    flexible = replace(building, sway=1.0 / sway, rocking=1.0 / rocking).system()
    assert flexible.stiffness[0, 0] == pytest.approx(k / (1.0 + k / sway + k * height**2 / rocking), rel=1e-12)
    assert flexible.first_frequency == pytest.approx(np.sqrt(flexible.stiffness[0, 0] / mass) / (2.0 * np.pi))
    # the storey takes its share of the deformation
    assert flexible.drifts[0, 0] == pytest.approx(flexible.stiffness[0, 0] / k, rel=1e-12)


def reference(system: System, ground: np.ndarray, force: Callable, extra: Callable) -> np.ndarray:  # type: ignore[type-arg]
    """Displacement of floors by SciPy's integrator, with a force of storey 0 of (drift, velocity, own state)."""
    n, time = system.masses.size, STEP * np.arange(ground.size)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        q, v, z = y[:n], y[n : 2 * n], y[2 * n]
        load = system.stiffness @ q + system.damping @ v
        load[0] += force(q[0], v[0], z)
        return np.concatenate((v, -np.interp(t, time, ground) - load / system.masses, [extra(q[0], v[0], z)]))

    found = solve_ivp(rate, (0.0, time[-1]), np.zeros(2 * n + 1), t_eval=time, rtol=1e-7, atol=1e-9, max_step=STEP)
    return np.asarray(found.y[:n].T)


@pytest.mark.parametrize(
    ("link", "force", "extra"),
    [
        (
            Link(0, 2e7, "bouc_wen", (1e5, 0.005, 0.0, 1.0, 0.5, 0.5, 1.0)),
            lambda u, v, z: 1e5 * z,
            lambda u, v, z: (v - 0.5 * abs(v) * z - 0.5 * v * abs(z)) / 0.005,
        ),
        (
            Link.alone(0, 2e7, "hardening.power", 2e6, 3.0, 0.05),
            lambda u, v, z: 2e6 * u * (u / 0.05) ** 2,
            lambda u, v, z: 0.0,
        ),
        # z: the largest drift ever
        (
            Link.breaking(0, 3e6, 0.05),
            lambda u, v, z: 3e6 * np.exp(-((max(z, abs(u)) / 0.05) ** 2)) * u,
            lambda u, v, z: max(v * np.sign(u), 0.0) if abs(u) >= z else 0.0,
        ),
        # z: the envelope, which fades when the drift is below it
        (
            Link.alone(0, 2e6, "payne.elastic", 2e6, 0.04, 2.0, 3.0),
            lambda u, v, z: -2e6 * max(z, abs(u)) ** 2 / (0.04**2 + max(z, abs(u)) ** 2) * u,
            lambda u, v, z: max(v * np.sign(u), -z / 3.0) if abs(u) >= z else -z / 3.0,
        ),
    ],
    ids=["bouc_wen", "power", "breaking", "fading"],
)
def test_an_isolated_building_is_as_by_scipy(link: Link, force: Callable, extra: Callable) -> None:  # type: ignore[type-arg]
    system, ground = isolated().system(), shaking(250)
    found = respond(system, [(ground, STEP)], [link])[0].displacement
    expected = reference(system, ground, force, extra)
    assert np.max(np.abs(expected[:, 0])) > 0.05  # far beyond yielding
    # forces of links are linear in a step of 10 ms: an error of second order
    assert np.max(np.abs(found - expected)) < 2e-3 * np.max(np.abs(expected))


def test_a_law_of_the_core_is_a_layer_as_a_linear_one_is() -> None:
    linear, ground = isolated(), shaking()
    bare = replace(linear, stiffness=np.array([0.0, 2e8, 2e8]), dashpots=np.zeros(3)).system()
    # without a second branch the law is a spring and a dashpot, which the response takes as any other law
    (link,) = IsolationLaw.of("linearised", {"k_eff": 4e6, "zeta_eff": 0.05, "omega": 4.0}).links
    viscous = replace(linear, dashpots=np.array([2.0 * 0.05 * 4e6 / 4.0, 0.0, 0.0])).system()
    found, expected = respond(bare, [(ground, STEP)], [link])[0], respond(viscous, [(ground, STEP)])[0]
    assert np.max(np.abs(found.displacement - expected.displacement)) < 2e-3 * np.max(np.abs(expected.displacement))


def test_friction_in_all_storeys_keeps_the_balance_of_energies() -> None:
    # work of the ground = kinetic + strain + dissipated, all from histories: nothing is created by the links
    building, ground = isolated(), shaking(800)
    links = [Link(i, k, "elastic_plastic", (k, 2e4, 0.0)) for i, k in enumerate(building.stiffness.tolist())]
    system = building.system()
    (found,) = respond(system, [(ground, STEP)], links)
    velocity = np.gradient(found.displacement, STEP, axis=0)
    drift = found.displacement @ system.drifts.T
    friction = np.sum(0.5 * (found.forces[1:] + found.forces[:-1]) * np.diff(drift, axis=0))
    viscous = STEP * np.einsum("ti,ij,tj->", velocity, system.damping, velocity)
    power = -velocity @ building.masses * ground
    work = STEP * np.sum(0.5 * (power[1:] + power[:-1]))
    stored = 0.5 * np.sum(building.masses * velocity[-1] ** 2)
    stored += 0.5 * found.displacement[-1] @ system.stiffness @ found.displacement[-1]
    assert friction > 0.05 * work
    assert friction + viscous + stored == pytest.approx(work, rel=0.01)  # derivatives by differences


def test_what_has_broken_is_broken_in_the_next_test() -> None:
    system, strong = one_floor(mass=1e5).system(), shaking()
    motions = [(0.02 * strong, STEP), (strong, STEP), (0.02 * strong, STEP)]
    fresh, _, again = (one.displacement for one in respond(system, motions, [Link.breaking(0, 2e6, 0.01)]))
    broken = respond(system, motions[:1])[0].displacement
    assert np.max(np.abs(fresh - broken)) > 0.1 * np.max(np.abs(broken))
    assert np.allclose(again, broken, atol=1e-6 * np.max(np.abs(broken)))


def test_a_link_too_stiff_for_the_steps_is_refused() -> None:
    with pytest.raises(PredictionError, match="stiff"):
        respond(one_floor(mass=1.0).system(), [(shaking(), STEP)], [Link(0, 1e9, "elastic_plastic", (1e9, 1.0, 0.0))])


def test_a_response_without_bounds_is_refused() -> None:
    running = replace(one_floor(), dashpots=np.array([-100.0])).system()
    with pytest.raises(PredictionError, match="bounds"):
        respond(running, [(shaking(), STEP)])


@pytest.mark.parametrize("every", [3, 6])
def test_wanted_samples_are_those_of_the_whole_response(every: int) -> None:
    system, motions = isolated().system(), [(shaking(), STEP), (shaking(395), STEP)]
    for links in ((), (HYSTERESIS,)):
        for whole, wanted in zip(respond(system, motions, links), respond(system, motions, links, every), strict=True):
            # the motion between wanted samples counts in full: what differs is rounding
            assert np.allclose(wanted.displacement, whole.displacement[::every], rtol=0, atol=1e-12)
            assert np.allclose(wanted.acceleration, whole.acceleration[::every], rtol=0, atol=1e-10)
            assert wanted.forces.shape == whole.forces[::every].shape


def test_rough_steps_are_good_enough_for_differences() -> None:
    system, motion = isolated().system(), (shaking(), STEP)

    def change(rough: bool) -> np.ndarray:
        other = Link(0, 1.1 * HYSTERESIS.stiffest, "bouc_wen", (1.1 * HYSTERESIS.values[0], *HYSTERESIS.values[1:]))
        one, two = (respond(system, [motion], [link], 6, rough)[0].acceleration for link in (HYSTERESIS, other))
        return two - one

    fine, rough = change(False), change(True)
    assert not np.array_equal(fine, rough)
    # slopes steer a search, they are no result; a twentieth is what a step of 0.03 s leaves of this loop
    assert np.linalg.norm(rough - fine) < 0.05 * np.linalg.norm(fine)


@pytest.mark.parametrize("lag", [0.02, 0.0137, -0.004])
def test_a_late_channel_is_the_motion_before(lag: float) -> None:
    (late,) = (form.mechanisms[0] for form in FORMS if form.label == "lag.delay")
    time, omega = STEP * np.arange(300), np.array([12.0, 30.0])
    found = late.change({"lag": lag}, STEP, (), np.sin(np.outer(time, omega)))  # type: ignore[union-attr]
    inside = slice(10, -10)
    # six samples about it: (w h / 2)^6 times 225 / 720 at most in the middle of a step, 4e-6 at 30 rad/s
    assert np.allclose(found[inside], np.sin(np.outer(time - lag, omega))[inside], rtol=0, atol=4e-6)
