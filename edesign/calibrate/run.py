"""Calibrate a law by a campaign: the whole loop, from the file to what was found."""

from __future__ import annotations

import time as clock
from collections.abc import Mapping, Sequence

import numpy as np

from edesign.calibrate.dampers.next_test import next_test
from edesign.calibrate.dampers.prepare import damper_problem, thinned
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import AT_FLOOR, Judged
from edesign.calibrate.dampers.trial import Trial
from edesign.calibrate.noise import white_noise
from edesign.calibrate.problem import Use
from edesign.calibrate.residual.record import Residual

from edesign.calibrate.residual.analysis import analyse
from edesign.calibrate.result import Calibration, Effect, Errors, Estimate, Series, Stage, Verdict
from edesign.calibrate.selection import Adopted, Loop, Progress, Selection
from edesign.damper.campaign import Campaign

BOTH: tuple[Use, ...] = ("fit", "validate")
_LEAST_NOISE = 5e-4  # of a test's rms force: no load cell is better, and no integration of a law is asked to be
_EXPLAINED = 1.5  # times the noise floor: error of the validation tests up to which nothing is left to explain


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
    """Standard deviation of what cannot be predicted in a test, N: noise of the force, and of the displacement through the law."""
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
    errors = {stage: _errors(problem, forces) for stage, forces in predicted.items()}
    floors = {use: _floor(problem, noise, use) for use in BOTH}
    verdict = _verdict(found, errors["corrected"], floors)
    over = max(errors["refit"].validate - floors["validate"], 1e-300)
    share = min(max((errors["corrected"].validate - floors["validate"]) / over, 0.0), 1.0)
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
        effects=tuple(_effect(problem, found, adopted, errors["corrected"]) for adopted in found.adopted),
        verdict=verdict,
        unexplained_share=share if left else 0.0,
        unexplained_shape=analyse([residual_of(one, "corrected") for one in series]).shape if left else "",
        next_test=next_test(problem, found),
        refused=tuple((candidate.label, evidence.text) for candidate, evidence in found.refused),
        parameters={stage: _parameters(judged) for stage, judged in stages.items()},
        law_held=found.law_held,
        series=series,
        seconds=clock.perf_counter() - begin,
    )


def predict(problem: DamperProblem, judged: Judged) -> list[np.ndarray]:
    """Force (n_i,) N of every test, with what is each test's own taken from its residual."""
    parts = judged.fitted.parts
    forces = []
    for i, force in enumerate(problem.predict(judged.fitted.base, parts, BOTH)):
        assert force is not None
        columns = problem.nuisance(parts, i) if parts else None
        if columns is not None:
            force = force + columns @ np.linalg.lstsq(columns, problem.measured[i] - force, rcond=None)[0]
        forces.append(force)
    return forces


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


def _errors(problem: DamperProblem, forces: Sequence[np.ndarray]) -> Errors:
    squared = [float(np.sum((m - f) ** 2)) for m, f in zip(problem.measured, forces, strict=True)]
    power = [float(m @ m) for m in problem.measured]

    def over(use: Use) -> float:
        chosen = [i for i, u in enumerate(problem.uses) if u == use]
        return sum(squared[i] for i in chosen) / sum(power[i] for i in chosen)

    tests = {name: s / p for name, s, p in zip(problem.names, squared, power, strict=True)}
    return Errors(over("fit"), over("validate"), tests)


def _floor(problem: DamperProblem, noise: Sequence[float], use: Use) -> float:
    chosen = [i for i, u in enumerate(problem.uses) if u == use]
    power = sum(float(problem.measured[i] @ problem.measured[i]) for i in chosen)
    return sum(noise[i] ** 2 * problem.measured[i].size for i in chosen) / power


def _verdict(found: Selection, corrected: Errors, floors: Mapping[Use, float]) -> Verdict:
    """See Calibration.verdict."""
    quiet = found.final.left <= AT_FLOOR or found.final.fitted.reduced <= _EXPLAINED
    at_floor = quiet and corrected.validate <= _EXPLAINED * floors["validate"]
    if not found.adopted:
        return "none" if at_floor else "unexplained"
    return "explained" if at_floor else "partly_explained"


def _effect(problem: DamperProblem, found: Selection, adopted: Adopted, corrected: Errors) -> Effect:
    candidate = adopted.candidate
    form, fixed = candidate.effect
    errors = _standard_errors(found.final)
    values = {
        unknown.name: Estimate(float(value), errors[(candidate.label, unknown.name)], unknown.unit)
        for unknown, value in zip(candidate.unknowns, adopted.values, strict=True)
    }
    without = _errors(problem, predict(problem, adopted.without))
    return Effect(
        name=candidate.name,
        form=candidate.form,
        kind=candidate.kind,
        title=form.title,
        amendment=getattr(form, "amendment_form", form.form) if form.amendment else "",
        parameters=values,
        fixed=fixed,
        delta_validate=without.validate - corrected.validate,
        evidence=f"{form.signature}; {adopted.evidence.text}",
        share=adopted.evidence.share,
        indistinguishable_from=tuple(adopted.alike),
    )


def _standard_errors(judged: Judged) -> dict[tuple[str, str], float]:
    """Of every unknown by the label of its effect ("" for the law) and its name, SI."""
    fitted = judged.fitted
    owners = [""] * len(fitted.model.base)
    owners += [effect.label for effect in fitted.model.effects for _ in effect.unknowns]
    variances = np.diag(fitted.covariance) if fitted.x.size else np.empty(0)
    return {
        (owner, u.name): abs(u.slope(float(c))) * float(np.sqrt(max(v, 0.0)))
        for owner, u, c, v in zip(owners, fitted.model.unknowns, fitted.x, variances, strict=True)
    }


def _parameters(judged: Judged) -> dict[str, Estimate]:
    errors = _standard_errors(judged)
    return {
        u.name: Estimate(float(value), errors.get(("", u.name), 0.0), u.unit)
        for u, value in zip(judged.fitted.model.problem.base, judged.fitted.base, strict=True)
    }
