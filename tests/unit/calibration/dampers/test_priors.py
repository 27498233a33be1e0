"""Priors and starts of every form in campaigns of several laws: finite, inside their bounds, of a sane size."""

from __future__ import annotations

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.effects import forms
from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import values_of

PROBLEMS = {
    "kelvin_voigt": problem("kelvin_voigt", 5, (20.0, 26.0, 31.0), tones=(50.0, 31.0)),
    "mgmm": problem("mgmm", 5, (20.0, 26.0, 31.0, 24.0)),
    "bouc_wen": problem("bouc_wen", 4),
    "one temperature": problem("kelvin_voigt", 3),
}


@pytest.mark.parametrize("of", PROBLEMS)
def test_starts_are_few_and_within_bounds(of):
    for form in forms(PROBLEMS[of].typical):
        parameters, starts = form.parameters(PROBLEMS[of].typical), form.starts(PROBLEMS[of].typical)
        assert 1 <= len(starts) <= 6, form.label
        for row in starts:
            assert len(row) == len(parameters), form.label
            for one, value in zip(parameters, row, strict=True):
                assert one.lower <= value <= one.upper, (form.label, one.name)
                assert abs(one.coordinate(value)) < 6.0, (form.label, one.name)


@pytest.mark.parametrize("of", PROBLEMS)
def test_labels_are_unique_and_names_are_those_of_the_list(of):
    labels = [form.label for form in forms(PROBLEMS[of].typical)]
    assert len(set(labels)) == len(labels)


def test_all_names_of_effects_are_there():
    softening = "payne mullins extremes pinching degradation ageing self_heating temperature_law"
    other = "hardening one_sided limit relaxation_branch velocity_exponent hysteresis friction play series_flexibility"
    channels = "static_offset gas_spring lag clock thermometer gain offset drift inertia hum linearity reversibility"
    expected = set(f"{softening} {other} {channels}".split())
    assert {form.name for form in forms(PROBLEMS["kelvin_voigt"].typical)} == expected


@pytest.mark.parametrize("of", PROBLEMS)
def test_draws_of_the_prior_predict_finite_forces_or_say_why_not(of):
    random, tests = np.random.default_rng(3), PROBLEMS[of]
    base = [one.centre for one in tests.base]
    for effect in tests.effects:
        draws = [values_of(effect.parameters, random.standard_normal(len(effect.parameters))) for _ in range(2)]
        assert np.all(np.isfinite(draws))
        for found in tests.model((effect,)).predict(np.array([[*base, *one] for one in draws])):
            assert isinstance(found, PredictionError) or all(np.all(np.isfinite(force)) for force in found)


@pytest.mark.parametrize("of", ["kelvin_voigt", "mgmm"])
def test_one_standard_deviation_of_a_damper_effect_is_some_tenths_of_the_force(of):
    """Of the size, the shapes as at the start where it does most: about 30 %, within a factor of ten either way."""
    tests = PROBLEMS[of]
    base = [one.centre for one in tests.base]
    (plain,) = tests.model(()).forces(np.array([base]))
    for effect in tests.effects:
        # what springs or dashpots carry alone may be little
        if not effect.linear or effect.kind != "damper" or effect.form.endswith(("_springs", "_dashpots")):
            continue
        rows = [[*base, effect.parameters[0].value(1.0), *row[1:]] for row in effect.starts]
        changes = [
            np.sqrt(np.mean(np.concatenate([(a - b) ** 2 for a, b in zip(found, plain, strict=True)])))
            for found in tests.model((effect,)).forces(np.array(rows))
            if not isinstance(found, PredictionError)
        ]
        assert 0.03 < max(changes) / tests.typical.rms < 3.0, effect.label
