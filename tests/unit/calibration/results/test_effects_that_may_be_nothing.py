"""An effect whose size may be nothing, as all samples show it, is a hypothesis and no part of the model."""

from __future__ import annotations

import re
from dataclasses import replace

import numpy as np
from damper_problems import problem

from edesign.calibration.results.evidence import why_dropped
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.kept import kept, validated
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.noise import Noise

NOISE = 100.0  # N


def fitted(mass: float, zero: float = 300.0) -> FittedModel:
    """A law with a mass and a zero of the force, fitted to tests with a zero, N, and a mass, kg, of these sizes."""
    tests = problem(tests=5)
    random = np.random.default_rng(3)
    made = [
        one.force + mass * one.motion.acceleration + zero + NOISE * random.standard_normal(one.force.size)
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


def test_a_size_that_may_be_nothing_is_taken_off_and_reported() -> None:
    model = fitted(mass=0.0)
    found = kept(unbounded(model.problem, SETTINGS), model)
    assert [one.label for one in found.model.effects] == ["offset.constant"]
    (one,) = found.dropped
    assert one.model is model and model.effects[one.index].name == "inertia"
    why = why_dropped(one)
    assert why.startswith("the 95 % interval of mass, 0 to ") and why.endswith(" kg, holds zero")  # none is below zero


def test_the_interval_of_a_size_is_reported_in_units_of_a_laboratory() -> None:
    model = fitted(mass=2000.0, zero=0.0)
    (one,) = kept(unbounded(model.problem, SETTINGS), model).dropped
    low, high = re.fullmatch(r"the 95 % interval of \w+, (\S+) to (\S+) kN, holds zero", why_dropped(one)).groups()  # type: ignore[union-attr]
    # noise of 0.1 kN over hundreds of samples leaves the mean of a force to far less than its own size
    assert model.effects[one.index].name == "offset" and -0.1 < float(low) < 0.0 < float(high) < 0.1


def test_sizes_that_the_tests_determine_stay() -> None:
    found = kept(unbounded(problem(), SETTINGS), fitted(mass=2000.0))
    assert {one.name for one in found.model.effects} == {"inertia", "offset"} and found.dropped == ()


def test_an_effect_that_misleads_goes_and_the_others_stay() -> None:
    """Validation tests without the mass of the tests fitted to: it is worse than no effects, the zero is not."""
    model = fitted(mass=2000.0)
    fitter = unbounded(model.problem, SETTINGS)
    sure = kept(fitter, model)

    def error(one: FittedModel) -> float:
        names = [effect.name for effect in one.effects]
        return 0.05 + 0.1 * ("inertia" in names) - 0.04 * ("offset" in names)

    for plain in (0.05, 0.2):  # worse than the law alone, or better: without the mass it is better still
        found = validated(fitter, sure, plain, 0.0, error)
        assert [one.name for one in found.model.effects] == ["offset"]
        (one,) = found.dropped
        assert one.model is model and model.effects[one.index].name == "inertia"
        assert why_dropped(one) == "with it the validation tests are predicted worse (11 %) than without it (1 %)"
    # one that is no better than none is withheld, which is reported elsewhere
    assert validated(fitter, sure, 0.001, 0.0, error).model.label == "offset.constant"
    assert validated(fitter, sure, 0.2, 0.0, lambda one: 0.1 - 0.04 * len(one.effects)).model is sure.model
    # nothing predicts noise
    assert validated(fitter, sure, 0.2, 0.15, error).model is sure.model
