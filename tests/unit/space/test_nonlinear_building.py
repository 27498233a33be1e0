"""What is asked of a building's model: names, modes and reduced frames by direction."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import SMALL, building

from edesign.archive.dataset import Group
from edesign.core import Analysis
from edesign.space.nonlinear import build_building
from edesign.space.structure.plan_outline import corners
from edesign.study.analysis.lateral_patterns import floor_masses
from edesign.study.analysis.modal import store_modes
from edesign.study.analysis.structure import Structure
from edesign.study.design.condensed import condense


@pytest.fixture(scope="module")
def structure() -> Structure:
    """Under gravity: frames along x, diagonals in tension along y."""
    frame = build_building(building(SMALL))
    structure = Structure(frame, Analysis(frame.model))
    structure.apply_gravity()
    return structure


def test_names_and_places(structure: Structure) -> None:
    frame = structure.frame
    assert [d.name for d in frame.directions] == ["x", "y"] and frame.up == 2 and frame.model.dimension == 3
    assert list(frame.masses) == ["floor.1", "floor.2"] and set(frame.masses) <= set(frame.nodes)
    assert frame.floors[1].nodes[-1] == "floor.2"
    assert frame.places["floor.2"] == pytest.approx((5.0, 5.0, 7.0), abs=0.02)  # members stand closer on one side
    assert frame.model.node_names[frame.control] == "floor.2"
    assert [at.line for at in frame.storeys[0].drifts[0]] == [f"{c}{i}" for c in "ABC" for i in (1, 2, 3)]
    assert [at.frames for at in frame.storeys[0].drifts[0][:3]] == [("X1",), ("X2",), ("X3",)]
    assert [at.frames for at in frame.storeys[0].drifts[1][:4]] == [("YA",)] * 3 + [("YB",)]
    assert frame.supports["A1.0"] == (True,) * 6
    assert [len(storey.shear[0]) for storey in frame.storeys] == [9 + 4, 9 + 4]
    assert frame.still == tuple(name for name in frame.members if name.startswith("B"))


def test_members_bend_about_two_axes(structure: Structure) -> None:
    column, brace = (structure.frame.members[name] for name in ("C_B2_1", "DY_A_1_1_r"))
    assert column.frames == ("X2", "YB") and [bending.axis for bending in column.bending] == ["y", "z"]
    assert column.fibres is not None and len(column.outer) == 4  # the tips of the flanges
    tips = np.abs(column.fibres[list(column.outer)])
    assert np.ptp(tips, axis=0).max() < 1e-12 and (tips[0] > 0.85 * np.abs(column.fibres).max(axis=0)).all()
    assert column.bar is not None and column.bar.strut is not None
    assert column.bar.strut.length == 4.0
    assert brace.fibres is None and brace.bar is not None and brace.bar.strut is None  # it does not count


def test_modes_are_archived_by_direction(structure: Structure) -> None:
    group, modes = Group(), structure.modes(6)
    store_modes(group, structure, modes)
    found = group.variables
    assert list(group.coords["direction"].values) == ["x", "y"]
    assert found["floor_shape"].dims == ("mode", "floor", "direction")
    assert found["node_shape"].dims == ("mode", "node", "degree")
    for axis in "xy":
        assert found[f"cumulative_mass_ratio_{axis}"].values[-1] == pytest.approx(
            1.0, rel=1e-9
        )  # all modes of two floors
    # the modes together represent a unit displacement of the ground along x, and none along y
    for axis, unit in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
        ground = np.einsum("m,mfd->fd", found[f"participation_factor_{axis}"].values, found["floor_shape"].values)
        assert ground == pytest.approx(np.array([unit, unit]), abs=1e-9)
    roof = list(group.coords["node"].values).index("floor.2")
    assert found["node_shape"].values[:, roof, :2] == pytest.approx(found["floor_shape"].values[:, 1], rel=1e-12)


@pytest.mark.parametrize("direction", [0, 1])
def test_a_reduced_building_has_its_modes(structure: Structure, direction: int) -> None:
    reduced = condense(structure, direction).modes()
    modes = structure.modes(6)
    assert reduced.omega == pytest.approx(modes.omega, rel=1e-9)
    participation = np.abs(modes.participation[:, direction])
    assert np.abs(reduced.participation) == pytest.approx(participation, abs=1e-7 * participation.max())
    floors = np.array([modes.moved(floor.movers[direction][0]) for floor in structure.frame.floors]).T
    assert np.abs(reduced.floors) == pytest.approx(np.abs(floors), abs=1e-7 * np.abs(floors).max())
    forces = np.eye(reduced.masses.shape[1])
    at_floors = condense(structure, direction).at_floors(forces)
    assert at_floors.sum() == 2.0  # a force on each mass that moves in this direction


def test_floors_that_are_not_rigid_move_as_their_masses() -> None:
    """Each node counts by its mass, whose sum is that of the floor; the base has none."""
    frame = build_building(building(SMALL, ("columns:", "diaphragms: 2\ncolumns:")))
    loose, rigid = frame.floors
    assert loose.turn == () and rigid.turn == ((1.0, frame.nodes["floor.2"], 5),)
    ((mover,), (across,)) = loose.movers
    assert [degree for _, _, degree in (*mover, *across)] == [0] * 9 + [1] * 9
    masses = [frame.masses[frame.model.node_names[node]] for _, node, _ in mover]
    assert [share for share, _, _ in mover] == pytest.approx((np.array(masses) / sum(masses)).tolist(), rel=1e-12)
    assert floor_masses(frame).sum() == pytest.approx(frame.mass, rel=1e-12)
    assert set(loose.points) == set(rigid.points) == {"A1", "A3", "C1", "C3"}


def test_corners_of_an_outline() -> None:
    """An L of four bays turns in six places, once inwards; the lines between bays along an edge are no corners."""
    assert corners({(1, 1), (2, 1), (3, 1), (1, 2)}) == [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)]
