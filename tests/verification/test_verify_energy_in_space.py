"""Energy balance of inelastic histories of three components, with diaphragms, dampers and loads inside members.

References: conservation of energy; works of ground motion and dampers from recorded motions, summed here.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.corner_building import (
    FORCE,
    FY,
    MASSES,
    MOMENT,
    Built,
    E,
    Placing,
    building,
    motions,
    node_channels,
    shaken,
)

from edesign.core import Bilinear, Channel, MenegottoPinto, Response, Steel

PLACING, SECONDS, SIZE = Placing(0.4), 1.6, 9.0
LAWS: dict[str, Steel] = {
    "perfect": Bilinear(E, FY, 0.0),
    "hardening": Bilinear(E, FY, 0.01),
    "curved": MenegottoPinto(E, FY, 0.01),
}


def history(
    dt: float, law: str, diaphragms: bool, damping: str, inside: bool = True
) -> tuple[Built, np.ndarray, Response]:
    built = building(PLACING, LAWS[law], diaphragms=diaphragms, inside=inside)
    ground = motions(dt, SECONDS, SIZE)
    dampers = [
        Channel(f"{kind} {k}", ((1.0, f"damper_{kind}", k, 0),))
        for k in built.dampers
        for kind in ("force", "deformation", "work")
    ]
    return built, ground, shaken(built, ground, dt, node_channels(built) + dampers, damping)


def error(r: Response) -> float:
    return float(np.abs(r.energy["residual"]).max() / np.abs(r.energy["input"]).max())


@pytest.mark.parametrize("damping", ["initial", "current"])
@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
@pytest.mark.parametrize("law", list(LAWS))
def test_balance_converges(law: str, diaphragms: bool, damping: str) -> None:
    """Trapezoidal works miss what is not linear within a step, by the square of the step: over a quarter of the step
    16 times less, but for the places in their steps where fibres begin to yield (hence 8)."""
    rough, fine = (history(dt, law, diaphragms, damping)[2] for dt in (0.01, 0.0025))
    for kind in ("damping", "hysteretic", "dampers"):
        assert fine.energy[kind][-1] > 0.02 * fine.energy["input"][-1]
    assert abs(fine.energy["p_delta"]).max() > 1e-3 * fine.energy["input"][-1]
    assert error(fine) < 1e-4
    assert error(fine) < error(rough) / 8.0


@pytest.mark.parametrize("diaphragms", [True, False], ids=["diaphragms", "flexible"])
def test_works_of_ground_and_dampers(diaphragms: bool) -> None:
    """Works of the ground on masses and of loads on nodes, from displacements of the nodes; of dampers, from force and
    deformation. Both sums are trapezoidal, so that 1e-9 of the input is rounding."""
    built, ground, r = history(0.005, "hardening", diaphragms, "initial", inside=False)
    loads = (*PLACING.vector(FORCE), *PLACING.turn(MOMENT))
    work = np.zeros(r.time.size)
    for floor in built.corners[1:]:
        for node, mass in zip(floor, MASSES, strict=True):
            for d in range(3):
                u = r.values[f"u{node}.{d}"]
                mean = 0.5 * (ground[d][1:] + ground[d][:-1])
                work[1:] -= mass * np.cumsum(mean * np.diff(u))
            for d, load in enumerate(loads):
                work += load * (r.values[f"u{node}.{d}"] - r.values[f"u{node}.{d}"][0])
    given = r.energy["input"] - r.energy["input"][0]
    np.testing.assert_allclose(given, work, rtol=0, atol=1e-9 * abs(given).max())
    for k in built.dampers:
        force, moved = r.values[f"force {k}"], r.values[f"deformation {k}"]
        done = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(moved))])
        np.testing.assert_allclose(r.values[f"work {k}"], done, rtol=0, atol=1e-10 * done[-1])
    total = np.sum([r.values[f"work {k}"] for k in built.dampers], axis=0)
    np.testing.assert_allclose(r.energy["dampers"], total, rtol=0, atol=1e-10 * total[-1])
