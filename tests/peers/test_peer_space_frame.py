"""Buildings in space side by side with OpenSeesPy: diaphragms, braces, hinges; periods and member forces."""

from __future__ import annotations

import numpy as np
import pytest
from verification.space_frames import Frame, building

ops = pytest.importorskip("openseespy.opensees")

pytestmark = pytest.mark.peer

LOWEST = 4  # of nine modes: ARPACK asks for twice as many degrees with mass


def peer_building(diaphragms: bool) -> Frame:
    """Three storeys, two by two bays; hinges about y, z or both; no springs, which the element of OpenSees lacks."""
    f = building(31, bays=(2, 2), storeys=3, diaphragms=diaphragms)
    rng = np.random.default_rng(2)
    for row in f.rows:
        row["A_y"] = row["A_z"] = 0.0  # its shear beam has no hinges
        ends = np.where(rng.uniform(size=4) < 0.25, 0.0, np.inf) if not row["axial_only"] else np.zeros(4)
        column = f.nodes[int(row["start"])][2] != f.nodes[int(row["end"])][2]
        row["ends"] = tuple(np.full(4, np.inf) if column else ends)
    return f


def build_peer(f: Frame) -> None:
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for i, (x, fixed) in enumerate(zip(f.nodes, f.fixed, strict=True)):
        ops.node(i, *map(float, x))
        if any(fixed):
            ops.fix(i, *fixed)
    for k, (x, y) in enumerate(f.masters):
        own = [i for i, floor in enumerate(f.floors) if floor == k]
        ops.node(1000 + k, float(x), float(y), float(f.nodes[own[0]][2]))
        ops.fix(1000 + k, 0, 0, 1, 1, 1, 0)
        ops.rigidDiaphragm(3, 1000 + k, *own)
    code = {(False, False): 0, (True, False): 1, (False, True): 2, (True, True): 3}
    for m, row in enumerate(f.rows):
        a, b = int(row["start"]), int(row["end"])
        if row["axial_only"]:
            ops.uniaxialMaterial("Elastic", 5000 + m, row["E"])
            ops.element("Truss", m, a, b, row["A"], 5000 + m)
            continue
        ops.geomTransf("Linear", m, *map(float, row["web"]))
        values = [float(row[name]) for name in ("A", "E", "G", "I_t", "I_y", "I_z")]
        y1, z1, y2, z2 = (value == 0.0 for value in row["ends"])
        release = ["-releasez", code[bool(z1), bool(z2)], "-releasey", code[bool(y1), bool(y2)]]
        ops.element("elasticBeamColumn", m, a, b, *values, m, *release)


def solve_peer() -> None:
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormUnbalance", 1e-6, 10)
    ops.algorithm("Linear")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    assert ops.analyze(1) == 0


@pytest.mark.parametrize("diaphragms", [True, False])
def test_static_cases(diaphragms: bool) -> None:
    """Displacements, end forces and reactions to 1e-7 of the largest: both are exact."""
    f = peer_building(diaphragms)
    model = f.model()
    rng = np.random.default_rng(3)
    nodal = np.zeros((1, len(f.nodes), 6))
    free = [i for i, fixed in enumerate(f.fixed) if not any(fixed)]
    nodal[0, free] = rng.normal(0, 1e4, (len(free), 6))
    axes = np.array([np.subtract(f.nodes[row["end"]], f.nodes[row["start"]]) for row in f.rows])
    x = axes / np.linalg.norm(axes, axis=1)[:, None]
    z = np.array([row["web"] for row in f.rows])
    uniform = np.array([np.zeros(3) if row["axial_only"] else rng.normal(0, 5e3, 3) for row in f.rows])[None]
    static = model.static(nodal, uniform)
    build_peer(f)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for i in free:
        ops.load(i, *map(float, nodal[0, i]))
    for m, row in enumerate(f.rows):
        if not row["axial_only"]:
            w = uniform[0, m]
            ops.eleLoad(
                "-ele", m, "-type", "-beamUniform", float(w @ np.cross(z[m], x[m])), float(w @ z[m]), float(w @ x[m])
            )
    solve_peer()
    u = np.array([ops.nodeDisp(i) for i in range(len(f.nodes))])
    np.testing.assert_allclose(static.displacements[0], u, atol=1e-7 * np.max(np.abs(u)))
    beams = [m for m, row in enumerate(f.rows) if not row["axial_only"]]
    forces = np.array([ops.eleResponse(m, "localForces") for m in beams])
    np.testing.assert_allclose(static.end_forces[0, beams], forces, atol=1e-7 * np.max(np.abs(forces)))
    bars = [m for m, row in enumerate(f.rows) if row["axial_only"]]
    axial = np.array([ops.eleResponse(m, "axialForce")[0] for m in bars])
    np.testing.assert_allclose(static.end_forces[0, bars, 6], axial, atol=1e-7 * np.max(np.abs(axial)))
    ops.reactions()
    supported = [i for i, fixed in enumerate(f.fixed) if all(fixed)]
    reactions = np.array([ops.nodeReaction(i) for i in supported])
    np.testing.assert_allclose(static.reactions[0, supported], reactions, atol=1e-7 * np.max(np.abs(reactions)))
    ops.wipe()


