"""Yield strengths by thickness: EN 10025-2, Table 7, and EN 1993-1-1, Table 3.1."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import SMALL, building, design_of

from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.steel_section import steel_section
from edesign.project import parse_project
from edesign.report.building.assumptions import building_assumption_rows
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.extract import frame_row, project_text
from edesign.space.selection.groups import groups_of
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.steel_by_thickness import thick_parts, with_steel_by_thickness
from edesign.study.results.checked_members import checked_members

THICK = (
    SMALL.replace("columns: [{section: HEB200,", "columns: [{section: HEB450,")
    + "  members: {yield_by_thickness: true}\n"
)
"""Flanges of HEB450 are 26 mm thick: 265 MPa by EN 10025-2, and 275 MPa by Table 3.1; all others are below 16 mm."""


def test_members_are_of_the_steel_of_their_thickest_part() -> None:
    frame = design_of(THICK).frame
    assert {member.material for member in frame.members if member.kind == "column"} == {"S275_t40"}
    assert {member.material for member in frame.members if member.kind != "column"} == {"S275"}
    of_table = design_of(THICK, ("thickness: true", "thickness: table-3.1")).frame
    assert {member.material for member in of_table.members} == {"S275"}


def test_checks_take_the_lower_strength() -> None:
    """N alone in a column: its utilisation grows by 275 / 265 (1e-12)."""
    with_it, without = (design_of(THICK, ("thickness: true", f"thickness: {key}")) for key in ("en10025-2", "false"))
    column = [member.kind for member in with_it.frame.members].index("column")
    check = with_it.members.checks.index("N")
    one, other = (of.members.utilisation[column, check] for of in (with_it, without))
    assert with_it.building.materials["S275_t40"].fy == 265e6
    assert one == pytest.approx(other * 275.0 / 265.0, rel=1e-12)


def test_other_sections_bring_their_own_steel() -> None:
    """The analysis of HEB450 in place of HEB200 is that of a file that has it, but for rounding (1e-9)."""
    thin = building(THICK, ("HEB450", "HEB200"))
    found = ElasticAnalysis(thin).design({"C1": "HEB450"})
    whole = design_of(THICK).members.utilisation
    np.testing.assert_allclose(found.members.utilisation, whole, rtol=1e-9, atol=1e-9)


def test_sections_that_are_too_thick_are_left_out() -> None:
    """Table 3.1 ends at 80 mm; the flanges of HD400x818 have 97 mm."""
    assert steel_section("HD400x818").tf > 0.08
    text = THICK.replace("thickness: true", "thickness: table-3.1")
    listed = building(text + "  select: {lists: {columns: [HEB450, HD400x818]}}\n")
    group = next(group for group in groups_of(ElasticAnalysis(listed)) if group.name == "C1")
    assert group.sections == ("HEB450",) and group.left_out == ("HD400x818.0",)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ([("S275: {fy: 275 MPa}", "S275: {fy: 265 MPa}")], "materials.S275.fy: 265 MPa, .* 275 MPa .*E-SPACE-09"),
        ([("HEB450", "HD400x1086"), ("thickness: true", "thickness: table-3.1")], "125 mm .* 80 mm, .*E-EC3-02"),
        ([("thickness: true", "thickness: 3")], "yield_by_thickness"),
    ],
)
def test_what_is_refused(changes: list[tuple[str, str]], says: str) -> None:
    with pytest.raises(InputError, match=says):
        with_steel_by_thickness(building(THICK, *changes))


_BY_MATERIALS = THICK.replace("  members: {yield_by_thickness: true}\n", "")


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ([], ["HEB450 275 MPa (26 mm: 265 MPa)"]),
        (
            [("HEB450", "HD400x634"), ("IPE300", "HEB300")],
            ["HD400x634.0 275 MPa (77.1 mm: 245 MPa), HEB300 275 MPa (19 mm: 265"],
        ),
        ([("HEB450", "HEB200")], []),  # flanges of 15 mm
        ([("S275: {fy: 275 MPa}", "S275: {fy: 265 MPa}")], []),  # that of the thick parts
        ([("S275: {fy: 275 MPa}", "S275: {fy: 300 MPa}")], []),  # as measured
        ([("ductility_class: medium", "ductility_class: medium\n  members: {yield_by_thickness: false}")], []),
    ],
)
def test_thick_parts_with_the_strength_of_thin_ones_are_said(changes: list[tuple[str, str]], says: list[str]) -> None:
    """EN 10025-2, Table 7, S275: 265 MPa up to 40 mm, 245 MPa up to 80 mm; frames that are extracted say it too."""
    of = building(_BY_MATERIALS, *changes)
    said = dict(building_assumption_rows(of)).get("Yield strength in checks", "")
    assert bool(said) == bool(says) and all(part in said for part in says)
    frame = parse_project(project_text(frame_row(of, space_frame(of), "X2")), "frame.yaml", BuildingSections())
    assert thick_parts(frame) == said


def test_extracted_frames_have_the_steel_of_their_building() -> None:
    """Their materials are by thickness, so that their checks take these as they are."""
    of = with_steel_by_thickness(building(THICK))
    frame = parse_project(project_text(frame_row(of, space_frame(of), "X2")), "frame.yaml", BuildingSections())
    (column,) = checked_members(frame, ["C_A2_1"]).members
    assert column.plastic.fy == 265e6
    assert thick_parts(frame) == ""


def test_a_name_that_is_no_grade() -> None:
    text = THICK.replace("S275", "mild")
    with pytest.raises(InputError, match="materials.mild: .*E-SPACE-09"):
        with_steel_by_thickness(building(text))
    assert with_steel_by_thickness(building(THICK.replace("S275", "S275JR"))).materials["S275JR_t40"].fy == 265e6
