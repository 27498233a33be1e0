"""A portal of a project on two footings, beside OpenSeesPy with zero-length springs and dashpots of the same values."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core import Channel
from edesign.project import parse_project
from edesign.study.analysis.structure import make_structure

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

H, L, DT = 3.6, 6.0, 0.005
E, A, I_C, I_B, MASS = 210e9, 1.2e-2, 2.0e-4, 3.0e-4, 25e3
TEXT = f"""\
edesign: 1
title: Portal on footings
frame:
  bays: [{L} m]
  storeys: [{H} m]
  supports: {{default: {{footing: {{soil: clay, length: 2 m, width: 1.6 m, embedment: 0.8 m, thickness: 0.7 m}}}}}}
  columns: [{{storeys: 1, section: post, material: steel}}]
  beams: [{{floors: 1, section: girder, material: steel}}]
sections:
  post: {{area: {A} m^2, inertia: {I_C} m^4}}
  girder: {{area: {A} m^2, inertia: {I_B} m^4}}
materials: {{steel: {{law: elastic, E: 210 GPa}}}}
elements: {{geometry: {{columns: linear}}}}
soils: {{clay: {{density: 1800 kg/m^3, shear_wave_velocity: 90 m/s, poisson: 0.4, damping: 5 %}}}}
masses: {{given: [{{floors: 1, mass: {MASS} kg}}]}}
analyses: [{{name: modes, kind: modal, modes: 1, state: initial}}]
"""


def ground() -> np.ndarray:
    t = np.arange(0.0, 10.0, DT)
    return np.asarray(3.0 * np.sin(2.0 * np.pi * t / 0.4) * np.sin(np.pi * t / 10.0) ** 2)


def test_history_of_a_portal_on_footings() -> None:
    """Displacement of the roof and of a base, and the rotation of the base: both programs use average acceleration."""
    structure = make_structure(parse_project(TEXT))
    frame = structure.frame
    structure.install_dampers()
    wanted = [
        Channel(name, ((1.0, "displacement", frame.nodes[node], degree),))
        for name, node, degree in (("roof", "A1", 0), ("sway", "A0", 0), ("settling", "A0", 1), ("rocking", "A0", 2))
    ]
    response = structure.analysis.history(ground(), DT, channels=wanted)
    assert response.status == "completed", response.reason
    theirs = of_opensees(frame.footings["A0"].springs)
    for i, channel in enumerate(wanted):
        ours, other = response.values[channel.name][1:], theirs[:, i]
        assert np.abs(ours - other).max() < 1e-6 * np.abs(other).max(), channel.name


def of_opensees(footing: object) -> np.ndarray:
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag, place in enumerate(((0.0, 0.0), (L, 0.0), (0.0, H), (L, H), (0.0, 0.0), (L, 0.0)), start=1):
        ops.node(tag, *place)
    for degree in range(3):
        ops.uniaxialMaterial("Elastic", 1 + degree, footing.stiffness[degree])
        ops.uniaxialMaterial("Viscous", 11 + degree, footing.dashpot[degree], 1.0)
        ops.uniaxialMaterial("Parallel", 21 + degree, 1 + degree, 11 + degree)
    for tag, (base, soil) in enumerate(((1, 5), (2, 6)), start=11):
        ops.fix(soil, 1, 1, 1)
        ops.element("zeroLength", tag, soil, base, "-mat", 21, 22, 23, "-dir", 1, 2, 6, "-doRayleigh", 0)
        ops.mass(base, footing.mass, footing.mass, *footing.inertia)
        ops.mass(base + 2, MASS, MASS, 0.0)
    ops.geomTransf("Linear", 1)
    ops.element("elasticBeamColumn", 1, 1, 3, A, E, I_C, 1)
    ops.element("elasticBeamColumn", 2, 2, 4, A, E, I_C, 1)
    ops.element("elasticBeamColumn", 3, 3, 4, A, E, I_B, 1)
    motion = ground()
    ops.timeSeries("Path", 1, "-dt", DT, "-values", *motion)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-6, 20)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    rows = []
    for _ in range(motion.size - 1):
        assert ops.analyze(1, DT) == 0
        rows.append([ops.nodeDisp(3, 1), *(ops.nodeDisp(1, degree) for degree in (1, 2, 3))])
    ops.wipe()
    return np.array(rows)
