"""Braces of angles in buildings: tension, buckling, lists to choose from, and where they are refused."""

from __future__ import annotations

import pytest
from building_examples import building, design_of, number_of
from test_own_load_cases import BRACED

from edesign.core.member_checks import Check
from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.space.check import check_building
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame

ANGLES = BRACED.replace("section: SHS100x5, material: S275", "section: L 80x10, material: S235").replace(
    "materials: {S275: {fy: 275 MPa}}", "materials: {S275: {fy: 275 MPa}, S235: {fy: 235 MPa}}"
)


def test_tension_of_a_cross() -> None:
    """N = 60.09 kN of the wind (see there), N_pl,Rd = 15.1 cm2 x 23.5 = 355 kN: 1.5 x 60.09 / 355 = 0.254."""
    design = design_of(ANGLES)
    number = number_of(design.frame, "DY_A_1_1_r")
    assert design.frame.members[number].section == "L80x80x10"
    column = list(Check).index(Check.N)
    area = steel_section("L80x80x10").A
    rows = design.members.rows
    wind = next(k for k, row in enumerate(rows) if row.name == "1.35 G + 1.05 Q + 1.5 wind + 0.75 drift")
    N = design.effects.of_static(rows[wind])[number, 0, 0]
    assert N == pytest.approx(1.5 * 60.0925e3, rel=1e-3)
    assert design.members.utilisation[number, column] >= N / (area * 235e6) - 1e-9


def test_design_of_angles_in_compression_is_checked_for_buckling() -> None:
    design = design_of(ANGLES.replace("kind: cross, section", "kind: cross, compression: true, section"))
    number = number_of(design.frame, "DY_A_1_1_r")
    assert design.members.utilisation[number, list(Check).index(Check.N_B)] > 0.0


def test_lists_of_angles() -> None:
    select = "  select: {lists: {@: [L]}}\n  serviceability:"
    check_building(building(ANGLES.replace("  serviceability:", select.replace("@", "braces"))))
    with pytest.raises(InputError, match="sections that only braces can have"):
        check_building(building(ANGLES.replace("  serviceability:", select.replace("@", "columns"))))


def test_extracted_frames_have_area_and_inertia() -> None:
    made = building(ANGLES)
    text = project_text(frame_row(made, space_frame(made), "YA"))
    assert "L80x80x10: {area: 15.1" in text and "inertia: 36." in text


def test_columns_and_beams_are_refused() -> None:
    for old in ("section: HEB200", "section: IPE300"):
        with pytest.raises(InputError, match="angles are for braces of buildings alone"):
            building(ANGLES.replace(old, "section: L100x100x10", 1))
