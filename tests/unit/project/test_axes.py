"""Column lines with the names that plans have for them."""

from __future__ import annotations

import pytest
from shear_frames import shear_frame_text

from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project.loader import parse_project
from edesign.project.notation.selections import parse_lines
from edesign.project.project import Project


def read(axes: str, columns: str = "") -> Project:
    text = shear_frame_text(1).replace("  storeys:", f"  axes: {axes}\n  storeys:")
    text = text.replace("columns: [{", f"columns: [{{{columns}") + "analyses: [{name: g, kind: gravity}]\n"
    return parse_project(text, "project.yaml", profile_names())


def test_members_and_nodes_have_the_names_of_their_lines() -> None:
    frame = read("[A2, B']", "lines: A2-B', ").frame
    assert list(frame.nodes) == ["A2.0", "B'.0", "A2.1", "B'.1"]
    assert frame.ends["C_A2_1"] == ("A2.0", "A2.1") and frame.line_place("B'") == (8.0,)
    assert list(read("[P, Q]").frame.nodes) == ["P0", "Q0", "P1", "Q1"]


@pytest.mark.parametrize(
    ("axes", "columns", "message"),
    [
        ("[A2]", "", "frame.axes: 1 name for 2 lines"),
        ("[A2, A2]", "", r"frame.axes\[1\]: `A2` comes twice"),
        ("[1, 2]", "", r"frame.axes\[0\]: `1` names no line"),
        ("[A2, B2]", "lines: A, ", "there is no line A; lines are named A2 to B2"),
        ("[A2, B2]", "lines: B2-A2, ", "the range `B2-A2` runs backwards; write `A2-B2`"),
    ],
)
def test_wrong_names(axes: str, columns: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(axes, columns)


def test_ranges_go_by_the_places_of_lines() -> None:
    lines = ("C1", "A1", "B", "A2")
    assert parse_lines("A1-A2").names(lines) == ("A1", "B", "A2")
    assert parse_lines(["C1", "B"]).names(lines) == ("C1", "B")
    assert parse_lines("Z").names(lines) == () and parse_lines("Z9-A2").names(lines) == ()
