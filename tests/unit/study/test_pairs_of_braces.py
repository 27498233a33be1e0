"""Crosses, and crosses of which one diagonal acts, pushed in one storey of pins: closed form of two bars."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.steel_section import steel_section
from edesign.project import parse_project
from edesign.project.analysis.analyses import PushoverAnalysis
from edesign.study.analysis.pushover import run_pushover

TEXT = """\
edesign: 1
title: One storey of pins
frame:
  bays: [4 m]
  storeys: [3 m]
  supports: pinned
  diaphragms: all
  columns: [{storeys: all, section: HEB200, material: stiff}]
  beams: [{floors: all, section: HEB200, material: stiff}]
  braces: [{bays: 1, storeys: 1, kind: cross, section: SHS80x5, material: S235@}]
  releases: [{columns: {lines: all, storeys: all}, ends: both}]
materials:
  S235: {law: bilinear, E: 210 GPa, fy: 235 MPa, hardening: 0.01 %}
  stiff: {law: elastic, E: 210000 GPa}
masses: {given: [{floors: all, mass: 10 t}], directions: horizontal}
elements: {geometry: {columns: linear}}
analyses: [{name: push, kind: pushover, pattern: uniform, roof_drift: 0.5 %, steps: 50}]
"""


@pytest.mark.parametrize(("compression", "acting"), [("true", 2.0), ("false", 1.0)])
def test_stiffness_and_strength_of_a_cross(compression: str, acting: float) -> None:
    """cos = 4/5, L = 5 m: k = n E A cos2 / L and V = n A f_y cos with n diagonals that act."""
    project = parse_project(TEXT.replace("@", f", compression: {compression}"), "p.yaml", BuildingSections())
    push = project.analyses[0]
    assert isinstance(push, PushoverAnalysis)
    pushed = run_pushover(project, push)
    shear = np.abs(pushed.variables["base_shear"].values)
    area = steel_section("SHS80x5").A
    # at 15 mm of drift, 2.1 times that of yielding, hardening of 1e-4 adds 1.1e-4
    assert shear[-1] == pytest.approx(acting * area * 235e6 * 0.8, rel=2e-4)
    step = 0.005 * 3.0 / 50
    elastic = acting * 210e9 * area * 0.8**2 / 5.0 * step
    # columns a thousand times as stiff as steel shorten: A 7810 mm2 over 3 m for 1470 mm2 over 5 m
    assert shear[1] - shear[0] == pytest.approx(elastic, rel=1e-3)
