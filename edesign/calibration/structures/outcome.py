"""What a search found in records of a building: compared with all samples of all records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibration.residual.series import Errors, Series, Worst
from edesign.calibration.results.evidence import Evidence, weighed
from edesign.calibration.results.fit import base_estimates
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.result import Calibrated, Estimate
from edesign.calibration.results.steps import Steps
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SearchSettings
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.corrected import law_file, where_carried
from edesign.calibration.structures.problem import LEAST_NOISE, StructureProblem
from edesign.calibration.structures.record import UNITS
from edesign.calibration.structures.residual_words import describe_residual
from edesign.damper.fitting.identifiable import reasons_fixed
from edesign.damper.laws import law as law_of
from edesign.damper.testing.measured_histories import USES, Use

_TEMPERATURE = 20.0  # degC; records of structures have none, and no effect of a structure asks for it


@dataclass(frozen=True, eq=False)
class StructureOutcome(Evidence[Sequence[np.ndarray]]):
    """What the models of a search say about all samples of all records: channels (t, channels), SI.

    Attributes:
        campaign: records.
        problem: with all samples.
    """

    campaign: StructureCampaign
    problem: StructureProblem

    asked = ()

    @staticmethod
    def of(campaign: StructureCampaign, found: Found, settings: SearchSettings, steps: Steps) -> StructureOutcome:
        """Return the outcome of a search."""
        final = weighed(found, settings, steps)
        steps.progress("predicting all tests")
        thinned: StructureProblem = found.base.problem  # type: ignore[assignment]
        return StructureOutcome(found, settings, found.declared, found.base, final, campaign, thinned.full_rate)

    def predict(self, effects: Sequence[Effect], values: np.ndarray) -> Sequence[np.ndarray]:
        """Return the channels (t, channels), SI, of every test."""
        return self.problem.model(effects, USES).histories(values)

    def errors_of(self, predicted: Sequence[np.ndarray]) -> Errors:
        """Return NRMS over all scaled channels of the tests of each use, of each test, and of each channel."""
        problem = self.problem
        squared: dict[str, float] = {}
        power: dict[str, float] = {}
        channels: dict[str, float] = {}
        for i, (test, values) in enumerate(zip(problem.tests, predicted, strict=True)):
            squared[test.name] = float(np.sum(problem.flat(i, test.values - values) ** 2))
            power[test.name] = max(float(np.sum(problem.flat(i, test.values) ** 2)), 1e-300)
            left = np.sum((test.values - values) ** 2, axis=0) / np.sum(test.values**2, axis=0)
            channels |= {f"{test.name}: {c.label}": float(e) for c, e in zip(test.channels, left, strict=True)}
        of_use: dict[Use, float] = {}
        for use in USES:
            names = [problem.tests[i].name for i in problem.used_for(use)]
            of_use[use] = sum(squared[name] for name in names) / sum(power[name] for name in names)
        each = {name: squared[name] / power[name] for name in power}
        return Errors(of_use["fit"], of_use["validate"], each, channels)

    def not_carried(self, model: FittedModel, index: int) -> str:
        """Return why no file carries an effect of a model."""
        effect = model.effects[index]
        if effect.kind != "structure":
            return "it is no part of the building"
        return "" if where_carried(effect) else "no file has a key for it"

    def floor(self) -> tuple[Mapping[Use, float], Worst | None]:
        """Return the NRMS of noise over the tests of each use, and the channel that leaves more than that."""
        errors = self.errors["corrected"]
        parts = [
            Part(one.name, errors.of(one), one.noise**2 / float(np.mean(one.measured**2)), one.measured.size)
            for one in self.series
        ]
        return self.floor_with_effects(), worst_of(parts)

    def floor_with_effects(self) -> Mapping[Use, float]:
        """Return the NRMS of noise over the tests of each use."""
        return {use: self._floor(use) for use in USES}

    def shape(self) -> str:
        """Return in words what is left."""
        return describe_residual(self.series, self._first_mode())

    def calibrated(self) -> Calibrated:
        """Return the campaign, and its building at each stage."""
        problem, campaign, final = self.problem, self.campaign, self.final
        return Calibrated(
            campaign=campaign,
            subject="structure",
            law=campaign.isolation.law if campaign.isolation else "",
            parameters={
                "declared": {one.name: Estimate.fixed(one.centre, one.unit) for one in problem.base},
                "refit": base_estimates(self.refit),
                "corrected": base_estimates(final),
            },
            law_fixed=not problem.base,
            fixed=_fixed(campaign, problem),
            law_file=law_file(campaign, problem, final, self.errors["corrected"].validate),
            series=self.series,
        )

    @cached_property
    def noise(self) -> tuple[np.ndarray, ...]:
        """Noise (channels,), SI, of every test."""
        return tuple(
            np.maximum(self.problem.channel_noise(i), LEAST_NOISE * np.sqrt(np.mean(test.values**2, axis=0)))
            for i, test in enumerate(self.problem.tests)
        )

    def _floor(self, use: Use) -> float:
        """Return the NRMS of noise over the tests of a use."""
        noise, power = 0.0, 0.0
        for i in self.problem.used_for(use):
            values = self.problem.tests[i].values
            noise += float(np.sum(self.problem.flat(i, np.ones_like(values) * self.noise[i]) ** 2))
            power += float(np.sum(self.problem.flat(i, values) ** 2))
        return noise / max(power, 1e-300)

    @cached_property
    def series(self) -> tuple[Series, ...]:
        """One a channel; displacement and velocity are those of its floor in the corrected model."""
        final, histories = self.final, self.predicted
        responses = self.problem.model(final.effects, USES).responses(final.fit.values)
        found = []
        for order, (test, response) in enumerate(zip(self.problem.tests, responses, strict=True)):
            for i, channel in enumerate(test.channels):
                displacement = response.displacement[:, channel.floor]
                found.append(
                    Series(
                        name=f"{test.name}: {channel.label}",
                        title=test.title,
                        use=test.use,
                        order=order,
                        time=test.time,
                        displacement=displacement,
                        velocity=np.gradient(displacement, test.step),
                        measured=test.values[:, i],
                        predicted={stage: values[order][:, i] for stage, values in histories.items()},
                        temperature=np.full(test.time.size, _TEMPERATURE),
                        noise=float(self.noise[order][i]),
                        quantity=channel.measure,
                        unit=UNITS[channel.measure],
                        test=test.name,
                        channel=channel.label,
                    )
                )
        return tuple(found)

    def _first_mode(self) -> float:
        """Return the first frequency, Hz; of an isolated building with the secant stiffness of its declared layer."""
        if self.problem.isolation is not None:
            return 1.0 / self.problem.typical.period
        values = dict(zip((one.name for one in self.problem.base), map(float, self.final.fit.values), strict=False))
        return self.problem.building(values)[0].system().first_frequency


def _fixed(campaign: StructureCampaign, problem: StructureProblem) -> dict[str, str]:
    """Return parameters of the isolation law that are not fitted as others do what they do, with the reason."""
    if campaign.isolation is None or not campaign.isolation.refit:
        return {}
    return reasons_fixed(law_of(campaign.isolation.law), [one.name for one in problem.base])
