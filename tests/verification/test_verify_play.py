"""A brace whose pins have play: k_b dz(u - x) = F(x), where dz cuts half the play off either way.

References: scipy's Radau for laws that depend on speed; for an elastic-plastic damper the path of a spring with a gap
in series with a slider, followed in small steps by bisection.
"""

from __future__ import annotations

import numpy as np
import pytest
from damper_motions import Motion
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from edesign.core import Analysis, Channel, LawValues, Model
from edesign.core.damper import CoreDamper
from edesign.core.errors import CoreError

Array = np.ndarray
BRACE, PLAY, DURATION = 40e6, 3e-3, 1.6
MOTION = Motion(10e-3, 11, DURATION)


def cut(stretch: Array | float) -> Array | float:
    return stretch - np.clip(stretch, -0.5 * PLAY, 0.5 * PLAY)


def samples(rate: float) -> tuple[Array, Array, Array]:
    t = np.arange(round(DURATION * rate) + 1) / rate
    return t, MOTION.u(t), MOTION.v(t)


@pytest.mark.parametrize("alpha", [1.0, 0.5])
def test_dashpot_behind_play(alpha: float) -> None:
    """x' = (k_b dz(u - x) / c)^(1/alpha)."""
    c = 0.5e6 if alpha == 1.0 else 250e3

    def rate(t: float, x: Array) -> Array:
        force = BRACE * cut(MOTION.u(t) - x)
        return np.sign(force) * (np.abs(force) / c) ** (1.0 / alpha)

    fine = solve_ivp(rate, (0.0, DURATION), [0.0], "Radau", rtol=1e-8, atol=1e-12, max_step=1e-3, dense_output=True).sol
    core = CoreDamper("viscous_power", [c, alpha], BRACE, play=PLAY)
    errors = []
    for rate_of_samples in (200, 800):
        t, u, v = samples(rate_of_samples)
        expected = BRACE * cut(u - fine(t)[0])
        errors.append(np.max(np.abs(core.force(t, u, v) - expected)) / np.max(np.abs(expected)))
    # pins that close inside a step are met to first order in it, then left behind
    assert errors[0] < 0.05 and errors[1] < 0.4 * errors[0]


def test_elastic_plastic_damper_behind_play() -> None:
    k, fy, b = 50e6, 100e3, 0.03
    t, u, v = samples(1000.0)
    plastic, expected = 0.0, np.zeros_like(t)

    def own(x: float) -> float:
        force = k * (x - plastic)
        return float(np.clip(force, b * k * x - (1.0 - b) * fy, b * k * x + (1.0 - b) * fy))

    for i, total in enumerate(u):
        x = brentq(lambda x, total=total: own(x) - BRACE * cut(total - x), -0.1, 0.1, xtol=1e-15)
        expected[i] = own(x)
        plastic = x - own(x) / k
    found = CoreDamper("elastic_plastic", [k, fy, b], BRACE, play=PLAY).force(t, u, v)
    # the reference cuts turns that fall between its samples
    np.testing.assert_allclose(found, expected, atol=1e-3 * np.max(np.abs(expected)))


def test_spring_behind_play_is_a_gap() -> None:
    """Both in series: k = k_d k_b / (k_d + k_b) beyond the play; in a frame with its own deformation."""
    k = 30e6
    model = Model()
    ground, mass = model.node("ground", 0.0, 0.0), model.node("mass", 1.0, 0.0)
    model.fix(ground, True, True, True)
    model.fix(mass, False, True, True)
    model.mass(mass, 1e5)
    model.link("spring", ground, mass, (4e6, 0.0, 0.0))
    terms = ((1.0, mass, 0), (-1.0, ground, 0))
    model.damper("damper", LawValues("kelvin_voigt", (k, 0.0)), terms, BRACE, play=PLAY)
    analysis = Analysis(model, tolerance=1e-10)
    analysis.install_dampers()
    dt = 0.002
    ground_motion = 3.0 * np.sin(5.0 * np.arange(1001) * dt)
    channels = (
        Channel("u", ((1.0, "displacement", mass, 0),)),
        Channel("force", ((1.0, "damper_force", 0, 0),)),
        Channel("own", ((1.0, "damper_deformation", 0, 1),)),
    )
    found = analysis.history(ground_motion, dt, channels=channels).values
    expected = k * BRACE / (k + BRACE) * cut(found["u"])
    assert np.max(np.abs(expected)) > 50e3
    np.testing.assert_allclose(found["force"], expected, atol=1e-6 * np.max(np.abs(expected)))
    np.testing.assert_allclose(found["own"], expected / k, atol=1e-6 * np.max(np.abs(expected)) / k)


def test_play_without_a_brace_is_refused() -> None:
    with pytest.raises(CoreError, match="play = 0.003 .* brace.*E-CORE-02"):
        CoreDamper("viscous", [1e6], play=PLAY)


@pytest.mark.parametrize("law, values", [("viscous", [2e6]), ("viscous_power", [6e4, 0.5]), ("maxwell", [2e6, 0.1])])
def test_slow_steps_leave_nothing_in_a_dashpot(law: str, values: list[float]) -> None:
    """Static steps last 1e8 s: the force is that of the damper's own velocity, 5e-11 m/s."""
    t = np.arange(8) * 1e8
    force = CoreDamper(law, values, BRACE, play=PLAY).force(t, np.arange(8) * 5e-3, np.zeros(8))
    assert np.max(np.abs(force)) < 1.0
