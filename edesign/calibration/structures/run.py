"""Calibrate the model of a building by records of its motion: from the campaign to what the user gets."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibration.residual.series import STAGES, Errors, Series, Stage
from edesign.calibration.results.evidence import Evidence
from edesign.calibration.results.fit import base_estimates, unbounded
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.result import Calibration, Estimate
from edesign.calibration.results.steps import Progress, Steps, searched
from edesign.calibration.search.adoption import Kept, kept
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.search import Found
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.corrected import law_file, where_carried
from edesign.calibration.structures.from_campaign import structure_problem
from edesign.calibration.structures.problem import LEAST_NOISE, StructureProblem
from edesign.calibration.structures.record import UNITS
from edesign.calibration.structures.residual_words import describe_residual
from edesign.damper.fitting.identifiable import reasons_held
from edesign.damper.laws import law as law_of
from edesign.damper.testing.measured_histories import USES, Use
from edesign.estimation.model import PredictionError
from edesign.one_thread import one_thread

_TEMPERATURE = 20.0  # degC; records of structures have none, and no effect of a structure asks for it


@one_thread()
def calibrate_structure(
    campaign: StructureCampaign,
    settings: SearchSettings = SETTINGS,
    threads: int = 2,
    progress: Progress = lambda _: None,
) -> Calibration:
    """Find what the declared building lacks, and correct it.

    An interrupt (Ctrl-C) ends the search, and what it has found is returned with the ending `interrupted`.

    Args:
        campaign: records, and the declared building.
        settings: numbers of the search, its effort among them.
        threads: of predictions, at most so many. Results do not depend on it.
        progress: told what is done.

    Raises:
        InputError: the campaign is wrong, or the declared building has no response.
        KeyboardInterrupt: before the building was fitted.
    """
    begin = clock.perf_counter()
    problem = structure_problem(campaign, threads)
    progress("fitting the building alone")
    found = searched(problem.thinned(), settings, progress, campaign.path, "structure")
    steps = Steps(progress, found.ending)
    with steps.held():
        return _Outcome.of(campaign, problem, found, settings, steps).calibration(steps, begin)


@dataclass(frozen=True, eq=False)
class _Outcome:
    """What the models of a search say about all samples of all tests.

    Attributes:
        campaign: records.
        problem: with all samples.
        found: by the search.
        settings: of the search.
        kept: the model with effects.
        histories: channels (t, channels), SI, of every test by stage; corrected: with the effects.
        noise: (channels,) SI, of every test.
    """

    campaign: StructureCampaign
    problem: StructureProblem
    found: Found
    settings: SearchSettings
    kept: Kept
    histories: Mapping[Stage, Sequence[np.ndarray]]
    noise: tuple[np.ndarray, ...]

    @staticmethod
    def of(
        campaign: StructureCampaign, problem: StructureProblem, found: Found, settings: SearchSettings, steps: Steps
    ) -> _Outcome:
        fitter = unbounded(found.base.problem, settings)
        final = steps.take("weighing effects", lambda: kept(fitter, found.best), Kept(found.best), True)
        steps.progress("predicting all tests")
        centres = np.array([one.centre for one in problem.base])
        histories: dict[Stage, Sequence[np.ndarray]] = {
            "declared": problem.model((), USES).histories(centres),
            "refit": problem.model((), USES).histories(found.base.fit.values),
            "corrected": problem.model(final.model.effects, USES).histories(final.model.fit.values),
        }
        noise = tuple(
            np.maximum(problem.channel_noise(i), LEAST_NOISE * np.sqrt(np.mean(test.values**2, axis=0)))
            for i, test in enumerate(problem.tests)
        )
        return _Outcome(campaign, problem, found, settings, final, histories, noise)

    def calibration(self, steps: Steps, begin: float) -> Calibration:
        """Return all of it for people and files; `begin`: when it began, s."""
        problem, campaign, evidence = self.problem, self.campaign, self.evidence
        final, corrected = evidence.final, evidence.errors["corrected"]
        series = self._series(final, evidence.staged(self.histories))
        parts = [
            Part(one.name, corrected.of(one), one.noise**2 / float(np.mean(one.measured**2)), one.measured.size)
            for one in series
        ]
        return evidence.calibration(
            steps,
            {use: self._floor(use) for use in USES},
            worst_of(parts),
            lambda: describe_residual(series, self._first_mode(final)),
            title=campaign.title or campaign.name,
            law=campaign.isolation.law if campaign.isolation else "",
            parameters={
                "declared": {one.name: Estimate.held(one.centre, one.unit) for one in problem.base},
                "refit": base_estimates(self.found.base),
                "corrected": base_estimates(final),
            },
            law_held=not problem.base,
            series=series,
            law_file=law_file(campaign, problem, final, corrected.validate),
            held=_held(campaign, problem),
            subject="structure",
            seconds=clock.perf_counter() - begin,
        )

    @cached_property
    def evidence(self) -> Evidence:
        """What the models of the search say of the effects."""
        errors: dict[Stage, Errors] = {stage: self._errors(self.histories[stage]) for stage in STAGES}
        found = self.found
        return Evidence(self.settings, found, found.base, self.kept, errors, self._validate, self._why_not_carried)

    def _errors(self, histories: Sequence[np.ndarray]) -> Errors:
        """Return NRMS over all scaled channels of the tests of each use, of each test, and of each channel."""
        problem = self.problem
        squared: dict[str, float] = {}
        power: dict[str, float] = {}
        channels: dict[str, float] = {}
        for i, (test, values) in enumerate(zip(problem.tests, histories, strict=True)):
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

    def _floor(self, use: Use) -> float:
        """Return the NRMS of noise over the tests of a use."""
        noise, power = 0.0, 0.0
        for i in self.problem.used_for(use):
            values = self.problem.tests[i].values
            noise += float(np.sum(self.problem.flat(i, np.ones_like(values) * self.noise[i]) ** 2))
            power += float(np.sum(self.problem.flat(i, values) ** 2))
        return noise / max(power, 1e-300)

    def _validate(self, model: FittedModel) -> float:
        try:
            histories = self.problem.model(model.effects, USES).histories(model.fit.values)
        except PredictionError:
            return math.nan
        return self._errors(histories).validate

    def _why_not_carried(self, model: FittedModel, index: int) -> str:
        effect = model.effects[index]
        if effect.kind != "structure":
            return "it is no part of the building"
        return "" if where_carried(effect) else "no file has a key for it"

    def _series(self, final: FittedModel, histories: Mapping[Stage, Sequence[np.ndarray]]) -> tuple[Series, ...]:
        """Return one a channel; displacement and velocity are those of its floor in the corrected model."""
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

    def _first_mode(self, final: FittedModel) -> float:
        """Return the first frequency, Hz; of an isolated building with the secant stiffness of its declared layer."""
        if self.problem.isolation is not None:
            return 1.0 / self.problem.typical.period
        values = dict(zip((one.name for one in self.problem.base), map(float, final.fit.values), strict=False))
        return self.problem.building(values)[0].system().first_frequency


def _held(campaign: StructureCampaign, problem: StructureProblem) -> dict[str, str]:
    """Return parameters of the isolation law that are not fitted as others do what they do, with the reason."""
    if campaign.isolation is None or not campaign.isolation.refit:
        return {}
    return reasons_held(law_of(campaign.isolation.law), [one.name for one in problem.base])
