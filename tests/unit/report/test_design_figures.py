"""Designs as figures, and the SVG that a page takes in."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from unit.report.figure_archive import small_archive

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.report.archive.figures import all_figures, draw_figures
from edesign.report.design.figures import design_figures
from edesign.report.drawing.style import svg_text
from edesign.study.results.recording import coordinate

AREAS = np.array([[0.4, 0.2], [0.8, 0.4], [0.6, 0.3]])


def design() -> Group:
    """Three rounds, two storeys: missed, met, met with less."""
    group = Group(attributes={"status": "completed", "method": "strain_energy", "layers": 2, "number": 1, "places": 4})
    coordinate(group, "storey", [1, 2], "1", "storey")
    coordinate(group, "round", [1, 2, 3], "1", "round")
    coordinate(group, "criterion", ["drift"], "", "criterion")
    add = group.add
    add("storey_stiffness", ("storey",), [4e7, 2e7], "N/m", "frame")
    add("damper_stiffness", ("storey",), [2e7, 1e7], "N/m", "dampers")
    add("layer_area", ("storey",), AREAS[2], "m2", "area")
    add("round_layer_area", ("round", "storey"), AREAS, "m2", "area")
    add("round_target", ("round",), [0.05, 0.12, 0.09], "1", "target")
    add("round_damping_strain_energy", ("round",), [0.048, 0.11, 0.085], "1", "damping")
    add("round_period", ("round",), [1.8, 1.5, 1.6], "s", "period")
    add("verdict_value", ("round", "criterion"), [[0.02], [0.012], [0.014]], "1", "value")
    add("verdict_limit", ("round", "criterion"), [[0.015], [0.015], [0.015]], "1", "limit")
    add("verdict_met", ("round", "criterion"), [[0.0], [1.0], [1.0]], "1", "met")
    return group


def test_rounds_and_heights_of_a_design(tmp_path: Path) -> None:
    with open_archive(small_archive(tmp_path, ("designs/thesis", design()))) as archive:
        found = {name: (caption, figure) for name, caption, figure in design_figures(archive)}
    assert list(found) == ["design_thesis_heights", "design_thesis_rounds"]
    caption, heights = found["design_thesis_heights"]
    assert "50.0 % of the stiffness of their storeys" in caption
    left, right = heights.axes
    assert [bar.get_width() for bar in left.patches] == pytest.approx([40.0, 20.0, 20.0, 10.0])  # MN/m
    assert [bar.get_width() for bar in right.patches] == pytest.approx([0.6, 0.3])
    assert len(right.lines) == 3  # one of each round
    damping, area, period, verdicts = found["design_thesis_rounds"][1].axes
    assert damping.lines[0].get_ydata() == pytest.approx([5.0, 12.0, 9.0])
    assert area.lines[0].get_ydata() == pytest.approx(2 * 2 * AREAS.sum(axis=1))  # 2 layers, 2 places a storey
    assert period.lines[0].get_ydata() == pytest.approx([1.8, 1.5, 1.6])
    assert verdicts.lines[0].get_ydata() == pytest.approx([4 / 3, 0.8, 14 / 15])
    marks = [line for line in verdicts.lines if len(line.get_xdata()) == 1]
    assert [mark.get_markerfacecolor() == "white" for mark in marks] == [True, False, False]


def test_rounds_that_follow_a_strain(tmp_path: Path) -> None:
    group = design()
    group.attributes["chosen_round"] = 3
    coordinate(group, "iteration", [1, 2], "1", "iteration")
    coordinate(group, "strain_step", [1, 2, 3], "1", "step")
    add = group.add
    for name, values in (("frequency", [0.9, 1.1]), ("next_frequency", [1.1, 1.1]), ("damping", [0.05, 0.05])):
        add(f"iteration_{name}", ("iteration",), values, "1", name)
    add("strain_step_taken", ("strain_step",), [0.4, 0.25, 0.24], "1", "taken")
    add("strain_step_reached", ("strain_step",), [0.22, 0.24, 0.24], "1", "reached")
    add("round_strain", ("round",), [0.24, 0.3, 0.28], "1", "strain")
    add("round_history_strain", ("round",), [0.35, 0.27, 0.28], "1", "strain")
    with open_archive(small_archive(tmp_path, ("designs/thesis", group))) as archive:
        found = {name: (caption, figure) for name, caption, figure in design_figures(archive)}
    caption, rounds = found["design_thesis_rounds"]
    assert "Round 3 is the one that was chosen." in caption
    assert [axis.get_ylabel().rpartition(" ")[2] for axis in rounds.axes[:5]] == ["(%)", "(m²)", "(s)", "(1)", "(%)"]
    for axis in rounds.axes[:5]:
        (shaded,) = axis.patches
        assert shaded.get_x() == pytest.approx(2.7) and shaded.get_width() == pytest.approx(0.6)
    assert rounds.axes[4].lines[1].get_ydata() == pytest.approx([35.0, 27.0, 28.0])
    caption, iterations = found["design_thesis_iterations"]
    assert caption.endswith("at the first frequency and the strain that is reached.")
    taken, reached = iterations.axes[2].lines
    assert taken.get_ydata() == pytest.approx([40.0, 25.0, 24.0]) and reached.get_ydata()[-1] == pytest.approx(24.0)


def test_all_figures_have_their_own_names(tmp_path: Path) -> None:
    with open_archive(small_archive(tmp_path, ("designs/thesis", design()))) as archive:
        names = [name for name, _, _ in all_figures(archive)]
    assert len(names) == len(set(names))
    assert {"design_thesis_rounds", "profile_storey_drift_DBE", "hinges_DBE_mean", "axial_DBE"} <= set(names)


def test_figures_become_files(tmp_path: Path) -> None:
    with ArchiveWriter(tmp_path / "designs.h5", Group()) as writer:
        writer.write("designs/thesis", design())
        path = writer.finish()
    files = draw_figures(path, tmp_path / "figures", "svg")
    assert [file.name for file in files] == ["design_thesis_heights.svg", "design_thesis_rounds.svg"]
    assert all(ElementTree.parse(file).getroot().tag.endswith("svg") for file in files)


def test_svg_of_a_page_is_one_element_with_text(tmp_path: Path) -> None:
    with open_archive(small_archive(tmp_path, ("designs/thesis", design()))) as archive:
        _, _, figure = next(iter(design_figures(archive)))
    root = ElementTree.fromstring(svg_text(figure))
    assert root.tag.endswith("svg")
    names = [element.attrib["id"] for element in root.iter() if "id" in element.attrib]
    assert names
    used = [value[1:] for element in root.iter() for key, value in element.attrib.items() if key.endswith("href")]
    assert set(used) <= set(names)
    assert "area of a layer (m²)" in {"".join(element.itertext()).strip() for element in root.iter()}
