"""The key `residual_stress` of project and building files: sections that have it, layers, and what is refused."""

from __future__ import annotations

import pytest
from building_examples import SMALL, building

from edesign.errors import InputError
from edesign.exchange.opensees.limits import refuse
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.space.nonlinear.build import build_building
from edesign.study.analysis.structure import make_frame

LAW = SMALL.replace("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, law: bilinear}") + "fibres: {residual_stress: eccs}\n"

PLANE = """\
edesign: 1
title: Portal
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB200, material: S275}, {storeys: all, lines: B, section: HEB200, material: S275,
             axis: weak}]
  beams: [{floors: 1, section: IPE300, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa}}
fibres: {residual_stress: eccs}
masses: {given: [{lines: all, floors: all, mass: 1 t}]}
analyses: [{name: modes, kind: modal, modes: 1}]
"""


def test_layers_of_plane_frames_are_those_of_one_depth_and_stress() -> None:
    """8 rows of flanges with 16 fibres, of which two have one stress, and 16 of a web; about z 16 rows of both."""
    project = parse_project(PLANE, "project.yaml", profiles=profile_names())
    frame = make_frame(project)
    for name, count in (("C_A_1", 8 * 8 + 16), ("C_B_1", 16 + 2 * 8), ("B_1_1", 8 * 8 + 16)):
        fibres = frame.members[name].fibres
        assert fibres is not None and len(fibres) == count
    assert {frame.model.layers(section) for section in range(3)} == {80, 32}
    with pytest.raises(InputError, match=r"fibres.residual_stress: .*not translated.*\[E-OPS-03\]"):
        refuse(project, without_dampers=False)


def test_own_sections_are_refused() -> None:
    text = PLANE.replace("section: IPE300", "section: own").replace(
        "materials:", "sections: {own: {height: 300 mm, width: 150 mm, flange: 10 mm, web: 8 mm}}\nmaterials:"
    )
    with pytest.raises(InputError, match=r"no pattern for own \[E-SECT-05\]"):
        make_frame(parse_project(text, "project.yaml", profiles=profile_names()))


def test_sections_of_buildings_have_stresses() -> None:
    frame = build_building(building(LAW))
    member = frame.members["C_A1_1"]
    assert member.fibres is not None and len(member.fibres) == 32
    assert frame.model.layers(0) == 32


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("HEB200", "SHS200x10", "there is no pattern for SHS200x10"),
        ("law: bilinear", "law: menegotto_pinto", "S275 is `menegotto_pinto`"),
        ("fy: 275 MPa", "fy: 150 MPa, hardening: 0.4", "has no room"),
    ],
)
def test_what_has_no_pattern_is_refused(old: str, new: str, said: str) -> None:
    with pytest.raises(InputError, match=r"fibres.residual_stress: .*\[E-SECT-05\]") as refused:
        build_building(building(LAW.replace(old, new)))
    assert said in str(refused.value)
