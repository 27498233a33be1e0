"""Statics in space: reactions balance loads, members themselves, and the base of a shaken building its inertia.

Reference: Newton and Euler; loads and their places are written here by hand.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.corner_building import (
    CORNERS,
    FORCE,
    HEIGHTS,
    MASSES,
    MOMENT,
    SHARP,
    Built,
    Placing,
    building,
    motions,
)

from edesign.core import Analysis, Bilinear, Channel, Response, Steel

ELASTIC = Bilinear(2.1e11, 1e12, 0.01)
LAWS: dict[str, Steel] = {"elastic": ELASTIC, "yielding": Bilinear(2.1e11, 30e6, 0.02)}
PLACING = Placing(0.6)
PLACES = np.array([PLACING.vector((*corner, height)) for height in HEIGHTS for corner in CORNERS])


def channels(built: Built) -> list[Channel]:
    found = []
    for node in built.nodes:
        for kind in ("reaction", "total_acceleration"):
            found += [Channel(f"{kind}{node}.{d}", ((1.0, kind, node, d),)) for d in range(6)]
    for k, member in enumerate(built.members):
        for kind in ("global_force", "end_force"):
            found += [Channel(f"{kind}{k}.{c}", ((1.0, kind, member, c),)) for c in range(12)]
    return found


def of_node(r: Response, kind: str, node: int) -> np.ndarray:
    return np.array([r.values[f"{kind}{node}.{d}"] for d in range(6)])


def loads(placing: Placing) -> np.ndarray:
    """Force and moment about the origin of all loads of the building."""
    total = np.zeros(6)
    for level in (1, 2):
        top = [np.array(placing.vector((*corner, HEIGHTS[level]))) for corner in CORNERS]
        for k in range(4):
            force = np.array(placing.vector(FORCE))
            total += [*force, *(np.cross(top[k], force) + placing.turn(MOMENT))]
            along = top[(k + 1) % 4] - top[k]
            length = float(np.linalg.norm(along))
            x, z = along / length, np.array([0.0, 0.0, 1.0])
            y = np.cross(z, x)
            uniform, point = (1e3 * x + 2e3 * y - 12e3 * z) * length, -2e3 * x + 3e3 * y - 9e3 * z
            total += [*uniform, *np.cross(top[k] + 0.5 * along, uniform)]
            total += [*point, *np.cross(top[k] + 0.4 * along, point)]
    return total


@pytest.mark.parametrize("law", list(LAWS))
@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
def test_reactions_balance_loads(law: str, diaphragms: bool) -> None:
    """1e-9 of the loads: they are 1e6 N, and equilibrium is iterated to 1e-12."""
    built = building(PLACING, LAWS[law], "linear", diaphragms, spring=False, dampers=False)
    a = Analysis(built.model, **SHARP)
    r = a.static(built.pattern, 0.6 if law == "yielding" else 1.0, 4, channels(built))
    assert r.status == "completed", r.reason
    if law == "yielding":
        assert r.energy["hysteretic"][-1] > 0.0
    total = (0.6 if law == "yielding" else 1.0) * loads(PLACING)
    for node, place in zip(built.corners[0], PLACES[:4], strict=True):
        reaction = of_node(r, "reaction", node)[:, -1]
        total += [*reaction[:3], *(np.cross(place, reaction[:3]) + reaction[3:])]
    np.testing.assert_allclose(total, 0.0, atol=1e-9 * 1e6)


def test_members_balance_themselves() -> None:
    """Forces at both ends with the loads between them, in global and in local axes."""
    built = building(PLACING, LAWS["elastic"], "linear", spring=False, dampers=False)
    r = Analysis(built.model, **SHARP).static(built.pattern, 1.0, 1, channels(built))
    for k in range(8):  # columns, without loads
        f = np.array([r.final[f"global_force{k}.{c}"] for c in range(12)])
        low, high = PLACES[k], PLACES[k + 4]
        np.testing.assert_allclose(f[:3] + f[6:9], 0.0, atol=1e-3)
        np.testing.assert_allclose(f[3:6] + f[9:] + np.cross(high - low, f[6:9]), 0.0, atol=1e-3)
        q = np.array([r.final[f"end_force{k}.{c}"] for c in range(12)])
        length = high[2] - low[2]
        assert q[0] == pytest.approx(f[2]) and q[6] == pytest.approx(-q[0])  # N: local x is upwards
        assert q[4] + q[10] - q[8] * length == pytest.approx(0.0, abs=1e-3)  # M_y with V_z
        assert q[5] + q[11] + q[7] * length == pytest.approx(0.0, abs=1e-3)  # M_z with V_y


@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
def test_base_balances_inertia(diaphragms: bool) -> None:
    """Base shear, axial forces and torsion of a history without damping are those of masses times total accelerations.

    1e-7: equilibrium of a step is iterated to 1e-12 of the largest force, moments have levers.
    """
    built = building(PLACING, Bilinear(2.1e11, 235e6, 0.02), "linear", diaphragms, spring=False, dampers=False)
    a = Analysis(built.model, **SHARP)
    assert a.static(built.pattern, steps=2).status == "completed"
    ground = motions(0.01, 1.6, 9.0)
    r = a.history(ground[0], 0.01, channels=channels(built), vertical=ground[2], along_y=ground[1])
    assert r.energy["hysteretic"][-1] > 0.1 * r.energy["input"][-1]
    total = np.tile(loads(PLACING)[:, None], r.time.size)
    for node, place in zip(built.nodes, PLACES, strict=False):
        if node in built.corners[0]:
            force, moment = of_node(r, "reaction", node)[:3], of_node(r, "reaction", node)[3:]
        else:
            mass = MASSES[sum(level.index(node) for level in built.corners if node in level)]
            force, moment = -mass * of_node(r, "total_acceleration", node)[:3], np.zeros((3, r.time.size))
        total[:3] += force
        total[3:] += np.cross(place, force.T).T + moment
    np.testing.assert_allclose(total, 0.0, atol=1e-7 * 1e6)
