"""Calibrate a building by records of its motion: the whole loop, from the campaign to what was found."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.evidence import Judged
from edesign.calibrate.outcome import (
    BOTH,
    Described,
    effect_of,
    errors_of,
    floor_of,
    parameters_of,
    predict,
    share_left,
    verdict_of,
)
from edesign.calibrate.problem import Candidate
from edesign.calibrate.result import Calibration, Series, Stage
from edesign.calibrate.selection import Loop, Progress, Selection
from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.check import check_channels, check_tests
from edesign.calibrate.structure.problem import StructureProblem, acting, first_frequency
from edesign.calibrate.structure.record import UNITS
from edesign.calibrate.structure.shape import describe_left

_TEMPERATURE = 20.0  # degC; records of structures have none, and no effect of a structure asks for it


def calibrate_structure(
    campaign: StructureCampaign, workers: int = 2, progress: Progress = lambda _: None
) -> Calibration:
    """Run the loop on the records of a structure.

    Args:
        campaign: records, and the declared building.
        workers: threads.
        progress: told what is done.

    Raises:
        InputError: the campaign is wrong.
    """
    begin = clock.perf_counter()
    check_tests(campaign)
    problem = StructureProblem.of(campaign)
    check_channels(problem, campaign)
    selection = Loop(problem, problem.noise, bool(problem.base), workers, progress).run()
    progress("predicting all tests")
    return _result(campaign, problem, selection, begin)


def _result(campaign: StructureCampaign, problem: StructureProblem, found: Selection, begin: float) -> Calibration:
    stages: dict[Stage, Judged] = {"declared": found.declared, "refit": found.refit, "corrected": found.final}
    predicted = {stage: predict(problem, judged) for stage, judged in stages.items()}
    errors = {stage: errors_of(problem, rows) for stage, rows in predicted.items()}
    floors = {use: floor_of(problem, problem.noise, use) for use in BOTH}
    verdict = verdict_of(found, errors["corrected"], floors)
    series = _series(problem, found.final, predicted)
    left = verdict in ("partly_explained", "unexplained")
    return Calibration(
        title=campaign.title or campaign.name,
        law=campaign.isolation.law if campaign.isolation else "",
        errors={stage: replace(one, channels=_channel_errors(series, stage)) for stage, one in errors.items()},
        noise_floor=floors["validate"],
        noise_floor_fit=floors["fit"],
        effects=tuple(effect_of(problem, found, adopted, errors["corrected"], _described) for adopted in found.adopted),
        verdict=verdict,
        unexplained_share=share_left(errors["refit"], errors["corrected"], floors) if left else 0.0,
        unexplained_shape=describe_left(series, _first_mode(problem, found.final)) if left else "",
        next_test=None,
        refused=tuple((candidate.label, evidence.text) for candidate, evidence in found.refused),
        parameters={stage: parameters_of(judged) for stage, judged in stages.items()},
        law_held=found.law_held,
        series=series,
        seconds=clock.perf_counter() - begin,
        subject="structure",
    )


def _series(problem: StructureProblem, final: Judged, predicted: dict[Stage, list[np.ndarray]]) -> tuple[Series, ...]:
    """One a channel; displacement and velocity are those of its floor relative to the base in the corrected model."""
    effects = [acting(part) for part in final.fitted.parts]
    responses = problem.responses(final.fitted.base, effects)
    found = []
    for order, (test, response) in enumerate(zip(problem.tests, responses, strict=True)):
        assert response is not None
        noise = problem.channel_noise(test)
        histories = {stage: problem.channels(test, rows[order]) for stage, rows in predicted.items()}
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
                    predicted={stage: values[:, i] for stage, values in histories.items()},
                    temperature=np.full(test.time.size, _TEMPERATURE),
                    noise=float(noise[i]),
                    quantity=channel.measure,
                    unit=UNITS[channel.measure],
                    test=test.name,
                    channel=channel.label,
                )
            )
    return tuple(found)


def _channel_errors(series: Sequence[Series], stage: Stage) -> dict[str, float]:
    return {
        one.name: float(np.sum((one.measured - one.predicted[stage]) ** 2) / np.sum(one.measured**2)) for one in series
    }


def _first_mode(problem: StructureProblem, judged: Judged) -> float:
    """Hz; of an isolated building with the secant stiffness of its layer."""
    return (
        first_frequency(problem.setting.building)
        if problem.isolation
        else first_frequency(problem.building(judged.fitted.base))
    )


def _described(candidate: Candidate) -> Described:
    effect = candidate.effect
    return Described(effect.title, effect.signature, effect.amendment, effect.fixed)
