"""How sure parameters are: the scatter within tests, and that from test to test, against least squares by hand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of

from edesign.calibrate.cross_validation import leave_one_out
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, fit
from edesign.calibrate.outcome import estimates
from edesign.calibrate.uncertainty import Uncertainty

T_2 = 4.302653  # Student's t, 97.5 %, two degrees of freedom: any table


def _fitted(problem: LinearProblem) -> Fitted:
    model = model_of(problem)
    return fit(model, model.coordinates())


def _scattered(seed: int, tests: int, scatter: float) -> LinearProblem:
    """Tests in which the first parameter is another one by a normal `scatter`, the last one for validation."""
    problem = linear(seed=seed, tests=tests + 1)
    random = np.random.default_rng(seed + 1000)
    own = scatter * random.standard_normal(tests + 1)
    problem.measured = tuple(
        y + size * m[:, 0] for y, m, size in zip(problem.measured, problem.matrices, own, strict=True)
    )
    return problem


def test_the_scatter_from_test_to_test_is_that_of_each_tests_own_estimate() -> None:
    # columns are nearly orthogonal and of one length: the estimate is the mean of the tests' own
    problem = _scattered(3, 5, 0.4)
    own = [
        np.linalg.lstsq(m, y, rcond=None)[0][0] for m, y in zip(problem.matrices[:5], problem.measured, strict=False)
    ]
    expected = np.std(own, ddof=1) / np.sqrt(5)
    sure = Uncertainty.of(_fitted(problem))
    # 200 samples a test: lengths and angles of columns, and so the weights of tests, differ by 1 / sqrt(200)
    assert sure.standard_error(np.eye(3)[0]) == pytest.approx(expected, rel=0.15)


def test_what_one_test_alone_tells_has_the_scatter_within_it() -> None:
    # the first column is nothing but in one test: other tests do not pull at it, and that one is followed
    problem = linear(seed=4)
    for matrix in problem.matrices[1:]:
        matrix[:, 0] = 0.0
    own = np.linalg.inv(problem.matrices[0].T @ problem.matrices[0])[0, 0] ** 0.5
    sure = Uncertainty.of(_fitted(problem))
    assert np.abs(sure.pulls[:, 0]).max() < 0.15 * own  # but for the angles of other columns
    assert sure.standard_error(np.eye(3)[0]) > 0.9 * own


@pytest.mark.parametrize("tests", [3, 8])
def test_intervals_hold_the_truth_as_often_as_they_say(tests: int) -> None:
    # the truth of the first parameter is 1.1; tests scatter about it by 20 times what noise does
    inside = 0
    for seed in range(200):
        sure_of = _fitted(_scattered(seed, tests, 1.4))
        inside += abs(sure_of.x[0] - 1.1) <= Uncertainty.of(sure_of).half_width(np.eye(3)[0])
    # 95 % of 200 with a standard deviation of 3; normal quantiles with three tests would hold 81 %
    assert 181 <= inside <= 199


def test_few_tests_ask_for_students_t() -> None:
    sure = Uncertainty.of(_fitted(_scattered(3, 3, 1.0)))
    row = np.eye(3)[0]
    assert sure.half_width(row) == pytest.approx(T_2 * sure.standard_error(row), rel=1e-6)


def test_a_parameter_at_its_bound_is_told_as_that() -> None:
    problem = linear(seed=5)
    problem.base = (replace(problem.base[0], upper=0.9), *problem.base[1:])  # the truth is 1.1
    found = estimates(Judged(_fitted(problem)))["", "b0"]
    assert found.value == 0.9 and found.untold == "at its upper bound" and np.isinf(found.standard_error)


@pytest.mark.parametrize(("fitted", "left_out"), [(2, 8), (3, 3), (5, 5)])
def test_whole_tests_are_left_out_from_three_on(fitted: int, left_out: int) -> None:
    problem = linear(seed=6, tests=fitted + 1)
    found = leave_one_out(_fitted(problem))
    assert found.chi2.size == left_out
    if fitted == 3:  # a fit without the first test, by numpy
        matrix, measured = np.vstack(problem.matrices[1:3]), np.concatenate(problem.measured[1:3])
        # the belief in the declared parameters (0.3) is a thousandth of 400 samples
        own = problem.measured[0] - problem.matrices[0] @ np.linalg.lstsq(matrix, measured, rcond=None)[0]
        assert found.chi2[0] == pytest.approx(float(own @ own), rel=0.01)
