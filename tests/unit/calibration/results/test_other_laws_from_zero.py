"""Another law is asked for where the declared one ends with a parameter of zero, and with any parameter at zero."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from damper_examples import EXAMPLES
from kelvin_voigt_campaign import C, campaign

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.results.fit import law_estimates
from edesign.calibration.results.practical_units import practical
from edesign.calibration.run import calibrate
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters, write_parameters
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.estimation.parameters import coordinates_of


def _no_spring(t, u, v, a, order):  # type: ignore[no-untyped-def]
    """A dashpot beside friction that rises over 2 mm/s and pulsates; less than no spring, so that k ends at zero."""
    return -1e5 * u + C * v + 3e3 * np.tanh(v / 2e-3) * (0.9 + 0.2 * np.sin(2.0 * t))


def _left_by_powers(tests: Campaign) -> float:
    """Least NRMS of c |v|^alpha sgn v in the tests fitted, by linear least squares over a grid of alpha."""
    fitted = [one for one in tests.tests if one.use == "fit"]
    v = np.concatenate([np.gradient(one.displacement, one.time) for one in fitted])
    force = np.concatenate([one.measured_force() for one in fitted])
    errors = []
    for alpha in np.linspace(0.1, 1.0, 91):
        power = np.abs(v) ** alpha * np.sign(v)
        errors.append(np.sum((force - power * (power @ force) / (power @ power)) ** 2))
    return float(min(errors) / (force @ force))


def test_a_law_that_ends_at_zero_is_compared_with_others(tmp_path: Path) -> None:
    tests = campaign(tmp_path, _no_spring, tests=5)
    declared = LawChoice("kelvin_voigt", {"k": "0 kN/mm", "c": "0.2 kN*s/mm"})
    found = calibrate(replace(tests, law=declared), replace(SETTINGS, effort=60.0), 1)
    assert found.parameters["refit"]["k"].value == 0.0 and not found.failed
    assert found.other_law is not None and found.other_law.law == "viscous_power"
    # at the sampling of a fit, whose low pass takes the sharpest edges off the friction: less by some per cent
    assert found.other_law.nrms == pytest.approx(_left_by_powers(tests), rel=0.1)


@pytest.fixture(scope="module")
def problem(tmp_path_factory: pytest.TempPathFactory) -> DamperProblem:
    return damper_problem(campaign(tmp_path_factory.mktemp("c"), tests=4))


@pytest.mark.parametrize("name", LAWS)
def test_every_parameter_may_be_zero_that_a_law_lets_be(name: str, problem: DamperProblem) -> None:
    law = LAWS[name]
    values = law.complete(EXAMPLES[name])
    for one in law.all_parameters(values):
        if not (one.fitted and one.allows(0.0)):
            continue
        declared = {**values, one.name: 0.0}
        own = replace(problem, law=law, declared=declared, alone={})
        centres = np.array([parameter.centre for parameter in own.base])
        assert np.all(np.isfinite(coordinates_of(own.base, centres)))
        assert isinstance(own.model(()).predict(centres[np.newaxis])[0], list)
        estimates = law_estimates(own, None)
        assert practical(estimates[one.name], estimates).value == 0.0
        assert read_parameters(law, write_parameters(law, declared))[one.name] == 0.0
        assert own.effects and len(own.start) == len(own.base)
