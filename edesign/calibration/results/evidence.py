"""What the models of a search say of its effects, whatever the tests are of: verdict, probability, what stands."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

from edesign.calibration.residual.series import Errors, Stage, Worst
from edesign.calibration.results.fit import effect_estimates, estimates, unbounded
from edesign.calibration.results.floor import only_noise
from edesign.calibration.results.models import Posterior, without
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import (
    Calibration,
    ComparedModel,
    Effect,
    Estimate,
    Hypothesis,
    NextTest,
    OtherLaw,
    SearchDepth,
    Verdict,
)
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.adoption import Dropped, Kept, misleads
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.search import Ending, Found
from edesign.calibration.search.settings import SearchSettings
from edesign.damper.testing.measured_histories import Use

T = TypeVar("T")
MODELS = "comparing the models of the search"
NEXT_TEST = "asking which further test would tell more"
OTHER_LAW = "asking whether another law does better"
"""Steps of a calibration that it can do without."""
NOT_DESCRIBED = "more than noise, which could not be described"


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the models of a search say of the effects that it found.

    Attributes:
        settings: of the search.
        found: by it.
        refit: the base model fitted again.
        kept: the model that stands, and what was taken off it.
        every_error: of the tests by stage; corrected: with the effects, even if they are withheld in the end.
        validate: NRMS of the validation tests by a model; nan: it cannot predict them.
        not_carried: why no file carries an effect of a model, by its index, for people; "" if one does.
    """

    settings: SearchSettings
    found: Found
    refit: FittedModel
    kept: Kept
    every_error: Mapping[Stage, Errors]
    validate: Callable[[FittedModel], float]
    not_carried: Callable[[FittedModel, int], str]

    @cached_property
    def fitter(self) -> Fitter:
        """Fits models at the sampling of the search, without a limit."""
        return unbounded(self.found.base.problem, self.settings)

    @cached_property
    def withheld(self) -> str:
        """Why the effects are no part of the corrected model, for people: the validation tests; "" if they are."""
        corrected, refit = (self.every_error[stage].validate for stage in ("corrected", "refit"))
        if not self.kept.model.effects or not misleads(corrected, refit):
            return ""
        return (
            f"with the effects the validation tests are predicted worse ({100.0 * corrected:.3g} %) than without them "
            f"({100.0 * refit:.3g} %)"
        )

    @property
    def final(self) -> FittedModel:
        """The corrected model."""
        return self.refit if self.withheld else self.kept.model

    @property
    def errors(self) -> dict[Stage, Errors]:
        """Errors by stage."""
        return self.staged(self.every_error)

    def staged(self, every: Mapping[Stage, T]) -> dict[Stage, T]:
        """Return what each stage has: the corrected one that of the refit where the effects are withheld.

        Args:
            every: by stage; corrected: with the effects.
        """
        return {**every, "corrected": every["refit"]} if self.withheld else dict(every)

    def calibration(
        self,
        steps: Steps,
        floor: Mapping[Use, float],
        worst: Worst | None,
        shape: Callable[[], str],
        next_test: Callable[[], NextTest | None] | None = None,
        other_law: Callable[[], OtherLaw | None] | None = None,
        **facts: Any,
    ) -> Calibration:
        """Return all of it for people and files.

        Args:
            steps: taken after the search.
            floor: NRMS of what no model can predict, by the use of tests.
            worst: test that leaves more than noise.
            shape: says in words what is left.
            next_test: asks which further test would tell more.
            other_law: asks whether another law does better; it is asked where more than noise is left.
            facts: all else of a calibration, by its names there.
        """
        errors = self.errors
        reached = only_noise(errors["corrected"], floor, worst)
        effects, hypotheses = self.effects(steps)
        verdict = verdict_of(reached, bool(effects), steps.ending)
        further = better = None
        if next_test is not None:
            further = steps.take(NEXT_TEST, next_test, None)
        if other_law is not None and not reached:
            better = steps.take(OTHER_LAW, other_law, None)
        left = "" if reached else steps.guard("describing what is left", shape, NOT_DESCRIBED)
        compared: tuple[ComparedModel, ...] = ()
        if steps.ending != "interrupted":
            compared = steps.guard(MODELS, lambda: self.posterior.compared(), ())
        return Calibration(
            verdict=verdict,
            ending=steps.ending,
            errors=errors,
            noise_floor=floor["validate"],
            noise_floor_fit=floor["fit"],
            effects=effects,
            hypotheses=hypotheses,
            unexplained_share=0.0 if reached else _unexplained_share(errors, floor["validate"]),
            unexplained_shape=left,
            models=compared,
            depths=_depths_of(self.found),
            forms=len(self.fitter.problem.effects),
            effort=self.found.effort,
            most_effort=self.settings.effort,
            next_test=further,
            other_law=better,
            worst=worst,
            failed=dict(steps.failed),
            **facts,
        )

    @cached_property
    def posterior(self) -> Posterior:
        """The posterior over the models of the search, about the one that stands."""
        best, final = self.found.best, self.kept.model
        if self.kept.dropped:
            best = self.fitter.fit(final.effects, final.fit.values, best.noise) or best
        return Posterior.of(self.fitter, self.found, best)

    def effects(self, steps: Steps) -> tuple[tuple[Effect, ...], tuple[Hypothesis, ...]]:
        """Return the effects of the corrected model, and those that were found and are no part of it.

        Args:
            steps: taken after the search.
        """
        model, corrected = self.kept.model, self.every_error["corrected"].validate
        every = range(len(model.effects))
        found = steps.take(
            MODELS,
            lambda: tuple(self._effect(self.posterior, model, i, i, corrected) for i in every),
            None,
            True,
        )
        posterior = self.posterior if found is not None else None
        dropped = [
            Hypothesis(self._effect(posterior, one.model, one.index, None, corrected), why_dropped(one))
            for one in self.kept.dropped
        ]
        if found is None:  # interrupted, or failed
            found = tuple(self._effect(None, model, i, i, corrected) for i in every)
        if self.withheld:
            return (), (*(Hypothesis(one, self.withheld) for one in found), *dropped)
        return found, tuple(dropped)

    def _effect(
        self, posterior: Posterior | None, model: FittedModel, index: int, stands: int | None, corrected: float
    ) -> Effect:
        """Return an effect of a model; it is one of the model that stands, or none of that.

        Args:
            posterior: over the models of the search; None: not asked.
            model: with the effect.
            index: of the effect.
            stands: index of it in the model that stands; None: it is not in that.
            corrected: NRMS of the validation tests with it.
        """
        effect = model.effects[index]
        rise, gain, error, alike, probability = math.nan, math.nan, math.nan, dict[str, float](), math.nan
        titles: Mapping[str, str] = {}
        if posterior is not None:
            probability = posterior.probability(effect.name)
        if posterior is not None and stands is not None:
            alike, titles = posterior.indistinguishable_from(effect.name), posterior.titles(effect.name)
            fewer, ahead = without(posterior, stands)
            if fewer is not None and ahead is not None:
                gain, error = ahead.total, ahead.error
                rise = self.validate(fewer) - corrected
        return Effect(
            name=effect.name,
            form=effect.form,
            kind=effect.kind,
            title=effect.data.title,
            signature=effect.data.signature,
            parameters=effect_estimates(model, estimates(model), index),
            fixed=dict(effect.data.constants),
            delta_validate=rise,
            gain=gain,
            gain_error=error,
            probability=probability,
            indistinguishable_from=alike,
            not_carried=self.not_carried(model, index),
            meanings=effect.data.meanings,
            titles=titles,
        )


