"""From what a search found to a calibration: all samples, all tests, verdict, what is open."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.residual.analysis import analyse
from edesign.calibration.residual.record import FEWEST
from edesign.calibration.residual.series import Errors, Series, Stage
from edesign.calibration.results.fit import (
    Kept,
    at_full_rate,
    effect_estimates,
    estimates,
    kept,
    law_estimates,
    unbounded,
)
from edesign.calibration.results.floor import Floor
from edesign.calibration.results.law_file import carried, law_file
from edesign.calibration.results.models import Posterior, without
from edesign.calibration.results.next_test import next_test
from edesign.calibration.results.other_law import other_law
from edesign.calibration.results.predictions import errors_of, predicted
from edesign.calibration.results.result import Calibration, Effect, Hypothesis, SearchDepth, Verdict
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.search import Ending, Found
from edesign.calibration.search.settings import SearchSettings
from edesign.damper.fitting.identifiable import HELD, why_held
from edesign.damper.testing.campaign import Campaign
from edesign.estimation.model import PredictionError

Progress = Callable[[str], None]
T = TypeVar("T")


@dataclass
class Steps:
    """Steps after a search: after an interrupt among them the rest is left out, after one before all that can be.

    Attributes:
        progress: told what is done.
        ending: how the search ended; interrupted if a step was.
    """

    progress: Progress
    ending: Ending
    _left: bool = False

    def take(self, what: str, step: Callable[[], T], instead: T, needed: bool = False) -> T:
        """Return what a step makes; what stands instead where it is interrupted or left out.

        Args:
            what: is done, for people.
            step: makes it.
            instead: of it.
            needed: whether it is taken after an interrupt of the search too.
        """
        if self._left or (self.ending == "interrupted" and not needed):
            return instead
        self.progress(what)
        try:
            return step()
        except KeyboardInterrupt:
            self.ending, self._left = "interrupted", True
            return instead


@dataclass(frozen=True, eq=False)
class Outcome:
    """What the models of a search say about all tests at full rate.

    Attributes:
        campaign: tests.
        problem: at the sampling of a fit.
        found: by the search.
        settings: of the search.
        whole: the problem at full rate.
        refit, kept: the law fitted again, and the model with effects, fitted to all samples.
        forces: (n_i,) N of every test by stage; corrected: with the effects, even if they are withheld in the end.
        errors: by stage.
    """

    campaign: Campaign
    problem: DamperProblem
    found: Found
    settings: SearchSettings
    whole: DamperProblem
    refit: FittedModel
    kept: Kept
    forces: Mapping[Stage, Sequence[np.ndarray]] = field(repr=False)
    errors: Mapping[Stage, Errors]

    @staticmethod
    def of(campaign: Campaign, found: Found, settings: SearchSettings, steps: Steps) -> Outcome:
        """Return the outcome of a search.

        Args:
            campaign: tests.
            found: by the search.
            settings: of the search.
            steps: taken.
        """
        problem: DamperProblem = found.base.problem  # type: ignore[assignment]
        whole, thin = problem.full_rate, unbounded(problem, settings)
        fitting = unbounded(whole, settings)

        def fitted() -> tuple[FittedModel, Kept]:
            refit = at_full_rate(fitting, found.base)
            return refit, kept(fitting, at_full_rate(fitting, found.best) if found.best.effects else refit)

        try:
            refit, final = steps.take("fitting all samples", fitted, (found.base, kept(thin, found.best)), True)
        except PredictionError:  # larger steps hid that the model has no prediction; at those it has one
            whole = problem
            refit, final = found.base, kept(thin, found.best)
        declared = np.array([one.centre for one in problem.base])
        models: dict[Stage, tuple[Sequence[object], np.ndarray]] = {
            "declared": ((), declared),
            "refit": ((), refit.fit.values),
            "corrected": (final.model.effects, final.model.fit.values),
        }
        steps.progress("predicting all tests")
        forces = {stage: predicted(whole, effects, values) for stage, (effects, values) in models.items()}  # type: ignore[arg-type]
        errors = {stage: errors_of(whole, of_stage) for stage, of_stage in forces.items()}
        return Outcome(campaign, problem, found, settings, whole, refit, final, forces, errors)

    @property
    def withheld(self) -> str:
        """Why the effects are no part of the corrected law, for people: the validation tests; "" if they are."""
        corrected, refit = (self.errors[stage].validate for stage in ("corrected", "refit"))
        if not self.kept.model.effects or corrected <= refit:
            return ""
        return (
            f"with the effects the validation tests are predicted worse ({100.0 * corrected:.3g} %) than without them "
            f"({100.0 * refit:.3g} %)"
        )

    def calibration(self, steps: Steps) -> Calibration:
        """Return all of it for people and files.

        Args:
            steps: taken.
        """
        withheld, found, whole = self.withheld, self.found, self.whole
        final = self.refit if withheld else self.kept.model
        errors, forces = dict(self.errors), dict(self.forces)
        if withheld:
            errors["corrected"], forces["corrected"] = errors["refit"], forces["refit"]
        floor = Floor.under(whole, final, forces["corrected"])
        posterior = self._posterior()
        told = steps.take("comparing the models of the search", lambda: self._effects(posterior), None, True)
        dropped = tuple(Hypothesis(self._effect(posterior, m, i, None), why) for m, i, why in self.kept.dropped)
        if told is None:  # interrupted
            told = self._effects(None)
        effects = () if withheld else told
        hypotheses = (*(Hypothesis(one, withheld) for one in told if withheld), *dropped)
        reached = floor.reached(errors["corrected"])
        verdict = _verdict(reached, bool(effects), steps.ending)
        series = self._series(forces, floor)
        further = steps.take(
            "asking which further test would tell more", lambda: next_test(self.problem, posterior), None
        )
        better = None
        if not reached:
            better = steps.take(
                "asking whether another law does better",
                lambda: other_law(self.campaign, found.base, found.best, self.settings),
                None,
            )
        law = self.campaign.law
        assert law is not None
        return Calibration(
            title=self.campaign.label,
            law=self.problem.law.name,
            verdict=verdict,
            ending=steps.ending,
            errors=errors,
            noise_floor=floor.nrms("validate"),
            noise_floor_fit=floor.nrms("fit"),
            effects=effects,
            hypotheses=hypotheses,
            parameters={
                "declared": law_estimates(whole, None),
                "refit": law_estimates(whole, self.refit),
                "corrected": law_estimates(whole, final),
            },
            law_held=not self.problem.refit,
            series=series,
            unexplained_share=0.0 if reached else _left(errors, floor),
            unexplained_shape="" if reached else _shape(series),
            models=posterior.compared() if steps.ending != "interrupted" else (),
            depths=tuple(_depth(one.best, one.screening.screened, one.fitted, one.adopted) for one in found.depths),
            forms=len(self.problem.effects),
            effort=found.effort,
            most_effort=self.settings.effort,
            next_test=further,
            law_file=law_file(whole, final, self.refit, withheld),
            other_law=better,
            worst=floor.worst(errors["corrected"]),
            held=_held(self.problem),
            lasting=self.problem.lasting,
            gamma_of=self.problem.gamma_of,
            fitted_first=law.fitted,
        )

    def _posterior(self) -> Posterior:
        """The posterior over the models of the search, about the one that stands."""
        fitting, best = unbounded(self.problem, self.settings), self.found.best
        final = self.kept.model
        if self.kept.dropped:
            best = fitting.fit(final.effects, final.fit.values, best.noise) or best
        return Posterior.of(fitting, self.found, best)

    def _effects(self, posterior: Posterior | None) -> tuple[Effect, ...]:
        model = self.kept.model
        return tuple(self._effect(posterior, model, i, i) for i in range(len(model.effects)))

    def _effect(self, posterior: Posterior | None, model: FittedModel, index: int, stands: int | None) -> Effect:
        """Return an effect of a model; it is one of the model that stands, or none of that.

        Args:
            posterior: over the models of the search; None: not asked.
            model: with the effect, at full rate.
            index: of the effect.
            stands: index of it in the model that stands; None: it is not in that.
        """
        effect = model.effects[index]
        form = effect.data.form
        own = np.array([model.fit.values[i] for i in model.places(index)])
        rise, gain, error, alike, probability = math.nan, math.nan, math.nan, dict[str, float](), math.nan
        if posterior is not None:
            probability = posterior.probability(effect.name)
        if posterior is not None and stands is not None:
            alike = posterior.alike(effect.name)
            fewer, ahead = without(posterior, stands)
            if fewer is not None and ahead is not None:
                gain, error = ahead.total, ahead.error
                rise = self._validate(fewer) - self.errors["corrected"].validate
        damper = effect.kind == "damper"
        lacking = damper and carried(self.whole, effect, own) is None
        return Effect(
            name=effect.name,
            form=effect.form,
            kind=effect.kind,
            title=form.title,
            signature=form.signature,
            parameters=effect_estimates(model, estimates(model), index),
            fixed=dict(effect.data.constants),
            delta_validate=rise,
            gain=gain,
            gain_error=error,
            probability=probability,
            indistinguishable_from=alike,
            not_carried="law files have no such form" if lacking else "" if damper else "it is no part of the damper",
        )

    def _validate(self, model: FittedModel) -> float:
        try:
            return errors_of(self.whole, predicted(self.whole, model.effects, model.fit.values)).validate
        except PredictionError:
            return math.nan

    def _series(self, forces: Mapping[Stage, Sequence[np.ndarray]], floor: Floor) -> tuple[Series, ...]:
        found = []
        for i, (one, test) in enumerate(zip(self.whole.experiments, self.campaign.tests, strict=True)):
            history = test.temperature_history
            found.append(
                Series(
                    one.name,
                    test.title,
                    one.use,
                    one.order,
                    one.motion.time,
                    one.motion.displacement,
                    one.motion.velocity,
                    one.force,
                    {stage: of_stage[i] for stage, of_stage in forces.items()},
                    history
                    if history is not None and history.size == one.force.size
                    else np.full(one.force.size, one.temperature),
                    floor.noise[i],
                    start=one.start,
                )
            )
        return tuple(found)


def _verdict(reached: bool, effects: bool, ending: Ending) -> Verdict:
    if effects:
        return "explained" if reached else "partly_explained"
    if reached:
        return "none"
    return "nothing_found" if ending == "complete" else "not_searched"


def _left(errors: Mapping[Stage, Errors], floor: Floor) -> float:
    """Return the share of the excess over noise of the refitted law that is left in the validation tests."""
    noise = floor.nrms("validate")
    over = max(errors["refit"].validate - noise, 1e-300)
    return min(max((errors["corrected"].validate - noise) / over, 0.0), 1.0)


def _shape(series: Sequence[Series]) -> str:
    """Return what is left in words; "" if the tests are too short for that."""
    long = [one.residual("corrected") for one in series if one.time[one.judged].size >= FEWEST]
    return analyse(long).shape if long else ""


def _depth(beside: FittedModel, screened: int, fitted: int, adopted: FittedModel | None) -> SearchDepth:
    after = () if adopted is None else tuple(effect.label for effect in adopted.effects)
    return SearchDepth(tuple(effect.label for effect in beside.effects), screened, fitted, after)


def _held(problem: DamperProblem) -> dict[str, str]:
    """Return parameters of the law that are not fitted as others do what they do, with the reason."""
    fitted = {one.name for one in problem.base}
    names = HELD.get(problem.law.name, {}) if problem.refit else {}
    return {name: why_held(problem.law, name) for name in names if name not in fitted}
