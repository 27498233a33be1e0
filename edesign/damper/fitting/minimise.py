"""Least squares from several starts: scipy's trust-region fits on dimensionless coordinates."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy

from edesign.stopping import in_threads

Loss = Literal["linear", "soft_l1", "huber", "cauchy"]
Residual = Callable[[np.ndarray], np.ndarray]

_TOLERANCE = 1e-8
"""Relative change of the cost at which a search ends: of 10 000 samples a hundredth of a standard error is left."""


@dataclass(frozen=True)
class Problem:
    """Problem of least squares that is minimised.

    Attributes:
        residual: (m,) of coordinates (n,).
        lower, upper: bounds (n,).
        steps: steps (n,) for differences about coordinates.
    """

    residual: Residual
    lower: np.ndarray
    upper: np.ndarray
    steps: Callable[[np.ndarray], np.ndarray]

    def jacobian(self, x: np.ndarray, at_x: np.ndarray | None = None, workers: int = 1) -> np.ndarray:
        """Return the derivatives (m, n) of the residual by differences.

        Args:
            x: (n,) coordinates.
            at_x: (m,) residual at x, for one-sided differences; None: they are central.
            workers: number of threads.
        """
        steps = self.steps(x)

        def column(j: int) -> np.ndarray:
            high, low = x.copy(), x.copy()
            high[j] = min(x[j] + steps[j], self.upper[j])
            low[j] = max(x[j] - steps[j], self.lower[j])
            if at_x is None:
                return (self.residual(high) - self.residual(low)) / (high[j] - low[j])
            other = high if high[j] - x[j] >= x[j] - low[j] else low
            return (self.residual(other) - at_x) / (other[j] - x[j])

        return np.column_stack(list(in_threads(column, range(x.size), workers)))


@dataclass(frozen=True)
class Descent:
    """End of a descent.

    Attributes:
        x: coordinates (n,).
        cost: half the sum of (weighted) squares.
        iterations: evaluations of the Jacobian.
        evaluations: of the residual.
        converged: whether the search ended by itself.
    """

    x: np.ndarray
    cost: float
    iterations: int
    evaluations: int
    converged: bool


def descend(
    problem: Problem,
    start: np.ndarray,
    loss: Loss = "linear",
    f_scale: float = 1.0,
    most: int = 60,
    central: bool = False,
    workers: int = 1,
    tolerance: float = _TOLERANCE,
) -> Descent:
    """Find the minimum that a descent from one start leads to.

    Args:
        problem: what is minimised.
        start: coordinates (n,), moved inside the bounds.
        loss: see scipy.optimize.least_squares.
        f_scale: residual from which the loss is no longer quadratic, see scipy.optimize.least_squares.
        most: iterations.
        central: whether derivatives are central differences: twice the work, errors of second order.
        workers: threads for the derivatives.
        tolerance: relative change of the cost at which the search ends.

    Returns:
        The minimum, its cost and the work that it took.
    """
    seen: dict[bytes, np.ndarray] = {}
    count = 0

    def residual(x: np.ndarray) -> np.ndarray:
        nonlocal count
        count += 1
        seen.clear()
        seen[x.tobytes()] = value = problem.residual(x)
        return value

    def jacobian(x: np.ndarray) -> np.ndarray:
        nonlocal count
        count += x.size * (2 if central else 1)
        at_x = seen.get(x.tobytes())
        return problem.jacobian(x, None if central else problem.residual(x) if at_x is None else at_x, workers)

    found = scipy.optimize.least_squares(
        residual,
        np.clip(start, problem.lower, problem.upper),
        jac=jacobian,
        bounds=(problem.lower, problem.upper),
        method="trf",
        x_scale="jac",
        loss=loss,
        f_scale=f_scale,
        ftol=tolerance,
        xtol=0.1 * tolerance,
        gtol=1e-12,
        max_nfev=most,
    )
    return Descent(found.x, float(found.cost), int(found.njev), count, found.status > 0)
