"""Fit a base model with effects to the tests of a problem: Levenberg-Marquardt on residuals in units of their noise."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from edesign.calibrate.allowance import Allowance
from edesign.calibrate.problem import Candidate, Part, Point, PredictionError, Problem, Use
from edesign.calibrate.side_by_side import brief_side_by_side
from edesign.calibrate.unknown import Unknown

BELIEF = 0.3
"""How far the declared parameters are believed, in coordinates: a factor of e^0.3. It decides what the tests cannot
tell.
"""
_MOST_STEPS = 15
_ENOUGH = 1e-4  # relative change of the sum of squares that ends a search
_REFRESH = 0.3
"""A step that lowers the sum of squares by less than this share of what was hoped for asks for new slopes."""
FARTHEST = 2.0  # standard deviations by which a condition in doubt may be off
_STILL = 0.1  # moves of the coordinates after which updated slopes are good enough for errors on tests left out


@dataclass(frozen=True)
class Model:
    """A base model with effects, before their parameters are known.

    Attributes:
        problem: what it is of.
        noise: (tests,) standard deviation by which residuals are measured.
        effects: in the order of adoption.
        held: whether the base keeps its declared parameters.
        misfit: standard deviation of what is left by the models compared, in units of noise and as if it were white:
            what no model explains does not make the parameters sure, so the belief in the declared ones counts by as
            much more.
        workers: processes that predict it.
        allowance: processor time that predictions may take.
    """

    problem: Problem
    noise: tuple[float, ...]
    effects: tuple[Candidate, ...] = ()
    held: bool = False
    misfit: float = 1.0
    workers: int = 1
    allowance: Allowance = field(default_factory=Allowance, compare=False)

    @cached_property
    def base(self) -> tuple[Unknown, ...]:
        """Unknowns of the base that are searched."""
        return () if self.held else self.problem.base

    @cached_property
    def unknowns(self) -> tuple[Unknown, ...]:
        """All unknowns."""
        return (*self.base, *(unknown for effect in self.effects for unknown in effect.unknowns))

    @property
    def given(self) -> tuple[object, ...]:
        """What models share: problem and effects."""
        return (self.problem, self.allowance, *self.effects)

    def coordinates(self, base: np.ndarray | None = None, parts: Sequence[Part] = ()) -> np.ndarray:
        """Coordinates (p,) of values of the base (None: declared) and of the parts; effects without a part at their
        first start.
        """
        given = {candidate.label: values for candidate, values in parts}
        values = [] if self.held else list(self.problem.declared if base is None else base)
        for effect in self.effects:
            values.extend(given.get(effect.label, effect.starts[0]))
        return np.array([unknown.coordinate(float(v)) for unknown, v in zip(self.unknowns, values, strict=True)])

    def pull(self, x: np.ndarray) -> np.ndarray:
        """Half the slope (p,) of the belief in the declared parameters."""
        return np.asarray(belief(self) ** 2 * (x - self.coordinates()))

    def cost(self, residuals: Sequence[np.ndarray], x: np.ndarray) -> float:
        """Sum of squares that a fit makes small: of the residuals, and of the belief in the declared parameters."""
        cost = float(sum(r @ r for r in residuals)) + float(np.sum((belief(self) * (x - self.coordinates())) ** 2))
        return cost if np.isfinite(cost) else np.inf

    def base_values(self, x: np.ndarray) -> np.ndarray:
        """Values of the base's parameters, SI."""
        if self.held:
            return self.problem.declared
        return np.array([unknown.value(float(c)) for unknown, c in zip(self.base, x, strict=False)])

    def parts(self, x: np.ndarray) -> tuple[Part, ...]:
        """The effects with their values, SI."""
        found: list[Part] = []
        at = len(self.base)
        for effect in self.effects:
            own = x[at : at + len(effect.unknowns)]
            values = np.array([u.value(float(c)) for u, c in zip(effect.unknowns, own, strict=True)])
            found.append((effect, values))
            at += len(effect.unknowns)
        return tuple(found)

    def residuals(
        self,
        x: np.ndarray,
        uses: Sequence[Use] = ("fit",),
        doubts: Sequence[np.ndarray | None] | None = None,
        about: Point | None = None,
    ) -> list[np.ndarray]:
        """Residuals (n_i,) of the tests used so, in units of the noise at each time, freed from what is each test's
        own, and whitened where a condition of a test is in doubt.

        Args:
            x: (p,) coordinates.
            uses: of the tests.
            doubts: (n_i,) of each test; None: those at x.
            about: see Problem.nuisance; None: at x.

        Raises:
            OutOfTime: the allowance is used up.
        """
        self.allowance.check()
        parts = self.parts(x)
        base = self.base_values(x)
        predicted = self.problem.predict(base, parts, uses)
        found: list[np.ndarray] = []
        for i, values in enumerate(predicted):
            if values is None:
                continue
            residual = self._weighted(i, (self.problem.measured[i] - values) / self.noise[i])
            columns = self.problem.nuisance(base, parts, i, about)
            if columns is not None:
                residual = residual - columns @ (columns.T @ residual)
            doubt = self._doubt(parts, i, columns) if doubts is None else doubts[len(found)]
            found.append(residual if doubt is None else whitened(residual, doubt))
        return found

    def doubts(self, x: np.ndarray) -> list[np.ndarray | None]:
        """What conditions in doubt may change (n_i,) in the tests fitted to, in units of noise, freed likewise."""
        parts, base = self.parts(x), self.base_values(x)
        fitted = [i for i, use in enumerate(self.problem.uses) if use == "fit"]
        return [self._doubt(parts, i, self.problem.nuisance(base, parts, i)) for i in fitted]

    def _doubt(self, parts: Sequence[Part], i: int, columns: np.ndarray | None) -> np.ndarray | None:
        doubt = self.problem.doubt(parts, i)
        if doubt is None:
            return None
        doubt = self._weighted(i, doubt / self.noise[i])
        return doubt if columns is None else doubt - columns @ (columns.T @ doubt)

    def _weighted(self, i: int, values: np.ndarray) -> np.ndarray:
        weight = self.problem.weight(i)
        return values if weight is None else weight * values


