"""The motion of a building as it is read, packed and drawn."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from moving_building import DAMPERS, PICTURES, STEP, TEXT, formula, moving_archive, moving_group, small_building

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.project.building import load_building
from edesign.report.motion.building_geometry import moving_building
from edesign.report.motion.encoding import scene_text
from edesign.report.motion.geometry import Geometry
from edesign.report.motion.plan_motion import rigid_motion, storey_drifts
from edesign.report.motion.scenes import Scene, scenes
from edesign.report.motion.still import member_curve, motion_caption
from edesign.report.motion.still_building import building_still
from edesign.study.results.provenance import root_group


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Scene:
    """The history of the small building."""
    with open_archive(moving_archive(tmp_path_factory.mktemp("scene"))) as archive:
        (found,) = scenes(archive)
    return found


def test_nodes_come_back_as_the_formula_has_them(scene: Scene) -> None:
    (one,) = scene.variants
    assert scene.in_space and one.nodes is not None
    expected = formula(dict(one.geometry.nodes), STEP * np.arange(PICTURES))
    assert one.nodes == pytest.approx(expected, abs=1e-15)
    assert one.reach == pytest.approx(np.abs(expected[..., :3]).max())


def test_floors_of_the_archive_say_how_every_node_moves_in_plan(tmp_path: Path) -> None:
    """The places that are kept of each floor determine it as a rigid body; what nodes do beside is not known."""
    with open_archive(moving_archive(tmp_path, motion=False)) as archive:
        (scene,) = scenes(archive)
    (one,) = scene.variants
    expected = formula(dict(one.geometry.nodes), scene.time)
    assert one.nodes is None and one.rotation is None
    # places are kept in single precision: 6e-8 of 0.08 m, over an arm of less than twice the sides of the plan
    assert one.node_motion[..., :2] == pytest.approx(expected[..., :2], abs=2e-8)
    assert one.node_motion[..., 5] == pytest.approx(expected[..., 5], abs=1e-8)
    assert not one.node_motion[..., 2:5].any()
    assert "Only floors were kept" in motion_caption(scene)


def test_drifts_above_two_towers_are_those_of_the_lines() -> None:
    """Floor 1 has two diaphragms that part by 30 mm, floor 2 one above the first of them that does not drift."""
    names = ["A1.1", "B1.1", "C1.1", "D1.1", "A1.2", "B1.2"]
    moved = np.zeros((1, 6, 2))
    moved[0, :, 0] = [0.02, 0.02, -0.01, -0.01, 0.02, 0.02]
    floors = np.zeros((1, 3, 2))
    floors[0, 1:, 0] = [0.005, 0.02]  # the mean of the masses, and the only diaphragm
    group = Group()
    group.coords["point"] = Variable(("point",), np.array(names), "", "places")
    group.add("point_displacement", ("time", "point", "direction"), moved, "m", "of the places")
    group.add("diaphragm_floor", ("diaphragm",), np.array([1, 1]), "", "their floors")
    group.add("storey_height", ("storey",), np.array([4.0, 2.0]), "m", "heights")
    drift = storey_drifts(group, floors)
    assert drift[0, :, 0] == pytest.approx([0.00125, 0.0]) and not drift[..., 1].any()


def test_rigid_motion_is_that_of_the_points() -> None:
    """Displacement of the middle and turn of points that a rigid body takes with it, u = a - r y, v = b + r x."""
    rng = np.random.default_rng(3)
    places, a, b, turn = rng.normal(size=(7, 2)), rng.normal(size=5), rng.normal(size=5), rng.normal(size=5)
    x, y = places.T
    moved = np.stack((a[:, None] - np.outer(turn, y), b[:, None] + np.outer(turn, x)), axis=-1)
    middle, mean, found = rigid_motion(places, moved)
    assert found == pytest.approx(turn) and middle == pytest.approx(places.mean(axis=0))
    assert mean == pytest.approx(np.column_stack((a - turn * middle[1], b + turn * middle[0])))
    alone = rigid_motion(places[:1], moved[:, :1])
    assert alone[1] == pytest.approx(moved[:, 0]) and not alone[2].any()


def test_members_bend_as_beam_theory_says_in_any_direction() -> None:
    """The cantilever and the propped one of a table of beams (Timoshenko), turned into space at random."""
    rng = np.random.default_rng(11)
    along, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    x, across, about = along.T[0], along.T[1], np.cross(along.T[0], along.T[1])
    length, tip = 5.0, 0.02
    start = rng.normal(size=3)
    nodes = {"a": tuple(start), "b": tuple(start + length * x)}
    motion = np.zeros((2, 6))
    motion[1, :3] = tip * across
    s = np.linspace(0.0, 1.0, 17)

    def deflection(geometry: Geometry, turn: float) -> np.ndarray:
        motion[1, 3:] = turn * about
        curve = member_curve(geometry, "B", motion, 1.0)
        straight = start + np.outer(length * s, x)
        assert (curve - straight) @ about == pytest.approx(0.0, abs=1e-12)
        return np.asarray((curve - straight) @ across)

    rigid = Geometry(nodes, {"B": (0, 1)}, (), (0.0, 1.0))
    # w = D (3 s^2 - s^3) / 2 with the turn 3 D / (2 L) of the free end
    cantilever = tip * (3.0 * s**2 - s**3) / 2.0
    assert deflection(rigid, 1.5 * tip / length) == pytest.approx(cantilever, abs=1e-12)
    # hinged at its end the member is this cantilever, whatever the node there turns by
    hinged = replace(rigid, hinged=frozenset({("B", 1)}))
    assert deflection(hinged, 7.0 * tip / length) == pytest.approx(cantilever, abs=1e-12)
    bar = replace(rigid, hinged=frozenset({("B", 0), ("B", 1)}))
    assert deflection(bar, 7.0 * tip / length) == pytest.approx(tip * s, abs=1e-12)


def test_dampers_hang_where_their_names_say(tmp_path: Path) -> None:
    found = moving_building(small_building(tmp_path), (*DAMPERS, "VYA_1", "N_A1.0_Z9.1", "VY_A_1_1_r", "SY_B_2_1_2"))
    dampers = {damper.name: damper for damper in found.dampers}
    assert list(dampers) == ["VX_1_1_1", "RY_C_1_1", "N_B1.0_B2.1", "VY_A_1_1_r", "SY_B_2_1_2"]

    def ends(name: str) -> list[tuple[float, ...]]:
        return [point.at for point in dampers[name].body]

    assert ends("VX_1_1_1") == [(3.0, 0.0, 4.0), (3.0, 0.0, 4.0)]
    low, high = (point.nodes for point in dampers["VX_1_1_1"].body)
    names = list(found.nodes)
    assert [names[i] for i in low] == ["A1.0", "B1.0"] and [names[i] for i in high] == ["A1.1", "B1.1"]
    assert ends("RY_C_1_1") == [(11.0, 0.0, 0.0), (11.0, 4.0, 4.0)]
    assert ends("N_B1.0_B2.1") == [(6.0, 0.0, 0.0), (6.0, 4.0, 4.0)]
    assert ends("VY_A_1_1_r") == [(0.0, 0.0, 0.0), (0.0, 2.0, 4.0)]
    # this one meets the node in the middle of the beam that the braces halve
    assert [names[i] for i in dampers["VY_A_1_1_r"].body[1].nodes] == ["BY_A_1_1"] * 2
    assert ends("SY_B_2_1_2") == [(6.0, 6.0, 0.0), (6.0, 6.0, 4.0)]


def test_tuned_masses_stand_where_the_file_says(tmp_path: Path) -> None:
    text = (
        TEXT
        + """\
