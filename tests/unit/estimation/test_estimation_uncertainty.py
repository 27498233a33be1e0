"""Intervals hold the truth as often as they say; what is known only together is named."""

from __future__ import annotations

import numpy as np
import pytest
from estimation_models import FormulaModel, linear, normal
from scipy.signal import lfilter

from edesign.estimation.least_squares import Settings, fit
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter
from edesign.estimation.uncertainty import at_bounds, uncertainty

TIGHT = Settings(enough=1e-12, steps=100)


@pytest.mark.parametrize(("tests", "bias"), [(8, 0.0), (4, 0.0), (8, 0.3)])
def test_intervals_cover_with_correlated_residuals(tests: int, bias: float) -> None:
    """AR(1) noise of correlation 0.95, and a model wrong by another share in each test.

    The interval is the wider one of two: at least 95 % of 150 simulations, less three standard errors (5.3 %).
    """
    generator, held, n = np.random.default_rng(11), [], 200
    x = [
        np.column_stack((np.sin(np.arange(n) / (5.0 + i)), np.cos(np.arange(n) / (9.0 - 0.5 * i))))
        for i in range(tests)
    ]
    truth = np.array([1.0, -0.5])
    for _ in range(150):
        noise = lfilter([1.0], [1.0, -0.95], 0.05 * generator.standard_normal((tests, n + 200)), axis=1)[:, 200:]
        own = truth + bias * generator.standard_normal((tests, 2))
        measured = [a @ v + e for a, v, e in zip(x, own, noise, strict=True)]
        model = linear(x, measured, normal("ab", 10.0))
        found = fit(model, Noise.white([1.0] * tests))
        found = fit(model, Noise.left_by(found.left, [0.01] * tests, [0.8] * tests), found)
        reported = uncertainty(found)
        held.append(
            [low < value < high for value, (low, high) in zip(truth, map(reported.interval, range(2)), strict=True)]
        )
    assert np.all(np.mean(held, axis=0) > 0.95 - 0.053)


def test_intervals_hold_the_truth_where_an_equation_is_wrong() -> None:
    """Shares b ~ N(0, a^2) of two columns that the model has not, of an amplitude a from its prior, and noise.

    The reference is generalised least squares of all samples, with the covariance s^2 I + a^2 C C', and the likelihood
    of that a: the mean square of what it moves the estimate by, over a fine grid of a. No code of the package is used.
    """
    generator, n, tests, share = np.random.default_rng(5), 60, 6, 0.2
    x = [np.sin(np.arange(n) / (4.0 + i))[:, np.newaxis] for i in range(tests)]
    wrong = [np.column_stack((2.0 * one[:, 0] + np.cos(np.arange(n) / 3.0), np.cos(np.arange(n) / 5.0))) for one in x]
    every, beside = np.vstack(x), np.vstack(wrong)
    grid = np.geomspace(1e-4, 1.0, 300)
    prior = np.log(grid / (1.0 + (grid / share) ** 2))
    u, s, _ = np.linalg.svd(beside, full_matrices=False)
    held, alone, wide, narrow = [], [], [], []
    for k in range(300):
        amplitude = min(share * np.tan(0.5 * np.pi * generator.uniform()), 1.0) if k % 2 else 0.0
        b = amplitude * generator.standard_normal(2)
        measured = [a[:, 0] + c @ b + 0.1 * generator.standard_normal(n) for a, c in zip(x, wrong, strict=True)]
        found = fit(linear(x, measured, normal("a", 1e3)), Noise.white([0.1] * tests), settings=TIGHT)
        reported = uncertainty(found, wrong=wrong, share=share)
        if k < 6:
            y, log, square = np.concatenate(measured), prior.copy(), np.zeros_like(grid)
            for i, a in enumerate(grid):
                gain = a**2 * s**2 / (0.01 + a**2 * s**2)
                precise = [(one - u @ (gain * (u.T @ one))) / 0.01 for one in (every[:, 0], y)]
                normal_matrix = every[:, 0] @ precise[0]
                best = precise[0] @ y / normal_matrix
                log[i] -= 0.5 * (np.log1p((a * s) ** 2 / 0.01).sum() + y @ precise[1] - best**2 * normal_matrix)
                log[i] -= 0.5 * np.log(normal_matrix)
                square[i] = (best - 1e3 * found.z[0]) ** 2 + 1.0 / normal_matrix - 0.01 / (every[:, 0] @ every[:, 0])
            odds = np.exp(log - log.max())
            assert 1e6 * reported.moved[0, 0] == pytest.approx(odds @ square / odds.sum(), rel=0.02)
        low, high = reported.interval(0)
        (held if k % 2 else narrow).append(low < 1.0 < high)
        wide.append((high - low) / np.subtract(*uncertainty(found).interval(0)[::-1]))
        if k % 2:
            low, high = uncertainty(found).interval(0)
            alone.append(low < 1.0 < high)
    assert min(np.mean(held), np.mean(narrow)) > 0.95 - 3.0 * np.sqrt(0.05 * 0.95 / 150)
    assert np.mean(alone) < 0.5
    assert np.median(wide[::2]) < 2.0 and np.median(wide[1::2]) > 4.0  # the tests show whether the equation holds


