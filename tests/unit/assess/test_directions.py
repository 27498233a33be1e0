"""Results of a building seen along one direction, or in one plane frame: taken from whole arrays by hand."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.assess.known_history import known_history
from unit.assess.test_building_criteria import shaken, whole

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.assess.directions import frame_view, views
from edesign.assess.measures import response_measures
from edesign.assess.profile import storey_profile

__all__ = ["shaken", "whole"]


def values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


def names(group: Group, dimension: str) -> list[str]:
    return [str(name) for name in group.coords[dimension].values]


def test_a_plane_frame_is_its_own_view() -> None:
    group = known_history()
    assert views(group) == {"": group}


def test_a_direction_is_read_as_a_plane_frame(shaken: Group) -> None:
    for i, (direction, view) in enumerate(views(shaken).items()):
        assert direction == "xy"[i] and "direction" not in view.coords
        for name, item in view.variables.items():
            assert not {"direction"} & set(item.dims), name
            assert all(dim in view.coords for dim in item.dims), name
            assert item.values.shape == tuple(len(view.coords[dim].values) for dim in item.dims), name
        for name in ("floor_displacement", "storey_drift_max", "base_shear", "line_drift_min", "point_acceleration"):
            assert np.array_equal(values(view, name), values(shaken, name)[..., i]), name
        for name in ("floor_rotation", "storey_torque_max", "energy", "column_axial_force_min"):
            assert np.array_equal(values(view, name), values(shaken, name)), name
        profile = storey_profile(view)
        assert all(of.shape == (2,) for of in profile.values()) and len(profile) == 5
        beams = names(view, "beam")
        assert beams == [name for name in names(shaken, "beam") if name.startswith(f"B{direction.upper()}_")]
        assert names(view, "brace") == ([] if direction == "x" else names(shaken, "brace"))
        assert names(view, "column") == names(shaken, "column")
        at = [names(shaken, "beam").index(name) for name in beams]
        expected = values(shaken, "beam_plastic_rotation_max")[at, :, 0]  # beams bend about y in their frame
        assert np.array_equal(values(view, "beam_plastic_rotation_max"), expected)
    whole, of_directions = response_measures(shaken), [response_measures(view) for view in views(shaken).values()]
    for measure in ("interstorey_drift", "base_shear_N", "roof_displacement_m", "residual_interstorey_drift"):
        assert whole[measure] == max(float(one[measure] or 0.0) for one in of_directions)


def test_columns_bend_about_the_axis_that_stands_across(shaken: Group) -> None:
    columns, rotations = names(shaken, "column"), values(shaken, "column_plastic_rotation_max")
    strong = dict.fromkeys(columns, "x")
    seen = views(shaken, strong)
    assert np.array_equal(values(seen["x"], "column_plastic_rotation_max"), rotations[..., 0])
    assert np.array_equal(values(seen["y"], "column_plastic_rotation_max"), rotations[..., 1])
    moments = values(shaken, "member_bending_moment")
    at = names(shaken, "recorded_member").index("C_A1_1")
    assert np.array_equal(values(seen["y"], "member_bending_moment")[:, 0], moments[:, at, :, 1])
    assert np.array_equal(values(views(shaken)["x"], "column_plastic_rotation_max"), rotations[..., 0])  # as archived
    open_axis = values(views(shaken, {})["x"], "column_plastic_rotation_max")
    assert np.array_equal(np.abs(open_axis), np.abs(rotations).max(axis=-1))


@pytest.mark.parametrize(("frame", "lines", "i"), [("X3", ("A3", "B3", "C3"), 0), ("YA", ("A1", "A2", "A3"), 1)])
def test_a_frame_has_its_lines_and_members(shaken: Group, frame: str, lines: tuple[str, ...], i: int) -> None:
    view = frame_view(shaken, frame)
    labels = names(shaken, "drift_line")
    for storey in (1, 2):
        at = [labels.index(f"{line}.{storey}") for line in lines]
        for name, source, take in (
            ("storey_drift_max", "line_drift_max", np.max),
            ("storey_drift_min", "line_drift_min", np.min),
            ("residual_storey_drift", "residual_line_drift", np.mean),
            ("storey_drift_final", "line_drift_final", np.mean),
        ):
            assert values(view, name)[storey - 1] == take(values(shaken, source)[at, i]), name
    assert names(view, "column") == [f"C_{line}_{storey}" for storey in (1, 2) for line in lines]
    assert all(name.startswith(f"B{frame[0]}_{frame[1]}_") for name in names(view, "beam"))
    assert len(names(view, "brace")) == (4 if frame == "YA" else 0)
    left = {"storey_shear", "storey_drift", "base_shear", "storey_torque", "overturning_moment"}
    assert not left & set(view.variables) and "storey_height" in view.variables


def test_views_of_an_archive_read_what_is_asked_for(shaken: Group, tmp_path: Path) -> None:
    path = tmp_path / "shaken.h5"
    with ArchiveWriter(path, Group()) as writer:
        writer.write("analyses/shaken", shaken)
        writer.finish()
    with open_archive(path) as archive:
        group = archive.view("analyses/shaken")
        seen = views(group)["y"]
        assert np.array_equal(values(seen, "base_shear_max"), values(shaken, "base_shear_max")[1])
        assert "floor_displacement" not in group.variables._have  # type: ignore[attr-defined]
