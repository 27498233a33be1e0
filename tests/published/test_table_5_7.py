"""Thesis Table 5.7: stiffness and layer area of the dampers of the ten-storey frame."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from design_examples import GIVEN_STIFFNESS, TABLE_5_7_STIFFNESS, design, thesis_project
from scipy.linalg import eigh

from edesign.archive.dataset import Group
from edesign.damper.sizing import damping_of_frequencies, stiffness_ratio
from edesign.project.project import Project
from edesign.study.design.design import run_design

K_D = np.array([67309, 34867, 29567, 27121, 22014, 19687, 18870, 16608, 15069, 12469]) * 1e3  # N/m
AREA_RATIO = np.array([26.84, 13.90, 11.79, 10.82, 8.78, 7.85, 7.52, 6.62, 6.01, 4.97])
COMMON = (
    "method: strain_energy, law: elastomer, bays: [1, 3], layers: 2, damping: 10 %, strain: 20 %, "
    "drift: 1 %, strain_limit: 50 %, brace: {ratio: 7}, braces_in_target: false, target_in: storeys"
)
FIXED = "properties: {G_storage: 1.06 MPa, loss_factor: 0.3535}"


@cache
def project() -> Project:
    return thesis_project()


def found(text: str) -> Group:
    result = run_design(project(), "tried", design(f"{COMMON}, {text}", project()), Path("."))
    assert (result.status, result.reason) == ("completed", "")
    return result.group


def test_dampers_of_the_printed_storey_stiffnesses() -> None:
    # the table took k_D = 1.300 k_S where Eq. 5.9 gives 1.303, and its areas are rounded to three or four digits
    group = found(f"kind: chevron, {FIXED}, storey_stiffness: {GIVEN_STIFFNESS}")
    assert group.attributes["layer_thickness_m"] == pytest.approx(0.07)
    np.testing.assert_allclose(group.variables["damper_stiffness"].values, K_D, rtol=0.005)
    np.testing.assert_allclose(group.variables["area_ratio"].values, AREA_RATIO, rtol=0.005)


def test_the_design_of_the_table_is_plausible() -> None:
    group = found(f"kind: chevron, {FIXED}, storey_stiffness: {GIVEN_STIFFNESS}")
    assert group.attributes["warnings"] == []
    assert group.attributes["prototypes"] == pytest.approx(4 * AREA_RATIO.sum() / 2, rel=0.005)  # layers, two places


@pytest.mark.parametrize("state", ["initial", "gravity"])
def test_dampers_of_the_computed_storey_stiffnesses(state: str) -> None:
    # the bar is 12 %: the thesis' stiffnesses are those of another program and a 3-D model
    group = found(f"kind: chevron, {FIXED}, state: {state}")
    computed = group.variables["computed_storey_stiffness"].values
    np.testing.assert_allclose(computed, 1e3 * np.array(TABLE_5_7_STIFFNESS), rtol=0.12)
    np.testing.assert_allclose(group.variables["area_ratio"].values, AREA_RATIO, rtol=0.12)


def test_measured_properties_in_the_band_of_the_design() -> None:
    # section 5.3.4: 1.06 MPa and 0.3535 at 20 % strain and 0.25 to 0.5 Hz, printed to three and four digits
    text = "kind: chevron, properties: {table: thesis_appendix_a}, frequency: [0.25 Hz, 0.5 Hz]"
    group = found(text)
    assert group.attributes["G_storage_Pa"] == pytest.approx(1.06e6, rel=0.002)
    assert group.attributes["loss_factor"] == pytest.approx(0.3535, rel=1e-3)


def test_damping_of_storeys_in_proportion() -> None:
    # Eq. 5.8: 9.99 % where k_D = 1.3 k_S everywhere (printed 9.86 %); here a chain of the printed storeys
    k = 1e3 * np.array(TABLE_5_7_STIFFNESS)
    mass = np.full(10, 2 * 29.5e3 + 2 * 19.35e3)

    def omega(storeys: np.ndarray) -> float:
        above = np.append(storeys[1:], 0.0)
        matrix = np.diag(storeys + above) - np.diag(above[:-1], 1) - np.diag(above[:-1], -1)
        return float(np.sqrt(eigh(matrix, np.diag(mass), eigvals_only=True)[0]))

    damping = damping_of_frequencies(0.3535, omega(k), omega(k + K_D))
    assert damping == pytest.approx(0.0999, abs=1e-4)
    assert stiffness_ratio(0.10, 0.3535) == pytest.approx(1.303, abs=5e-4)


def test_damping_of_the_frame() -> None:
    # dampers between floors add 10.0 % by both equations; on chevrons the columns' axial strain takes a part of it
    between = found(f"kind: storey, {FIXED}, state: initial").variables
    for name in ("damping_strain_energy", "damping_frequencies"):
        assert 0.098 <= between[name].values[0, 0] <= 0.1001
    chevron = found(f"kind: chevron, {FIXED}, state: initial").variables
    assert 0.08 <= chevron["damping_strain_energy"].values[0, 0] < chevron["damping_frequencies"].values[0, 0] <= 0.098
