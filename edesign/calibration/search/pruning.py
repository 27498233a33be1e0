"""Which effects of a model are kept: those that it needs, that are more than nothing, and that are identified."""

from __future__ import annotations

import math
from collections.abc import Sequence

from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.variants import Variants
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import at_bounds, uncertainty


class Pruning:
    """Takes effects off models.

    Args:
        fitter: of the search.
        variants: of models.
    """

    def __init__(self, fitter: Fitter, variants: Variants) -> None:
        self._fitter, self._variants = fitter, variants

    def pruned(self, model: FittedModel, known: FittedModel) -> FittedModel | None:
        """Return the model without effects that it does not need, or that are of no size, or less than instruments see.

        Noise of the motion makes force through the law. An effect that swallows it, as a clearance as large as the
        noise, is better and is none.

        Each effect is needed beside the others, whatever equations these have, and although these may be wrong.

        Args:
            model: fitted.
            known: a model whose effects are known.

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
                if self._fitter.difference(model, one, noise, one).sure and one is not known:
                    one = fitter.reweighted(self._variants.with_best_forms(one, noise, True))
                    noise = fitter.noise(model, one)
                explained.append(one.nrms - model.nrms)
                if (
                    explained[-1] <= max(fitter.settings.least**2, fitter.problem.input_noise)
                    or not fitter.difference(model, one, noise, one).sure
                    or self.insignificant(model, index)
                    or not self._identified_in(model, index, one, noise)
                ):
                    simpler.append(one)
            if not simpler:
                break
            # of two effects that do the same, the one stays that is something
            noise = fitter.noise(model, known)
            model = min(simpler, key=lambda one: (self.insignificant_effects(one), -fitter.score(one, noise).total))
        # less than is known already is no step: the next depth would take it back
        if model.names <= known.names:
            return None
        new = [i for i, effect in enumerate(model.effects) if effect.name not in known.names]
        old = [i for i in range(len(model.effects)) if i not in new]
        return fitter.in_order(model, [*old, *sorted(new, key=lambda i: -explained[i])])

    def identified_among(
        self, models: Sequence[FittedModel], model: FittedModel, known: FittedModel, noise: Noise
    ) -> bool:
        """Return whether what a model adds is no error of the equations of known effects.

        It explains more than these may be wrong by, or no model with other effects predicts as well.

        Args:
            models: that were fitted beside the known one.
            model: one of them.
            known: the model with the effects that are known.
            noise: by which they are compared.
        """
        if known.nrms - model.nrms > self._errors(known, range(len(known.effects))):
            return True
        others = [one for one in models if not (one.names <= model.names or one.names >= model.names)]
        return all(self._fitter.difference(model, one, noise, known).sure for one in others)

    def _identified_in(self, model: FittedModel, index: int, rest: FittedModel, noise: Noise) -> bool:
        """Return whether an effect is no error of the equations of the others.

        It explains more than these may be wrong by, or no other effect predicts as well in its place.
        """
        if rest.nrms - model.nrms > self._errors(model, [i for i in range(len(model.effects)) if i != index]):
            return True
        others = self._variants.in_place(model.effects[index], rest)
        return all(self._fitter.difference(model, one, noise, rest).sure for one in others)

    def _errors(self, model: FittedModel, effects: Sequence[int]) -> float:
        """Return the share of the power of what was measured by which equations of effects may be wrong."""
        return self._fitter.settings.own_discrepancy**2 * sum(model.size(i) ** 2 for i in effects)

    def insignificant(self, model: FittedModel, index: int) -> bool:
        """Return whether the size of an effect may be nothing (95 %), or is at a bound, where it is another effect.

        A share of a whole may be all of it.

        Args:
            model: fitted.
            index: of the effect.
        """
        size = model.places(index)[:1]
        if not size:
            return False
        bound = at_bounds(model.fit)[size[0]]
        if bound:
            return not (bound == "upper" and model.effects[index].parameters[0].whole)
        low, high = uncertainty(model.fit, model.noise).interval(size[0])
        return low <= 0.0 <= high

    def insignificant_effects(self, model: FittedModel) -> int:
        """Return how many effects of a model are insignificant.

        Args:
            model: fitted.
        """
        return sum(self.insignificant(model, i) for i in range(len(model.effects)))
