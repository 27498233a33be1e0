"""Hinges on the elevation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.text import Text
from unit.report.figure_archive import TEXT, history, small_archive

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.report.drawing.frame_drawing import FrameElevation
from edesign.report.motion.encoding import scene_text
from edesign.report.motion.scenes import scenes
from edesign.report.motion.still import still_figure
from edesign.report.response.frame_figures import ACCEPTANCE, ROTATION, Hinges, acceptance, frame_figures, hinge_figure
from edesign.report.response.histories import History
from edesign.study.results.recording import coordinate

PROJECT = parse_project(TEXT, "project.yaml", profile_names())
FRAME = PROJECT.frame  # one bay of 6 m, storeys of 4 and 3 m


def hinges(axis: Any) -> dict[tuple[str, int], int]:
    """Class of the hinges that are drawn."""
    found = {}
    for line in axis.lines:
        words = str(line.get_gid()).split()
        if words[0] == "hinge":
            found[words[1], int(words[2])] = int(words[4])
    return found


@pytest.fixture(scope="module")
def figures(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, Any]]:
    with open_archive(small_archive(tmp_path_factory.mktemp("hinges"))) as archive:
        return {name: (caption, figure) for name, caption, figure in frame_figures(archive)}


def test_hinges_are_where_members_rotate(figures: dict[str, tuple[str, Any]]) -> None:
    """Mean of 1, 2 and 3 times 4 and 6 mrad (columns), 12, 30 and 0.5 mrad (beams); the last is 1 mrad or more."""
    bare, damped = figures["hinges_DBE_mean"][1].axes
    expected = {("C_A_1", 0): 2, ("C_B_1", 0): 3, ("B_1_1", 0): 4, ("B_1_1", 1): 4, ("B_1_2", 1): 1}
    assert hinges(bare) == expected
    assert hinges(damped) == {("C_A_1", 0): 1, ("C_B_1", 0): 1, ("B_1_1", 0): 2, ("B_1_1", 1): 3}  # 0.65 times
    largest = hinges(figures["hinges_DBE_max"][1].axes[0])
    assert largest["C_A_1", 0] == 3 and largest["B_1_2", 1] == 1  # 12 and 1.5 mrad


def test_a_hinge_stands_near_its_end(figures: dict[str, tuple[str, Any]]) -> None:
    axis = figures["hinges_DBE_mean"][1].axes[0]
    at = {line.get_gid(): (line.get_xdata()[0], line.get_ydata()[0]) for line in axis.lines if line.get_gid()}
    x, y = next(place for name, place in at.items() if name.startswith("hinge B_1_1 1"))
    assert y == 4.0 and 5.0 < x < 6.0
    x, y = next(place for name, place in at.items() if name.startswith("hinge C_B_1 0"))
    assert x == 6.0 and 0.0 < y < 1.0


def test_numbers_in_the_caption(figures: dict[str, tuple[str, Any]]) -> None:
    caption = figures["hinges_DBE_mean"][0]
    assert "bare, 3 records: 5 of 12 ends rotate by more than 1 mrad, the largest is 60.0 mrad (B_1_1)" in caption
    assert "damped, Borrego 1942 B-ELC000" in caption


@pytest.mark.parametrize(("rotation", "rank"), [(0.0, 0), (0.00099, 0), (0.001, 1), (0.0051, 2), (0.012, 3), (0.03, 4)])
def test_classes_of_rotation(rotation: float, rank: int) -> None:
    assert ROTATION.rank(rotation) == rank


def test_classes_of_acceptance_of_a_compact_beam() -> None:
    """FEMA 356, Table 5-6 a: theta_y, 6 and 8 theta_y; theta_y = Z fy l / (6 E I) of an IPE300, 6 m, by its tables."""
    yield_rotation = 628.4e-6 * 275e6 * 6.0 / (6.0 * 210e9 * 8356e-8)  # EN 10365: Wpl 628.4 cm3, Iy 8356 cm4
    for multiple, rank in ((0.9, 1), (1.1, 2), (5.9, 2), (6.1, 3), (7.9, 3), (8.1, 4)):
        group = history("bare", "x", 0, 1.0)
        group.variables.pop("column_plastic_rotation_max")
        rotations = np.array([[multiple * yield_rotation, 0.0], [0.0, 0.0009]])
        group.add("beam_plastic_rotation_min", ("beam", "end"), -rotations, "rad", "least")
        found = acceptance(PROJECT, {History("x", "bare", "DBE", "x", None, True, ""): group})
        assert ACCEPTANCE.rank(found["B_1_1", 0]) == rank, multiple
        assert found["B_1_2", 1] == 0.0  # below 1 mrad


def halved(group: Any) -> Any:
    """The history of a variant whose dampers meet the beam of the first floor, as a design of braces does."""
    coordinate(group, "beam", ["B_1_1_1", "B_1_1_2", "B_1_2"], "", "beam")
    rotations = [[0.012, 0.0], [0.0, 0.003], [0.0, 0.0005]]
    group.add("beam_plastic_rotation_min", ("beam", "end"), -np.array(rotations), "rad", "least")
    return group


def test_hinges_of_beams_that_dampers_of_a_variant_halve(tmp_path: Path) -> None:
    """The file has the beam whole; its ends at columns are drawn, and the classes count all ends of both halves.

    FEMA 356, Table 5-6 a: theta_y of half the span, 3 m, is half that of 6 m, 4.9 mrad: 12 mrad is 2.4 theta_y.
    """
    root = Group()
    root.add("project_text", (), np.array(TEXT), "", "project")
    with ArchiveWriter(tmp_path / "a.h5", root) as writer:
        for name, group in (("bare", history("bare", "x", 0, 1.0)), ("brb", halved(history("brb", "x", 1, 0.1)))):
            group.add("storey_height", ("storey",), np.array([4.0, 3.0]), "m", "height")
            writer.write(f"analyses/{name}.DBE.x", group)
        writer.finish()
    with open_archive(tmp_path / "a.h5") as archive:
        found = {name: (caption, figure) for name, caption, figure in frame_figures(archive)}
        (scene,) = scenes(archive)
        still_figure(scene), scene_text(scene)
    caption, figure = found["hinges_DBE_mean"]
    assert hinges(figure.axes[1]) == {("B_1_1_1", 0): 3, ("B_1_1_2", 1): 1}
    at = {line.get_gid(): line.get_xdata()[0] for line in figure.axes[1].lines if "hinge" in str(line.get_gid())}
    first, last = at.values()
    assert 0.0 < first < 1.0 and 5.0 < last < 6.0
    assert "2 of 14 ends" in caption
    assert hinges(found["hinges_DBE_acceptance"][1].axes[1]) == {("B_1_1_1", 0): 2, ("B_1_1_2", 1): 1}
    whole, halves = (one.geometry for one in scene.variants)
    assert whole.members["B_1_1"] and halves.members["B_1_1_2"] and "B_1_1" not in halves.members


def test_members_and_dampers_to_scale() -> None:
    drawn = FrameElevation(FRAME)
    lines = drawn.lines
    assert lines["C_B_2"] == ((6.0, 4.0), (6.0, 7.0))
    assert lines["B_1_2"] == ((0.0, 7.0), (6.0, 7.0))
    chevron = drawn.damper("V_1_2")
    assert chevron is not None and chevron.at == (3.0, 7.0)
    assert chevron.braces == (((0.0, 4.0), (3.0, 7.0)), ((6.0, 4.0), (3.0, 7.0)))
    falling, between = drawn.damper("F_1_1_2"), drawn.damper("N_A0_B2")
    assert falling is not None and falling.braces == (((0.0, 4.0), (6.0, 0.0)),)
    assert between is not None and between.at == (3.0, 3.5)
    assert drawn.damper("V_2_1") is None and drawn.damper("N_A0_Z9") is None


def test_without_the_project_there_is_no_elevation(tmp_path: Path) -> None:
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer:
        writer.write("analyses/a", history("bare", "x", 0, 1.0))
        path = writer.finish()
    with open_archive(path) as archive:
        assert list(frame_figures(archive)) == []


def test_titles_stay_within_the_figure() -> None:
    figure = hinge_figure(FrameElevation(FRAME), [Hinges("push.first_mode", {}), Hinges("push.uniform", {})])
    figure.draw_without_rendering()
    titles = [text for axis in figure.axes for text in axis.get_children() if isinstance(text, Text)]
    assert max(text.get_window_extent().y1 for text in titles if text.get_text()) <= figure.bbox.y1
