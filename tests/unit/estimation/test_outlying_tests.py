"""The test that agrees least with the others: its squares, how often chance makes one, and how surely a fault is."""

from __future__ import annotations

import numpy as np
import pytest
from estimation_models import FormulaModel, free, linear, normal
from scipy.stats import t as student

from edesign.estimation.least_squares import fit
from edesign.estimation.left_out import Score, difference
from edesign.estimation.noise import Noise
from edesign.estimation.outlier import Outlier, outlier

Lists = list[np.ndarray]


def campaign_of(
    random: np.random.Generator, tests: int, scatter: float = 0.0, faulty: float = 0.0, quiet: float = 1.0
) -> tuple[Lists, Lists, list[float], Outlier | None]:
    """Forces k u + c v + F of tests of other sizes and lengths; noise known to a quarter; all gains scatter."""
    matrices, measured, deviations = Lists(), Lists(), list[float]()
    for i in range(tests):
        t = np.arange(random.integers(150, 400)) / 50.0
        f, a = random.uniform(0.3, 1.5), random.uniform(0.5, 3.0)
        u, v = a * np.sin(2.0 * np.pi * f * t), a * f * np.cos(2.0 * np.pi * f * t)
        matrix = np.column_stack((u, v, np.ones_like(t)))
        gain = 1.0 + scatter * random.standard_normal() + (faulty if i == 1 else 0.0)
        noise = 0.02 / quiet * np.exp(0.5 * random.standard_normal())
        measured.append(gain * matrix @ (2.0, 0.7, 0.1) + noise * random.standard_normal(t.size))
        matrices.append(matrix)
        deviations.append(noise * np.exp(0.25 * random.standard_normal()))
    white = Noise.white(deviations)
    return matrices, measured, deviations, outlier(fit(linear(matrices, measured, free("kcF")), white), white)


def test_the_ratio_of_a_test_is_that_of_fits_without_it() -> None:
    """By weighted least squares of numpy: Chow's form r' (I + X (X'X)^-1 X')^-1 r of a test left out (1960).

    Its part along the slopes X of that test is the same of Q'r, with Q an orthogonal basis of X.
    """
    matrices, measured, deviations, found = campaign_of(np.random.default_rng(5), 4, 0.03, 0.1)
    x = [m / s for m, s in zip(matrices, deviations, strict=True)]
    y = [m / s for m, s in zip(measured, deviations, strict=True)]
    share = [1.0 / np.sum(one**2) for one in y]

    def excess(test: int, others: list[int]) -> tuple[float, float]:
        every = np.vstack([x[k] for k in others])
        r = y[test] - x[test] @ np.linalg.lstsq(every, np.concatenate([y[k] for k in others]), rcond=None)[0]
        covariance = np.eye(r.size) + x[test] @ np.linalg.inv(every.T @ every) @ x[test].T
        q = np.linalg.qr(x[test])[0]
        along = (q.T @ r) @ np.linalg.solve(q.T @ covariance @ q, q.T @ r)
        return (float(r @ np.linalg.solve(covariance, r)) - r.size) * share[test], (along - 3.0) * share[test]

    least = {}
    for i in range(4):
        others = [k for k in range(4) if k != i]
        b = np.mean([max(excess(j, [k for k in others if k != j])[1], 0.0) for j in others])
        whole, part = np.min([excess(i, [k for k in others if k != j]) for j in others], axis=0)
        noise = np.sqrt(max(whole, 0.0) / (np.sqrt(0.2) * y[i].size * share[i]))
        ratio = np.sqrt(max(part, 0.0) / (np.sqrt(2.0 * 3.0 + 0.2 * 9.0) * share[i] + b))
        least[i] = ratio, min(1.0, 4.0 * 2.0 * max(student.sf(noise, 10.0), student.sf(ratio, 2.0)))
    assert found is not None and found.test == min(least, key=lambda i: least[i][1])
    assert (found.ratio, found.chance) == pytest.approx(least[found.test], rel=1e-5)


