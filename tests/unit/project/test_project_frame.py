"""The grid and members of frames, counted by hand."""

from __future__ import annotations

import pytest

from edesign.project import Project, ProjectError, parse_project


@pytest.fixture
def project(small: str) -> Project:
    return parse_project(small)


def test_grid(project: Project) -> None:
    frame = project.frame
    assert (frame.n_bays, frame.n_lines, frame.n_storeys) == (2, 3, 3)
    assert frame.lines == ("A", "B", "C")
    assert frame.bay_lines(2) == ("B", "C")
    assert frame.x == (0.0, 6.0, 13.5)
    assert frame.levels == (0.0, 3.5, 7.0, 10.5)
    assert frame.height == 10.5


def test_later_runs_override_and_missing_members_are_gone(project: Project) -> None:
    frame = project.frame
    sections = {place: run.section for place, run in frame.column_at.items()}
    assert sections[("B", 1)] == "HEB260" and sections[("B", 2)] == sections[("B", 3)] == "HEB240"
    assert len(sections) == 8 and ("C", 3) not in sections
    assert list(frame.beam_at) == [(1, 1), (2, 1), (1, 2), (2, 2), (1, 3)]
    assert list(frame.members)[:3] == ["C_A_1", "C_B_1", "C_C_1"]
    assert len(frame.members) == 13
    assert "C3" not in frame.nodes and len(frame.nodes) == 11
    assert frame.nodes["B2"] == (6.0, 7.0)


def test_supports_by_line(project: Project) -> None:
    assert [project.frame.support(line) for line in "ABC"] == ["fixed", "pinned", "fixed"]


def test_braces_and_releases(small: str) -> None:
    text = small.replace(
        "sections:\n",
        "  diaphragms: [1, 3]\n"
        "  braces:\n"
        "    - {bays: 1, storeys: all, kind: rising, section: rod, material: S275}\n"
        "    - {bays: 1, storeys: 2, kind: cross, section: rod, material: S275}\n"
        "  releases:\n"
        "    - {beams: {bays: all, floors: 1-3}, ends: start}\n"
        "    - {beams: {bays: 1, floors: 1}, ends: end}\n"
        "    - {columns: {lines: A, storeys: 1}, ends: both}\n"
        "sections:\n",
    )
    frame = parse_project(text).frame
    assert list(frame.brace_at) == [(1, 1, "r"), (1, 2, "r"), (1, 2, "f"), (1, 3, "r")]
    assert frame.diaphragm_floors == (1, 3)
    assert frame.released["B_1_1"] == (True, True)
    assert frame.released["B_2_2"] == (True, False)
    assert frame.released["C_A_1"] == (True, True)
    assert "B_2_3" not in frame.released, "it does not stand"


def test_a_selection_of_all_takes_only_what_exists(project: Project) -> None:
    given = project.masses.given if project.masses else None
    assert given is not None
    assert len(project.frame.node_places(given[0].lines, given[0].floors)) == 6
    loads = project.loads.beams[0]
    assert project.frame.standing_beams(loads) == [(1, 1), (2, 1), (1, 2), (2, 2)]


def test_defaults_and_marks(project: Project, small: str) -> None:
    assert project.elements.integration_points == 5
    assert project.elements.geometry.columns == "p_delta"
    assert project.text == small
    assert project.where("analyses", 1, "record") == "project.yaml:31:42"
    assert project.where("records", "el_centro") == "project.yaml:28:14"
    assert project.where("elements") == "project.yaml:1:1", "a default has no place of its own"
    assert str(project.archive_path) == "project.h5"


def test_projects_do_not_change(project: Project) -> None:
    with pytest.raises(ValueError, match="frozen"):
        project.title = "other"  # type: ignore[misc]


CHEVRONS = (
    "  braces:\n"
    "    - {bays: 1, storeys: 1, kind: chevron, section: rod, material: S275}\n"
    "    - {bays: 2, storeys: 2, kind: v, section: rod, material: S275}\n"
)


def test_beams_that_braces_meet_are_two_members(small: str) -> None:
    release = "  releases: [{beams: {bays: all, floors: 1}, ends: both}]\n"
    frame = parse_project(small.replace("sections:\n", CHEVRONS + release + "sections:\n")).frame
    assert frame.nodes["B_1_1"] == (3.0, 3.5) and frame.nodes["B_2_1"] == (9.75, 3.5)
    assert {"B_1_1_1", "B_1_1_2", "B_2_1_1", "B_2_1_2", "B_1_2"} < set(frame.members)
    assert "B_1_1" not in frame.members and "B_1_2" not in frame.nodes
    assert frame.brace_nodes(1, 1, "r") == ("A0", "B_1_1") and frame.brace_nodes(1, 1, "f") == ("B_1_1", "B0")
    assert frame.brace_nodes(2, 2, "f") == ("B2", "B_2_1") and frame.brace_nodes(2, 2, "r") == ("B_2_1", "C2")
    assert frame.released == {name: (name.endswith("_1"), name.endswith("_2")) for name in frame.released}
    assert len(frame.released) == 4


@pytest.mark.parametrize(
    ("braces", "said"),
    [
        ("{bays: 2, storeys: 3, kind: chevron", r"frame.braces\[0\].kind.* B_2_3 .*E-DAMPER-05"),
        ("{bays: 1, storeys: 1, kind: v", r"frame.braces\[0\].kind.* bay 1 .*E-DAMPER-05"),
    ],
)
def test_braces_need_the_beam_that_they_meet(small: str, braces: str, said: str) -> None:
    text = small.replace("sections:\n", f"  braces: [{braces}, section: rod, material: S275}}]\nsections:\n")
    with pytest.raises(ProjectError, match=said):
        parse_project(text)


def test_only_sections_with_two_axes_bend_about_the_weak_one(small: str) -> None:
    column = "{storeys: all, section: HEB260, material: S275}"
    weak = small.replace(column, column.replace("HEB260", "girder").replace("}", ", axis: weak}"))
    assert parse_project(weak).frame.column_at["A", 1].axis == "weak"
    solid = weak.replace("section: girder, material: S275, axis", "section: solid, material: S275, axis")
    rectangles = "sections:\n  solid: {rectangles: [{width: 0.1 m, depth: 0.2 m, centre: 0 m}]}\n"
    with pytest.raises(ProjectError, match=r"columns\[0\].axis.*E-FRAME-02"):
        parse_project(solid.replace("sections:\n", rectangles))
    beam = "{floors: 1-3, section: girder, material: S275}"
    flat = small.replace(beam, beam.replace("}", ", axis: weak}"))
    assert parse_project(flat).frame.beam_at[1, 1].axis == "weak"
    with pytest.raises(ProjectError, match=r"beams\[0\].axis.*E-FRAME-02"):
        parse_project(
            flat.replace("girder, material: S275, axis", "solid, material: S275, axis").replace(
                "sections:\n", rectangles
            )
        )


def test_layers_of_hollow_sections_are_counted_when_they_are_cut(small: str) -> None:
    """A tube has more layers than an I section of the same cut, 24; what is asked for is checked by the run."""
    fibres = "  fibres: [{member: C_A_1, points: 1, layers: 26}]\n"
    with pytest.raises(ProjectError, match=r"outputs.fibres\[0\].layers.* 1 to 24 .*E-NAME-01"):
        parse_project(small + fibres)
    parse_project((small + fibres).replace("HEB260", "SHS260x10"))
