"""Riveted I sections by hand, against drawn polygons, and as members of old buildings."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import ANALYSED, SMALL, building, design_of, number_of
from shapely import Polygon
from shapely.affinity import scale, translate
from shapely.geometry import box
from structuralcodes.geometry import profiles

from edesign.codes.ec3.section import SteelSection
from edesign.core.member_checks import Check
from edesign.errors import InputError
from edesign.frame.sections.own_section import own_section
from edesign.frame.sections.section_class import section_class
from edesign.project.frame.sections import CoverPlates, RivetedSection
from edesign.report.model.words import section_words
from edesign.space.extract import frame_row, project_text
from edesign.space.nonlinear.build import build_building
from edesign.space.structure.geometry import space_frame

COVERS = CoverPlates.model_construct(width=0.25, thickness=0.012)


def riveted(angles: str, covers: CoverPlates | None = COVERS, outstanding: str | None = None) -> SteelSection:
    """A web of 600 x 10 mm with angles and covers."""
    parts = {"height": 0.6, "web": 0.01, "angles": angles, "outstanding": outstanding, "covers": covers}
    return own_section("girder", RivetedSection.model_construct(**parts))


def test_by_hand() -> None:
    """L100x10 of EN 10056-1: A 19.2 cm2, I_x 177 cm4, c 2.82 cm; half a unit of its third digits is 0.3 %.

    A = 60 + 4 x 19.2 + 2 x 30 = 196.8 cm2
    I_y = 603/12 + 4 (177 + 19.2 x 27.182) + 2 (25 x 1.23/12 + 30 x 30.62) = 131640 cm4
    I_z = 60/12 + 4 (177 + 19.2 x 3.322) + 2 x 1.2 x 253/12 = 4684 cm4
    W_pl,y = 602/4 + 4 x 19.2 x 27.18 + 2 x 30 x 30.6 = 4823 cm3
    """
    found = riveted("L100x10")
    assert 1e4 * found.A == pytest.approx(196.8, rel=3e-3)
    assert 1e8 * found.I_y == pytest.approx(131640.0, rel=3e-3)
    assert 1e8 * found.I_z == pytest.approx(4684.0, rel=3e-3)
    assert 1e6 * found.W_pl_y == pytest.approx(4823.0, rel=3e-3)
    assert found.h == pytest.approx(0.624) and found.b == 0.25
    assert found.W_el_y == pytest.approx(found.I_y / 0.312)
    assert 1e4 * found.A_vz == pytest.approx(60.0)
    assert found.b * found.tf == pytest.approx(2.0 * 0.1 * 0.01 + 0.25 * 0.012)  # outstanding legs and covers


def moments(shape: Polygon) -> np.ndarray:
    """A, S_y, S_z, I_y, I_z of a polygon about the axes of the drawing, by its corners, mm."""
    y, z = np.array(shape.exterior.coords).T
    a = y[:-1] * z[1:] - y[1:] * z[:-1]
    sums = [
        a.sum() / 2.0,
        (a * (z[:-1] + z[1:])).sum() / 6.0,
        (a * (y[:-1] + y[1:])).sum() / 6.0,
        (a * (z[:-1] ** 2 + z[:-1] * z[1:] + z[1:] ** 2)).sum() / 12.0,
        (a * (y[:-1] ** 2 + y[:-1] * y[1:] + y[1:] ** 2)).sum() / 12.0,
    ]
    return np.array(sums) * np.sign(sums[0])


@pytest.mark.parametrize(
    ("angles", "outstanding", "legs"),
    [("L100x100x10", None, (100, 100)), ("L150x100x12", "long", (150, 100)), ("L150x100x12", "short", (100, 150))],
)
def test_against_drawn_sections(angles: str, outstanding: str | None, legs: tuple[int, int]) -> None:
    """The quarter of positive y and z: half web, angle and half cover, with the angle as structuralcodes draws it."""
    family = profiles.L if legs[0] == legs[1] else profiles.LI
    drawn = family(angles).polygon
    left, low, *_ = drawn.bounds
    corner = translate(drawn, -left, -low)  # legs along y and z from the heel at the origin
    if (corner.bounds[2], corner.bounds[3]) != pytest.approx(legs):
        corner = Polygon([(z, y) for y, z in corner.exterior.coords])
    assert (corner.bounds[2], corner.bounds[3]) == pytest.approx(legs)
    upper = translate(scale(corner, 1.0, -1.0, origin=(0, 0)), 5.0, 300.0)  # its back on the web and under the cover
    quarter = sum(moments(part) for part in (box(0, 0, 5, 300), upper, box(0, 300, 125, 312)))
    A, S_y, S_z, I_y, I_z = 4.0 * quarter
    found = riveted(angles, outstanding=outstanding)
    values = 1e6 * found.A, 1e9 * found.W_pl_y, 1e9 * found.W_pl_z, 1e12 * found.I_y, 1e12 * found.I_z
    assert values == pytest.approx((A, S_y, S_z, I_y, I_z), rel=1e-3)  # roundings are drawn as polygons


def test_class_part_by_part() -> None:
    """Web (600 - 200)/10 = 40; leg 100/10 = 10, class 2 of S235; cover beyond the middle of the leg 70/12 = 5.8."""
    found = section_class(riveted("L100x10"), 235e6)
    assert {of.part: round(of.slenderness, 1) for of in found.parts} == {"web": 40.0, "angle": 10.0, "cover": 5.8}
    assert found.number == 2
    assert section_class(riveted("L100x8", None), 235e6).number == 3  # 12.5 of 14


GIRDER = "sections: {GIRDER: {height: 300 mm, web: 8 mm, angles: L 60x8, covers: {width: 140 mm, thickness: 8 mm}}}\n"
OLD = SMALL.replace("section: IPE300", "section: GIRDER").replace("loads:\n", f"{GIRDER}loads:\n", 1)
OLD = OLD.replace("ductility_class: medium", "ductility_class: low").replace("q: 4}", "q: 1.5}")


def test_members_of_an_old_building() -> None:
    """M_c,Rd = W_pl f_y of class 1 or 2; shear goes through the web of 300 x 8 mm."""
    design = design_of(OLD)
    number = number_of(design.frame, "BX_1_1_1")
    member = design.members.members[design.members.kinds[number]]
    section = design.frame.section("GIRDER")
    assert member.constants.M_y_Rd == pytest.approx(section.W_pl_y * 275e6)
    assert member.constants.V_z_Rd == pytest.approx(0.3 * 0.008 * 275e6 / 3.0**0.5)
    assert np.isfinite(design.members.utilisation[number, list(Check).index(Check.M_Y)])
    assert any(note.startswith("`GIRDER`: rivet holes are not deducted") for note in design.notes)


def test_words_and_extraction() -> None:
    made = building(OLD)
    assert section_words("GIRDER", made.sections["GIRDER"]) == (
        "GIRDER: riveted I, web 300 × 8 mm, 4 L 60x8, covers 140 × 8 mm"
    )
    assert "GIRDER: {area: " in project_text(frame_row(made, space_frame(made), "X2"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("L 60x8", "L60x7", "sections.GIRDER: angles: `L60x7` is no angle of the catalogue.*E-NAME-01"),
        ("L 60x8", "IPE300", "`IPE300` is no angle.*E-NAME-01"),
        ("L 60x8", "L150x100x12", "unequal legs.*E-FRAME-01"),
        ("height: 300 mm", "height: 100 mm", "leave no web.*E-FRAME-01"),
        ("ductility_class: low", "ductility_class: medium", "riveted, whose rivets.*E-SPACE-10"),
    ],
)
def test_refused(old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        design_of(OLD.replace(old, new))


def test_fibres_are_refused() -> None:
    text = ANALYSED.replace("section: IPE300", "section: GIRDER").replace("loads:\n", f"{GIRDER}loads:\n", 1)
    with pytest.raises(InputError, match="is riveted, and its fibres are not made.*E-FRAME-02"):
        build_building(building(text))
