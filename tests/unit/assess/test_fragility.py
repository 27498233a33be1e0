"""Fragility fits: parameters recovered from simulated data, other solutions, and data without a solution."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import binom, norm

from edesign.assess.fragility import collapse_margin_ratio, fit_capacities, fit_counts
from edesign.errors import AnalysisError

IM = np.array([0.2, 0.4, 0.6, 0.8, 1.0, 1.3, 1.7])


def counts(theta: float, beta: float, n: int, rng: np.random.Generator) -> np.ndarray:
    return np.asarray(rng.binomial(n, norm.cdf(np.log(IM / theta) / beta)))


def log_likelihood(theta: float, beta: float, im: np.ndarray, n: np.ndarray, k: np.ndarray) -> float:
    return float(binom.logpmf(k, n, norm.cdf(np.log(im / theta) / beta)).sum())


def test_parameters_of_simulated_counts_are_recovered() -> None:
    """Of 400 samples errors in units of their standard errors have mean 0 and deviation 1 (5 % for 400, and bias)."""
    rng = np.random.default_rng(20)
    errors = []
    for _ in range(400):
        fit = fit_counts(IM, [200] * IM.size, counts(0.8, 0.45, 200, rng))
        errors.append([(fit.theta - 0.8) / fit.theta_se, (fit.beta - 0.45) / fit.beta_se])
    assert np.mean(errors, axis=0) == pytest.approx([0.0, 0.0], abs=0.2)
    assert np.std(errors, axis=0) == pytest.approx([1.0, 1.0], abs=0.12)


@pytest.mark.parametrize("seed", range(6))
def test_largest_likelihood_by_brute_force(seed: int) -> None:
    """The largest binomial likelihood on a grid of 1e-3, and by Nelder and Mead's search from its place."""
    rng = np.random.default_rng(seed)
    n = np.array([20, 20, 15, 20, 20, 8, 20])
    k = np.minimum(counts(0.9, 0.5, 20, rng), n)
    fit = fit_counts(IM, n, k)
    theta, beta = np.meshgrid(np.arange(0.4, 2.0, 1e-3), np.arange(0.1, 1.5, 1e-2))
    p = norm.cdf(np.log(IM[:, None, None] / theta) / beta)
    grid = binom.logpmf(k[:, None, None], n[:, None, None], p).sum(axis=0)
    best = np.unravel_index(np.argmax(grid), grid.shape)
    assert fit.theta == pytest.approx(theta[best], abs=2e-2)
    assert log_likelihood(fit.theta, fit.beta, IM, n, k) >= grid[best] - 1e-12
    search = minimize(
        lambda x: -log_likelihood(x[0], x[1], IM, n, k),
        [theta[best], beta[best]],
        method="Nelder-Mead",
        options={"xatol": 1e-9, "fatol": 1e-13},
    )
    assert (fit.theta, fit.beta) == pytest.approx(tuple(search.x), rel=1e-6)  # half the digits of a flat maximum


def test_exact_fractions_give_the_function_back() -> None:
    """Fractions that lie on the function (counts need not be whole): no deviance, and the probabilities themselves."""
    n = np.full(IM.size, 1000.0)
    fit = fit_counts(IM, n, n * norm.cdf(np.log(IM / 0.7) / 0.35))
    assert (fit.theta, fit.beta) == pytest.approx((0.7, 0.35), rel=1e-9)
    assert fit.deviance == pytest.approx(0.0, abs=1e-9)
    assert fit.p_value == pytest.approx(1.0)
    assert fit.probability([0.0, 0.7, 0.7 * np.exp(0.35)]) == pytest.approx([0.0, 0.5, norm.cdf(1.0)])


def test_standard_errors_are_those_of_the_curvature() -> None:
    """The inverse of numerical second derivatives at exact fractions, where observed and expected ones are the same."""
    n = np.full(IM.size, 1000.0)
    p = norm.cdf(np.log(IM / 0.7) / 0.35)
    fit = fit_counts(IM, n, n * p)

    def value(theta: float, beta: float) -> float:
        q = norm.cdf(np.log(IM / theta) / beta)
        return float(np.sum(n * (p * np.log(q) + (1 - p) * np.log1p(-q))))

    h = 1e-4
    tt = (value(0.7 + h, 0.35) - 2 * value(0.7, 0.35) + value(0.7 - h, 0.35)) / h**2
    bb = (value(0.7, 0.35 + h) - 2 * value(0.7, 0.35) + value(0.7, 0.35 - h)) / h**2
    corners = [value(0.7 + i * h, 0.35 + j * h) for i, j in ((1, 1), (1, -1), (-1, 1), (-1, -1))]
    tb = (corners[0] - corners[1] - corners[2] + corners[3]) / (4 * h**2)
    variance = np.linalg.inv(-np.array([[tt, tb], [tb, bb]]))
    assert (fit.theta_se, fit.beta_se) == pytest.approx(tuple(np.sqrt(np.diag(variance))), rel=1e-4)


