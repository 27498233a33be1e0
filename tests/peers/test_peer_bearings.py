"""Bearings in two directions beside OpenSeesPy: a mass on one of them under a pair, the same step and method.

`elastomericBearingPlasticity` has the circle of `lead_rubber`, `singleFPBearing` that of the friction pendulum. Both go
from one step to the next by a radial return along the chord, where edesign follows the way on the circle. They differ
by the order of the step, which a smaller step shows. `elastomericBearingBoucWen` is `bouc_wen`, by the implicit Euler
method; its beta is the gamma of edesign. With a large exponent it comes close to the circle.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from edesign.core import Analysis, Channel, Elastic, LawValues, Model

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

MASS, GRAVITY = 1e5, 9.81
WEIGHT = MASS * GRAVITY
Q, K_D, Y = 60e3, 0.6e6, 5e-3
R, SLOW, FAST, RATE, SLIP = 5.0, 0.03, 0.07, 25.0, 1e-3
STIFF = K_D + Q / Y
UPRIGHT = ("-orient", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)


def pair(dt: float) -> np.ndarray:
    """Two motions that are never in phase, (2, nt) m/s2."""
    t = np.arange(0.0, 12.0 + 0.5 * dt, dt)
    x = np.sin(2 * np.pi * t / 1.7) + 0.8 * np.sin(2 * np.pi * t / 0.61 + 1.0)
    y = 0.9 * np.sin(2 * np.pi * t / 2.3 + 0.7) + 0.6 * np.sin(2 * np.pi * t / 0.43)
    return np.asarray(0.9 * np.sin(np.pi * t / 12.0) ** 2 * np.array([x, y]))


def ours(law: LawValues, dt: float) -> np.ndarray:
    """Displacements and forces along x and y, (4, nt) m and N."""
    model = Model(dimension=3)
    top = model.node("top", 0.0, 0.0, 0.0)
    model.fix(top, rx=True, ry=True, rz=True)
    model.mass(top, MASS, MASS)
    ground = model.node("ground", 0.0, 0.0, -1.0)
    model.fix(ground, **dict.fromkeys(model.degrees, True))
    model.truss("post", ground, top, model.material(Elastic(1e11)), 1.0)  # it carries the weight, and nothing sideways
    model.damper("x", law, ((1.0, top, 0),), carries=True, across=("y", ((1.0, top, 1),)))
    channels = [Channel(f"u{at}", ((1.0, "displacement", top, at),)) for at in (0, 1)]
    channels += [Channel(f"f{at}", ((1.0, "damper_force", at, 0),)) for at in (0, 1)]
    x, y = pair(dt)
    gravity = model.pattern()
    model.nodal_load(gravity, top, fz=-WEIGHT)
    analysis = Analysis(model, tolerance=1e-10)
    assert analysis.static(gravity, 1.0, 1).status == "completed"
    response = analysis.history(x, dt, channels=channels, along_y=y)
    assert response.status == "completed", response.reason
    assert response.statistics["energy_error"] < 1e-8
    return np.array([response.values[channel.name] for channel in channels])


def theirs(bearing: Callable[[], None], dt: float) -> np.ndarray:
    """The same by OpenSees."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(1, 0.0, 0.0, 0.0)
    ops.node(2, 0.0, 0.0, 0.0)
    ops.fix(1, 1, 1, 1, 1, 1, 1)
    ops.fix(2, 0, 0, 0, 1, 1, 1)
    ops.mass(2, MASS, MASS, 1e-3 * MASS, 0.0, 0.0, 0.0)
    ops.uniaxialMaterial("Elastic", 1, 1e10)
    ops.uniaxialMaterial("Elastic", 2, 1.0)
    bearing()
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(2, 0.0, 0.0, -WEIGHT, 0.0, 0.0, 0.0)
    _solve(1e-12)
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    assert ops.analyze(10) == 0
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    for at, motion in enumerate(pair(dt)):
        ops.timeSeries("Path", 2 + at, "-dt", dt, "-values", *motion)
        ops.pattern("UniformExcitation", 2 + at, 1 + at, "-accel", 2 + at)
    _solve(1e-11)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    found = []
    for step in range(pair(dt).shape[1]):
        if step and ops.analyze(1, dt) != 0:
            assert ops.analyze(10, dt / 10.0) == 0
        force = ops.eleResponse(1, "force")
        found.append([ops.nodeDisp(2, 1), ops.nodeDisp(2, 2), force[6], force[7]])
    ops.wipe()
    return np.array(found).T


