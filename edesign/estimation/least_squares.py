"""Bounded least squares with priors: the estimator of all laws, effects and structures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeGuard

import numpy as np

from edesign.estimation.model import Model, PredictionError, columns_near, predict_near
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import priors_of, ranges_of, values_of

Tests = Sequence[np.ndarray]
"""An array of each test."""


@dataclass(frozen=True)
class Settings:
    """Numbers of the estimator.

    Attributes:
        difference: longest step of differences, in prior standard deviations. Errors of a fixed-step integration vanish
            beside it, and so does curvature. Where one conditional standard error is less, the step is that.
        central: whether differences are central: twice the work, errors of second order.
        steps: most of them in one search.
        enough: decrease of the objective (a log density) that ends a search when no step is promised more: a tenth of
            what a parameter of one standard error changes.
        relative: such a decrease as a share of the objective, where the size of the noise is not known.
        rough: whether slopes at the end may be those that steps have updated.
    """

    difference: float = 1e-3
    central: bool = False
    steps: int = 20
    enough: float = 0.05
    relative: float = 0.0
    rough: bool = False


SETTINGS = Settings()
_DAMPING = 1e-2  # the first one, relative to the diagonal of the normal matrix (Madsen et al. 2004, section 3.2)
_LEAST, _MOST = 1e-15, 1e8  # of it; with more no better step is in reach
_GOOD, _POOR = 0.7, 0.2  # share of the promised decrease, below which slopes are found anew
_IDLE = 3  # steps one after another that gain less than is enough end a search too
_SHORTEST = 1e-6  # difference, in prior standard deviations
_AT = 1e-9  # of the coordinate: at a bound
_INDEPENDENT = 1e-3
"""Part of a column of unit length that others do not make, above which squares of a matrix keep half of its digits."""


@dataclass(frozen=True)
class Weighted:
    """Residuals of tests in units of their noise, freed of nuisance amplitudes, and their slopes.

    Attributes:
        residuals: (n_i,) of each test.
        slopes: (n_i, p) d residual / d z.
        determinants: log, of each test, that integrating out its nuisance amplitudes adds.
        amplitudes: (k_i,) of each test's nuisance columns, estimated.
    """

    residuals: tuple[np.ndarray, ...]
    slopes: tuple[np.ndarray, ...]
    determinants: tuple[float, ...]
    amplitudes: tuple[np.ndarray, ...]


@dataclass(frozen=True)
class Fit:
    """A model with its parameters.

    Attributes:
        model: that was fitted.
        noise: by which residuals were weighted.
        z: (p,) coordinates.
        predicted: (n_i,) of each test.
        slopes: (n_i, p) d predicted / d z, with nuisance amplitudes fixed.
        evaluations: sets of parameters for which tests were predicted.
        steps: that the search tried.
        converged: whether the search ended by itself.
        held: number of the first parameters that are kept at the centres of their priors, with slopes of zero.
        gained: by which the last step decreased the objective; infinite where there was no search.
        rough: whether slopes are those that steps have updated, or that hold somewhere near.
    """

    model: Model
    noise: Noise
    z: np.ndarray
    predicted: tuple[np.ndarray, ...]
    slopes: tuple[np.ndarray, ...]
    evaluations: int
    steps: int = 0
    converged: bool = True
    held: int = 0
    gained: float = math.inf
    rough: bool = False

    @cached_property
    def values(self) -> np.ndarray:
        """Values (p,) of the parameters, SI."""
        return values_of(self.model.parameters, self.z)

    @cached_property
    def without(self) -> dict[int, Fit]:
        """Fits without a test, by its index, as far as they were asked for."""
        return {}

    @cached_property
    def left(self) -> tuple[np.ndarray, ...]:
        """Residuals (n_i,) of each test, measured less predicted."""
        return tuple(y - f for y, f in zip(self.model.measured, self.predicted, strict=True))

    @cached_property
    def free(self) -> np.ndarray:
        """Whether each parameter (p,) is fitted, and stands off its bounds."""
        low, high = ranges_of(self.model.parameters)
        fitted = np.arange(self.z.size) >= self.held
        return np.asarray(fitted & (self.z > low + _AT) & (self.z < high - _AT))

    def weighted(self, noise: Noise | None = None) -> Weighted:
        """Return residuals and slopes in units of a noise; None: that of the fit."""
        return weighted(self.model, noise or self.noise, self.values, self.predicted, self.slopes)


def weighted(model: Model, noise: Noise, values: np.ndarray, predicted: Tests, slopes: Tests) -> Weighted:
    """Return residuals and slopes in units of the noise, freed of nuisance amplitudes.

    Amplitudes of the nuisance columns Z have the prior N(0, 1) and are integrated out: what is left is multiplied by
    (I + Z Z')^(-1/2).

    Args:
        values: (p,) SI.
        predicted: (n_i,) of each test.
        slopes: (n_i, p) d predicted / d z.
    """
    found = []
    for i, columns in enumerate(model.nuisance_columns(values)):
        both = noise.weight(i) * np.column_stack((model.measured[i] - predicted[i], -slopes[i]))
        determinant, amplitude = 0.0, np.zeros(0)
        if columns is not None:
            u, s, v = np.linalg.svd(noise.weight(i) * columns, full_matrices=False)
            shown = u.T @ both
            amplitude = v.T @ (s / (1.0 + s**2) * shown[:, 0])
            both -= u @ ((1.0 - 1.0 / np.sqrt(1.0 + s**2))[:, np.newaxis] * shown)
            determinant = float(np.sum(np.log1p(s**2)))
        found.append((both[:, 0], both[:, 1:], determinant, amplitude))
    residuals, rates, determinants, amplitudes = zip(*found, strict=True)
    return Weighted(residuals, rates, determinants, amplitudes)


def fit(
    model: Model,
    noise: Noise,
    start: np.ndarray | Fit | None = None,
    steps: int | None = None,
    settings: Settings = SETTINGS,
    held: int = 0,
) -> Fit:
    """Search the parameters of largest posterior density: Levenberg-Marquardt, kept inside the bounds.

    Slopes are differences of one batch of predictions; between batches they are updated by what steps show. A search
    ends by itself where fresh slopes promise nothing more. Several starts are the caller's.

    Args:
        model: to be fitted.
        noise: of the tests.
        start: (p,) coordinates, or a fit of the model, whose predictions and slopes are not asked for again; None: the
            centres of the priors.
        steps: most of them; None: those of the settings.
        held: number of the first parameters that are kept where they are, the centres of their priors; a fit to start
            from says that itself.

    Returns:
        The fit, with slopes at its end.

    Raises:
        PredictionError: the model cannot predict at the start.

    Sources: Madsen, Nielsen and Tingleff (2004), Methods for non-linear least squares problems, sections 3.2 and 3.5;
    More (1978), LNM 630, 105-116 (scaling); Kaufman (1975), BIT 15, 49-57 (slopes with nuisance amplitudes fixed);
    Stark and Parker (1995), Computational Statistics 10, 129-141 (the step inside the bounds).
    """
    held = start.held if isinstance(start, Fit) else held
    search = _Search(model, noise, settings, held)
    most = settings.steps if steps is None else steps
    fresh = not (isinstance(start, Fit) and start.rough)
    damping, taken, idle, scale, gained = _DAMPING, 0, 0, np.zeros(len(model.parameters)), 0.0
    shortened = False  # differences at this point: where predictions jump, they may be too long however often
    if isinstance(start, Fit):
        here, rates = search.point(start.z, start.predicted), list(start.slopes)
    else:
        here = search.first(np.zeros(scale.size) if start is None else np.asarray(start, dtype=float))
        rates = search.slopes(here)
    while True:
        root, pull = search.linear(here, rates)
        low, high = search.low - here.z, search.high - here.z
        promised = _decrease(root, pull, _inside(root, pull, low, high))
        enough = settings.enough + settings.relative * here.objective
        converged = promised <= enough or idle >= _IDLE
        if not converged and taken < most:
            taken, growth, there = taken + 1, 2.0, here
            scale = np.maximum(scale, np.linalg.norm(root, axis=0))
            while damping <= _MOST and not there.objective < here.objective:
                damped = np.vstack((root, np.sqrt(damping) * np.diag(scale)))
                step = _inside(damped, np.append(pull, np.zeros(scale.size)), low, high)
                there = search.to(here.z + step)
                damping, growth = damping * growth, 2.0 * growth
            gained = max(here.objective - there.objective, 0.0)
            if gained:
                kept = gained / max(_decrease(root, pull, step), 1e-300)
                damping *= 2.0 / growth * max(0.1, 1.0 - (2.0 * min(kept, 1.0) - 1.0) ** 3)
                damping, fresh = max(damping, _LEAST), kept < (_POOR if settings.rough else _GOOD)
                idle = idle + 1 if gained <= enough else 0
                rates = search.slopes(there, root) if fresh else search.updated(rates, here, there)
                here, shortened = there, False
                continue
            converged = fresh
        if settings.rough or (fresh and (shortened or not search.too_long(root))):
            ended = here.z, tuple(here.predicted), tuple(rates)
            return Fit(model, noise, *ended, search.evaluations, taken, converged, held, gained, not fresh)
        shortened = fresh
        rates, fresh, damping = search.slopes(here, root), True, min(damping, 1.0)


@dataclass(frozen=True)
class _Point:
    """Predictions with coordinates; the objective is the negative log posterior density, infinite without them."""

    z: np.ndarray
    predicted: Tests
    objective: float
    amplitudes: Tests


class _Search:
    """Predictions of a search, counted."""

    def __init__(self, model: Model, noise: Noise, settings: Settings, held: int) -> None:
        self.model, self.noise, self.settings, self.held = model, noise, settings, held
        self.low, self.high = ranges_of(model.parameters)
        self.prior = priors_of(model.parameters)
        self.evaluations, self.moved = 0, np.zeros(len(model.parameters))

    def first(self, z: np.ndarray) -> _Point:
        z = np.clip(z, self.low, self.high)
        (predicted,) = self.model.predict(values_of(self.model.parameters, z)[np.newaxis])
        if isinstance(predicted, PredictionError):
            raise predicted
        self.evaluations += 1
        found = self.point(z, predicted)
        if not np.isfinite(found.objective):
            raise PredictionError("predictions at the start are not finite")
        return found

    def to(self, z: np.ndarray) -> _Point:
        """Predict with coordinates (p,), moved inside the bounds."""
        z = np.clip(z, self.low, self.high)
        self.evaluations += 1
        (predicted,) = self.model.predict(values_of(self.model.parameters, z)[np.newaxis])
        return self.point(z, predicted)

    def near(self, z: np.ndarray, here: _Point) -> list[Tests | None]:
        """Return predictions (n_i,) with coordinates (m, p) near a point, and with its nuisance amplitudes."""
        self.evaluations += len(z)
        if not len(z):
            return []
        values = np.array([values_of(self.model.parameters, one) for one in z])
        found = predict_near(self.model, values, values_of(self.model.parameters, here.z), here.predicted)
        both = zip(z, found, strict=True)
        return [self.whole(_Point(at, of, np.inf, ()), here) if _finite(of) else None for at, of in both]

    def point(self, z: np.ndarray, predicted: Tests | PredictionError) -> _Point:
        if not _finite(predicted):
            return _Point(z, (), np.inf, ())
        try:
            here = self.weighted(_Point(z, predicted, np.inf, ()), [np.zeros((f.size, 0)) for f in predicted])
        except np.linalg.LinAlgError:  # columns are not finite
            return _Point(z, (), np.inf, ())
        total = 0.5 * (sum(float(r @ r) for r in here.residuals) + sum(here.determinants) + float(self.prior @ z**2))
        return _Point(z, predicted, total if np.isfinite(total) else np.inf, here.amplitudes)

    def weighted(self, here: _Point, slopes: Tests) -> Weighted:
        return weighted(self.model, self.noise, values_of(self.model.parameters, here.z), here.predicted, slopes)

    def linear(self, here: _Point, slopes: Tests) -> tuple[np.ndarray, np.ndarray]:
        """Return R (p, p) and c (p,): the objective after a step is half |R step + c|^2, but for a constant."""
        found, root = self.weighted(here, slopes), np.sqrt(self.prior)
        rows = [np.column_stack((j, r)) for j, r in zip(found.slopes, found.residuals, strict=True)]
        r = triangle(*rows, np.column_stack((np.diag(root), root * here.z)))
        return r[: root.size, : root.size], r[: root.size, root.size]

    def slopes(self, here: _Point, root: np.ndarray | None = None) -> list[np.ndarray]:
        """Return d predicted / d z (n_i, p) of each test, by differences; none of what cannot be moved either way."""
        z, p, longest = here.z, here.z.size, np.full(here.z.size, self.settings.difference)
        if root is not None:
            longest = np.clip(1.0 / np.maximum(np.linalg.norm(root, axis=0), 1.0), _SHORTEST, longest)
        self.moved = longest
        both = np.column_stack((np.minimum(longest, self.high - z), -np.minimum(longest, z - self.low)))
        ends = [{0.0: self.whole(here, here)} for _ in range(p)]
        for first in (True, False):  # then the other side of what could not be predicted
            one_sided = not self.settings.central and first
            sides = [[max(side, key=abs)] if one_sided else side for side in both.tolist()]
            wanted = [
                (k, d) for k, side in enumerate(sides) for d in side if d and k >= self.held and len(ends[k]) == 1
            ]
            moved = np.array([z + d * (np.arange(p) == k) for k, d in wanted]).reshape(len(wanted), p)
            for (k, d), there in zip(wanted, self.near(moved, here), strict=True):
                if there is not None:
                    ends[k][d] = there
        rates = [np.zeros((f.size, p)) for f in here.predicted]
        for k, of in enumerate(ends):
            low, high = min(of), max(of)
            for rate, one, other in zip(rates, of[low], of[high], strict=True):
                rate[:, k] = (other - one) / max(high - low, 1e-300)
        return rates

    def too_long(self, root: np.ndarray) -> bool:
        """Return whether the last differences went beyond conditional standard errors."""
        return bool(np.any((self.moved > _SHORTEST) & (self.moved * np.linalg.norm(root, axis=0) > 3.0)))

    def whole(self, there: _Point, here: _Point) -> Tests:
        """Return predictions (n_i,) at a point with the nuisance amplitudes at another one."""
        if not any(amplitude.size for amplitude in here.amplitudes):
            return there.predicted
        nuisance = columns_near(self.model, *(values_of(self.model.parameters, one.z) for one in (there, here)))
        both = zip(there.predicted, nuisance, here.amplitudes, strict=True)
        return [f if columns is None else f + columns @ amplitude for f, columns, amplitude in both]

    def updated(self, slopes: Tests, here: _Point, there: _Point) -> list[np.ndarray]:
        """Return slopes that give what a step changed, and are else as they were (Broyden's update)."""
        step = there.z - here.z
        before, after, along = self.whole(here, here), self.whole(there, here), step / float(step @ step)
        return [j + np.outer(b - a - j @ step, along) for j, a, b in zip(slopes, before, after, strict=True)]


def _finite(predicted: Tests | PredictionError) -> TypeGuard[Tests]:
    return not isinstance(predicted, PredictionError) and all(np.all(np.isfinite(f)) for f in predicted)


def triangle(*rows: np.ndarray) -> np.ndarray:
    """Return R (p, p) of the rows (m, p) of one matrix A, m >= p in all: R'R = A'A.

    Of columns that are nearly independent, Cholesky's factor of A'A has eight correct digits, in less time.
    """
    length = np.sqrt(sum(np.einsum("ij,ij->j", one, one) for one in rows))
    if length.size and np.all(length > 0.0) and np.all(np.isfinite(length)):
        try:
            root = np.linalg.cholesky(sum(one.T @ one for one in rows) / np.outer(length, length))
        except np.linalg.LinAlgError:
            pass
        else:
            if np.diag(root).min() > _INDEPENDENT:
                return np.asarray(root.T * length)
    return np.asarray(np.linalg.qr(np.vstack(rows), mode="r"))


def _decrease(root: np.ndarray, pull: np.ndarray, step: np.ndarray) -> float:
    """Return how much the linear model decreases the objective by a step."""
    change = root @ step
    return -float(change @ (pull + 0.5 * change))


def _inside(matrix: np.ndarray, target: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Return the step (p,) within bounds that makes |matrix step + target| least."""
    length = np.linalg.norm(matrix, axis=0)
    length[length == 0.0] = 1.0
    step = np.linalg.lstsq(matrix / length, -target)[0] / length
    if np.all((step >= low) & (step <= high)):
        return step
    from scipy.optimize import lsq_linear

    found = lsq_linear(matrix / length, -target, (low * length, high * length), method="bvls")
    return np.clip(found.x / length, low, high)
