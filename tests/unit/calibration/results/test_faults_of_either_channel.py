"""Beside a linear law a gain of the force and one of the displacement are one equation, beside others not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.models import Posterior
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.noise import Noise


@pytest.mark.parametrize(("law", "alike"), [("kelvin_voigt", True), ("bouc_wen", False)])
def test_a_gain_of_the_other_channel_is_told_where_it_is_the_same_equation(law: str, alike: bool) -> None:
    """(1 + g) F(u) = F((1 + g) u) of F linear in u: g of the displacement is then -g/(1 + g)."""
    random, tests = np.random.default_rng(4), problem(law, tests=5)
    gains = [1.0, 1.12, 1.0, 1.0, 1.0]
    tests = tests.with_experiments(
        [
            replace(one, force=gain * one.force + 0.01 * one.rms_force * random.standard_normal(one.force.size))
            for one, gain in zip(tests.experiments, gains, strict=True)
        ]
    )
    effect = next(one for one in tests.effects if one.label == "gain.force_of_test_2")
    fitter = unbounded(tests, SETTINGS)
    start = np.append([one.centre for one in tests.base], 0.1)
    noise = Noise.white([0.01 * one.rms_force for one in tests.experiments[:4]])
    model = fitter.fit((effect,), start, noise)
    assert model is not None
    found = Posterior(fitter, model, (model,)).other_equations(0)
    other = "gain.displacement_of_test_2"
    assert (other in found) == alike
    if alike:
        assert found[other][0] == pytest.approx(0.5, abs=0.1)
        assert "displacement channel" in found[other][1]
