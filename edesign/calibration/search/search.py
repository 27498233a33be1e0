"""The search of the effects that a model lacks: screening, a beam of models, and the gates of `adoption.py`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.search.adoption import Adoption, Tried, sure
from edesign.calibration.search.models import EffortSpentError, FittedModel, Fitter, Start
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.screening import Screening, screen
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.calibration.search.variants import Variants
from edesign.estimation.left_out import LEAST
from edesign.estimation.noise import Noise

Ending = Literal["complete", "effort_spent", "interrupted"]
Progress = Callable[[str], None]


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
    """Searches the effects that the base model of a problem lacks."""

    def __init__(
        self, problem: Problem, settings: SearchSettings = SETTINGS, progress: Progress = lambda _: None
    ) -> None:
        self._problem, self._settings, self._progress = problem, settings, progress
        self._fitter = Fitter(problem, settings)

    def run(self) -> Found:
        """Search until the next depth, fully searched, does not pass the rule, or until the effort is spent."""
        base = self._base()
        self._best, self._depths, self._rivals = base, list[Depth](), list[tuple[Tried, ...]]()
        self._variants = Variants(self._fitter, base)
        self._adoption = Adoption(self._fitter, self._variants, base)
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
            self._best = self._adoption.take(adopted)

    def _swap(self) -> bool:
        """Try other effects in the place of each one; return whether one of them is surely better, and was taken.

        Those that the best model does not surely beat are its rivals: the tests cannot separate them.
        """
        best = self._best
        self._rivals = []
        for index, effect in enumerate(best.effects):
            self._progress(f"trying others in the place of {effect.label}")
            rest = self._variants.omitting(best, index)
            if rest is None:
                self._rivals.append(())
                continue
            noise = self._fitter.noise(best, rest)
            others = self._variants.in_place(effect, rest)
            tried = [Tried(one, self._fitter.difference(one, best, noise, rest)) for one in others]
            leader = self._adoption.in_place(tried, best)
            if leader is not None:
                self._best = self._adoption.take(self._variants.with_best_forms(leader, noise))
                return True
            indistinguishable = [
                one for one in tried if not sure(self._fitter.difference(best, one.model, noise, rest))
            ]
            self._rivals.append(tuple(indistinguishable))
        return False

    def _base(self) -> FittedModel:
        """Return the base model, fitted."""
        noise = Noise.of_first_fit(self._problem.deviations, self._problem.sizes)
        found = self._fitter.fit((), np.array(self._problem.start), noise)
        if found is None:
            raise ValueError("the base model cannot predict with its declared parameters")
        return self._fitter.reweighted(found)

    def _depth(self, best: FittedModel) -> Depth:
        fitter = self._fitter
        before, screening = fitter.fitted, screen(fitter, best, best)
        noise = screening.noise
        children = self._children(best, screening, noise)
        leaders = [
            fitter.reweighted(self._variants.with_best_forms(one, noise, True)) for one in self._beam(children, noise)
        ]
        if not leaders:
            return Depth(best, screening, fitter.fitted - before, (), None)
        leader = max(leaders, key=lambda one: fitter.score(one, noise, best, sure=False).total)
        noise = fitter.noise(leader, best)
        tried = [Tried(one, self._fitter.difference(one, best, noise, best)) for one in leaders]
        tried.sort(key=lambda one: -one.difference.total)
        for one in tried:
            d = one.difference
            left = f"NRMS {100.0 * one.model.nrms:.3g} %, gain {d.total:.1f} +- {d.error:.1f}"
            self._progress(f"  {one.model.label}: {left}")
        adopted = self._adoption.best_of(tried, best, noise)
        return Depth(best, screening, fitter.fitted - before, tuple(tried), adopted)

    def _children(self, model: FittedModel, screening: Screening, noise: Noise) -> list[FittedModel]:
        """Return the model with each of the effects and pairs that the screening puts first, roughly fitted."""
        fitter, forms = self._fitter, dict[str, int]()
        tried: list[tuple[Start, ...]] = []
        for start, _ in screening.singles:
            # nuisance amplitudes are no function of a start: what they do is hardly seen to first order
            forms[start.effect.name] = forms.get(start.effect.name, 0) + (not start.effect.nuisance)
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
