"""Angles against a mill's catalogue and the polygons of structuralcodes, and their checks written out."""

from __future__ import annotations

import math

import pytest

from edesign.codes.ec3.member import Member, Stability, Strength
from edesign.codes.trace import Trace
from edesign.errors import InputError
from edesign.frame.sections.angles import angle_names
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.section_lists import sections_of
from edesign.frame.sections.steel_section import steel_section

EQUAL = {
    "L40x40x4": (4.47, 2.42),
    "L50x50x5": (10.96, 3.77),
    "L60x60x6": (22.79, 5.42),
    "L60x60x8": (29.15, 7.09),
    "L70x70x7": (42.3, 7.38),
    "L80x80x8": (72.25, 9.63),
    "L80x80x10": (87.5, 11.9),
    "L90x90x9": (115.8, 12.2),
    "L100x100x8": (144.8, 12.2),
    "L100x100x10": (176.7, 15.0),
    "L100x100x12": (206.7, 17.8),
    "L120x120x12": (367.7, 21.6),
    "L150x150x15": (898.1, 33.8),
    "L180x180x18": (1866.0, 48.6),
    "L200x200x20": (2851.0, 59.9),
    "L200x200x24": (3331.0, 71.1),
}
"""I about an axis along a leg, cm4, and mass, kg/m: a catalogue of ArcelorMittal, Perfiles y Barras Comerciales."""
UNEQUAL = {
    "L120x80x8": 12.2,
    "L120x80x10": 15.0,
    "L120x80x12": 17.8,
    "L150x90x10": 18.2,
    "L150x90x11": 19.9,
    "L150x100x10": 19.0,
    "L150x100x12": 22.5,
    "L150x100x14": 26.1,
    "L200x100x10": 23.0,
    "L200x100x12": 27.3,
    "L200x100x14": 31.6,
}
"""Mass, kg/m, from the same tables."""
PRINCIPAL = {
    "L40x40x4": (7.09, 1.86),
    "L60x60x6": (36.1, 9.43),
    "L70x70x7": (67.1, 17.5),
    "L80x80x8": (115.0, 29.9),
    "L100x100x10": (280.0, 73.0),
}
"""I_u and I_v, cm4, of EN 10056-1 in tables of Dutch textbooks."""


@pytest.mark.parametrize("name", EQUAL)
def test_equal_legs_of_the_catalogue(name: str) -> None:
    """I to 0.5 %, the mass to the digits printed; the mean of I_u and I_v is that about an axis along a leg."""
    inertia, mass = EQUAL[name]
    found = steel_section(name)
    assert 0.5e8 * (found.I_y + found.I_z) == pytest.approx(inertia, rel=5e-3)
    assert found.mass == pytest.approx(mass, rel=5e-3)


@pytest.mark.parametrize("name", UNEQUAL)
def test_unequal_legs_of_the_catalogue(name: str) -> None:
    assert steel_section(name).mass == pytest.approx(UNEQUAL[name], rel=5e-3)


@pytest.mark.parametrize("name", PRINCIPAL)
def test_principal_axes(name: str) -> None:
    """To three digits."""
    found = steel_section(name)
    assert (1e8 * found.I_y, 1e8 * found.I_z) == pytest.approx(PRINCIPAL[name], rel=5e-3)


def test_every_angle_against_its_polygon() -> None:
    """Area, I_u and I_v within 0.05 %: the arcs of structuralcodes are polygons."""
    profiles = pytest.importorskip("structuralcodes.geometry.profiles")
    compared = 0
    for family in (profiles.L, profiles.LI):
        for name in family.profiles():
            theirs, ours = family(name), steel_section(name.rstrip("#"))
            low, high = sorted((abs(theirs.Icsi), abs(theirs.Ieta)))
            assert (1e6 * ours.A, 1e12 * ours.I_y, 1e12 * ours.I_z) == pytest.approx((theirs.A, high, low), rel=5e-4)
            compared += 1
    assert compared == len(angle_names()) == 95


def test_names() -> None:
    for written in ("L100x100x10", "l 100 x 100 x 10", "L100x10", "L 100×10"):
        assert steel_section(written).name == "L100x100x10"
    assert steel_section("L 80x120x8").name == "L120x80x8"
    names = BuildingSections()
    assert names.canonical("L100x10") is None and names.canonical_in_building("L100x10", brace=True) == "L100x100x10"
    assert "L100x100x8" in names.near("L100x100x9") and "braces of buildings alone" in names.near("L100x100x9")
    assert len(sections_of("L")) == 95 and sections_of("L100x1*")[0].kind == "L"
    with pytest.raises(InputError, match="L130x130x12"):
        sections_of("L133x133x12")


def test_classes_of_table_5_2_sheet_3() -> None:
    """h/t = (b + h) / 2t = 10: S235 class 2; S355, epsilon = 0.8136: 11.5 x 0.8136 = 9.36 < 10: class 4."""
    ten = steel_section("L100x100x10")
    assert section_class(ten, 235e6, -1.0, about_y=False).number == 2
    assert section_class(ten, 355e6, -1.0, about_y=False).number == 4
    assert section_class(ten, 355e6, 0.0, about_y=False).number == 1
    # L150x100x12 of S235: h/t = 12.5 <= 15, (150 + 100) / 24 = 10.4 <= 11.5: class 3
    assert section_class(steel_section("L150x100x12"), 235e6, -1.0, about_y=False).number == 3


def test_buckling_about_v_by_curve_b() -> None:
    """L100x100x10 of S235 over 2 m: i_v = sqrt(73.0 / 19.15) = 1.952 cm, lambda_1 = 93.91.

    lambda_v = 200 / 1.952 / 93.91 = 1.091; of one leg joined 0.35 + 0.7 x 1.091 = 1.114 (BB.1.2).
    Phi = 0.5 (1 + 0.34 (1.114 - 0.2) + 1.114^2) = 1.276; chi = 1 / (1.276 + sqrt(1.276^2 - 1.114^2)) = 0.5277.
    N_b,Rd = 0.5277 x 19.15 x 23.5 = 237.5 kN.
    """
    member = Member(steel_section("L100x100x10"), 235e6, Stability(2.0, 2.0, 0.0), 2)
    trace = Trace()
    found = Strength(member, trace).flexural("z")
    assert found.slenderness == pytest.approx(1.114, abs=1e-3)
    assert found.N_b_Rd == pytest.approx(237.5e3, rel=2e-3)
    assert {"lambda_z", "lambda_eff,v"} <= {step.symbol for step in trace.steps}
    slender = Strength(Member(member.section, 235e6, Stability(4.0, 4.0, 0.0), 2)).flexural("z")
    assert slender.slenderness == pytest.approx(400.0 / 1.952 / 93.91, rel=1e-3)  # above 1.167 its own counts


def test_nothing_but_an_axial_force() -> None:
    found = steel_section("L100x100x10")
    assert found.axial_alone and math.isnan(found.W_pl_y) and math.isnan(found.A_vz)