@pytest.mark.parametrize("tests", [3, 4, 5, 9])
def test_the_largest_ratio_of_gains_that_scatter_has_its_bound(tests: int) -> None:
    """Gains are all that differs: in simulations a hundredth of the ratios lies beyond Student's quantile, or less."""
    gains = np.random.default_rng(3).standard_normal((100_000, tests))
    largest = np.zeros(len(gains))
    for i in range(tests):
        others = [j for j in range(tests) if j != i]
        of_rest = (gains.sum(axis=1, keepdims=True) - gains[:, [i]] - gains[:, others]) / (tests - 2)
        own = np.min((gains[:, [i]] - of_rest) ** 2, axis=1)
        largest = np.maximum(largest, own / np.mean((gains[:, others] - of_rest) ** 2, axis=1))
    beyond = np.mean(np.sqrt(largest) > student.isf(0.01 / (2.0 * tests), tests - 2.0))
    assert 0.006 < beyond < 0.0105


@pytest.mark.parametrize(("scatter", "quiet"), [(0.0, 1.0), (0.05, 1.0), (0.02, 5.0), (0.08, 5.0)])
def test_chance_and_scatter_from_test_to_test_make_no_outlier(scatter: float, quiet: float) -> None:
    """One alarm in a hundred campaigns at most: of 80, four or more have a chance below 1 %."""
    random = np.random.default_rng(7)
    found = [campaign_of(random, int(random.integers(3, 8)), scatter, quiet=quiet)[3] for _ in range(80)]
    assert sum(one is not None and one.sure for one in found) <= 3


@pytest.mark.parametrize(
    ("tests", "faulty", "quiet", "least"), [(3, 0.25, 4.0, 14), (4, 0.12, 1.0, 16), (6, 0.05, 1.0, 14)]
)
def test_a_fault_in_one_test_is_found_beside_others_that_leave_noise(
    tests: int, faulty: float, quiet: float, least: int
) -> None:
    """Of three, two must agree to 1/190 of the fault, and each alone determine the law: not all motions here do."""
    random = np.random.default_rng(8)
    found = [campaign_of(random, tests, 0.0, faulty, quiet)[3] for _ in range(20)]
    assert sum(one is not None and one.sure and one.test == 1 for one in found) >= least
    assert not any(one is not None and one.sure and one.test != 1 for one in found)


def test_others_are_compared_beside_the_fault_that_explains_a_test() -> None:
    """Of a linear law it makes little of a difference to the ratio whether the others are left out with that test."""
    for seed in range(4):
        matrices, measured, deviations, alone = campaign_of(np.random.default_rng(20 + seed), 6, faulty=0.12)
        white = Noise.white(deviations)
        gain = [1.0 if i == 1 else 0.0 for i in range(6)]

        def forces(v: np.ndarray, matrices: Lists = matrices, gain: list[float] = gain) -> Lists:
            return [(1.0 + g * v[3]) * (m @ v[:3]) for m, g in zip(matrices, gain, strict=True)]

        faulty = fit(FormulaModel((*free("kcF"), *normal("g")), tuple(measured), forces), white)
        found = outlier(fit(linear(matrices, measured, free("kcF")), white), white, (1, faulty))
        assert alone is not None and found is not None and found.test == 1
        assert found.ratio > 0.8 * alone.ratio or alone.test != 1


def test_of_two_tests_none_is_the_outlier() -> None:
    assert campaign_of(np.random.default_rng(9), 2, faulty=0.5)[3] is None


def test_the_log_prior_of_a_place_is_part_of_the_score() -> None:
    one = Score(np.array([-3.0, -5.0]), np.array([-2.0, -4.0]), log_prior=-np.log(6.0))
    none = Score(np.array([-7.0, -9.0]), np.array([-6.0, -8.0]))
    assert one.total == pytest.approx(-8.0 - np.log(6.0))
    assert difference(one, none).total == pytest.approx(8.0 - np.log(6.0))
