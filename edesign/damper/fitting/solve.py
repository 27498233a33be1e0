"""From several starts to one minimum, with parameters set on their bounds where the data push them there."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from threading import Event

import numpy as np

from edesign.damper.fitting.coordinates import Coordinates
from edesign.damper.fitting.minimise import Descent, Loss, Problem, descend
from edesign.errors import AnalysisError
from edesign.stopping import in_threads

Progress = Callable[[str, int, int], None]
"""What is done, how many of it are done, of how many."""

SAME = 1e-3  # relative difference of costs of one and the same minimum
FAILED = 10.0  # error, in measured forces, of parameters for which a law gives no force
_NOTHING = 1e-12  # cost of data without noise
_SEARCH_TOLERANCE = 1e-5
_POLISH = 100  # iterations at most
_NEAR = 0.02  # of a bound, in coordinates, where it is tried whether the bound itself is as good
_AS_GOOD = 1e-6  # relative cost


class Stopped(Exception):
    """Error that ends a search in another thread when the fit is interrupted."""


@dataclass(frozen=True)
class Outcome:
    """Minimum that a search found.

    Attributes:
        x: coordinates (n,).
        free: numbers of those that are not at a bound.
        residual: (m,).
        jacobian: (m, len(free)).
        loss_weight: (m,) derivative of the loss.
        cost: half the weighted sum of squares.
        costs: of all starts, ascending.
        same: how many ended at the least.
        iterations, evaluations: of all searches.
        converged: whether the last one ended by itself.
    """

    x: np.ndarray
    free: tuple[int, ...]
    residual: np.ndarray
    jacobian: np.ndarray
    loss_weight: np.ndarray
    cost: float
    costs: tuple[float, ...]
    same: int
    iterations: int
    evaluations: int
    converged: bool


def solve(
    coordinates: Coordinates,
    coarse: Callable[[np.ndarray], np.ndarray],
    full: Callable[[np.ndarray], np.ndarray],
    candidates: Sequence[np.ndarray],
    starts: int,
    loss: Loss = "linear",
    workers: int = 1,
    progress: Progress | None = None,
    canonical: Callable[[np.ndarray], np.ndarray] = lambda x: x,
) -> Outcome:
    """Screen candidates, descend from the best, polish the best of these.

    Args:
        coordinates: of the unknowns.
        coarse: residual for the search; raises AnalysisError nowhere: FAILED stands for it.
        full: residual for the polish.
        candidates: coordinates (n,); the first is always a start.
        starts: how many descents.
        loss: of the polish; the search takes squares, whose scale then sets that of the loss.
        workers: threads.
        progress: told of every start.
        canonical: coordinates of the same law in their proper order, where branches can change places.

    Raises:
        AnalysisError: the law gives no force for any candidate.
    """
    tell = progress or (lambda what, done, of: None)
    stop = Event()

    def unless_stopped(x: np.ndarray) -> np.ndarray:
        if stop.is_set():
            raise Stopped
        return coarse(x)

    search = Problem(unless_stopped, coordinates.lower, coordinates.upper, coordinates.steps)
    screened = list(in_threads(lambda x: float(np.sum(coarse(x) ** 2)), candidates, workers))
    rest = sorted(range(1, len(candidates)), key=lambda i: screened[i])
    chosen = [candidates[0], *(candidates[i] for i in rest[: max(starts, 1) - 1])]
    if min(screened) >= 0.99 * FAILED**2:
        raise AnalysisError("the law gives no force for any start of the fit; give other start values")
    done = 0

    def one(x: np.ndarray) -> Descent:
        nonlocal done
        found = descend(search, x, tolerance=_SEARCH_TOLERANCE)
        done += 1
        tell("starts", done, len(chosen))
        return found

    descents = list(in_threads(one, chosen, workers, stop))
    tell("polish", 0, 1)
    best = min(descents, key=lambda descent: descent.cost)
    same = sum(descent.cost <= best.cost * (1.0 + SAME) + _NOTHING for descent in descents)
    polish = Problem(full, coordinates.lower, coordinates.upper, coordinates.steps)
    f_scale = _loss_scale(full(best.x)) if loss != "linear" else 1.0
    last = descend(polish, canonical(best.x), loss, f_scale, _POLISH, central=True, workers=workers)
    last, fixed = _to_bounds(polish, last, loss, f_scale, workers)
    free = tuple(i for i in range(last.x.size) if i not in fixed)
    residual = full(last.x)
    jacobian = _part(polish, last.x, free).jacobian(last.x[list(free)], None, workers)
    tell("polish", 1, 1)
    return Outcome(
        last.x,
        free,
        residual,
        jacobian,
        _loss_weight(residual / f_scale, loss),
        last.cost,
        tuple(sorted(descent.cost for descent in descents)),
        same,
        sum(descent.iterations for descent in descents) + last.iterations,
        sum(descent.evaluations for descent in descents) + last.evaluations + len(candidates),
        last.converged,
    )


def _to_bounds(
    problem: Problem, found: Descent, loss: Loss, f_scale: float, workers: int
) -> tuple[Descent, frozenset[int]]:
    """Set parameters near a bound on it where that is as good: a trust-region search only comes near to bounds."""
    fixed: set[int] = set()
    for i in range(found.x.size):
        for bound in (problem.lower[i], problem.upper[i]):
            if np.isfinite(bound) and abs(found.x[i] - bound) < _NEAR:
                x = found.x.copy()
                x[i] = bound
                free = tuple(j for j in range(x.size) if j not in fixed | {i})
                if not free:
                    continue
                part = _part(problem, x, free)
                tried = descend(part, x[list(free)], loss, f_scale, central=True, workers=workers)
                if tried.cost <= found.cost * (1.0 + _AS_GOOD) + _NOTHING**2:
                    x[list(free)] = tried.x
                    counted = found.evaluations + tried.evaluations
                    found = replace(tried, x=x, evaluations=counted, iterations=found.iterations + tried.iterations)
                    fixed.add(i)
                    break
    return found, frozenset(fixed)


def _part(problem: Problem, x: np.ndarray, free: tuple[int, ...]) -> Problem:
    """The problem in some of its unknowns, the others held at x."""
    index = list(free)

    def whole(part: np.ndarray) -> np.ndarray:
        full = x.copy()
        full[index] = part
        return full

    return Problem(
        lambda part: problem.residual(whole(part)),
        problem.lower[index],
        problem.upper[index],
        lambda part: problem.steps(whole(part))[index],
    )


def _loss_scale(residual: np.ndarray) -> float:
    """Errors beyond twice the standard deviation that most of them have (by the median) count less."""
    return float(max(2.0 * 1.4826 * np.median(np.abs(residual)), 1e-12))


def _loss_weight(z: np.ndarray, loss: Loss) -> np.ndarray:
    square = z**2
    if loss == "soft_l1":
        return (1.0 + square) ** -0.5
    if loss == "huber":
        return np.where(square <= 1.0, 1.0, 1.0 / np.maximum(np.abs(z), 1.0))
    if loss == "cauchy":
        return 1.0 / (1.0 + square)
    return np.ones_like(z)
