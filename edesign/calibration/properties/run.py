"""Calibrate a damper law by a table of its moduli: from the campaign to what the user gets."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from edesign.calibration.properties.campaign import PropertyCampaign
from edesign.calibration.properties.corrected import table_law
from edesign.calibration.properties.from_campaign import property_problem
from edesign.calibration.properties.next_test import next_test
from edesign.calibration.properties.problem import PropertyProblem
from edesign.calibration.properties.residual_words import describe_residual, relative_errors
from edesign.calibration.residual.series import STAGES, Errors, Stage
from edesign.calibration.results.evidence import Evidence
from edesign.calibration.results.fit import law_estimates, unbounded
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.law_file import why_not_carried
from edesign.calibration.results.result import Calibration
from edesign.calibration.results.steps import Progress, Steps, searched
from edesign.calibration.search.adoption import Kept, kept
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.damper.fitting.identifiable import reasons_held
from edesign.damper.testing.measured_histories import USES
from edesign.damper.testing.steady_state import CYCLES, SAMPLES, PropertyRows
from edesign.estimation.model import PredictionError
from edesign.one_thread import one_thread


@dataclass(frozen=True, eq=False)
class PropertyCalibration:
    """What a calibration found in a table of moduli.

    Attributes:
        found: errors as mean squares of relative errors of G', G_eq and loss factor, effects, verdict, the law.
        campaign: table, law and groups of rows.
        rows: properties of all rows by stage.
        repeats: how well rows repeat: relative standard deviation of a property.
    """

    found: Calibration
    campaign: PropertyCampaign
    rows: Mapping[Stage, PropertyRows]
    repeats: float


@one_thread()
def calibrate_properties(
    campaign: PropertyCampaign,
    settings: SearchSettings = SETTINGS,
    threads: int = 2,
    progress: Progress = lambda _: None,
) -> PropertyCalibration:
    """Find what the declared law lacks, and correct it.

    An interrupt (Ctrl-C) ends the search, and what it has found is returned with the ending `interrupted`.

    Args:
        campaign: the table, and the declared law.
        settings: numbers of the search, its effort among them.
        threads: of predictions, at most so many. Results do not depend on it.
        progress: told what is done.

    Raises:
        InputError: no law is declared, or it cannot predict the table.
        KeyboardInterrupt: before the law was fitted.
    """
    begin = clock.perf_counter()
    quick = property_problem(campaign, threads=threads)
    progress("fitting the law alone")
    found = searched(quick, settings, progress, campaign.path, "law")
    steps = Steps(progress, found.ending)
    with steps.held():
        return _Outcome.of(campaign, quick, found, settings, steps, threads).calibration(steps, begin)


@dataclass(frozen=True, eq=False)
class _Outcome:
    """What the models of a search say about all rows.

    Attributes:
        campaign: table, law and groups of rows.
        quick, problem: with the cycles of the search, and of measured tests.
        found: by the search.
        settings: of the search.
        kept: the model with effects.
        rows: properties of all rows by stage; corrected: with the effects.
    """

    campaign: PropertyCampaign
    quick: PropertyProblem
    problem: PropertyProblem
    found: Found
    settings: SearchSettings
    kept: Kept
    rows: Mapping[Stage, PropertyRows]

    @staticmethod
    def of(
        campaign: PropertyCampaign,
        quick: PropertyProblem,
        found: Found,
        settings: SearchSettings,
        steps: Steps,
        threads: int,
    ) -> _Outcome:
        fitter = unbounded(quick, settings)
        final = steps.take("weighing effects", lambda: kept(fitter, found.best), Kept(found.best), True)
        steps.progress("predicting all rows")
        problem = property_problem(campaign, CYCLES, SAMPLES, threads)
        declared = np.array([one.centre for one in quick.inner.base])
        rows: dict[Stage, PropertyRows] = {
            "declared": problem.model((), USES).properties(declared),
            "refit": problem.model((), USES).properties(found.base.fit.values),
            "corrected": problem.model(final.model.effects, USES).properties(final.model.fit.values),
        }
        return _Outcome(campaign, quick, problem, found, settings, final, rows)

    def calibration(self, steps: Steps, begin: float) -> PropertyCalibration:
        """Return all of it for people and files; `begin`: when it began, s."""
        quick, campaign, evidence = self.quick, self.campaign, self.evidence
        inner, final, corrected = quick.inner, evidence.final, evidence.errors["corrected"]
        rows, floor = evidence.staged(self.rows), quick.repeats**2
        parts = [Part(g.name, corrected.tests[g.name], floor, 3 * g.rows.size) for g in campaign.groups]
        calibration = evidence.calibration(
            steps,
            dict.fromkeys(USES, floor),
            worst_of(parts),
            lambda: describe_residual(rows["corrected"], campaign.table),
            lambda: next_test(quick, evidence.posterior),
            title=campaign.title or campaign.specimen.name,
            law=inner.law.name,
            parameters={
                "declared": law_estimates(inner, None),
                "refit": law_estimates(inner, self.found.base),
                "corrected": law_estimates(inner, final),
            },
            law_held=not inner.base,
            series=(),
            law_file=table_law(self.problem, final, self.found.base, evidence.withheld),
            held=reasons_held(inner.law, [one.name for one in inner.base]) if inner.refit else {},
            subject="table",
            seconds=clock.perf_counter() - begin,
        )
        return PropertyCalibration(calibration, campaign, rows, quick.repeats)

    @cached_property
    def evidence(self) -> Evidence:
        """What the models of the search say of the effects."""
        errors: dict[Stage, Errors] = {stage: self._errors(self.rows[stage]) for stage in STAGES}
        not_carried = partial(why_not_carried, self.quick.inner)
        found = self.found
        return Evidence(self.settings, found, found.base, self.kept, errors, self._validate, not_carried)

    def _errors(self, rows: PropertyRows) -> Errors:
        squares = np.mean([r**2 for r in relative_errors(rows, self.campaign.table).values()], axis=0)
        groups = self.campaign.groups
        fit, validate = (
            float(np.mean(squares[np.concatenate([g.rows for g in groups if g.use == use])])) for use in USES
        )
        return Errors(fit, validate, {group.name: float(np.mean(squares[group.rows])) for group in groups})

    def _validate(self, model: FittedModel) -> float:
        try:
            return self._errors(self.problem.model(model.effects, USES).properties(model.fit.values)).validate
        except PredictionError:
            return math.nan
