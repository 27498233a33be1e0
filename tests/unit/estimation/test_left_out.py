"""The score of tests left out against fits without each of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from estimation_models import FormulaModel, free, linear, normal
from scipy.stats import multivariate_t

from edesign.estimation.least_squares import Fit, Settings, fit
from edesign.estimation.left_out import PRIOR_FREEDOM, difference, score
from edesign.estimation.noise import Noise

TIGHT = Settings(enough=1e-12, steps=100)
SIZES = (30, 41, 52, 63)


def campaign(tests: int = 4, p: int = 3, seed: int = 1) -> tuple[list[np.ndarray], list[np.ndarray]]:
    generator = np.random.default_rng(seed)
    matrices = [generator.standard_normal((n, p)) for n in SIZES[:tests]]
    truth = generator.standard_normal(p)
    return matrices, [x @ truth + 0.6 * generator.standard_normal(len(x)) for x in matrices]


def by_refits(model: FormulaModel, noise: Noise, slopes: list[np.ndarray] | None = None) -> np.ndarray:
    """Log predictive density of each test by a fit to the others: multivariate t by scipy, white noise."""
    found = []
    for i in range(len(model.measured)):
        rest = [k for k in range(len(model.measured)) if k != i]
        others = FormulaModel(
            model.parameters,
            tuple(model.measured[k] for k in rest),
            lambda v, rest=rest: [model.formula(v)[k] for k in rest],
        )
        of_rest = Noise(tuple(noise.variance[k] for k in rest), tuple(noise.long_run[k] for k in rest))
        refit = fit(others, of_rest, settings=TIGHT)
        one = fit(model, noise, refit.z, steps=0)  # slopes of the test left out, at the parameters by the others
        weight = noise.weight(i)
        normal_matrix = np.eye(refit.z.size) + sum(j.T @ j for j in refit.weighted().slopes)
        j = weight * one.slopes[i]
        freedom = PRIOR_FREEDOM + sum(r.size for r in refit.left)
        scale = max((PRIOR_FREEDOM + sum(float(r @ r) for r in refit.weighted().residuals)) / freedom, 1.0)
        covariance = scale * (np.eye(len(j)) + j @ np.linalg.solve(normal_matrix, j.T))
        density = multivariate_t.logpdf(weight * one.left[i], shape=covariance, df=freedom)
        found.append(density + 0.5 * len(j) * np.log(2.0 * np.pi))  # a constant that all models share
    return np.array(found)


def test_the_score_of_a_linear_model_is_exact() -> None:
    matrices, measured = campaign()
    model, noise = linear(matrices, measured, normal("abc")), Noise.white([0.5, 0.6, 0.7, 0.5])
    found = score(fit(model, noise, settings=TIGHT), noise)
    np.testing.assert_allclose(found.left_out, by_refits(model, noise), rtol=1e-7)
    assert found.total == pytest.approx(found.left_out.sum())


def test_a_fit_that_has_not_ended_has_the_score_of_its_end() -> None:
    matrices, measured = campaign()
    model, noise = linear(matrices, measured, normal("abc")), Noise.white([0.5, 0.6, 0.7, 0.5])
    ended, begun = fit(model, noise, settings=TIGHT), fit(model, noise, steps=0)
    np.testing.assert_allclose(score(begun, noise).left_out, score(ended, noise).left_out, rtol=1e-7)


def test_the_score_of_a_nonlinear_model_is_near() -> None:
    """Relaxation in four tests; one step of Gauss-Newton from the fit to all: models that differ by 1 are resolved."""
    generator, times = np.random.default_rng(3), [np.linspace(0.0, 1.0 + i, 40) for i in range(4)]
    formula = lambda v: [np.exp(v[0]) * np.exp(-np.exp(v[1]) * t) + v[2] for t in times]  # noqa: E731
    measured = tuple(f + 0.05 * generator.standard_normal(40) for f in formula(np.array([0.3, 0.5, 0.2])))
    model, noise = FormulaModel(normal("abc"), measured, formula), Noise.white([0.05] * 4)
    found = score(fit(model, noise, settings=TIGHT), noise)
    np.testing.assert_allclose(found.left_out, by_refits(model, noise), atol=0.2)


def test_nuisance_amplitudes_count_as_parameters_of_a_test() -> None:
    """A share that no other test determines predicts with its prior alone."""
    matrices, measured = campaign(p=2)
    columns = [2.0 * np.ones((len(x), 1)) for x in matrices]
    noise = Noise.white([0.5] * 4)
    own = linear(matrices, measured, normal("ab"))
    own.columns = lambda values: columns
    wide = [np.hstack((x, np.zeros((len(x), 4)))) for x in matrices]
    for i, x in enumerate(wide):
        x[:, 2 + i] = 2.0
    explicit = linear(wide, measured, normal("abcdef"))
    one, other = (score(fit(model, noise, settings=TIGHT), noise).left_out for model in (own, explicit))
    np.testing.assert_allclose(one, other, rtol=2e-3)  # the scale counts powers without shares, by 4 of 186 samples


def test_what_equations_may_be_wrong_by_counts_as_shared_parameters() -> None:
    matrices, measured = campaign(p=4)
    noise = Noise.white([0.5, 0.6, 0.7, 0.5])
    narrow = linear([x[:, :3] for x in matrices], measured, normal("abc"))
    wide = score(fit(linear(matrices, measured, normal("abcd")), noise, settings=TIGHT), noise)
    wrong = score(fit(narrow, noise, settings=TIGHT), noise, [x[:, 3:] for x in matrices])
    np.testing.assert_allclose(wrong.left_out, wide.left_out, rtol=1e-7)
    np.testing.assert_allclose(wrong.within, wide.within, rtol=1e-7)


def test_refits_follow_what_one_step_does_not() -> None:
    """One test shows another rate than the others: without it they lead far, along a curve."""
    generator = np.random.default_rng(9)
    times = [np.linspace(0.0, 0.3, 30), np.linspace(0.0, 0.4, 30), np.linspace(0.0, 8.0, 30)]
    formula = lambda v: [np.exp(2.0 * v[0]) * np.exp(-np.exp(3.0 * v[1]) * t) for t in times]  # noqa: E731
    slow, fast = formula(np.array([0.5, -1.7])), formula(np.array([0.5, -0.2]))
    measured = tuple(f + 0.1 * generator.standard_normal(30) for f in (*slow[:2], fast[2]))
    model, noise = FormulaModel(normal("ab", 0.25), measured, formula), Noise.white([0.1] * 3)
    fitted = fit(model, noise, settings=TIGHT)
    expected = by_refits(model, noise)
    errors = [np.abs(score(fitted, noise, refits=again).left_out - expected).max() for again in (False, True)]
    assert errors[1] < 0.5 * errors[0]


def test_one_test_has_its_prior_and_flat_parameters_need_others() -> None:
    matrices, measured = campaign(tests=1)
    noise = Noise.white([0.6])
    one = linear(matrices, measured, normal("abc"))
    found = score(fit(one, noise, settings=TIGHT), noise)
    np.testing.assert_allclose(found.left_out, by_refits_of_one(one, 0.6), rtol=1e-7)
    flat = linear(matrices, measured, free("abc"))
    assert score(fit(flat, noise, settings=TIGHT), noise).total == -np.inf
    assert np.isfinite(score(fit(linear([np.ones((3, 0))], [np.ones(3)], ()), noise), noise).total)


def by_refits_of_one(model: FormulaModel, deviation: float) -> list[float]:
    x = model.formula(np.eye(3)[0])[0][:, np.newaxis], *(model.formula(row)[0][:, np.newaxis] for row in np.eye(3)[1:])
    j = np.hstack(x) / deviation
    y = model.measured[0] / deviation
    found = multivariate_t.logpdf(y, shape=np.eye(len(j)) + j @ j.T, df=PRIOR_FREEDOM)
    return [found + 0.5 * len(j) * np.log(2.0 * np.pi)]


def test_nearly_collinear_columns_do_not_spoil_the_score() -> None:
    """Two columns alike but for 1e-7, determined to 1e4 of the prior: with their sum the score is almost the same."""
    generator = np.random.default_rng(8)
    x = [generator.standard_normal((n, 1)) for n in SIZES]
    measured = [1e4 * one[:, 0] + generator.standard_normal(len(one)) for one in x]
    both = [np.hstack((one, one + 1e-7 * generator.standard_normal(one.shape))) for one in x]
    noise = Noise.white([1.0] * 4)
    pair = score(fit(linear([1e4 * one for one in both], measured, normal("ab")), noise, settings=TIGHT), noise)
    alone = score(
        fit(linear([1e4 * one for one in x], measured, normal("a", np.sqrt(2.0))), noise, settings=TIGHT), noise
    )
    assert pair.total == pytest.approx(alone.total, abs=0.01)
    assert difference(pair, alone).total == pytest.approx(pair.total - alone.total, abs=1e-9)


def test_parameters_at_a_bound_count_as_known() -> None:
    matrices, measured = campaign()
    noise = Noise.white([0.6] * 4)
    parameters = normal("abc")
    known = fit(linear([x[:, :2] for x in matrices], measured, parameters[:2]), noise, settings=TIGHT)
    bounded = (*parameters[:2], replace(parameters[2], lower=0.0, upper=1.0, centre=0.5))
    truth: Fit = fit(
        linear([np.hstack((x[:, :2], -1e3 * np.ones((len(x), 1)))) for x in matrices], measured, bounded),
        noise,
        settings=TIGHT,
    )
    assert truth.values[2] == 0.0
    np.testing.assert_allclose(score(truth, noise).left_out, score(known, noise).left_out, rtol=1e-6)
