"""Shear buildings under base acceleration: closed forms, SciPy's integrator, and convergence."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from edesign.calibration.structures.building import Building, Damping, System
from edesign.calibration.structures.response import Link, Response, respond

STEP = 0.01
HYSTERESIS = Link(0, 1e5 / 0.005, "bouc_wen", (1e5, 0.005, 0.0, 1.0, 0.5, 0.5, 1.0))
HALF = Link(0, 5e4 / 0.004, "bouc_wen", (5e4, 0.004, 0.0, 1.0, 0.5, 0.5, 1.0))


def simulate(system: System, ground: np.ndarray, step: float, links: Sequence[Link] = ()) -> Response:
    return respond(system, [(ground, step)], links)[0]


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


def test_acceleration_is_the_second_derivative_of_displacement() -> None:
    ground = shaking()
    found = simulate(isolated().system(), ground, STEP, [HALF])
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


@pytest.mark.parametrize(
    ("link", "force", "extra"),
    [
        (
            Link.alone(0, 4e6, "hardening.threshold", 4e6, 0.03),
            lambda u, v, z: 4e6 * np.sign(u) * max(abs(u) - 0.03, 0.0),
            lambda u, v, z: 0.0,
        ),
        # z: spring force of the slider over its friction, held at one while it slips
        (
            Link(0, 1e7, "elastic_plastic", (1e7, 5e4, 0.0)),
            lambda u, v, z: 5e4 * z,
            lambda u, v, z: 0.0 if abs(z) >= 1.0 and v * z > 0.0 else 200.0 * v,
        ),
    ],
    ids=["threshold", "slider"],
)
def test_isolated_building_against_scipy(link, force, extra) -> None:  # noqa: ANN001
    system, ground = isolated().system(), shaking(400)
    found = simulate(system, ground, STEP, [link]).displacement
    expected = reference(system, ground, force, extra)
    assert np.max(np.abs(expected[:, 0])) > 0.05  # far beyond yielding
    # forces of links are linear in a step of 10 ms: an error of second order
    assert np.max(np.abs(found - expected)) < 2e-3 * np.max(np.abs(expected))


def test_finer_steps_converge() -> None:
    # second order between reversals, less at them
    system, coarse = isolated().system(), shaking(400)

    def response(parts: int) -> np.ndarray:
        ground = np.interp(np.arange(399 * parts + 1) / parts, np.arange(400), coarse)
        return simulate(system, ground, STEP / parts, [HYSTERESIS]).displacement[::parts]

    best = response(32)
    errors = [np.max(np.abs(response(parts) - best)) for parts in (1, 2, 4, 8)]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2] > 8.0 * errors[3]
