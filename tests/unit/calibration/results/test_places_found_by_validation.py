"""Where effects begin that validation tests alone can show: a gain that changed between two fitted tests."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.kept import Kept, placed, validated
from edesign.calibration.results.predictions import validation_error
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.testing.measured_histories import Use
from edesign.estimation.noise import Noise

GAIN = 0.08
USES: tuple[Use, ...] = ("fit", "fit", "validate", "validate", "fit", "fit")


@pytest.mark.parametrize("first", [3, 4, 5])
def test_a_gain_that_changed_begins_where_validation_tests_say(first: int) -> None:
    """The fitted tests cannot separate these three; the validation tests would refuse a wrong one."""
    tests = problem(tests=len(USES))
    made = [
        replace(one, use=use, force=one.force * (1.0 + GAIN * (one.order + 1 >= first)))
        for one, use in zip(tests.experiments, USES, strict=True)
    ]
    tests = replace(tests, experiments=tuple(made), typical=Sizes.of(made))
    (sought,) = (one for one in tests.effects if one.label == "gain.force_from_test_3_to_5")
    values = np.array([*(one.centre for one in tests.base), GAIN])
    fitter = unbounded(tests, SETTINGS)
    model, refit = (
        fitter.fit(effects, start, Noise.white(tests.deviations))
        for effects, start in (((sought,), values), ((), values[:-1]))
    )
    assert model is not None and refit is not None

    def error(of: FittedModel) -> float:
        return validation_error(tests, of.effects, of.fit.values)

    reported = placed(model, error)
    assert reported.label == f"gain.force_from_test_{first}"
    assert reported.effects[0].data.form.numbers == range(first, len(USES) + 1)
    assert np.array_equal(reported.fit.values, model.fit.values) and reported.nrms == model.nrms
    assert error(reported) < 1e-9  # the tests have no noise; a gain of 8 % at the wrong place leaves 0.6 % of the power
    assert validated(fitter, Kept(reported), error(refit), 0.0, error).model is reported
    if first == 3:
        assert error(model) > error(refit)  # which had the effect refused


def test_what_fitted_tests_determine_is_left_as_it_is() -> None:
    tests = problem(tests=5)
    tests = replace(tests, typical=Sizes.of(tests.experiments))
    (sought,) = (one for one in tests.effects if one.label == "gain.force_from_test_3")
    values = np.array([*(one.centre for one in tests.base), GAIN])
    model = unbounded(tests, SETTINGS).fit((sought,), values, Noise.white(tests.deviations), 0)
    assert model is not None
    assert placed(model, lambda _: 1.0) is model
