"""Damper laws side by side with uniaxial materials of OpenSees, driven through the same deformation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from edesign.damper.damper import Damper
from edesign.damper.laws import law

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

DT = 4e-5  # s; the materials integrate to first order in it
TIME = np.arange(0.0, 1.6, DT)
SLOW, FAST = 2 * np.pi * 0.9, 2 * np.pi * 2.1
U = 0.012 * np.sin(SLOW * TIME) * TIME + 0.003 * (1 - np.cos(FAST * TIME))
V = 0.012 * (np.sin(SLOW * TIME) + SLOW * TIME * np.cos(SLOW * TIME)) + 0.003 * FAST * np.sin(FAST * TIME)


def opensees_force(material: Sequence[object]) -> np.ndarray:
    """Force (n,) N of an OpenSees material under U: a zero-length element with an imposed end, in a transient analysis
    whose only unknown is a spring of no concern: materials take the speed from the node and the time step from the
    analysis."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for tag in (1, 2, 3):
        ops.node(tag, 0.0)
    ops.fix(1, 1)
    ops.mass(3, 1.0)
    ops.uniaxialMaterial(material[0], 1, *material[1:])
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    ops.element("zeroLength", 1, 1, 2, "-mat", 1, "-dir", 1)
    ops.element("zeroLength", 2, 1, 3, "-mat", 2, "-dir", 1)
    for tag, values in ((1, U), (2, V)):  # one more: rounding of the time may go past the end
        ops.timeSeries("Path", tag, "-dt", DT, "-values", *map(float, np.append(values, values[-1])))
    ops.pattern("MultipleSupport", 1)
    ops.groundMotion(1, "Plain", "-disp", 1, "-vel", 2)
    ops.imposedMotion(2, 1, 1)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormUnbalance", 1e-6, 20, 0)
    ops.algorithm("Linear")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    force = np.zeros_like(U)
    for i in range(1, TIME.size):
        assert ops.analyze(1, DT) == 0
        force[i] = ops.eleResponse(1, "material", 1, "stress")[0]
    ops.wipe()
    return force


def difference(name: str, parameters: dict[str, float], material: Sequence[object]) -> float:
    """Largest difference of the forces over the peak."""
    theirs = opensees_force(material)
    ours = Damper(law(name), parameters).force(TIME, U, V)
    assert np.max(np.abs(theirs)) > 1e4  # the material was moved
    return float(np.max(np.abs(ours - theirs)) / np.max(np.abs(theirs)))


@pytest.mark.parametrize("n", [1.0, 2.0, 5.0])
def test_bouc_wen(n: float) -> None:
    """BoucWen alpha ko n gamma beta Ao 0 0 0: its z is Y times ours, its gamma is our beta and the other way round."""
    fy, y, alpha, beta, gamma = 2e5, 0.004, 0.05, 0.4, 0.6
    material = ("BoucWen", alpha, fy / y, n, beta / y**n, gamma / y**n, 1.0, 0.0, 0.0, 0.0)
    parameters = {"Fy": fy, "Y": y, "alpha": alpha, "beta": beta, "gamma": gamma, "n": n}
    assert difference("bouc_wen", parameters, material) < 1e-3


@pytest.mark.parametrize("alpha", [0.3, 0.5, 1.0])
def test_viscous_damper(alpha: float) -> None:
    """ViscousDamper K Cd alpha: a spring and a power-law dashpot in series."""
    c, k = 3e5, 2e7
    assert difference("maxwell_power", {"c": c, "alpha": alpha, "k": k}, ("ViscousDamper", k, c, alpha)) < 1e-3


def test_maxwell() -> None:
    """Maxwell K C alpha L: the same element; with exponents other than 1 that material follows another equation."""
    c, k = 3e5, 2e7
    assert difference("maxwell_power", {"c": c, "alpha": 1.0, "k": k}, ("Maxwell", k, c, 1.0, 1.0)) < 1e-3


def test_elastic_plastic() -> None:
    """Steel01 Fy E b: bilinear with kinematic hardening; both are exact between the samples."""
    k, fy, b = 5e7, 2e5, 0.05
    assert difference("elastic_plastic", {"k": k, "Fy": fy, "b": b}, ("Steel01", fy, k, b)) < 1e-3


def test_oil_damper() -> None:
    """BilinearOilDamper K Cd Fr p: with a spring in series, here so stiff that it is none."""
    c, relief, p, k = 3e6, 1.2e5, 0.05, 1e12
    parameters = {"c": c, "F_r": relief, "p": p}
    assert difference("bilinear_oil", parameters, ("BilinearOilDamper", k, c, relief, p)) < 1e-3


@pytest.mark.parametrize("beta", [0.3, 0.9])
def test_self_centring(beta: float) -> None:
    """SelfCentering k1 k2 sigAct beta; both are exact between the samples."""
    k, fy, b = 5e7, 1.5e5, 0.05
    material = ("SelfCentering", k, b * k, fy, beta)
    assert difference("self_centring", {"k": k, "Fy": fy, "b": b, "beta": beta}, material) < 1e-3


def test_gap() -> None:
    """ElasticPPGap E Fy gap: one-sided, with a yield force out of reach."""
    k, gap = 4e7, 0.004
    material = ("ElasticPPGap", k, 1e12, gap, 0.0)
    assert difference("gap", {"k": k, "gap": gap, "d": 0.0, "side": 1.0}, material) < 1e-3