def test_blocks_stand_for_tests_where_there_is_one() -> None:
    generator = np.random.default_rng(2)
    x = generator.standard_normal((400, 2))
    model = linear([x], [x @ [1.0, 2.0] + generator.standard_normal(400)], normal("ab", 10.0))
    found = fit(model, Noise.white([1.0]), settings=TIGHT)
    assert uncertainty(found).pulls.shape == (4, 2) and uncertainty(found, blocks=[7]).pulls.shape == (7, 2)
    inverse = np.linalg.inv(x.T @ x + 0.01 * np.eye(2)) / 10.0**2  # of coordinates, by blocks: White's covariance
    scores = np.array([10.0 * x[i::4].T @ found.left[0][i::4] for i in range(4)])
    assert scores.shape == (4, 2)
    blocks = np.array([10.0 * part.T @ r for part, r in zip(np.split(x, 4), np.split(found.left[0], 4), strict=True)])
    expected = inverse @ (np.cov(blocks.T, ddof=1) * 4) @ inverse
    np.testing.assert_allclose(uncertainty(found).between, expected, rtol=1e-6)


def test_a_product_is_known_and_its_factors_only_together() -> None:
    """Friction mu N: the product is determined to a percent, mu and N to a decade by their priors alone."""
    generator, v = np.random.default_rng(4), np.sign(np.sin(np.arange(300) / 7.0))
    parameters = (
        Parameter("mu", "", 0.0, np.inf, 0.3, 1.5, logarithmic=True),
        Parameter("N", "N", 0.0, np.inf, 100e3, 1.5, logarithmic=True),
        Parameter("k", "", -np.inf, np.inf, 0.0, 1e5),
    )
    measured = tuple(30e3 * v + 3e3 * generator.standard_normal(300) for _ in range(3))
    model = FormulaModel(parameters, measured, lambda p: [p[0] * p[1] * v + p[2] * np.cos(np.arange(300.0))] * 3)
    found = fit(model, Noise.white([3e3] * 3), settings=TIGHT)
    reported = uncertainty(found)
    assert [reported.determined(i) for i in range(3)] == [False, False, True]
    assert reported.loose == pytest.approx([1.0, 1.0, 0.0], abs=1e-3)
    assert found.values[0] * found.values[1] == pytest.approx(30e3, rel=0.02)
    assert reported.half_width(np.array([1.5, 1.5, 0.0])) < 0.05
    low, high = reported.interval(0)
    assert high / low > 10.0


def test_a_parameter_at_its_bound_is_known_unless_it_is_asked_for() -> None:
    generator = np.random.default_rng(6)
    x = [generator.standard_normal((50, 2)) for _ in range(4)]
    measured = [a @ [1.0, -0.05] + 0.5 * generator.standard_normal(50) for a in x]
    parameters = (*normal("a"), Parameter("b", "", 0.0, 5.0, 1.0, 1.0))
    found = fit(linear(x, measured, parameters), Noise.white([0.5] * 4), settings=TIGHT)
    assert at_bounds(found) == ("", "lower")
    assert uncertainty(found).interval(1) == (0.0, 0.0)
    low, high = uncertainty(found, size_of=range(1, 2)).interval(1)
    assert low == 0.0 and 0.05 < high < 0.5


def test_scheffe_widens_what_was_chosen() -> None:
    generator = np.random.default_rng(7)
    x = [generator.standard_normal((50, 3)) for _ in range(6)]
    measured = [a @ np.ones(3) + generator.standard_normal(50) for a in x]
    reported = uncertainty(fit(linear(x, measured, normal("abc")), Noise.white([1.0] * 6), settings=TIGHT))
    one = np.eye(3)[0]
    assert reported.half_width(one, joint=3) > 1.3 * reported.half_width(one) > 1.3 * reported.standard_error(one)