@dataclass(frozen=True)
class Fitted:
    """A model with its parameters.

    Attributes:
        model: what was fitted.
        x: (p,) coordinates found.
        residuals: (n_i,) of each test fitted to, in units of noise.
        slopes: (n_i, p) of each test's residual to x.
    """

    model: Model
    x: np.ndarray
    residuals: tuple[np.ndarray, ...]
    slopes: tuple[np.ndarray, ...]

    @cached_property
    def chi2(self) -> float:
        """Sum of squared residuals."""
        return float(sum(r @ r for r in self.residuals))

    @cached_property
    def samples(self) -> int:
        """Number of residuals."""
        return sum(r.size for r in self.residuals)

    @property
    def own(self) -> tuple[np.ndarray | None, ...]:
        """Columns (n_i, k) of each test fitted to, whose share is its own; None: there are none."""
        problem = self.model.problem
        return tuple(problem.nuisance(self.base, self.parts, i) for i, use in enumerate(problem.uses) if use == "fit")

    @cached_property
    def freedom(self) -> int:
        """How many numbers were fitted, with those that are each test's own."""
        return self.x.size + sum(columns.shape[1] for columns in self.own if columns is not None)

    def shared(self, residuals: Sequence[np.ndarray]) -> list[np.ndarray]:
        """Residuals (n_i,) of another model in the tests fitted to, freed from what is each test's own in this one."""
        return [
            r if columns is None else r - columns @ (columns.T @ r)
            for r, columns in zip(residuals, self.own, strict=True)
        ]

    @property
    def reduced(self) -> float:
        """chi2 per sample: 1 at the noise floor."""
        return self.chi2 / self.samples

    @property
    def parts(self) -> tuple[Part, ...]:
        """The effects with their values, SI."""
        return self.model.parts(self.x)

    @property
    def base(self) -> np.ndarray:
        """Values of the base's parameters, SI."""
        return self.model.base_values(self.x)

    @cached_property
    def hessian(self) -> np.ndarray:
        """J^T J (p, p) of the tests and of the belief in the declared parameters."""
        total = np.diag(belief(self.model) ** 2)
        for slopes in self.slopes:
            total = total + slopes.T @ slopes
        return np.asarray(total)

    @cached_property
    def covariance(self) -> np.ndarray:
        """Covariance (p, p) of x: noise inflated to what is left, with as many independent samples as its correlation
        leaves.
        """
        return np.asarray(np.linalg.pinv(self.hessian) * self.misfit**2)

    @cached_property
    def misfit(self) -> float:
        """Standard deviation of the residuals as if they were white, at least that of the noise."""
        return math.sqrt(max(sum(float(r @ r) * correlation_length(r) for r in self.residuals) / self.samples, 1.0))