dampers:
  attachments:
    - {kind: tuned_mass, floor: 2, mass: 2 t, frequency: 1 Hz, damping: 8 %, direction: y, at: A3}
    - {kind: tuned_mass, floor: 1, mass: 2 t, frequency: 1 Hz, damping: 8 %, direction: x}
"""
    )
    (tmp_path / "building.yaml").write_text(text, encoding="utf-8")
    found = moving_building(load_building(tmp_path / "building.yaml"), (), ("T_2_1", "T_1_2"))
    first, second = found.masses
    assert (first.at.at, first.direction) == ((0.0, 8.0, 7.0), 1)
    # amid the floor, between two of its nodes: their mean is (5.2, 4, 4), one of them halves the beam on line A
    assert second.direction == 0 and second.at.share == 0.5
    assert second.at.at == pytest.approx((5.5, 4.0, 4.0), abs=0.5)


def test_slabs_supports_and_hinged_ends_are_those_of_the_file(tmp_path: Path) -> None:
    found = moving_building(small_building(tmp_path), ())
    places = list(found.nodes.values())
    assert [len(panels) for panels in found.slabs] == [4, 2]
    for level, panels in zip((4.0, 7.0), found.slabs, strict=True):
        for panel in panels:
            (x0, y0, _), (x1, y1, _), (x2, y2, _), (x3, y3, _) = (places[i] for i in panel)
            assert (y0, x1, y2, x3) == (y1, x2, y3, x0) and {places[i][2] for i in panel} == {level}
    kinds = {list(found.nodes)[support.node]: support.kind for support in found.supports}
    assert len(kinds) == 9 and {name for name, kind in kinds.items() if kind == "pinned"} == {"C1.0"}
    braces = {(f"DY_A_1_1_{way}", end) for way in "rf" for end in (0, 1)}
    assert found.hinged == braces | {("BY_C_1_1", 0), ("BY_C_2_1", 0)}
    assert [label for label, _, _ in found.grid] == ["A", "B", "C", "1", "2", "3"]


def test_rigid_floors_are_three_numbers_and_others_three_a_node(scene: Scene) -> None:
    """The size of what the page carries of 600 pictures of a floor of 25 nodes, rigid in plan or not."""
    (one,) = scene.variants
    assert one.nodes is not None
    loose = one.nodes.copy()
    loose[:, [i for i, name in enumerate(one.geometry.nodes) if name == "A1.1"], 0] += 1e-3
    of = {
        which: scene_text(replace(scene, variants=(replace(one, nodes=nodes),)))
        for which, nodes in (("rigid", one.nodes), ("loose", loose))
    }
    assert '"loose":[]' in of["rigid"] and '"loose":[]' not in of["loose"]
    assert len(of["rigid"]) < len(of["loose"])


def test_one_angle_of_a_record_is_shown_and_named(tmp_path: Path) -> None:
    """Two angles of one record are two motions, of which one is shown, also where both have the same name."""
    building = small_building(tmp_path)
    writer = ArchiveWriter(tmp_path / "turned.h5", root_group(building, ["wave.0deg", "wave.90deg"], {}))
    for angle in (0.0, 90.0):
        group = moving_group(building)
        group.attributes |= {"angle_deg": angle, "eccentricity": "+x+y"}
        writer.write(f"analyses/wave.{angle:g}deg", group)
    with open_archive(writer.finish({"status": "completed"})) as archive:
        (scene,) = scenes(archive)
    (one,) = scene.variants
    turned = ", turned by 90°" if one.analysis.endswith("90deg") else ""
    assert scene.record == f"wave{turned}, masses shifted to +x+y" and scene.of == 2
    assert "of 2 motions" in motion_caption(scene)


def test_still_has_two_elevations_and_the_plan(scene: Scene) -> None:
    figure = building_still(scene)
    assert [axis.get_title(loc="left") for axis in figure.axes] == [
        "elevation along x",
        "elevation along y",
        "plan, roof dark",
    ]
    (one,) = scene.variants
    moved = np.array(list(one.geometry.nodes.values())) + 20.0 * one.node_motion[scene.peak, :, :3]
    top = [i for i, place in enumerate(one.geometry.nodes.values()) if place[2] == 7.0]
    for axis, (across, up) in zip(figure.axes, ((0, 2), (1, 2), (0, 1)), strict=True):
        drawn = np.concatenate([line.get_xydata() for line in axis.get_lines()])
        for node in top:  # each is an end of a member that is drawn
            assert np.nanmin(np.hypot(*(drawn - moved[node, [across, up]]).T)) < 1e-9
    assert "0.857 % along x" in motion_caption(scene)
