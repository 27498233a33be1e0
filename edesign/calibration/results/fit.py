"""What was found at the sampling of a fit, fitted to all samples, and its parameters with their intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.residual.series import Stage
from edesign.calibration.results.result import Estimate
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import ranges_of, values_of
from edesign.estimation.uncertainty import Uncertainty, at_bounds, uncertainty
from edesign.optional_stages import optional

STEPS = 8
"""Of a fit that begins near its end."""
_PARTS = (4, 16)
"""Into which steps are cut: those of a fit are of 5 ms or less, a contact lasts a millisecond."""
_CHORDS = 4  # steps by the slopes of the fit
_OF_ERROR = 0.1  # of its standard error, by which errors of steps may move a parameter: the interval is as wide then


def unbounded(problem: Problem, settings: SearchSettings) -> Fitter:
    """Return what fits models of a problem without counting the effort."""
    return Fitter(problem, replace(settings, effort=math.inf))


def at_full_rate(fitter: Fitter, model: FittedModel) -> FittedModel:
    """Return a model fitted to all samples; where it cannot be, with the values that it has.

    Raises:
        PredictionError: it cannot predict at full rate.
    """
    problem, values = fitter.problem, model.fit.values
    whole = problem.model(model.effects)
    (forces,) = whole.predict(values[np.newaxis])
    if isinstance(forces, PredictionError):
        raise forces
    left = [y - f for y, f in zip(whole.measured, forces, strict=True)]
    noise = Noise.left_by(left, problem.deviations, problem.sizes)
    found = fitter.fit(model.effects, values, noise, STEPS, model.fit.held)
    if found is None:
        raise PredictionError(f"{model.label} cannot be fitted to all samples")
    return fitter.reweighted(found)


def resolved(model: FittedModel) -> FittedModel:
    """Return a model with the parameters of steps so fine that finer ones move none by a share of its error.

    Steps of a fit pass over what happens within one: a play that closes, a mass that follows a force which jumps. With
    the parameters that are returned finer steps predict what those of the fit did: they are found by its slopes.

    Args:
        model: fitted to all samples.
    """
    fitted, problem = model.fit, model.problem
    weights = [1.0 / one for one in problem.deviations]
    slopes = np.vstack([w * j for w, j in zip(weights, fitted.slopes, strict=True)])
    known = _OF_ERROR**2 * np.diag(np.linalg.pinv(slopes.T @ slopes))
    z, bounds = fitted.z, ranges_of(fitted.model.parameters)
    for parts in _PARTS:
        finer: DamperProblem = replace(problem, parts=parts)  # type: ignore[type-var,assignment]
        of, there, far = finer.model(model.effects), fitted.predicted, list[float]()
        while len(far) <= _CHORDS:
            (found,) = of.predict(values_of(of.parameters, z)[np.newaxis])
            if isinstance(found, PredictionError):
                return model
            there = tuple(found)
            change = [w * (f - g) for w, f, g in zip(weights, there, fitted.predicted, strict=True)]
            step = np.linalg.lstsq(slopes, np.concatenate(change))[0]
            far.append(float(np.max(np.square(step) / np.maximum(known, 1e-300), initial=0.0)))
            if far[-1] <= 1.0:
                break
            if len(far) <= _CHORDS:
                z = np.clip(z - step, *bounds)
        if len(far) == 1 or far[-1] > far[0]:  # nothing to find, or not by these slopes
            break
        model = FittedModel(finer, model.effects, replace(fitted, model=of, z=z, predicted=there))
    return model


def estimates(model: FittedModel) -> list[Estimate]:
    """Return all parameters of a model with their 95 % intervals, SI; without these where they cannot be computed."""
    with optional(f"the intervals of {model.label}") as attempt:
        return _estimates(model)
    assert attempt.failure is not None
    unknown, why = (math.nan, math.nan), f"its interval could not be computed: {attempt.failure.reason}"
    each = zip(model.fit.model.parameters, model.fit.values.tolist(), strict=True)
    return [Estimate(value, math.inf, one.unit, unknown, why) for one, value in each]


@lru_cache(maxsize=1)
def model_uncertainty(model: FittedModel) -> Uncertainty:
    """Return the uncertainty of a model whose effects may have other equations.

    The parameters of an effect are those with which its equation comes nearest to what it does. So what other equations
    of it do in its place is freed of what its own parameters can make of it: the rest is what moves the law, and other
    effects. Each other equation is as large as the effect, and all of them together have the amplitude of an error.

    Source: Plumlee (2017), J. Am. Statist. Assoc. 112, 1274-1285 (parameters of a model that is not exact).
    """
    fitter, fitted = unbounded(model.problem, SETTINGS), model.freed
    slopes = np.vstack(fitted.slopes)
    sizes = [f.size for f in model.fit.predicted]
    weights = np.repeat([model.noise.weight(i) for i in range(len(sizes))], sizes)[:, np.newaxis]
    found = [np.zeros((sum(sizes), 0))]
    for index in range(len(model.effects)):
        others = [np.concatenate(change) for _, _, change in fitter.alternatives(model, index, here=True)]
        if others:
            wrong, own = weights * np.column_stack(others), weights * slopes[:, model.places(index)]
            change = weights[:, 0] * np.concatenate(model.contribution(index))
            wrong *= np.linalg.norm(change) / np.linalg.norm(wrong, axis=0) / math.sqrt(len(others))
            found.append((wrong - own @ np.linalg.lstsq(own, wrong)[0]) / weights)
    columns = np.split(np.hstack(found), np.cumsum(sizes)[:-1])
    return uncertainty(fitted, model.noise, wrong=columns, share=SETTINGS.median_discrepancy)


def _estimates(model: FittedModel) -> list[Estimate]:
    of, sure, found = model.freed, model_uncertainty(model), list[Estimate]()
    for i, (one, bound) in enumerate(zip(of.model.parameters, at_bounds(of), strict=True)):
        value, alone = float(model.fit.values[i]), np.eye(sure.z.size)[i]
        rate = one.spread * (one.value(float(sure.z[i])) if one.logarithmic else 1.0)  # for a change of its coordinate
        error = math.inf if bound else sure.standard_error(alone) * rate
        loose = float(sure.loose[i]) >= 0.5
        undetermined = "only a combination of it with others is known" if loose else "not known to a decade"
        why = f"at its {bound} bound" if bound else "" if sure.determined(i) else undetermined
        found.append(Estimate(value, error, one.unit, sure.interval(i), why))
    return found


def base_estimates(model: FittedModel) -> dict[str, Estimate]:
    """Return the parameters of the base of a model by name, with their 95 % intervals, SI."""
    base = model.fit.model.parameters[: model.base_size]
    return dict(zip((one.name for one in base), estimates(model), strict=False))


def effect_estimates(model: FittedModel, every: list[Estimate], index: int) -> Mapping[str, Estimate]:
    """Return the parameters of an effect by name."""
    names = [one.name for one in model.effects[index].parameters]
    return dict(zip(names, (every[i] for i in model.places(index)), strict=True))


def law_estimates(problem: DamperProblem, model: FittedModel | None) -> dict[str, Estimate]:
    """Return the parameters of the law by name; those that were not fitted are fixed.

    Args:
        model: fitted; None: the declared law.
    """
    units = {one.name: one.unit for one in problem.law.all_parameters(problem.declared)}
    values = problem.declared if model is None else problem.law_values(model.fit.values)
    found = {name: Estimate.fixed(value, units[name]) for name, value in values.items()}
    if model is not None:
        found |= base_estimates(model)
    return found


def law_stages(problem: DamperProblem, refit: FittedModel, final: FittedModel) -> dict[Stage, dict[str, Estimate]]:
    """Return the parameters of the law by stage and name.

    Args:
        refit: the law fitted again.
        final: the corrected model.
    """
    models: dict[Stage, FittedModel | None] = {"declared": None, "refit": refit, "corrected": final}
    return {stage: law_estimates(problem, model) for stage, model in models.items()}
