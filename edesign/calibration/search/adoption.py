"""Where an effect is adopted: every gate. docs/theory/calibration.md explains the steps.

    rule of adoption   `sure`: tests that are left out are predicted significantly better
    search, step 5     `Adoption.pruned`: an effect explains more than instruments see, is needed beside the others, is
                       of some size (`insignificant`), and is no error of the equations of others
    search, step 6     `Adoption.best_of`: of the candidates that are sure and identified, each with the best form and
                       pruned, the one that gains most; no set of effects twice
    search, step 7     `Adoption.instead`: whatever is surely better in the place of the best model
    after the search   `kept.py` of `results`: intervals of sizes, and what the validation tests say, which have chosen
                       nothing so far

The numbers are those of `settings.py` beside this file and of `edesign/estimation/left_out.py`. Words for people are
made in `results`.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

from edesign.calibration.search.models import FittedModel, Fitter, Key
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.variants import Variants
from edesign.estimation.left_out import LEAST, Difference
from edesign.estimation.noise import Noise
from edesign.estimation.uncertainty import at_bounds, uncertainty

_NEAR = ("instrument", "rig", "damper", "structure")
"""Kinds of effects: of those that predict alike a fault of an instrument comes before new physics."""


def plainness(model: FittedModel) -> tuple[int, int, int]:
    """Return by what models that predict alike are put in order: changes, their parameters, and what they belong to."""
    parameters = sum(max(len(effect.parameters), 1) for effect in model.effects)
    return len(model.changes), parameters, sum(_NEAR.index(effect.kind) for effect in model.effects)


@dataclass(frozen=True)
class Tried:
    """A model that was compared with the best one so far.

    Attributes:
        model: fitted to the end.
        difference: by how much it predicts better.
    """

    model: FittedModel
    difference: Difference


Gate = Literal["no_size", "small", "motion_noise", "not_needed", "alike", "law", "given_up", "leaves_more"]
"""Gates by name: a size that may be nothing or stands at a bound; less than instruments see; less than noise of the
motion makes; not needed beside the others; no better than another effect, or an error of equations; the change of the
base is not needed; a set of effects that was given up for another one; better only as far as equations may be wrong."""


@dataclass(frozen=True)
class Refusal:
    """Why a model is none to adopt.

    Attributes:
        gate: that it does not pass.
        effect: of which; None: all of them.
    """

    gate: Gate
    effect: Effect | None = None


class Adoption:
    """The gates of a search.

    Attributes:
        refused: why models are none to adopt, by their key.
    """

    def __init__(self, fitter: Fitter, variants: Variants) -> None:
        self._fitter, self._variants = fitter, variants
        self._taken = set[frozenset[str]]()
        self.refused = dict[Key, Refusal]()

    def take(self, model: FittedModel) -> FittedModel:
        """Note that a model is the best one now; no set of effects is that twice, so that the search comes to its end.

        Args:
            model: that was adopted.
        """
        self._taken.add(model.changes)
        return model

    def pruned(self, model: FittedModel, known: FittedModel) -> FittedModel | None:
        """Return the model without effects that it does not need, or that are of no size, or less than instruments see.

        Noise of the motion makes force through the law. An effect that swallows it, as a clearance as large as the
        noise, is better and is none.

        Each effect is needed beside the others, whatever equations these have, and although these may be wrong. The
        change of the base is needed likewise. What errors of the others excuse is needed if the others fall without it.

        Returns:
            The effects that are not known are in the order of what they explain; None: there are none.
        """
        fitter, explained = self._fitter, list[float]()
        whole: tuple[FittedModel, list[float]] | None = None
        while model.effects:
            simpler = [one for i in self._idle(model) if (one := self._variants.omitting(model, i)) is not None]
            if simpler:
                whole = None
            else:
                simpler, explained = self._needless(model, known)
            if not simpler and model.refits and (one := self._variants.as_declared(model)) is not None:
                if not fitter.compare(model, one).sure:
                    self.refused.setdefault(model.key, Refusal("law"))
                    simpler.append(one)
            if not simpler:
                break
            # of two effects that do the same, the one stays that is something
            noise = fitter.noise(model.noise, known)
            rest = min(simpler, key=lambda one: (len(self._idle(one)), -fitter.score(one, noise).total))
            excused = model.key in self.refused and self.refused[model.key].gate == "not_needed"
            if excused and not rest.changes <= known.changes and fitter.compare(model, known).sure:
                whole = whole or (model, explained)
            model = rest
        # less than is known already is no step: the next depth would take it back
        if not model.effects or model.changes <= known.changes:
            if whole is None:
                return None
            model, explained = whole
            del self.refused[model.key]
        new = [i for i, effect in enumerate(model.effects) if effect.name not in known.names]
        old = [i for i in range(len(model.effects)) if i not in new]
        return fitter.in_order(model, [*old, *sorted(new, key=lambda i: -explained[i])])

    def _needless(self, model: FittedModel, known: FittedModel) -> tuple[list[FittedModel], list[float]]:
        """Return a model without each of the effects that do not pass a gate, and what each effect explains.

        What an effect explains is a share of the power of what was measured, beside the best equations of the others.
        """
        fitter, simpler, explained = self._fitter, list[FittedModel](), list[float]()
        for index, effect in enumerate(model.effects):
            others, _ = model.without(index)
            alike = others == known.effects and model.fit.held == known.fit.held
            one = known if alike else self._variants.omitting(model, index)
            if one is None:
                explained.append(math.inf)
                continue
            noise = fitter.noise(model.noise, one)
            if fitter.difference(model, one, noise, one).sure and one is not known:
                better = self._variants.with_better_forms(one, noise, fitter.settings.forms)
                one = better if fitter.behind(better, model) else fitter.reweighted(better)
                noise = fitter.noise(model.noise, one)
            explained.append(one.nrms - model.nrms)
            gate = self._gate(model, index, one, explained[-1], noise)
            if gate is not None:
                self.refused.setdefault(model.key, Refusal(gate, effect))
                simpler.append(one)
        return simpler, explained

    def _idle(self, model: FittedModel) -> list[int]:
        """Return the indices of effects that may be of no size."""
        found = [i for i in range(len(model.effects)) if self.insignificant(model, i)]
        if found:
            self.refused.setdefault(model.key, Refusal("no_size", model.effects[found[0]]))
        return found

    def _gate(self, model: FittedModel, index: int, rest: FittedModel, explained: float, noise: Noise) -> Gate | None:
        """Return the gate that an effect does not pass; None: it passes all.

        Args:
            rest: model without it.
            explained: share of the power of what was measured that it explains beside the others.
            noise: by which the two are compared.
        """
        fitter = self._fitter
        if explained <= fitter.settings.least**2:
            return "small"
        if explained <= fitter.problem.input_noise:
            return "motion_noise"
        if not fitter.difference(model, rest, noise, rest).sure:
            return "not_needed"
        if not self._may_be_error(model, explained, self._errors(model, index)):
            return None
        rough = self._variants.in_place(model.effects[index], rest, model)
        # what is as good by a few steps is as good at the end, which is not asked for then
        beats = self._beats(model, rough, noise, rest, roughly=True)
        return None if beats and self._beats(model, map(fitter.reweighted, rough), noise, rest) else "alike"

    def insignificant(self, model: FittedModel, index: int) -> bool:
        """Return whether the size of an effect may be nothing (95 %), or is at a bound, where it is another effect.

        A share of a whole may be all of it. A fault in one test is nothing if the test agrees with the others as well
        as these with each other.
        """
        size = model.places(index)[:1]
        bound = at_bounds(model.fit)[size[0]] if size else ""
        whole = bound == "upper" and model.effects[index].parameters[0].whole
        if not whole and (bound or about_zero(model, index) is not None):
            return True
        tests = model.effects[index].tests
        rest = self._variants.omitting(model, index) if len(tests) == 1 else None
        found = None if rest is None else self._fitter.outlier(rest, model, index)
        return rest is not None and not (found is not None and found.sure)

    def _beats(
        self, model: FittedModel, others: Iterable[FittedModel], noise: Noise, known: FittedModel, roughly: bool = False
    ) -> bool:
        """Return whether a model is surely better than each of those that have something else beside a known one."""
        return all(self._fitter.difference(model, one, noise, known, roughly=roughly).sure for one in others)

    def _may_be_error(self, model: FittedModel, explained: float, errors: float) -> bool:
        """Return whether what an effect explains is one of several, or an error of the equations of others.

        It is less than these may be wrong by. And as much is left as another equation of one effect leaves of it: what
        is no error of them is explained better than that by its own equation alone.

        Args:
            explained: share of the power of what was measured that the effect explains beside the others.
            errors: by which the equations of the others may be wrong, likewise.
        """
        return explained <= errors and model.nrms > self._fitter.settings.median_discrepancy**2 * explained

    def _errors(self, model: FittedModel, without: int = -1) -> float:
        """Return the share of the power of what was measured by which equations of effects, but one, may be wrong."""
        sizes = [model.size(i) for i, one in enumerate(model.effects) if i != without and not one.exact]
        return self._fitter.settings.own_discrepancy**2 * sum(size**2 for size in sizes)

    def best_of(self, tried: Sequence[Tried], known: FittedModel) -> FittedModel | None:
        """Return the best of models that pass the rule, by what is needed of it; None: none passes.

        Parts of a model may be less than the next one.

        Args:
            tried: models, the best first.
            known: the model beside which they were found.
        """
        fitter, passed = self._fitter, list[tuple[float, FittedModel]]()
        for one in tried:
            most = max((total for total, _ in passed), default=-math.inf)
            if not one.difference.sure or one.difference.total <= most - LEAST:
                continue
            noise = fitter.noise(one.model.noise, known)
            changes, explained = one.model.changes, known.nrms - one.model.nrms
            every = [each.model for each in tried]
            others = [each for each in every if not (each.changes <= changes or each.changes >= changes)]
            error = self._may_be_error(one.model, explained, self._errors(known))
            if error and not self._beats(one.model, others, noise, known):
                self.refused[one.model.key] = Refusal("alike")
                continue
            better = self._variants.with_best_forms(one.model, noise)
            needed = self.pruned(better, known)
            if needed is not None and needed.changes not in self._taken:
                passed.append((fitter.compare(needed, known).total, needed))
            if needed is None or needed.key != one.model.key:
                self.refused.setdefault(one.model.key, self.refused.get(better.key, Refusal("given_up")))
        most = max((total for total, _ in passed), default=-math.inf)
        return min((one for total, one in passed if total > most - LEAST), key=plainness, default=None)

    def instead(self, tried: Tried, best: FittedModel) -> FittedModel | None:
        """Return what takes the place of the best model: one that is surely better, by what is needed of it.

        A plainer one that is as good takes it too. What equations may be wrong by, of an effect that does much, must
        not hide that less is explained.

        Args:
            tried: a model, compared with the best one.

        Returns:
            None: the model is neither surely better nor plainer and as good, or passes not all gates.
        """
        one, fitter = tried.model, self._fitter

        def ahead(model: FittedModel, difference: Difference) -> bool:
            return difference.sure or (plainness(model) < plainness(best) and difference.total > -LEAST)

        if not ahead(one, tried.difference) or one.key in self.refused:
            return None
        if one.changes in self._taken:
            self.refused[one.key] = Refusal("given_up")
        elif not self._predicts_as_well(one, best):
            self.refused[one.key] = Refusal("leaves_more")
        else:
            base = self._variants.without_effects(one)
            better = self._variants.with_best_forms(one, fitter.noise(one.noise, base))
            needed = self.pruned(better, base)
            if needed is not None and needed.changes not in self._taken and ahead(needed, fitter.compare(needed, best)):
                return needed
            self.refused.setdefault(one.key, self.refused.get(better.key, Refusal("given_up")))
        return None

    def _predicts_as_well(self, one: FittedModel, other: FittedModel) -> bool:
        """Return whether a model predicts as well as another one beside what this one leaves alone."""
        scores = self._fitter.score(one, other.noise), self._fitter.score(other, other.noise)
        return scores[0].total > scores[1].total - LEAST


def about_zero(model: FittedModel, index: int) -> tuple[float, float] | None:
    """Return the 95 % interval, SI, of an effect's size if it holds zero; None: it does not, or there is no size."""
    if not model.effects[index].parameters:
        return None
    size = model.places(index)
    low, high = uncertainty(model.fit, model.noise, size_of=size).interval(size[0])
    return (low, high) if low <= 0.0 <= high else None
