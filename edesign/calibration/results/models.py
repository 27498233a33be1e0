"""Which models of a search the tests leave probable: the posterior over all that were fitted to the end."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from edesign.calibration.results.result import ComparedModel
from edesign.calibration.search.adoption import sure
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found
from edesign.estimation.left_out import Difference, Score, difference
from edesign.estimation.noise import Noise

LEAST = 0.01
"""Probability of a model that is worth a word, or a test."""

_SHOWN = 8  # models
_FAR = 50.0  # log density: what is that far behind has no share, however exactly it is known


@dataclass(frozen=True, eq=False)
class Posterior:
    """Models of a search with weights exp(score), as the last round of the search that adopted one compared them.

    Attributes:
        fitter: of the problem at the sampling of a fit.
        best: the model that stands.
        known: the model beside which the last effect was found, whose equations may be wrong.
        models: all of them, the best one first.
        searched: by the effects of a rival or a richer model, how far the search itself found it ahead of the best one,
            which it compared beside what both have in common.
    """

    fitter: Fitter
    best: FittedModel
    known: FittedModel
    models: tuple[FittedModel, ...]
    searched: Mapping[tuple[str, ...], Difference] = field(default_factory=dict)

    @staticmethod
    def of(fitter: Fitter, found: Found, best: FittedModel) -> Posterior:
        """Return the posterior over the models of a search.

        Args:
            fitter: of the problem at the sampling of a fit.
            best: the model that stands, at that sampling.
        """
        every = {_key(model): model for model in (*_models(found), best)}
        others = [model for key, model in every.items() if key != _key(best)]
        known = [depth.best for depth in found.depths if depth.adopted is not None]
        rivals = [one for of_effect in found.rivals for one in of_effect] if best is found.best else []
        richer = [one for depth in found.depths if depth.best is best for one in depth.tried]
        searched = {_key(one.model): one.difference for one in (*richer, *rivals)}
        return Posterior(fitter, best, known[-1] if known else found.base, (best, *others), searched)

    @cached_property
    def noise(self) -> Noise:
        """By which they are compared."""
        return self.fitter.noise(self.best, self.known)

    @cached_property
    def scores(self) -> tuple[Score, ...]:
        """Of each model; one that may be the best is fitted again without tests that move it far."""
        rough = [self.score(model, sure=False) for model in self.models]
        least = max(one.total for one in rough) - _FAR
        both = zip(self.models, rough, strict=True)
        return tuple(one if one.total < least else self.score(model) for model, one in both)

    def score(self, model: FittedModel, sure: bool = True) -> Score:
        """Return the score of a model.

        Args:
            model: at the sampling of a fit.
            sure: whether it is fitted again without a test that moves it far.
        """
        return self.fitter.score(model, self.noise, self.known, sure)

    @cached_property
    def probabilities(self) -> np.ndarray:
        """Of each model (n,)."""
        totals = np.array([-self.behind(i).total for i in range(len(self.models))])
        totals[np.isnan(totals)] = -np.inf  # of which tests left out say nothing
        totals[0] = 0.0
        weights = np.exp(totals - totals.max())
        return np.asarray(weights / weights.sum())

    def behind(self, i: int) -> Difference:
        """Return by how much a model is behind the best one."""
        known = self.searched.get(_key(self.models[i]))
        if known is not None:
            return Difference(-known.total, known.error)
        return difference(self.scores[0], self.scores[i])

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
            title = " and ".join(f"{one.data.title} ({one.kind})" for one in others)
            other = " and ".join(one.name for one in others)
            found[other] = max(found.get(other, (-1.0, "")), (self.odds(i), title))
        return {other: title for other, (_, title) in found.items()}

    def _in_place_of(self, name: str) -> Iterator[tuple[int, list[Effect]]]:
        """Models that are not surely behind the best one, with the effects that stand in the place of one of it."""
        for i, model in enumerate(self.models):
            others = sorted((one for one in model.effects if one.name not in self.best.names), key=lambda one: one.name)
            if name not in model.names and others and self.odds(i) >= LEAST and not sure(self.behind(i)):
                yield i, others

    def odds(self, i: int) -> float:
        """Return the odds of a model beside the best one."""
        behind = self.behind(i).total
        return 0.0 if math.isnan(behind) else math.exp(min(-behind, _FAR))

    def rivals(self) -> tuple[int, ...]:
        """Indices of the probable models with other effects than the best one, which is the first."""
        far = [self.odds(i) < LEAST or sure(self.behind(i)) for i in range(len(self.models))]
        return (0, *(i for i, m in enumerate(self.models) if m.names != self.best.names and not far[i]))

    def compared(self) -> tuple[ComparedModel, ...]:
        """Return the models for people, the most probable first."""
        order = sorted(range(len(self.models)), key=lambda i: (-self.probabilities[i], i))
        return tuple(self._compared(i) for i in order[:_SHOWN])

    def _compared(self, i: int) -> ComparedModel:
        model, behind = self.models[i], self.behind(i)
        labels = tuple(effect.label for effect in model.effects)
        return ComparedModel(labels, model.nrms, behind.total, behind.error, float(self.probabilities[i]))


def _key(model: FittedModel) -> tuple[str, ...]:
    return tuple(sorted(effect.label for effect in model.effects))


def _models(found: Found) -> Iterator[FittedModel]:
    """All models that the search fitted to the end."""
    yield found.base
    for depth in found.depths:
        yield from (one.model for one in depth.tried)
        if depth.adopted is not None:
            yield depth.adopted
    for of_effect in found.rivals:
        yield from (one.model for one in of_effect)
    yield found.best


def without(posterior: Posterior, index: int) -> tuple[FittedModel | None, Difference | None]:
    """Return the best model without one of its effects, the others fitted again, and how far that is behind."""
    best, fitter = posterior.best, posterior.fitter
    others, values = best.without(index)
    rough = fitter.fit(others, values, best.noise)
    # the noise of the best one is far below what is left without the effect
    again = None if rough is None else fitter.fit(others, rough.fit.values, rough.noise)
    if again is None:
        return None, None
    fewer = fitter.reweighted(again)
    return fewer, difference(posterior.score(best), posterior.score(fewer))
