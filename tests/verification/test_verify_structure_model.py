"""Shear buildings under base acceleration: closed forms, an independent integrator, and parity of formulations."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from edesign.calibrate.structure.building import Building, System
from edesign.calibrate.structure.damping import Damping
from edesign.calibrate.structure.links import (
    BreakingSpring,
    FadingSpring,
    Hysteresis,
    LawLink,
    Link,
    PowerSpring,
    Slider,
    ThresholdSpring,
    by_storey,
)
from edesign.calibrate.structure.simulation import NoResponse, simulate, transition
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS

STEP = 0.01


def one_floor(mass: float = 2.0, omega: float = 7.0, ratio: float = 0.05) -> Building:
    return Building(np.array([mass]), np.array([mass * omega**2]), Damping("modal", ratio), np.zeros(1))


def isolated(floors: int = 3) -> Building:
    stiffness = np.full(floors, 2e8)
    stiffness[0] = 4e6
    dashpots = np.zeros(floors)
    dashpots[0] = 1e5
    return Building(np.full(floors, 1e5), stiffness, Damping("modal", 0.03), dashpots, isolated=True)


def shaking(samples: int = 800, size: float = 2.0) -> np.ndarray:
    time = STEP * np.arange(samples)
    return size * (np.sin(5.0 * time) + 0.7 * np.sin(3.1 * time + 1.0) + 0.4 * np.sin(17.0 * time)) * np.exp(-time / 8)


def test_oscillator_in_steady_state() -> None:
    # Chopra, Dynamics of Structures, 3.6 and 3.7: deformation factor, transmissibility of absolute acceleration
    omega, ratio, forced = 7.0, 0.05, 5.0
    time = STEP * np.arange(9000)
    found = simulate(one_floor(omega=omega, ratio=ratio).system(), np.sin(forced * time), STEP)
    r = forced / omega
    late = time > 60.0  # free vibration is gone: exp(-0.05 * 7 * 60) = 1e-9
    drift = -1.0 / omega**2 / (1.0 - r**2 + 2j * ratio * r)
    carried = (1.0 + 2j * ratio * r) / (1.0 - r**2 + 2j * ratio * r)
    turning = np.exp(1j * forced * time[late])
    # chords of a sine are low by (w h)^2 / 12 = 2e-4
    assert np.allclose(found.displacement[late, 0], np.imag(drift * turning), atol=3e-4 * abs(drift))
    assert np.allclose(found.acceleration[late, 0], np.imag(carried * turning), atol=3e-4 * abs(carried))


def test_oscillator_under_a_step_of_acceleration_is_exact() -> None:
    # Chopra 4.3: u = -a/w^2 (1 - e^(-zwt) (cos wd t + z/sqrt(1-z^2) sin wd t)); a constant is linear between samples
    omega, ratio = 7.0, 0.05
    time = 0.2 * np.arange(60)
    found = simulate(one_floor(omega=omega, ratio=ratio).system(), np.ones(60), 0.2)
    damped = omega * np.sqrt(1.0 - ratio**2)
    decay = np.exp(-ratio * omega * time)
    exact = -(1 - decay * (np.cos(damped * time) + ratio * omega / damped * np.sin(damped * time))) / omega**2
    assert np.allclose(found.displacement[:, 0], exact, atol=1e-13)


def test_free_vibration_of_two_floors() -> None:
    # equal masses and storeys: w^2 = (3 -+ sqrt 5) / 2 k/m, Chopra example 10.4 with m2 = m1
    building = Building(np.full(2, 3.0), np.full(2, 300.0), Damping("modal", 0.02), np.zeros(2))
    ground = np.zeros(4000)
    ground[:40] = np.sin(np.linspace(0.0, np.pi, 40))
    found = simulate(building.system(), ground, STEP).displacement[40:]
    for sign in (-1, 1):
        omega = np.sqrt(100.0 * (3.0 + sign * np.sqrt(5.0)) / 2.0)
        modal = found @ np.array([1.0, 2.0 - omega**2 / 100.0])  # shapes are orthogonal with equal masses
        time = STEP * np.arange(modal.size)
        damped, decay = omega * np.sqrt(1.0 - 0.02**2), np.exp(-0.02 * omega * time)
        basis = np.column_stack((decay * np.cos(damped * time), decay * np.sin(damped * time)))
        left = modal - basis @ np.linalg.lstsq(basis, modal, rcond=None)[0]
        assert np.max(np.abs(left)) < 1e-10 * np.max(np.abs(modal))


@pytest.mark.parametrize(
    ("kind", "expected"),
    [
        ("modal", lambda w: np.full(w.size, 0.04)),
        ("stiffness", lambda w: 0.04 * w / w[0]),
        ("mass", lambda w: 0.04 * w[0] / w),
        ("rayleigh", lambda w: 0.04 / (w[0] + w[2]) * (w[0] * w[2] / w + w)),
    ],
)
def test_damping_ratios_of_modes(kind: str, expected) -> None:  # noqa: ANN001
    # Chopra 11.4, eqs. 11.4.5-11.4.8 and 11.4.20
    masses, stiffness = np.array([3.0, 2.0, 2.0, 1.0]), np.array([900.0, 700.0, 500.0, 300.0])
    system = Building(masses, stiffness, Damping(kind, 0.04, (1, 3)), np.zeros(4)).system()
    squares, shapes = eigh(system.stiffness, np.diag(masses))
    modal = shapes.T @ system.damping @ shapes
    omega = np.sqrt(squares)
    assert np.allclose(np.diag(modal) / (2.0 * omega), expected(omega), rtol=1e-10)
    assert np.allclose(modal, np.diag(np.diag(modal)), atol=1e-10)


def test_ground_under_one_floor_adds_flexibilities() -> None:
    # Veletsos & Meek (1974): (T~/T)^2 = 1 + k/k_x + k h^2/k_theta
    mass, k, height, sway, rocking = 2e5, 3e7, 9.0, 8e7, 5e9
    building = Building(np.array([mass]), np.array([k]), Damping(), np.zeros(1), heights=np.array([height]))
    flexible = replace(building, sway=1.0 / sway, rocking=1.0 / rocking).system()
    assert flexible.stiffness[0, 0] == pytest.approx(k / (1.0 + k / sway + k * height**2 / rocking), rel=1e-12)
    # the storey takes its share of the deformation
    assert flexible.drifts[0, 0] == pytest.approx(flexible.stiffness[0, 0] / k, rel=1e-12)


def test_flexible_ground_is_a_light_foundation_on_springs() -> None:
    # the same building with its foundation as a floor and a rotation of nearly no mass, assembled here
    masses, k, heights = np.array([2e5, 2e5, 1e5]), np.array([3e7, 2e7, 2e7]), np.array([4.0, 7.0, 10.0])
    sway, rocking, light = 8e7, 5e9, 1.0  # kg, kg m2
    building = Building(masses, k, Damping(), np.zeros(3), heights=heights, sway=1.0 / sway, rocking=1.0 / rocking)
    system = building.system()
    found = eigh(system.stiffness, np.diag(masses), eigvals_only=True)
    relative = np.eye(3) - np.eye(3, k=-1)
    frame = np.hstack((relative, np.zeros((3, 2))))  # of q, foundation s, rotation r: storeys without the rigid motion
    frame[:, 3] = relative @ -np.ones(3)
    frame[:, 4] = relative @ -heights
    full = frame.T @ (k[:, None] * frame)
    full[3, 3] += sway
    full[4, 4] += rocking
    expected = eigh(full, np.diag([*masses, light, light]), eigvals_only=True)[:3]
    assert np.allclose(found, expected, rtol=2e-5)  # light over the mass of a floor


@pytest.mark.parametrize("ratio", [0.3, 1.0])
def test_recursion_by_modes_is_the_stepwise_one(ratio: float) -> None:
    # a link without force leads through every step; critical damping has no basis of eigenvectors
    for building in (one_floor(ratio=ratio), isolated()):
        system = building.system()
        modes = simulate(system, shaking(), STEP)
        steps = simulate(system, shaking(), STEP, [Slider(0, 0.0, 1.0)])
        assert np.allclose(modes.displacement, steps.displacement, rtol=0, atol=1e-10)
        assert np.allclose(modes.acceleration, steps.acceleration, rtol=0, atol=1e-8)


def test_acceleration_is_the_second_derivative_of_displacement() -> None:
    ground = shaking()
    found = simulate(isolated().system(), ground, STEP, [Hysteresis(0, 5e4, 0.004)])
    second = np.diff(found.displacement, 2, axis=0) / STEP**2
    absolute = second + ground[1:-1, None]
    # central differences of motion up to 50 rad/s are off by (w h)^2 / 12 = 2 % of the part at that frequency
    assert np.max(np.abs(absolute - found.acceleration[1:-1])) < 0.02 * np.max(np.abs(found.acceleration))


def reference(system: System, ground: np.ndarray, force, extra) -> np.ndarray:  # noqa: ANN001
    """Displacement of floors by SciPy's integrator, with a force of storey 0 of (drift, velocity, own state)."""
    n, time = system.masses.size, STEP * np.arange(ground.size)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        q, v, z = y[:n], y[n : 2 * n], y[2 * n]
        load = system.stiffness @ q + system.damping @ v
        load[0] += force(q[0], v[0], z)
        return np.concatenate((v, -np.interp(t, time, ground) - load / system.masses, [extra(q[0], v[0], z)]))

    found = solve_ivp(rate, (0.0, time[-1]), np.zeros(2 * n + 1), t_eval=time, rtol=1e-7, atol=1e-9, max_step=STEP)
    return found.y[:n].T


