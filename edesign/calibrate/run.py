"""Calibrate a law by a campaign: the whole loop, from the tests to what was found."""

from __future__ import annotations

import math
import time as clock
from dataclasses import replace

from edesign.calibrate.allowance import taken
from edesign.calibrate.dampers.carried import carried_law, described
from edesign.calibrate.dampers.full_rate import at_full_rate
from edesign.calibrate.dampers.law_kind import law_kind
from edesign.calibrate.dampers.law_unknowns import held_parameters
from edesign.calibrate.dampers.next_test import next_test
from edesign.calibrate.dampers.prepare import damper_problem, thinned, with_noise
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.readings import Reading, likely_readings
from edesign.calibrate.dampers.starts import as_started, settled, with_starts
from edesign.calibrate.evidence import simplest
from edesign.calibrate.fit import Fitted
from edesign.calibrate.outcome import Outcome, residual_of
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.result import Calibration, Series
from edesign.calibrate.search.loop import Loop, Progress
from edesign.calibrate.search.selection import Selection
from edesign.calibration.residual.analysis import analyse
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice

_LEAST, _SECOND = 0.5, 0.25
"""Of the time, that a search has at least after the law was read, and that of the second one of two readings.
"""


def calibrate(
    campaign: Campaign, workers: int = 2, progress: Progress = lambda _: None, seconds: float = math.inf
) -> Calibration:
    """Run the loop on the tests of a campaign.

    Args:
        campaign: tests, and the declared law.
        workers: processes.
        progress: told what is done.
        seconds: processor time after which the search goes on with what it has found.

    Raises:
        InputError: the campaign is wrong.
    """
    begin = clock.perf_counter()
    problem = damper_problem(campaign)  # that there is a law
    assert campaign.law is not None
    noise = tuple(trial.noise for trial in problem.trials)
    fast = with_starts(thinned(problem), campaign.tests)
    found, fast = _searched(fast, campaign.law, noise, workers, progress, seconds)
    final = found.final.fitted
    fast = with_starts(fast, campaign.tests, final.base, final.parts)
    problem = replace(as_started(problem, fast), lasting=fast.lasting, gamma_of=fast.gamma_of)
    progress("fitting all samples")
    problem = noisy_beside(problem, final)
    noise = tuple(trial.noise for trial in problem.trials)
    found = at_full_rate(found, problem, noise)
    progress("predicting all tests")
    final = found.final.fitted
    problem = as_started(problem, with_starts(fast, campaign.tests, final.base, final.parts))
    told = settled(problem)
    outcome = Outcome.of(told, noise, found)
    found = outcome.found
    series = tuple(
        Series(
            trial.name,
            test.title,
            trial.use,
            trial.order,
            trial.motion.time,
            trial.motion.displacement,
            trial.motion.velocity,
            trial.force,
            {stage: forces[i] for stage, forces in outcome.predicted.items()},
            trial.temperature,
            noise[i],
            start=trial.start,
        )
        for i, (trial, test) in enumerate(zip(problem.trials, campaign.tests, strict=True))
    )
    progress("writing the law")
    carried = carried_law(found.final.fitted, found.refit.fitted, fast, told, outcome.floors["validate"])
    progress("asking which further test would tell more")
    calibration = outcome.calibration(
        campaign.label,
        problem.law.name,
        described,
        analyse([residual_of(one, "corrected") for one in series]).shape if outcome.more_is_left else "",
        next_test(fast, found, workers),
        series,
        clock.perf_counter() - begin,
    )
    held = held_parameters(problem.law)
    calibration = replace(
        calibration,
        carried=carried,
        held=held,
        lasting=fast.lasting,
        gamma_of=fast.gamma_of,
        fitted_first=campaign.law.fitted,
    )
    return replace(calibration, kind=law_kind(campaign, calibration, workers, progress))


def _searched(
    problem: DamperProblem,
    law: LawChoice,
    noise: tuple[float, ...],
    workers: int,
    progress: Progress,
    seconds: float,
) -> tuple[Selection, DamperProblem]:
    """What the loop finds with the likeliest reading of the law, and that reading; with a second one in the rest of the
    time if more than noise is left then.
    """
    begun = taken()
    first, *others = likely_readings(problem, law, noise, workers)
    seconds = max(seconds - (taken() - begun), _LEAST * seconds)
    begun = taken()

    def search(reading: Reading, seconds: float) -> Selection:
        return Loop(reading.problem, noise, law.refit, workers, progress, seconds).run(reading.refitted)

    found = search(first, (1.0 - _SECOND) * seconds if others else seconds)
    for other in others if found.ending != "interrupted" else ():
        if found.final.at_floor:
            break
        progress("searching with the law read another way")
        try:
            again = search(other, max(seconds - (taken() - begun), _SECOND * seconds))
        except KeyboardInterrupt:
            return replace(found, ending="interrupted"), first.problem
        if again.final is simplest([found.final, again.final]):
            found, first = again, other
    return found, first.problem


def noisy_beside(problem: DamperProblem, final: Fitted) -> DamperProblem:
    """With what noise of the motion makes in a final model: friction is as steep at rest as the law is, or steeper."""
    try:
        return with_noise(problem, final.base, final.parts) if final.parts else problem
    except PredictionError:
        return problem
