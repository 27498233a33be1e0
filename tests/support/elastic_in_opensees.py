"""Elastic space frames with rigid floors in OpenSeesPy, for tests that put both side by side."""

from __future__ import annotations

from typing import Any

import numpy as np

from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.model import masters


def solve_in_opensees(ops: Any, frame: SpaceFrame, properties: np.ndarray, nodal: np.ndarray) -> np.ndarray:
    """Build a frame, load its nodes, and return their displacements, (n, 6) m and rad; the model stays for more.

    Args:
        ops: the module of OpenSeesPy.
        frame: whose braces are bars; all other members deform in shear as well.
        properties: of `member_properties`.
        nodal: (n, 6) N and N m.
    """
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
    return np.array([ops.nodeDisp(i) for i in range(len(frame.node_names))])
