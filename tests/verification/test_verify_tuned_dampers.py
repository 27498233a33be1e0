"""Tuned mass and liquid dampers: against numerical optima, potential flow by series, and the oscillator they stand for.

References, none of which uses the formulas under test: the response of the two masses by its complex equations; its
variance under white noise by Lyapunov's equation (scipy); the balance of mass of all sloshing modes.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

from edesign.damper.tuned import (
    sloshing_frequency,
    sloshing_mass_ratio,
    tuned_mass,
)
from edesign.errors import InputError


def amplitude(mu: float, f: float, zeta: float, omega: np.ndarray, base: bool) -> np.ndarray:
    """Displacement of the structure (mass 1, frequency 1 rad/s) over the static one: Eqs. 2.26-2.27."""
    spring = mu * f**2 + 1j * omega * 2.0 * zeta * mu * f
    a11, a12, a22 = 1.0 - omega**2 + spring, -spring, spring - mu * omega**2
    p1, p2 = (1.0, mu) if base else (1.0, 0.0)
    return np.abs((p1 * a22 - p2 * a12) / (a11 * a22 - a12**2))


def variance(mu: float, f: float, zeta: float, base: bool) -> float:
    """Of the structure's displacement under white noise, by Lyapunov's equation."""
    k, c = mu * f**2, 2.0 * zeta * mu * f
    M = np.diag([1.0, mu])
    C, K = np.array([[c, -c], [-c, c]]), np.array([[1.0 + k, -k], [-k, k]])
    A = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    load = np.array([[0.0], [0.0], [1.0], [1.0 if base else 0.0]])
    return float(scipy.linalg.solve_continuous_lyapunov(A, -load @ load.T)[0, 0])


@pytest.mark.parametrize("mu", [0.005, 0.02, 0.1])
@pytest.mark.parametrize("base", [False, True])
def test_white_noise_optimum_minimises_the_variance(mu: float, base: bool) -> None:
    damper = tuned_mass(mu, 1.0, 0.5 / math.pi, "white_noise_base" if base else "white_noise_force")
    start = [1.0 / (1.0 + mu), 0.5 * math.sqrt(mu)]
    best = scipy.optimize.minimize(
        lambda x: variance(mu, x[0], x[1], base), start, method="Nelder-Mead", options={"xatol": 1e-7, "fatol": 1e-12}
    )
    assert (damper.frequency_ratio, damper.damping_ratio) == pytest.approx(tuple(best.x), rel=1e-4)


@pytest.mark.parametrize("mu", [0.005, 0.02, 0.1])
@pytest.mark.parametrize("base", [False, True])
def test_harmonic_optimum_is_close_to_the_lowest_peak(mu: float, base: bool) -> None:
    """The rule of fixed points is an approximation: its peak lies within 1 % above the lowest, and the two peaks differ
    by as little; its frequency is exact to 0.5 % (Asami & Nishihara 2003)."""
    omega = np.linspace(0.6, 1.3, 4001)

    def peak(x: np.ndarray) -> float:
        return float(amplitude(mu, x[0], x[1], omega, base).max())

    damper = tuned_mass(mu, 1.0, 0.5 / math.pi, "harmonic_base" if base else "harmonic_force")
    here = np.array([damper.frequency_ratio, damper.damping_ratio])
    best = scipy.optimize.minimize(peak, here * [1.01, 0.9], method="Nelder-Mead", options={"xatol": 1e-6})
    assert best.fun <= peak(here) <= 1.01 * best.fun
    assert here[0] == pytest.approx(best.x[0], rel=5e-3)
    assert here[1] == pytest.approx(best.x[1], rel=0.05)  # the peak is flat in the damping


def test_den_hartogs_peak() -> None:
    """At the fixed points the amplitude is sqrt(1 + 2 / mu), whatever the damping (Den Hartog 1956, 3.3)."""
    mu = 0.05
    f = tuned_mass(mu, 1.0, 1.0, "harmonic_force").frequency_ratio
    points = np.sqrt((1.0 + np.array([-1.0, 1.0]) * math.sqrt(mu / (2.0 + mu))) / (1.0 + mu))
    for zeta in (0.03, 0.2, 0.9):
        np.testing.assert_allclose(amplitude(mu, f, zeta, points, False), math.sqrt(1.0 + 2.0 / mu), rtol=1e-12)


def test_stiffness_and_dashpot_give_the_ratios() -> None:
    damper = tuned_mass(0.02, 1.5e6, 0.4)
    assert damper.mass == pytest.approx(3.0e4)
    own = math.sqrt(damper.stiffness / damper.mass)
    assert own / (2.0 * math.pi * 0.4) == pytest.approx(damper.frequency_ratio)
    assert damper.damping / (2.0 * damper.mass * own) == pytest.approx(damper.damping_ratio)


@pytest.mark.parametrize("ratio", [0.02, 0.05, 0.1])
def test_shallow_water(ratio: float) -> None:
    """Lepelletier & Raichlen (1988), thesis Eq. 2.31: kappa sqrt(g h) (1 - x^2/6 + 19 x^4/360 - ...), x = kappa h."""
    x = math.pi * ratio
    shallow = math.pi * math.sqrt(9.80665 * ratio / 10.0) * (1.0 - x**2 / 6.0)
    exact = sloshing_frequency(10.0, 10.0 * ratio)
    assert (exact - shallow) / exact == pytest.approx(19.0 * x**4 / 360.0, rel=0.1)  # of the terms behind it


def test_deep_water_limit() -> None:
    """omega^2 = pi g / L whatever the depth (Lamb 1932, article 228)."""
    assert sloshing_frequency(2.0, 20.0) == pytest.approx(math.sqrt(math.pi * 9.80665 / 2.0), rel=1e-12)


def test_masses_of_all_modes_in_shallow_water_are_the_whole() -> None:
    """All water slides to and fro: the masses add to 1; the tail beyond mode 2000 is 1e-4. Deep water: mostly fixed."""
    assert sum(sloshing_mass_ratio(1.0, 1e-6, n) for n in range(1, 2001)) == pytest.approx(1.0, abs=2e-4)
    # Housner (1957): 0.527 (l / h) tanh(1.58 h / l), l = L / 2, made for design: 2 to 3 % above
    for ratio in (0.1, 0.3, 1.0):
        housner = 0.527 / (2.0 * ratio) * math.tanh(1.58 * 2.0 * ratio)
        assert sloshing_mass_ratio(1.0, ratio) == pytest.approx(housner, rel=0.03)


def test_bad_input() -> None:
    with pytest.raises(InputError, match="did you mean `white_noise_base`"):
        tuned_mass(0.02, 1.0, 1.0, "white_noise_bas")
    with pytest.raises(InputError, match="mass_ratio = 1.5 .*E-LAW-03"):
        tuned_mass(1.5, 1.0, 1.0)
    with pytest.raises(InputError, match="depth"):
        sloshing_frequency(1.0, 0.0)
