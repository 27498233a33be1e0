"""Uncertain tests: how far and fast a specimen went before a record that begins in motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from damper_problems import problem

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.problem import DamperProblem
from edesign.damper.damper import Damper
from edesign.damper.history import NONE, Extremes
from edesign.damper.testing.start import Start

FOUND = (8e-3, -8e-3, 0.1, -0.1)  # of displacements of 2 to 8 mm
MOVING = 2  # the test that begins in motion


def moving(prior: Extremes, lasting: bool) -> DamperProblem:
    def started(one: Experiment) -> Experiment:
        return replace(one, start=Start(0.0, 0.1, 0.0, True, prior)) if one.order == MOVING else one

    tests = problem("mgmm", tests=5, lasting=lasting)
    return tests.with_experiments([started(one) for one in tests.experiments])


def forces(tests: DamperProblem) -> list[np.ndarray]:
    (found,) = tests.model((), ("fit", "validate")).forces(np.array([[one.centre for one in tests.base]]))
    return found


def test_what_a_fresh_specimen_went_through_is_no_matter_where_earlier_tests_soften_it():
    fresh, lasting, without = moving(FOUND, False), moving(FOUND, True), moving(NONE, True)
    law = Damper(fresh.law, fresh.declared)
    motion = fresh.experiments[MOVING].motion
    unsoftened = law.force(motion.time, motion.displacement)
    assert np.max(np.abs(forces(fresh)[MOVING] - unsoftened)) > 0.05 * fresh.typical.force
    assert all(np.array_equal(a, b) for a, b in zip(forces(lasting), forces(without), strict=True))


def test_softening_before_a_record_is_a_share_of_its_own():
    tests = moving(NONE, False)
    values = np.array([one.centre for one in tests.base])
    columns = tests.model(()).nuisance_columns(values)
    own = tests.experiments[MOVING].motion.extremes
    far, fast = max(own[0], -own[1]), max(own[2], -own[3])
    plain, weights = forces(tests)[MOVING], tests.model(()).weights[MOVING]
    for k, prior in enumerate([(far, -far, 0.0, 0.0), (0.0, 0.0, fast, -fast)]):
        # by the definition: the force after such extremes less that after none
        assert np.array_equal(columns[MOVING][:, k], weights * (forces(moving(prior, False))[MOVING] - plain))
    assert not any(np.any(column) for i, column in enumerate(columns) if i != MOVING)
    assert problem("mgmm").uncertain_inputs == ()
