"""Conditions of EN 1998-1:2004, 10.9.2(5) and 10.9.3(3), for isolated buildings that are reported one by one."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from edesign.codes.ec8.analysis.isolation import EquivalentLinear

MASS = 1e6
GOOD = EquivalentLinear(0.2, MASS * (2.0 * math.pi / 2.5) ** 2, 0.2, MASS, 1.26, 0.6, 0.03)
"""T_eff is 2.5 s."""


@pytest.mark.parametrize(
    ("found", "fixed_period", "said"),
    [
        (GOOD, 0.5, []),
        (replace(GOOD, stiffness_ratio=0.5, damping=0.3, restoring=0.025), 2.5 / 3.0, []),  # the limits are allowed
        (replace(GOOD, stiffness_ratio=0.42), 0.5, ["EN 1998-1, 10.9.2(5)a: K_eff is 0.42 of that at 0.2 d_dc"]),
        (replace(GOOD, damping=0.31), 0.5, ["EN 1998-1, 10.9.2(5)b: xi_eff is 31.0 %"]),
        (replace(GOOD, restoring=0.02), 0.5, ["EN 1998-1, 10.9.2(5)d: the force grows by 2.00 % of the weight"]),
        (GOOD, 1.0, ["EN 1998-1, 10.9.3(3)e: T_eff is 2.50 T_f, less than 3"]),
        (
            replace(GOOD, stiffness=MASS * (2.0 * math.pi / 3.2) ** 2),
            1.0,
            ["EN 1998-1, 10.9.3(3)e: T_eff is 3.20 s, more than 3"],
        ),
    ],
)
def test_conditions_that_are_not_met(found: EquivalentLinear, fixed_period: float, said: list[str]) -> None:
    reported = list(found.not_met(fixed_period))
    assert len(reported) == len(said) and all(one.startswith(words) for one, words in zip(reported, said, strict=True))
