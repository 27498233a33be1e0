"""An effect whose size may be nothing, as all samples tell it, is a hypothesis and no part of the model."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from damper_problems import problem

from edesign.calibration.results.fit import kept, unbounded
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.noise import Noise

NOISE = 100.0  # N


def fitted(mass: float) -> FittedModel:
    """A law with a mass and a zero of the force, fitted to tests with a zero of 300 N and so large a mass, kg."""
    tests = problem(tests=5)
    random = np.random.default_rng(3)
    made = [
        one.force + mass * one.motion.acceleration + 300.0 + NOISE * random.standard_normal(one.force.size)
        for one in tests.experiments
    ]
    tests = tests.with_experiments(
        [replace(one, force=f, channel_noise=NOISE) for one, f in zip(tests.experiments, made, strict=True)]
    )
    effects = [one for one in tests.effects if one.label in ("inertia.mass", "offset.constant")]
    start = np.array([*(one.centre for one in tests.base), *(one.starts[0][0] for one in effects)])
    model = unbounded(tests, SETTINGS).fit(tuple(effects), start, Noise.white([NOISE] * 4))
    assert model is not None
    return model


def test_a_size_that_may_be_nothing_is_taken_off_and_told() -> None:
    model = fitted(mass=0.0)
    found = kept(unbounded(model.problem, SETTINGS), model)
    assert [one.label for one in found.model.effects] == ["offset.constant"]
    ((before, index, why),) = found.dropped
    assert before is model and model.effects[index].name == "inertia"
    assert why.startswith("the 95 % interval of mass, -") and why.endswith(" kg, holds zero")


def test_sizes_that_the_tests_tell_stay() -> None:
    found = kept(unbounded(problem(), SETTINGS), fitted(mass=2000.0))
    assert {one.name for one in found.model.effects} == {"inertia", "offset"} and found.dropped == ()
