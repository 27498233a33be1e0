"""What a search found in a table of moduli: compared with all rows, in cycles as those of measured tests."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.properties.campaign import PropertyCampaign
from edesign.calibration.properties.corrected import table_law
from edesign.calibration.properties.from_campaign import property_problem
from edesign.calibration.properties.next_test import next_test
from edesign.calibration.properties.problem import PropertyProblem
from edesign.calibration.properties.residual_words import describe_residual, relative_errors
from edesign.calibration.residual.series import Errors, Stage, Worst
from edesign.calibration.results.evidence import Evidence, weighed
from edesign.calibration.results.fit import law_stages
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.law_file import why_not_carried
from edesign.calibration.results.result import Calibrated, Calibration, NextTest
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SearchSettings
from edesign.damper.fitting.identifiable import reasons_fixed
from edesign.damper.testing.measured_histories import USES, Use
from edesign.damper.testing.steady_state import CYCLES, SAMPLES, PropertyRows


@dataclass(frozen=True, eq=False, kw_only=True)
class PropertyCalibration(Calibration):
    """What a calibration found in a table of moduli.

    Attributes:
        campaign: table, law and groups of rows.
        rows: properties of all rows by stage.
        repeats: how well rows repeat: relative standard deviation of a property.
    """

    campaign: PropertyCampaign
    rows: Mapping[Stage, PropertyRows]
    repeats: float


@dataclass(frozen=True, eq=False)
class TableOutcome(Evidence[PropertyRows]):
    """What the models of a search say about all rows of a table of moduli, with cycles as those of measured tests.

    Attributes:
        campaign: table, law and groups of rows.
        problem: of it.
    """

    campaign: PropertyCampaign
    problem: PropertyProblem

    @staticmethod
    def of(campaign: PropertyCampaign, found: Found, settings: SearchSettings, steps: Steps) -> TableOutcome:
        """Return the outcome of a search.

        Args:
            campaign: table, law and groups of rows.
            steps: taken after it.
        """
        final = weighed(found, settings, steps)
        steps.progress("predicting all rows")
        quick: PropertyProblem = found.base.problem  # type: ignore[assignment]
        problem = property_problem(campaign, CYCLES, SAMPLES, quick.inner.threads)
        return TableOutcome(found, settings, found.declared, found.base, final, campaign, problem)

    def predict(self, effects: Sequence[Effect], values: np.ndarray) -> PropertyRows:
        """Return the properties of all rows."""
        return self.problem.model(effects, USES).properties(values)

    def errors_of(self, predicted: PropertyRows) -> Errors:
        """Return mean squares of relative errors over the rows of each use, and of each group."""
        squares = np.mean([r**2 for r in relative_errors(predicted, self.campaign.table).values()], axis=0)
        groups = self.campaign.groups
        fit, validate = (
            float(np.mean(squares[np.concatenate([g.rows for g in groups if g.use == use])])) for use in USES
        )
        return Errors(fit, validate, {group.name: float(np.mean(squares[group.rows])) for group in groups})

    def not_carried(self, model: FittedModel, index: int) -> str:
        """Return why no law file carries an effect of a model."""
        return why_not_carried(self.problem.inner, model, index)

    def floor(self) -> tuple[Mapping[Use, float], Worst | None]:
        """Return how well rows repeat, by use, and the group that leaves more than that."""
        errors, floor = self.errors["corrected"].tests, self.problem.repeats**2
        parts = [Part(g.name, errors[g.name], floor, 3 * g.rows.size) for g in self.campaign.groups]
        return self.floor_with_effects(), worst_of(parts)

    def floor_with_effects(self) -> Mapping[Use, float]:
        """Return how well rows repeat, by use."""
        return dict.fromkeys(USES, self.problem.repeats**2)

    def shape(self) -> str:
        """Return in words what is left."""
        return describe_residual(self.predicted["corrected"], self.campaign.table)

    def next_test(self) -> NextTest | None:
        """Return which further test would separate the models."""
        return next_test(self.found.base.problem, self.posterior)  # type: ignore[arg-type]

    def calibrated(self) -> Calibrated:
        """Return the campaign, and its law at each stage."""
        inner = self.problem.inner
        return Calibrated(
            campaign=self.campaign,
            subject="table",
            law=inner.law.name,
            parameters=law_stages(inner, self.refit, self.final),
            law_fixed=not inner.base,
            fixed=reasons_fixed(inner.law, [one.name for one in inner.base]) if inner.refit else {},
            law_file=table_law(self.problem, self.final, self.alone, self.withheld),
        )

    def calibration(self, steps: Steps) -> PropertyCalibration:
        """Return all of it for people and files."""
        found = super().calibration(steps)
        return PropertyCalibration(**vars(found), rows=self.predicted, repeats=self.problem.repeats)