def bouc_wen_rate(yielding: float):  # noqa: ANN201
    return lambda u, v, z: (v - 0.5 * abs(v) * z - 0.5 * v * abs(z)) / yielding


@pytest.mark.parametrize(
    ("link", "force", "extra"),
    [
        (lambda: Hysteresis(0, 1e5, 0.005), lambda u, v, z: 1e5 * z, bouc_wen_rate(0.005)),
        (lambda: PowerSpring(0, 2e6, 3.0, 0.05), lambda u, v, z: 2e6 * u * (u / 0.05) ** 2, lambda u, v, z: 0.0),
        (
            lambda: ThresholdSpring(0, 4e6, 0.03),
            lambda u, v, z: 4e6 * np.sign(u) * max(abs(u) - 0.03, 0.0),
            lambda u, v, z: 0.0,
        ),
        # z: spring force of the slider over its friction, held at one while it slips
        (
            lambda: Slider(0, 5e4, 1e7),
            lambda u, v, z: 5e4 * z,
            lambda u, v, z: 0.0 if abs(z) >= 1.0 and v * z > 0.0 else 200.0 * v,
        ),
        # z: the largest drift ever
        (
            lambda: BreakingSpring(0, 3e6, 0.05),
            lambda u, v, z: 3e6 * np.exp(-((max(z, abs(u)) / 0.05) ** 2)) * u,
            lambda u, v, z: max(v * np.sign(u), 0.0) if abs(u) >= z else 0.0,
        ),
        # z: the envelope, which fades when the drift is below it
        (
            lambda: FadingSpring(0, 2e6, 0.04, 2.0, 3.0),
            lambda u, v, z: -2e6 * max(z, abs(u)) ** 2 / (0.04**2 + max(z, abs(u)) ** 2) * u,
            lambda u, v, z: max(v * np.sign(u), -z / 3.0) if abs(u) >= z else -z / 3.0,
        ),
    ],
    ids=["bouc_wen", "power", "threshold", "slider", "breaking", "fading"],
)
def test_isolated_building_against_scipy(link, force, extra) -> None:  # noqa: ANN001
    system, ground = isolated().system(), shaking(400)
    found = simulate(system, ground, STEP, [link()]).displacement
    expected = reference(system, ground, force, extra)
    assert np.max(np.abs(expected[:, 0])) > 0.05  # far beyond yielding
    # forces of links are linear in a step of 10 ms: an error of second order
    assert np.max(np.abs(found - expected)) < 2e-3 * np.max(np.abs(expected))


