"""Which effects of a final model the tests bear out: the others are hypotheses, no part of the law."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from edesign.calibrate.cross_validation import FEWEST
from edesign.calibrate.evidence import Judged, compare, simplest
from edesign.calibrate.problem import Candidate, PredictionError
from edesign.calibrate.search.contest import shortlist
from edesign.calibrate.search.effect_forms import EffectForms
from edesign.calibrate.search.selection import Adopted, Hypothesis
from edesign.calibrate.search.workbench import RIVALS, Workbench
from edesign.calibrate.uncertainty import Uncertainty, wide

_BETWEEN_TESTS = f"it acts between tests, which is tested by tests left out from {FEWEST} tests to fit on"
_NOTHING = 0.01  # of what an effect changes: what steps of the prediction leave where it does nothing


class Tenable:
    """What may stay in a model.

    Args:
        bench: what all parts of the search share.
        forms: of effects.
    """

    def __init__(self, bench: Workbench, forms: EffectForms) -> None:
        self.bench = bench
        self.forms = forms

    def part(self, final: Judged, rival: Judged) -> tuple[Judged, tuple[Hypothesis, ...]]:
        """The model with the effects that the tests bear out, in forms that they do, and the other effects.

        Args:
            final: with which a search ended.
            rival: the model without effects.
        """
        final = self.nested(final)
        dropped: list[Hypothesis] = []
        while final.fitted.model.effects:
            effect, why = self._weakest(final)
            if effect is None:
                break
            self.bench.tell(f"{effect.name} is a hypothesis: {why}")
            without = rival
            if len(final.fitted.model.effects) > 1:
                without = self.bench.freed(self.bench.without(final, effect))
            values = next(values for candidate, values in final.fitted.parts if candidate is effect)
            adopted = Adopted(effect, values, compare(final, without), without, {})
            dropped.append(Hypothesis(adopted, final, why))
            final = without
        return final, tuple(dropped)

    def between_tests(self, final: Judged) -> list[Hypothesis]:
        """The effect between tests that explains what is left best, where the tests are too few to bear it out."""
        pool = [] if final.at_floor else self.bench.beyond_few(final)
        if not pool:
            return []
        tried = self.bench.fit_best(shortlist(self.bench.screened(final.fitted, pool))[:RIVALS])
        better = [judged for judged in tried if compare(judged, final).adopts]
        if not better:
            return []
        best = simplest(better)
        effect, values = best.fitted.parts[-1]
        return [Hypothesis(Adopted(effect, values, compare(best, final), final, {}), best, _BETWEEN_TESTS)]

    def nested(self, final: Judged) -> Judged:
        """Each effect of which the tests leave a parameter at a bound, or do not tell it, in the nested form without
        that parameter, unless that is clearly worse.
        """
        been: set[frozenset[str]] = set()
        while final.labels not in been:
            been.add(final.labels)
            for i, effect in enumerate(final.fitted.model.effects):
                if _untold(final, effect):
                    found = simplest([final, *self.forms.with_plainer(final, i)])
                    if found is not final:
                        final = found
                        break
        return final

    def _weakest(self, final: Judged) -> tuple[Candidate | None, str]:
        """The effect that the tests bear out least, and why it is a hypothesis; None: they bear out all."""
        effects = final.fitted.model.effects
        if self.bench.few:
            for effect, values in final.fitted.parts:
                if effect.between_tests:  # as a finer form of one that does not
                    return effect, _BETWEEN_TESTS
                if effect.unknowns and abs(values[0] - effect.unknowns[0].value(0.0)) > effect.usual:
                    return effect, (
                        f"more than {100.0 * effect.usual:g} % is no usual error of an instrument, and asks for "
                        f"{FEWEST} tests to fit"
                    )
        shares = [size_uncertainty(final, effect) for effect in effects]
        if not shares or max(shares) < 1.0:
            return None, ""
        effect = effects[int(np.argmax(shares))]
        return effect, "its 95 % interval reaches to nothing"


def size_uncertainty(judged: Judged, effect: Candidate) -> float:
    """Half the width of the 95 % interval of an effect's size over that size: from 1 on it may be nothing.

    The size is the parameter at whose zero the effect does nothing; of several that are zero together, the sum that the
    tests tell best. An effect that has none but logarithms, as the stiffness of a flexible rig, does nothing where one
    of them is infinitely far: its size is then the parameter that the tests tell best. 0: it has no size that is a
    parameter, as a share that is each test's own.
    """
    fitted = judged.fitted
    first = _first(judged, effect)
    own = range(first, first + len(effect.unknowns))
    sized = [j for j, u in zip(own, effect.unknowns, strict=True) if u.span[0] <= 0.0 <= u.span[1]]
    for j in sized:
        if _does_nothing(judged, effect, [j]):
            weights = np.zeros(fitted.x.size)
            weights[j] = 1.0
            return _share(Uncertainty.of(fitted, j).half_width(weights), abs(float(fitted.x[j])))
    linear = [j for j, u in zip(own, effect.unknowns, strict=True) if j in sized and not u.logarithmic]
    if len(linear) > 1 and _does_nothing(judged, effect, linear):
        sure = Uncertainty.of(fitted)
        size = fitted.x[linear]
        along = np.linalg.pinv(sure.within[np.ix_(linear, linear)]) @ size
        weights = np.zeros(fitted.x.size)
        weights[linear] = along
        return _share(sure.half_width(weights, len(linear)), abs(float(along @ size)))
    if effect.unknowns and all(u.logarithmic for u in effect.unknowns) and not _own_shares(judged, effect):
        sure = Uncertainty.of(fitted)
        return min(sure.half_width(row) if not sure.bounds[j] else math.inf for j, row in _rows(own, fitted.x.size))
    return 0.0


def _untold(judged: Judged, effect: Candidate) -> bool:
    """Whether a parameter of an effect is at a bound, or its interval holds zero or spans more than a decade."""
    fitted, first = judged.fitted, _first(judged, effect)
    sure = Uncertainty.of(fitted)
    for (j, row), unknown in zip(
        _rows(range(first, first + len(effect.unknowns)), fitted.x.size), effect.unknowns, strict=True
    ):
        half = sure.half_width(row)
        if sure.bounds[j] or wide(half, unknown.logarithmic):
            return True
        if not unknown.logarithmic and half >= abs(float(fitted.x[j])):
            return True
    return False


def _does_nothing(judged: Judged, effect: Candidate, zero: list[int]) -> bool:
    """Whether an effect does nothing where some of its coordinates are zero."""
    fitted = judged.fitted
    x = fitted.x.copy()
    x[zero] = 0.0
    others = replace(fitted.model, effects=tuple(e for e in fitted.model.effects if e is not effect))
    try:
        there = np.concatenate(fitted.model.residuals(x))
        without = np.concatenate(others.residuals(others.coordinates(fitted.base, fitted.parts)))
    except PredictionError:
        return False
    here = np.concatenate(fitted.residuals)
    return float(np.linalg.norm(there - without)) <= _NOTHING * float(np.linalg.norm(here - without))


def _own_shares(judged: Judged, effect: Candidate) -> bool:
    problem, base = judged.fitted.model.problem, judged.fitted.base
    parts = [part for part in judged.fitted.parts if part[0] is effect]
    return any(problem.nuisance(base, parts, i) is not None for i, use in enumerate(problem.uses) if use == "fit")


def _share(half_width: float, size: float) -> float:
    return half_width / size if size > 0.0 else math.inf


def _first(judged: Judged, effect: Candidate) -> int:
    """Number of the first coordinate of an effect."""
    model = judged.fitted.model
    before = model.effects[: model.effects.index(effect)]
    return len(model.base) + sum(len(other.unknowns) for other in before)


def _rows(own: range, size: int) -> list[tuple[int, np.ndarray]]:
    """Coordinates with the weights (p,) that pick them."""
    return [(j, np.eye(size)[j]) for j in own]
