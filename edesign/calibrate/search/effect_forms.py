"""Which form of an effect suits: other forms beside each other, finer ones where more than noise is left."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from edesign.calibrate.evidence import Judged, simplest
from edesign.calibrate.fit import fit
from edesign.calibrate.outcome import errors_of, predict
from edesign.calibrate.problem import Candidate, Part, PredictionError
from edesign.calibrate.search.begun import begun_at, begun_from, others_than
from edesign.calibrate.search.contest import BEHIND, likely_forms
from edesign.calibrate.search.screening import promised
from edesign.calibrate.search.workbench import FAR_BEHIND, FEW, Key, Workbench, key_of, labels_of, of_left_out

LIKELY = 2
"""Effects of which forms are compared, or models with which the law is fitted again."""
_FORMS, _FORMS_HELD, _FORMS_SLOW = 5, 10, 3
"""Forms of an effect that are compared once it is a likely one: usually, with the law held, and beside slow or several
effects.
"""
_PROMISING, _AS_MUCH = 0.1, 0.5
"""Of what is left over noise, and of what the best one removes: a finer form that is fitted, by a linear estimate."""


class EffectForms:
    """The search among the forms of effects.

    Args:
        bench: what all parts of the search share.
    """

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.compared: set[tuple[str, Key]] = set()  # effects whose forms were, beside which model
        self.finest: Judged | None = None  # the last model in which a finer form was sought

    def placed(self, final: Judged) -> Judged:
        """Each effect in the form that does least wrong to tests that are not fitted to, of those that do the same to
        the fitted ones, as a gain does that changed in between: what it does to a test is then that test's own.
        """
        problem = self.bench.problem
        for i, part in enumerate(final.fitted.parts):
            models = [final]
            for other in problem.elsewhere(part):
                effects = (*final.fitted.model.effects[:i], other, *final.fitted.model.effects[i + 1 :])
                model = replace(final.fitted.model, effects=effects)
                models.append(Judged(fit(model, final.fitted.x, most_steps=0)))
            if len(models) > 1:
                final = min(
                    models, key=lambda one: errors_of(self.bench.problem, predict(self.bench.problem, one)).validate
                )
        return final

    def other_forms_of_likely(self, tried: Sequence[Judged]) -> list[Judged]:
        """Models with further forms of the effects that the best models have last: best on tests left out, or on those
        fitted to, as a wrong form of the right effect may extrapolate badly.
        """
        likely: dict[str, Judged] = {}
        for order in (of_left_out, lambda j: j.fitted.chi2):
            best: dict[str, Judged] = {}
            for judged in sorted(tried, key=order):
                best.setdefault(judged.fitted.model.effects[-1].name, judged)
            for name in [*best][:LIKELY]:
                likely.setdefault(name, best[name])
        found: list[Judged] = []
        least = min((judged.fitted.chi2 for judged in tried), default=0.0)
        for judged in likely.values():
            if judged.fitted.chi2 <= BEHIND * least and not judged.all_noise:
                found += self.other_forms(judged, judged.fitted.model.effects[-1])
        return found

    def reformed(self, current: Judged) -> Judged:
        """Each effect in the form that suits best, now that the others are there."""
        effects = current.fitted.model.effects
        for effect in effects if 1 < len(effects) <= FEW else ():  # forms of a single one have just been compared
            if current.all_noise:
                break
            current = simplest([current, *self.other_forms(current, effect)])
        return current

    def plainer(self, current: Judged) -> Judged:
        """Each effect as a simpler one, where that does the same: play without a clearance is a flexible rig."""
        for i in range(len(current.fitted.parts)):
            current = simplest([current, *self.with_plainer(current, i)])
        return current

    def with_plainer(self, current: Judged, i: int) -> list[Judged]:
        """Models with simpler ones in the place of the effect i."""
        known = current.fitted.parts[i]
        parts = [part for part in self.bench.problem.simpler(known) if part[0].label not in current.labels]
        return self.bench.with_parts(current, i, parts)

    def finer(self, current: Judged) -> Judged:
        """Each effect in a finer form, where more than noise is left and that form is better: with nothing in doubt, as
        what is in doubt may have made up for the coarser one.
        """
        best = first = self.bench.certain(current)
        if first is not current and not best.all_noise and best.last_is_new:
            best = self._in_other_forms(best)
        for i in range(len(current.fitted.model.effects)):
            best = self.as_fine_as_needed(best, i)
        for other in self._near_forms(current) if current.last_is_new else ():
            if not best.all_noise:  # a coarser form behind this one may have finer ones before it
                near = other if current.fitted.model.held else self.bench.freed(other)
                best = simplest([best, self.as_fine_as_needed(self.bench.certain(near), -1)])
        if best is first:
            return current
        return self.bench.in_doubt(best)

    def as_fine_as_needed(self, best: Judged, i: int) -> Judged:
        """With the effect i in finer forms as long as they are better and more than noise is left; not twice in one
        form, as a coarser one that does as well may have it before it again.
        """
        been: set[str] = set()
        while not best.all_noise and (label := best.fitted.model.effects[i].label) not in been:
            been.add(label)
            best = self.finest = self._in_finer_form(best, i)
        return best

    def _near_forms(self, current: Judged) -> list[Judged]:
        """The other form of the last effect that was nearly as good."""
        *known, last = current.fitted.model.effects
        forms = [
            judged
            for held in (False, True)
            for judged in self.bench.rivals.get((labels_of(known), held), [])
            if judged.fitted.model.effects[-1].name == last.name
            and judged.fitted.model.effects[-1].label != last.label
            and judged.fitted.chi2 <= BEHIND * current.fitted.chi2
        ]
        return sorted(forms, key=lambda judged: judged.fitted.chi2)[:1]

    def _in_other_forms(self, current: Judged) -> Judged:
        """The last effect in the form that suits best with nothing in doubt; what was compared in doubt is no
        answer.
        """
        known, compared = self.bench.known, self.compared
        self.bench.known, self.compared = {}, set()
        found = simplest([current, *self.other_forms(current, current.fitted.model.effects[-1])])
        self.bench.known, self.compared = known, compared
        return found

    def _in_finer_form(self, current: Judged, i: int) -> Judged:
        parts = current.fitted.parts
        i %= len(parts)
        self.bench.tell(f"finer forms of {parts[i][0].name}")
        finer = _promising(current, i, self.bench.problem.finer(parts[i]))
        if not finer:
            return current
        best = simplest([current, *self.bench.with_parts(current, i, finer)])
        if best is current:
            return current
        # where the finer form has led, a coarser one may do as well
        known = best.fitted.parts[i]
        coarser = [part for effect, _ in (parts[i], *finer) if (part := begun_at(effect, known)) is not None]
        return simplest([best, *self.bench.with_parts(best, i, coarser)])

    def other_forms(self, current: Judged, effect: Candidate, most: float = math.inf) -> list[Judged]:
        """Models with another form of an effect; which are likely is seen beside the law as the model has it.

        Those that leave more than `most` or far more than the model (chi2) after a rough fit are not fitted on.
        """
        fitted = current.fitted
        smaller = replace(fitted.model, effects=others_than(fitted.model.effects, effect))
        if effect.label not in current.labels or (effect.name, key_of(smaller)) in self.compared:
            return []
        self.compared.add((effect.name, key_of(smaller)))
        self.bench.tell(f"comparing forms of {effect.name}")
        kept = [part for part in fitted.parts if part[0].label != effect.label]
        without = fit(smaller, smaller.coordinates(fitted.base, kept), most_steps=0)
        here = labels_of(fitted.model.effects)
        pool = [c for c in self.bench.candidates(current) if c.name == effect.name and c.label not in here]
        slow = len(smaller.effects) > 1 or any(other.slow for other in smaller.effects)
        number = _FORMS_SLOW if slow else _FORMS_HELD if fitted.model.held else _FORMS
        signatures = self.bench.screened(without, pool)
        wider = [found for s in signatures if (found := begun_from(fitted, effect, s))][:number]
        return self.bench.fit_best([*likely_forms(signatures, number), *wider], min(most, FAR_BEHIND * fitted.chi2))


def _promising(current: Judged, i: int, parts: Sequence[Part]) -> list[Part]:
    """Finer forms of the effect i that by a linear estimate remove a good share of what is left, as much as others."""
    excess = current.fitted.chi2 - current.fitted.samples
    gains = []
    for part in parts:
        try:
            gains.append(promised(current.fitted, i, part))
        except PredictionError:
            gains.append(-math.inf)
    least = max(_PROMISING * excess, _AS_MUCH * max(gains, default=0.0))
    return [part for part, gain in zip(parts, gains, strict=True) if gain >= least]
