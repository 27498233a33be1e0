"""Where an effect is adopted: every gate. docs/theory/calibration.md explains the steps.

    rule of adoption   `sure`: tests that are left out are predicted significantly better
    search, step 5     `Adoption.pruned`: an effect explains more than instruments see, is needed beside the others, is
                       of some size (`insignificant`), and is no error of the equations of others
    search, step 6     `Adoption.best_of`: of the candidates that are sure and identified, each with the best form and
                       pruned, the one that gains most; no set of effects twice
    search, step 7     `Adoption.in_place`: another effect in the place of one
    after the search   `kept`: no interval of a size holds zero; for tests of dampers `placed` and `validated` besides,
                       and for all campaigns `misleads`: what the validation tests say, which have chosen nothing so far

The numbers are those of `settings.py` beside this file and of `edesign/estimation/left_out.py`. Words for people are
made in `results`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.variants import Variants
from edesign.estimation.left_out import LEAST, Difference
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import at_bounds, uncertainty

STEPS = 8
"""Of a fit that begins near its end."""

Validate = Callable[[FittedModel], float]
"""NRMS of the validation tests by a model; nan or infinite: it cannot predict them."""


def sure(difference: Difference) -> bool:
    """Return whether one model is significantly better than another: the rule of adoption.

    Args:
        difference: of their log densities of tests left out, with its error.
    """
    return difference.total > max(LEAST, 2.0 * difference.error)


@dataclass(frozen=True)
class Tried:
    """A model that was compared with the best one so far.

    Attributes:
        model: fitted to the end.
        difference: by how much it predicts better.
    """

    model: FittedModel
    difference: Difference


class Adoption:
    """The gates of a search.

    Args:
        base: the base model, fitted.
    """

    def __init__(self, fitter: Fitter, variants: Variants, base: FittedModel) -> None:
        self._fitter, self._variants = fitter, variants
        self._taken = {base.names}

    def take(self, model: FittedModel) -> FittedModel:
        """Note that a model is the best one now; no set of effects is that twice, so that the search comes to its end.

        Args:
            model: that was adopted.
        """
        self._taken.add(model.names)
        return model

    def pruned(self, model: FittedModel, known: FittedModel) -> FittedModel | None:
        """Return the model without effects that it does not need, or that are of no size, or less than instruments see.

        Noise of the motion makes force through the law. An effect that swallows it, as a clearance as large as the
        noise, is better and is none.

        Each effect is needed beside the others, whatever equations these have, and although these may be wrong.

        Returns:
            The effects that are not known are in the order of what they explain; None: there are none.
        """
        fitter, explained = self._fitter, list[float]()
        while model.effects:
            simpler, explained = [], []
            for index in range(len(model.effects)):
                others, _ = model.without(index)
                one = known if others == known.effects else self._variants.omitting(model, index)
                if one is None:
                    explained.append(math.inf)
                    continue
                noise = fitter.noise(model, one)
                if sure(fitter.difference(model, one, noise, one)) and one is not known:
                    one = fitter.reweighted(self._variants.with_best_forms(one, noise, True))
                    noise = fitter.noise(model, one)
                explained.append(one.nrms - model.nrms)
                if (
                    explained[-1] <= max(fitter.settings.least**2, fitter.problem.input_noise)
                    or not sure(fitter.difference(model, one, noise, one))
                    or self.insignificant(model, index)
                    or not self._identified_in(model, index, one, noise)
                ):
                    simpler.append(one)
            if not simpler:
                break
            # of two effects that do the same, the one stays that is something
            noise = fitter.noise(model, known)
            model = min(simpler, key=lambda one: (self._insignificant_effects(one), -fitter.score(one, noise).total))
        # less than is known already is no step: the next depth would take it back
        if model.names <= known.names:
            return None
        new = [i for i, effect in enumerate(model.effects) if effect.name not in known.names]
        old = [i for i in range(len(model.effects)) if i not in new]
        return fitter.in_order(model, [*old, *sorted(new, key=lambda i: -explained[i])])

    def insignificant(self, model: FittedModel, index: int) -> bool:
        """Return whether the size of an effect may be nothing (95 %), or is at a bound, where it is another effect.

        A share of a whole may be all of it.
        """
        size = model.places(index)[:1]
        if not size:
            return False
        bound = at_bounds(model.fit)[size[0]]
        if bound:
            return not (bound == "upper" and model.effects[index].parameters[0].whole)
        low, high = uncertainty(model.fit, model.noise).interval(size[0])
        return low <= 0.0 <= high

    def _insignificant_effects(self, model: FittedModel) -> int:
        return sum(self.insignificant(model, i) for i in range(len(model.effects)))

    def _identified_in(self, model: FittedModel, index: int, rest: FittedModel, noise: Noise) -> bool:
        """Return whether an effect is no error of the equations of the others.

        It explains more than these may be wrong by, or no other effect predicts as well in its place.
        """
        if rest.nrms - model.nrms > self._errors(model, [i for i in range(len(model.effects)) if i != index]):
            return True
        others = self._variants.in_place(model.effects[index], rest)
        return all(sure(self._fitter.difference(model, one, noise, rest)) for one in others)

    def _identified_among(
        self, models: Sequence[FittedModel], model: FittedModel, known: FittedModel, noise: Noise
    ) -> bool:
        """Return whether what a model adds is no error of the equations of known effects.

        It explains more than these may be wrong by, or no model with other effects predicts as well.
        """
        if known.nrms - model.nrms > self._errors(known, range(len(known.effects))):
            return True
        others = [one for one in models if not (one.names <= model.names or one.names >= model.names)]
        return all(sure(self._fitter.difference(model, one, noise, known)) for one in others)

    def _errors(self, model: FittedModel, effects: Sequence[int]) -> float:
        """Return the share of the power of what was measured by which equations of effects may be wrong."""
        return self._fitter.settings.own_discrepancy**2 * sum(model.size(i) ** 2 for i in effects)

    def best_of(self, tried: Sequence[Tried], known: FittedModel, noise: Noise) -> FittedModel | None:
        """Return the best of models that pass the rule, by what is needed of it; None: none passes.

        Parts of a model may be less than the next one.

        Args:
            tried: models, the best first.
            known: the model beside which they were found.
            noise: by which they are compared.
        """
        adopted, most = None, -math.inf
        for one in tried:
            if not sure(one.difference) or one.difference.total <= most:
                continue
            if not self._identified_among([each.model for each in tried], one.model, known, noise):
                continue
            needed = self.pruned(self._variants.with_best_forms(one.model, noise), known)
            if needed is not None and needed.names not in self._taken:
                total = self._fitter.difference(needed, known, noise, known).total
                if total > most:
                    adopted, most = needed, total
        return adopted

    def in_place(self, tried: Sequence[Tried], best: FittedModel) -> FittedModel | None:
        """Return the best of models that are surely better with another effect in the place of one; None: none is.

        What equations may be wrong by, of an effect that does much, must not hide that less is explained.

        Args:
            tried: models, compared with the best one beside that without the effect.
        """
        better = [
            one
            for one in tried
            if sure(one.difference)
            and one.model.names not in self._taken
            and self._predicts_better(one.model, best)
            and not self._insignificant_effects(one.model)
        ]
        return max(better, key=lambda one: one.difference.total).model if better else None

    def _predicts_better(self, one: FittedModel, other: FittedModel) -> bool:
        """Return whether a model predicts better than another one beside what this one leaves alone."""
        return self._fitter.score(one, other.noise).total > self._fitter.score(other, other.noise).total


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
    """
    dropped: list[Dropped] = []
    while True:
        every = [Dropped(model, i, found) for i in range(len(model.effects)) if (found := _about_zero(model, i))]
        if not every:
            return Kept(model, tuple(dropped))
        widest = max(every, key=_width)
        dropped.append(widest)
        model = _without(fitter, model, widest.index)


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


