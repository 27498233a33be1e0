"""Orders of convergence and numerical damping of the time integrators on linear oscillators."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import Structure, channel, oscillator

from edesign.core import HHT, GeneralisedAlpha, Integrator, Newmark

M, T = 1000.0, 0.8
OMEGA = 2 * np.pi / T
K = M * OMEGA**2
ZETA = 0.05
METHODS: dict[str, Integrator] = {
    "average": Newmark(),
    "linear": Newmark(0.5, 1 / 6),
    "hht": HHT(-0.2),
    "alpha": GeneralisedAlpha(0.6),
    "alpha_0": GeneralisedAlpha(0.0),
}


def run(method: Integrator, ground: np.ndarray, dt: float, velocity: float = 0.0, damping: bool = True) -> np.ndarray:
    """Displacement of the oscillator."""
    s: Structure = oscillator(K, M)
    a = s.analysis(tolerance=1e-12)
    if damping:
        a.rayleigh(2 * ZETA * OMEGA, 0.0)
    a.initial_velocity([velocity])
    r = a.history(ground, dt, method, [channel("displacement", s.nodes[1], 0, "u")])
    assert r.status == "completed", r.reason
    return r.values["u"]


def damped_sine(t: np.ndarray, v0: float) -> np.ndarray:
    wd = OMEGA * np.sqrt(1 - ZETA**2)
    return v0 / wd * np.exp(-ZETA * OMEGA * t) * np.sin(wd * t)


def forced(t: np.ndarray, amplitude: float, frequency: float) -> np.ndarray:
    """From rest under ground acceleration A sin(w t): Chopra (2012), Eqs. 3.2.3-3.2.4 with p0 / k = -A / omega^2."""
    ratio = frequency / OMEGA
    static = -amplitude / OMEGA**2
    d = (1 - ratio**2) ** 2 + (2 * ZETA * ratio) ** 2
    c, e = static * (1 - ratio**2) / d, static * -2 * ZETA * ratio / d
    wd = OMEGA * np.sqrt(1 - ZETA**2)
    a = -e
    b = (-ZETA * OMEGA * e - frequency * c) / wd
    decay = np.exp(-ZETA * OMEGA * t)
    return decay * (a * np.cos(wd * t) + b * np.sin(wd * t)) + c * np.sin(frequency * t) + e * np.cos(frequency * t)


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
@pytest.mark.parametrize("kind", ["free", "forced"])
def test_second_order(method: Integrator, kind: str) -> None:
    errors = []
    for n in (200, 400, 800, 1600):
        t = np.linspace(0.0, 4.0, n + 1)
        if kind == "free":
            u, exact = run(method, np.zeros(n + 1), t[1], 0.3), damped_sine(t, 0.3)
        else:
            u, exact = run(method, 2.0 * np.sin(5.0 * t), t[1]), forced(t, 2.0, 5.0)
        errors.append(np.max(np.abs(u - exact)) / np.max(np.abs(exact)))
    order = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert order[-1] == pytest.approx(2.0, abs=0.05), (errors, order)
    assert errors[-1] < 2e-3


def amplification(method: Integrator, step: float) -> np.ndarray:
    """3x3 matrix of (u, dt v, dt^2 a) of the undamped oscillator over a step with omega dt = step, built from the
    definition."""
    _, p = method.parameters()
    am, af, g, b = (0.0, 0.0, *p) if len(p) == 2 else p
    s2 = step**2
    # unknowns u1 v1 a1 of the three equations: balance, and Newmark's two
    left = np.array([[(1 - af) * s2, 0, 1 - am], [1, 0, -b], [0, 1, -g]])
    right = np.array([[-af * s2, 0, -am], [1, 1, 0.5 - b], [0, 1, 1 - g]])
    return np.linalg.solve(left, right)


# linear acceleration is unstable above 2 sqrt(3)
STEPS = [(name, step) for name in METHODS for step in (0.3, 2.0, 50.0, 1e4) if name != "linear" or step < 3.46]


@pytest.mark.parametrize("name, step", STEPS)
def test_free_motion_follows_the_amplification_matrix(name: str, step: float) -> None:
    """Step by step, to the rounding of 40 steps."""
    method = METHODS[name]
    dt = step / OMEGA
    u = run(method, np.zeros(41), dt, 0.3, damping=False)
    state = np.array([0.0, 0.3 * dt, 0.0])
    A = amplification(method, step)
    expected = [0.0]
    for _ in range(40):
        state = A @ state
        expected.append(state[0])
    np.testing.assert_allclose(u, expected, atol=1e-9 * np.max(np.abs(expected)))


@pytest.mark.parametrize("rho", [0.0, 0.3, 0.6, 1.0])
def test_high_frequencies_decay_at_the_chosen_rate(rho: float) -> None:
    """Chung & Hulbert (1993): spectral radius rho_inf for omega dt -> infinity and at most 1 anywhere.

    That the core follows this matrix is tested above. Roots of a triple eigenvalue come out to eps^(1/3) = 1e-5.
    """
    radius = [
        float(np.max(np.abs(np.linalg.eigvals(amplification(GeneralisedAlpha(rho), s)))))
        for s in np.logspace(-2, 4, 25)
    ]
    assert max(radius) <= 1 + 1e-6
    assert radius[-1] == pytest.approx(rho, abs=0.02)


@pytest.mark.parametrize("alpha", [-0.05, -0.2, -1 / 3])
def test_hht_spectral_radius_at_infinity(alpha: float) -> None:
    """Hilber, Hughes & Taylor (1977): (1 + alpha) / (1 - alpha) from the double root; the third root is alpha / (1
    + alpha)."""
    eigen = np.sort(np.abs(np.linalg.eigvals(amplification(HHT(alpha), 1e5))))
    assert eigen[0] == pytest.approx(-alpha / (1 + alpha), rel=3e-3)  # at -1/3 the three meet: eps^(1/3)
    assert eigen[2] == pytest.approx((1 + alpha) / (1 - alpha), rel=3e-3)


def test_average_acceleration_conserves_energy() -> None:
    """Undamped: kinetic and elastic energy stay, to the rounding of 2000 steps."""
    s = oscillator(K, M)
    a = s.analysis(tolerance=1e-13)
    a.initial_velocity([0.3])
    r = a.history(np.zeros(2001), 0.01)
    total = r.energy["kinetic"] + r.energy["elastic"]
    np.testing.assert_allclose(total, 0.5 * M * 0.3**2, rtol=1e-10)


def test_period_elongation() -> None:
    """Newmark average acceleration: tan(w' dt / 2) = omega dt / 2 (Chopra 2012, 5.5): peaks where it says."""
    dt = T / 20
    u = run(Newmark(), np.zeros(401), dt, 0.3, damping=False)
    discrete = 2 / dt * np.arctan(OMEGA * dt / 2)
    amplitude = 0.3 / OMEGA  # conserved energy
    np.testing.assert_allclose(u, amplitude * np.sin(discrete * dt * np.arange(401)), atol=1e-9 * amplitude)
