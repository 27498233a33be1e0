"""Spectra of EN 1998-1:2004 against ordinates computed by hand from its equations and Tables 3.2-3.4 and A.1.

All ordinates are for a_gR = 1 m/s2 unless said otherwise; tolerances are those of the digits that are printed here.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from edesign.codes.ec8 import (
    DesignSpectrum,
    ElasticSpectrum,
    LongPeriodSpectrum,
    VerticalSpectrum,
    damping_correction,
    national_parameters,
    vertical_design_spectrum,
)
from edesign.codes.ec8.action.displacement import design_ground_displacement
from edesign.codes.ec8.action.importance import (
    factor_of_probability,
    factor_of_return_period,
    return_period_of,
)
from edesign.errors import InputError

EC8 = national_parameters()
GROUNDS = "ABCDE"

# type, ground: periods T_B/2, T_B, T_C, 2 T_C, T_D, 2 T_D (s) and S_e at 0, T_B/2, plateau, 2 T_C, T_D, 2 T_D
ELASTIC = {
    (1, "A"): ((0.075, 0.15, 0.4, 0.8, 2.0, 4.0), (1.00, 1.7500, 2.500, 1.2500, 0.50, 0.125)),
    (1, "B"): ((0.075, 0.15, 0.5, 1.0, 2.0, 4.0), (1.20, 2.1000, 3.000, 1.5000, 0.75, 0.1875)),
    (1, "C"): ((0.100, 0.20, 0.6, 1.2, 2.0, 4.0), (1.15, 2.0125, 2.875, 1.4375, 0.8625, 0.215625)),
    (1, "D"): ((0.100, 0.20, 0.8, 1.6, 2.0, 4.0), (1.35, 2.3625, 3.375, 1.6875, 1.35, 0.3375)),
    (1, "E"): ((0.075, 0.15, 0.5, 1.0, 2.0, 4.0), (1.40, 2.4500, 3.500, 1.7500, 0.875, 0.21875)),
    (2, "A"): ((0.025, 0.05, 0.25, 0.5, 1.2, 2.4), (1.00, 1.7500, 2.500, 1.2500, 0.520833333, 0.130208333)),
    (2, "B"): ((0.025, 0.05, 0.25, 0.5, 1.2, 2.4), (1.35, 2.3625, 3.375, 1.6875, 0.703125, 0.17578125)),
    (2, "C"): ((0.050, 0.10, 0.25, 0.5, 1.2, 2.4), (1.50, 2.6250, 3.750, 1.8750, 0.78125, 0.1953125)),
    (2, "D"): ((0.050, 0.10, 0.30, 0.6, 1.2, 2.4), (1.80, 3.1500, 4.500, 2.2500, 1.125, 0.28125)),
    (2, "E"): ((0.025, 0.05, 0.25, 0.5, 1.2, 2.4), (1.60, 2.8000, 4.000, 2.0000, 0.833333333, 0.208333333)),
}


def elastic(ground: str = "C", spectrum_type: int = 1, damping: float = 0.05, gamma_I: float = 1.0) -> ElasticSpectrum:
    return ElasticSpectrum(1.0, EC8.horizontal(spectrum_type, ground), gamma_I, damping)


@pytest.mark.parametrize(("spectrum_type", "ground"), ELASTIC)
def test_elastic_spectrum_on_every_ground(spectrum_type: int, ground: str) -> None:
    (half, T_B, T_C, twice, T_D, double), expected = ELASTIC[spectrum_type, ground]
    spectrum = elastic(ground, spectrum_type)
    at = spectrum.acceleration([0.0, half, T_B, T_C, twice, T_D, double])
    zero, rising, plateau, falling, corner, last = expected
    np.testing.assert_allclose(at, [zero, rising, plateau, plateau, falling, corner, last], rtol=1e-8)
    assert spectrum.zero_period == pytest.approx(zero, rel=1e-15)


def test_the_spectrum_of_the_thesis() -> None:
    # zone 3 of Greece, ground C, type 1 (thesis 5.3.1): a_g = 0.36 x 9.80665 = 3.530394, a_g S = 4.0599531 m/s2
    greece = national_parameters("greece")
    spectrum = ElasticSpectrum(greece.a_gR("3"), greece.horizontal(1, "C"))
    assert spectrum.zero_period == pytest.approx(4.0599531, rel=1e-12)
    # plateau x 2.5; T = 1: x 0.6; T1 = 2.651286 of Table 5.3: 10.14988275 x 1.2 / 2.651286^2 = 1.732723
    ordinates = spectrum.acceleration([0.4, 1.0, 2.651286])
    np.testing.assert_allclose(ordinates, [10.14988275, 6.08992965, 1.732723], rtol=3e-7)


def test_damping_correction() -> None:
    assert damping_correction(0.05) == 1.0
    assert damping_correction(0.10) == pytest.approx(0.8164966, rel=1e-7)  # sqrt(10 / 15)
    assert damping_correction(0.02) == pytest.approx(1.1952286, rel=1e-7)  # sqrt(10 / 7)
    assert damping_correction(0.28) == pytest.approx(0.5504819, rel=1e-7)  # sqrt(10 / 33)
    assert damping_correction(0.30) == 0.55  # sqrt(10 / 35) = 0.535


def test_damping_changes_the_plateau_and_not_the_ground() -> None:
    spectrum = elastic(damping=0.10)
    # Eq. 3.2 at T_B / 2: 1.15 (1 + 0.5 (2.5 x 0.8164966 - 1)) = 1.7487135; plateau 1.15 x 2.5 x 0.8164966
    np.testing.assert_allclose(spectrum.acceleration([0.0, 0.1, 0.3]), [1.15, 1.7487139, 2.3474277], rtol=1e-7)


@pytest.mark.parametrize(("spectrum_type", "factor"), [(1, 1.0), (2, 0.5)])
def test_vertical_spectrum(spectrum_type: int, factor: float) -> None:
    # type 1: 0.9, at T_B / 2 0.9 (1 + 0.5 x 2), plateau 2.7, at 2 T_C half of it, at 2 T_D 2.7 x 0.15 / 4
    spectrum = VerticalSpectrum(1.0, EC8.vertical(spectrum_type))
    at = spectrum.acceleration([0.0, 0.025, 0.05, 0.15, 0.30, 1.0, 2.0])
    np.testing.assert_allclose(at, factor * np.array([0.9, 1.8, 2.7, 2.7, 1.35, 0.405, 0.10125]), rtol=1e-12)
    assert spectrum.zero_period == pytest.approx(0.9 * factor, rel=1e-15)
    damped = replace(spectrum, damping=0.10).acceleration(0.1)
    assert damped == pytest.approx(factor * 2.2045408, rel=1e-7)  # 2.7 x 0.8164966
    assert spectrum.displacement(1.0) == pytest.approx(factor * 0.405 / (4 * math.pi**2), rel=1e-12)


def test_design_spectrum() -> None:
    # ground C, q = 4: S 2/3; at T_B / 2 1.15 (2/3 + 0.5 (0.625 - 2/3)); 1.15 x 0.625; half of it; at 2 s x 0.3
    spectrum = DesignSpectrum.of(elastic(), q=4.0)
    at = spectrum.acceleration([0.0, 0.1, 0.2, 0.6, 1.2, 2.0])
    np.testing.assert_allclose(at, [0.766666667, 0.742708333, 0.71875, 0.71875, 0.359375, 0.215625], rtol=1e-9)
    # at 4 s 0.71875 x 1.2 / 16 = 0.05390625 is less than beta a_g
    assert spectrum.acceleration(4.0) == pytest.approx(0.2, rel=1e-15)
    assert DesignSpectrum.of(elastic(), q=4.0, beta=0.0).acceleration(4.0) == pytest.approx(0.05390625, rel=1e-12)
    # 2.5 / q = 1: at T_C the branches 3.14 and 3.15 meet at a_g S
    np.testing.assert_allclose(DesignSpectrum.of(elastic(), q=2.5).acceleration([0.6, 0.60001]), 1.15, rtol=2e-5)
    importance = DesignSpectrum.of(elastic(gamma_I=1.2), q=4.0)
    np.testing.assert_allclose(importance.acceleration([0.4, 4.0]), [0.8625, 0.24], rtol=1e-12)


def test_vertical_design_spectrum() -> None:
    # a_vg = 0.9, S = 1, q = 1.5: 0.9 x 2/3, 0.9 x 2.5 / 1.5, half at 2 T_C; at 2 s 0.05625 is below 0.2 x 0.9
    elastic_vertical = VerticalSpectrum(1.0, EC8.vertical(1))
    at = vertical_design_spectrum(elastic_vertical).acceleration([0.0, 0.1, 0.3, 2.0])
    np.testing.assert_allclose(at, [0.6, 1.5, 0.75, 0.18], rtol=1e-12)
    with pytest.raises(InputError, match=r"3\.2\.2\.5\(6\).*E-EC8-01"):
        vertical_design_spectrum(elastic_vertical, q=2.0)
    assert vertical_design_spectrum(elastic_vertical, q=2.0, justified=True).acceleration(0.1) == pytest.approx(1.125)


def test_displacement_spectrum() -> None:
    # Eq. 3.7: T = 1 s 1.725 / (4 pi2); from T_D on 2.875 x 1.2 / (4 pi2)
    at = elastic().displacement([0.0, 1.0, 2.0, 4.0, 6.0])
    np.testing.assert_allclose(at, [0.0, 0.0436947604, 0.0873895208, 0.0873895208, 0.0873895208], rtol=1e-8)


# ground: T_E, d_g = 0.025 S T_C T_D, and 1.75 d_g half-way to T_F = 10 s
ANNEX_A = {
    "A": (4.5, 0.02, 0.035),
    "B": (5.0, 0.03, 0.0525),
    "C": (6.0, 0.0345, 0.060375),
    "D": (6.0, 0.054, 0.0945),
    "E": (6.0, 0.035, 0.06125),
}


@pytest.mark.parametrize("ground", GROUNDS)
def test_annex_a(ground: str) -> None:
    T_E, d_g, half_way = ANNEX_A[ground]
    spectrum = LongPeriodSpectrum(elastic(ground))
    assert (spectrum.T_E, spectrum.T_F) == (T_E, 10.0)
    assert design_ground_displacement(spectrum.elastic) == pytest.approx(d_g, rel=1e-12)
    middle = (T_E + 10.0) / 2.0
    np.testing.assert_allclose(spectrum.displacement([middle, 10.0, 15.0]), [half_way, d_g, d_g], rtol=1e-12)
    # Eq. 3.7 inverted
    assert spectrum.acceleration(middle) == pytest.approx(half_way * (2 * math.pi / middle) ** 2, rel=1e-12)
    short = np.linspace(0.0, T_E, 50)
    np.testing.assert_array_equal(spectrum.acceleration(short), spectrum.elastic.acceleration(short))
    np.testing.assert_array_equal(spectrum.displacement(short), spectrum.elastic.displacement(short))


def test_annex_a_with_damping() -> None:
    # 30 %: 2.5 x 0.55 = 1.375; at 8 s 0.0345 (1.375 + 0.5 (1 - 1.375)) = 0.04096875
    spectrum = LongPeriodSpectrum(elastic(damping=0.30))
    np.testing.assert_allclose(spectrum.displacement([8.0, 10.0]), [0.04096875, 0.0345], rtol=1e-12)


def test_annex_a_is_for_type_1() -> None:
    with pytest.raises(InputError, match="E-EC8-02"):
        LongPeriodSpectrum(elastic(spectrum_type=2))


def _step(values: np.ndarray) -> float:
    return float(abs(values[1] / values[0] - 1.0))


@pytest.mark.parametrize(("spectrum_type", "ground"), ELASTIC)
@pytest.mark.parametrize("damping", [0.02, 0.05, 0.30])
def test_branches_meet(spectrum_type: int, ground: str, damping: float) -> None:
    """No step at T_B, T_C, T_D: over 2e-9 of a period ordinates change by less than 1e-8 of themselves."""
    spectrum = elastic(ground, spectrum_type, damping)
    parameters = spectrum.parameters
    vertical = VerticalSpectrum(1.0, EC8.vertical(spectrum_type), 1.0, damping)
    design = DesignSpectrum.of(spectrum, q=1.5)
    for corner in (parameters.T_B, parameters.T_C, parameters.T_D):
        near = corner * np.array([1.0 - 1e-9, 1.0 + 1e-9])
        assert _step(spectrum.acceleration(near)) < 1e-8
        assert _step(design.acceleration(near)) < 1e-8
    for corner in (0.05, 0.15, 1.0):
        assert _step(vertical.acceleration(corner * np.array([1.0 - 1e-9, 1.0 + 1e-9]))) < 1e-8


@pytest.mark.parametrize("ground", GROUNDS)
def test_annex_a_meets_at_t_f_and_steps_by_the_rounded_constant_at_t_e(ground: str) -> None:
    spectrum = LongPeriodSpectrum(elastic(ground))
    near = np.array([1.0 - 1e-9, 1.0 + 1e-9])
    assert _step(spectrum.displacement(spectrum.T_F * near)) < 1e-8
    below, above = spectrum.displacement(spectrum.T_E * near)
    assert above / below == pytest.approx(0.025 * 4.0 * math.pi**2, rel=1e-8)  # 0.987, as printed in EN 1998-1


def test_levels_differ_by_the_importance_factor_exactly() -> None:
    gamma_I = factor_of_probability(0.02)
    periods = np.concatenate(([0.0], np.geomspace(0.01, 20.0, 2001)))
    for damping in (0.02, 0.05):
        design_level, rare = elastic(damping=damping), elastic(damping=damping, gamma_I=gamma_I)
        np.testing.assert_array_equal(rare.acceleration(periods), gamma_I * design_level.acceleration(periods))
        assert rare.zero_period == gamma_I * design_level.zero_period
        assert rare.a_g == gamma_I * design_level.a_g


def test_importance_factors() -> None:
    assert [EC8.gamma_I(name) for name in ("I", "II", "III", "IV")] == [0.8, 1.0, 1.2, 1.4]  # 4.2.5(5)P Note
    assert factor_of_probability(0.02) == pytest.approx(1.7099759, rel=1e-7)  # 5^(1/3), thesis Eq. 5.5: 1.7
    assert factor_of_probability(0.10) == 1.0
    assert factor_of_probability(0.02, k=2.0) == pytest.approx(2.2360680, rel=1e-7)  # sqrt 5
    assert factor_of_return_period(2475.0) == pytest.approx(1.7336464, rel=1e-7)  # (2475 / 475)^(1/3)
    assert factor_of_return_period(95.0) == pytest.approx(0.5848035, rel=1e-7)  # 0.2^(1/3)
    assert factor_of_return_period(475.0 * 8.0) == pytest.approx(2.0, rel=1e-14)


def test_return_periods() -> None:
    # 2.1(1)P Note 1: 10 % in 50 years is 475 years, 10 % in 10 years 95 years
    assert return_period_of(0.10) == pytest.approx(475.0, abs=0.5)
    assert return_period_of(0.10, years=10.0) == pytest.approx(95.0, abs=0.1)
    assert return_period_of(0.02) == pytest.approx(2474.9, abs=0.05)
