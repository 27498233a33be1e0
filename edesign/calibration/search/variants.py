"""Variants of a fitted model: without one of its effects, with another in its place, with the best equations."""

from __future__ import annotations

import numpy as np

from edesign.calibration.search.models import FittedModel, Fitter, Key, once
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.screening import Screening, screen
from edesign.estimation.left_out import LEAST
from edesign.estimation.noise import Noise


class Variants:
    """Fits variants of models; what was fitted in the place of an effect is kept.

    Args:
        base: the same, fitted; the declared one where that is fixed.
    """

    def __init__(self, fitter: Fitter, declared: FittedModel, base: FittedModel) -> None:
        self._fitter, self._declared, self._base = fitter, declared, base
        self._beside = dict[Key, dict[str, FittedModel]]()
        self._formed = dict[FittedModel, FittedModel]()

    def as_declared(self, model: FittedModel) -> FittedModel | None:
        """Return a model with the base as declared, its effects fitted again; None: it cannot predict so."""
        return self._fitter.as_declared(model) if model.effects else self._declared

    def otherwise_based(self, model: FittedModel) -> list[FittedModel]:
        """Return a model without effects with the other base, one as declared with the base fitted too, else none."""
        if self._declared is self._base or (model.effects and model.refits):
            return []
        if not model.effects:
            return [self._base if model is self._declared else self._declared]
        found = self._fitter.fit(model.effects, model.fit.values, model.noise, self._fitter.settings.rough_steps)
        return [] if found is None else [found]

    def readings(self) -> list[FittedModel]:
        """Return the base under each other reading of it, an effect without parameters, fitted; none if it is fixed."""
        fitter, base = self._fitter, self._base
        forms = [one for one in fitter.problem.effects if not (one.parameters or one.nuisance)]
        fitted = [fitter.fit((form,), base.fit.values, base.noise) for form in forms if base is not self._declared]
        return [fitter.reweighted(one) for one in fitted if one is not None]

    def without_effects(self, model: FittedModel) -> FittedModel:
        """Return the base of a model alone, as declared or fitted like its own."""
        return self._base if model.refits else self._declared

    def omitting(self, model: FittedModel, index: int) -> FittedModel | None:
        """Return a model without one of its effects, fitted; None: it cannot predict then."""
        alone = len(model.effects) == 1
        return self.without_effects(model) if alone else self._fitter.omitting(model, index, model.fit.held)

    def refitted_without(self, model: FittedModel, index: int) -> FittedModel | None:
        """Return a model without one of its effects, its base fitted too: what takes the place may ask for that."""
        held = model.fit.held if self._declared is self._base else 0
        return self._base if len(model.effects) == 1 else self._fitter.omitting(model, index, held)

    @once
    def screened(self, model: FittedModel) -> Screening:
        """Return the screening beside a model."""
        return screen(self._fitter, model)

    def in_place(self, effect: Effect, rest: FittedModel, model: FittedModel) -> list[FittedModel]:
        """Return models with another effect in the place of one: those that the screening puts first, fitted roughly.

        Args:
            effect: that is replaced.
            rest: model without it.
            model: with it, that they are not surely behind.
        """
        fitter, key = self._fitter, rest.key
        if key not in self._beside:
            found: dict[str, FittedModel] = {}
            screening = self.screened(rest)
            for start, gain in screening.singles:
                if gain <= 0.0 or len(found) > fitter.settings.others:
                    break
                if start.effect.name in found:
                    continue
                grown = fitter.extended(rest, [start], screening.noise)
                if grown is not None:
                    found[start.effect.name] = fitter.rough(grown, screening.noise)
            self._beside[key] = found
        others = [one for name, one in self._beside[key].items() if name != effect.name][: fitter.settings.others]
        return [one for one in others if not fitter.behind(one, model)]

    def with_best_forms(self, model: FittedModel, noise: Noise) -> FittedModel:
        """Return the model with that equation of each effect that predicts best, fitted to the end; it is kept.

        Args:
            noise: by which predictions are compared.
        """
        if model not in self._formed:
            found = self.with_better_forms(model, noise, self._fitter.settings.others)
            self._formed[model] = self._fitter.reweighted(found)
        return self._formed[model]

    def with_better_forms(self, model: FittedModel, noise: Noise, number: int) -> FittedModel:
        """Return the model with that equation of each effect that predicts best after a few steps.

        Of equations as good as the best one that is taken which has fewest parameters, none at a bound if possible: a
        form at a bound of a parameter is another form, and that bound is no price of a parameter.

        Args:
            noise: by which predictions are compared.
            number: of other equations of each effect that are tried.
        """
        fitter = self._fitter
        for index in range(len(model.effects)):
            nearest = fitter.nearest_equations(model, index, noise, number)
            models = [model, *(fitter.rough(one, noise) for one in nearest)]
            totals = [fitter.score(one, noise, roughly=True).total for one in models]
            alike = [(one, total) for one, total in zip(models, totals, strict=True) if total > max(totals) - LEAST]
            model = min(alike, key=lambda one: (np.sum(~one[0].fit.free), one[0].fit.z.size, -one[1]))[0]
        return model
