"""Keys of criteria that say where in a building: refused on plane files, and what they name exists."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import SMALL, building
from messages import says
from unit.assess.assessed import FRAME, Part

from edesign.errors import InputError
from edesign.frame.project_file import load_study
from edesign.project import parse_project
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.criteria import check_criteria
from edesign.project.notation.frames import frames_of_member
from edesign.project.reading.yaml_file import check_model


def problems_of(text: str, project: AnalysisFile, kept: tuple[HistoryKind, ...] = ("floors", "storeys")) -> list[str]:
    """All problems, as `line:column key: message`."""
    found, problems = check_model(f"criteria: [{{name: c, {text}}}]\n", Part, "study file", "criteria:")
    if found is not None:
        check_criteria((), found.criteria, (), project, ("bare",), problems, kept, {"bare": ()})
    return [f"{p.mark.line}:{p.mark.column} {p}" for p in problems.found]


@pytest.mark.parametrize("key", ["direction: x", "at: A", "frames: X1", "axis: z"])
def test_plane_frames_have_no_places_in_space(key: str) -> None:
    (problem,) = problems_of(f"measure: interstorey_drift, {key}, most: 1 %", parse_project(FRAME))
    assert problem.startswith("1:50 ") and says(problem, f"criteria[0].{key.partition(':')[0]} plane E-CRIT-04")


@pytest.mark.parametrize(
    "name", ["line_drift", "residual_line_drift", "torsional_ratio", "point_displacement", "base_shear_resultant"]
)
def test_plane_frames_have_no_quantities_of_buildings(name: str) -> None:
    limit = {"line_drift": "1 %", "residual_line_drift": "1 %", "torsional_ratio": "1.2", "point_displacement": "1 m"}
    (problem,) = problems_of(f"quantity: {name}, most: {limit.get(name, '1 MN')}", parse_project(FRAME))
    assert problem.startswith("1:32 ") and says(problem, f"`{name}` is of buildings E-CRIT-04")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("measure: interstorey_drift, at: [A1, D1], most: 1 %", "criteria[0].at[1] `D1` `A1` E-NAME-01"),
        ("measure: interstorey_drift, at: centre, most: 1 %", "criteria[0].at `centre` E-NAME-01"),
        ("measure: interstorey_drift, frames: [X1, XA], most: 1 %", "criteria[0].frames[1] `XA` `YA` E-NAME-01"),
        ("measure: interstorey_drift, frames: YA, direction: x, most: 1 %", "criteria[0].frames `YA` E-VALUE-04"),
        ("measure: interstorey_drift, axis: y, most: 1 %", "criteria[0].axis `direction` `at` E-CRIT-04"),
        ("measure: interstorey_drift, direction: resultant, most: 1 %", "direction base_shear_N E-CRIT-04"),
        ("measure: interstorey_drift, direction: z, most: 1 %", "criteria[0].direction `x` `resultant` E-VALUE-03"),
        ("measure: column_plastic_rotation, axis: x, most: 1 rad", "criteria[0].axis `y` `z` E-VALUE-03"),
        ("measure: column_axial_force, direction: x, most: 1 MN", "criteria[0].direction `frames` E-CRIT-04"),
        ("measure: column_axial_force, members: C_A1_3, most: 1 MN", "members `C_A1_3` building E-NAME-01"),
        ("measure: interstorey_drift, storeys: 3, most: 1 %", "criteria[0].storeys 3 E-NAME-01"),
        ("measure: base_shear, storeys: 2, most: 1 MN", "criteria[0].storeys building E-CRIT-04"),
        ("measure: brace_ductility, most: 2 %", "criteria[0].measure building E-CRIT-04"),
        ("quantity: point_displacement, at: [A1, C4], most: 1 m", "criteria[0].at[1] `C4` `C3` E-NAME-01"),
        ("quantity: floor_displacement, at: [centre, C3], most: 1 m", "criteria[0].at `centre` E-KEY-03"),
        ("quantity: floor_rotation, direction: x, most: 1 rad", "criteria[0].direction E-CRIT-04"),
        ("quantity: storey_torque, floors: 1, most: 1 kN*m", "criteria[0].floors `storeys` E-CRIT-04"),
        ("quantity: support_moment, lines: A, most: 1 kN*m", "criteria[0].lines `at` E-CRIT-04"),
        ("quantity: base_shear_resultant, direction: x, most: 1 MN", "criteria[0].direction E-CRIT-04"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(text: str, said: str) -> None:
    (problem,) = problems_of(text, building(SMALL), ("floors", "storeys", "supports"))
    assert problem.startswith("1:") and says(problem, said), problem


SETBACK = (
    (
        "braces:",
        "missing:\n  columns: [{at: C1-C3, storeys: 2}]\n"
        "  beams: [{along: x, bays: 2, floors: 2}, {along: y, frames: C, floors: 2}]\nbraces:",
    ),
    ("frames: [A, C], bays: 1", "frames: [A, B], bays: 1"),
    ("{G: 4 kN/m^2,", "{floors: 1, G: 4 kN/m^2,"),
)  # frame YC ends at floor 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("measure: interstorey_drift, at: [A1, B3], frames: X1, most: 1 %", "criteria[0].at[1] `B3` X1 E-CRIT-06"),
        ("measure: interstorey_drift, at: C2, storeys: 2, most: 1 %", "criteria[0].at `C2` storeys 2 E-CRIT-06"),
        ("measure: interstorey_drift, frames: YC, storeys: 2, most: 1 %", "criteria[0].frames YC E-CRIT-06"),
        ("quantity: point_displacement, at: C1, floors: 2, most: 1 m", "criteria[0].at `C1` floors 2 E-CRIT-06"),
        ("quantity: column_axial_force, members: C_A1_1, frames: X2, most: 1 MN", "members `C_A1_1` X2 E-CRIT-06"),
        ("quantity: column_axial_force, members: C_A1_1, storeys: 2, most: 1 MN", "members `C_A1_1` 2 E-CRIT-06"),
        ("quantity: brace_axial_force, frames: X2, most: 1 MN", "criteria[0].frames brace X2 `DY_A_1_1_r` E-CRIT-06"),
        ("quantity: member_use, frames: YC, storeys: 2, most: 1", "criteria[0].frames YC E-CRIT-06"),
    ],
)
def test_nothing_stands_there(text: str, said: str) -> None:
    """Such a criterion would be reported as one that does not apply."""
    (problem,) = problems_of(text, building(SMALL, *SETBACK), ("floors", "storeys"))
    assert problem.startswith("1:") and says(problem, said), problem


def test_dampers_stand_elsewhere() -> None:
    text = "criteria: [{name: c, quantity: damper_force, frames: X2, most: 1 kN}]\n"
    for dampers, count in ((("VX_1_1_1",), 1), (("VX_2_1_1",), 0), (("N_A1.0_B2.1",), 0), ((), 0)):
        found, problems = check_model(text, Part, "study file", "criteria:")
        assert found is not None
        check_criteria((), found.criteria, (), building(SMALL), ("a",), problems, dampers={"a": dampers})
        assert len(problems.found) == count


def test_all_keys_together_are_right() -> None:
    whole = building(SMALL)
    for text in (
        "measure: interstorey_drift, direction: y, at: [A1, C3], frames: [YA, YC], storeys: 1, most: 1 %",
        "quantity: floor_acceleration, at: centre, direction: x, floors: 2, most: 1 g",
        "quantity: point_acceleration, at: C3, direction: resultant, most: 1 g",
        "quantity: member_bending_moment, axis: z, frames: X1, members: C_A1_1, most: 1 kN*m",
        "quantity: damper_force, frames: X2, most: 1 kN",
        "quantity: support_vertical_reaction, at: [A1, C3], side: tension, most: 1 kN",
        "quantity: section_use, members: BX_2_1_1, most: 1",
    ):
        assert problems_of(text, whole, ("floors", "storeys", "supports")) == [], text


def test_two_directions_do_not_contradict_each_other() -> None:
    text = (
        "criteria:\n  - {name: a, measure: interstorey_drift, direction: x, least: 2 %}\n"
        "  - {name: b, measure: interstorey_drift, direction: @, most: 1 %}\n"
    )
    for direction, count in (("y", 0), ("x", 1)):
        found, problems = check_model(text.replace("@", direction), Part, "study file", "criteria:")
        assert found is not None
        check_criteria((), found.criteria, (), building(SMALL), ("bare",), problems)
        assert len(problems.found) == count


@pytest.mark.parametrize(
    ("name", "frames"),
    [
        ("C_A2_3", ("X2", "YA")),
        ("C_AB12_3", ("X12", "YAB")),
        ("BX_2_1_5", ("X2",)),
        ("BX_2_1_5_1", ("X2",)),
        ("DY_A_1_2_r", ("YA",)),
        ("VX_1_2_3", ("X1",)),
        ("C_A_3", ()),
        ("B_1_3", ()),
        ("N_A1.0_B1.1", ()),
    ],
)
def test_frames_by_names_of_members(name: str, frames: tuple[str, ...]) -> None:
    assert frames_of_member(name) == frames


def test_use_is_not_asked_of_members_without_a_class(tmp_path: Path) -> None:
    """Their archived use is 0, which would meet any limit."""
    own = "sections: {own: {area: 78 cm^2, inertia: 5700 cm^4, weak_inertia: 2000 cm^4, torsion_constant: 60 cm^4}}\n"
    shaken = "damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3]}\nintegration: {method: newmark, time_step: 0.02 s}\n"
    column = "{section: HEB200, material: S275, strong: x}"
    assert column in SMALL
    text = SMALL.replace(column, f"{column}, {{at: A1, section: own, material: S275, strong: x}}")
    (tmp_path / "building.yaml").write_text(text + own + shaken)
    (tmp_path / "study.yaml").write_text(
        "edesign_study: 1\ntitle: Uses\nproject: building.yaml\nvariants: {bare: {dampers: none}}\ncriteria:\n"
        "  - {name: use, quantity: section_use, members: [C_A1_1, C_A2_1], most: 1}\n"
    )
    with pytest.raises(InputError) as caught:
        load_study(tmp_path / "study.yaml")
    said = "criteria[0].members[0]: `section_use` does not judge `C_A1_1`: its section `own` has no class [E-CRIT-05]"
    assert said in str(caught.value) and "C_A2_1" not in str(caught.value)
