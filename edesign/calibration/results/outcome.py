"""What a search found in tests of a damper: fitted to all samples, compared with the validation tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.residual.curves import FreeCurve, free_curves
from edesign.calibration.residual.series import FEWEST, Errors, Residual, Series, Worst
from edesign.calibration.residual.shape import describe_residual
from edesign.calibration.results.evidence import NEXT_TEST, OTHER_LAW, OUTLYING, Evidence
from edesign.calibration.results.fit import at_full_rate, law_stages, resolved, unbounded
from edesign.calibration.results.floor import Floor
from edesign.calibration.results.kept import Kept, kept, placed, validated
from edesign.calibration.results.law_file import law_file, why_not_carried
from edesign.calibration.results.next_test import next_test
from edesign.calibration.results.nuisances import nuisances_of
from edesign.calibration.results.other_law import other_law
from edesign.calibration.results.outlying import outlying_tests
from edesign.calibration.results.predictions import errors_of, predicted, validation_error, validation_noise
from edesign.calibration.results.result import Calibrated, NextTest, OfTests, OtherLaw, OutlyingTest
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SearchSettings
from edesign.calibration.signals.noise import least_noise
from edesign.damper.fitting.identifiable import reasons_fixed
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.measured_histories import USES, Use
from edesign.estimation.model import PredictionError
from edesign.optional_stages import optional


@dataclass(frozen=True, eq=False)
class DamperOutcome(Evidence[Sequence[np.ndarray]]):
    """What the models of a search say about all tests of a damper at full rate: forces (n_i,) N.

    Attributes:
        campaign: tests.
        whole: the problem at full rate.
    """

    campaign: Campaign
    whole: DamperProblem

    asked = (NEXT_TEST, OTHER_LAW, OUTLYING)

    @staticmethod
    def of(campaign: Campaign, found: Found, settings: SearchSettings, steps: Steps) -> DamperOutcome:
        """Return the outcome of a search, which is fitted to all samples, and compared with the validation tests."""
        problem: DamperProblem = found.base.problem  # type: ignore[assignment]
        best = found.best.fit
        near = {one.name: float(value) for one, value in zip(problem.base, best.values, strict=False)}
        every, thin = replace(problem.full_rate, near=near), unbounded(problem, settings)
        # residuals are weighted by what a model leaves beside noise: the law alone, and the best one
        weighed = every.weighed(problem.share_of(found.best.left))

        def fitted() -> tuple[FittedModel, FittedModel, Kept]:
            of, first = (weighed, found.best) if found.best.effects else (every, found.base)
            best, alone = resolved(at_full_rate(unbounded(of, settings), first)), unbounded(every, settings)
            whole = replace(weighed, parts=best.problem.parts)  # type: ignore[attr-defined]
            declared = at_full_rate(alone, found.declared)
            if not found.best.effects:
                return declared, best, Kept(best)
            refit, fitter = at_full_rate(alone, found.base), unbounded(whole, settings)

            def error(model: FittedModel) -> float:
                return validation_error(whole, model.effects, model.fit.values)

            sure = kept(fitter, best)
            sure = replace(sure, model=placed(sure.model, error))
            plain, floor = min(error(declared), error(refit)), validation_noise(whole)
            return declared, refit, validated(fitter, sure, plain, floor, error)

        def at_all_samples() -> tuple[FittedModel, FittedModel, Kept] | None:
            try:
                return fitted()
            except PredictionError:  # larger steps hid that the model has no prediction; at those it has one
                return None

        sure = steps.guard("weighing effects", lambda: kept(thin, found.best), Kept(found.best))
        instead: tuple[FittedModel, FittedModel, Kept] | None = (found.declared, found.base, sure)
        full = steps.take("fitting all samples", at_all_samples, instead, True)
        steps.progress("predicting all tests")
        declared, refit, final = full or (found.declared, found.base, sure)
        whole = problem if full is None else replace(weighed, parts=final.model.problem.parts)  # type: ignore[attr-defined]
        return DamperOutcome(found, settings, declared, refit, final, campaign, whole)

    def predict(self, effects: Sequence[Effect], values: np.ndarray) -> Sequence[np.ndarray]:
        """Return the force (n_i,) N of every test."""
        return predicted(self.whole, effects, values)

    def errors_of(self, predicted: Sequence[np.ndarray]) -> Errors:
        """Return NRMS over the tests of each use, and of each test."""
        return errors_of(self.whole, predicted)

    def not_carried(self, model: FittedModel, index: int) -> str:
        """Return why no law file carries an effect of a model."""
        return why_not_carried(self.whole, model, index)

    def floor(self) -> tuple[Mapping[Use, float], Worst | None]:
        """Return the NRMS of what no model can predict by use, and the test that leaves more than that."""
        return {use: self._floor.nrms(use) for use in USES}, self._floor.worst(self.errors["corrected"])

    def doubtful(self) -> str:
        """Return why the floor does not say whether only noise is left."""
        return self._floor.doubtful(self.errors["corrected"], len(self.final.fit.model.parameters))

    def interpolated(self) -> Mapping[Use, float]:
        """Return the NRMS of what is not known of motions between samples, by use."""
        return {use: self._floor.interpolated(use) for use in USES}

    def shape(self) -> str:
        """Return what is left in words; "" if the tests are too short for that."""
        return describe_residual(self._left, curves=self.curves) if self._left else ""

    @cached_property
    def curves(self) -> tuple[FreeCurve, ...]:
        """What smooth functions of displacement and velocity take of what is left."""
        return free_curves(self._left)

    @cached_property
    def _left(self) -> list[Residual]:
        """Residuals of the corrected model, of tests that are long enough."""
        return [one.residual("corrected") for one in self.series if one.time[one.judged].size >= FEWEST]

    def next_test(self) -> NextTest | None:
        """Return which further test would separate the models."""
        return next_test(self.found.base.problem, self.posterior)  # type: ignore[arg-type]

    def other_law(self) -> OtherLaw | None:
        """Return a law that does better."""
        validate = self.errors["corrected"].validate
        return other_law(self.campaign, self.found.base, self.standing.best, validate, self.settings)

    def outlying(self) -> tuple[OutlyingTest, ...]:
        """Return tests that do not agree with the others."""
        problem, model = self.found.base.problem, self.final
        return outlying_tests(problem, model.effects, model.fit.values, self.settings)  # type: ignore[arg-type]

    def calibrated(self) -> Calibrated:
        """Return the campaign, and its law at each stage."""
        whole, law = self.whole, self.campaign.law
        assert law is not None
        return Calibrated(
            campaign=self.campaign,
            subject="damper",
            law=whole.law.name,
            parameters=law_stages(whole, self.refit, self.final),
            law_fixed=not whole.refit,
            fixed=reasons_fixed(whole.law, [one.name for one in whole.base]) if whole.refit else {},
            law_file=law_file(whole, self.final, self.alone, self.withheld),
            series=self.series,
            lasting=whole.lasting,
            gamma_of=whole.gamma_of,
            fitted_first=law.fitted,
            nuisances=self.nuisances,
        )

    @cached_property
    def nuisances(self) -> tuple[OfTests, ...]:
        """What belongs to single tests; () too where it cannot be computed."""
        with optional("what belongs to single tests"):
            return nuisances_of(self.whole, self.final, self.predicted["corrected"])
        return ()

    @cached_property
    def _floor(self) -> Floor:
        if self.final is self.kept.model:
            return self._floor_with_effects
        return Floor.under(self.whole, self.final, self.predicted["corrected"])

    @cached_property
    def _floor_with_effects(self) -> Floor:
        return Floor.under(self.whole, self.kept.model, self.every_prediction["corrected"])

    def floor_with_effects(self) -> Mapping[Use, float]:
        """Return the NRMS of what no model can predict with the effects that were found, by use."""
        return {use: self._floor_with_effects.nrms(use) for use in USES}

    @cached_property
    def series(self) -> tuple[Series, ...]:
        """Motion, measured and predicted force of each test."""
        found, forces = [], self.predicted
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
                    self._floor.noise[i],
                    start=one.start,
                    clipped=one.clipped,
                    spikes=one.spikes,
                    motion_spikes=one.motion_spikes,
                    ends=one.ends if np.any(one.ends) else None,
                    assumed=not self._floor.measured or self._floor.noise[i] <= least_noise(one.force),
                )
            )
        return tuple(found)
