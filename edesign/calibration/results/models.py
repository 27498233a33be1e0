"""Which models of a search the tests leave probable: the posterior over all that were fitted to the end."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import numpy as np

from edesign.calibration.results.result import ComparedModel
from edesign.calibration.search.models import FittedModel, Fitter, Key
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found
from edesign.estimation.left_out import LEAST as LEAST_GAIN
from edesign.estimation.left_out import Difference

LEAST = 0.01
"""Probability of a model that is worth a word, or a test."""

_SHOWN = 8  # models
_FAR = 50.0  # log density: what is that far behind has no share, however exactly it is known


@dataclass(frozen=True, eq=False)
class Posterior:
    """Models of a search, each compared with the one that stands by the rule of adoption.

    Models that a gate refuses have no share. Of the others the odds are those of the comparison. Every effect more has
    the prior odds at which the rule begins to see a gain. Both are moderated together by the error of the comparison.

    Source: moderated odds: MacKay (1992), Neural Computation 4, 720-736, Eq. 10.

    Attributes:
        fitter: of the problem at the sampling of a fit.
        best: the model that stands.
        models: all of them, the best one first.
        refused: why some of them are none to adopt, for people, by their key.
        judged_by: model beside which the search judged them, for people, if that is not the one that stands.
    """

    fitter: Fitter
    best: FittedModel
    models: tuple[FittedModel, ...]
    refused: Mapping[Key, str] = field(default_factory=dict)
    judged_by: str = ""

    @staticmethod
    def of(
        fitter: Fitter,
        found: Found,
        best: FittedModel,
        refused: Mapping[Key, str] = MappingProxyType({}),
        judged_by: str = "",
    ) -> Posterior:
        """Return the posterior over the models of a search.

        Args:
            fitter: of the problem at the sampling of a fit.
            best: the model that stands, at that sampling.
            refused: why models are none to adopt, for people, by their key.
            judged_by: model beside which the search judged them, for people, if that is not the one that stands.
        """
        every = {model.key: model for model in (*found.models, found.best, best)}
        others = (model for key, model in every.items() if key != best.key)
        return Posterior(fitter, best, (best, *others), refused, judged_by)

    @cached_property
    def _behind(self) -> tuple[Difference, ...]:
        return tuple(self.fitter.compare(self.best, one) for one in self.models)

    def behind(self, i: int) -> Difference:
        """Return by how much a model is behind the best one."""
        return self._behind[i]

    @cached_property
    def probabilities(self) -> np.ndarray:
        """Of each model (n,)."""
        weights = np.array([self.odds(i) for i in range(len(self.models))])
        return np.asarray(weights / weights.sum())

    def odds(self, i: int) -> float:
        """Return the odds of a model beside the best one."""
        if i == 0:
            return 1.0
        model, behind = self.models[i], self.behind(i)
        if model.key in self.refused or math.isnan(behind.total):
            return 0.0
        return _odds(behind, len(model.effects) - len(self.best.effects))

    def why_not(self, i: int) -> str:
        """Return why a model that is ahead, or refused, is not the one that stands; "" if it is behind."""
        behind = self.behind(i)
        if self.models[i].key in self.refused:
            return self.refused[self.models[i].key]
        if i == 0 or not behind.total < 0.0:
            return ""
        if Difference(-behind.total, behind.error).sure:
            beside = f"not surely better than {self.judged_by}, beside which the search judged it"
            return beside if self.judged_by else "the search ended before it had passed all gates"
        return f"ahead by less than the rule asks: {max(LEAST_GAIN, 2.0 * behind.error):.3g}"

    def probability(self, name: str) -> float:
        """Return the probability of an effect, whatever its equation and what is beside it."""
        return float(sum(p for p, m in zip(self.probabilities, self.models, strict=True) if name in m.names))

    def indistinguishable_from(self, name: str) -> dict[str, float]:
        """Return what the tests cannot separate from an effect of the best model: other effects in its place.

        They stand in models that are not surely behind the best one, by the rule of adoption. A richer model that is
        ahead, though not surely, takes nothing off them.

        Returns:
            Probability of each by name beside the best model, at most one half, the most probable first.
        """
        found: dict[str, float] = {}
        for i, others in self._in_place_of(name):
            other = " and ".join(one.name for one in others)
            found[other] = min(found.get(other, 0.0) + self.odds(i), 1.0)
        return {name: odds / (1.0 + odds) for name, odds in sorted(found.items(), key=lambda one: -one[1])}

    def titles(self, name: str) -> dict[str, str]:
        """Return what those effects are, for people: of each its most probable equation, by name."""
        found: dict[str, tuple[float, str]] = {}
        for i, others in self._in_place_of(name):
            values, places = self.models[i].fit.values, self.models[i].places
            own = {effect.name: values[places(k)] for k, effect in enumerate(self.models[i].effects)}
            title = " and ".join(f"{one.data.words(own[one.name]).title} ({one.kind})" for one in others)
            other = " and ".join(one.name for one in others)
            found[other] = max(found.get(other, (-1.0, "")), (self.odds(i), title))
        return {other: title for other, (_, title) in found.items()}

    def other_equations(self, index: int) -> dict[str, tuple[float, str]]:
        """Return what the tests cannot separate from an instrument's effect of the best model, of the same name.

        Which channel is wrong is no detail: beside a linear law a gain of the force and one of the displacement are one
        equation. The nearest equations are fitted in the place of the effect, and compared by the rule of adoption.

        Returns:
            Probability beside the best model, at most one half, and what it is, for people, by label.
        """
        best, fitter, effect = self.best, self.fitter, self.best.effects[index]
        if effect.kind != "instrument" or not effect.parameters:
            return {}
        found: dict[str, tuple[float, str]] = {}
        for placed in fitter.nearest_equations(best, index, best.noise, fitter.settings.forms, here=True):
            other = fitter.reweighted(placed)
            behind, odds = fitter.compare(best, other), 0.0
            if not behind.sure and not math.isnan(behind.total):
                odds = min(_odds(behind, 0), 1.0)
            if odds >= LEAST:
                form = other.effects[index]
                words = form.data.words(other.fit.values[other.places(index)])
                found[form.label] = odds / (1.0 + odds), f"{words.title} ({form.kind})"
        return found

    def _in_place_of(self, name: str) -> Iterator[tuple[int, list[Effect]]]:
        """Models of no more effects that are not surely behind, with those that stand in the place of one."""
        for i, model in enumerate(self.models):
            others = sorted((one for one in model.effects if one.name not in self.best.names), key=lambda one: one.name)
            no_more = len(model.effects) <= len(self.best.effects)
            if name not in model.names and others and no_more and self.odds(i) >= LEAST and not self.behind(i).sure:
                yield i, others

    def rivals(self) -> tuple[int, ...]:
        """Indices of the probable models with other effects than the best one, which is the first."""
        far = [self.odds(i) < LEAST or self.behind(i).sure for i in range(len(self.models))]
        return (0, *(i for i, m in enumerate(self.models) if m.names != self.best.names and not far[i]))

    def compared(self, error: Callable[[FittedModel], float]) -> tuple[ComparedModel, ...]:
        """Return the models for people: the one that stands, then what is ahead of it, then the others.

        Args:
            error: NRMS of the tests fitted to by a model, of all samples alike.
        """
        order = sorted(range(len(self.models)), key=lambda i: (i > 0, self.behind(i).total))
        return tuple(self._compared(i, error(self.models[i])) for i in order[:_SHOWN])

    def _compared(self, i: int, error: float) -> ComparedModel:
        model, behind = self.models[i], self.behind(i)
        labels = tuple(effect.label for effect in model.effects)
        both = behind.total, behind.error
        return ComparedModel(labels, model.refits, error, *both, float(self.probabilities[i]), self.why_not(i))


def _odds(behind: Difference, more: int) -> float:
    """Return the odds of a model that is so far behind, with so many effects more."""
    moderated = (behind.total + LEAST_GAIN * more) / math.sqrt(1.0 + math.pi / 8.0 * behind.error**2)
    return math.exp(min(-moderated, _FAR))


def without(posterior: Posterior, index: int) -> tuple[FittedModel | None, Difference | None]:
    """Return the best model without one of its effects, all else fitted again, and how far that is behind."""
    best, fitter = posterior.best, posterior.fitter
    fewer = fitter.omitting(best, index, 0)
    return fewer, None if fewer is None else fitter.compare(best, fewer)
