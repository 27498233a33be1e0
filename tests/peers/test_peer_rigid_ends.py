"""Periods of frames with rigid ends side by side with OpenSees, whose transformations have joint offsets."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign import load_project
from edesign.core import Analysis, Model
from edesign.study.run.analyses import run_analysis

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

G = 9.80665
HALF_COLUMN, HALF_BEAM = 0.15, 0.225  # m
TEXT = """\
edesign: 1
title: Frame of two storeys
frame:
  bays: [6 m, 8 m]
  storeys: [4 m, 3.5 m]
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: all, section: beam, material: steel}]
sections:
  column: {area: 149 cm^2, inertia: 25170 cm^4}
  beam: {area: 98.8 cm^2, inertia: 33740 cm^4}
materials: {steel: {law: elastic, E: 210 GPa}}
loads: {nodes: [{floors: all, G: 900 kN}]}
masses: {from_loads: {}, directions: horizontal}
elements: {rigid_ends: {beams: 0.15 m, columns: 0.225 m}, geometry: {columns: GEOMETRY}}
analyses: [{name: modes, kind: modal, modes: 2}]
"""


@pytest.mark.parametrize(
    ("geometry", "transformation", "offsets", "tolerance"),
    [
        ("linear", "Linear", True, 1e-9),
        ("p_delta", "PDelta", False, 1e-6),
        ("corotational", "Corotational", False, 1e-5),
    ],
)
def test_periods_of_a_loaded_frame(
    tmp_path: Path, geometry: str, transformation: str, offsets: bool, tolerance: float
) -> None:
    """Rounding with joint offsets; 1e-6 beside members a million times as stiff; the load steps leave more.

    With P-Delta the offsets of OpenSees leave out the moment N a theta of the arms (0.14 % of the first period here).
    """
    file = tmp_path / "project.yaml"
    file.write_text(TEXT.replace("GEOMETRY", geometry))
    project = load_project(file)
    ours = run_analysis(project, project.analyses[0]).variables["period"].values
    np.testing.assert_allclose(ours, opensees(transformation, offsets), rtol=tolerance)


def opensees(transformation: str, offsets: bool) -> np.ndarray:
    """Periods under the loads; rigid ends as joint offsets, or as members a million times as stiff."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    places = {}
    for floor, y in enumerate((0.0, 4.0, 7.5)):
        for line, x in enumerate((0.0, 6.0, 14.0)):
            places[10 * floor + line] = (x, y)
            ops.node(10 * floor + line, x, y)
            if floor:
                ops.mass(10 * floor + line, 900e3 / G, 0.0, 0.0)
            else:
                ops.fix(line, 1, 1, 1)
    ops.geomTransf(transformation, 1)
    ops.geomTransf("Linear", 2)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    tags = iter(range(3, 1000))

    def member(i: int, j: int, area: float, inertia: float, kind: int, arms: tuple[float, float]) -> None:
        start, end = (np.array(places[node]) for node in (i, j))
        along = (end - start) / np.hypot(*(end - start))
        faces = start + arms[0] * along, end - arms[1] * along
        if offsets:
            own = next(tags)
            name = transformation if kind == 1 else "Linear"
            ops.geomTransf(name, own, "-jntOffset", *(faces[0] - start), *(faces[1] - end))
            ops.element("elasticBeamColumn", next(tags), i, j, area, 210e9, inertia, own)
            return
        chain = [i]
        for face, arm in zip(faces, arms, strict=True):
            if arm:
                chain.append(1000 + next(tags))
                ops.node(chain[-1], *face)
        chain.append(j)
        if not arms[0]:
            factors = [1.0, 1e6]
        else:
            factors = [1e6, 1.0, 1e6]
        for first, second, factor in zip(chain[:-1], chain[1:], factors, strict=True):
            ops.element("elasticBeamColumn", next(tags), first, second, factor * area, 210e9, factor * inertia, kind)

    for storey in (1, 2):
        for line in range(3):
            arms = (HALF_BEAM if storey > 1 else 0.0, HALF_BEAM)
            member(10 * storey - 10 + line, 10 * storey + line, 1.49e-2, 2.517e-4, 1, arms)
            ops.load(10 * storey + line, 0.0, -900e3, 0.0)
        for bay in range(2):
            member(10 * storey + bay, 10 * storey + bay + 1, 9.88e-3, 3.374e-4, 2, (HALF_COLUMN, HALF_COLUMN))
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", 1e-11, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    assert ops.analyze(10) == 0
    periods = 2.0 * np.pi / np.sqrt(np.array(ops.eigen("-fullGenLapack", 2)))
    ops.wipe()
    return periods


def test_offset_ends_in_space() -> None:
    """Periods of a bent of two columns and a beam, all of them beside their nodes, about both axes: rounding."""
    EA, EI_z, EI_y, GJ = 2e9, 8e6, 3e7, 4e6
    places = ((0.0, 0.0, 0.0), (5.0, 0.5, 0.0), (0.0, 0.0, 4.0), (5.0, 0.5, 4.0))
    members = (  # nodes, web, offsets
        (0, 2, (1.0, 0.0, 0.0), (0.3, -0.2, 0.0), (0.3, -0.2, -0.25)),
        (1, 3, (1.0, 0.0, 0.0), (-0.1, 0.2, 0.1), (-0.1, 0.2, -0.3)),
        (2, 3, (0.0, 0.0, 1.0), (0.2, 0.02, -0.3), (-0.4, -0.04, -0.3)),
    )
    model = Model(3)
    section = model.elastic_section(EA, EI_z, EI_y, GJ)
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for tag, place in enumerate(places):
        node = model.node(str(tag), *place)
        ops.node(tag, *place)
        if tag < 2:
            model.fix(node, True, True, True, uz=True, rx=True, ry=True)
            ops.fix(tag, 1, 1, 1, 1, 1, 1)
        else:
            model.mass(node, 2e4, 2e4, 1e3, mz=2e4, mrx=1e3, mry=1e3)
            ops.mass(tag, 2e4, 2e4, 2e4, 1e3, 1e3, 1e3)
    for tag, (i, j, web, at_i, at_j) in enumerate(members):
        element = model.beam_column(str(tag), i, j, section, 2, "linear", (False,) * 4, web=web)
        model.offset_ends(element, at_i, at_j)
        ops.geomTransf("Linear", tag, *web, "-jntOffset", *at_i, *at_j)
        ops.element("elasticBeamColumn", tag, i, j, EA, 1.0, 1.0, GJ, EI_y, EI_z, tag)
    theirs = 2.0 * np.pi / np.sqrt(ops.eigen("-fullGenLapack", 6))
    np.testing.assert_allclose(Analysis(model).modes(6).period, theirs, rtol=1e-9)
