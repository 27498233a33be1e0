"""Calibrate a building by records of its motion: the whole loop, from the campaign to what was found."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.law_unknowns import held_parameters
from edesign.calibrate.evidence import Judged
from edesign.calibrate.outcome import Outcome
from edesign.calibrate.problem import Candidate, Described
from edesign.calibrate.result import Calibration, Series, Stage
from edesign.calibrate.search.loop import Loop, Progress
from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.check import check_channels, check_tests
from edesign.calibrate.structure.problem import StructureProblem, acting, first_frequency
from edesign.calibrate.structure.record import UNITS
from edesign.calibrate.structure.shape import describe_left
from edesign.damper.laws import LAWS

_TEMPERATURE = 20.0  # degC; records of structures have none, and no effect of a structure asks for it


def calibrate_structure(
    campaign: StructureCampaign,
    workers: int = 2,
    progress: Progress = lambda _: None,
    seconds: float = math.inf,
) -> Calibration:
    """Run the loop on the records of a structure.

    Args:
        campaign: records, and the declared building.
        workers: processes.
        progress: told what is done.
        seconds: processor time after which the search goes on with what it has found.

    Raises:
        InputError: the campaign is wrong.
    """
    begin = clock.perf_counter()
    check_tests(campaign)
    problem = StructureProblem.of(campaign)
    check_channels(problem, campaign)
    found = Loop(problem, problem.noise, bool(problem.base), workers, progress, seconds).run()
    progress("predicting all tests")
    outcome = Outcome.of(problem, problem.noise, found)
    found = outcome.found
    series = _series(problem, found.final, outcome.predicted)
    told = outcome.calibration(
        campaign.title or campaign.name,
        campaign.isolation.law if campaign.isolation else "",
        _described,
        describe_left(series, _first_mode(problem, found.final)) if outcome.more_is_left else "",
        None,
        series,
        clock.perf_counter() - begin,
    )
    errors = {stage: replace(one, channels=_channel_errors(series, stage)) for stage, one in told.errors.items()}
    held = {} if problem.isolation is None else held_parameters(LAWS[problem.isolation.law])
    return replace(told, errors=errors, held=held, subject="structure")


def _series(
    problem: StructureProblem, final: Judged, predicted: Mapping[Stage, Sequence[np.ndarray]]
) -> tuple[Series, ...]:
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
