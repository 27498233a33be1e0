"""Verdicts of a calibration, from what the loop leaves in tests fitted to and in others."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from linear_problem import linear

from edesign.calibrate.evidence import Judged, most_of_one
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.outcome import verdict_of, worst_of
from edesign.calibrate.problem import Piece
from edesign.calibrate.result import Errors, Worst

FLOOR = 1e-4
BAD = Worst("test_01", 30.0 * FLOOR, FLOOR)


def _found(adopted: int, left: float, ending: str = "complete") -> Any:
    """A selection with so many effects that leaves so many times the noise in the tests fitted to."""
    return SimpleNamespace(
        adopted=(object(),) * adopted,
        final=SimpleNamespace(left=left, fitted=SimpleNamespace(reduced=left)),
        ending=ending,
    )


@pytest.mark.parametrize(
    ("adopted", "left", "validate", "verdict"),
    [
        (0, 1.0, 1.0, "none"),
        (0, 8.0, 0.99, "unexplained"),  # in tests fitted to alone: the law does not follow these
        (0, 8.0, 1.01, "unexplained"),
        (0, 1.0, 30.0, "unexplained"),  # fitted away, and back in the tests that were not fitted to
        (1, 1.0, 1.0, "explained"),
        (1, 1.0, 1.49, "explained"),
        (1, 1.0, 1.51, "partly_explained"),
        (0, 1.0, 1.99, "none"),  # effects claim more than their absence does
        (0, 1.0, 2.01, "unexplained"),
        (1, 8.0, 1.0, "partly_explained"),
        (1, 1.0, 30.0, "partly_explained"),
    ],
)
def test_verdict(adopted: int, left: float, validate: float, verdict: str) -> None:
    errors = Errors(fit=left * FLOOR, validate=validate * FLOOR, tests={})
    assert verdict_of(_found(adopted, left), errors, {"fit": FLOOR, "validate": FLOOR}, None) == verdict


@pytest.mark.parametrize(("adopted", "verdict"), [(0, "unexplained"), (1, "partly_explained")])
def test_no_verdict_is_better_than_the_worst_test_allows(adopted: int, verdict: str) -> None:
    errors = Errors(fit=FLOOR, validate=FLOOR, tests={})
    assert verdict_of(_found(adopted, 1.0), errors, {"fit": FLOOR, "validate": FLOOR}, BAD) == verdict


def test_one_test_among_many_is_found_though_all_together_are_at_the_floor() -> None:
    """One of 24 tests has five times the power of its noise: the mean over all has (23 + 5) / 24 = 1.17."""
    problem = linear(tests=24)
    quiet = problem.measured
    random = np.random.default_rng(2)
    loud = [values + (2.0 * random.standard_normal(values.size) if i == 3 else 0.0) for i, values in enumerate(quiet)]
    problem.measured = tuple(loud)
    held = Model(problem, (1.0,) * 24, held=False)
    judged = Judged(fit(held, held.coordinates()))
    assert problem.left(judged.fitted.residuals, (1.0,) * 24) < 1.2
    assert not judged.at_floor
    found = SimpleNamespace(final=judged, adopted=())
    predicted = [
        values for values in problem.predict(judged.fitted.base, (), ("fit", "validate")) if values is not None
    ]
    worst = worst_of(found, (1.0,) * 24, problem, predicted)
    assert worst is not None and worst.name == "test 3"
    assert worst.times == pytest.approx(5.0, rel=0.3)  # 200 samples: 10 % one standard deviation
    problem.measured = quiet
    predicted = [
        values for values in problem.predict(judged.fitted.base, (), ("fit", "validate")) if values is not None
    ]
    assert worst_of(found, (1.0,) * 24, problem, predicted) is None


def test_channels_of_a_test_are_judged_apart() -> None:
    """Of four channels one has four times the power of its noise, all together 1.75 times."""
    problem = linear(tests=6)
    noise = np.random.default_rng(3).standard_normal((6, 200))
    noise[2, 150:] *= 2.0
    predicted = [values - own for values, own in zip(problem.measured, noise, strict=True)]
    found = SimpleNamespace(
        final=SimpleNamespace(fitted=SimpleNamespace(model=SimpleNamespace(problem=problem), parts=())), adopted=()
    )
    assert worst_of(found, (1.0,) * 6, problem, predicted) is None
    channels = tuple(Piece(f"channel {i}", slice(50 * i, 50 * (i + 1))) for i in range(4))
    problem.judged = lambda index: channels  # type: ignore[method-assign]
    worst = worst_of(found, (1.0,) * 6, problem, predicted)
    assert worst is not None and worst.name == "channel 3"


@pytest.mark.parametrize("samples", [3, 12, 500])
def test_chance_makes_few_tests_seem_to_be_above_their_floor(samples: int) -> None:
    """Of twenty tests with noise alone, one is above MOST = 1 times that in one campaign of a hundred: 400 of them."""
    power = np.mean(np.random.default_rng(samples).standard_normal((400, 20, samples)) ** 2, axis=2)
    most = most_of_one(samples, 20, True) / 1.5
    assert np.count_nonzero(power.max(axis=1) > most) <= 11  # 4 expected, one in 2000 times more than 11
