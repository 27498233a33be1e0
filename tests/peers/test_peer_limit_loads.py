"""Limit loads of frames in space side by side with OpenSeesPy: the same fibres and controlled displacement."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

import openseespy.opensees as ops  # noqa: E402
from verification.limit_frames import ALL, FACTOR, UP, G, LimitFrame, two_storeys  # noqa: E402

pytestmark = pytest.mark.peer

POINTS = 5
HARDENING = 1e-4  # OpenSees' element does not invert the flexibility of sections without any
GEOMETRY = {"linear": "Linear", "p_delta": "PDelta", "corotational": "Corotational"}


def in_opensees(frame: LimitFrame, geometry: str, node: int, degree: str, target: float, steps: int) -> np.ndarray:
    """Factor of the loads at the start and after each step, (steps + 1,)."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for k, place in enumerate(frame.nodes):
        ops.node(k, *place)
    for k, held in frame.held.items():
        ops.fix(k, *(int(name in held) for name in ALL))
    ops.uniaxialMaterial("Steel01", 1, frame.fy, frame.E, frame.hardening)
    tags = {name: tag for tag, name in enumerate(frame.sections, start=1)}
    for name, s in frame.sections.items():
        ops.section("Fiber", tags[name], "-GJ", G * s.I_t)
        for y, z, area in zip(s.y.tolist(), s.z.tolist(), s.area.tolist(), strict=True):
            ops.fiber(y, z, area, 1)
        ops.beamIntegration("Lobatto", tags[name], tags[name], POINTS)
    for k, (start, end, name, web) in enumerate(frame.members):
        ops.geomTransf(GEOMETRY[geometry], k, *web)
        ops.element("forceBeamColumn", k, start, end, k, tags[name], "-iter", 50, 1e-10)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for k, load in frame.loads.items():
        ops.load(k, *load.tolist(), 0.0, 0.0, 0.0)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormUnbalance", 1e-1, 60)
    ops.algorithm("Newton")
    ops.integrator("DisplacementControl", node, ALL.index(degree) + 1, target / steps)
    ops.analysis("Static")
    found = [0.0]
    for step in range(steps):
        assert ops.analyze(1) == 0, f"no equilibrium in step {step}"
        found.append(ops.getTime())
    ops.wipe()
    return np.array(found)


def vogel() -> tuple[LimitFrame, int]:
    """The six storeys of Vogel's calibration frame, standing in space and held in its plane; and a node of the roof.

    Without imperfections and residual stresses. Geometry, sections and loads as in frame_vogel_six_storey.py of
    github.com/fcarvajalbrown/Entropy-Collapse-Simulator; loads along beams stand on their quarters.
    """
    frame = LimitFrame(E=205e9, hardening=HARDENING)
    held = ("uy", "rx", "rz")
    grid = [[frame.node(6.0 * i, 0.0, 3.75 * k, held if k else ALL) for i in range(3)] for k in range(7)]
    outer = ("HEB220",) * 4 + ("HEB160",) * 2
    inner = ("HEB260",) * 3 + ("HEB240",) + ("HEB200",) * 2
    beams = ("IPE400", "IPE360", "IPE330", "IPE300", "IPE300", "IPE240")
    for k in range(1, 7):
        along = 31.7e3 if k == 6 else 49.1e3
        for i, columns in enumerate((outer, inner, outer)):
            frame.member(grid[k - 1][i], grid[k][i], columns[k - 1], (1.0, 0.0, 0.0), 2, held)
        for i in range(2):
            start, end = grid[k][i], grid[k][i + 1]
            for node in frame.member(start, end, beams[k - 1], UP, 4, held):
                frame.load(node, fz=-along * 1.5)
            for node in (start, end):
                frame.load(node, fz=-along * 0.75)
        frame.load(grid[k][0], fx=10.23e3 if k == 6 else 20.44e3)
    return frame, grid[6][0]


def both(frame: LimitFrame, roof: int, geometry: str, target: float, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Factors of edesign and of OpenSees along a push of the roof along x."""
    ours = frame.push(geometry, roof, "ux", target, steps, POINTS).values[FACTOR]
    return ours, in_opensees(frame, geometry, roof, "ux", target, steps)


def test_vogels_six_storeys() -> None:
    """The whole path in P-Delta up to the limit load and beyond it.

    2e-6 in all steps but one: there OpenSees is 4e-4 off its own smooth curve.
    """
    ours, theirs = both(*vogel(), "p_delta", 0.4, 80)
    assert 0 < ours.argmax() < 60
    assert ours.max() == pytest.approx(theirs.max(), rel=1e-6)
    assert np.sort(np.abs(ours - theirs))[-2] < 2e-6


def test_two_storeys() -> None:
    """Columns turned, forces beside the centre, P-Delta: the whole path within 1e-5, the limit load within 2e-6."""
    frame, roof = two_storeys()
    frame.hardening = HARDENING
    ours, theirs = both(frame, roof, "p_delta", 0.5, 100)
    np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-5)
    assert ours.max() == pytest.approx(theirs.max(), rel=2e-6)


def test_two_storeys_with_finite_rotations() -> None:
    """Limit loads 0.5 % apart with one member a column, 0.2 % with two: formulations that differ by the length squared.

    They are 11 % below P-Delta's: the beams turn over sideways, which has no warping to hold it. With ten times GJ both
    geometries are within 1 %.
    """
    apart = []
    for parts in (1, 2):
        frame, roof = two_storeys(parts)
        frame.hardening = HARDENING
        ours, theirs = both(frame, roof, "corotational", 0.25, 50)
        assert 0 < ours.argmax() < 49
        apart.append(abs(ours.max() / theirs.max() - 1.0))
    assert apart[0] < 6e-3
    assert apart[1] < 0.6 * apart[0]
    frame, roof = two_storeys()
    stiff = [
        frame.push(geometry, roof, "ux", 0.4, 80, torsion=10.0).values[FACTOR].max()
        for geometry in ("p_delta", "corotational")
    ]
    assert stiff[1] == pytest.approx(stiff[0], rel=0.01)
