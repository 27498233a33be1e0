"""Errors on tests that a model was not fitted to: each test left out in turn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.calibrate.fit import Fitted
from edesign.calibrate.problem import PredictionError

_NEAR = 0.2  # moves of the coordinates up to which the slopes predict what a left-out test would show


@dataclass(frozen=True)
class HeldOut:
    """Errors of each test when the model is fitted to the others.

    Attributes:
        chi2: (tests,) sums of squared residuals, in units of noise.
        samples: (tests,) their numbers.
    """

    chi2: np.ndarray
    samples: np.ndarray

    @property
    def total(self) -> float:
        """Over all tests."""
        return float(self.chi2.sum())

    @property
    def excess(self) -> float:
        """What noise does not explain."""
        return max(self.total - float(self.samples.sum()), 0.0)


def leave_one_out(fitted: Fitted) -> HeldOut:
    """Each test of a fit left out in turn.

    The fit without a test is one Gauss-Newton step from the fit with it; where the step is short the test's residual follows
    from the slopes, else the model is run again. A parameter that no other test shows goes back towards where it was declared.

    Source: Cook and Weisberg (1982), Residuals and Influence in Regression, chapter 5 (one-step approximation).
    """
    model, x = fitted.model, fitted.x
    low, high = (np.array(side) for side in zip(*(u.span for u in model.unknowns), strict=True)) if x.size else (x, x)
    gradients = [j.T @ r for j, r in zip(fitted.slopes, fitted.residuals, strict=True)]
    found = []
    for i, (r, j) in enumerate(zip(fitted.residuals, fitted.slopes, strict=True)):
        if x.size == 0:
            found.append(float(r @ r))
            continue
        move = np.linalg.lstsq(fitted.hessian - j.T @ j, gradients[i], rcond=1e-12)[0]
        move = np.clip(x + np.clip(move, -3.0, 3.0), low, high) - x
        left = r + j @ move
        if np.max(np.abs(move)) > _NEAR:
            try:
                left = model.residuals(x + move)[i]
            except PredictionError:
                found.append(np.inf)
                continue
        found.append(float(left @ left))
    return HeldOut(np.array(found), np.array([r.size for r in fitted.residuals]))
