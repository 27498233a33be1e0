"""Compression beyond the buckling resistance: what is said before a run and of its result."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from unit.study.frames import project

from edesign.archive.dataset import Group
from edesign.cli.main import main
from edesign.frame.project_file import load_project
from edesign.project import ProjectError
from edesign.study.analysis.buckling import slender_braces
from edesign.study.analysis.structure import make_frame
from edesign.study.results.warnings import warnings_of
from edesign.study.run.analyses import run_analysis

BRACED = """\
edesign: 1
title: Three storeys with crosses of HEA160
frame:
  bays: [6 m, 6 m, 6 m]
  storeys: [4 m, 3.2 m, 3.2 m]
  columns: [{storeys: all, section: HEB260, material: S355}]
  beams: [{floors: all, section: IPE360, material: S355}]
  braces: [{bays: 2, storeys: all, kind: cross, section: HEA160, material: S355}]
  releases: [{beams: {bays: all, floors: all}, ends: both}]
materials:
  S355: {law: bilinear, E: 210 GPa, fy: 355 MPa, hardening: 1 %}
loads:
  beams: [{bays: all, floors: all, G: 20 kN/m, Q: 8 kN/m}]
masses: {from_loads: {G: 1.0, Q: 0.3}}
analyses:
  - {name: push, kind: pushover, pattern: first_mode, roof_drift: 2 %}
"""
EULER = np.pi**2 * 210e9 * 615.6e-8 / (6.0**2 + 4.0**2)  # N, HEA160 about its weak axis (Iz of the tables) over 7.21 m


def test_slender_braces_are_reported_before_the_run() -> None:
    """N_b,Rd lies below Euler's 245 kN, and far below the 1377 kN at which the brace yields in the analysis."""
    made = project(BRACED)
    (line,) = slender_braces(make_frame(made))
    assert "braces of section `HEA160` do not buckle in the analysis" in line and "buckling length 7.21 m" in line
    assert EULER == pytest.approx(245e3, rel=2e-3)
    braces = [bar for bar in make_frame(made).bars if bar.kind == "brace"]
    assert len(braces) == 6
    lowest = min(bar.strut.resistance for bar in braces if bar.strut is not None)
    assert 0.75 * EULER < lowest < EULER


def test_a_brace_with_a_support_at_mid_length() -> None:
    made = project(BRACED.replace("section: HEA160", "buckling_length_factor: 0.5, section: HEA160"))
    half = [bar.strut for bar in make_frame(made).bars if bar.kind == "brace"]
    assert half[0] is not None and half[0].length == pytest.approx(0.5 * np.hypot(6.0, 4.0))
    for wrong in ("0", "1e-9", "1.5"):
        with pytest.raises(ProjectError, match=r"frame.braces\[0\].buckling_length_factor.*E-VALUE-02"):
            project(BRACED.replace("section: HEA160", f"buckling_length_factor: {wrong}, section: HEA160"))


def test_stocky_braces_and_those_without_inertia() -> None:
    rod = "sections: {{rod: {{{}}}}}\nmaterials:"
    text = BRACED.replace("section: HEA160", "section: rod")
    stocky = project(text.replace("materials:", rod.format("area: 10 cm^2, inertia: 1 m^4")))
    assert slender_braces(make_frame(stocky)) == []
    unknown = project(text.replace("materials:", rod.format("area: 10 cm^2")))
    (line,) = slender_braces(make_frame(unknown))
    assert line == "braces of section `rod` cannot be judged for buckling: it has no `inertia`"


def test_the_compression_that_was_reached_is_compared() -> None:
    made = project(BRACED)
    group = run_analysis(made, made.analyses[0])
    found = {warning.kind: warning for warning in warnings_of(group)}
    assert set(found) == {"brace_buckling", "column_buckling"}
    resistance = group.variables["brace_buckling_resistance"].values
    ratio = (-group.variables["brace_axial_force_min"].values / resistance).max()
    assert found["brace_buckling"].ratio == pytest.approx(ratio) and ratio == pytest.approx(7.0, abs=0.1)
    assert found["brace_buckling"].text.startswith("3 of 6 braces of section `HEA160`: compression beyond")
    assert "D_2_1_f, 1401 kN" in found["brace_buckling"].text
    assert "1 of 12 columns of section `HEB260`" in found["column_buckling"].text


DAMPED = """\
edesign: 1
title: Storey with dampers on braces
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB200, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa}}
masses: {given: [{floors: all, mass: 20 t}]}
dampers:
  laws: {spring: {type: kelvin_voigt, parameters: {k: 20 kN/mm, c: 0 kN*s/mm}}}
  devices: [{kind: @kind@, bays: 1, storeys: 1, law: spring, brace: {section: HEA100, material: S275}}]
analyses:
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 2 %}
"""


def damped(kind: str) -> tuple[Group, float]:
    """The pushover to the right, and N_b,Rd of a brace."""
    made = project(DAMPED.replace("@kind@", kind))
    (bar,) = (bar for bar in make_frame(made, dampers=True).bars if bar.kind == "brace of a damper")
    assert bar.strut is not None and bar.name[0] == kind[0].upper().replace("C", "V")
    return run_analysis(made, made.analyses[0]), bar.strut.resistance


def test_the_braces_of_dampers_are_compared() -> None:
    """Of a chevron each brace has F / (2 cos); a rising diagonal is in tension when the frame leans to the right."""
    group, resistance = damped("chevron")
    (warning,) = (warning for warning in warnings_of(group) if warning.kind == "brace_buckling")
    force = float(group.variables["damper_force_max"].values[0]) / (2.0 * 3.0 / 5.0)
    assert warning.ratio == pytest.approx(force / resistance) and "1 of 1 braces of dampers" in warning.text
    group, resistance = damped("falling")
    (warning,) = (warning for warning in warnings_of(group) if warning.kind == "brace_buckling")
    assert warning.ratio == pytest.approx(-float(group.variables["damper_force_min"].values[0]) / resistance)
    group, _ = damped("rising")
    assert not [warning for warning in warnings_of(group) if warning.kind == "brace_buckling"]


def test_check_run_show_and_report_say_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "p.yaml"
    path.write_text(BRACED)
    assert load_project(path).title
    assert main(["check", str(path)]) == 0
    checked = capsys.readouterr().out
    assert "warnings:   braces of section `HEA160` do not buckle" in checked and checked.endswith(
        "ok, with 1 warning\n"
    )
    assert main(["run", str(path)]) == 0
    said = capsys.readouterr()
    assert "warning: braces of section `HEA160` do not buckle" in said.err
    assert "\n\nWarnings\nbraces of section `HEA160`" in said.out and "push: 3 of 6 braces" in said.out
    assert main(["show", str(path.with_suffix(".h5")), "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert len(shown["archive"]["warnings"]) == 1 and len(shown["analyses"][0]["warnings"]) == 2
    assert main(["show", str(path.with_suffix(".h5")), "--analysis", "push"]) == 0
    assert "Warnings\n" in capsys.readouterr().out
    assert main(["report", str(path.with_suffix(".h5")), "--quiet"]) == 0
    page = path.with_suffix(".html").read_text()
    assert page.count("do not buckle in the analysis") >= 2 and "3 of 6 braces" in page
