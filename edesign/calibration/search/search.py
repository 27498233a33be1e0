"""The search of the effects that a model lacks: screening, a beam of models, and the gates of `adoption.py`."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.search.adoption import Adoption, Refusal, Tried
from edesign.calibration.search.models import EffortSpentError, FittedModel, Fitter, Key, Start
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
        adopted: the best model after it; None: nothing passes the gates.
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
        declared: the base model as declared.
        base: the same, fitted.
        best: with the effects that were adopted; of the base as declared, if its change is not needed beside them.
        models: all that were fitted to the end.
        refused: why models that were looked at are none to adopt, by their `key`.
        depths: rounds of the search.
        ending: how it ended.
        effort: weighted predictions that each step took.
    """

    declared: FittedModel
    base: FittedModel
    best: FittedModel
    models: tuple[FittedModel, ...]
    refused: Mapping[Key, Refusal]
    depths: tuple[Depth, ...]
    ending: Ending
    effort: Mapping[str, float]


class Search:
    """Searches the effects that the base model of a problem lacks."""

    def __init__(
        self, problem: Problem, settings: SearchSettings = SETTINGS, progress: Progress = lambda _: None
    ) -> None:
        self._problem, self._settings, self._progress = problem, settings, progress
        self._fitter = Fitter(problem, settings)

    def run(self) -> Found:
        """Search until the next depth, fully searched, passes no gate, or until the effort is spent."""
        with self._fitter.effort.on("the model alone"):
            declared, base = self._roots()
            needed = base is declared or self._fitter.compare(base, declared).sure
        self._depths, self._models = list[Depth](), dict[Key, FittedModel]()
        self._children, self._leaders = list[FittedModel](), list[FittedModel]()
        self._variants = Variants(self._fitter, declared, base)
        self._adoption = Adoption(self._fitter, self._variants)
        for root in (declared, base):
            self._note(root)
        self._best = self._adoption.take(base if needed else declared)
        ending: Ending = "complete"
        try:
            self._grow()
            while self._best.effects and self._challenged():
                self._grow()
        except EffortSpentError:
            ending = "effort_spent"
            self._close()
        except KeyboardInterrupt:
            ending = "interrupted"
        models, refused = tuple(self._models.values()), self._adoption.refused
        spent = dict(self._fitter.effort.by_step)
        return Found(declared, base, self._best, models, refused, tuple(self._depths), ending, spent)

    def _note(self, model: FittedModel) -> FittedModel:
        """Note a model that is fitted to the end."""
        self._models[model.key] = model
        return model

    def _roots(self) -> tuple[FittedModel, FittedModel]:
        """Return the base model as declared, and fitted; the same twice where the declared one is fixed."""
        noise = Noise.of_first_fit(self._problem.deviations, self._problem.sizes)
        start = np.array(self._problem.start)
        found = self._fitter.fit((), start, noise)
        if found is None:
            raise ValueError("the base model cannot predict with its declared parameters")
        base = self._fitter.reweighted(found)
        declared = np.array([one.centre for one in base.fit.model.parameters])
        as_declared = self._fitter.fit((), declared, noise, held=start.size) if base.refits else None
        return as_declared or base, base

    def _grow(self) -> None:
        """Adopt effects until no more than noise is left, or the next depth passes no gate."""
        if not (self._best.effects or self._best.at_floor):
            self._read()
        while len(self._best.effects) < self._settings.depth and not self._best.at_floor:
            self._progress(f"screening beside {self._best.label}: an NRMS of {100.0 * self._best.nrms:.3g} % is left")
            adopted = self._depth(self._best)
            if adopted is None:
                break
            self._best = self._adoption.take(adopted)

    def _read(self) -> None:
        """Take another reading of the base if it passes all gates: a base fitted under the wrong one is bent to it."""
        best, fitter = self._best, self._fitter
        with fitter.effort.on("the model alone"):
            tried = [Tried(self._note(one), fitter.compare(one, best)) for one in self._variants.readings()]
        with fitter.effort.on("gates of adoption"):
            adopted = self._adoption.best_of(sorted(tried, key=lambda one: -one.difference.total), best)
        if adopted is not None:
            self._best = self._adoption.take(self._note(adopted))

    def _challenged(self) -> bool:
        """Fit other effects in the place of each one of the best model; return whether a model takes its place."""
        best, fitter = self._best, self._fitter
        for index, effect in enumerate(best.effects):
            self._progress(f"trying others in the place of {effect.label}")
            with fitter.effort.on("others in the place of an effect"):
                rest = self._variants.refitted_without(best, index)
                for one in () if rest is None else self._variants.in_place(effect, rest, best):
                    self._note(fitter.reweighted(one))
        with fitter.effort.on("gates of adoption"):
            return self._overtaken()

    def _overtaken(self) -> bool:
        """Take a model that is surely better than the best one and passes all gates; return whether there is one."""
        best = self._best
        tried = [Tried(one, self._fitter.compare(one, best)) for one in self._models.values() if one is not best]
        for one in sorted(tried, key=lambda each: -each.difference.total):
            taken = self._adoption.instead(one, best)
            if taken is not None:
                self._best = self._note(self._adoption.take(taken))
                return True
        return False

    def _depth(self, best: FittedModel) -> FittedModel | None:
        """Return the best model with more effects that passes all gates; None: none does."""
        fitter = self._fitter
        before = fitter.fitted
        with fitter.effort.on("screening"):
            screening = self._variants.screened(best)
        noise = screening.noise
        with fitter.effort.on("rough fits"):
            self._try(best, screening, noise)
            for other in self._variants.otherwise_based(best):
                if other.refits:
                    self._children.append(other)
                if not best.effects:
                    beside = screen(fitter, other, noise).better_than(screening.alone)
                    self._try(other, beside, noise)
        with fitter.effort.on("fits to the end"):
            beam = self._beam((best, *self._children), noise)
            rest = [self._variants.with_better_forms(one, noise, self._settings.forms) for one in beam]
        tried, adopted = tuple[Tried, ...](), None
        while rest and adopted is None:
            with fitter.effort.on("fits to the end"):
                first = max(rest, key=lambda one: fitter.score(one, noise, roughly=True).total)
                behind = [one for one in rest if fitter.behind(one, first)]
                told = len(self._leaders)
                self._leaders += [self._note(fitter.reweighted(one)) for one in rest if one not in behind]
            with fitter.effort.on("gates of adoption"):
                tried, adopted = self._judged(best, told)
            # what is surely behind a model that is not surely better is no better either
            rest = behind if any(one.difference.sure for one in tried) else []
        self._children, self._leaders = [], []
        self._depths.append(Depth(best, screening, fitter.fitted - before, tried, adopted))
        return adopted

    def _judged(self, best: FittedModel, told: int = 0) -> tuple[tuple[Tried, ...], FittedModel | None]:
        """Return the leaders of a depth compared with the best model, and what is adopted of them.

        Args:
            told: number of the first ones that people were told of.
        """
        fitter = self._fitter
        tried = [Tried(one, fitter.compare(one, best)) for one in self._leaders]
        fresh = tried[told:]
        tried.sort(key=lambda one: -one.difference.total)
        for one in sorted(fresh, key=lambda each: -each.difference.total):
            d = one.difference
            left = f"NRMS {100.0 * one.model.nrms:.3g} %, gain {d.total:.1f} +- {d.error:.1f}"
            self._progress(f"  {one.model.label}: {left}")
        adopted = self._adoption.best_of(tried, best)
        return tuple(tried), None if adopted is None else self._note(adopted)

    def _close(self) -> None:
        """Judge the best one of what is at hand when the effort is spent: it is the result if it passes all gates."""
        fitter = self._fitter
        fitter.effort.most = math.inf
        self._progress("the effort is spent: judging the best model so far")
        with fitter.effort.on("after the effort was spent"):
            first = self._beam((self._best, *(self._leaders or self._children)), self._best.noise)[:1]
            self._leaders = [self._note(fitter.reweighted(one)) for one in first]
            _, adopted = self._judged(self._best)
            if adopted is not None:
                self._best = self._adoption.take(adopted)

    def _try(self, model: FittedModel, screening: Screening, noise: Noise) -> None:
        """Fit the model roughly with each of the effects and pairs that the screening puts first."""
        fitter, forms = self._fitter, dict[str, int]()
        tried: list[tuple[Start, ...]] = []
        for start, _ in screening.singles:
            # nuisance amplitudes are no function of a start: what they do is hardly seen to first order
            forms[start.effect.name] = forms.get(start.effect.name, 0) + (not start.effect.nuisance)
            if forms[start.effect.name] <= self._settings.forms:
                tried.append((start,))
        for starts in (*tried[: self._settings.singles], *(pair for pair, _ in screening.pairs)):
            grown = fitter.extended(model, starts, noise)
            if grown is not None:
                self._children.append(fitter.rough(grown, noise))

    def _beam(self, models: Sequence[FittedModel], noise: Noise) -> list[FittedModel]:
        """Return the best models of different effects, none with an effect that it does not need.

        Args:
            models: the one beside which the others were found, and these.
        """

        def total(one: FittedModel) -> float:
            return self._fitter.score(one, noise, roughly=True).total

        found: list[FittedModel] = []
        for model in sorted(models[1:], key=lambda one: -total(one)):
            simpler = [one for one in models if one.changes < model.changes]
            if any(one.names == model.names for one in found):
                continue
            if not any(total(one) > total(model) - LEAST for one in simpler):
                found.append(model)
        return found[: self._settings.beam]
