"""Pushover of a portal with a rigid beam: elastic stiffness and plastic collapse load."""

from __future__ import annotations

import numpy as np
import pytest
from unit.study.frames import PORTAL, project, shear_frame

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.frame.frame import build_frame
from edesign.study.analysis.lateral_patterns import lateral_loads
from edesign.study.run.analyses import run_analysis

B, D, H, E, FY = 0.1, 0.2, 4.0, 210e9, 250e6
MP = FY * B * D**2 / 4  # plastic moment of a rectangle; exact with an even number of layers


@pytest.fixture(scope="module")
def group() -> Group:
    made = project(PORTAL)
    return run_analysis(made, made.analyses[0])


def test_elastic_stiffness(group: Group) -> None:
    """k = 24 E I / h^3; 16 layers have I (1 - 1/16^2)."""
    u = group.variables["roof_displacement"].values
    v = group.variables["base_shear"].values
    inertia = B * D**3 / 12 * (1 - 1 / 16**2)
    assert u[1] == pytest.approx(0.1 * H / 100)
    assert v[1] / u[1] == pytest.approx(24 * E * inertia / H**3, rel=1e-5)


def test_collapse_load(group: Group) -> None:
    """Four plastic hinges: V = 4 M_p / h. The beam is so long that columns get 1e-3 of V as axial force."""
    v = group.variables["base_shear"].values
    assert v[-1] == pytest.approx(4 * MP / H, rel=1e-4)
    assert np.all(v <= 4 * MP / H * (1 + 1e-9))
    assert group.variables["lateral_load"].values == pytest.approx(v, rel=1e-8)
    assert group.variables["storey_shear"].values[:, 0] == pytest.approx(v, rel=1e-8)
    assert group.variables["storey_drift_max"].values == pytest.approx([0.1], rel=1e-9)
    assert group.variables["lateral_load_share"].values == pytest.approx([0.5, 0.5])


def test_hinges_rotate_by_the_drift_less_the_elastic_part(group: Group) -> None:
    """Rigid beam: the chord of a column rotates by 0.1; its ends have M_p h / (6 E I) of that elastically."""
    inertia = B * D**3 / 12 * (1 - 1 / 16**2)
    elastic = MP * H / (6 * E * inertia)
    rotations = {name: group.variables[f"column_plastic_rotation_{name}"].values for name in ("max", "min")}
    largest = np.maximum(np.abs(rotations["max"]), np.abs(rotations["min"]))
    assert largest == pytest.approx(np.full((2, 2), 0.1 - elastic), rel=1e-3)
    assert np.all(group.variables["beam_plastic_rotation_max"].values == 0.0)  # it stays elastic


def test_requested_members_sections_and_fibres(group: Group) -> None:
    variables = group.variables
    assert list(group.coords["recorded_member"].values) == ["C_A_1"]
    assert list(group.coords["section"].values) == ["C_A_1:1"]
    assert list(group.coords["fibre"].values) == ["C_A_1:1:1", "C_A_1:1:16"]
    assert variables["fibre_depth"].values == pytest.approx([-D / 2 * 15 / 16, D / 2 * 15 / 16], rel=1e-12)
    assert np.abs(variables["section_moment"].values[-1]) == pytest.approx([MP], rel=1e-4)
    assert np.abs(variables["member_bending_moment"].values[-1]) == pytest.approx(np.full((1, 2), MP), rel=1e-4)
    # bottom and top layer: strain = e0 - y kappa, and both at yield with opposite signs
    strain, kappa = variables["fibre_strain"].values, variables["section_curvature"].values
    expected = variables["section_strain"].values - variables["fibre_depth"].values * kappa
    assert strain == pytest.approx(expected, rel=1e-9, abs=1e-15)
    assert sorted(variables["fibre_stress"].values[-1]) == pytest.approx([-FY, FY], rel=1e-9)


@pytest.mark.parametrize(
    ("pattern", "shares"),
    [("uniform", [0.5, 0.5]), ("triangular", [1 / 3, 2 / 3]), ("first_mode", [0.381966, 0.618034])],
)
def test_load_patterns(pattern: str, shares: list[float]) -> None:
    """Two equal storeys with equal masses; the first mode is (0.618, 1)."""
    made = shear_frame("{name: g, kind: gravity}", storeys=2)
    loads = lateral_loads(made, build_frame(made), pattern)
    by_floor = [loads["A1"] + loads["B1"], loads["A2"] + loads["B2"]]
    assert by_floor == pytest.approx(shares, abs=1e-6)
    assert sum(loads.values()) == pytest.approx(1.0, rel=1e-12)


def test_asking_for_sections_of_an_elastic_member_is_an_input_error() -> None:
    text = PORTAL.replace("fy: 250 MPa}", "fy: 250 MPa}\n  plain: {law: elastic, E: 210 GPa}").replace(
        "section: bar, material: steel", "section: bar, material: plain"
    )
    made = project(text)
    with pytest.raises(InputError, match="`C_A_1`.*E-HIST-04"):
        run_analysis(made, made.analyses[0])
