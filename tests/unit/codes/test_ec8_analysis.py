"""Clauses of EN 1998-1:2004, chapter 4, on analysis: closed forms and values worked out by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from edesign.codes.ec8 import DesignSpectrum, ElasticSpectrum, national_parameters
from edesign.codes.ec8.analysis.design_displacement import design_displacement
from edesign.codes.ec8.analysis.lateral_force import lateral_forces
from edesign.codes.ec8.analysis.modal_combination import (
    check_modes,
    close_modes,
    cqc,
    cqc_coefficients,
    needed_modes,
)
from edesign.codes.ec8.analysis.seismic_mass import phi
from edesign.codes.ec8.analysis.torsion import accidental_eccentricity, accidental_moments
from edesign.codes.ec8.verification.drift import drift_limit, reduced_drift
from edesign.codes.ec8.verification.second_order import drift_sensitivity
from edesign.errors import InputError

G = 9.80665
GROUND_C = national_parameters().horizontal(1, "C")

periods = st.lists(st.floats(0.05, 4.0), min_size=1, max_size=12)


def white_noise_correlation(omega: tuple[float, float], zeta: tuple[float, float]) -> float:
    """Correlation of the displacements of two oscillators under white noise, by integrating over frequency."""

    def response(w: float, i: int) -> complex:
        return 1.0 / complex(omega[i] ** 2 - w**2, 2.0 * zeta[i] * omega[i] * w)

    def integral(i: int, j: int) -> float:
        points = sorted({omega[i], omega[j]})
        end = 50.0 * max(omega)
        value, _ = quad(
            lambda w: (response(w, i) * response(w, j).conjugate()).real,
            0.0,
            end,
            points=points,
            limit=2000,
            epsabs=0.0,
        )
        return float(value)

    return integral(0, 1) / math.sqrt(integral(0, 0) * integral(1, 1))


@pytest.mark.parametrize("ratio", [1.0, 1.05, 1.2, 1.8])
@pytest.mark.parametrize("zeta", [(0.05, 0.05), (0.02, 0.08)])
def test_cqc_coefficients_are_correlations_under_white_noise(ratio: float, zeta: tuple[float, float]) -> None:
    omega = (4.0, 4.0 * ratio)
    rho = cqc_coefficients([2.0 * math.pi / w for w in omega], zeta)
    # the integral ends at 50 times the higher frequency: what is left is below 50^-3
    assert rho[0, 1] == pytest.approx(white_noise_correlation(omega, zeta), abs=1e-5)


@given(periods)
def test_cqc_matrix_is_symmetric_with_ones(T: list[float]) -> None:
    rho = cqc_coefficients(T)
    np.testing.assert_allclose(rho, rho.T, rtol=1e-12)  # rounding
    np.testing.assert_allclose(np.diag(rho), 1.0, rtol=1e-12)
    assert (rho > 0.0).all() and (rho <= 1.0 + 1e-12).all()


def test_cqc_of_equal_modes_adds_and_of_distant_ones_is_srss() -> None:
    modal = np.array([[3.0, -2.0], [4.0, 2.0]])
    together = cqc(modal, cqc_coefficients([1.0, 1.0]))
    np.testing.assert_allclose(together, [7.0, 0.0], atol=1e-7)  # a root of rounding, 1e-16
    np.testing.assert_allclose(cqc(modal, np.eye(2)), [5.0, math.sqrt(8.0)], rtol=1e-15)
    assert cqc(np.ones((2, 3, 4)), np.eye(2)).shape == (3, 4)
    assert cqc([3.0, 4.0], np.eye(2)) == 5.0


def test_close_modes() -> None:
    """Eq. 4.15: T_j <= 0.9 T_i."""
    assert close_modes([1.0, 0.9, 0.5]) == ()
    assert close_modes([0.5, 0.91, 1.0]) == ((2, 1),)
    assert close_modes([2.0]) == ()


def test_needed_modes_and_what_is_missing() -> None:
    ratios = [[0.75, 0.0], [0.0, 0.80], [0.12, 0.02], [0.05, 0.13]]
    assert needed_modes(ratios) == 4
    assert needed_modes([0.6, 0.2]) is None
    x = [row[0] for row in ratios]
    few = check_modes(x, 2, "x")
    assert (few.passed, few.value) == (False, 0.75)
    assert few.detail == "2 modes have 75.0% of the mass in x, 15.0% are missing; 4 modes are needed"
    assert check_modes(x, 4, "x").passed
    assert "more modes than the 2 that are known" in check_modes([0.6, 0.2], 2).detail
    with pytest.raises(InputError, match="5 modes .* 4 .*E-VALUE-02"):
        check_modes(x, 5)


def test_every_mode_above_5_percent_is_the_other_rule() -> None:
    many = [0.80, 0.04, 0.04, 0.04, 0.04]  # 4 % are in modes that are not known
    check = check_modes(many, 1)
    assert check.passed and "no other mode can have more than 5%" in check.detail
    assert not check_modes(many[:4], 1).passed  # 8 % might be in one mode


def test_accidental_torsion() -> None:
    np.testing.assert_allclose(accidental_eccentricity([28.8, 21.6]), [1.44, 1.08], rtol=1e-15)
    F = lateral_forces(600.0, np.ones(3), np.array([1.0, 2.0, 3.0]))
    np.testing.assert_allclose(accidental_moments(F, 20.0), [100.0, 200.0, 300.0], rtol=1e-14)


def test_accidental_moment_and_factor_agree_where_the_factor_comes_from() -> None:
    """A row of n equal frames: torsion 0.05 L F adds 0.6 n/(n+1) x/L_e at a frame; 0.6 x/L_e for many (4.3.3.2.4)."""
    n, L_e, F = 401, 40.0, 1.0
    x = np.linspace(-L_e / 2.0, L_e / 2.0, n)
    moment = float(accidental_moments(F, L_e))
    shares = F / n + moment * x / (x**2).sum()
    # n equal frames have sum x^2 = n (n + 1) / (n - 1) L_e^2 / 12: 0.5 % from the continuum at n = 401
    np.testing.assert_allclose(shares * n / F, 1.0 + 0.6 * x / L_e, atol=0.3 * 2.0 / n)


def test_variable_loads_with_mass() -> None:
    """Table 4.2."""
    factors = national_parameters().phi
    assert phi("B", factors) == 0.5
    assert phi("B", factors, correlated=True) == 0.8
    assert phi("C", factors, roof=True) == 1.0
    assert phi("E", factors) == phi("H", factors, roof=True) == phi("snow", factors) == 1.0


def test_displacement_is_capped_by_the_elastic_one() -> None:
    """4.3.4(3), one dof: where beta a_g governs, q S_d exceeds S_e, and the cap gives back S_De."""
    elastic = ElasticSpectrum(0.36 * G, GROUND_C)
    design = DesignSpectrum.of(elastic, q=6.5)
    T = 2.65
    d_e = float(design.acceleration(T)) * (T / (2.0 * math.pi)) ** 2
    d_elastic = float(elastic.displacement(T))
    assert design.lower_bound_governs(T)
    assert design_displacement(d_e, 6.5) > 1.5 * d_elastic
    assert design_displacement(-d_e, 6.5, d_elastic) == pytest.approx(-d_elastic, rel=1e-15)
    assert design_displacement(0.01, 4.0, 1.0) == pytest.approx(0.04)


def test_lower_bound() -> None:
    """V with beta over V without = beta a_g / S_d; by hand: a_g S 2.5/q T_C T_D / T2 = 0.267 m/s2 at 2.65 s."""
    design = DesignSpectrum(0.36 * G, GROUND_C.S, (GROUND_C.T_B, GROUND_C.T_C, GROUND_C.T_D), 6.5)
    alone = replace(design, beta=0.0)
    by_hand = 0.36 * G * 1.15 * 2.5 / 6.5 * 0.6 * 2.0 / 2.65**2
    assert alone.acceleration(2.65) == pytest.approx(by_hand, rel=1e-14)
    assert design.acceleration(2.65) == pytest.approx(0.2 * 0.36 * G, rel=1e-14)
    assert design.lower_bound_governs([0.0, 0.5, 0.97, 2.65]).tolist() == [False, False, False, True]


@pytest.mark.parametrize("T", [0.5, 1.5, 3.0])
def test_theta_of_one_degree_of_freedom(T: float) -> None:
    """theta = q P / (K h) whatever the spectrum: d_r = q V / K."""
    m, q, h = 100e3, 4.0, 3.5
    K = m * (2.0 * math.pi / T) ** 2
    S_d = float(DesignSpectrum(3.0, 1.15, (0.2, 0.6, 2.0), q).acceleration(T))
    V, P = m * S_d, m * G
    theta = drift_sensitivity(P, design_displacement(V / K, q), V, h)
    assert theta == pytest.approx(q * P / (K * h), rel=1e-14)


def test_second_order() -> None:
    """Storey by hand: 20 MN x 30 mm / (2 MN x 3 m) = 0.1."""
    assert drift_sensitivity(20e6, -0.03, 2e6, 3.0) == pytest.approx(0.1)
    with pytest.raises(InputError, match="V_tot .*E-VALUE-02"):
        drift_sensitivity(20e6, 0.03, [1.0, 0.0], 3.0)


def test_drift() -> None:
    """Eqs. 4.31-4.33: 0.5 x 52.5 mm / 3.5 m = 0.0075."""
    assert [drift_limit(name) for name in ("brittle", "ductile", "none_attached")] == [0.005, 0.0075, 0.010]
    np.testing.assert_allclose(reduced_drift([0.0525, -0.035], 3.5, 0.5), [0.0075, 0.005], rtol=1e-14)
    with pytest.raises(InputError, match=r"`britle`; did you mean `brittle`\?"):
        drift_limit("britle")
