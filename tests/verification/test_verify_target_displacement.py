"""Target displacements against closed forms: idealisations of known curves, and the factors of the codes by hand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import ArrayLike

from edesign.codes.asce41 import target_displacement as asce41
from edesign.codes.capacity_curve import CapacityCurve
from edesign.codes.ec8.analysis import target_displacement as n2
from edesign.codes.fema356 import target_displacement as fema356
from edesign.codes.fema356.idealisation import bilinear
from edesign.errors import InputError

K, F_Y = 20e6, 1e6  # of an elastoplastic frame, N/m and N
D_Y = F_Y / K
MASS = 1e6


@dataclass(frozen=True)
class Hyperbola:
    """S = v / T: constant velocity at all periods."""

    velocity: float
    label: str = "v / T"
    damping: float = 0.05
    zero_period: float = 0.0

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        return self.velocity / np.asarray(period, dtype=float)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        return self.velocity * np.asarray(period, dtype=float) / (2 * math.pi) ** 2


def elastoplastic(slope: float = 0.0, end: float = 1.0) -> CapacityCurve:
    """Elastic up to F_Y, then `slope` times K; a slope of 0 is one of 1e-12, so that the peak is at the end."""
    beyond = F_Y + (slope or 1e-12) * K * (end - D_Y)
    return CapacityCurve(np.array([0.0, D_Y, end]), np.array([0.0, F_Y, beyond]))


def no_loads(first: float, last: float) -> None:
    """Nothing is known of vertical loads."""


def parabola(end: float = 0.4) -> CapacityCurve:
    """F = F_Y (2 x - x^2) with x = d / end, which peaks at the end with an area of 2/3 of the rectangle."""
    x = np.linspace(0.0, 1.0, 4001)
    return CapacityCurve(end * x, F_Y * (2 * x - x * x))


def test_equal_energy_of_an_elastoplastic_curve_is_itself() -> None:
    for d_m in (0.06, 0.2, 1.0):
        found = n2.idealised(elastoplastic(), MASS, d_m)
        assert (found.F_y, found.d_y) == pytest.approx((F_Y, D_Y), rel=1e-7)
        assert found.T == pytest.approx(2 * math.pi * math.sqrt(MASS / K), rel=1e-7)


def test_equal_energy_of_a_parabola() -> None:
    """d_y = 2 (1 - 2/3) d_m = 2/3 d_m; trapezoids of 1/4000 err by 1e-8 of it."""
    found = n2.idealised(parabola(), MASS, 0.4)
    assert (found.F_y, found.d_y) == pytest.approx((F_Y, 0.8 / 3), rel=1e-6)


def test_equal_energy_with_hardening() -> None:
    """Fy = F(d_m); d_y = 2 (d_m - E / Fy) with E by hand."""
    curve, d_m = elastoplastic(0.1), 0.25
    F = F_Y + 0.1 * K * (d_m - D_Y)
    E = 0.5 * F_Y * D_Y + 0.5 * (F_Y + F) * (d_m - D_Y)
    found = n2.idealised(curve, MASS, d_m)
    assert (found.F_y, found.d_y) == pytest.approx((F, 2 * (d_m - E / F)), rel=1e-12)


def test_targets_of_the_n2_method() -> None:
    """Gamma d_et* beyond T_C; elastic frames there and below too; short periods by Eq. B.10, at most 3 d_et*."""
    spectrum, oscillator = Hyperbola(1.5), n2.Oscillator(MASS, 1.3)
    T = 2 * math.pi * math.sqrt(MASS / K)
    curve = elastoplastic().scaled(1.3)
    long = n2.target_displacement(curve, oscillator, spectrum, 0.5)
    assert long.d_t == pytest.approx(1.3 * 1.5 * T / (2 * math.pi) ** 2, rel=1e-6)
    assert long.q_u == pytest.approx(1.5 / T * MASS / F_Y, rel=1e-6)
    short = n2.target_displacement(curve, oscillator, spectrum, 2.0)
    expected = long.d_et / long.q_u * (1 + (long.q_u - 1) * 2.0 / T)
    assert short.d_t_oscillator == pytest.approx(expected, rel=1e-6)
    assert n2.oscillator_target(10.0, 0.1, 1.0, 20.0) == pytest.approx(3 * 10.0 * (0.1 / (2 * math.pi)) ** 2)
    weak = n2.target_displacement(curve, oscillator, Hyperbola(0.1), 2.0)
    assert weak.q_u < 1.0 and weak.d_t == pytest.approx(1.3 * 0.1 * T / (2 * math.pi) ** 2, rel=1e-6)


def test_the_target_fits_its_own_idealisation() -> None:
    """A curve that bends throughout: d_m* = d_t* to 1e-8, and a target beyond the peak is idealised up to the peak."""
    spectrum, oscillator = Hyperbola(1.0), n2.Oscillator(MASS, 1.0)
    found = n2.target_displacement(parabola(), oscillator, spectrum, 0.5)
    assert found.idealisation.d_m == pytest.approx(found.d_t_oscillator, rel=1e-7)
    assert 0.0 < found.d_t < 0.4
    far = n2.target_displacement(parabola(), oscillator, Hyperbola(100.0), 0.5)
    assert far.idealisation.d_m == pytest.approx(0.4) and far.d_t > 0.4


def test_targets_too_small_for_the_curve_are_refused() -> None:
    with pytest.raises(InputError, match="1e-09 of the 1 m .*E-EC8-06"):
        n2.target_displacement(elastoplastic(0.1), n2.Oscillator(MASS, 1.0), Hyperbola(1e-12), 0.5)
    with pytest.raises(InputError, match=" 1e-200 .*E-EC8-06"):
        n2.equivalent_oscillator(np.array([1.0, 1e-200]), np.ones(2))


def test_oscillator_of_uniform_and_linear_shapes() -> None:
    """Phi = 1: m* = sum m, Gamma = 1. Phi = i/n of n equal masses: Gamma = 3 n / (2 n + 1)."""
    masses = np.full(10, 5e4)
    uniform = n2.equivalent_oscillator(masses, masses)
    assert (uniform.mass, uniform.Gamma) == pytest.approx((5e5, 1.0))
    linear = n2.equivalent_oscillator(7.0 * masses * np.arange(1, 11), masses)
    assert (linear.mass, linear.Gamma) == pytest.approx((5e4 * 5.5, 30 / 21))
    with pytest.raises(InputError, match="E-EC8-06"):
        n2.equivalent_oscillator(np.array([1.0, 0.0]), np.array([1.0, 0.0]))


@pytest.mark.parametrize("slope", [0.0, 0.02, 0.1])
def test_two_lines_of_a_bilinear_curve_are_itself(slope: float) -> None:
    found = bilinear(elastoplastic(slope), 0.5)
    assert (found.V_y, found.D_y) == pytest.approx((F_Y, D_Y), rel=1e-6)
    assert found.alpha == pytest.approx(slope, abs=1e-6)
    assert found.effective_period(1.2) == pytest.approx(1.2, rel=1e-6)


def test_two_lines_of_a_trilinear_curve() -> None:
    """Cracked at 0.4 V: the secant at 0.6 V_y lies on the second part; areas agree; T_e = T_i sqrt(K_i / K_e)."""
    curve = CapacityCurve(np.array([0.0, 0.01, 0.06, 0.5]), np.array([0.0, 0.4e6, 1e6, 1.1e6]))
    found = bilinear(curve, 0.4)
    area = 0.5 * found.V_y * found.D_y + 0.5 * (found.V_y + found.V_d) * (0.4 - found.D_y)
    assert area == pytest.approx(curve.energy(0.4), rel=1e-8)
    secant = 0.01 + (0.6 * found.V_y - 0.4e6) * 0.05 / 0.6e6
    assert found.K_e == pytest.approx(0.6 * found.V_y / secant, rel=1e-8)
    assert found.K_i == pytest.approx(40e6)


def test_two_lines_of_a_straight_curve() -> None:
    found = bilinear(elastoplastic(), 0.5 * D_Y)
    assert (found.K_e, found.V_y, found.alpha) == pytest.approx((K, 0.5 * F_Y, 1.0))


def test_factors_by_hand() -> None:
    """ASCE/SEI 41-17, Eqs. 7-29 and 7-30; FEMA 356, 3.3.3.3.2, whose C_1 and C_3 UFC 3-310-03A, 5-4, has too."""
    assert asce41.inelastic_factor(4.0, 0.5, 60.0) == pytest.approx(1.2)
    assert asce41.inelastic_factor(4.0, 0.1, 60.0) == pytest.approx(1 + 3 / (60 * 0.04))
    assert asce41.inelastic_factor(4.0, 1.01, 60.0) == 1.0
    assert asce41.inelastic_factor(0.8, 0.5, 60.0) == 1.0
    assert asce41.degradation_factor(5.0, 0.5) == pytest.approx(1.08)
    assert asce41.degradation_factor(5.0, 0.71) == 1.0
    assert fema356.inelastic_factor(4.0, 0.7, 0.6) == 1.0
    assert fema356.inelastic_factor(2.0, 0.5, 0.6) == pytest.approx(min(1.1, 1 + 0.5 * 0.1 / 0.5))
    assert fema356.inelastic_factor(9.0, 0.05, 0.6) == pytest.approx(1.5)
    assert fema356.unlimited_inelastic_factor(9.0, 0.05, 0.6) == pytest.approx((1 + 8 * 12) / 9)
    assert fema356.unlimited_inelastic_factor(0.9, 0.05, 0.6) == 1.0
    assert fema356.second_order_factor(5.0, 2.0, -0.05) == pytest.approx(1 + 0.05 * 8 / 2)
    assert fema356.second_order_factor(5.0, 2.0, 0.05) == 1.0
    assert [fema356.effective_mass_factor(n, T) for n, T in ((2, 0.5), (3, 0.5), (10, 1.1))] == [1.0, 0.9, 1.0]


def test_targets_of_the_coefficient_methods() -> None:
    """An elastoplastic frame with 0.44 s: everything but the target follows from K, F_Y and the spectrum."""
    mass, spectrum = 0.1 * MASS, Hyperbola(15.0)
    T = 2 * math.pi * math.sqrt(mass / K)
    S_a = 15.0 / T
    R = S_a * mass * 0.9 / F_Y
    found, limit = asce41.target_displacement(elastoplastic(), T, 1.3, mass, 4, spectrum, "D", 0.2, no_loads)
    elastic = 1.3 * S_a * (T / (2 * math.pi)) ** 2
    assert found.ratio == pytest.approx(R, rel=1e-6)
    C_1, C_2 = 1 + (R - 1) / (60 * T**2), 1 + ((R - 1) / T) ** 2 / 800
    assert found.d_t == pytest.approx(C_1 * C_2 * elastic, rel=1e-6)
    assert limit.alpha_2 is None and limit.mu_max == math.inf
    old = fema356.target_displacement(elastoplastic(), T, 1.3, mass, 4, spectrum, 0.8)
    C_1 = min((1 + (R - 1) * 0.8 / T) / R, 1 + 0.5 * (0.8 - T) / 0.7)
    assert old.d_t == pytest.approx(C_1 * elastic, rel=1e-6)


def test_a_descent() -> None:
    """A peak at D_Y and a descent of 5 % of K: FEMA 356 has it as alpha of C_3, ASCE/SEI 41 as mu_max."""
    curve = elastoplastic(-0.05, 0.6)
    spectrum, T = Hyperbola(3.0), 2 * math.pi * math.sqrt(MASS / K)
    old = fema356.target_displacement(curve, T, 1.0, MASS, 1, spectrum, 0.5)
    assert old.idealisation.alpha == pytest.approx(-0.05, rel=1e-5)
    R = 3.0 / T * MASS / F_Y
    assert old.C_3 == pytest.approx(1 + 0.05 * (R - 1) ** 1.5 / T, rel=1e-5)
    found, limit = asce41.target_displacement(curve, T, 1.0, MASS, 1, spectrum, "B", 0.2, no_loads)
    assert limit.alpha_e == pytest.approx(-0.05, rel=1e-6)
    h = 1 + 0.15 * math.log(T)
    assert limit.mu_max == pytest.approx(1.0 + 0.05**-h / 4, rel=1e-5)
    assert found.idealisation.D_d == pytest.approx(D_Y)


@pytest.mark.parametrize(("S_X1", "factor"), [(0.599, 0.2), (0.6, 0.8)])
def test_effective_slope_of_a_descent(S_X1: float, factor: float) -> None:
    """ASCE/SEI 41-17, Eq. 7-33: -0.02 + lambda (-0.05 + 0.02), lambda 0.8 from S_X1 = 0.6 g on."""
    assert asce41.near_fault_factor(S_X1 * 9.80665) == factor
    curve, T = elastoplastic(-0.05, 0.6), 1.4

    def loads(first: float, last: float) -> float:
        assert (first, last) == pytest.approx((D_Y, D_Y + 0.4 / 0.05 * D_Y))  # down to 60 % of V_y
        return -0.02 * K

    limit = asce41.strength_limit(curve, bilinear(curve, D_Y), T, factor, loads)
    assert (limit.alpha_2, limit.alpha_PDelta) == pytest.approx((-0.05, -0.02))
    assert limit.alpha_e == pytest.approx(-0.02 - 0.03 * factor)
    assert limit.mu_max == pytest.approx(1.0 + (0.02 + 0.03 * factor) ** -(1 + 0.15 * math.log(T)) / 4)


@pytest.mark.parametrize(
    ("displacement", "force"),
    [([0.0], [0.0]), ([0.0, 0.1, 0.1], [0.0, 1.0, 2.0]), ([0.0, 0.1], [0.0, -1.0])],
)
def test_no_capacity_curve(displacement: list[float], force: list[float]) -> None:
    with pytest.raises(InputError, match="E-CURVE-05"):
        CapacityCurve(np.array(displacement), np.array(force))
