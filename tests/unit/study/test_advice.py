"""What `edesign check` warns of."""

from __future__ import annotations

from pathlib import Path

import pytest
from unit.study.frames import project

from edesign import check_project

TEXT = """\
edesign: 1
title: Braced storey
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB200, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
  braces: [{bays: 1, storeys: 1, kind: cross, section: rod, material: S275}]
sections:
  rod: {rectangles: [{width: 20 mm, depth: 80 mm, centre: 0 mm}]}
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa}
masses:
  given: [{floors: all, mass: 20 t}]
damping: {kind: none}
integration: {method: newmark, time_step: 0.005 s}
records:
  pulse: {file: pulse.csv, acceleration_unit: g, time_step: 0.005 s}
analyses:
  - {name: shake, kind: history, record: pulse}
"""


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("", "", "braces of section `rod` do not buckle in the analysis"),
        (
            "rectangles: [{width: 20 mm, depth: 80 mm, centre: 0 mm}]",
            "area: 16 cm^2",
            "`D_1_1_r`, `D_1_1_f` will not yield",
        ),
        ("newmark, time_step: 0.005 s", "newmark, time_step: 0.01 s", "0.01 s is longer than that of `pulse`"),
        ("mass: 20 t", "mass: 0.1 t", "0.005 s is longer than 1/10 of the period T1 = 0.0"),
    ],
)
def test_warnings(tmp_path: Path, old: str, new: str, said: str) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    found = check_project(project(TEXT.replace(old, new) if old else TEXT, tmp_path / "project.yaml"))
    assert said in found["warnings"]


def test_dampers_without_a_design_of_members_are_told(tmp_path: Path) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    braces = "  braces: [{bays: 1, storeys: 1, kind: cross, section: rod, material: S275}]\n"
    law = "{oil: {type: viscous, parameters: {c: 50 kN*s/m}}}"
    runs = "[{kind: rising, bays: 1, storeys: all, law: oil, brace: rigid}]"
    damped = TEXT.replace(braces, "") + f"dampers: {{laws: {law}, devices: {runs}}}\n"
    said = "design: without it, histories check members under damper forces by their sections alone"
    assert said in check_project(project(damped, tmp_path / "project.yaml"))["warnings"]
    assert said not in check_project(project(damped + "design: {}\n", tmp_path / "project.yaml")).get("warnings", "")


def test_a_sound_frame_has_no_warnings(tmp_path: Path) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    braces = "  braces: [{bays: 1, storeys: 1, kind: cross, section: rod, material: S275}]\n"
    assert "warnings" not in check_project(project(TEXT.replace(braces, ""), tmp_path / "project.yaml"))


@pytest.mark.parametrize(
    ("loads", "history", "said"),
    [
        ("{floors: 1, G: 10 kN/m}", "vertical: {ratio: -0.9}", True),
        ("{floors: 1, points: [{at: [1/2], G: 10 kN}]}", "vertical: {ratio: 0.9}", True),
        ("{floors: 1, Q: 10 kN/m}", "vertical: {ratio: 0.9}", False),  # not in the gravity combination
        ("{floors: 1, G: 10 kN/m}", "scale: 1", False),
    ],
)
def test_beams_that_miss_the_vertical_motion(tmp_path: Path, loads: str, history: str, said: bool) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    text = TEXT.replace("damping:", f"loads: {{beams: [{loads}], gravity: {{G: 1, Q: 0}}}}\ndamping:")
    found = check_project(
        project(text.replace("record: pulse", f"record: pulse, {history}"), tmp_path / "project.yaml")
    )
    assert ("vertical motion does not bend `B_1_1`: masses" in found["warnings"]) == said


ELASTIC_BEAM = (
    ("section: IPE300, material: S275}]", "section: plain, material: S275}]"),
    ("sections:\n", "sections:\n  plain: {area: 53.8 cm^2, inertia: 8360 cm^4}\n"),
)
HINGE = "{M_y: 170 kN*m, theta_p: 0.02 rad, theta_pc: 0.2 rad, theta_u: 0.3 rad}"


@pytest.mark.parametrize(
    ("springs", "said"),
    [
        ("", True),
        (f"hinges: [{{beams: {{floors: all}}, parameters: {HINGE}}}]\n", False),
        ("joints: [{beams: {floors: all}, stiffness: 40 MN*m/rad, resistance: 120 kN*m}]\n", False),
        ("joints: [{beams: {floors: all}, stiffness: 40 MN*m/rad}]\n", True),
    ],
)
@pytest.mark.parametrize("braces", ["cross", "chevron"])  # of a beam that is one member, and of one that is two
def test_beams_that_yield_in_their_hinges_are_said_to_yield(
    tmp_path: Path, springs: str, said: bool, braces: str
) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    text = TEXT.replace("kind: cross", f"kind: {braces}").replace("masses:", f"{springs}masses:")
    for old, new in ELASTIC_BEAM:
        text = text.replace(old, new, 1)
    found = check_project(project(text, tmp_path / "project.yaml"))
    assert ("will not yield" in found["warnings"]) == said


def test_the_period_says_that_it_is_without_dampers(tmp_path: Path) -> None:
    (tmp_path / "pulse.csv").write_text("0\n0.1\n0.2\n0.1\n0\n-0.1\n-0.2\n-0.1\n0\n")
    laws = "dampers:\n  laws: {fluid: {type: viscous, parameters: {c: 10 kN*s/m}}}\n"
    device = "  devices: [{kind: storey, bays: 1, storeys: 1, law: fluid}]\n"
    for added, ending in (("", "under gravity"), (laws, "under gravity"), (laws + device, "without its dampers")):
        found = check_project(project(TEXT + added, tmp_path / "project.yaml"))
        assert found["period"].endswith(ending)
