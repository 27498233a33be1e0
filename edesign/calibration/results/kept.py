"""Which of the effects that a search found stand: their intervals, and what the validation tests say of them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

from edesign.calibration.search.adoption import about_zero
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.settings import SETTINGS
from edesign.estimation.model import PredictionError

Validate = Callable[[FittedModel], float]
"""NRMS of the validation tests by a model; nan or infinite: it cannot predict them."""


@dataclass(frozen=True, eq=False)
class Dropped:
    """An effect that the search found and that is taken off after it.

    Attributes:
        model: with it.
        index: of it in that model.
        interval: 95 %, SI, of its size, which holds zero; None: the validation tests refuse it.
        with_it, without: NRMS of the validation tests, where these refuse it.
    """

    model: FittedModel
    index: int
    interval: tuple[float, float] | None = None
    with_it: float = math.nan
    without: float = math.nan


@dataclass(frozen=True, eq=False)
class Kept:
    """A model of which no effect may be nothing.

    Attributes:
        model: fitted to all samples.
        dropped: effects that were taken off.
    """

    model: FittedModel
    dropped: tuple[Dropped, ...] = ()


def kept(fitter: Fitter, model: FittedModel) -> Kept:
    """Return a model without the effects of which the 95 % interval of the size holds zero, the others fitted again.

    Args:
        model: fitted to all samples.

    Raises:
        PredictionError: it cannot be fitted without such an effect.
    """
    dropped: list[Dropped] = []
    while True:
        every = [Dropped(model, i, found) for i in range(len(model.effects)) if (found := about_zero(model, i))]
        if not every:
            return Kept(model, tuple(dropped))
        widest = max(every, key=_width)
        dropped.append(widest)
        fewer = fitter.omitting(model, widest.index, model.fit.held)
        if fewer is None:
            raise PredictionError(f"the model cannot be fitted without {model.effects[widest.index].label}")
        model = fewer


def placed(model: FittedModel, validate: Validate) -> FittedModel:
    """Return a model with each effect in the place where validation tests are predicted best.

    That is asked only of effects that do the same in all tests that are fitted wherever they stand.

    Args:
        validate: error of the validation tests by a model.
    """
    for index, effect in enumerate(model.effects):
        found = []
        for one in effect.confounded:
            effects = (*model.effects[:index], one, *model.effects[index + 1 :])
            found.append(FittedModel(model.problem, effects, replace(model.fit, model=model.problem.model(effects))))
        model = min(found, key=validate, default=model)
    return model


def validated(fitter: Fitter, found: Kept, plain: float, floor: float, validate: Validate) -> Kept:
    """Return a model without the changes by which validation tests are predicted worse than without them.

    As long as the law alone, or the model without one of its changes, predicts these tests better, that change is
    dropped without which they are predicted best: an effect, or the change of the law. No effect comes in by the
    validation tests.

    Args:
        found: a model of which no effect may be nothing.
        plain: error of the validation tests by the law alone, as declared or fitted again, the lesser one.
        floor: NRMS of the noise of these tests: no model predicts them better.
        validate: error of the validation tests by a model.
    """
    model, dropped = found.model, list(found.dropped)
    error = validate(model)
    while misleads(error, min(plain, floor)):
        several = range(len(model.effects) if len(model.effects) > 1 else 0)
        fewer = [(i, fitter.omitting(model, i, held)) for i in several for held in {model.fit.held, 0}]
        if model.effects and model.refits:
            fewer.append((-1, fitter.as_declared(model)))
        each = [(validate(one), index, one) for index, one in fewer if one is not None]
        least = min(each, key=lambda one: (math.isnan(one[0]), one[0]), default=None)
        # where one effect alone is worse than none, all of them are withheld
        if least is None or not misleads(error, min(plain, least[0])):
            break
        if least[1] >= 0:
            dropped.append(Dropped(model, least[1], None, error, least[0]))
        error, _, model = least
    return Kept(model, tuple(dropped))


def misleads(corrected: float, plain: float) -> bool:
    """Return whether effects make validation tests predicted worse, so that they are withheld: all are hypotheses.

    By less than instruments see they are not: half of all effects that do nothing in these tests would be.

    Args:
        corrected: NRMS of the validation tests with the effects; nan: they cannot be predicted.
        plain: the same by the base model alone, as declared or fitted again, the lesser one.
    """
    return not corrected <= plain + SETTINGS.least**2


def _width(one: Dropped) -> tuple[float, int]:
    assert one.interval is not None
    return one.interval[1] - one.interval[0], one.index
