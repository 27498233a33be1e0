"""The laws of the foundry's program, stepped by its own rules, against edesign's laws."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from blind.laboratories.foundry.laws import ALL, draw_law, yaml_parameters
from blind.laboratories.foundry.motions import Kin, draw_motion
from blind.laboratories.foundry.response import law_force
from edesign.damper.damper import Damper
from edesign.damper.laws import law as edesign_law
from edesign.damper.parameters import read_parameters

RATE = 4000.0  # Hz, the coarsest step of the foundry's campaigns
ROUGH = {"viscous_power": 2e-3, "mgmm": 5e-4}
"""A power of the velocity begins with infinite slope: edesign has the velocity from samples, the foundry from its
spline, and they part for a step where the motion turns round."""
WRITTEN = 1e-5  # parameters are written with six digits


@pytest.mark.parametrize("law", ALL)
def test_law_against_edesign(law: str) -> None:
    """An earthquake-like motion of 27 mm at 0.7 Hz, units of the foundry: kN, mm, s."""
    rng = np.random.default_rng(11)
    w = 2.0 * np.pi * 0.7
    parameters = draw_law(law, rng, 120.0, 30.0, w)
    spline, seconds, _, _ = draw_motion("quake", rng, 30.0, 0.7, 1.25 * w * 30.0, 0.9, 1.0)
    motion = Kin(spline, np.arange(int(seconds * RATE) + 1) / RATE)
    force = law_force(law, parameters, motion)
    known = edesign_law(law)
    values = read_parameters(known, yaml.safe_load(yaml_parameters(law, parameters)))
    right = 1e-3 * Damper(known, values).force(motion.t, 1e-3 * motion.u)
    apart = np.abs(force - right)
    assert apart.max() < ROUGH.get(law, WRITTEN) * np.abs(right).max()
    assert np.sqrt(np.mean(apart**2)) < 1e-4 * np.sqrt(np.mean(right**2))
