"""Loads inside members and a leaning column side by side with OpenSees: an elastic frame, built from its numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign import load_project
from edesign.study.run.analyses import run_analysis

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

G, E = 9.80665, 210e9
COLUMN, BEAM = (1.49e-2, 2.517e-4), (9.88e-3, 3.374e-4)  # m2, m4
X, Y = (0.0, 6.0, 14.0), (0.0, 4.0, 7.5)
LEANING = (900e3, 700e3)  # N
TEXT = """\
edesign: 1
title: Frame of two storeys
frame:
  bays: [6 m, 8 m]
  storeys: [4 m, 3.5 m]
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: all, section: beam, material: steel}]
  leaning_column: {G: [900 kN, 700 kN]}
sections:
  column: {area: 149 cm^2, inertia: 25170 cm^4}
  beam: {area: 98.8 cm^2, inertia: 33740 cm^4}
materials: {steel: {law: elastic, E: 210 GPa}}
loads:
  floors: [{floors: all, G: 4 kN/m2, width: 5 m}]
  beams:
    - {bays: 1, floors: all, points: [{at: [1/3, 2/3], G: 60 kN}]}
    - {bays: 2, floors: 1, points: [{at: 3 m, G: 200 kN}]}
    - {bays: 2, floors: 2, partial: [{start: 1/4, end: 1/2, G: 30 kN/m}]}
  columns: [{lines: C, storeys: all, G: -5 kN/m}]
masses: {from_loads: {}, directions: horizontal}
analyses:
  - {name: modes, kind: modal, modes: 2}
  - {name: gravity, kind: gravity}
"""


def opensees() -> tuple[np.ndarray, np.ndarray]:
    """Displacements (9, 3) of the nodes of the frame under gravity, floor by floor, and the two periods."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("PDelta", 1)
    ops.geomTransf("Linear", 2)
    for floor, y in enumerate(Y):
        for line, x in enumerate(X):
            ops.node(10 * floor + line, x, y)
        ops.node(10 * floor + 3, 20.0, y)
    for line in range(4):
        ops.fix(line, 1, 1, 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    weight = np.zeros((3, 3))
    for storey in (1, 2):
        for line in range(3):
            tag = 100 * storey + line
            ops.element("elasticBeamColumn", tag, 10 * storey - 10 + line, 10 * storey + line, *_section(COLUMN), 1)
        ops.eleLoad("-ele", 100 * storey + 2, "-type", "-beamUniform", 5e3)  # to the left
        for bay, width in enumerate((6.0, 8.0)):
            tag = 1000 * storey + bay
            ops.element("elasticBeamColumn", tag, 10 * storey + bay, 10 * storey + bay + 1, *_section(BEAM), 2)
            ops.eleLoad("-ele", tag, "-type", "-beamUniform", -20e3)
            weight[storey, bay : bay + 2] += 10e3 * width
        for share in (1 / 3, 2 / 3):
            ops.eleLoad("-ele", 1000 * storey, "-type", "-beamPoint", -60e3, share)
        weight[storey, :2] += 60e3
        ops.fix(10 * storey + 3, 0, 0, 1)
        ops.equalDOF(10 * storey, 10 * storey + 3, 1)
        ops.uniaxialMaterial("Elastic", storey, E)
        ops.element("corotTruss", 300 + storey, 10 * storey - 7, 10 * storey + 3, 1.0, storey)
        ops.load(10 * storey + 3, 0.0, -LEANING[storey - 1], 0.0)
        weight[storey, 0] += LEANING[storey - 1]
    ops.eleLoad("-ele", 1001, "-type", "-beamPoint", -200e3, 3.0 / 8.0)
    weight[1, 1:] += 200e3 * np.array([5.0, 3.0]) / 8.0
    ops.eleLoad("-ele", 2001, "-type", "-beamUniform", -30e3, 0.0, 0.25, 0.5)
    weight[2, 1:] += 30e3 * 2.0 * np.array([5.0, 3.0]) / 8.0
    for storey in (1, 2):
        for line in range(3):
            ops.mass(10 * storey + line, weight[storey, line] / G, 0.0, 0.0)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-13, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    assert ops.analyze(10) == 0
    moved = np.array([ops.nodeDisp(10 * floor + line) for floor in range(3) for line in range(3)])
    periods = 2.0 * np.pi / np.sqrt(np.array(ops.eigen("-fullGenLapack", 2)))
    ops.wipe()
    return moved, periods


def _section(section: tuple[float, float]) -> tuple[float, float, float]:
    area, inertia = section
    return area, E, inertia


def test_gravity_and_periods_of_a_frame(tmp_path: Path) -> None:
    """The struts of OpenSees are corotational, here P-Delta: drifts of 1e-3 make their difference 1e-6 of the drift.

    1e-5 is also what the last step of load leaves in the axial forces that OpenSees takes for the second order.
    """
    file = tmp_path / "project.yaml"
    file.write_text(TEXT)
    project = load_project(file)
    modes, gravity = (run_analysis(project, spec) for spec in project.analyses)
    moved, periods = opensees()
    for column, axis in ((0, "x"), (1, "y")):
        ours = gravity.variables[f"node_displacement_{axis}_final"].values
        np.testing.assert_allclose(ours, moved[:, column], rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(modes.variables["period"].values, periods, rtol=1e-5)