def whitened(residual: np.ndarray, doubt: np.ndarray) -> np.ndarray:
    """(I + d d^T)^(-1/2) r of a residual r (n,): white noise of unit size beside a share of d (n,), normal with unit
    standard deviation. Its sum of squares is that of generalised least squares up to a share of two: more is no error
    of a condition that was measured, and what is beyond counts in full.
    """
    size = float(np.sqrt(doubt @ doubt))
    if size == 0.0:
        return residual
    along = doubt / size
    found = float(along @ residual)
    if abs(found) * size <= FARTHEST * (1.0 + size**2):
        left = found / math.hypot(1.0, size)
    else:
        left = math.copysign(math.hypot(abs(found) - FARTHEST * size, FARTHEST), found)
    return residual + along * (left - found)


def correlation_length(residual: np.ndarray) -> float:
    """Samples over which a residual (n,) is correlated: 1 for white noise (Geyer's initial positive sequence)."""
    n = residual.size
    r = residual - residual.mean()
    power = float(r @ r)
    if power <= 0.0 or n < 4:
        return 1.0
    size = 1 << (2 * n - 1).bit_length()
    spectrum = np.fft.rfft(r, size)
    rho = np.fft.irfft(spectrum * np.conj(spectrum), size)[: n // 2] / power
    pairs = rho[1::2][: rho.size // 2 - 1] + rho[2::2][: rho.size // 2 - 1]
    negative = np.flatnonzero(pairs <= 0.0)
    last = int(negative[0]) if negative.size else pairs.size
    return max(1.0, 1.0 + 2.0 * float(pairs[:last].sum()))


def fit(
    model: Model,
    start: np.ndarray,
    most_steps: int = _MOST_STEPS,
    enough: float = _ENOUGH,
    frozen: Sequence[np.ndarray] | None = None,
) -> Fitted:
    """Search from a start (p,) of coordinates.

    Args:
        model: what to fit.
        start: moved inside the bounds.
        most_steps: of the search.
        enough: relative change of the sum of squares that ends it.
        frozen: slopes (n_i, q) to the first unknowns, for which no differences are taken: those of the base, which
            effects change little.

    Raises:
        PredictionError: the model cannot predict at the start.
    """
    x = np.clip(start, *_bounds(model))
    residuals = model.residuals(x)
    begun = Fitted(model, x, tuple(residuals), tuple(slopes_at(model, x, residuals, frozen)))
    return _search(begun, most_steps, enough, frozen)


def refine(fitted: Fitted, enough: float = _ENOUGH) -> Fitted:
    """Search on from what was found, with the slopes known there.

    Args:
        fitted: what was found.
        enough: relative change of the sum of squares that ends the search.
    """
    return _search(fitted, _MOST_STEPS, enough, None)


def with_differences(fitted: Fitted) -> Fitted:
    """With slopes by differences: those that a search leaves behind may have followed from its steps, by which a test
    left out may seem to be predicted far worse than it is.
    """
    return replace(fitted, slopes=tuple(slopes_at(fitted.model, fitted.x, fitted.residuals)))


def _search(begun: Fitted, most_steps: int, enough: float, frozen: Sequence[np.ndarray] | None) -> Fitted:
    """Levenberg-Marquardt; between differences the slopes follow from what the steps show.

    Source: Madsen, Nielsen and Tingleff (2004), Methods for non-linear least squares problems, sections 3.2 and 3.5
    (the update is Broyden's).
    """
    model, x = begun.model, begun.x
    low, high = _bounds(model)
    weights, centre = belief(model), model.coordinates()
    residuals, slopes, slopes_x = list(begun.residuals), list(begun.slopes), x
    cost = model.cost(residuals, x)
    damping = 1e-3
    for _ in range(most_steps if x.size else 0):
        hessian, gradient = _normal(residuals, slopes, x, weights, centre)
        fresh = slopes_x is x
        for _ in range(8 if fresh else 2):
            step, hoped = _step(hessian, gradient, damping, x, low, high)
            try:
                tried = model.residuals(x + step)
                tried_cost = model.cost(tried, x + step)
            except PredictionError:
                tried_cost = np.inf
            if tried_cost < cost:
                break
            damping *= 10.0
        if not tried_cost < cost:
            if fresh or hoped < enough * cost:
                break
            slopes, slopes_x = slopes_at(model, x, residuals, frozen), x
            continue
        gain = cost - tried_cost
        slopes = _updated(slopes, step, residuals, tried)
        x, residuals, cost = x + step, tried, tried_cost
        damping = max(damping * (0.1 if gain > 0.5 * hoped else 1.0), 1e-9)
        poor = gain < _REFRESH * hoped
        if gain < enough * cost and (fresh or not poor):
            break
        if poor:
            slopes, slopes_x = slopes_at(model, x, residuals, frozen), x
    if x.size and np.max(np.abs(x - slopes_x)) > _STILL:
        slopes = slopes_at(model, x, residuals, frozen)
    return Fitted(model, x, tuple(residuals), tuple(slopes))


def _updated(
    slopes: Sequence[np.ndarray], step: np.ndarray, before: Sequence[np.ndarray], after: Sequence[np.ndarray]
) -> list[np.ndarray]:
    """Slopes (n_i, p) that give what a step (p,) changed, and are else as they were."""
    direction = step / float(step @ step)
    return [j + np.outer(new - old - j @ step, direction) for j, old, new in zip(slopes, before, after, strict=True)]


def slopes_at(
    model: Model, x: np.ndarray, residuals: Sequence[np.ndarray], frozen: Sequence[np.ndarray] | None = None
) -> list[np.ndarray]:
    """Slopes (n_i, p) of the residuals to the coordinates, by differences; those of the first unknowns may be given."""
    slopes = [np.empty((r.size, x.size)) for r in residuals]
    known = 0
    if frozen is not None:
        known = frozen[0].shape[1]
        for own, given in zip(slopes, frozen, strict=True):
            own[:, :known] = given
    wanted = range(known, x.size)
    doubts = model.doubts(x)
    found = brief_side_by_side(lambda j: _slope(model, x, j, residuals, doubts), wanted, model.workers)
    for j, column in zip(wanted, found, strict=True):
        for own, values in zip(slopes, column, strict=True):
            own[:, j] = values
    return slopes


def _slope(
    model: Model, x: np.ndarray, j: int, residuals: Sequence[np.ndarray], doubts: Sequence[np.ndarray | None]
) -> list[np.ndarray]:
    """Slopes (n_i,) of the residuals to one coordinate, the doubt about conditions as it is: how that changes is a
    term of second order, as in least squares that are weighted anew with each step.
    """
    step, after = _moved(model, x, j, model.unknowns[j].step(float(x[j])), doubts)
    return [(moved - here) / step for moved, here in zip(after, residuals, strict=True)]


def _moved(
    model: Model, x: np.ndarray, j: int, step: float, doubts: Sequence[np.ndarray | None]
) -> tuple[float, list[np.ndarray]]:
    """Step of a coordinate, and the residuals after it; where the model has no prediction, of the other way.

    Raises:
        PredictionError: the model has none about x.
    """
    for share in (1.0, -1.0):
        moved = x.copy()
        moved[j] += share * step
        try:
            about = (model.base_values(x), model.parts(x))
            return share * step, model.residuals(moved, doubts=doubts, about=about)
        except PredictionError as error:
            last = error
    raise last


def _bounds(model: Model) -> tuple[np.ndarray, np.ndarray]:
    spans = [unknown.span for unknown in model.unknowns]
    return np.array([low for low, _ in spans]), np.array([high for _, high in spans])


def belief(model: Model) -> np.ndarray:
    """Weight (p,) of the declared value of each unknown; effects have none but what keeps the equations regular."""
    known, added = len(model.base), len(model.unknowns) - len(model.base)
    return model.misfit * np.array([1.0 / BELIEF] * known + [1e-3] * added)


def _normal(
    residuals: Sequence[np.ndarray],
    slopes: Sequence[np.ndarray],
    x: np.ndarray,
    weights: np.ndarray,
    centre: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:
    hessian, gradient = np.diag(weights**2), weights**2 * (x - centre)
    for r, j in zip(residuals, slopes, strict=True):
        hessian = hessian + j.T @ j
        gradient = gradient + j.T @ r
    return hessian, gradient


def _step(
    hessian: np.ndarray, gradient: np.ndarray, damping: float, x: np.ndarray, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, float]:
    """A damped Gauss-Newton step inside the bounds, and the reduction it hopes for; unknowns that push at a bound
    stay there.
    """
    free = ~(((x <= low) & (gradient > 0.0)) | ((x >= high) & (gradient < 0.0)))
    step = np.zeros_like(x)
    for _ in range(x.size + 1):
        index = np.flatnonzero(free)
        if index.size == 0:
            break
        h = hessian[np.ix_(index, index)]
        fixed = np.flatnonzero(~free)
        right = gradient[index] + hessian[np.ix_(index, fixed)] @ step[fixed]
        own = np.linalg.lstsq(h + damping * np.diag(np.diag(h)), -right, rcond=1e-14)[0]
        step[index] = own
        over = index[(x[index] + own < low[index]) | (x[index] + own > high[index])]
        if over.size == 0:
            break
        step[over] = np.clip(x[over] + step[over], low[over], high[over]) - x[over]
        free[over] = False
    step = np.clip(x + step, low, high) - x
    return step, float(-(2.0 * gradient @ step + step @ hessian @ step))
