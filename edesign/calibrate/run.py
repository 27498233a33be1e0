"""Calibrate a law by a campaign: the whole loop, from the file to what was found."""

from __future__ import annotations

import time as clock
from collections.abc import Sequence

import numpy as np

from edesign.calibrate.dampers.next_test import next_test
from edesign.calibrate.dampers.prepare import damper_problem, thinned
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Trial
from edesign.calibrate.evidence import Judged
from edesign.calibrate.noise import white_noise
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
from edesign.calibrate.residual.analysis import analyse
from edesign.calibrate.residual.record import Residual
from edesign.calibrate.result import Calibration, Series, Stage
from edesign.calibrate.selection import Loop, Progress, Selection
from edesign.damper.campaign import Campaign

_LEAST_NOISE = 5e-4  # of a test's rms force: no load cell is better, and no integration of a law is asked to be


def calibrate(campaign: Campaign, workers: int = 2, progress: Progress = lambda _: None) -> Calibration:
    """Run the loop on the tests of a campaign.

    Args:
        campaign: tests, and the declared law.
        workers: threads.
        progress: told what is done.

    Raises:
        InputError: the campaign is wrong.
    """
    begin = clock.perf_counter()
    problem = damper_problem(campaign)
    noise = tuple(noise_of(trial) for trial in problem.trials)
    refit = campaign.law is None or campaign.law.refit
    selection = Loop(thinned(problem), noise, refit, workers, progress).run()
    progress("predicting all tests")
    return _result(campaign, problem, noise, selection, progress, begin)


def noise_of(trial: Trial) -> float:
    """Standard deviation of what cannot be predicted in a test, N: noise of the force, and of the displacement
    through the law.
    """
    channel = white_noise(trial.force, trial.motion.time)
    return max(float(np.hypot(channel, trial.motion_noise)), _LEAST_NOISE * float(np.sqrt(np.mean(trial.force**2))))


def _result(
    campaign: Campaign,
    problem: DamperProblem,
    noise: Sequence[float],
    found: Selection,
    progress: Progress,
    begin: float,
) -> Calibration:
    stages: dict[Stage, Judged] = {"declared": found.declared, "refit": found.refit, "corrected": found.final}
    predicted = {stage: predict(problem, judged) for stage, judged in stages.items()}
    errors = {stage: errors_of(problem, forces) for stage, forces in predicted.items()}
    floors = {use: floor_of(problem, noise, use) for use in BOTH}
    verdict = verdict_of(found, errors["corrected"], floors)
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
            {stage: forces[i] for stage, forces in predicted.items()},
            trial.temperature,
            noise[i],
        )
        for i, (trial, test) in enumerate(zip(problem.trials, campaign.tests, strict=True))
    )
    left = verdict in ("partly_explained", "unexplained")
    progress("asking which further test would tell more")
    return Calibration(
        title=campaign.title or campaign.specimen.name,
        law=problem.law.name,
        errors=errors,
        noise_floor=floors["validate"],
        noise_floor_fit=floors["fit"],
        effects=tuple(effect_of(problem, found, adopted, errors["corrected"], _described) for adopted in found.adopted),
        verdict=verdict,
        unexplained_share=share_left(errors["refit"], errors["corrected"], floors) if left else 0.0,
        unexplained_shape=analyse([residual_of(one, "corrected") for one in series]).shape if left else "",
        next_test=next_test(problem, found),
        refused=tuple((candidate.label, evidence.text) for candidate, evidence in found.refused),
        parameters={stage: parameters_of(judged) for stage, judged in stages.items()},
        law_held=found.law_held,
        series=series,
        seconds=clock.perf_counter() - begin,
    )


def residual_of(series: Series, stage: Stage) -> Residual:
    """The residual of a test at a stage, as the analysis takes it."""
    return Residual(
        series.name,
        series.order,
        series.use,
        series.time,
        series.displacement,
        series.velocity,
        series.measured,
        series.predicted[stage],
        series.temperature,
    )


def _described(candidate: Candidate) -> Described:
    form, fixed = candidate.effect
    amendment = getattr(form, "amendment_form", form.form) if form.amendment else ""
    return Described(form.title, form.signature, amendment, fixed)
