"""Loops of dampers as figures."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.report.drawing.style import AFTER, TARGET
from edesign.report.response.damper_loops import MOST, Loops, loops_figure
from edesign.study.results.recording import coordinate


def history(dampers: int, storeys: int, size: float = 1.0) -> Group:
    """Ellipses that grow with the number of the damper: 1 mm and 10 kN a number."""
    angle = np.linspace(0.0, 2.0 * np.pi, 49)  # the extremes are among them
    numbers = np.arange(1, dampers + 1)
    group = Group()
    coordinate(group, "damper", [f"V_1_{i}" for i in numbers], "", "name")
    group.add("damper_storey", ("damper",), (numbers - 1) % storeys + 1, "1", "storey")
    group.add("damper_deformation", ("time", "damper"), size * 1e-3 * np.outer(np.sin(angle), numbers), "m", "u")
    group.add("damper_force", ("time", "damper"), size * 1e4 * np.outer(np.cos(angle), numbers), "N", "F")
    return group


def titles(figure: object) -> list[str]:
    axes = [axis for axis in figure.axes if axis.get_visible()]  # type: ignore[attr-defined]
    return [axis.texts[0].get_text() for axis in axes]


def test_dampers_of_a_storey_share_a_panel_in_mm_and_kN() -> None:
    figure = loops_figure([Loops("", history(6, 3), AFTER)])
    assert titles(figure) == ["storey 1", "storey 2", "storey 3"]
    third = figure.axes[2]
    curves = [line for line in third.lines if len(line.get_xdata()) == 49]
    assert [np.max(line.get_xdata()) for line in curves] == pytest.approx([3.0, 6.0])
    assert [line.get_ydata()[0] for line in curves] == pytest.approx([30.0, 60.0])
    assert figure.axes[0].get_xlim() == third.get_xlim() == pytest.approx((-6.3, 6.3))  # one scale


def test_two_histories_are_overlaid() -> None:
    figure = loops_figure([Loops("cold", history(2, 2), AFTER), Loops("warm", history(2, 2, 1.5), TARGET)])
    curves = [line for line in figure.axes[1].lines if len(line.get_xdata()) == 49]
    assert [np.max(line.get_xdata()) for line in curves] == pytest.approx([2.0, 3.0])
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["cold", "warm"]


def test_tested_strain_is_marked_and_strain_stands_at_the_top() -> None:
    group = history(2, 2)
    group.add("damper_layer_thickness", ("damper",), [0.004, 0.004], "m", "thickness")
    group.add("damper_tested_strain", ("damper",), [0.4, 0.4], "1", "strain")
    figure = loops_figure([Loops("", group, AFTER)])
    marks = [line.get_xdata()[0] for line in figure.axes[0].lines if line.get_color() == TARGET]
    assert marks == pytest.approx([-1.6, 1.6])  # 40 % of 4 mm
    (strain,) = figure.axes[0].child_axes
    figure.savefig(BytesIO())  # the second scale follows when the figure is drawn
    assert strain.get_xlim() == pytest.approx((-52.5, 52.5))  # 1.05 times 2 mm of 4 mm
    assert figure.legends[0].get_texts()[0].get_text() == "tested to a strain of 40 %"


def test_of_many_storeys_those_with_the_largest_deformation_are_shown() -> None:
    figure = loops_figure([Loops("", history(MOST + 3, MOST + 3), AFTER)])
    assert titles(figure) == [f"storey {i}" for i in range(4, MOST + 4)]


def test_a_damper_that_spans_no_storey_has_a_panel_with_its_name() -> None:
    group = history(2, 2)
    group.add("damper_storey", ("damper",), [1, 0], "1", "storey")
    assert titles(loops_figure([Loops("", group, AFTER)])) == ["storey 1", "V_1_2"]
