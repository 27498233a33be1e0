"""The search of the effects that a model lacks: screening, a beam of models, one rule of adoption."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.search.models import EffortSpentError, FittedModel, Fitter, Start
from edesign.calibration.search.problem import Effect, Problem
from edesign.calibration.search.screening import Screening, screen
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.estimation.left_out import LEAST, Difference, difference
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import at_bounds, uncertainty

Ending = Literal["complete", "effort_spent", "interrupted"]
Progress = Callable[[str], None]


@dataclass(frozen=True)
class Tried:
    """A model that was compared with the best one so far.

    Attributes:
        model: fitted to the end.
        difference: by how much it predicts better.
    """

    model: FittedModel
    difference: Difference


@dataclass(frozen=True)
class Depth:
    """One round of the search.

    Attributes:
        best: model beside which effects were screened.
        screening: of effects and pairs.
        fitted: models that were fitted.
        tried: models that were fitted to the end, best first.
        adopted: the best model after it; None: nothing passes the rule.
    """

    best: FittedModel
    screening: Screening
    fitted: int
    tried: tuple[Tried, ...]
    adopted: FittedModel | None


@dataclass(frozen=True)
class Found:
    """What a search found.

    Attributes:
        base: the base model, fitted.
        best: with the effects that were adopted.
        depths: rounds of the search.
        rivals: of each adopted effect, models with another one in its place.
        ending: how it ended.
        effort: weighted predictions that it took.
    """

    base: FittedModel
    best: FittedModel
    depths: tuple[Depth, ...]
    rivals: tuple[tuple[Tried, ...], ...]
    ending: Ending
    effort: float


class Search:
    """Searches the effects that the base model of a problem lacks.

    Args:
        problem: of the tests.
        settings: numbers of the search.
        progress: told what is done.
    """

    def __init__(
        self, problem: Problem, settings: SearchSettings = SETTINGS, progress: Progress = lambda _: None
    ) -> None:
        self._problem, self._settings, self._progress = problem, settings, progress
        self._fitter = Fitter(problem, settings)
        self._beside = dict[frozenset[str], dict[str, FittedModel]]()

    def run(self) -> Found:
        """Search until the next depth, fully searched, does not pass the rule, or until the effort is spent."""
        base = self._base()
        self._best, self._depths, self._rivals = base, list[Depth](), list[tuple[Tried, ...]]()
        self._visited = {base.names}
        ending: Ending = "complete"
        try:
            self._grow()
            while self._best.effects and self._swap():
                self._grow()
        except EffortSpentError:
            ending = "effort_spent"
        except KeyboardInterrupt:
            ending = "interrupted"
        spent = self._fitter.effort.spent
        return Found(base, self._best, tuple(self._depths), tuple(self._rivals), ending, spent)

    def _grow(self) -> None:
        """Adopt effects until no more than noise is left, or the next depth does not pass the rule."""
        while len(self._best.effects) < self._settings.depth and not self._best.at_floor:
            self._progress(f"screening beside {self._best.label}: an NRMS of {100.0 * self._best.nrms:.3g} % is left")
            self._depths.append(self._depth(self._best))
            adopted = self._depths[-1].adopted
            if adopted is None:
                break
            self._adopt(adopted)

    def _adopt(self, model: FittedModel) -> None:
        """Make a model the best one; no set of effects is that twice, so that the search comes to its end."""
        self._best = model
        self._visited.add(model.names)

    def _swap(self) -> bool:
        """Try other effects in the place of each one; return whether one of them is surely better, and was taken.

        Those that the best model does not surely beat are its rivals: the tests cannot tell them apart.
        """
        best = self._best
        self._rivals = []
        for index, effect in enumerate(best.effects):
            self._progress(f"trying others in the place of {effect.label}")
            rest = self._omitting(best, index)
            if rest is None:
                self._rivals.append(())
                continue
            noise = self._fitter.noise(best, rest)
            others = self._in_place(effect, rest)
            tried = [Tried(one, self._difference(one, best, noise, rest)) for one in others]
            # what equations may be wrong by, of an effect that does much, must not hide that less is explained
            better = [
                one
                for one in tried
                if one.difference.sure
                and one.model.names not in self._visited
                and self._predicts_better(one.model, best)
                if not any(self._insignificant(one.model, i) for i in range(len(one.model.effects)))
            ]
            if better:
                leader = max(better, key=lambda one: one.difference.total).model
                self._adopt(self._with_best_forms(leader, noise))
                return True
            alike = [one for one in tried if not self._difference(best, one.model, noise, rest).sure]
            self._rivals.append(tuple(alike))
        return False

    def _in_place(self, effect: Effect, rest: FittedModel) -> list[FittedModel]:
        """Return models with another effect in the place of one, fitted: those that the screening puts first.

        Args:
            effect: that is replaced.
            rest: model without it.
        """
        key = frozenset(one.label for one in rest.effects)
        if key not in self._beside:
            found: dict[str, FittedModel] = {}
            screening = screen(self._fitter, rest, rest)
            for start, gain in screening.singles:
                if gain <= 0.0 or len(found) > self._settings.others:
                    break
                if start.effect.name in found:
                    continue
                grown = self._fitter.extended(rest, [start], screening.noise)
                if grown is not None:
                    rough = self._fitter.rough(grown, screening.noise)
                    found[start.effect.name] = self._fitter.reweighted(rough)
            self._beside[key] = found
        others = [one for name, one in self._beside[key].items() if name != effect.name]
        return others[: self._settings.others]

    def _predicts_better(self, one: FittedModel, other: FittedModel) -> bool:
        """Return whether a model predicts better than another one beside what this one leaves alone."""
        return self._fitter.score(one, other.noise).total > self._fitter.score(other, other.noise).total

    def _omitting(self, model: FittedModel, index: int) -> FittedModel | None:
        """Return a model without one of its effects, fitted; None: it cannot predict then."""
        others, values = model.without(index)
        if not others:
            return self._base_model
        slopes = [np.delete(j, model.places(index), axis=1) for j in model.fit.slopes]
        rough = self._fitter.linearised(others, [values], slopes, model.noise)
        return None if rough is None else self._fitter.reweighted(rough)

    def _base(self) -> FittedModel:
        """Return the base model, fitted."""
        noise = Noise.of_first_fit(self._problem.deviations, self._problem.sizes)
        found = self._fitter.fit((), np.array(self._problem.start), noise)
        if found is None:
            raise ValueError("the base model cannot predict with its declared parameters")
        self._base_model = self._fitter.reweighted(found)
        return self._base_model

    def _depth(self, best: FittedModel) -> Depth:
        fitter = self._fitter
        before, screening = fitter.fitted, screen(fitter, best, best)
        noise = screening.noise
        children = self._children(best, screening, noise)
        leaders = [fitter.reweighted(self._with_best_forms(one, noise, True)) for one in self._beam(children, noise)]
        if not leaders:
            return Depth(best, screening, fitter.fitted - before, (), None)
        leader = max(leaders, key=lambda one: fitter.score(one, noise, best, sure=False).total)
        noise = fitter.noise(leader, best)
        tried = [Tried(one, self._difference(one, best, noise, best)) for one in leaders]
        tried.sort(key=lambda one: -one.difference.total)
        for one in tried:
            d = one.difference
            left = f"NRMS {100.0 * one.model.nrms:.3g} %, gain {d.total:.1f} +- {d.error:.1f}"
            self._progress(f"  {one.model.label}: {left}")
        adopted, most = None, -math.inf
        for one in tried:
            # of those that pass, the best by what is needed of it; parts of it may be less than the next one
            if not one.difference.sure or one.difference.total <= most:
                continue
            if not self._identified_among(tried, one.model, best, noise):
                continue
            needed = self._pruned(self._with_best_forms(one.model, noise), best)
            if needed is not None and needed.names not in self._visited:
                total = self._difference(needed, best, noise, best).total
                if total > most:
                    adopted, most = needed, total
        return Depth(best, screening, fitter.fitted - before, tuple(tried), adopted)

    def _difference(self, better: FittedModel, worse: FittedModel, noise: Noise, known: FittedModel) -> Difference:
        return difference(self._fitter.score(better, noise, known), self._fitter.score(worse, noise, known))

    def _children(self, model: FittedModel, screening: Screening, noise: Noise) -> list[FittedModel]:
        """Return the model with each of the effects and pairs that the screening puts first, roughly fitted."""
        fitter, forms = self._fitter, dict[str, int]()
        tried: list[tuple[Start, ...]] = []
        for start, _ in screening.singles:
            # shares of each test's own are no function of a start: what they do is hardly seen to first order
            forms[start.effect.name] = forms.get(start.effect.name, 0) + (not start.effect.own)
            if forms[start.effect.name] <= self._settings.forms:
                tried.append((start,))
        tried = [*tried[: self._settings.singles], *(pair for pair, _ in screening.pairs)]
        grown = [fitter.extended(model, starts, noise) for starts in tried]
        return [fitter.rough(one, noise) for one in grown if one is not None]

    def _beam(self, models: Sequence[FittedModel], noise: Noise) -> list[FittedModel]:
        """Return the best models of different effects, none with an effect that it does not need."""

        def total(one: FittedModel) -> float:
            return self._fitter.score(one, noise, sure=False).total

        found: list[FittedModel] = []
        for model in sorted(models, key=lambda one: -total(one)):
            simpler = [one for one in models if one.names < model.names]
            if any(one.names == model.names for one in found):
                continue
            if not any(total(one) > total(model) - LEAST for one in simpler):
                found.append(model)
        return found[: self._settings.beam]

    def _with_best_forms(self, model: FittedModel, noise: Noise, roughly: bool = False) -> FittedModel:
        """Return the model with that equation of each effect that predicts best.

        Args:
            model: fitted.
            noise: by which predictions are compared.
            roughly: whether fewer equations are tried, and none is fitted to the end.
        """
        fitter, settings = self._fitter, self._settings
        weights = [noise.weight(i) for i in range(len(model.fit.predicted))]
        for index in range(len(model.effects)):
            # what the effect does and should do
            both = zip(weights, model.contribution(index), model.left, strict=True)
            target = np.concatenate([w * (c + r) for w, c, r in both])
            like: dict[str, tuple[float, Start]] = {}
            for form, values, change in fitter.alternatives(model, index, weights):
                share = float(change @ target) / float(change @ change)
                near = share * float(change @ target)
                if near > like.get(form.label, (-1.0,))[0]:
                    like[form.label] = near, Start(form, _scaled(values, form.linear, share))
            others, kept = model.without(index)
            slopes = [np.delete(j, model.places(index), axis=1) for j in model.fit.slopes]
            order = [*range(index), len(others), *range(index, len(others))]
            rough: list[FittedModel] = []
            number = settings.forms if roughly else settings.others
            for _, start in sorted(like.values(), key=lambda one: -one[0])[:number]:
                placed = fitter.linearised((*others, start.effect), [kept, start.values], slopes, noise)
                if placed is not None:
                    rough.append(fitter.rough(placed, noise))
            totals = [fitter.score(one, noise, sure=False).total for one in rough]
            likely = [one for one, total in zip(rough, totals, strict=True) if total > max(totals) - LEAST]
            if not roughly:
                likely = [fitter.reweighted(one) for one in likely]
            model = self._simplest([model, *(fitter.in_order(one, order) for one in likely)], noise, not roughly)
        return model

    def _simplest(self, models: Sequence[FittedModel], noise: Noise, sure: bool) -> FittedModel:
        """Return that of models as good as the best which has fewest parameters, none at a bound if possible.

        A form at a bound of a parameter is another form; that bound is no price of a parameter.
        """
        totals = [self._fitter.score(one, noise, sure=sure).total for one in models]
        alike = [(one, total) for one, total in zip(models, totals, strict=True) if total > max(totals) - LEAST]
        return min(alike, key=lambda one: (np.sum(~one[0].fit.free), one[0].fit.z.size, -one[1]))[0]

    def _pruned(self, model: FittedModel, known: FittedModel) -> FittedModel | None:
        """Return the model without effects that it does not need, or that are of no size, or less than instruments see.

        Noise of the motion makes force through the law. An effect that swallows it, as a clearance as large as the
        noise, is better and is none.

        Each effect is needed beside the others, whatever equations these have, and although these may be wrong.
        """
        fitter = self._fitter
        while model.effects:
            simpler = []
            for index in range(len(model.effects)):
                others, _ = model.without(index)
                one = known if others == known.effects else self._omitting(model, index)
                if one is None:
                    continue
                noise = fitter.noise(model, one)
                if self._difference(model, one, noise, one).sure and one is not known:
                    one = fitter.reweighted(self._with_best_forms(one, noise, True))
                    noise = fitter.noise(model, one)
                seen = one.nrms - model.nrms > max(self._settings.least**2, fitter.problem.input_noise)
                if (
                    not seen
                    or not self._difference(model, one, noise, one).sure
                    or self._insignificant(model, index)
                    or not self._identified_in(model, index, one, noise)
                ):
                    simpler.append(one)
            if not simpler:
                break
            noise = fitter.noise(model, known)
            model = max(simpler, key=lambda one: fitter.score(one, noise).total)
        # less than is known already is no step: the next depth would take it back
        return None if model.names <= known.names else model

    def _identified_among(self, tried: Sequence[Tried], model: FittedModel, known: FittedModel, noise: Noise) -> bool:
        """Return whether what a model adds is no error of the equations of known effects.

        It explains more than these may be wrong by, or no model with other effects predicts as well.
        """
        if known.nrms - model.nrms > self._errors(known, range(len(known.effects))):
            return True
        others = [one.model for one in tried if not (one.model.names <= model.names or one.model.names >= model.names)]
        return all(self._difference(model, one, noise, known).sure for one in others)

    def _identified_in(self, model: FittedModel, index: int, rest: FittedModel, noise: Noise) -> bool:
        """Return whether an effect is no error of the equations of the others.

        It explains more than these may be wrong by, or no other effect predicts as well in its place.
        """
        if rest.nrms - model.nrms > self._errors(model, [i for i in range(len(model.effects)) if i != index]):
            return True
        others = self._in_place(model.effects[index], rest)
        return all(self._difference(model, one, noise, rest).sure for one in others)

    def _errors(self, model: FittedModel, effects: Sequence[int]) -> float:
        """Return the share of the power of what was measured by which equations of effects may be wrong."""
        return self._settings.own_discrepancy**2 * sum(model.size(i) ** 2 for i in effects)

    def _insignificant(self, model: FittedModel, index: int) -> bool:
        """Return whether the size of an effect may be nothing (95 %), or is at a bound, where it is another effect.

        A share of a whole may be all of it.
        """
        size = model.places(index)[:1]
        if not size:
            return False
        bound = at_bounds(model.fit)[size[0]]
        if bound:
            return not (bound == "upper" and model.effects[index].parameters[0].whole)
        if not model.effects[index].linear:
            return False
        low, high = uncertainty(model.fit, model.noise).interval(size[0])
        return low <= 0.0 <= high


def _scaled(start: np.ndarray, linear: bool, share: float) -> np.ndarray:
    return np.array([start[0] * share, *start[1:]]) if linear else start
