"""Eccentric bracings in space side by side with OpenSeesPy: displacements and the forces of links and braces."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, changed, moment_frames
from elastic_in_opensees import solve_in_opensees

from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties, space_model

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
    properties = member_properties(frame, made.materials, gravity=case == "gravity")
    u = solve_in_opensees(ops, frame, properties, nodal)
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
