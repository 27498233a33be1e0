"""Resultants of two channels: their largest value, its time and its direction.

References: a mast that swings in a vertical plane, in closed form; roots of the squares of kept histories.
"""

from __future__ import annotations

from math import atan2, pi, sqrt

import numpy as np
import pytest

from edesign.core import Analysis, Channel, Model

HEIGHT, EI, MASS = 4.0, 8e6, 5e3
BESIDE = (
    Channel("u_x", ((1.0, "displacement", 1, 0),)),
    Channel("u_y", ((1.0, "displacement", 1, 1),)),
    Channel("u", beside=("u_x", "u_y")),
)


def mast(EI_y: float = EI) -> Analysis:
    """A mass on a mast of stiffness EI in x and EI_y in y."""
    m = Model(3)
    section = m.elastic_section(1e9, EI_y, EI, 1e6)
    foot, top = m.node("foot", 0.0, 0.0, 0.0), m.node("top", 0.0, 0.0, HEIGHT)
    m.fix(foot, True, True, True, uz=True, rx=True, ry=True)
    m.beam_column("mast", foot, top, section, geometry="linear", web=(1.0, 0.0, 0.0))
    m.mass(top, MASS, MASS, mz=MASS)
    return Analysis(m)


@pytest.mark.parametrize(("v_x", "v_y"), [(0.3, 0.4), (0.3, -0.4), (-0.4, 0.3), (0.0, -0.5)])
def test_free_swing(v_x: float, v_y: float) -> None:
    """A mast alike in all directions swings the way of its velocity, to v / omega after a quarter of a period."""
    a = mast()
    velocity = np.zeros(a.n_equations)
    velocity[a.equations[1, :2]] = v_x, v_y
    a.initial_velocity(velocity)
    omega = sqrt(3 * EI / HEIGHT**3 / MASS)
    steps = 50  # to three quarters of half a period
    r = a.history(np.zeros(steps + 1), 0.75 * pi / omega / steps, channels=BESIDE)
    # constant average acceleration: the period is too long by (omega dt)^2 / 12 = 2e-4; the peak is between two steps
    assert r.maximum["u"] == pytest.approx(0.5 / omega, rel=3e-4)
    assert r.time_of_maximum["u"] == pytest.approx(0.5 * pi / omega, abs=0.75 * pi / omega / steps)
    assert r.angle["u"] == pytest.approx(atan2(v_y, v_x), abs=1e-12)  # rounding: both directions are one equation


def test_roots_of_histories() -> None:
    """Extremes, angle and limit are those of the root of the kept histories, at every step."""
    t = np.arange(400) * 0.01
    ground = 3.0 * np.sin(9.0 * t) * np.exp(-t), 2.0 * np.sin(5.0 * t + 1.0)
    r = mast(0.5 * EI).history(ground[0], 0.01, channels=BESIDE, along_y=ground[1])
    root = np.hypot(r.values["u_x"], r.values["u_y"])
    at = int(np.argmax(root))
    assert np.array_equal(r.values["u"], root)
    assert (r.maximum["u"], r.time_of_maximum["u"]) == (root[at], r.time[at])
    assert (r.minimum["u"], r.final["u"]) == (root.min(), root[-1])
    assert r.angle == {"u": atan2(r.values["u_y"][at], r.values["u_x"][at])}
    thinned = mast(0.5 * EI).history(ground[0], 0.01, channels=BESIDE, every=7, along_y=ground[1])
    assert (thinned.maximum["u"], thinned.angle) == (r.maximum["u"], r.angle)
    limit = 0.7 * root[at]
    stopped = mast(0.5 * EI).history(ground[0], 0.01, channels=BESIDE, along_y=ground[1], limits={"u": limit})
    assert stopped.status == "limit"
    assert stopped.end == r.time[np.argmax(root > limit)]


def test_resultants_of_what_comes_later() -> None:
    """A resultant needs both channels before it, and has no terms of its own."""
    for wrong, message in (
        ((BESIDE[0], BESIDE[2], BESIDE[1]), "u_y, which does not come before it"),
        ((*BESIDE[:2], Channel("u", BESIDE[0].terms, beside=("u_x", "u_y"))), "has terms"),
    ):
        with pytest.raises(ValueError, match=message):
            mast().history(np.zeros(3), 0.01, channels=wrong)
