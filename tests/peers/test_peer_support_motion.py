"""A portal whose second support is reached later, beside OpenSeesPy with MultipleSupport excitation.

OpenSees computes absolute displacements, and damps by absolute velocities. Damping proportional to stiffness is the
same in both: the whole frame moving along is not damped.
"""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core import Analysis, Channel, Model, SupportMotion
from edesign.ground_motion.delayed import delayed_by, motion_at

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

H, L, E, A, I_C, I_B, MASS, DT, DELAY = 4.0, 12.0, 210e9, 1.5e-2, 2.0e-4, 3.0e-4, 40e3, 0.0025, 0.0337
A1 = 2e-3  # s, on the initial stiffness


def ground() -> np.ndarray:
    """From rest to rest, without displacement left: the second derivative of a modulated wave."""
    t = np.arange(0.0, 6.0, DT)
    p, w = np.pi / 6.0, 2.0 * np.pi / 0.8
    s, c = np.sin(p * t), np.cos(p * t)
    bump = s**4, 4.0 * p * s**3 * c, 12.0 * (p * s * c) ** 2 - 4.0 * p * p * s**4
    wave = np.sin(w * t), w * np.cos(w * t), -w * w * np.sin(w * t)
    return np.asarray(0.04 * (bump[2] * wave[0] + 2.0 * bump[1] * wave[1] + bump[0] * wave[2]))


def test_multiple_support_excitation() -> None:
    """Sway of both tops and of the late support, and the shear in the columns. Average acceleration of absolute and of
    relative displacements differs by the square of the step: 1e-4 of the largest at 5 ms, a quarter of it here."""
    theirs = of_opensees()
    m = Model()
    places = {"A0": (0.0, 0.0), "B0": (L, 0.0), "A1": (0.0, H), "B1": (L, H)}
    nodes = {name: m.node(name, *place) for name, place in places.items()}
    post, girder = m.elastic_section(E * A, E * I_C), m.elastic_section(E * A, E * I_B)
    for line in "AB":
        m.fix(nodes[f"{line}0"], True, True, True)
        m.beam_column(f"C_{line}", nodes[f"{line}0"], nodes[f"{line}1"], post, geometry="linear")
        m.mass(nodes[f"{line}1"], MASS, MASS, 0.0)
    m.beam_column("B", nodes["A1"], nodes["B1"], girder, geometry="linear")
    analysis = Analysis(m, tolerance=1e-10)
    analysis.rayleigh(0.0, A1, "initial")
    wanted = [Channel(name, ((1.0, "displacement", nodes[name], 0),)) for name in ("A1", "B1", "B0")]
    wanted += [Channel(f"V_{line}", ((1.0, "global_force", i, 3),)) for i, line in enumerate("AB")]
    late = delayed_by(ground(), DT, DELAY)
    motion = SupportMotion(nodes["B0"], "ux", (late[0], late[1], late[2]))
    response = analysis.history(ground(), DT, channels=wanted, supports=[motion])
    assert response.status == "completed", response.reason
    carried = motion_at(ground(), DT, DT * np.arange(ground().size))[0]
    for i, channel in enumerate(wanted):
        ours = response.values[channel.name][1:] + (carried[1:] if i < 3 else 0.0)
        assert np.abs(ours - theirs[:, i]).max() < 5e-5 * np.abs(theirs[:, i]).max(), channel.name


def of_opensees() -> np.ndarray:
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag, place in enumerate(((0.0, 0.0), (L, 0.0), (0.0, H), (L, H)), start=1):
        ops.node(tag, *place)
    ops.fix(1, 1, 1, 1)
    ops.fix(2, 1, 1, 1)
    for tag in (3, 4):
        ops.mass(tag, MASS, MASS, 0.0)
    ops.geomTransf("Linear", 1)
    ops.element("elasticBeamColumn", 1, 1, 3, A, E, I_C, 1)
    ops.element("elasticBeamColumn", 2, 2, 4, A, E, I_C, 1)
    ops.element("elasticBeamColumn", 3, 3, 4, A, E, I_B, 1)
    ops.rayleigh(0.0, 0.0, A1, 0.0)
    times = DT * np.arange(ground().size)
    ops.pattern("MultipleSupport", 1)
    for tag, delay in ((1, 0.0), (2, DELAY)):
        u, v, a = motion_at(ground(), DT, times - delay)
        for k, part in enumerate((u, v, a)):
            ops.timeSeries("Path", 10 * tag + k, "-dt", DT, "-values", *part)
        series = ("-disp", 10 * tag, "-vel", 10 * tag + 1, "-accel", 10 * tag + 2)
        ops.groundMotion(tag, "Plain", *series)
        ops.imposedMotion(tag, 1, tag)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-5, 20)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    rows = []
    for _ in range(ground().size - 1):
        assert ops.analyze(1, DT) == 0
        shears = [ops.eleForce(tag, 4) for tag in (1, 2)]
        rows.append([*(ops.nodeDisp(tag, 1) for tag in (3, 4, 2)), *shears])
    ops.wipe()
    return np.array(rows)
