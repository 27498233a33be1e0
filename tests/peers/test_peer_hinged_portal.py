"""A portal with hinges at the ends of its beam, beside OpenSeesPy with the same springs, from a project's own builder.

Pinned bases, elastic columns, no damping; the beam bends in double curvature alone, in which n = 10 with a prismatic
beam of (n + 1) / n times E I (OpenSees) and a member that leaves out its springs (here) are the same.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import channel

from edesign.core import Analysis, Model
from edesign.frame.hinges import MemberBuilder, MemberEnd
from edesign.project.frame.hinges import HingeValues

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

H, L, E, A, I_C, I_B = 3.6, 7.0, 210e9, 1e-2, 3.0e-4, 2.3e-4  # m, Pa
MASS, N = 30e3, 10.0  # kg at each corner
VALUES = HingeValues.model_validate(
    {
        "M_y": "350 kN*m",
        "theta_p": "0.025 rad",
        "theta_pc": "0.16 rad",
        "theta_u": "0.3 rad",
        "Lambda": "0.9 rad",
    }
)


def ground() -> np.ndarray:
    t = np.arange(0.0, 12.0, 0.005)
    waves = np.sin(2.0 * np.pi * t / 0.7) + 0.6 * np.sin(2.0 * np.pi * t / 0.43 + 1.0)
    return 8.0 * waves * np.sin(np.pi * t / 12.0) ** 2


def ours() -> tuple[np.ndarray, np.ndarray]:
    """Roof displacement and moment of the left hinge over time."""
    m = Model()
    places = {"A0": (0.0, 0.0), "B0": (L, 0.0), "A1": (0.0, H), "B1": (L, H)}
    nodes = {name: m.node(name, *place) for name, place in places.items()}
    column, beam = m.elastic_section(E * A, E * I_C), m.elastic_section(E * A, E * I_B)
    builder = MemberBuilder(m, {node: places[name] for name, node in nodes.items()})
    for line in "AB":
        m.beam_column(f"C_{line}", nodes[f"{line}0"], nodes[f"{line}1"], column, geometry="linear")
        m.fix(nodes[f"{line}0"], True, True, False)
        m.mass(nodes[f"{line}1"], MASS)
    end = MemberEnd(VALUES, 0.0, N)
    built = builder.add("B", (nodes["A1"], nodes["B1"]), beam, E * I_B, 2, "linear", (False, False), (end, end))
    analysis = Analysis(m, tolerance=1e-9)
    hinge = built.springs[0][0].element
    wanted = [channel("displacement", nodes["A1"], name="u"), channel("axial_force", hinge, name="M")]
    response = analysis.history(ground(), 0.005, channels=wanted)
    assert response.status == "completed", response.reason
    return response.values["u"], response.values["M"]


def theirs() -> tuple[np.ndarray, np.ndarray]:
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag, place in enumerate(((0.0, 0.0), (L, 0.0), (0.0, H), (L, H), (0.0, H), (L, H)), start=1):
        ops.node(tag, *place)
    for tag in (1, 2):
        ops.fix(tag, 1, 1, 0)
    for outer, inner in ((3, 5), (4, 6)):
        ops.equalDOF(outer, inner, 1, 2)
        ops.mass(outer, MASS, 0.0, 0.0)
    ops.geomTransf("Linear", 1)
    for tag, (i, j) in enumerate(((1, 3), (2, 4)), start=1):
        ops.element("elasticBeamColumn", tag, i, j, A, E, I_C, 1)
    ops.element("elasticBeamColumn", 3, 5, 6, A, E, I_B * (N + 1.0) / N, 1)
    K = (N + 1.0) * 6.0 * E * I_B / L
    side = (VALUES.theta_p, VALUES.theta_pc, VALUES.theta_u, VALUES.M_y, VALUES.M_c_ratio, VALUES.M_r_ratio)
    ops.uniaxialMaterial("IMKBilin", 1, K, *side, *side, *(VALUES.Lambda,) * 3, 1.0, 1.0, 1.0, 1.0, 1.0)
    for tag, (inner, outer) in ((4, (5, 3)), (5, (6, 4))):
        ops.element("zeroLength", tag, inner, outer, "-mat", 1, "-dir", 6)
    motion = ground()
    ops.timeSeries("Path", 1, "-dt", 0.005, "-values", *motion.tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-7, 50)  # its tangents do not bring the unbalance down further
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    displacement, moment = [0.0], [0.0]
    for _ in range(motion.size - 1):
        assert ops.analyze(1, 0.005) == 0
        displacement.append(ops.nodeDisp(3, 1))
        moment.append(ops.eleForce(4)[5])
    return np.array(displacement), np.array(moment)


def test_history_of_a_portal_with_deteriorating_hinges() -> None:
    """Displacements within 0.1 % of the peak, moments within 0.1 % of M_y, over a history that takes strength away.

    The peer stops iterating at 1e-7 m.
    """
    u, M = ours()
    peer_u, peer_M = theirs()
    assert np.max(np.abs(u)) > 0.04
    assert np.max(np.abs(M[-400:])) < np.max(np.abs(M))
    assert np.max(np.abs(u - peer_u)) < 1e-3 * np.max(np.abs(peer_u))
    assert np.max(np.abs(np.abs(M) - np.abs(peer_M))) < 1e-3 * VALUES.M_y
