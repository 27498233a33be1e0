"""Buildings with the axes of the office's plans: names in members, tables, messages and extracted frames."""

from __future__ import annotations

import re
from html import unescape
from pathlib import Path

import pytest
from building_examples import ANALYSED, SMALL, building

from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building.building import Building
from edesign.project.loader import parse_project
from edesign.report.archive.document import write_page
from edesign.report.archive.summary import summarise
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame
from edesign.study.run.building import run_building

AXES = "axes: {x: [P, Q', Sb], y: [7, 5a, 5]}"
"""Lines A, B, C across x and 1, 2, 3 across y by other names, those across y downwards."""
OWN = {"A": "P", "B": "Q'", "C": "Sb", "1": "7", "2": "5a", "3": "5"}
PLAN = ("width: 5 m}}", f"width: 5 m}}, {AXES}}}")
BRACED = ("frames: [A, C]", "frames: [P, Sb]")


def renamed(name: str) -> str:
    """The name of a member or node with the axes of the plans."""
    name = re.sub(r"\b(C_)?([ABC])([123])(?=[._])", lambda m: f"{m[1] or ''}{OWN[m[2]]}{OWN[m[3]]}", name)
    return re.sub(r"([BD][XY]_)([ABC123])_", lambda m: f"{m[1]}{OWN[m[2]]}_", name)


@pytest.fixture(scope="module")
def own() -> Building:
    return building(SMALL, PLAN, BRACED)


def test_members_and_nodes_have_the_names_of_the_plans(own: Building) -> None:
    plain = building(SMALL).grid
    assert list(own.grid.members) == [renamed(name) for name in plain.members]
    assert {renamed(name): place for name, place in plain.nodes.items()} == dict(own.grid.nodes)
    assert own.grid.ends["BX_5a_2_1"] == ("Q'5a.1", "Sb5a.1") and own.grid.line_place("Sb5a") == (10.0, 5.0)
    assert own.grid.lines_in("P-Q'") == ("P7", "P5a", "P5", "Q'7", "Q'5a", "Q'5")
    assert own.grid.lines_in("Q'5a-Sb5") == ("Q'5a", "Q'5", "Sb5a", "Sb5") and own.grid.lines_in("B2") == ()
    assert [member.frame for member in space_frame(own).members if member.name == "C_Q'5a_1"] == [("X5a", "YQ'")]


@pytest.mark.parametrize(
    ("axes", "columns", "message"),
    [
        ("x: [P, Q]", "", r"plan.axes.x: 2 names for 3 lines; one for each is needed"),
        ("x: [P, Q, P]", "", r"plan.axes.x\[2\]: `P` comes twice"),
        ("x: [P, Q, 3]", "", r"plan.axes.x\[2\]: `3` names no line across x; write a capital letter"),
        ("x: [P, Q, XA]", "", r"plan.axes.x\[2\]: `XA` names no line across x"),
        ("y: [1, 2, b]", "", r"plan.axes.y\[2\]: `b` names no line across y; write a figure"),
        ("y: [1, 2, '03']", "", r"plan.axes.y\[2\]: `03` names no line across y"),
        ("x: [P, Q, R]", "at: A1, ", r"`A1`: column lines go from P1 to R3; lines are `P, Q, R` across x"),
        ("x: [R, Q, P]", "at: P1-R1, ", r"the range `P1-R1` runs backwards"),
        ("y: [3, 2, 1]", "at: 1-3, ", r"the range `1-3` runs backwards"),
    ],
)
def test_wrong_names(axes: str, columns: str, message: str) -> None:
    changes = [("width: 5 m}}", f"width: 5 m}}, axes: {{{axes}}}}}"), ("columns: [{", f"columns: [{{{columns}")]
    with pytest.raises(InputError, match=message):
        building(SMALL.replace("frames: [A, C], ", "frames: all, "), *changes)


def test_frames_that_are_not_there(own: Building) -> None:
    with pytest.raises(InputError, match=r"no frame `A` along y; they are P, Q', Sb"):
        building(SMALL, PLAN)
    with pytest.raises(InputError, match="the frames are X7 to X5 and YP to YSb"):
        frame_row(own, space_frame(own), "X2")


@pytest.mark.parametrize("name", ["X5a", "X", "YP", "ySb"])
def test_extracted_members_are_those_of_the_building(own: Building, name: str) -> None:
    """Each member has the name of one of the building, and its nodes; the line that leans has no other."""
    frame = parse_project(project_text(frame_row(own, space_frame(own), name)), "frame.yaml", BuildingSections()).frame
    ends = {member: nodes for member, nodes in frame.ends.items() if not member.startswith("C_L_")}
    assert ends and all(set(own.grid.ends[member]) == set(nodes) for member, nodes in ends.items())
    if name == "X":
        assert frame.bays_in_building == {
            bay + start: (of, bay) for of, start in (("X7", 0), ("X5a", 3), ("X5", 6)) for bay in (1, 2)
        }
        assert "1 to 2 X7, 4 to 5 X5a, 7 to 8 X5." in project_text(frame_row(own, space_frame(own), name))


def test_all_results_have_the_names_of_the_plans(tmp_path: Path) -> None:
    """A report of a design and analyses names members of the plans, and nothing by the letters that it would have."""
    text = ANALYSED.replace(*PLAN).replace(*BRACED).replace("C_A2_1", "C_P5a_1").replace("BX_2_1_2", "BX_5a_1_2")
    (tmp_path / "own.yaml").write_text(text.replace("shaken.h5", "own.h5"), encoding="utf-8")
    run_building(load_building(tmp_path / "own.yaml"))
    write_page(tmp_path / "own.h5", tmp_path / "own.html")
    page = re.sub(r"<[^>]*>", " ", unescape((tmp_path / "own.html").read_text(encoding="utf-8")))
    for told in (page, str(summarise(tmp_path / "own.h5"))):
        assert "C_Q'5a_1" in told
        assert not re.findall(r"\b(?:C_[ABC][123]_\d|[BD][XY]_[123ABC]_\d|[ABC][123]\.\d|X[123]\b|Y[ABC]\b)", told)