def test_finer_steps_converge() -> None:
    # second order between reversals, less at them
    system, coarse = isolated().system(), shaking(400)

    def response(parts: int) -> np.ndarray:
        ground = np.interp(np.arange(399 * parts + 1) / parts, np.arange(400), coarse)
        return simulate(system, ground, STEP / parts, [Hysteresis(0, 1e5, 0.005)]).displacement[::parts]

    best = response(32)
    errors = [np.max(np.abs(response(parts) - best)) for parts in (1, 2, 4, 8)]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2] > 8.0 * errors[3]


def test_links_that_are_dampers_of_the_core() -> None:
    # a Kelvin-Voigt link beside nothing is the same as a linear layer; a Bouc-Wen link is the layer's own recursion
    linear, ground = isolated(), shaking()
    bare = replace(linear, stiffness=np.array([0.0, 2e8, 2e8]), dashpots=np.zeros(3))
    damper = Damper(LAWS["kelvin_voigt"], {"k": 4e6, "c": 1e5})
    found = simulate(bare.system(), ground, STEP, [LawLink(0, damper, 4e6)])
    expected = simulate(linear.system(), ground, STEP)
    assert np.max(np.abs(found.displacement - expected.displacement)) < 2e-3 * np.max(np.abs(expected.displacement))
    hysteretic = Damper(LAWS["bouc_wen"], {"Fy": 1e5, "Y": 0.005, "alpha": 0.0})
    own = simulate(linear.system(), ground, STEP, [Hysteresis(0, 1e5, 0.005)])
    core = simulate(linear.system(), ground, STEP, [LawLink(0, hysteretic, 2e7)])
    assert np.max(np.abs(own.displacement - core.displacement)) < 1e-3 * np.max(np.abs(own.displacement))


