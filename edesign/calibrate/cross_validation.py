"""Errors on tests that a model was not fitted to: each test left out in turn."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibrate.fit import Fitted
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.side_by_side import brief_side_by_side

FEWEST = 3
"""Tests of which each is left out as a whole: two others remain, so that what acts between tests still shows."""

_PARTS = 4  # of each, if there are fewer
_NOTHING = 1e-12
_HALVINGS = 5
_NEAR = 0.2  # moves of the coordinates up to which the slopes predict what a left-out test would show


@dataclass(frozen=True)
class HeldOut:
    """Errors of each test when the model is fitted to the others.

    Attributes:
        chi2: (tests,) sums of squared residuals, in units of noise; of fewer than `FEWEST` tests (quarters,).
        samples: (tests,) their numbers.
    """

    chi2: np.ndarray
    samples: np.ndarray

    @property
    def ratio(self) -> np.ndarray:
        """(tests,) squared residual per sample, in units of noise: 1 where only noise is left."""
        return np.maximum(self.chi2 / self.samples, _NOTHING)

    @property
    def score(self) -> float:
        """Sum over tests of n ln(chi2 / n): the predictive log-likelihood, each test with the scatter it shows.

        A test that alone tells a parameter is predicted badly when it is left out; its sum of squares would drown all
        others'.
        """
        return float(self.samples @ np.log(self.ratio))


def leave_one_out(fitted: Fitted) -> HeldOut:
    """Each test of a fit left out in turn; of fewer than `FEWEST` tests their quarters: a single other one is too few.

    The fit without a test is one Gauss-Newton step from the fit with it; where the step is short the test's residual
    follows from the slopes, else the model is run again, and the step is halved until the other tests are fitted no
    worse than before it. A parameter that no other test shows goes back towards where it was declared.

    Source: Cook and Weisberg (1982), Residuals and Influence in Regression, chapter 5 (one-step approximation).
    """
    model, x = fitted.model, fitted.x
    low, high = (np.array(side) for side in zip(*(u.span for u in model.unknowns), strict=True)) if x.size else (x, x)
    found, samples, far = [], [], []
    for i, block in _blocks(fitted):
        r, j = fitted.residuals[i][block], fitted.slopes[i][block]
        samples.append(r.size)
        if x.size == 0:
            found.append(float(r @ r))
            continue
        move = np.linalg.lstsq(fitted.hessian - j.T @ j, j.T @ r, rcond=1e-12)[0]
        move = np.clip(x + np.clip(move, -3.0, 3.0), low, high) - x
        if np.max(np.abs(move)) > _NEAR:
            far.append((len(found), move, i, block))
        left = r + j @ move
        found.append(float(left @ left))
    again = brief_side_by_side(lambda one: _after(fitted, *one[1:]), far, model.workers)
    for (place, *_), chi2 in zip(far, again, strict=True):
        found[place] = chi2
    return HeldOut(np.array(found), np.array(samples))


def _after(fitted: Fitted, move: np.ndarray, i: int, block: slice) -> float:
    """Sum of squared residuals of what is left out, after a move of the coordinates that a fit to the rest asks for."""
    model, x, found = fitted.model, fitted.x, math.inf
    before = _of_rest(fitted, x, fitted.residuals, i, block)
    for _ in range(_HALVINGS):
        try:
            residuals = model.residuals(x + move)
        except PredictionError:
            residuals = None
        if residuals is not None:
            found = float(residuals[i][block] @ residuals[i][block])
            if _of_rest(fitted, x + move, residuals, i, block) <= before:
                break
        move = 0.5 * move
    return found


def _of_rest(fitted: Fitted, x: np.ndarray, residuals: Sequence[np.ndarray], i: int, block: slice) -> float:
    """What a fit to the rest makes small."""
    left_out = residuals[i][block]
    return fitted.model.cost(residuals, x) - float(left_out @ left_out)


def _blocks(fitted: Fitted) -> Iterator[tuple[int, slice]]:
    """What is left out at a time: number of a test, and its samples."""
    few = len(fitted.residuals) < FEWEST
    for i, residual in enumerate(fitted.residuals):
        edges = np.linspace(0, residual.size, _PARTS + 1 if few else 2).astype(int)
        for first, last in itertools.pairwise(edges.tolist()):
            yield i, slice(first, last)
