"""Intervals of a law hold its true parameters where the equation of an effect beside it is not the true one."""

from __future__ import annotations

import numpy as np
import pytest
from curve_problem import CUBIC, FIFTH, CurveProblem, effect

from edesign.calibration.results.fit import estimates, model_uncertainty, unbounded
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import uncertainty

SECOND = effect("hardening", "second", lambda p, i, u, v: p[0] * np.abs(u) * u)
SEVENTH = effect("hardening", "seventh", lambda p, i, u, v: p[0] * u**7)
FORMS = (SECOND, CUBIC, FIFTH, SEVENTH)


def nearest(power: float, seed: int) -> FittedModel:
    """The listed form that fits best a spring beside k u + c v which hardens with another power."""
    truth = effect("hardening", "true", lambda p, i, u, v: p[0] * np.abs(u) ** (power - 1.0) * u)
    problem = CurveProblem(effects=FORMS, truth=((truth, (0.4,)),), noise=0.002, seed=seed)
    fitter = unbounded(problem, SETTINGS)
    start, noise = (1.0, 0.3, 0.3), Noise.white(problem.deviations)
    found = [fitter.fit([one], np.array(start), noise) for one in FORMS]
    return fitter.reweighted(min((one for one in found if one is not None), key=lambda one: one.nrms))


def test_a_stiffness_is_held_beside_a_power_that_no_equation_has() -> None:
    """Generated here: k = 1 and powers from 1.5 to 8, none of them of the list."""
    powers, held, alone = np.random.default_rng(8).uniform(1.5, 8.0, 24), [], []
    for seed, power in enumerate(powers):
        model = nearest(power, seed)
        for to, sure in ((held, model_uncertainty(model)), (alone, uncertainty(model.fit, model.noise))):
            low, high = sure.interval(0)
            to.append(low < 1.0 < high)
    assert np.mean(held) >= 0.9
    assert np.mean(alone) < 0.7


def test_the_size_of_an_effect_is_that_of_its_own_equation() -> None:
    """Others are as large as it: where it leaves nothing to them, they leave its interval narrow."""
    model = nearest(3.0, 1)
    sure = model_uncertainty(model)
    assert model.label == CUBIC.label
    assert 0.4 == pytest.approx(model.fit.values[2], abs=sure.half_width(np.array([0.0, 0.0, 1.0])))
    assert sure.half_width(np.array([0.0, 0.0, 1.0])) < 0.005
    low, high = sure.interval(0)
    assert low < 1.0 < high and high - low < 0.006
    assert estimates(model)[0].interval == (low, high)
