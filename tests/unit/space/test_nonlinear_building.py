"""What is asked of a building's model: names, modes and reduced frames by direction."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import DAMPED, SMALL, building

from edesign.archive.dataset import Group
from edesign.core import Analysis
from edesign.space.nonlinear import build_building
from edesign.space.structure.plan_outline import corners
from edesign.study.analysis.lateral_patterns import floor_masses
from edesign.study.analysis.modal import store_modes
from edesign.study.analysis.structure import Structure, make_frame
from edesign.study.design.condensed import condense
from tools import doc_pages


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


def test_the_building_of_the_reference_has_the_dampers_that_it_tells_of() -> None:
    """Names, frames and directions of the dampers in the file that docs/reference/building_file.md shows."""
    page = (doc_pages.ROOT / "docs/reference/building_file.md").read_text(encoding="utf-8")
    (text,) = (step.text for step in doc_pages.steps(page) if step.name == "damped_building.yaml")
    frame = make_frame(building(text), dampers=True)
    told = {device.name: (device.storey, device.frame, device.direction, device.stands) for device in frame.devices}
    assert told == {
        "VX_1_1_1": (1, "X1", 0, "chevron"),
        "VX_3_1_1": (1, "X3", 0, "chevron"),
        "VX_1_1_2": (2, "X1", 0, "chevron"),
        "VX_3_1_2": (2, "X3", 0, "chevron"),
        "VY_B_1_1_r": (1, "YB", 1, "chevron_braces"),
        "VY_B_1_1_f": (1, "YB", 1, "chevron_braces"),
        "VY_B_2_1_r": (1, "YB", 1, "chevron_braces"),
        "VY_B_2_1_f": (1, "YB", 1, "chevron_braces"),
        "RX_2_2_1": (1, "X2", 0, "rising"),
        "RX_2_2_2": (2, "X2", 0, "rising"),
        "N_A1.0_B2.1": (1, "", None, "nodes"),
    }
    assert [frame.devices[i].force_scale for i in (0, 2)] == [2.0, 1.0]
    bars = {device.brace_bar.section for device in frame.devices if device.brace_bar is not None}
    assert bars == {"SHS120x8"} and len(frame.bars) == 18 + 4
    assert [stroke[0][2] for stroke in frame.attached.values()] == [0, 1]
    assert list(frame.attached) == ["T_2_1", "T_2_2"]


def test_beams_stay_halved_without_dampers_in_their_place() -> None:
    """Results of members with and without dampers are those of the same members."""
    whole = building(DAMPED)
    assert list(make_frame(whole).members) == list(make_frame(whole, dampers=True).members)
    bare = make_frame(whole.with_dampers(None))
    assert "BX_2_1_2_1" in bare.members and bare.devices == () and bare.attached == {}
