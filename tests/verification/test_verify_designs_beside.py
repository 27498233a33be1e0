"""Designs beside each other, and designs in bays of several kinds, against hand calculations of shear frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from design_examples import design, shear_project
from shear_frames import BAY, HEIGHT, MASS, STIFFNESS

from edesign.codes.ec8 import damping_correction
from edesign.one_thread import one_thread
from edesign.project.project import Project
from edesign.study.design.beside import NOTHING_BESIDE, Standing, standing_of
from edesign.study.design.design import DesignResult, run_design

LAWS = """
dampers:
  laws:
    plastic: {type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0}}
    fluid: {type: viscous, parameters: {c: 500 kN*s/m}}
    power: {type: viscous_power, parameters: {c: 500 kN*(s/m)^0.5, alpha: 0.5}}
"""
SLOPE2 = BAY**2 / (BAY**2 + HEIGHT**2)
"""Square of the cosine of a diagonal."""
FIRST = 2.0 * math.sin(math.pi / 14.0)
"""First frequency of three equal storeys and floors, over the root of storey stiffness over floor mass."""
DBE = 0.36 * 9.80665 * 1.15 * 2.5  # plateau of the shear frames' spectrum at 5 %, m/s2
LAYERS = """
dampers:
  laws:
    rubber:
      type: kelvin_voigt
      parameters: {k: 1 kN/mm, c: 20 kN*s/m}
      prototype: {layers: 2, layer_area: 0.1 m^2, layer_thickness: 20 mm}
