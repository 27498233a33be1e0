"""Fits, errors on tests left out and doubts, against numpy's least squares on a linear problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of

from edesign.calibrate.cross_validation import leave_one_out
from edesign.calibrate.dampers.full_rate import likeliest_doubt
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import BELIEF, Model, correlation_length, fit, whitened
from edesign.calibrate.outcome import predict
from edesign.calibrate.problem import Part, Use
from edesign.calibrate.unknown import Unknown


def _stacked(problem: LinearProblem, without: int | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Equations of the tests fitted to, and of the belief b = 1 with a standard deviation of BELIEF."""
    rows = [i for i, use in enumerate(problem.uses) if use == "fit" and i != without]
    matrix = np.vstack([problem.matrices[i] for i in rows] + [np.eye(3) / BELIEF])
    right = np.concatenate([problem.measured[i] for i in rows] + [np.ones(3) / BELIEF])
    return matrix, right


@pytest.mark.parametrize("logarithmic", [True, False])
def test_coordinates_and_values_go_back_and_forth(logarithmic: bool) -> None:
    unknown = Unknown("tau", "s", 1e-3, 50.0, 0.2, logarithmic)
    for value in (1e-3, 0.2, 7.0, 50.0):
        assert unknown.value(unknown.coordinate(value)) == pytest.approx(value, rel=1e-12)
    assert unknown.value(unknown.coordinate(1e3)) == pytest.approx(50.0)  # the bound
    step = 1e-6
    x = unknown.coordinate(3.0)
    slope = (unknown.value(x + step) - unknown.value(x - step)) / (2.0 * step)
    assert unknown.slope(x) == pytest.approx(slope, rel=1e-6)
    assert unknown.span == pytest.approx((unknown.coordinate(1e-3), unknown.coordinate(50.0)))


def test_fit_is_least_squares() -> None:
    problem = linear()
    found = fit(model_of(problem), np.ones(3))
    matrix, right = _stacked(problem)
    assert found.x == pytest.approx(np.linalg.lstsq(matrix, right, rcond=None)[0], abs=1e-6)
    # noise of 1: chi2 per sample is 1 within 4 standard deviations of a chi2 of 1000 samples
    assert found.reduced == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / 1000.0))
    assert np.sqrt(np.diag(found.covariance)) == pytest.approx(
        np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix))) * found.misfit, rel=1e-3
    )


def test_noise_that_changes_within_a_test_is_weighted_least_squares() -> None:
    # noise three times as strong in the first half of each test, and an effect that has a share of each test's own
    problem = linear()
    problem.weights = tuple(np.where(np.arange(y.size) < y.size // 2, 1.0 / 3.0, 1.0) for y in problem.measured)
    random = np.random.default_rng(6)
    problem.columns["slow"] = [random.standard_normal(y.size) for y in problem.measured]
    problem.own["slow"] = [random.standard_normal((y.size, 2)) for y in problem.measured]
    (slow,) = (c for c in problem.candidates([]) if c.name == "slow")
    model = replace(model_of(problem), effects=(slow,))
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    # all of it at once: the parameters, and two numbers of each test
    blocks = []
    for place, i in enumerate(fitted):
        own = np.zeros((problem.measured[i].size, 2 * len(fitted)))
        own[:, 2 * place : 2 * place + 2] = problem.own["slow"][i]
        columns = [problem.matrices[i], problem.columns["slow"][i][:, np.newaxis], own]
        blocks.append(np.hstack(columns) * problem.weights[i][:, np.newaxis])
    belief = np.hstack([np.eye(3) / BELIEF, np.zeros((3, 1 + 2 * len(fitted)))])
    right = [*(problem.weights[i] * problem.measured[i] for i in fitted), np.ones(3) / BELIEF]
    expected = np.linalg.lstsq(np.vstack([*blocks, belief]), np.concatenate(right), rcond=None)[0]
    found = fit(model, model.coordinates())
    assert found.x == pytest.approx(expected[:4], abs=1e-6)
    # what is taken from a test is what that fit gives it
    errors = predict(problem, Judged(found))
    for place, i in enumerate(fitted):
        own = problem.own["slow"][i] @ expected[4 + 2 * place : 6 + 2 * place]
        shared = problem.matrices[i] @ expected[:3] + expected[3] * problem.columns["slow"][i]
        assert errors[i] == pytest.approx(shared + own, abs=1e-5)


def test_a_condition_in_doubt_is_generalised_least_squares() -> None:
    # noise I + d d^T of each test fitted to, beside the belief in the declared ones
    problem = linear()
    random = np.random.default_rng(5)
    problem.doubts = tuple(3.0 * random.standard_normal(y.size) for y in problem.measured)
    found = fit(model_of(problem), np.ones(3))
    total, right, chi2 = np.eye(3) / BELIEF**2, np.ones(3) / BELIEF**2, 0.0
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    inverses = {i: np.linalg.inv(np.eye(d.size) + np.outer(d, d)) for i, d in enumerate(problem.doubts)}
    for i in fitted:
        total += problem.matrices[i].T @ inverses[i] @ problem.matrices[i]
        right += problem.matrices[i].T @ inverses[i] @ problem.measured[i]
    expected = np.linalg.solve(total, right)
    np.testing.assert_allclose(found.x, expected, rtol=1e-6)
    for i in fitted:
        left = problem.measured[i] - problem.matrices[i] @ expected
        chi2 += float(left @ inverses[i] @ left)
    assert found.chi2 == pytest.approx(chi2, rel=1e-9)


@pytest.mark.parametrize(
    ("share", "expected"), [(0.5, 0.25 * 49.0 / 50.0), (-1.9, 3.61 * 49.0 / 50.0), (-10.0, 8.0**2 * 49.0 + 2.0**2)]
)
def test_a_condition_is_not_in_doubt_without_limit(share: float, expected: float) -> None:
    # of a share s of d with |d| = 7 generalised least squares leave s^2 d^2 / (1 + d^2); beyond two all the rest
    doubt, beside = 7.0 * np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, -0.6])
    found = whitened(share * doubt + beside, doubt)
    assert found @ found == pytest.approx(expected + 1.0, rel=1e-12)
    assert found @ beside == pytest.approx(1.0, rel=1e-12)