def _solve(tolerance: float) -> None:
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormDispIncr", tolerance, 100)
    ops.algorithm("KrylovNewton")


ENDS = ("-P", 1, "-T", 2, "-My", 2, "-Mz", 2)


def plasticity() -> None:
    ops.element("elastomericBearingPlasticity", 1, 1, 2, STIFF, Q, K_D / STIFF, 0.0, 2.0, *ENDS, *UPRIGHT)


def bouc_wen(eta: float, beta: float, gamma: float) -> Callable[[], None]:
    """A = 1 and beta + gamma = 1, so that z reaches 1."""

    def bearing() -> None:
        words = STIFF, Q, K_D / STIFF, 0.0, 2.0, eta, gamma, beta, *ENDS, *UPRIGHT
        ops.element("elastomericBearingBoucWen", 1, 1, 2, *words)

    return bearing


def smooth(n: float, beta: float, gamma: float) -> LawValues:
    """The same with z of edesign."""
    return LawValues("bouc_wen", (Q + K_D * Y, Y, K_D / STIFF, 1.0, beta, gamma, n))


def pendulum() -> None:
    ops.frictionModel("VelDependent", 1, SLOW, FAST, RATE)
    ops.element("singleFPBearing", 1, 1, 2, 1, R, SLOW * WEIGHT / SLIP, *ENDS, *UPRIGHT, "-iter", 100, 1e-9)


LEAD = LawValues("lead_rubber", (Q, K_D, Y))
DISH = LawValues("friction_pendulum", (WEIGHT, R, SLOW, FAST, RATE, SLIP))


CASES = {
    "soft": (smooth(1.0, 0.5, 0.5), bouc_wen(1.0, 0.5, 0.5)),
    "smooth": (smooth(2.0, 0.3, 0.7), bouc_wen(2.0, 0.3, 0.7)),
    "sharp": (smooth(5.0, 0.5, 0.5), bouc_wen(5.0, 0.5, 0.5)),
    "lead": (LEAD, plasticity),
    "near": (LEAD, bouc_wen(5.0, 0.5, 0.5)),
    "dish": (DISH, pendulum),
}
COARSE, FINE = 0.005, 0.001


def apart(one: np.ndarray, other: np.ndarray) -> tuple[float, float]:
    """Root mean square of the differences over the largest resultant: of displacements, and of forces."""
    found = []
    for at in (slice(0, 2), slice(2, 4)):
        largest = np.hypot(*other[at]).max()
        found.append(float(np.sqrt(np.mean(np.sum((one[at] - other[at]) ** 2, axis=0))) / largest))
    return found[0], found[1]


@pytest.mark.parametrize(
    ("case", "moved", "force"),
    [
        ("soft", 1.5e-3, 2.5e-3),
        ("smooth", 1.5e-3, 2.5e-3),
        ("sharp", 1.5e-3, 2.5e-3),
        ("lead", 1e-3, 1.5e-3),
        ("near", 3e-3, 2e-2),
        ("dish", 2e-3, 7e-3),
    ],
)
def test_a_mass_on_a_bearing(case: str, moved: float, force: float) -> None:
    """At the smaller step; the dish of OpenSees turns, by up to (u/R)^2 of the force, and with it its friction."""
    law, bearing = CASES[case]
    mine, other = ours(law, FINE), theirs(bearing, FINE)
    assert np.hypot(*other[:2]).max() > 0.1 and np.ptp(other[:2], axis=1).min() > 0.1
    found = apart(mine, other)
    assert found[0] < moved and found[1] < force


@pytest.mark.parametrize("case", ["lead", "dish", "smooth"])
def test_larger_steps(case: str) -> None:
    """Five times the step: what edesign loses of its own answer is less than a fifth of what OpenSees loses of its."""
    law, bearing = CASES[case]
    every = round(COARSE / FINE)
    own = apart(ours(law, COARSE), ours(law, FINE)[:, ::every])
    peer = apart(theirs(bearing, COARSE), theirs(bearing, FINE)[:, ::every])
    assert own[0] < 0.2 * peer[0]