"""


@pytest.fixture(autouse=True)
def alone() -> Iterator[None]:
    """Small matrices are slower in several threads, as in a run."""
    with one_thread():
        yield


def run(text: str, project: Project, beside: Standing = NOTHING_BESIDE, state: str = "initial") -> DesignResult:
    spec = design(f"{text}, state: {state}", project)
    found = run_design(project, "tried", spec, Path("."), beside=beside)
    assert found.status == "completed", found.reason
    return found


def test_viscous_dampers_beside_yielding_ones() -> None:
    """One storey. The yielding dampers count with their secant: K = K_S + F_y / u, so that c = 2 zeta sqrt(K m)."""
    project, u = shear_project(1, LAWS), 0.02
    plastic = run(
        f"method: hysteretic, law: plastic, kind: storey, bays: 1, shear_share: 5 %, shear: [800 kN], "
        f"amplitude: {{roof_displacement: {u} m}}",
        project,
    )
    F_y, yields = 0.05 * 800e3, 50e3 / 20e6
    assert plastic.group.variables["yield_force"].values == pytest.approx([F_y])
    group = run(
        "method: viscous, law: fluid, kind: rising, bays: 1, damping: 10 %, level: DBE, inherent_damping: 3 %",
        project,
        plastic.standing,
    ).group
    K = STIFFNESS + F_y / u
    omega = math.sqrt(K / MASS)
    assert group.variables["bare_period"].values == pytest.approx([2.0 * math.pi / omega])
    assert group.variables["storey_stiffness"].values == pytest.approx([K])
    assert group.variables["damping_coefficient"].values == pytest.approx([0.2 * MASS * omega], rel=1e-6)
    of_plastic = 4.0 * F_y * (u - yields) / (2.0 * math.pi * K * u**2)  # E / (4 pi W), Jacobsen
    assert group.attributes["beside_damping"] == pytest.approx(of_plastic, rel=1e-6)
    # EN 1998-1, 3.2.2.2: all three damping ratios act on the spectrum; inherent 3 %
    eta = damping_correction(0.03 + 0.10 + of_plastic)
    drift = group.variables["estimated_storey_drift"].values
    assert drift == pytest.approx([DBE * eta / omega**2 / HEIGHT], rel=1e-6)
    # of the shear the columns have what both kinds of dampers leave: those that yield take their secant
    column = group.variables["estimated_column_shear"].values
    assert column == pytest.approx([STIFFNESS * DBE * eta / omega**2], rel=1e-6)


def test_two_designs_with_half_of_the_damping_are_one_with_all() -> None:
    """Dashpots do not stiffen the frame, so the second design sees the frame of the first."""
    project = shear_project(3, LAWS)
    text = "method: viscous, law: fluid, kind: {}, bays: 1, damping: {} %"
    rising = run(text.format("rising", 6), project)
    falling = run(text.format("falling", 6), project, rising.standing)
    both = run(text.format("rising", 12), project)
    parts = [one.group.variables["damping_coefficient"].values for one in (rising, falling)]
    np.testing.assert_allclose(sum(parts), both.group.variables["damping_coefficient"].values, rtol=1e-6)
    # C = 2 zeta / omega_1 K by hand
    omega = FIRST * math.sqrt(STIFFNESS / MASS)
    np.testing.assert_allclose(parts[1], 0.12 / omega * STIFFNESS, rtol=1e-6)
    assert falling.group.attributes["beside_damping"] == pytest.approx(0.06, rel=1e-6)


@pytest.mark.parametrize("storeys", [1, 3])
def test_elastomer_beside_elastomer(storeys: int) -> None:
    """Eq. 5.9 for the second one takes the storeys with the first one in them: k_2 = r (k_S + r k_S)."""
    project = shear_project(storeys, LAYERS)
    text = (
        "method: strain_energy, law: rubber, kind: {}, bays: 1, damping: 5 %, strain: 20 %, "
        "properties: {{G_storage: 1 MPa, loss_factor: 0.4}}, layer_thickness: 20 mm"
    )
    first = run(text.format("rising"), project)
    second = run(text.format("falling"), project, first.standing)
    r = 0.1 / (0.4 - 0.1)  # k_D / k_S = 2 zeta / (n - 2 zeta)
    # diagonals lengthen the columns, which are as stiff as a thousand square metres: 1e-6 of the answer
    np.testing.assert_allclose(first.group.variables["damper_stiffness"].values, r * STIFFNESS, rtol=1e-5)
    k = r * (1.0 + r) * STIFFNESS
    np.testing.assert_allclose(second.group.variables["damper_stiffness"].values, k, rtol=1e-5)
    whole = (1.0 + r + r * (1.0 + r)) * STIFFNESS
    # each takes its part of the loss in the frame with both: n k_1 / (2 K)
    assert second.group.attributes["beside_damping"] == pytest.approx(0.4 * r * STIFFNESS / (2.0 * whole), rel=1e-5)
    names = list(standing_of([first.standing, second.standing]).stiffness)
    assert names == [f"{letter}_1_{i + 1}" for letter in "RF" for i in range(storeys)]


def test_places_of_several_kinds_share_the_target() -> None:
    """Rising, falling and between floors: equal sizes, whose effects add up with the squares of their cosines."""
    project = shear_project(3, LAWS)
    start = "method: viscous, law: fluid, damping: 9 %"
    places = "places: [{kind: rising, bays: 1}, {kind: falling, bays: 1, storeys: 1-2}, {kind: storey, bays: 1}]"
    group = run(f"{start}, {places}", project).group
    omega = FIRST * math.sqrt(STIFFNESS / MASS)
    of_storey = 0.18 / omega * STIFFNESS
    np.testing.assert_allclose(group.variables["damping_coefficient"].values, of_storey, rtol=1e-6)
    shared = np.array([2.0 * SLOPE2 + 1.0, 2.0 * SLOPE2 + 1.0, SLOPE2 + 1.0])
    np.testing.assert_allclose(group.variables["device_coefficient"].values, of_storey / shared, rtol=1e-6)
    np.testing.assert_array_equal(group.variables["device_count"].values, [3, 3, 2])
    runs = run(f"{start}, {places}", project).dampers.devices
    assert [run.kind for run in runs] == ["rising", "falling", "storey"]
    np.testing.assert_allclose(runs[1].scale, (of_storey / shared)[:2] / 500e3, rtol=1e-6)
    assert group.attributes["kind"] == "rising, falling, storey"
    assert group.attributes["bays"] == "1"
