"""The four-storey frame of Fajfar (2000), A nonlinear analysis method for performance based seismic design; others.

Earthquake Spectra 16(3), 573-592, section "Test example": a reinforced concrete building of four storeys. The printed
chain goes on with rounded numbers (Gamma = 1.34, F_y* = 619 kN, T* = 0.79 s), which shifts its results by up to 1.5 %.
Each printed number is met to its own digits from the printed numbers before it, the whole chain within that.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from edesign.codes.capacity_curve import CapacityCurve
from edesign.codes.ec8.action.elastic import ElasticSpectrum
from edesign.codes.ec8.action.parameters import HorizontalParameters
from edesign.codes.ec8.analysis.target_displacement import (
    equivalent_oscillator,
    idealised,
    oscillator_target,
    target_displacement,
)

G = 9.81
MASSES = 1e3 * np.array([87.0, 86.0, 86.0, 83.0])
SHAPE = np.array([0.28, 0.52, 0.76, 1.00])
F_Y, D_Y = 830e3, 0.061  # of the building, idealised
SPECTRUM = ElasticSpectrum(
    0.6 * G, HorizontalParameters(spectrum_type=1, ground="B", S=1.0, T_B=0.15, T_C=0.6, T_D=3.0)
)
CURVE = CapacityCurve(np.array([0.0, D_Y, 0.5]), np.array([0.0, F_Y, F_Y * (1 + 1e-9)]))


def test_equivalent_oscillator() -> None:
    found = equivalent_oscillator(MASSES * SHAPE, MASSES)
    assert f"{found.mass / 1e3:.0f}" == "217"
    assert f"{found.Gamma:.2f}" == "1.34"
    assert MASSES * SHAPE / MASSES[-1] == pytest.approx([0.293, 0.539, 0.787, 1.0], abs=1e-3)


def test_from_printed_numbers_to_printed_numbers() -> None:
    curve = CURVE.scaled(1 / 1.34)
    relation = idealised(curve, 217e3, curve.end)
    assert f"{relation.F_y / 1e3:.0f}" == "619"
    assert f"{100 * relation.d_y:.1f}" == "4.6"
    assert f"{relation.T:.2f}" == "0.79"
    S_e = float(SPECTRUM.acceleration(0.79))
    assert f"{S_e / G:.2f}" == "1.14"
    assert f"{1.14 / (619 / 217 / G):.1f}" == "3.9"  # R_mu = mu, as T* is above T_C
    assert oscillator_target(1.14 * G, 0.79, 0.6, 3.9) == pytest.approx(0.175, rel=0.015)


def test_whole_chain() -> None:
    found = target_displacement(CURVE, equivalent_oscillator(MASSES * SHAPE, MASSES), SPECTRUM, 0.6)
    assert found.idealisation.T == pytest.approx(0.79, abs=0.005)
    assert found.ductility == pytest.approx(3.9, abs=0.05)
    assert found.d_t == pytest.approx(0.235, rel=0.015)


def test_a_worked_example_for_the_rules_of_algeria() -> None:
    """The reference example of a public web application, `Calcul sismique N2 - RPA 2024` 2.0.0, read in its source.

    It has the masses and the shape of Fajfar's building, with more digits, and a capacity and a spectrum of its own:
    zone VI (0.30 g), site S3 (S = 1.3, T_2 = 0.6 s) of DTR BC 2.48 (2024), whose branches are those of EN 1998-1.
    """
    oscillator = equivalent_oscillator(MASSES * SHAPE, MASSES)
    assert (f"{oscillator.mass / 1e3:.2f}", f"{oscillator.Gamma:.3f}") == ("217.44", "1.336")
    site = HorizontalParameters(spectrum_type=1, ground="C", S=1.3, T_B=0.15, T_C=0.6, T_D=2.0)
    spectrum = ElasticSpectrum(0.30 * G, site)
    F_y, d_y = 948e3, 0.08913
    own = CapacityCurve(np.array([0.0, d_y, 0.5]), np.array([0.0, F_y, F_y * (1 + 1e-9)]))
    found = target_displacement(own.scaled(oscillator.Gamma), oscillator, spectrum, 0.6)
    assert f"{found.idealisation.F_y / oscillator.mass / G:.3f}" == "0.444"
    assert f"{found.idealisation.T:.3f}" == "0.898"
    assert f"{float(spectrum.acceleration(0.898)) / G:.3f}" == "0.651"
    d_t = oscillator_target(0.651 * G, 0.898, 0.6, 0.651 / 0.444)
    assert (f"{d_t:.3f}", f"{1.336 * d_t:.3f}") == ("0.130", "0.174")
    assert (found.d_t_oscillator, found.d_t) == pytest.approx((0.130, 0.174), abs=0.0007)  # T* = 0.8984 s not rounded


def test_short_period_of_another_program() -> None:
    """A frame of three storeys worked by hand in the notes of another program: EN 1998-1 type 1, 0.3 g, ground C.

    Printed: Gamma = 1.2619, F_y* = 1260.3 kN, d_y* = 39.47 mm, T* = 0.4960 s, q_u = 1.336, d_t* = 55.50 mm,
    d_t = 70.04 mm. m* follows from T*.
    """
    F_y, d_y, T = 1260.3e3, 0.03947, 0.4960
    mass = F_y / d_y * (T / (2 * math.pi)) ** 2
    spectrum = ElasticSpectrum(
        0.3 * G, HorizontalParameters(spectrum_type=1, ground="C", S=1.15, T_B=0.2, T_C=0.6, T_D=2.0)
    )
    S_e = float(spectrum.acceleration(T))
    assert f"{S_e * mass / F_y:.3f}" == "1.336"
    d_t = oscillator_target(S_e, T, 0.6, S_e * mass / F_y)
    assert d_t == pytest.approx(0.05550, abs=1e-5)
    assert 1.2619 * d_t == pytest.approx(0.07004, abs=2e-5)
