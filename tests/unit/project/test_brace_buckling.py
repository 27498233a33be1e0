"""Keys of braces that buckle: what is refused, where; defaults; and that the warnings about buckling vanish."""

from __future__ import annotations

from pathlib import Path

import pytest
from messages import says

from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.struts import equivalent_camber
from edesign.project import ProjectError, parse_project
from edesign.project.project import Project
from edesign.study.analysis.buckling import slender_braces
from edesign.study.analysis.structure import make_frame

TEXT = """
edesign: 1
title: one bay
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{{storeys: all, section: HEB260, material: S355}}]
  beams: [{{floors: all, section: IPE360, material: S355}}]
  braces: [{{bays: 1, storeys: 1, kind: cross, section: {section}, material: {material}{more}}}]
sections:
  bar: {{area: 20 cm^2, inertia: 300 cm^4}}
materials:
  S355: {{law: bilinear, E: 210 GPa, fy: 355 MPa}}
  soft: {{law: elastic, E: 210 GPa}}
elements: {{integration_points: {points}}}
analyses: [{{name: gravity, kind: gravity}}]
"""


def project(buckling: str | None, section: str = "HEA140", material: str = "S355", points: int = 5) -> Project:
    more = "" if buckling is None else f", buckling: {buckling}"
    text = TEXT.format(section=section, material=material, more=more, points=points)
    return parse_project(text, Path("one.yaml"), BuildingSections())


@pytest.mark.parametrize(
    ("buckling", "key", "said"),
    [
        ("yes", "buckling", "E-VALUE-01"),
        ("{cambre: 1 %}", "buckling.cambre", "`camber` E-KEY-01"),
        ("{camber: 0}", "buckling.camber", "0.1 E-VALUE-02"),
        ("{camber: 20 %}", "buckling.camber", "0.1 E-VALUE-02"),
        ("{camber: ec2}", "buckling.camber", "`ec3` E-VALUE-03"),
        ("{axis: z}", "buckling.axis", "`strong` `weak` E-VALUE-03"),
        ("{ends: hinged}", "buckling.ends", "`pinned` `fixed` E-UNIT-02"),
        ("{ends: 5 kN/m}", "buckling.ends", "E-UNIT-02"),
        ("{elements: 3}", "buckling.elements", "E-VALUE-02"),
        ("{elements: 18}", "buckling.elements", "16 E-VALUE-02"),
        ("{fracture: {strain: 0}}", "buckling.fracture.strain", "E-VALUE-02"),
        ("{fracture: {exponent: 0.5}}", "buckling.fracture.exponent", "E-VALUE-02"),
        ("{}, compression: false", "compression", "E-KEY-03"),
    ],
)
def test_what_is_wrong_is_reported_with_its_key(buckling: str, key: str, said: str) -> None:
    with pytest.raises(ProjectError) as caught:
        project(buckling)
    (problem,) = caught.value.problems
    assert problem.keys_text == f"frame.braces[0].{key}"
    assert says(problem.message, said) and problem.mark.line == 9


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"section": "bar"}, "E-FRAME-02"),
        ({"points": 2}, r"frame.braces\[0\].buckling.*`integration_points`.*E-FRAME-02"),
        ({"material": "soft"}, r"frame.braces\[0\].buckling.fracture.*E-FRAME-02"),
    ],
)
def test_what_does_not_go_together_is_reported(options: dict[str, str | int], said: str) -> None:
    with pytest.raises(ProjectError, match=said):
        project("{fracture: {}}", **options)  # type: ignore[arg-type]


def test_beams_by_default_follow_from_the_ends() -> None:
    found = [project(text).frame.braces[0].buckling for text in ("{}", "{ends: fixed}", "{ends: fixed, elements: 4}")]
    assert [one.n_elements for one in found if one is not None] == [4, 8, 4]


def test_the_warnings_about_buckling_vanish_where_braces_buckle() -> None:
    for buckling, warnings in ((None, 1), ("{}", 0)):
        one = project(buckling)
        assert len(slender_braces(make_frame(one))) == warnings


def test_camber_of_ec3() -> None:
    """HEA 140, weak axis, curve c: i_z = 3.52 cm, W_el,z = 55.6 cm3, A = 31.4 cm2 (EN 10365)."""
    length = 5.0
    slenderness = length / 0.0352 / (3.14159265 * (210e9 / 355e6) ** 0.5)
    expected = 0.49 * (slenderness - 0.2) * 55.6e-6 / 31.4e-4 / length
    assert equivalent_camber(project("{}"), "HEA140", "S355", "weak", length) == pytest.approx(expected, rel=3e-3)
    assert equivalent_camber(project("{}"), "HEA140", "S355", "weak", 0.1) == 1e-5
