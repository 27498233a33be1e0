"""The deteriorating law side by side with OpenSeesPy's IMKBilin, under the same protocols in the same run.

Outside of the protocols two things are known to differ. Where the yield strength has fallen to the residual one,
IMKBilin deteriorates on in another way. And of several reversals in one excursion without the force passing zero, it
counts the energy of the excursion each time; here each part counts once.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from verification.structures import turned_spring

from edesign.core import DeterioratingSide, DeterioratingSpring

ops = pytest.importorskip("openseespy.opensees", reason="OpenSeesPy (extra 'peers') is not installed")

pytestmark = pytest.mark.peer

K = 1.0e8
STEEL = DeterioratingSide(plastic=0.025, capping=0.16, ultimate=0.35, yield_force=5e5, capped=1.1, residual=0.4)
SLAB = DeterioratingSide(
    plastic=0.018, capping=0.12, ultimate=0.3, yield_force=3.5e5, capped=1.05, residual=0.3, rate=0.7
)
SAC = [(0.00375, 6), (0.005, 6), (0.0075, 6), (0.01, 4), (0.015, 2), (0.02, 2), (0.03, 2), (0.04, 2), (0.05, 2)]
"""Drift and number of cycles of AISC 341, K2.4b."""
NEAR_COLLAPSE = [*((0.01 * sign, 1) for sign in (1.0, -1.0, 1.0)), (0.02, 1), (0.03, 2)]
STEPS = 40


def turning_points(protocol: Sequence[tuple[float, int]]) -> np.ndarray:
    return np.array([sign * drift for drift, cycles in protocol for _ in range(cycles) for sign in (1.0, -1.0)])


def theirs(law: DeterioratingSpring, path: np.ndarray) -> np.ndarray:
    sides = [
        value
        for side in (law.positive, law.negative)
        for value in (side.plastic, side.capping, side.ultimate, side.yield_force, side.capped, side.residual)
    ]
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    rates = (law.positive.rate, law.negative.rate)
    lambdas = (E_t / law.positive.yield_force for E_t in (law.strength, law.after_capping, law.unloading))
    ops.uniaxialMaterial("IMKBilin", 1, law.stiffness, *sides, *lambdas, *law.exponents, *rates)
    ops.testUniaxialMaterial(1)
    moments = []
    for rotation in path:
        ops.setStrain(float(rotation))
        moments.append(ops.getStress())
    return np.array(moments)


@pytest.mark.parametrize("negative", [STEEL, SLAB], ids=["symmetric", "composite"])
@pytest.mark.parametrize("Lambda", [1.2, 2.0])
@pytest.mark.parametrize("protocol", [SAC, NEAR_COLLAPSE], ids=["SAC", "near collapse"])
def test_cyclic_protocols(negative: DeterioratingSide, Lambda: float, protocol: Sequence[tuple[float, int]]) -> None:
    """Moments within 1 % of yield along the path, energy within 0.5 %, while the strength is above the residual one."""
    E_t = Lambda * STEEL.yield_force
    law = DeterioratingSpring(K, STEEL, negative, E_t, E_t, 1.5 * E_t)
    path, moments, _ = turned_spring(law, turning_points(protocol), STEPS)
    peer = theirs(law, path)
    assert np.max(np.abs(peer)) > 5e5  # the peer has not refused the values
    # its step begins each reversal with the stiffness of before, ours with the one after: one step's difference
    assert np.max(np.abs(moments - peer)) < 1e-2 * STEEL.yield_force
    assert np.trapezoid(moments, path) == pytest.approx(np.trapezoid(peer, path), rel=5e-3)
