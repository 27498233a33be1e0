"""The coefficient method of ASCE/SEI 41-17 against results that another program printed, given its two lines.

Source: Steltic/steltic_nonlinear (2026), examples/Ex18_R3/pushover/pushover_package.json, direction X: a braced steel
frame of eight storeys, 9746 kip, S_X1 = 0.09 and 0.135 g, site class D; kip, in and g = 386.4 in/s2. Its program has
the factors of 7.4.3.3.2 and Eqs. 7-32 and 7-33; it takes P-Delta from the drift of the first storey, here as printed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import ArrayLike

from edesign.codes.asce41.target_displacement import near_fault_factor, target_displacement
from edesign.codes.capacity_curve import CapacityCurve

G = 386.4  # in/s2
WEIGHT, C_0, ALPHA_PDELTA = 9746.0, 1.4315284, -0.029792124  # kip


@dataclass(frozen=True)
class ConstantVelocity:
    """S_X1 / T, which the branch beyond T_S is."""

    S_X1: float
    label: str = "S_X1 / T"
    damping: float = 0.05
    zero_period: float = 0.0

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        return self.S_X1 / np.asarray(period, dtype=float)


@dataclass(frozen=True)
class Printed:
    """What the program gives of a level: its two lines, and what follows from them."""

    S_X1: float
    T_e: float
    K_e: float
    V_y: float
    D_y: float
    alpha_1: float
    alpha_2: float
    mu_strength: float
    d_t: float
    alpha_e: float
    mu_max: float


LEVELS = {
    "BSE-1N": Printed(
        S_X1=0.09,
        T_e=1.5875738,
        K_e=187.34325,
        V_y=349.87893,
        D_y=1.8675822,
        alpha_1=0.76500328,
        alpha_2=-0.29019824,
        mu_strength=1.5791275,
        d_t=2.0019526,
        alpha_e=-0.081873346,
        mu_max=4.7039872,
    ),
    "BSE-2N": Printed(
        S_X1=0.135,
        T_e=1.5877427,
        K_e=187.30339,
        V_y=396.51039,
        D_y=2.1169419,
        alpha_1=0.82428081,
        alpha_2=-0.29026000,
        mu_strength=2.0898998,
        d_t=3.0032484,
        alpha_e=-0.081885699,
        mu_max=5.0502706,
    ),
}


@pytest.mark.parametrize("level", LEVELS)
def test_target_and_limit_of_strength(level: str) -> None:
    """All digits that are typed here: the two lines are a curve that is its own idealisation, with a descent behind.

    The target is short of the peak, so that where the peak is does not matter; it is put at 1.5 times the target.
    """
    p = LEVELS[level]
    peak = 1.5 * p.d_t
    V_peak = p.V_y + p.alpha_1 * p.K_e * (peak - p.D_y)
    down = V_peak / (-p.alpha_2 * p.K_e)
    curve = CapacityCurve(np.array([0.0, p.D_y, peak, peak + down]), np.array([0.0, p.V_y, V_peak, 0.0]))
    factor = near_fault_factor(p.S_X1 * 9.80665)
    assert factor == 0.2
    spectrum = ConstantVelocity(p.S_X1 * G)
    found, limit = target_displacement(
        curve, p.T_e, C_0, WEIGHT / G, 8, spectrum, "D", factor, lambda first, last: ALPHA_PDELTA * p.K_e
    )
    assert (found.C_1, found.C_2, found.C_m) == (1.0, 1.0, 1.0)  # T_e is above 1 s
    assert found.T_e == pytest.approx(p.T_e, rel=1e-6)
    assert found.S_a / G == pytest.approx(p.S_X1 / p.T_e, rel=1e-6)
    assert found.ratio == pytest.approx(p.mu_strength, rel=1e-6)
    assert found.d_t == pytest.approx(p.d_t, rel=1e-6)
    assert limit.alpha_2 == pytest.approx(p.alpha_2, rel=1e-6)
    assert limit.alpha_e == pytest.approx(p.alpha_e, rel=1e-6)
    assert limit.mu_max == pytest.approx(p.mu_max, rel=1e-6)
    assert math.isclose(p.V_y / p.D_y, p.K_e, rel_tol=1e-6)