def why_dropped(one: Dropped) -> str:
    """Return why an effect that was found is no part of the corrected model, for people.

    Args:
        one: the effect.
    """
    if one.interval is None:
        left = f"with it the validation tests are predicted worse ({100.0 * one.with_it:.3g} %) than without it"
        return f"{left} ({100.0 * one.without:.3g} %)"
    own = one.model.effects[one.index].parameters
    values = one.model.fit.values[one.model.places(one.index)].tolist()
    siblings = {each.name: Estimate.held(value, each.unit) for each, value in zip(own, values, strict=True)}
    shown = practical(Estimate(values[0], 0.0, own[0].unit, one.interval), siblings)
    low, high = shown.interval
    return f"the 95 % interval of {own[0].name}, {low:.3g} to {high:.3g} {shown.unit}".rstrip() + ", holds zero"


def verdict_of(reached: bool, effects: bool, ending: Ending) -> Verdict:
    """Return the verdict.

    Args:
        reached: whether only noise is left.
        effects: whether there are any in the corrected model.
        ending: of the search.
    """
    if effects:
        return "explained" if reached else "partly_explained"
    if reached:
        return "none"
    return "nothing_found" if ending == "complete" else "not_searched"


def _unexplained_share(errors: Mapping[Stage, Errors], noise: float) -> float:
    """Return the share of the excess over noise of the refitted model that is left in the validation tests."""
    over = max(errors["refit"].validate - noise, 1e-300)
    return min(max((errors["corrected"].validate - noise) / over, 0.0), 1.0)


def _depths_of(found: Found) -> tuple[SearchDepth, ...]:
    """Return the rounds of a search for people."""
    return tuple(
        SearchDepth(
            _labels(one.best), one.screening.screened, one.fitted, () if one.adopted is None else _labels(one.adopted)
        )
        for one in found.depths
    )


def _labels(model: FittedModel) -> tuple[str, ...]:
    return tuple(effect.label for effect in model.effects)
