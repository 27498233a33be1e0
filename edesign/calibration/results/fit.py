"""What was found at the sampling of a fit, fitted to all samples, without effects that may be nothing or mislead."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Estimate
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.settings import SearchSettings
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import at_bounds, uncertainty
from edesign.optional_stages import optional

_STEPS = 8  # of a fit that begins near its end


@dataclass(frozen=True, eq=False)
class Kept:
    """A model of which no effect may be nothing.

    Attributes:
        model: fitted to all samples.
        dropped: models with one effect more, the index of that effect in them, and why it went, for people.
    """

    model: FittedModel
    dropped: tuple[tuple[FittedModel, int, str], ...]


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
    found = fitter.fit(model.effects, values, noise, _STEPS)
    if found is None:
        raise PredictionError(f"{model.label} cannot be fitted to all samples")
    return fitter.reweighted(found)


def kept(fitter: Fitter, model: FittedModel) -> Kept:
    """Return a model without the effects of which the 95 % interval of the size holds zero, the others fitted again."""
    dropped: list[tuple[FittedModel, int, str]] = []
    while True:
        may_be_nothing = [(i, size) for i in range(len(model.effects)) if (size := _size(model, i)) is not None]
        if not may_be_nothing:
            return Kept(model, tuple(dropped))
        index, size = max(may_be_nothing, key=lambda one: (one[1].interval[1] - one[1].interval[0], one[0]))
        own = model.effects[index].parameters
        values = model.fit.values[model.places(index)].tolist()
        shown = practical(size, {one.name: Estimate.held(v, one.unit) for one, v in zip(own, values, strict=True)})
        (low, high), name = shown.interval, own[0].name
        why = f"the 95 % interval of {name}, {low:.3g} to {high:.3g} {shown.unit}".rstrip() + ", holds zero"
        dropped.append((model, index, why))
        model = _without(fitter, model, index)


def told_by_validation(model: FittedModel, validate: Callable[[FittedModel], float]) -> FittedModel:
    """Return a model with each effect in the place where validation tests are predicted best.

    That is asked only of effects that do the same in all tests that are fitted wherever they stand.

    Args:
        model: of damper tests, fitted.
        validate: error of the validation tests by a model.
    """
    problem: DamperProblem = model.problem  # type: ignore[assignment]
    for index, effect in enumerate(model.effects):
        found = []
        for one in problem.alike(effect):
            effects = (*model.effects[:index], one, *model.effects[index + 1 :])
            found.append(FittedModel(problem, effects, replace(model.fit, model=problem.model(effects))))
        model = min(found, key=validate, default=model)
    return model


def validated(fitter: Fitter, found: Kept, refit: float, validate: Callable[[FittedModel], float]) -> Kept:
    """Return a model without the effects by which validation tests are predicted worse than by the refit.

    Where all effects together do that, the one goes without which these tests are predicted best, and so on. No effect
    comes in by the validation tests.

    Args:
        fitter: of the problem.
        found: a model of which no effect may be nothing.
        refit: error of the validation tests by the refitted law.
        validate: error of the validation tests by a model.
    """
    model, dropped = found.model, list(found.dropped)
    error = validate(model)
    while len(model.effects) > 1 and not error <= refit:
        fewer = [_without(fitter, model, i) for i in range(len(model.effects))]
        errors = [validate(one) for one in fewer]
        index = min(range(len(errors)), key=lambda i: (math.isnan(errors[i]), errors[i]))
        left = f"with it the validation tests are predicted worse ({100.0 * error:.3g} %) than without it"
        dropped.append((model, index, f"{left} ({100.0 * errors[index]:.3g} %)"))
        model, error = fewer[index], errors[index]
    # where one effect alone is worse than none, all of them are withheld
    return Kept(model, tuple(dropped)) if error <= refit else found


def _without(fitter: Fitter, model: FittedModel, index: int) -> FittedModel:
    """Return a model without an effect, fitted again.

    Raises:
        PredictionError: it cannot be fitted.
    """
    others, values = model.without(index)
    fewer = fitter.fit(others, values, model.noise, _STEPS)
    if fewer is None:
        raise PredictionError(f"the model cannot be fitted without {model.effects[index].label}")
    return fitter.reweighted(fitter.fit(others, fewer.fit.values, fewer.noise) or fewer)


def _size(model: FittedModel, index: int) -> Estimate | None:
    """Return the size of an effect whose interval holds zero; None: it has no size, or that is more than nothing."""
    if not model.effects[index].parameters:
        return None
    at = model.places(index)[0]
    low, high = uncertainty(model.fit, model.noise, free=at).interval(at)
    one = model.effects[index].parameters[0]
    return Estimate(float(model.fit.values[at]), 0.0, one.unit, (low, high)) if low <= 0.0 <= high else None


def estimates(model: FittedModel) -> list[Estimate]:
    """Return all parameters of a model with their 95 % intervals, SI; without these where they cannot be computed."""
    with optional(f"the intervals of {model.label}") as attempt:
        return _estimates(model)
    assert attempt.failure is not None
    unknown, why = (math.nan, math.nan), f"its interval could not be computed: {attempt.failure.reason}"
    each = zip(model.fit.model.parameters, model.fit.values.tolist(), strict=True)
    return [Estimate(value, math.inf, one.unit, unknown, why) for one, value in each]


def _estimates(model: FittedModel) -> list[Estimate]:
    sure, found = uncertainty(model.fit, model.noise), list[Estimate]()
    for i, (one, bound) in enumerate(zip(model.fit.model.parameters, at_bounds(model.fit), strict=True)):
        value, alone = float(model.fit.values[i]), np.eye(sure.z.size)[i]
        rate = one.spread * (one.value(float(sure.z[i])) if one.logarithmic else 1.0)  # for a change of its coordinate
        error = math.inf if bound else sure.standard_error(alone) * rate
        loose = float(sure.loose[i]) >= 0.5
        untold = "only a combination of it with others is known" if loose else "not known to a decade"
        why = f"at its {bound} bound" if bound else "" if sure.determined(i) else untold
        found.append(Estimate(value, error, one.unit, sure.interval(i), why))
    return found


def base_estimates(model: FittedModel) -> dict[str, Estimate]:
    """Return the parameters of the base of a model by name, with their 95 % intervals, SI."""
    base = model.fit.model.parameters[: model.places(0).start if model.effects else None]
    return dict(zip((one.name for one in base), estimates(model), strict=False))


def effect_estimates(model: FittedModel, every: list[Estimate], index: int) -> Mapping[str, Estimate]:
    """Return the parameters of an effect by name."""
    names = [one.name for one in model.effects[index].parameters]
    return dict(zip(names, (every[i] for i in model.places(index)), strict=True))


def law_estimates(problem: DamperProblem, model: FittedModel | None) -> dict[str, Estimate]:
    """Return the parameters of the law by name; those that were not fitted are held.

    Args:
        problem: of the tests.
        model: fitted; None: the declared law.
    """
    units = {one.name: one.unit for one in problem.law.all_parameters(problem.declared)}
    found = {name: Estimate.held(value, units[name]) for name, value in problem.declared.items()}
    if model is not None:
        found |= base_estimates(model)
    return found
