"""Stiffness of dampers in steady vibration, and natural modes with it, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from edesign.core import LawValues
from edesign.damper.harmonic import complex_stiffness
from edesign.project.loader import parse_project
from edesign.study.analysis.damper_stiffness import damped_modes
from edesign.study.analysis.structure import make_structure

K0, K1, C1 = 2e6, 5e6, 1e5


def zener(omega: float) -> complex:
    """Complex stiffness of the Zener law, thesis Eqs. 4.1-4.2 with one branch."""
    lag = 1j * omega * C1 / K1
    return K0 + K1 * lag / (1.0 + lag)


@pytest.mark.parametrize("frequency", [0.1, 1.0, 5.0])
def test_linear_laws_have_their_complex_modulus(frequency):
    omega = 2.0 * np.pi * frequency
    # the start dies out as exp(-12 cycles / tau); the cubic path meets the sine to 1e-7
    assert complex_stiffness(LawValues("zener", (K0, K1, C1)), 5e-3, frequency) == pytest.approx(zener(omega), rel=1e-6)
    kelvin = complex_stiffness(LawValues("kelvin_voigt", (K0, C1)), 1e-3, frequency)
    assert kelvin == pytest.approx(complex(K0, C1 * omega), rel=1e-6)


def test_a_brace_is_in_series():
    brace, omega = 8e6, 2.0 * np.pi * 2.0
    found = complex_stiffness(LawValues("zener", (K0, K1, C1)), 5e-3, 2.0, brace)
    exact = 1.0 / (1.0 / brace + 1.0 / zener(omega))
    assert found == pytest.approx(exact, rel=1e-5)  # collocation at 100 steps a cycle


def test_elastic_plastic_loops_have_their_first_harmonic():
    """Caughey (1960): C(A) of the bilinear loop without hardening, theta = arccos(1 - 2 / ductility)."""
    k, fy, ductility = 4e6, 8e3, 3.0
    theta = np.arccos(1.0 - 2.0 / ductility)
    found = complex_stiffness(LawValues("elastic_plastic", (k, fy, 0.0)), ductility * fy / k, 1.0)
    storage = k / np.pi * (theta - 0.5 * np.sin(2.0 * theta))
    loss = k / np.pi * np.sin(theta) ** 2
    assert found == pytest.approx(complex(storage, loss), rel=2e-3)  # sums over 100 samples of a loop with corners


PROJECT = """
edesign: 1
title: one storey
frame:
  bays: [6 m]
  storeys: [3 m]
  diaphragms: all
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: all, section: rigid, material: steel}]
sections:
  column: {area: 1 m^2, inertia: 1e-4 m^4}
  rigid: {area: 100 m^2, inertia: 1000 m^4}
materials: {steel: {law: elastic, E: 210 GPa}}
masses: {given: [{lines: all, floors: all, mass: 70 t}]}
elements: {geometry: {columns: linear, beams: linear}}
dampers:
  laws:
    rubber: {type: zener, parameters: {k0: 2 kN/mm, k1: 5 kN/mm, c1: 0.1 kN*s/mm}}
  devices: [{kind: storey, bays: 1, storeys: 1, law: rubber, number: 2}]
analyses: [{name: modes, kind: modal, modes: 1, state: initial}]
"""


def test_the_first_frequency_is_that_at_which_the_dampers_stiffness_is_taken():
    project = parse_project(PROJECT)
    structure = make_structure(project, dampers=True)
    damped = damped_modes(project, structure, project.analyses[0])
    bare = float(structure.modes(1).omega[0])
    mass = 140e3
    exact = brentq(lambda w: mass * w**2 - mass * bare**2 - 2.0 * zener(w).real, bare, 10.0 * bare)
    assert float(damped.modes.omega[0]) == pytest.approx(exact, rel=1e-6)
    assert damped.stiffness[0] == pytest.approx(2.0 * zener(exact), rel=1e-5)
