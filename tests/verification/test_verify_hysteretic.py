"""Friction, elastic-plastic, Ramberg-Osgood and asymptote laws against independent references.

Elastic-plastic and asymptote: their rate equations by scipy's DOP853 with events. Ramberg-Osgood: its memory of
nested loops against elements in parallel that yield one by one and know of no rule (Iwan 1967), its skeleton by
Brent's method. Motions are sampled at 1 kHz; the cubics between samples are within 1e-9 of their amplitude.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from damper_examples import EXAMPLES
from damper_motions import Motion
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from edesign.core.damper import CoreDamper

Array = np.ndarray


def core_force(law: str, values: list[float], motion: Motion) -> Array:
    t = motion.time
    return CoreDamper(law, values).force(t, motion.u(t), motion.v(t))


def integrate(
    rate: Callable[[float, Array], list[float]], start: float, end: float, force: float, size: float, **options: object
) -> object:
    return solve_ivp(
        rate, (start, end), [force], method="DOP853", rtol=1e-11, atol=1e-12 * size, dense_output=True, **options
    )


@pytest.mark.parametrize("amplitude", [0.0015, 0.004, 0.012])
@pytest.mark.parametrize("b", [0.0, 0.03, 0.4])
def test_elastic_plastic_rate_equation(b: float, amplitude: float) -> None:
    k, yield_force = 50e6, 100e3
    motion = Motion(amplitude, seed=3)
    expected = np.zeros_like(motion.time)
    force = 0.0
    for start, end in motion.pieces():
        sign = float(np.sign(motion.v(0.5 * (start + end))))

        def reaches(t: float, y: Array, sign: float = sign) -> float:
            return sign * (y[0] - b * k * float(motion.u(t))) - (1.0 - b) * yield_force

        reaches.terminal = True  # type: ignore[attr-defined]
        while start < end:
            plastic = reaches(start, np.array([force])) > -1e-9 * yield_force
            stiffness = b * k if plastic else k
            part = integrate(
                lambda t, y, s=stiffness: [s * float(motion.v(t))],
                start,
                end,
                force,
                yield_force,
                events=None if plastic else reaches,
            )
            inside = (motion.time >= start) & (motion.time <= part.t[-1])
            expected[inside] = part.sol(motion.time[inside])[0]
            start, force = part.t[-1], part.y[0, -1]
    got = core_force("elastic_plastic", [k, yield_force, b], motion)
    # cubics between samples against sines (1e-9 of u, times k u / Fy up to 6), and solve_ivp
    np.testing.assert_allclose(got, expected, atol=2e-8 * yield_force, rtol=0.0)


def test_friction_is_elastic_plastic_without_hardening() -> None:
    motion = Motion(0.006, seed=5)
    mu, normal, k = EXAMPLES["friction"].values()
    friction = core_force("friction", [mu, normal, k], motion)
    np.testing.assert_array_equal(friction, core_force("elastic_plastic", [k, mu * normal, 0.0], motion))
    assert np.max(np.abs(friction)) == mu * normal


@pytest.mark.parametrize("amplitude", [0.001, 0.006, 0.03])
@pytest.mark.parametrize("n", [1.0, 1.5, 4.0])
def test_asymptote_rate_equation(n: float, amplitude: float) -> None:
    """dF/du = dFa/du (1 + kappa (e/e0)^n), e = Fa - F, from one reversal to the next."""
    values = EXAMPLES["asymptote"] | {"n": n}
    f0, k1, k2, k3, kappa, n, c = values.values()
    motion = Motion(amplitude, seed=7)
    force, expected = 0.0, np.zeros_like(motion.time)
    for start, end in motion.pieces():
        sign = float(np.sign(motion.v(0.5 * (start + end))))

        def asymptote(t: float, sign: float = sign) -> float:
            u = float(motion.u(t))
            return sign * f0 + k1 * u + k2 * u * abs(u) + k3 * u**3

        e0 = asymptote(start) - force

        def rate(t: float, y: Array, e0: float = e0, asymptote: Callable[[float], float] = asymptote) -> list[float]:
            u = abs(float(motion.u(t)))
            slope = k1 + 2.0 * k2 * u + 3.0 * k3 * u * u
            share = max((asymptote(t) - y[0]) / e0, 0.0)  # below zero by the integrator's error only
            return [slope * (1.0 + kappa * share**n) * float(motion.v(t))]

        part = integrate(rate, start, end, force, f0)
        inside = (motion.time >= start) & (motion.time <= end)
        expected[inside] = part.sol(motion.time[inside])[0]
        force = part.y[0, -1]
    got = core_force("asymptote", list(values.values()), motion)
    # as above; stiffness up to (1 + kappa) k1, and k2 has a corner at u = 0, where the order of solve_ivp drops
    np.testing.assert_allclose(got, expected + c * motion.v(motion.time), atol=1e-6 * f0, rtol=0.0)


def test_ramberg_osgood_skeleton_by_brent() -> None:
    k, yield_force, a, n = EXAMPLES["ramberg_osgood"].values()
    damper = CoreDamper("ramberg_osgood", [k, yield_force, a, n])
    for u in np.geomspace(1e-6, 0.05, 40):
        force = damper.step(damper.start(), 1.0, (0.0, 0.0), (u, 0.0))[1]
        expected = brentq(
            lambda f, u=u: f / k * (1.0 + a * (f / yield_force) ** (n - 1.0)) - u, 0.0, 10.0 * yield_force, xtol=1e-9
        )
        assert force == pytest.approx(expected, rel=1e-13, abs=2e-9)


@pytest.mark.parametrize("seed", range(3))
def test_ramberg_osgood_loops_against_yielding_elements(seed: int) -> None:
    """Elastic-perfectly-plastic elements in parallel, whose skeleton is a polygon through the Ramberg-Osgood curve."""
    k, yield_force, a, n = EXAMPLES["ramberg_osgood"].values()
    motion = Motion(0.006, seed)
    elements = 3000
    force = 1.001 * np.max(np.abs(core_force("ramberg_osgood", [k, yield_force, a, n], motion)))
    force *= np.linspace(0.0, 1.0, elements + 1)
    u = force / k * (1.0 + a * (force / yield_force) ** (n - 1.0))
    tangent = np.append(np.diff(force) / np.diff(u), 0.0)
    stiffness, reach = -np.diff(tangent), u[1:]
    plastic = np.zeros(elements)
    expected, worst = np.zeros_like(motion.time), 0
    for start, end in motion.pieces():
        inside = np.flatnonzero((motion.time >= start) & (motion.time <= end))
        for i in inside:
            elastic = np.clip(float(motion.u(motion.time[i])) - plastic, -reach, reach)
            expected[i] = elastic @ stiffness
        plastic = float(motion.u(end)) - np.clip(float(motion.u(end)) - plastic, -reach, reach)
        worst = max(worst, inside.size)
    assert len(motion.pieces()) > 8 and worst > 50  # loops in loops
    got = core_force("ramberg_osgood", [k, yield_force, a, n], motion)
    # the polygon lies within (force step)^2 / 8 times the curvature n (n-1) a/Fy^2 u of the curve: 1e-7 here
    np.testing.assert_allclose(got, expected, atol=1e-6 * yield_force, rtol=0.0)


@pytest.mark.parametrize("n", [1.0, 2.0])
def test_asymptote_as_published_creates_energy(n: float) -> None:
    """Published law: up with a small ripple, down without, gives more back than was put in.

    After each turn the tangent is (1 + kappa) k1 again, so that a ripple of vanishing size keeps the hysteretic force
    at w = kappa k1 u on the way up: work w^2 / (2 kappa k1). On the way down from w at the distance q = f0 + w the
    force follows the law: for n = 1 it gives (q / (kappa k1)) (w - f0 ln(q/f0)) until w = 0, which is more; for n = 2
    (q / (kappa k1)) (q ln(q/f0) - w). Here f0 = k1 = 1, kappa = 3, w = 0.95.
    """
    kappa = 3.0
    damper = CoreDamper("asymptote", [1.0, 1.0, 0.0, 0.0, kappa, n, 0.0])
    node, weight = np.polynomial.legendre.leggauss(5)

    def gained(ripple: float) -> tuple[float, float]:
        state, u, work = damper.start(), 0.0, 0.0

        def go(target: float) -> float:
            nonlocal state, u, work
            force = 0.0
            for part in np.diff(np.linspace(u, target, 1 + int(np.ceil(abs(target - u) / 0.05)))):
                on_the_way = [0.5 * part * (1.0 + x) for x in node]
                forces = [damper.step(state, 1.0, (u, way), (u + way, way))[1] for way in on_the_way]
                work += 0.5 * part * float(weight @ np.array(forces))
                state, force, _ = damper.step(state, 1.0, (u, part), (u + part, part))
                u += part
            return force - u

        w = go(2.0 * ripple)
        while w < 0.95:
            go(u - ripple)
            w = go(u + 2.0 * ripple)
        top, here = state, u
        go(brentq(lambda x: damper.step(top, 1.0, (here, 0.0), (x, 0.0))[1] - x, here - 10.0, here - 1e-9))
        q = 1.0 + w
        back = q / kappa * (w - np.log(q) if n == 1.0 else q * np.log(q) - w)
        return 0.5 * u * u - work, back - w * w / (2.0 * kappa)  # without the elastic part

    (coarse, _), (fine, expected) = gained(1e-3), gained(5e-4)
    assert fine > 0.9 * expected > 0.02  # in units of f0^2 / k1
    assert 2.0 * fine - coarse == pytest.approx(expected, rel=0.01)  # what the ripple costs is of the order of its size
