"""From what a search found to a calibration: all samples, all tests, verdict, what is open."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.residual.series import FEWEST, Errors, Series, Stage
from edesign.calibration.residual.shape import describe_residual
from edesign.calibration.results.evidence import Evidence
from edesign.calibration.results.fit import at_full_rate, law_estimates, unbounded
from edesign.calibration.results.floor import Floor
from edesign.calibration.results.law_file import law_file, why_not_carried
from edesign.calibration.results.next_test import next_test
from edesign.calibration.results.other_law import other_law
from edesign.calibration.results.predictions import errors_of, predicted, validation_error
from edesign.calibration.results.result import Calibration
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.adoption import Kept, kept, placed, validated
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SearchSettings
from edesign.calibration.signals.noise import least_noise
from edesign.damper.fitting.identifiable import reasons_held
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.measured_histories import USES
from edesign.estimation.model import PredictionError


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
        """Return the outcome of a search."""
        problem: DamperProblem = found.base.problem  # type: ignore[assignment]
        whole, thin = problem.full_rate, unbounded(problem, settings)
        fitter = unbounded(whole, settings)

        def fitted() -> tuple[FittedModel, Kept]:
            refit = at_full_rate(fitter, found.base)
            if not found.best.effects:
                return refit, Kept(refit)

            def error(model: FittedModel) -> float:
                return validation_error(whole, model.effects, model.fit.values)

            sure = kept(fitter, at_full_rate(fitter, found.best))
            sure = replace(sure, model=placed(sure.model, error))
            return refit, validated(fitter, sure, error(refit), error)

        def at_all_samples() -> tuple[FittedModel, Kept] | None:
            try:
                return fitted()
            except PredictionError:  # larger steps hid that the model has no prediction; at those it has one
                return None

        sure = steps.guard("weighing effects", lambda: kept(thin, found.best), Kept(found.best))
        instead: tuple[FittedModel, Kept] | None = (found.base, sure)
        full = steps.take("fitting all samples", at_all_samples, instead, True)
        if full is None:
            whole = problem
        refit, final = full or (found.base, sure)
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

    def calibration(self, steps: Steps) -> Calibration:
        """Return all of it for people and files."""
        found, whole, evidence, law = self.found, self.whole, self.evidence, self.campaign.law
        assert law is not None
        forces, final = evidence.staged(self.forces), evidence.final
        floor = Floor.under(whole, final, forces["corrected"])
        series = self._series(forces, floor)
        return evidence.calibration(
            steps,
            {use: floor.nrms(use) for use in USES},
            floor.worst(evidence.errors["corrected"]),
            lambda: _shape(series),
            lambda: next_test(self.problem, evidence.posterior),
            lambda: other_law(self.campaign, found.base, found.best, self.settings),
            title=self.campaign.label,
            law=whole.law.name,
            parameters={
                "declared": law_estimates(whole, None),
                "refit": law_estimates(whole, self.refit),
                "corrected": law_estimates(whole, final),
            },
            law_held=not whole.refit,
            series=series,
            law_file=law_file(whole, final, self.refit, evidence.withheld),
            held=reasons_held(whole.law, [one.name for one in whole.base]) if whole.refit else {},
            lasting=whole.lasting,
            gamma_of=whole.gamma_of,
            fitted_first=law.fitted,
        )

    @cached_property
    def evidence(self) -> Evidence:
        """What the models of the search say of the effects."""
        not_carried = partial(why_not_carried, self.whole)
        return Evidence(self.settings, self.found, self.refit, self.kept, self.errors, self._validate, not_carried)

    def _validate(self, model: FittedModel) -> float:
        error = validation_error(self.whole, model.effects, model.fit.values)
        return error if math.isfinite(error) else math.nan

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
                    clipped=one.clipped,
                    assumed=floor.noise[i] <= least_noise(one.force),
                )
            )
        return tuple(found)


def _shape(series: Sequence[Series]) -> str:
    """Return what is left in words; "" if the tests are too short for that."""
    long = [one.residual("corrected") for one in series if one.time[one.judged].size >= FEWEST]
    return describe_residual(long) if long else ""
