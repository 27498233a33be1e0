"""Supports of a building in space that move: together, as the ground does, and as a plate that turns.

References: the same building shaken by its ground; a storey of three unknowns in numpy.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.corner_building import E, Placing, building, motions, node_channels
from verification.test_verify_floor_torsion import CORNERS as COLUMNS
from verification.test_verify_floor_torsion import matrices, storey

from edesign.core import Analysis, Bilinear, Channel, SupportMotion

DT = 0.01


def integrated(acceleration: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and velocity from rest by the average acceleration, as Newmark's method has them, (nt,)."""
    mean = 0.5 * (acceleration[1:] + acceleration[:-1])
    v = np.concatenate([[0.0], np.cumsum(mean * DT)])
    return np.concatenate([[0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * DT)]), v


@pytest.mark.parametrize("fy", [235e6, 1e12], ids=["yielding", "elastic"])
@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
def test_all_supports_together_are_the_ground(diaphragms: bool, fy: float) -> None:
    """Relative to the base nothing changes: 1e-8 of the largest displacement, small beside the base."""
    ground = motions(DT, 1.6, 9.0)
    still = np.zeros_like(ground[0])

    def shaken(moving: bool) -> tuple[list[int], dict[str, np.ndarray]]:
        # what is joined to the ground elsewhere would feel the motion: its spring and dampers are left out
        built = building(Placing(0.4), Bilinear(E, fy, 0.01), diaphragms=diaphragms, spring=False)
        a = Analysis(built.model, tolerance=1e-12, element_tolerance=1e-24)
        assert a.static(built.pattern, steps=2).status == "completed"
        a.rayleigh(0.3, 1e-3, "initial")
        a.install_dampers()
        along = list(zip(("ux", "uy", "uz"), ground, strict=True))
        supports = [
            SupportMotion(node, degree, (*integrated(one), one)) for node in built.corners[0] for degree, one in along
        ]
        components = (still, still, still) if moving else ground
        r = a.history(
            components[0],
            DT,
            channels=node_channels(built),
            vertical=components[2],
            along_y=components[1],
            supports=supports if moving else (),
        )
        assert r.status == "completed", r.reason
        if fy < 1e9:
            assert r.energy["hysteretic"][-1] > 0.1 * r.energy["input"][-1]
        return built.corners[1] + built.corners[2], r.values

    nodes, by_ground = shaken(False)
    _, by_supports = shaken(True)
    scale = max(np.abs(by_ground[f"u{node}.{d}"]).max() for node in nodes for d in range(3))
    for node in nodes:
        for d in range(6):
            base = integrated(ground[d])[0] if d < 3 else 0.0
            np.testing.assert_allclose(
                by_supports[f"u{node}.{d}"] - base, by_ground[f"u{node}.{d}"], atol=1e-8 * scale, rtol=0
            )


def test_a_base_that_turns() -> None:
    """Feet turn as a plate about the centre of mass: M u'' + K u = -M (0, 0, theta'') of what moves beyond it."""
    stiffness, mass, centre = matrices()
    m, tops, master = storey()
    t = np.arange(200) * DT
    theta = 0.5 * np.sin(13.0 * t)
    turn = (*integrated(theta), theta)
    feet = [top - 1 for top in tops]
    supports = []
    for foot, (x, y, _web) in zip(feet, COLUMNS, strict=True):
        for degree, lever in (("ux", centre[1] - y), ("uy", x - centre[0]), ("rz", 1.0)):
            supports.append(SupportMotion(foot, degree, tuple(lever * part for part in turn)))
    a = Analysis(m, tolerance=1e-12)
    channels = [Channel(f"{d}", ((1.0, "displacement", master, d),)) for d in (0, 1, 5)]
    channels += [Channel("corner", ((1.0, "displacement", tops[2], 1),))]
    r = a.history(np.zeros_like(t), DT, channels=channels, supports=supports)
    load = -mass @ np.array([0.0, 0.0, 1.0])
    u, v, acceleration = np.zeros(3), np.zeros(3), np.linalg.solve(mass, load * theta[0])
    effective = stiffness + 4 / DT**2 * mass
    scale = np.abs(r.values["5"]).max()
    for k in range(1, t.size):
        pull = load * theta[k] + mass @ (4 / DT**2 * u + 4 / DT * v + acceleration)
        new = np.linalg.solve(effective, pull)
        rate = 2 / DT * (new - u) - v
        acceleration = 4 / DT**2 * (new - u) - 4 / DT * v - acceleration
        u, v = new, rate
        total = u + np.array([0.0, 0.0, turn[0][k]])
        for component, value in zip((0, 1, 5), total, strict=True):
            assert r.values[f"{component}"][k] == pytest.approx(value, abs=1e-8 * scale)
        lever = COLUMNS[2][0] - centre[0]
        assert r.values["corner"][k] == pytest.approx(total[1] + lever * total[2], abs=1e-8 * scale)


@pytest.mark.parametrize(("degree", "at"), [("ux", 0), ("uy", 1), ("rz", 2)])
def test_a_floor_that_a_jack_moves(degree: str, at: int) -> None:
    """Forces at the nodes of a floor whose master is held, put together about it, are a column of the stiffness."""
    stiffness, _, centre = matrices()
    m, tops, master = storey()
    m.fix(master, True, True, True)
    m.mass(tops[0], 0.0, mz=1.0)  # a history wants some mass
    a = Analysis(m)
    share = np.linspace(0.0, 1.0, 100)
    ramp = 1e-3 * share**2 * (3.0 - 2.0 * share)
    speed = 6e-3 * share * (1.0 - share) / (99 * DT)
    held = [Channel(f"{top}.{d}", ((1.0, "reaction", top, d),)) for top in tops for d in (0, 1, 5)]
    r = a.history(np.zeros(100), DT, channels=held, supports=[SupportMotion(master, degree, (ramp, speed, 0.0 * ramp))])
    force = np.zeros(3)
    for top, (x, y, _web) in zip(tops, COLUMNS, strict=True):
        fx, fy, moment = (r.final[f"{top}.{d}"] for d in (0, 1, 5))
        force += fx, fy, moment + (x - centre[0]) * fy - (y - centre[1]) * fx
    np.testing.assert_allclose(force, stiffness[:, at] * ramp[-1], rtol=0, atol=1e-9 * stiffness[2, 2] * ramp[-1])
    # the cubic between samples is followed exactly; work is trapezoidal, of what is linear: exact
    assert r.energy["input"][-1] == pytest.approx(0.5 * stiffness[at, at] * ramp[-1] ** 2, rel=1e-9)