def test_inertia_is_the_force_of_the_isolation_layer() -> None:
    # the equation error of a layer's own law, on its simulated drift, is nothing: both formulations are one
    building, ground = isolated(), shaking()
    response = simulate(building.system(), ground, STEP, [Hysteresis(0, 1e5, 0.005)])
    inertia = -response.acceleration @ building.masses
    drift = response.displacement[:, 0]
    law = Damper(LAWS["bouc_wen"], {"Fy": 1e5 + 4e6 * 0.005, "Y": 0.005, "alpha": 4e6 * 0.005 / (1e5 + 4e6 * 0.005)})
    dashpot = 1e5 * np.gradient(drift, STEP)
    force = law.force(STEP * np.arange(drift.size), drift) + dashpot
    assert np.sum((force - inertia) ** 2) < 1e-5 * np.sum(inertia**2)


def test_energy_of_friction_in_every_storey() -> None:
    # work of the ground = kinetic + strain + dissipated, all from histories: nothing is created by the links
    building, ground = isolated(), shaking()
    links: list[Link] = [Slider(i, 2e4, float(building.stiffness[i])) for i in range(3)]
    system = building.system()
    found = simulate(system, ground, STEP, links)
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


def test_memory_of_broken_partitions_lasts_to_the_next_test() -> None:
    system, strong = one_floor(mass=1e5).system(), shaking(400)
    link = BreakingSpring(0, 2e6, 0.01)
    fresh = simulate(system, 0.02 * strong, STEP, [link]).displacement
    simulate(system, strong, STEP, [link])
    again = simulate(system, 0.02 * strong, STEP, [link]).displacement
    broken = simulate(system, 0.02 * strong, STEP).displacement
    assert np.max(np.abs(fresh - broken)) > 0.1 * np.max(np.abs(broken))
    assert np.allclose(again, broken, atol=1e-6 * np.max(np.abs(broken)))


def test_links_too_stiff_for_the_steps_are_refused() -> None:
    with pytest.raises(NoResponse, match="stiff"):
        simulate(one_floor(mass=1.0).system(), shaking(), STEP, [Slider(0, 1.0, 1e9)])


def test_transition_of_a_free_mass() -> None:
    # no spring: x = a0 t^2/2 + (a1 - a0) t^3 / (6 h)
    free = System(np.array([2.0]), np.zeros((1, 1)), np.zeros((1, 1)), np.eye(1))
    a, b0, b1 = transition(free, np.array([[1.0]]), 0.1)
    assert np.allclose(a, [[1.0, 0.1], [0.0, 1.0]])
    assert np.allclose(b0[:, 0], [0.1**2 / 3.0, 0.05]) and np.allclose(b1[:, 0], [0.1**2 / 6.0, 0.05])


def test_links_of_one_storey_act_as_one() -> None:
    system, ground = isolated().system(), shaking(400)

    def links() -> list[Link]:
        return [Hysteresis(0, 1e5, 0.005), Slider(1, 2e4, 2e8), PowerSpring(0, 2e6, 3.0, 0.05)]

    apart, together = simulate(system, ground, STEP, links()), by_storey(links())
    found = simulate(system, ground, STEP, together)
    assert [link.storey for link in together] == [0, 1]
    # both iterate to 1e-8 of the forces
    assert np.allclose(found.displacement, apart.displacement, rtol=0, atol=1e-6 * np.max(np.abs(apart.displacement)))
