"""Eccentric bracings in space side by side with OpenSeesPy: displacements and the forces of links and braces."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, changed, moment_frames

from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import masters, member_properties, space_model

ops = pytest.importorskip("openseespy.opensees")

pytestmark = pytest.mark.peer

_ALL = "frames: all, bays: all, section: SHS150x8, material: S275"
TWO_STOREYS = changed(
    moment_frames(storeys="4 m, 3.5 m"),
    (
        "materials:",
        "braces:\n"
        f"  - {{along: x, kind: chevron, link: 0.7 m, {_ALL}}}\n"
        f"  - {{along: y, storeys: 1, kind: rising, link: 0.5 m, {_ALL}}}\n"
        f"  - {{along: y, storeys: 2, kind: falling, link: 0.9 m, {_ALL}}}\n"
        "materials:",
    ),
    ("{x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}", "{x: {type: eccentric}, y: {type: eccentric}}"),
)


@pytest.mark.parametrize("case", ["along x", "along y", "gravity"])
def test_forces_and_displacements(case: str) -> None:
    """All to 1e-7 of the largest: both are exact. Braces are bars; links and beams deform in shear as well."""
    made = building(TWO_STOREYS)
    frame = space_frame(made)
    model = space_model(frame, made.materials, gravity=case == "gravity")
    nodal = np.zeros((len(frame.node_names), 6))
    if case == "gravity":
        nodal[:, 2] = -1e3 * (1.0 + np.arange(len(frame.node_names)))
    else:
        for number in range(len(frame.diaphragms)):
            nodal[np.flatnonzero(frame.node_diaphragm == number)[0], "xy".index(case[-1])] = 100e3 * (number + 1)
    found = model.static(nodal[None])
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i, (place, fixed) in enumerate(zip(frame.coordinates, frame.fixed, strict=True)):
        ops.node(i, *map(float, place))
        if fixed.any():
            ops.fix(i, *map(int, fixed))
    for k, centre in enumerate(masters(frame)):
        own = [int(i) for i in np.flatnonzero(frame.node_diaphragm == k)]
        ops.node(1000 + k, *map(float, centre), float(frame.coordinates[own[0], 2]))
        ops.fix(1000 + k, 0, 0, 1, 1, 1, 0)
        ops.rigidDiaphragm(3, 1000 + k, *own)
    properties = member_properties(frame, made.materials, gravity=case == "gravity")
    for m, (member, row) in enumerate(zip(frame.members, properties, strict=True)):
        E, G, A, A_y, A_z, I_t, I_y, I_z = map(float, row)
        if member.axial_only:
            ops.uniaxialMaterial("Elastic", m + 1, E)
            ops.element("Truss", m, member.start, member.end, A, m + 1)
        else:
            ops.geomTransf("Linear", m, *member.web)
            ops.element("ElasticTimoshenkoBeam", m, member.start, member.end, E, G, A, I_t, I_y, I_z, A_y, A_z, m)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for i, load in enumerate(nodal):
        if load.any():
            ops.load(i, *map(float, load))
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormUnbalance", 1e-6, 10)
    ops.algorithm("Linear")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    assert ops.analyze(1) == 0
    u = np.array([ops.nodeDisp(i) for i in range(len(frame.node_names))])
    np.testing.assert_allclose(found.displacements[0], u, atol=1e-7 * np.abs(u).max())
    links = [m for m, member in enumerate(frame.members) if member.link]
    braces = [m for m, member in enumerate(frame.members) if member.axial_only]
    assert len(links) == 8 and len(braces) == 12
    ends = np.array([ops.eleResponse(m, "localForces") for m in links])
    np.testing.assert_allclose(found.end_forces[0, links], ends, atol=1e-7 * np.abs(ends).max())
    N = np.array([ops.basicForce(m)[0] for m in braces])
    assert np.abs(N).max() > 10e3
    np.testing.assert_allclose(found.end_forces[0, braces, 6], N, atol=1e-7 * np.abs(N).max())
    ops.wipe()
