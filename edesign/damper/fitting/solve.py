"""From several starts to one minimum of the errors of a law, by the estimator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from threading import Event
from typing import Literal

import numpy as np

from edesign.damper.fitting.coordinates import Coordinates
from edesign.errors import AnalysisError, InputError
from edesign.estimation.least_squares import Fit, Settings, fit
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter
from edesign.stopping import in_threads

Progress = Callable[[str, int, int], None]
"""What is done, how many of it are done, of how many."""
Loss = Literal["linear", "soft_l1", "huber", "cauchy"]
Errors = Callable[[np.ndarray], Sequence[np.ndarray]]
"""Errors (n_i,) of each test, of coordinates (n,); half the sum of their squares is the cost."""

SAME = 1e-3  # relative difference of costs of one and the same minimum
_NOTHING = 1e-12  # cost of data without noise
_SEARCH = Settings(steps=60, enough=1e-30, relative=1e-5)
_POLISH = Settings(steps=100, enough=1e-30, relative=1e-10, central=True)
"""A search ends at a share of the cost: of 10 000 samples, the polish leaves a thousandth of a standard error."""


class Stopped(Exception):
    """Error that ends a search in another thread when the fit is interrupted."""


@dataclass(frozen=True)
class ErrorModel:
    """Errors of a law as a model of the estimator: what it predicts is to be nothing.

    Attributes:
        coordinates: of the unknowns; nothing is known of them but their bounds.
        errors: of the tests; AnalysisError and InputError where the law gives no force.
        sizes: number of errors of each test.
        loss: "linear" is least squares; the others give errors beyond f_scale less weight, as those of
            scipy.optimize.least_squares.
        f_scale: see loss.
        workers: threads.
    """

    coordinates: Coordinates
    errors: Errors
    sizes: tuple[int, ...]
    loss: Loss = "linear"
    f_scale: float = 1.0
    workers: int = 1

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """Coordinates of the law with flat priors."""
        names, low, high = self.coordinates.names, self.coordinates.lower, self.coordinates.upper
        both = zip(names, low.tolist(), high.tolist(), strict=True)
        return tuple(Parameter(name, "", lower, upper, 0.0, 1.0, flat=True) for name, lower, upper in both)

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Nothing, (n_i,) of each test."""
        return tuple(np.zeros(size) for size in self.sizes)

    @property
    def noise(self) -> Noise:
        """Noise of one: the cost is the objective."""
        return Noise.white([1.0] * len(self.sizes))

    def predict(self, values: np.ndarray) -> list[list[np.ndarray] | PredictionError]:
        """Return errors of each test, such that half their squares are the loss."""
        return list(in_threads(self._one, values, self.workers))

    def nuisance_columns(self, values: np.ndarray) -> list[None]:
        """Return that tests have nothing of their own."""
        return [None] * len(self.sizes)

    def cost(self, x: np.ndarray) -> float:
        """Return half the sum of the losses, infinite where there is none."""
        found = self._one(x)
        total = np.inf if isinstance(found, PredictionError) else 0.5 * sum(float(error @ error) for error in found)
        return total if np.isfinite(total) else np.inf

    def _one(self, x: np.ndarray) -> list[np.ndarray] | PredictionError:
        try:
            return [self.f_scale * _root_of_loss(error / self.f_scale, self.loss) for error in self.errors(x)]
        except (AnalysisError, InputError) as error:
            return PredictionError(str(error))


@dataclass(frozen=True)
class Outcome:
    """Minimum that a search found.

    Attributes:
        fitted: parameters that are coordinates (n,).
        errors: (n_i,) of each test.
        costs: of all starts, ascending.
        same: how many ended at the least.
        iterations, evaluations: of all searches.
    """

    fitted: Fit
    errors: tuple[np.ndarray, ...]
    costs: tuple[float, ...]
    same: int
    iterations: int
    evaluations: int

    @property
    def x(self) -> np.ndarray:
        """Coordinates (n,)."""
        return self.fitted.z

    @property
    def cost(self) -> float:
        """Half the (weighted) sum of squares."""
        return _cost(self.fitted)


def solve(
    coarse: ErrorModel,
    full: ErrorModel,
    candidates: Sequence[np.ndarray],
    starts: int,
    workers: int = 1,
    progress: Progress | None = None,
    canonical: Callable[[np.ndarray], np.ndarray] = lambda x: x,
) -> Outcome:
    """Screen candidates, descend from the best, polish the best of these.

    Args:
        coarse: errors for the search.
        full: errors for the polish, whose loss takes its scale from those at its start.
        candidates: coordinates (n,); the first is a start if the law gives a force with it.
        starts: how many descents.
        workers: threads.
        progress: called at each start.
        canonical: coordinates of the same law in their proper order, where branches can change places.

    Raises:
        AnalysisError: the law gives no force for any candidate.
    """
    report = progress or (lambda what, done, of: None)
    stop, done = Event(), 0

    def unless_stopped(x: np.ndarray) -> Sequence[np.ndarray]:
        if stop.is_set():
            raise Stopped
        return coarse.errors(x)

    search = replace(coarse, errors=unless_stopped)
    screened = list(in_threads(coarse.cost, candidates, workers))
    order = [0, *sorted(range(1, len(candidates)), key=lambda i: screened[i])][: max(starts, 1)]
    chosen = [candidates[i] for i in order if np.isfinite(screened[i])]
    if not chosen:
        raise AnalysisError("the law gives no force for any start of the fit; give other start values [E-FIT-03]")

    def one(x: np.ndarray) -> Fit:
        nonlocal done
        found = fit(search, search.noise, x, settings=_SEARCH)
        done += 1
        report("starts", done, len(chosen))
        return found

    descents = sorted(in_threads(one, chosen, workers, stop), key=_cost)
    report("polish", 0, 1)
    best = descents[0]
    if full.loss != "linear":
        full = replace(full, f_scale=_loss_scale(np.concatenate(full.errors(best.z))))
    last = fit(full, full.noise, canonical(best.z), settings=_POLISH)
    report("polish", 1, 1)
    costs = tuple(map(_cost, descents))
    return Outcome(
        last,
        tuple(full.errors(last.z)),
        costs,
        sum(cost <= costs[0] * (1.0 + SAME) + _NOTHING for cost in costs),
        sum(descent.steps for descent in (*descents, last)),
        sum(descent.evaluations for descent in (*descents, last)) + len(candidates),
    )


def _cost(fitted: Fit) -> float:
    return 0.5 * sum(float(r @ r) for r in fitted.left)


def _loss_scale(error: np.ndarray) -> float:
    """Errors beyond twice the standard deviation that most of them have (by the median) count less."""
    return float(max(2.0 * 1.4826 * np.median(np.abs(error)), 1e-12))


def _root_of_loss(z: np.ndarray, loss: Loss) -> np.ndarray:
    """Return the root, with the sign of the error, of twice the loss."""
    square = z**2
    if loss == "soft_l1":
        return z * np.sqrt(2.0 / (1.0 + np.sqrt(1.0 + square)))
    if loss == "huber":
        return np.where(square <= 1.0, z, np.sign(z) * np.sqrt(np.maximum(2.0 * np.abs(z) - 1.0, 0.0)))
    if loss == "cauchy":
        return np.sign(z) * np.sqrt(np.log1p(square))
    return z
