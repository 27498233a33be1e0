"""Models that a search has fitted: a base model with effects, and what it says of its own errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property, wraps
from typing import Concatenate, ParamSpec, TypeVar

import numpy as np

from edesign.calibration.search.problem import Columns, Effect, Problem
from edesign.calibration.search.settings import SearchSettings
from edesign.estimation.least_squares import SETTINGS, Fit, Settings, fit
from edesign.estimation.left_out import PRIOR_FREEDOM, Difference, Score, difference, score
from edesign.estimation.model import PredictionError, predict_near
from edesign.estimation.noise import Noise, correlation_length, most_noise
from edesign.estimation.outlier import Outlier, outlier
from edesign.estimation.parameters import coordinates_of, ranges_of, values_of

_REWEIGHTED = 0.2  # fall of the logarithm of the noise, below which a fit under the noise that it leaves has settled
_FITS = 5  # most of them
_STEPS = 15
_ROUGH = Settings(rough=True)
_KNOWN = 1e-6  # of its prior spread: how far a parameter that counts as known may move
_NEGLIGIBLE = 0.03  # singular value, of the largest, of differences between equations


@dataclass(frozen=True, eq=False)
class Start:
    """A form of an effect at one start of its grid.

    Attributes:
        effect: the form.
        values: (p,) SI, with the size that the tests ask for.
    """

    effect: Effect
    values: np.ndarray


LAW = "law"
"""Stands among the changes of a model of which the base is fitted: a change of it is judged as an effect is."""
Key = frozenset[str]
"""By which models are told apart."""
S = TypeVar("S")
P = ParamSpec("P")
T = TypeVar("T")


def once(method: Callable[Concatenate[S, P], T]) -> Callable[Concatenate[S, P], T]:
    """Keep what a method returns as long as its object lives: it is not asked for again with the same arguments."""

    @wraps(method)
    def found(self: S, *args: P.args, **named: P.kwargs) -> T:
        known: dict[object, T] = self.__dict__.setdefault(f"_{method.__name__}_found", {})
        key = args, tuple(named.items())
        if key not in known:
            known[key] = method(self, *args, **named)
        return known[key]

    return found


class EffortSpentError(Exception):
    """The search has made as many predictions as it may."""


class Effort:
    """Weighted predictions that a search has made; the same on every machine.

    Args:
        most: after which it ends.

    Attributes:
        by_step: how many each step took, in their order.
    """

    def __init__(self, most: float) -> None:
        self.most, self.by_step, self._step = most, dict[str, float](), ""

    @property
    def spent(self) -> float:
        """How many there have been."""
        return sum(self.by_step.values())

    @contextmanager
    def on(self, step: str) -> Iterator[None]:
        """Count what is predicted meanwhile for a step, unless a step around it counts already.

        Args:
            step: for people.
        """
        before, self._step = self._step, self._step or step
        try:
            yield
        finally:
            self._step = before

    def spend(self, predictions: int, effects: Sequence[Effect]) -> None:
        """Count predictions of a model with effects.

        Raises:
            EffortSpentError: there have been too many.
        """
        cost = predictions * max((effect.cost for effect in effects), default=1.0)
        self.by_step[self._step] = self.by_step.get(self._step, 0.0) + cost
        if self.spent > self.most:
            raise EffortSpentError


@dataclass(frozen=True, eq=False)
class FittedModel:
    """A base model with effects, fitted.

    Attributes:
        problem: of the tests.
        effects: in the order of adoption, and in a round of what they explain.
        fit: parameters of the base, and of the effects in their order.
    """

    problem: Problem
    effects: tuple[Effect, ...]
    fit: Fit

    @property
    def label(self) -> str:
        """Labels of its effects."""
        return " + ".join(effect.label for effect in self.effects) or "none"

    @property
    def names(self) -> frozenset[str]:
        """Names of its effects."""
        return frozenset(effect.name for effect in self.effects)

    @property
    def changes(self) -> frozenset[str]:
        """Names of its effects, and `LAW` where the base is fitted."""
        return self.names | ({LAW} if self.refits else set())

    @property
    def key(self) -> Key:
        """Labels of its effects, and `LAW` where the base is fitted."""
        return frozenset(effect.label for effect in self.effects) | ({LAW} if self.refits else set())

    @property
    def refits(self) -> bool:
        """Whether the base is fitted: it has parameters, and they are not held as declared."""
        return self.base_size > self.fit.held

    @property
    def base_size(self) -> int:
        """How many parameters the base has."""
        return self.fit.z.size - sum(len(effect.parameters) for effect in self.effects)

    @cached_property
    def left(self) -> tuple[np.ndarray, ...]:
        """Residuals (n_i,) of each test, freed of its nuisance amplitudes."""
        nuisance = self.fit.model.nuisance_columns(self.fit.values)
        amplitudes = self.fit.weighted().amplitudes
        both = zip(self.fit.left, nuisance, amplitudes, strict=True)
        return tuple(r if columns is None else r - columns @ amplitude for r, columns, amplitude in both)

    @cached_property
    def noise(self) -> Noise:
        """What it leaves of the tests, at least the noise of the channels."""
        return Noise.left_by(self.left, self.problem.deviations, self.problem.sizes)

    @cached_property
    def freed(self) -> Fit:
        """Its fit with slopes to all parameters: what is kept as declared is no better known than by the tests."""
        return fit(self.fit.model, self.noise, self.fit.z, 0) if self.fit.held else self.fit

    @cached_property
    def nrms(self) -> float:
        """NRMS: sum of squares of what it leaves over that of what was measured, no root."""
        left, measured = (np.concatenate(each) for each in (self.left, self.fit.model.measured))
        return float(left @ left / (measured @ measured))

    @cached_property
    def at_floor(self) -> bool:
        """Whether it leaves no more than noise, as well as that is known: without effects, of each test too.

        With effects what one test leaves alone is an error of their equations rather than one more effect.
        """
        left = np.array([float(r @ r) / r.size for r in self.left]) / np.array(self.problem.deviations) ** 2
        each = [one <= most_noise(r.size, left.size) for one, r in zip(left, self.left, strict=True)]
        return bool(np.mean(left) <= 1.0 + math.sqrt(2.0 / PRIOR_FREEDOM)) and (bool(self.effects) or all(each))

    def places(self, index: int) -> range:
        """Indices of the parameters of an effect."""
        first = self.fit.z.size - sum(len(effect.parameters) for effect in self.effects[index:])
        return range(first, first + len(self.effects[index].parameters))

    def without(self, index: int) -> tuple[tuple[Effect, ...], np.ndarray]:
        """Return the other effects, and the values of all other parameters, SI."""
        others = tuple(effect for i, effect in enumerate(self.effects) if i != index)
        return others, np.delete(self.fit.values, self.places(index))

    def size(self, index: int) -> float:
        """Root mean square of what an effect does, of that of what was measured."""
        change, measured = (np.concatenate(each) for each in (self.contribution(index), self.fit.model.measured))
        return float(np.sqrt(change @ change / (measured @ measured)))

    def contribution(self, index: int) -> list[np.ndarray]:
        """What an effect changes (n_i,) of each test; nothing where the others cannot predict alone."""
        return self._contributions[index]

    @cached_property
    def _contributions(self) -> list[list[np.ndarray]]:
        found = []
        for index in range(len(self.effects)):
            others, values = self.without(index)
            (plain,) = self.problem.model(others).predict(values[np.newaxis])
            if isinstance(plain, PredictionError):
                plain = self.fit.predicted
            found.append([f - g for f, g in zip(self.fit.predicted, plain, strict=True)])
        return found


class Fitter:
    """Fits models of a problem and scores them, counting the effort; what was fitted is kept."""

    def __init__(self, problem: Problem, settings: SearchSettings) -> None:
        self.problem, self.settings = problem, settings
        self.effort = Effort(settings.effort)
        self.fitted = 0
        self._equations: dict[tuple[tuple[str, ...], int], np.ndarray] = {}

    def predict(self, effects: Sequence[Effect], values: np.ndarray) -> list[Sequence[np.ndarray] | PredictionError]:
        """Return predictions (n_i,) of each test for each row of values, SI."""
        self.effort.spend(len(values), effects)
        return list(self.problem.model(tuple(effects)).predict(values))

    def fit(
        self,
        effects: Sequence[Effect],
        start: np.ndarray | Fit,
        noise: Noise,
        steps: int = _STEPS,
        held: int = 0,
        settings: Settings = SETTINGS,
    ) -> FittedModel | None:
        """Fit a model from values, SI, or from a fit of it; None: it cannot predict there.

        Args:
            held: number of parameters of the base that are kept as declared; a fit to start from says that itself.
        """
        model = start.model if isinstance(start, Fit) else self.problem.model(tuple(effects))
        z = start if isinstance(start, Fit) else coordinates_of(model.parameters, start)
        try:
            found = fit(model, noise, z, steps, settings, held)
        except PredictionError:
            self.effort.spend(1, effects)
            return None
        self.fitted += 1
        self.effort.spend(found.evaluations, effects)
        return FittedModel(self.problem, tuple(effects), found)

    def rough(self, grown: FittedModel, noise: Noise) -> FittedModel:
        """Fit a model that has grown by a few steps, by which models are put in order."""
        return self.fit(grown.effects, grown.fit, noise, self.settings.rough_steps, settings=_ROUGH) or grown

    def extended(self, model: FittedModel, starts: Sequence[Start], noise: Noise) -> FittedModel | None:
        """Return a model with more effects at their starts, with its slopes, and those of their parameters; not fitted.

        None: it cannot predict there.
        """
        effects = (*model.effects, *(start.effect for start in starts))
        values = [model.fit.values, *(start.values for start in starts)]
        return self.linearised(effects, values, model.fit.slopes, noise, model.fit.held)

    def linearised(
        self, effects: tuple[Effect, ...], values: Sequence[np.ndarray], slopes: Columns, noise: Noise, held: int
    ) -> FittedModel | None:
        """Return a model at values (p,) SI; its slopes to the first parameters are known, those to others are found."""
        with_them = self.problem.model(effects)
        z = coordinates_of(with_them.parameters, np.concatenate(values))
        known = slopes[0].shape[1]
        low, high = ranges_of(with_them.parameters)
        steps = np.where(z + SETTINGS.difference <= high, 1.0, -1.0) * SETTINGS.difference
        moved = [z, *(z + steps * (np.arange(z.size) == k) for k in range(known, z.size))]
        at, *around = np.array([values_of(with_them.parameters, one) for one in moved])
        (here,) = self.predict(effects, at[np.newaxis])
        if isinstance(here, PredictionError):
            return None
        self.effort.spend(len(around), effects)
        there = predict_near(with_them, np.array(around), at, here) if around else []
        rates = list(slopes)
        for k, of in enumerate(there, known):
            if isinstance(of, PredictionError):
                return None
            rates = [np.column_stack((j, (a - b) / steps[k])) for j, a, b in zip(rates, of, here, strict=True)]
        found = Fit(with_them, noise, z, tuple(here), tuple(rates), 0, held=held, rough=True)
        return FittedModel(self.problem, effects, found)

    @once
    def reweighted(self, model: FittedModel) -> FittedModel:
        """Fit again under the noise that the fit leaves, until that noise is known."""
        for _ in range(_FITS):
            before, model = model, self.fit(model.effects, model.fit, model.noise) or model
            fall = float(np.mean(np.log(before.noise.long_run)) - np.mean(np.log(model.noise.long_run)))
            if fall < _REWEIGHTED:
                break
        return model

    @once
    def as_declared(self, model: FittedModel) -> FittedModel | None:
        """Return a model with the base as declared, its effects fitted again; None: it cannot predict so."""
        held = model.base_size
        declared = [one.centre for one in model.fit.model.parameters[:held]]
        found = self.fit(model.effects, np.append(declared, model.fit.values[held:]), model.noise, held=held)
        return None if found is None else self.reweighted(found)

    @once
    def omitting(self, model: FittedModel, index: int, held: int) -> FittedModel | None:
        """Return a model without one of its effects, fitted again; None: it cannot predict then.

        Args:
            held: number of parameters of the base that are kept as declared.
        """
        others, values = model.without(index)
        if held == model.fit.held:
            slopes = [np.delete(j, model.places(index), axis=1) for j in model.fit.slopes]
            rough = self.linearised(others, [values], slopes, model.noise, held)
        else:
            rough = self.fit(others, values, model.noise, held=held)
        return None if rough is None else self.reweighted(rough)

    def score(self, model: FittedModel, noise: Noise, roughly: bool = False) -> Score:
        """Return the score of a model.

        Args:
            noise: that all models compared share.
            roughly: whether the model is not fitted again without a test that moves it far.
        """
        return self._score(model, noise, None, frozenset(), roughly)

    @once
    def _score(
        self, model: FittedModel, noise: Noise, known: FittedModel | None, names: frozenset[str], roughly: bool
    ) -> Score:
        wrong = None if known is None else self.discrepancy(known, names)
        found = score(model.fit, noise, wrong, refits=not roughly)
        self.effort.spend(found.evaluations, model.effects)
        return replace(found, log_prior=sum(effect.log_prior for effect in model.effects))

    def compare(self, one: FittedModel, other: FittedModel, roughly: bool = False) -> Difference:
        """Return by how much one model predicts tests better than another.

        They are compared under the noise of the one that leaves less, beside what both have: the equations of their
        common effects, as the one that leaves more has them, may be wrong. So the difference is the same both ways. Of
        models with the same effects nothing stands beside what differs, and no such error may explain it.
        """
        less, more = sorted((one, other), key=lambda each: float(np.mean(np.log(each.noise.long_run))))
        beside = frozenset() if one.names == other.names else one.names & other.names
        return self.difference(one, other, self.noise(less.noise, more, beside), more, beside, roughly)

    def behind(self, one: FittedModel, other: FittedModel) -> bool:
        """Return whether a model is surely behind another one, though as many steps again gained as its last one."""
        ahead = self.compare(other, one, roughly=True)
        return replace(ahead, total=ahead.total - self.settings.rough_steps * one.fit.gained).sure

    def difference(
        self,
        better: FittedModel,
        worse: FittedModel,
        noise: Noise,
        known: FittedModel,
        names: frozenset[str] | None = None,
        roughly: bool = False,
    ) -> Difference:
        """Return by how much one model predicts tests better than another.

        Args:
            noise: by which they are compared.
            known: model whose equations may be wrong, which is allowed for.
            names: of its effects of which that is so; None: all of them.
            roughly: whether neither is fitted again without a test that moves it far.
        """
        wrong = known, known.names if names is None else names
        return difference(*(self._score(one, noise, *wrong, roughly) for one in (better, worse)))

    @once
    def outlier(self, model: FittedModel, faulty: FittedModel | None = None, index: int = -1) -> Outlier | None:
        """Return the test that agrees least with the others beside a model; None: there are too few.

        What a fault is in one test is known from that test alone, and is kept where the test is left out.

        Args:
            faulty: the model with one fault more, of which the test alone is asked about.
            index: of that fault among its effects.
        """
        of = None if faulty is None else (faulty.effects[index].tests[0], self._with_known_faults(faulty, index))
        found = outlier(self._with_known_faults(model), Noise.white(self.problem.deviations), of)
        slopes = model.freed.evaluations if model.fit.held else 0
        self.effort.spend(slopes + (0 if found is None else found.evaluations), model.effects)
        return found

    def _with_known_faults(self, model: FittedModel, free: int = -1) -> Fit:
        """Return the fit of a model with faults in one test, but one, that have the values found, and no spread."""
        effects, scale, values, of = list(model.effects), np.ones(model.fit.z.size), model.fit.values, model.freed
        for index, effect in enumerate(effects):
            if len(effect.tests) == 1 and index != free:
                places = model.places(index)
                scale[places] = _KNOWN
                own = zip(effect.parameters, values[places], strict=True)
                known = tuple(replace(one, centre=float(value), spread=_KNOWN * one.spread) for one, value in own)
                effects[index] = replace(effect, parameters=known)
        z = np.where(scale == 1.0, of.z, 0.0)
        slopes = tuple(j * scale for j in of.slopes)
        return replace(of, model=self.problem.model(effects), z=z, slopes=slopes)

    def noise(self, left: Noise, known: FittedModel, names: frozenset[str] | None = None) -> Noise:
        """Return the noise by which models are compared.

        It is at least that of the channels with what the equations of known effects may be wrong by.

        Args:
            left: by the best one of the models.
            names: of them; None: all that it has.
        """
        wrong = np.array([self.problem.deviations, self.problem.deviations]) ** 2
        for index, effect in enumerate(known.effects):
            counts = not effect.exact and (names is None or effect.name in names)
            for i, change in enumerate(known.contribution(index) if counts else ()):
                power = self.settings.own_discrepancy**2 * float(change @ change) / change.size
                wrong[:, i] += power, power * correlation_length(change)
        variance = np.maximum(left.variance, wrong[0])
        long_run = np.maximum(np.maximum(left.long_run, wrong[1]), variance)
        return Noise(tuple(variance.tolist()), tuple(long_run.tolist()))

    @once
    def discrepancy(self, model: FittedModel, names: frozenset[str]) -> Columns | None:
        """Return columns by which the equations of a model's effects may be wrong: what other equations of them do.

        Their shares have the prior N(0, 1); all of them together are the share `shared_discrepancy` of what the effect
        does.
        """
        found = [self.other_equations(model, i) for i, effect in enumerate(model.effects) if effect.name in names]
        if not any(one.size for one in found):
            return None
        ends = np.cumsum([f.size for f in model.fit.predicted])[:-1]
        return np.split(self.settings.shared_discrepancy * np.hstack(found), ends)

    def other_equations(self, model: FittedModel, index: int) -> np.ndarray:
        """Return what other equations of an effect do in its place (n, k), all together as large as what it does.

        They are principal components of it. Their shape is that beside the first model with these effects: where the
        others are near is known before it is fitted to the end.
        """
        key = tuple(effect.label for effect in model.effects), index
        if key not in self._equations:
            every = [np.concatenate(change) for _, _, change in self.alternatives(model, index, here=True)]
            found = [one / np.linalg.norm(one) for one in every] or [np.zeros(np.concatenate(model.left).size)]
            u, s, _ = np.linalg.svd(np.column_stack(found), full_matrices=False)
            keep = s > _NEGLIGIBLE * s[0]
            self._equations[key] = u[:, keep] * (s[keep] / np.sqrt(np.sum(s**2)))
        return self._equations[key] * float(np.linalg.norm(np.concatenate(model.contribution(index))))

    def changes(
        self, effects: tuple[Effect, ...], values: np.ndarray, plain: Columns, form: Effect
    ) -> Iterator[tuple[np.ndarray, list[np.ndarray]]]:
        """Return what a form of an effect changes beside others (n_i,) of each test, at each start where it can.

        Args:
            values: (p,) SI, of the base and the others.
            plain: (n_i,) of each test, predicted without the form.
        """
        starts = np.array([[*values, *start] for start in form.starts])
        for start, there in zip(form.starts, self.predict((*effects, form), starts), strict=True):
            if isinstance(there, PredictionError):
                continue
            change = [f - g for f, g in zip(there, plain, strict=True)]
            if np.isfinite(np.linalg.norm(np.concatenate(change))):  # a number may be too large to be squared
                yield np.array(start), change

    def alternatives(
        self, model: FittedModel, index: int, here: bool = False
    ) -> Iterator[tuple[Effect, np.ndarray, list[np.ndarray]]]:
        """Return what other equations of an effect do in its place, at each of their starts.

        Args:
            here: whether only those are asked for that act in the same tests.

        Returns:
            Form, start (p,) SI, and change (n_i,) of each test.
        """
        effect, (others, values) = model.effects[index], model.without(index)
        plain = [f - c for f, c in zip(model.fit.predicted, model.contribution(index), strict=True)]
        for form in self.problem.effects:
            other = form.name == effect.name and form.label != effect.label and form.parameters and not form.nuisance
            if other and (form.tests == effect.tests or not here):
                for start, change in self.changes(others, values, plain, form):
                    if any(c.any() for c in change):
                        yield form, start, change

    def nearest_equations(
        self, model: FittedModel, index: int, noise: Noise, number: int, here: bool = False
    ) -> list[FittedModel]:
        """Return a model with those other equations of an effect that come nearest to what it does and should do.

        They have the size that the tests ask for, and are not fitted.

        Args:
            noise: by which nearness is measured.
            number: of equations, at most.
            here: whether only those are asked for that act in the same tests.
        """
        weights = [noise.weight(i) for i in range(len(model.left))]
        both = zip(weights, model.contribution(index), model.left, strict=True)
        target = np.concatenate([w * (c + r) for w, c, r in both])
        near: dict[str, tuple[float, Start]] = {}
        for form, values, changes in self.alternatives(model, index, here):
            change = np.concatenate([w * c for w, c in zip(weights, changes, strict=True)])
            share = float(change @ target) / float(change @ change)
            if share * float(change @ target) > near.get(form.label, (-1.0,))[0]:
                size = [values[0] * share, *values[1:]] if form.linear else values
                near[form.label] = share * float(change @ target), Start(form, np.array(size))
        others, kept = model.without(index)
        slopes = [np.delete(j, model.places(index), axis=1) for j in model.fit.slopes]
        order, found = [*range(index), len(others), *range(index, len(others))], list[FittedModel]()
        for _, start in sorted(near.values(), key=lambda one: -one[0])[:number]:
            placed = self.linearised((*others, start.effect), [kept, start.values], slopes, noise, model.fit.held)
            found += [] if placed is None else [self.in_order(placed, order)]
        return found

    def in_order(self, model: FittedModel, order: Sequence[int]) -> FittedModel:
        """Return a model with its effects in another order."""
        if list(order) == sorted(order):
            return model
        index = [*range(model.base_size), *(i for k in order for i in model.places(k))]
        effects = tuple(model.effects[k] for k in order)
        moved = replace(
            model.fit,
            model=self.problem.model(effects),
            z=model.fit.z[index],
            slopes=tuple(j[:, index] for j in model.fit.slopes),
        )
        return FittedModel(self.problem, effects, moved)
