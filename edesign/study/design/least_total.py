"""The least weighted sum of the dampers of all storeys for which no storey of the frame drifts more than its limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from edesign.errors import AnalysisError

LEAST = 1e-3  # over the stiffness of the storey: every chosen storey keeps a damper
_TRIALS = 50  # equal dampers from the least to the most, of which one is taken where no dampers meet the limit
_STEP = 1e-6  # of the finite differences, over the stiffness of a storey


class OutOfReach(AnalysisError):
    """The estimate asks for no dampers, or says that none are enough.

    Attributes:
        nearest: dampers from which histories may start, over the stiffness of their storey, (s,).
    """

    def __init__(self, message: str, nearest: np.ndarray) -> None:
        estimate = "this is an estimate by the response spectrum: with `verify` histories decide"
        super().__init__(f"{message}; {estimate} [E-DESIGN-04]")
        self.nearest = nearest


@dataclass(frozen=True)
class Problem:
    """A constrained minimisation of the total size of the dampers.

    Attributes:
        used: drift over its limit of each storey of the frame for dampers of a size, (s,).
        unit: sizes of which a storey has x, (s,), those proportional to its stiffness.
        weight: of each x in the sum, (s,).
        drift: the limit, for messages.
        most: largest x.
        subject: of x for messages, such as "dampers".
        summed: what the sum is of, such as "area".
        nearest: whether the dampers nearest to the limit are taken where the estimate knows no others.
    """

    used: Callable[[np.ndarray], np.ndarray]
    unit: np.ndarray
    weight: np.ndarray
    drift: float
    most: float
    subject: str
    summed: str
    nearest: bool


def least_total(problem: Problem, start: np.ndarray | None = None) -> np.ndarray:
    """Return the dampers (s,) of least sum that meet the limit; sequential quadratic programming finds a local optimum.

    Args:
        start: sizes (s,) where the search begins; None: equal x that meet the limit.

    Raises:
        OutOfReach: the estimated drift is met without dampers, or no dampers meet it, or the search stopped; unless the
            nearest are asked for.
    """
    try:
        return _least(problem, None if start is None else start / problem.unit) * problem.unit
    except OutOfReach as error:
        if not problem.nearest:
            raise
        return error.nearest * problem.unit


def _least(problem: Problem, start: np.ndarray | None) -> np.ndarray:
    """The x (s,) of least sum, from a start."""
    weight, most = problem.weight / problem.weight.sum(), problem.most

    def spare(x: np.ndarray) -> np.ndarray:
        return 1.0 - problem.used(x * problem.unit)

    def gradient(x: np.ndarray) -> np.ndarray:
        columns = [(spare(x + _STEP * e) - spare(x - _STEP * e)) / (2.0 * _STEP) for e in np.eye(x.size)]
        return np.array(columns).T

    x0 = _equal(problem, spare) if start is None else start
    found = scipy.optimize.minimize(
        lambda x: float(weight @ x),
        x0,
        jac=lambda x: weight,
        bounds=[(LEAST, most)] * weight.size,
        constraints=[{"type": "ineq", "fun": spare, "jac": gradient}],
        method="SLSQP",
        options={"ftol": 1e-10, "maxiter": 200},
    )
    x = np.asarray(found.x)
    if spare(x).min() < -1e-6:
        message = f"the search for the least {problem.summed} stopped outside the drift limit: {found.message}"
        raise OutOfReach(message, x)
    return x


def _equal(problem: Problem, spare: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    """Equal x of all storeys that just meet the limit."""
    first = np.ones(problem.weight.size)
    if spare(LEAST * first).min() >= 0.0:
        message = f"the estimated drift stays below {100.0 * problem.drift:.4g} % without dampers"
        raise OutOfReach(message, LEAST * first)
    if spare(problem.most * first).min() < 0.0:
        most = problem.drift * (1.0 - float(spare(problem.most * first).min()))
        trials = np.geomspace(LEAST, problem.most, _TRIALS)
        best = trials[int(np.argmax([spare(scale * first).min() for scale in trials]))]
        raise OutOfReach(
            f"{problem.subject} {problem.most:g} times as stiff as the storeys still leave an estimated drift of "
            f"{100.0 * most:.4g} %; the limit is {100.0 * problem.drift:.4g} %",
            best * first,
        )
    scale = scipy.optimize.brentq(lambda s: float(spare(s * first).min()), LEAST, problem.most, xtol=1e-6)
    return np.asarray(scale * first)
