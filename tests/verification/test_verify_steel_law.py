"""The law of steel with combined hardening against closed forms of Lemaitre & Chaboche (1990), 5.4, and small steps."""

from __future__ import annotations

import numpy as np
import pytest
from damper_examples import EXAMPLES
from scipy.optimize import brentq

from edesign.core import CoreError
from edesign.core.damper import CoreDamper

STEEL = EXAMPLES["chaboche"]
K, FY, C1, G1, C2, G2, Q, B = STEEL.values()


def force(u: np.ndarray, **changes: float) -> np.ndarray:
    """Force (n,) N of deformations (n,) m, each reached at rest."""
    damper = CoreDamper("chaboche", tuple({**STEEL, **changes}.values()))
    return damper.force(np.arange(u.size, dtype=float), u, np.zeros_like(u))


def test_the_first_loading_is_the_sum_of_voce_and_armstrong_and_frederick() -> None:
    plastic = np.linspace(0.0, 0.03, 31)[1:]
    expected = FY + Q * (1.0 - np.exp(-B * plastic))
    expected += C1 / G1 * (1.0 - np.exp(-G1 * plastic)) + C2 / G2 * (1.0 - np.exp(-G2 * plastic))
    for side in (1.0, -1.0):
        u = side * np.concatenate(([0.0], expected / K + plastic))
        np.testing.assert_allclose(force(u)[1:], side * expected, rtol=1e-12)
        last = force(u[[0, -1]])[-1]  # at once
        assert last == pytest.approx(side * expected[-1], rel=1e-12)
    linear = FY + Q * (1.0 - np.exp(-B * plastic)) + C1 / G1 * (1.0 - np.exp(-G1 * plastic)) + C2 * plastic
    u = np.concatenate(([0.0], linear / K + plastic))
    np.testing.assert_allclose(force(u, gamma2=0.0)[1:], linear, rtol=1e-12)


@pytest.mark.parametrize("gained", [20e3, -25e3])
@pytest.mark.parametrize("amplitude", [3e-3, 8e-3, 20e-3])
def test_the_steady_loop_has_the_peak_of_the_hyperbolic_tangents(amplitude: float, gained: float) -> None:
    """F = Fy + Q + sum of C/gamma tanh(gamma p), p the amplitude of the plastic deformation; softening if Q < 0."""
    u = np.concatenate(([0.0], np.tile([amplitude, -amplitude], 3000)))

    def peak(plastic: float) -> float:
        hardened = C1 / G1 * np.tanh(G1 * plastic) + C2 / G2 * np.tanh(G2 * plastic)
        return float(FY + gained + hardened)

    plastic = brentq(lambda p: peak(p) + K * (p - amplitude), 0.0, amplitude, xtol=1e-16)
    found = force(u, Q=gained)
    assert found[-2] == pytest.approx(peak(plastic), rel=1e-9) and found[-1] == pytest.approx(-peak(plastic), rel=1e-9)


def small_steps(u: np.ndarray, parts: int) -> np.ndarray:
    """Force (n,) of a way in steps so small that one of Euler will do, by the differential equations."""
    p = s = x1 = x2 = 0.0
    found = np.zeros_like(u)
    for i in range(1, u.size):
        du = (u[i] - u[i - 1]) / parts
        for j in range(parts):
            total = K * (u[i - 1] + (j + 1) * du - p)
            side = 1.0 if total > x1 + x2 else -1.0
            over = side * (total - x1 - x2) - FY - Q * (1.0 - np.exp(-B * s))
            if over > 0.0:
                dx = C1 - side * G1 * x1 + C2 - side * G2 * x2
                way = over / (K + dx + Q * B * np.exp(-B * s))
                x1, x2 = x1 + (side * C1 - G1 * x1) * way, x2 + (side * C2 - G2 * x2) * way
                p, s = p + side * way, s + way
        found[i] = K * (u[i] - p)
    return found


def test_a_random_way_is_that_of_the_differential_equations_in_small_steps() -> None:
    u = np.concatenate(([0.0], 6e-3 * np.random.default_rng(5).standard_normal(40)))
    exact = force(u)
    errors = [float(np.max(np.abs(small_steps(u, parts) - exact))) for parts in (500, 1000)]
    assert errors[1] < 1e-3 * np.max(np.abs(exact))
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.2)  # Euler's are of first order in the step


def test_intermediate_samples_change_nothing() -> None:
    u = np.concatenate(([0.0], 6e-3 * np.random.default_rng(6).standard_normal(60)))
    fine = np.interp(np.arange(0.0, 60.01, 0.1), np.arange(61.0), u)
    np.testing.assert_allclose(force(fine)[::10], force(u), rtol=0.0, atol=1e-11 * 1e5)


def test_parameters_without_a_strength_are_refused() -> None:
    with pytest.raises(CoreError, match="Q = -60000 is not allowed: above -Fy"):
        force(np.zeros(2), Q=-60e3)
    with pytest.raises(CoreError, match="falls faster than the spring unloads"):
        force(np.zeros(2), Q=-50e3, b=1e3)
