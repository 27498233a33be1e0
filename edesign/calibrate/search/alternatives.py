"""What could stand in the place of an effect."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.calibrate.evidence import Judged, simplest
from edesign.calibrate.problem import Candidate, Part
from edesign.calibrate.search.begun import may_join, others_than
from edesign.calibrate.search.contest import shortlist
from edesign.calibrate.search.effect_forms import EffectForms
from edesign.calibrate.search.workbench import FAR_BEHIND, FEW, NONE, RIVALS, Workbench, labels_of, of_left_out


class Alternatives:
    """Each effect of a model against others in its place.

    Args:
        bench: what all parts of the search share.
        forms: of effects.
    """

    def __init__(self, bench: Workbench, forms: EffectForms) -> None:
        self.bench = bench
        self.forms = forms

    def against_others(self, current: Judged) -> Judged:
        """A single effect against others beside the law fitted again, where none were: it was found beside others."""
        effects, held = current.fitted.model.effects, current.fitted.model.held
        if held or len(effects) > 1 or (NONE, False) in self.bench.rivals:
            return current
        others = self.others(current, effects[0])
        self.bench.rivals[NONE, False] = [*others, current]
        return simplest([current, *others])

    def reconsider(self, current: Judged) -> Judged:
        """Each effect against what could stand in its place, now that the others are there."""
        effects = current.fitted.model.effects
        if len(effects) > FEW:
            return current
        for effect in effects[:-1]:
            self.bench.tell(f"reconsidering {effect.name}")
            found = simplest([current, *self.others(current, effect)])
            if found is not current and not found.at_floor:
                found = self._unless_finer(found, current, effect)
            current = found
        return current

    def _unless_finer(self, found: Judged, current: Judged, effect: Candidate) -> Judged:
        """Another effect in the place of one, unless that does better in a finer form than the other one in its own."""
        labels = [one.label for one in current.fitted.model.effects]
        finer = self.forms.as_fine_as_needed(current, labels.index(effect.label))
        if simplest([found, finer]) is found:
            return found
        return simplest([finer, self.forms.as_fine_as_needed(found, -1)])

    def settled(self, current: Judged) -> Judged:
        """The same in the end, where the last effects may have come in the place of others that were not begun beside
        them: each, the last one too, against what could stand in its place, until none does better.
        """
        been: set[frozenset[str]] = set()
        while 1 < len(current.fitted.model.effects) <= FEW and current.labels not in been:
            been.add(current.labels)
            for effect in current.fitted.model.effects:
                if effect.label in current.labels:
                    current = simplest([current, *self.others(current, effect)])
        return current

    def others(self, current: Judged, effect: Candidate) -> list[Judged]:
        """Models in which another effect, or another form, stands in the place of one."""
        others = others_than(current.fitted.model.effects, effect)
        held = current.fitted.model.held
        fitted = self.bench.rivals.get((labels_of(others), held), self.bench.rivals.get((labels_of(others), False)))
        if fitted is not None:
            return fitted
        if any(other.name == effect.name for other in others):
            return []  # what stands beside another form of the same effect is no rival of it
        without = self.bench.without(current, effect)
        known = [part for part in self._stood_beside(others) if part[0].label != effect.label] if others else []
        if known:
            found = self.bench.fit_all(without, known)
        else:
            pool = [c for c in self.bench.candidates(without) if may_join(c, others) and c.label != effect.label]
            roughly = any(e.slow for e in others)
            likely = shortlist(self.bench.screened(without.fitted, pool, roughly))[:RIVALS]
            found = self.bench.fit_best(likely, FAR_BEHIND * current.fitted.chi2)
        self.bench.rivals[labels_of(others), held] = found
        return found

    def _stood_beside(self, others: Sequence[Candidate]) -> list[Part]:
        """The best form of each effect, the best first, that was fitted beside other forms of these effects."""
        names = sorted(other.name for other in others)
        tried = [
            judged
            for judged in (model for models in self.bench.rivals.values() for model in models)
            if sorted(effect.name for effect in judged.fitted.model.effects[:-1]) == names
        ]
        best: dict[str, Part] = {}
        for judged in sorted(tried, key=of_left_out):
            part = judged.fitted.parts[-1]
            if may_join(part[0], others):
                best.setdefault(part[0].name, part)
        return [*best.values()][:RIVALS]
