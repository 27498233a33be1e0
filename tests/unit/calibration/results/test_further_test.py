"""The next test stays within what the tests have shown that the rig can make, and separates what it is to separate."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.floor import Floor
from edesign.calibration.results.models import Posterior
from edesign.calibration.results.next_test import Reach, _tests, next_test
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.left_out import Difference
from edesign.estimation.noise import Noise


@dataclass(frozen=True, eq=False)
class Even(Posterior):
    """All models are as good."""

    def behind(self, i):
        return Difference(0.0, 0.0)


def posterior(tests, *labels: str, size: float = 0.3) -> Posterior:
    fitter = unbounded(tests, SETTINGS)
    noise = Noise.white([100.0] * 3)
    base = np.array([one.centre for one in tests.base])
    models = []
    for label in labels:
        effect = next(one for one in tests.effects if one.label == label)
        values = np.array([size * effect.starts[0][0], *effect.starts[0][1:]])
        models.append(fitter.fit((effect,), np.append(base, values), noise, 0))
    return Even(fitter, models[0], tuple(models))


def test_tests_thought_of_are_no_larger_no_faster_and_no_warmer():
    tests = problem("mgmm", degrees=(18.0, 27.0))
    reach = Reach.of(tests.experiments)
    thought = list(_tests(tests))
    assert len(thought) > 20
    for _, one in thought:
        for k, most in ((1, reach.displacement), (2, reach.velocity), (3, reach.acceleration)):
            assert np.max(np.abs(one.motion.samples[k])) <= most * (1.0 + 1e-9)
        assert 18.0 <= one.temperature <= 27.0


def test_the_next_test_is_a_hold_for_what_differs_at_rest():
    """Friction stays in a hold, a force of the velocity goes."""
    found = next_test(problem(), posterior(problem(), "friction.coulomb", "velocity_exponent.dashpot"))
    assert found is not None and set(found.separates) == {"friction.coulomb", "velocity_exponent.dashpot"}
    assert found.difference > found.largest


def test_one_model_alone_needs_no_further_test():
    assert next_test(problem(), posterior(problem(), "hardening.power")) is None


def test_a_test_made_again_shows_what_does_not_repeat():
    tests = problem(tests=4)
    random = np.random.default_rng(1)
    first = tests.experiments[0]
    rough = [first.force + 200.0 * random.standard_normal(first.force.size) for _ in range(2)]
    again = replace(tests.experiments[1], motion=first.motion, force=rough[1])
    tests = tests.with_experiments([replace(first, force=rough[0]), again, *tests.experiments[2:]])
    # without effects: noise of the channels is as declared, 10 N, and not sought in the records again
    base = np.array([one.centre for one in tests.base])
    model = unbounded(tests, SETTINGS).fit((), base, Noise.white([100.0] * 3), 0)
    (forces,) = tests.model((), ("fit", "validate")).forces(base)
    floor = Floor.under(tests, model, forces)
    # 750 samples of white noise: 4 standard errors of 1/sqrt(2 n)
    assert floor.noise[:2] == pytest.approx((200.0, 200.0), rel=0.11)
    assert floor.noise[2:] == (10.0, 10.0)


def test_tests_thought_of_have_no_more_samples_the_slower_they_are():
    """A thousand times as slow as the tests that were made: a cycle has at most 600 samples."""
    tests = problem()
    slow = [
        replace(one, motion=Motion(1e3 * m.time, m.displacement, 1e-3 * m.velocity, 1e-6 * m.acceleration))
        for one in tests.experiments
        for m in (one.motion,)
    ]
    cycles = [one for text, one in _tests(tests.with_experiments(slow)) if "cycles" in text]
    assert cycles and max(one.motion.time.size for one in cycles) <= 12 * 600 + 1
