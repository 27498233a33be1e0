"""Sections to choose from: families, patterns, and which of them are worth trying."""

from __future__ import annotations

import pytest

from edesign.errors import InputError
from edesign.frame.sections.section_lists import efficient, sections_of
from edesign.frame.sections.steel_section import steel_section

SQUARES = {
    "SHS40x2.5": 2.89,
    "SHS60x8": 12.5,
    "SHS100x10": 27.4,
    "SHS150x12.5": 52.7,
    "SHS200x10": 58.8,
    "SHS250x16": 115.0,
    "SHS400x20": 235.0,
}
"""kg/m of EN 10210-2, Annex B, as mills print them, to three digits."""


def test_squares_have_the_masses_of_the_standard() -> None:
    listed = {section.name: section for section in sections_of("SHS")}
    assert len(listed) == 123
    for name, mass in SQUARES.items():
        assert listed[name].mass == pytest.approx(mass, rel=4e-3), name  # half a unit of the third digit, at 115


ROUND = {
    "CHS48.3x3.2": (4.53, 11.6, 6.52),
    "CHS114.3x6.3": (21.4, 313.0, 73.6),
    "CHS168.3x8": (40.3, 1297.0, 206.0),
    "CHS244.5x10": (73.7, 5073.0, 550.0),
    "CHS323.9x16": (155.0, 18390.0, 1518.0),
    "CHS508x14.2": (220.0, 67199.0, 3463.0),
}
"""A cm2, I cm4 and W_pl cm3 of Celsius 355 CHS to EN 10210-2, as Tata Steel prints them, to three digits."""


def test_circular_sections_have_the_properties_of_the_mill() -> None:
    listed = {section.name: section for section in sections_of("CHS")}
    assert len(listed) == 147
    for name, (A, I_y, W_pl) in ROUND.items():
        of = listed[name]
        assert (1e4 * of.A, 1e8 * of.I_y, 1e6 * of.W_pl_y) == pytest.approx((A, I_y, W_pl), rel=3e-3), name


def test_names_stand_for_families_patterns_and_sections() -> None:
    assert [section.name for section in sections_of("IPE3*")] == ["IPE300", "IPE330", "IPE360"]
    assert [section.name for section in sections_of("CHS406*")][-1] == "CHS406.4x16"
    assert [section.name for section in sections_of("he 300 b")] == ["HEB300"]
    assert [section.name for section in sections_of("CHS168.3x8")] == ["CHS168.3x8"]
    assert {section.name[:3] for section in sections_of("HEB")} == {"HEB"}
    with pytest.raises(InputError, match="`HEBB`.*E-NAME-01"):
        sections_of("HEBB")
    with pytest.raises(InputError, match="`RHS` .*E-SECT-03"):
        sections_of("RHS")


def test_efficient_sections_have_no_lighter_equal() -> None:
    every = sections_of("SHS")
    kept = efficient(every)
    properties = ("I_y", "W_pl_y")  # of squares the same about both axes
    for section in every:
        lighter = [of for of in every if of.A < section.A]
        beaten = any(all(getattr(of, key) >= getattr(section, key) for key in properties) for of in lighter)
        assert beaten == (section not in kept), section.name
    assert len(efficient(sections_of("HEB"))) == len(sections_of("HEB"))
    both = efficient([steel_section("HEM300"), steel_section("HEB500")])
    assert [section.name for section in both] == ["HEB500", "HEM300"]  # stiffer about y, stiffer about z