def validated(fitter: Fitter, found: Kept, refit: float, validate: Validate) -> Kept:
    """Return a model without the effects by which validation tests are predicted worse than by the refit.

    Where all effects together do that, the one is dropped without which these tests are predicted best, and so on. No
    effect comes in by the validation tests.

    Args:
        found: a model of which no effect may be nothing.
        refit: error of the validation tests by the refitted law.
        validate: error of the validation tests by a model.
    """
    model, dropped = found.model, list(found.dropped)
    error = validate(model)
    while len(model.effects) > 1 and misleads(error, refit):
        fewer = [_without(fitter, model, i) for i in range(len(model.effects))]
        errors = [validate(one) for one in fewer]
        index = min(range(len(errors)), key=lambda i: (math.isnan(errors[i]), errors[i]))
        dropped.append(Dropped(model, index, None, error, errors[index]))
        model, error = fewer[index], errors[index]
    # where one effect alone is worse than none, all of them are withheld
    return found if misleads(error, refit) else Kept(model, tuple(dropped))


def misleads(corrected: float, refit: float) -> bool:
    """Return whether effects make validation tests predicted worse, so that they are withheld: all are hypotheses.

    Args:
        corrected: NRMS of the validation tests with the effects; nan: they cannot be predicted.
        refit: the same by the base model fitted again.
    """
    return not corrected <= refit


def _about_zero(model: FittedModel, index: int) -> tuple[float, float] | None:
    """Return the 95 % interval, SI, of an effect's size if it holds zero; None: it does not, or there is no size."""
    if not model.effects[index].parameters:
        return None
    at = model.places(index)[0]
    low, high = uncertainty(model.fit, model.noise, free=at).interval(at)
    return (low, high) if low <= 0.0 <= high else None


def _width(one: Dropped) -> tuple[float, int]:
    assert one.interval is not None
    return one.interval[1] - one.interval[0], one.index


def _without(fitter: Fitter, model: FittedModel, index: int) -> FittedModel:
    """Return a model without an effect, fitted again.

    Raises:
        PredictionError: it cannot be fitted.
    """
    others, values = model.without(index)
    fewer = fitter.fit(others, values, model.noise, STEPS)
    if fewer is None:
        raise PredictionError(f"the model cannot be fitted without {model.effects[index].label}")
    return fitter.reweighted(fitter.fit(others, fewer.fit.values, fewer.noise) or fewer)