@pytest.mark.parametrize(
    "passed, words",
    [
        ([0, 0, 0, 0], "E-FRAG-01"),
        ([9, 9, 9, 9], "E-FRAG-01"),
        ([0, 0, 9, 9], "intensity 2 of 4, .* 3 .*E-FRAG-01"),
        ([0, 4, 9, 9], "only at intensity 2 of 4 .*E-FRAG-01"),
        ([9, 5, 2, 0], "E-FRAG-02"),
        ([9, 9, 0, 0], "E-FRAG-02"),
    ],
)
def test_data_without_a_maximum_say_so(passed: list[int], words: str) -> None:
    with pytest.raises(AnalysisError, match=words):
        fit_counts([0.1, 0.2, 0.3, 0.4], [9, 9, 9, 9], passed)


def test_nearly_separated_data_converge() -> None:
    """One of a thousand out of place on either side."""
    fit = fit_counts([1.0, 2.0, 3.0, 4.0], [1000] * 4, [0, 1, 999, 1000])
    assert fit.theta == pytest.approx(np.sqrt(6.0), rel=1e-6)  # symmetric in ln(im) between 2 and 3
    assert norm.cdf(np.log(2.0 / fit.theta) / fit.beta) == pytest.approx(1e-3, rel=1e-3)


def test_intensities_without_analyses_do_not_count() -> None:
    whole = fit_counts(IM, [20] * 7, [0, 1, 4, 9, 12, 17, 20])
    gap = fit_counts(np.append(IM, 2.0), [20] * 7 + [0], [0, 1, 4, 9, 12, 17, 20, 0])
    assert gap == whole


def test_capacities_are_moments_of_logarithms() -> None:
    fit = fit_capacities([1.0, np.e, np.e**2, np.e**3])
    assert fit.theta == pytest.approx(np.exp(1.5))
    assert fit.beta == pytest.approx(np.sqrt(5.0 / 3.0))
    assert fit.theta_se == pytest.approx(fit.theta * fit.beta / 2.0)
    assert fit.beta_se == pytest.approx(fit.beta / np.sqrt(6.0))
    assert fit.deviance is None and fit.censored == 0


def test_censored_capacities_are_recovered_within_their_errors() -> None:
    """Of 80 samples of 400 records, of which those beyond 1.1 theta are only known to be so."""
    rng = np.random.default_rng(3)
    errors = []
    for _ in range(80):
        capacity = 0.9 * np.exp(0.4 * rng.standard_normal(400))
        capacity[capacity > 1.0] = np.inf
        fit = fit_capacities(capacity, 1.0)
        assert fit.censored == np.isinf(capacity).sum() > 0
        errors.append([(fit.theta - 0.9) / fit.theta_se, (fit.beta - 0.4) / fit.beta_se])
    assert np.mean(errors, axis=0) == pytest.approx([0.0, 0.0], abs=0.35)  # three times 0.11 of chance
    assert np.std(errors, axis=0) == pytest.approx([1.0, 1.0], abs=0.25)


def test_records_censored_at_intensities_of_their_own() -> None:
    """Records whose chain ended early, each at another intensity that knows nothing of its capacity.

    Against Nelder and Mead's maximum of the likelihood, numerical second derivatives of it, and the true values. To
    censor all at the highest intensity would take the early ends for strong records: theta would be 20 % too large.
    """
    rng = np.random.default_rng(11)
    true = 0.9 * np.exp(0.4 * rng.standard_normal(400))
    last = rng.uniform(0.5, 1.6, 400)
    capacity = np.where(true <= last, true, np.inf)
    fit = fit_capacities(capacity, last)

    def loss(p: np.ndarray) -> float:
        z = (np.log(np.where(true <= last, true, last)) - p[0]) / p[1]
        return -float(np.where(true <= last, norm.logpdf(z) - np.log(p[1]), norm.logsf(z)).sum())

    found = minimize(loss, [0.0, 0.5], method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12}).x
    assert np.log(fit.theta) == pytest.approx(found[0], abs=2e-4)  # SciPy ends its search at steps of 1e-4
    assert fit.beta == pytest.approx(found[1], abs=2e-4)
    h = 1e-3
    second = np.array(
        [
            [
                sum(s * t * loss(found + h * (s * a + t * b)) for s in (1.0, -1.0) for t in (1.0, -1.0)) / (4.0 * h**2)
                for b in np.eye(2)
            ]
            for a in np.eye(2)
        ]
    )
    errors = np.sqrt(np.diag(np.linalg.inv(second)))
    assert [fit.theta_se / fit.theta, fit.beta_se] == pytest.approx(errors, rel=1e-3)  # of the differences
    assert abs(fit.theta - 0.9) < 3.0 * fit.theta_se and abs(fit.beta - 0.4) < 3.0 * fit.beta_se
    assert fit_capacities(capacity, last.max()).theta > 1.1 * 0.9
    assert fit.largest_difference < 0.07  # Kolmogorov's 5 % bound of 400 capacities, 1.36 / 20


def test_a_record_that_does_not_pass_has_a_last_intensity() -> None:
    with pytest.raises(ValueError, match="up to which it has results"):
        fit_capacities([1.0, 2.0, np.inf])


@pytest.mark.parametrize("capacity, words", [([1.0, np.inf], "1 of 2 .*E-FRAG-01"), ([2.0, 2.0, 2.0], "E-FRAG-01")])
def test_too_few_capacities(capacity: list[float], words: str) -> None:
    with pytest.raises(AnalysisError, match=words):
        fit_capacities(capacity, 3.0)


def test_collapse_margin() -> None:
    assert collapse_margin_ratio(1.5, 0.5) == 3.0