def test_a_bound_holds_and_the_others_find_their_best_place() -> None:
    problem = linear()
    problem.base = (Unknown("b0", "", -1.0, 0.9, 1.0), *problem.base[1:])
    found = fit(model_of(problem), np.zeros(3))
    assert found.x[0] == 0.9
    matrix, right = _stacked(problem)
    # the belief about the bounded one is at its bound's distance from 1 whatever the others are
    rest = np.linalg.lstsq(matrix[:, 1:], right - 0.9 * matrix[:, 0], rcond=None)[0]
    assert found.x[1:] == pytest.approx(rest, abs=1e-6)


def test_leaving_a_test_out_is_fitting_the_others() -> None:
    problem = linear()
    found = leave_one_out(fit(model_of(problem), np.ones(3)))
    for i in range(5):
        matrix, right = _stacked(problem, without=i)
        b = np.linalg.lstsq(matrix, right, rcond=None)[0]
        expected = float(np.sum((problem.measured[i] - problem.matrices[i] @ b) ** 2))
        assert found.chi2[i] == pytest.approx(expected, rel=1e-6)
    assert float(found.chi2.sum()) > fit(model_of(problem), np.ones(3)).chi2


def test_a_step_too_far_without_a_test_is_shortened() -> None:
    # arctan 4 b with b of 0.5 in five tests, of 6 in one of ten times the weight: without that one, a Gauss-Newton step
    # from the flat part, where the fit with it ends, goes far beyond 0.5 and fits the five worse than before
    class Arctan(LinearProblem):
        def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
            return [None if y is None else np.arctan(y) for y in super().predict(base, parts, uses)]

    sizes = (20, 20, 20, 20, 20, 1000)
    values = (0.5, 0.5, 0.5, 0.5, 0.5, 6.0)
    measured = tuple(np.arctan(np.full(n, 4.0 * b)) for n, b in zip(sizes, values, strict=True))
    problem = Arctan([np.full((n, 1), 4.0) for n in sizes], {}, measured, ("fit",) * 6)
    found = fit(model_of(problem, noise=0.01), np.ones(1))
    alone = sizes[-1] * ((np.arctan(24.0) - np.arctan(2.0)) / 0.01) ** 2  # of a fit to the five
    assert found.residuals[-1] @ found.residuals[-1] < leave_one_out(found).chi2[-1] < 1.1 * alone
    weight = found.hessian - found.slopes[-1].T @ found.slopes[-1]
    whole = float((found.slopes[-1].T @ found.residuals[-1])[0] / weight[0, 0])
    assert whole < -2.0
    (*_, far) = found.model.residuals(found.x + max(whole, -3.0))
    assert far @ far > 5.0 * alone


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9])
def test_correlation_length_of_a_first_order_process(rho: float) -> None:
    random = np.random.default_rng(3)
    values = np.empty(40000)
    values[0] = random.standard_normal()
    for i, e in enumerate(random.standard_normal(values.size - 1)):
        values[i + 1] = rho * values[i] + np.sqrt(1.0 - rho**2) * e
    # sum of rho^|k| over all k; the estimate scatters by some per cent for 40000 samples
    assert correlation_length(values) == pytest.approx((1.0 + rho) / (1.0 - rho), rel=0.15)


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_conditions_are_in_doubt_as_far_as_the_tests_show(share: float) -> None:
    problem = linear(seed=11, tests=12)
    random = np.random.default_rng(12)
    doubts = tuple(0.5 * random.standard_normal(200) for _ in problem.measured)
    off = random.standard_normal(12)  # standard deviations by which each condition is off
    problem.measured = tuple(
        y + share * size * doubt for y, size, doubt in zip(problem.measured, off, doubts, strict=True)
    )
    model = Model(replace(problem, doubts=doubts), (1.0,) * 12)
    chosen = likeliest_doubt(fit(model, model.coordinates()))
    # unit noise in 200 values, a doubt of 0.5 each: with 12 tests a tenth of it is no more likely than none
    assert chosen == 1.0 if share else chosen in (0.0, 0.1)
