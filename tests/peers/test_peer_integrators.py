"""Integrators of a numerical part, step by step beside those of OpenSeesPy."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest

from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.recursion import recursion

if importlib.util.find_spec("openseespy") is None:
    pytest.skip("OpenSeesPy (extra 'peers') is not installed", allow_module_level=True)

pytestmark = pytest.mark.peer

STEP, STEPS = 0.02, 200  # s; omega dt of the highest mode is 0.6
MASSES = (3.0, 2.0, 1.0)  # t
STIFFNESSES = (900.0, 700.0, 400.0)  # kN/m
MASS_FACTOR, STIFFNESS_FACTOR = 0.4, 0.002  # 1/s, s
RHO = 0.75
ALPHA = 1.0 - (1.0 - RHO) / (1.0 + RHO)
"""OpenSees' alpha is 1 + that of Hilber."""


@pytest.fixture
def ground() -> np.ndarray:
    """Noise that jumps from sample to sample, so that an instant too early or too late is seen."""
    values = np.random.default_rng(1).standard_normal(STEPS + 1)
    values[0] = 0.0
    return values


def shear_building() -> LinearPart:
    mass = np.diag(MASSES)
    lower, middle, upper = STIFFNESSES
    stiffness = np.array([[lower + middle, -middle, 0.0], [-middle, middle + upper, -upper], [0.0, -upper, upper]])
    damping = MASS_FACTOR * mass + STIFFNESS_FACTOR * stiffness
    return LinearPart(mass, damping, stiffness, np.ones(3), np.array([1.0, 0.0, 0.0]), ("1", "2", "3"))


def displacements(method: str, ground: np.ndarray) -> np.ndarray:
    """Of the floors at the ends of steps, (STEPS, 3)."""
    step = recursion(shear_building(), STEP, method, "held", rho=RHO)
    state = np.zeros(step.A.shape[0])
    found = []
    for now, ahead in zip(ground[:-1], ground[1:], strict=True):
        known = np.array([0.0, 0.0, now, ahead])
        found.append((step.C @ state + step.D @ known)[3:])
        state = step.A @ state + step.B @ known
    return np.array(found)


def peer_displacements(integrator: tuple[object, ...], ground: np.ndarray) -> np.ndarray:
    """The same of OpenSeesPy."""
    import openseespy.opensees as ops

    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in range(4):
        ops.node(node, 0.0)
    ops.fix(0, 1)
    for floor, (mass, stiffness) in enumerate(zip(MASSES, STIFFNESSES, strict=True), start=1):
        ops.mass(floor, mass)
        ops.uniaxialMaterial("Elastic", floor, stiffness)
        ops.element("zeroLength", floor, floor - 1, floor, "-mat", floor, "-dir", 1, "-doRayleigh", 1)
    ops.rayleigh(MASS_FACTOR, 0.0, STIFFNESS_FACTOR, 0.0)
    ops.timeSeries("Path", 1, "-dt", STEP, "-values", *ground)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm("Linear")
    ops.integrator(*integrator)
    ops.analysis("Transient")
    found = []
    for _ in range(STEPS):
        assert ops.analyze(1, STEP) == 0
        found.append([ops.nodeDisp(floor, 1) for floor in (1, 2, 3)])
    ops.wipe()
    return np.array(found)


@pytest.mark.parametrize(
    ("method", "integrator"),
    [
        ("newmark_explicit", ("NewmarkExplicit", 0.5)),
        ("central_difference", ("CentralDifference",)),
        ("kr_alpha", ("KRAlphaExplicit", RHO)),
        ("alpha_os", ("AlphaOS", ALPHA)),
    ],
)
def test_displacements(method: str, integrator: tuple[object, ...], ground: np.ndarray) -> None:
    """Equal but for rounding, which 200 steps add up to some 1e-14."""
    peer = peer_displacements(integrator, ground)
    assert np.max(np.abs(displacements(method, ground) - peer)) < 1e-12 * np.max(np.abs(peer))