def test_modes() -> None:
    """The lowest periods to 1e-6, shapes of all nodes by their cosine to 1e-6."""
    f = peer_building(True)
    mass = np.where(np.array(f.floors) >= 0, np.random.default_rng(4).uniform(1e4, 3e4, len(f.nodes)), 0.0)
    modes = f.model().modes(mass)
    assert modes.omega.size == 9
    build_peer(f)
    # lumped at the nodes in ours; OpenSees is given the mass of each floor at its master, turned there by hand
    for k in range(len(f.masters)):
        own = np.array(f.floors) == k
        place = np.array(f.nodes)[own, :2]
        centre = mass[own] @ place / mass[own].sum()
        polar = mass[own] @ np.sum((place - centre) ** 2, axis=1)
        ops.node(2000 + k, *map(float, centre), float(f.nodes[int(np.flatnonzero(own)[0])][2]))
        ops.fix(2000 + k, 0, 0, 1, 1, 1, 0)
        ops.rigidDiaphragm(3, 1000 + k, 2000 + k)
        total = float(mass[own].sum())
        ops.mass(2000 + k, total, total, 0.0, 0.0, 0.0, float(polar))
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    squared = np.array(ops.eigen("-genBandArpack", LOWEST))
    np.testing.assert_allclose(modes.omega[:LOWEST] ** 2, squared, rtol=2e-6)
    for mode in range(LOWEST):
        u = np.array([ops.nodeEigenvector(i, mode + 1) for i in range(len(f.nodes))])
        own = modes.displacements[mode]
        cosine = np.sum(u * own) / np.linalg.norm(u) / np.linalg.norm(own)
        assert abs(cosine) == pytest.approx(1.0, abs=1e-6)
    ops.wipe()


def test_displacements_under_a_response_spectrum() -> None:
    """Gamma S_a / omega^2 phi of each mode, 1e-6 of the largest: ARPACK of the peer iterates its eigenvectors.

    OpenSees leaves out masses of nodes that follow a master, so the masters stand at the centres of mass.
    """
    f = peer_building(True)
    mass = np.where(np.array(f.floors) >= 0, np.random.default_rng(4).uniform(1e4, 3e4, len(f.nodes)), 0.0)
    floors = [np.array(f.floors) == k for k in range(len(f.masters))]
    centres = [mass[own] @ np.array(f.nodes)[own, :2] / mass[own].sum() for own in floors]
    f.masters[:] = [tuple(map(float, centre)) for centre in centres]
    modes = f.model().modes(mass)
    build_peer(f)
    for k, (own, centre) in enumerate(zip(floors, centres, strict=True)):
        total = float(mass[own].sum())
        polar = float(mass[own] @ np.sum((np.array(f.nodes)[own, :2] - centre) ** 2, axis=1))
        ops.mass(1000 + k, total, total, 0.0, 0.0, 0.0, polar)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.eigen("-genBandArpack", LOWEST)
    ops.modalProperties("-unorm")
    periods = np.linspace(0.0, 2.0 * float(modes.period[0]), 200)
    ops.timeSeries("Path", 7, "-time", *periods.tolist(), "-values", *(1.0 + np.sin(periods)).tolist())
    for direction in (0, 1):
        for mode in range(LOWEST):
            ops.responseSpectrumAnalysis(7, direction + 1, "-mode", mode + 1)
            u = np.array([ops.nodeDisp(i) for i in range(len(f.nodes))])
            S_a = np.interp(modes.period[mode], periods, 1.0 + np.sin(periods))
            own_u = modes.participation[mode, direction] * S_a / modes.omega[mode] ** 2 * modes.displacements[mode]
            np.testing.assert_allclose(own_u, u, atol=1e-6 * np.max(np.abs(u)))
    ops.wipe()
