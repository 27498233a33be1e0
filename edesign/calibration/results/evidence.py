"""What the models of a search say of its effects, whatever the tests are of: verdict, probability, what stands."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Generic, TypeVar

import numpy as np

from edesign.calibration.residual.curves import FreeCurve
from edesign.calibration.residual.series import STAGES, Errors, Stage, Worst
from edesign.calibration.results.fit import effect_estimates, estimates, unbounded
from edesign.calibration.results.floor import only_noise
from edesign.calibration.results.kept import Dropped, Kept, kept, misleads
from edesign.calibration.results.models import Posterior, without
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import (
    Calibrated,
    Calibration,
    ComparedModel,
    Effect,
    Estimate,
    Hypothesis,
    NextTest,
    OtherLaw,
    OutlyingTest,
    SearchDepth,
    Verdict,
)
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.adoption import Gate, Refusal
from edesign.calibration.search.models import FittedModel, Fitter, Key
from edesign.calibration.search.problem import Effect as SearchedEffect
from edesign.calibration.search.search import Ending, Found
from edesign.calibration.search.settings import SearchSettings
from edesign.damper.testing.measured_histories import Use
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import MOST

T = TypeVar("T")
S = TypeVar("S")
MODELS = "comparing the models of the search"
NEXT_TEST = "asking which further test would separate the models"
OTHER_LAW = "asking whether another law does better"
OUTLYING = "asking whether a test does not agree with the others"
CURVES = "fitting curves to what is left"
"""Steps of a calibration that it can do without."""
NOT_DESCRIBED = "more than noise, which could not be described"


@dataclass(frozen=True, eq=False)
class Evidence(ABC, Generic[T]):
    """What the models of a search say of the effects that it found, and of all tests of a campaign.

    What tests are of says which class below this one it is: its predictions T of all tests, errors, floor and words.

    Attributes:
        found: by the search.
        settings: of the search.
        declared: the base model as declared.
        refit: the base model fitted again.
        kept: the model that stands, and what was taken off it.
    """

    found: Found
    settings: SearchSettings
    declared: FittedModel
    refit: FittedModel
    kept: Kept

    asked: ClassVar[tuple[str, ...]] = (NEXT_TEST,)
    """Further steps that are taken."""

    @abstractmethod
    def predict(self, effects: Sequence[SearchedEffect], values: np.ndarray) -> T:
        """Return what a model predicts of all tests.

        Args:
            values: (p,) SI.

        Raises:
            PredictionError: there is no prediction.
        """

    @abstractmethod
    def errors_of(self, predicted: T) -> Errors:
        """Return the errors of a prediction."""

    @abstractmethod
    def not_carried(self, model: FittedModel, index: int) -> str:
        """Return why no file carries an effect of a model, for people; "" if one does."""

    @abstractmethod
    def floor(self) -> tuple[Mapping[Use, float], Worst | None]:
        """Return the NRMS of what no model can predict by the use of tests, and the test that leaves more than that."""

    def doubtful(self) -> str:
        """Return why that floor does not say whether only noise is left, for people; "" if it does."""
        return ""

    def interpolated(self) -> Mapping[Use, float]:
        """Return the part of that floor, NRMS, of what is not known of motions between samples, by the use of tests."""
        return {}

    @abstractmethod
    def floor_with_effects(self) -> Mapping[Use, float]:
        """Return the same NRMS with the effects that were found, even if they are withheld."""

    @abstractmethod
    def shape(self) -> str:
        """Return in words what is left."""

    @property
    def curves(self) -> tuple[FreeCurve, ...]:
        """What smooth functions of displacement and velocity take of what is left, where it is a damper's force."""
        return ()

    @abstractmethod
    def calibrated(self) -> Calibrated:
        """Return the campaign, and its model at each stage."""

    def next_test(self) -> NextTest | None:
        """Return which further test would separate the models."""
        raise NotImplementedError

    def other_law(self) -> OtherLaw | None:
        """Return a law that does better. It is asked for where more than noise is left."""
        raise NotImplementedError

    def outlying(self) -> tuple[OutlyingTest, ...]:
        """Return tests that do not agree with the others."""
        raise NotImplementedError

    @cached_property
    def every_prediction(self) -> dict[Stage, T]:
        """Predictions of all tests by stage; corrected: with the effects, even if they are withheld."""
        stands = self.kept.model
        return {
            "declared": self.predict((), self.declared.fit.values),
            "refit": self.predict((), self.refit.fit.values),
            "corrected": self.predict(stands.effects, stands.fit.values),
        }

    def validate(self, model: FittedModel) -> float:
        """Return the NRMS of the validation tests by a model; nan: it cannot predict them."""
        try:
            error = self.errors_of(self.predict(model.effects, model.fit.values)).validate
        except PredictionError:
            return math.nan
        return error if math.isfinite(error) else math.nan

    @cached_property
    def fitter(self) -> Fitter:
        """Fits models at the sampling of the search, without a limit."""
        return unbounded(self.found.base.problem, self.settings)

    @cached_property
    def every_error(self) -> dict[Stage, Errors]:
        """Errors by stage; corrected: with the effects, even if they are withheld."""
        return {stage: self.errors_of(self.every_prediction[stage]) for stage in STAGES}

    @cached_property
    def plain(self) -> Stage:
        """Which model without effects predicts the validation tests better; the search's own one if both do alike."""
        declared, refit = (self.every_error[stage].validate for stage in ("declared", "refit"))
        if misleads(refit, declared):
            return "declared"
        as_declared = self.found.declared is not self.found.base and not self.found.best.refits
        return "declared" if as_declared and not misleads(declared, refit) else "refit"

    @cached_property
    def withheld(self) -> str:
        """Why the effects are no part of the corrected model, for people; "" if they are."""
        if not self.kept.model.effects:
            return ""
        corrected, plain = (self.every_error[stage].validate for stage in ("corrected", self.plain))
        if misleads(corrected, plain):
            worse = f"with the effects the validation tests are predicted worse ({100.0 * corrected:.3g} %)"
            return f"{worse} than without them ({100.0 * plain:.3g} %)"
        left = unexplained_share(self.every_error, self.plain, self.floor_with_effects())
        if left > 1.0 - self.settings.share:
            return f"more is left than they explain: {100.0 * left:.3g} % of what is above noise"
        return ""

    @property
    def final(self) -> FittedModel:
        """The corrected model."""
        return self.kept.model if self.kept.model.effects and not self.withheld else self.alone

    @property
    def alone(self) -> FittedModel:
        """The model without effects that predicts the validation tests better, as declared or fitted again."""
        return self.declared if self.plain == "declared" else self.refit

    @property
    def errors(self) -> dict[Stage, Errors]:
        """Errors by stage."""
        return self._staged(self.every_error)

    @property
    def predicted(self) -> dict[Stage, T]:
        """Predictions of all tests by stage."""
        return self._staged(self.every_prediction)

    def _staged(self, every: Mapping[Stage, S]) -> dict[Stage, S]:
        """Return what each stage has: the corrected one that of a model without effects where there are none."""
        effects = self.kept.model.effects and not self.withheld
        return {**every, "corrected": every["corrected" if effects else self.plain]}

    def calibration(self, steps: Steps) -> Calibration:
        """Return all of it for people and files."""
        errors, calibrated, (floor, worst) = self.errors, self.calibrated(), self.floor()
        doubtful, interpolated = self.doubtful(), self.interpolated()
        reached = only_noise(errors["corrected"], floor, worst) and not doubtful
        effects, hypotheses = self.effects(steps)
        verdict = verdict_of(reached, bool(effects), steps.ending)
        further = better = None
        if NEXT_TEST in self.asked:
            further = steps.take(NEXT_TEST, self.next_test, None)
        if OTHER_LAW in self.asked and not reached:
            better = steps.take(OTHER_LAW, self.other_law, None)
        outlying: tuple[OutlyingTest, ...] = ()
        if OUTLYING in self.asked:
            outlying = steps.take(OUTLYING, self.outlying, ())
        left = "" if reached else steps.guard("describing what is left", self.shape, NOT_DESCRIBED)
        compared: tuple[ComparedModel, ...] = ()
        if steps.ending != "interrupted":
            compared = steps.guard(MODELS, lambda: self.standing.compared(self._fit_error), ())
        return Calibration(
            **{**vars(calibrated), "as_declared": not calibrated.law_fixed and not self.final.refits},
            verdict=verdict,
            ending=steps.ending,
            errors=errors,
            noise_floor=floor["validate"],
            noise_floor_fit=floor["fit"],
            interpolation=interpolated.get("validate", 0.0),
            interpolation_fit=interpolated.get("fit", 0.0),
            doubtful=doubtful,
            effects=effects,
            hypotheses=hypotheses,
            unexplained_share=0.0 if reached else unexplained_share(errors, self.plain, floor),
            unexplained_shape=left,
            unexplained_curves=() if reached else steps.guard(CURVES, lambda: self.curves, ()),
            models=compared,
            depths=_depths_of(self.found),
            forms=len(self.fitter.problem.effects),
            effort=sum(self.found.effort.values()),
            effort_by_step=dict(self.found.effort),
            most_effort=self.settings.effort,
            next_test=further,
            other_law=better,
            outlying=outlying,
            worst=worst,
            failed=dict(steps.failed),
        )

    def _fit_error(self, model: FittedModel) -> float:
        """Return the NRMS of the tests fitted to, as all errors are; nan: a model cannot predict them."""
        if model is self.standing.best:
            return self.errors["corrected"].fit
        try:
            return self.errors_of(self.predict(model.effects, model.fit.values)).fit
        except PredictionError:
            return math.nan

    @cached_property
    def posterior(self) -> Posterior:
        """The posterior over the models of the search, about the one with the effects that were kept."""
        best, kept = self.found.best, self.kept.model
        if self.kept.dropped or best.fit.held != kept.fit.held:
            best = self.fitter.fit(kept.effects, kept.fit.values, best.noise, held=kept.fit.held) or best
        return Posterior.of(self.fitter, self.found, best, self._refused, self._judged_by(best))

    def _judged_by(self, stands: FittedModel) -> str:
        """Return beside which law alone the search judged effects, for people; "" if that stands or it found some."""
        best = self.found.best
        return "" if best.effects or best.key == stands.key else f"the law {'fitted' if best.refits else 'as declared'}"

    @cached_property
    def standing(self) -> Posterior:
        """The posterior over the models of the search, about the one that stands."""
        if self.final is self.kept.model:
            return self.posterior
        best = self.found.declared if self.plain == "declared" else self.found.base
        refused, kept = self._refused, self.kept.model
        if self.withheld:
            others = f"not surely better than {kept.label}, which is withheld"
            withheld = {one.key: others for one in self.found.models if one.effects}
            refused = {**withheld, kept.key: self.withheld, **refused}
        return Posterior.of(self.fitter, self.found, best, refused, self._judged_by(best))

    @cached_property
    def _refused(self) -> dict[Key, str]:
        """Why models that the search looked at are none to adopt, for people."""
        found = {key: refusal_words(one) for key, one in self.found.refused.items()}
        for one in self.kept.dropped:
            label = one.model.effects[one.index].label
            rest = one.model.label if len(one.model.effects) > 1 else "the law"
            others = f"{label} was taken off {rest} after the search"
            found |= {m.key: others for m in self.found.models if label in m.key}
            found[one.model.key] = f"{label}: {why_dropped(one)}"
        return found

    def effects(self, steps: Steps) -> tuple[tuple[Effect, ...], tuple[Hypothesis, ...]]:
        """Return the effects of the corrected model, and those that were found and are no part of it."""
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
            stands: index of it in the model that stands; None: it is not in that.
            corrected: NRMS of the validation tests with it.
        """
        effect = model.effects[index]
        own = model.fit.values[model.places(index)]
        words, twin = effect.data.words(own), effect.data.twin
        rise, gain, error, confounded, probability = math.nan, math.nan, math.nan, dict[str, float](), math.nan
        titles: dict[str, str] = {}
        if posterior is not None:
            probability = posterior.probability(effect.name)
        if posterior is not None and stands is not None:
            confounded, titles = posterior.indistinguishable_from(effect.name), posterior.titles(effect.name)
            for label, (likely, title) in posterior.other_equations(stands).items():
                confounded[label], titles[label] = likely, title
            fewer, ahead = without(posterior, stands)
            if fewer is not None and ahead is not None:
                gain, error = ahead.total, ahead.error
                rise = self.validate(fewer) - corrected
        return Effect(
            name=effect.name,
            form=effect.form,
            kind=effect.kind,
            title=words.title,
            signature=words.signature,
            parameters=effect_estimates(model, estimates(model), index),
            fixed=dict(effect.data.constants),
            delta_validate=rise,
            gain=gain,
            gain_error=error,
            probability=probability,
            indistinguishable_from=confounded,
            not_carried=self.not_carried(model, index),
            meanings=effect.data.meanings,
            titles=titles,
            other_kind=None if twin is None else twin.form.kind,
            other_title="" if twin is None else twin.words(own).title,
        )


def weighed(found: Found, settings: SearchSettings, steps: Steps) -> Kept:
    """Return what a search found without effects that may be nothing, at its sampling."""
    fitter = unbounded(found.base.problem, settings)
    return steps.take("weighing effects", lambda: kept(fitter, found.best), Kept(found.best), True)


def why_dropped(one: Dropped) -> str:
    """Return why an effect that was found is no part of the corrected model, for people."""
    if one.interval is None:
        left = f"with it the validation tests are predicted worse ({100.0 * one.with_it:.3g} %) than without it"
        return f"{left} ({100.0 * one.without:.3g} %)"
    own = one.model.effects[one.index].parameters
    values = one.model.fit.values[one.model.places(one.index)].tolist()
    siblings = {each.name: Estimate.fixed(value, each.unit) for each, value in zip(own, values, strict=True)}
    shown = practical(Estimate(values[0], 0.0, own[0].unit, one.interval), siblings)
    low, high = shown.interval
    return f"the 95 % interval of {own[0].name}, {low:.3g} to {high:.3g} {shown.unit}".rstrip() + ", holds zero"


def refusal_words(one: Refusal) -> str:
    """Return why a model that the search looked at is none to adopt, for people."""
    words = _GATES[one.gate]
    return f"{one.effect.name.replace('_', ' ')} {words}" if one.effect is not None else words


_GATES: Mapping[Gate, str] = {
    "small": "explains less than instruments see",
    "motion_noise": "explains no more than noise of the displacement makes",
    "not_needed": "is not needed beside the others",
    "no_size": "may be nothing: its interval holds zero, or it stands at a bound",
    "alike": "may be an error of the other equations: something else does as well",
    "law": "the law as declared does as well",
    "given_up": "given up in the search for a better one",
    "leaves_more": "better only as far as equations may be wrong",
}


def verdict_of(reached: bool, effects: bool, ending: Ending) -> Verdict:
    """Return the verdict.

    Args:
        reached: whether only noise is left, by a floor that is not doubtful.
        effects: whether there are any in the corrected model.
        ending: of the search.
    """
    if effects:
        return "explained" if reached else "partly_explained"
    if reached:
        return "none"
    return "nothing_found" if ending == "complete" else "not_searched"


def unexplained_share(errors: Mapping[Stage, Errors], plain: Stage, floor: Mapping[Use, float]) -> float:
    """Return the share of what is above noise without effects that is left with them.

    It is that of the validation tests; where nothing is above noise in these, that of the tests fitted to.

    Args:
        floor: NRMS of what no model can predict, by the use of tests.
    """
    use: Use = "validate" if errors[plain].validate > MOST * floor["validate"] else "fit"
    without, corrected = (getattr(errors[stage], use) for stage in (plain, "corrected"))
    return min(max((corrected - floor[use]) / max(without - floor[use], 1e-300), 0.0), 1.0)


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
