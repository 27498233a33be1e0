"""A second look at what was passed by: models that came near, and effects that were not the best alone."""

from __future__ import annotations

from edesign.calibrate.evidence import Judged, simplest
from edesign.calibrate.search.contest import BEHIND
from edesign.calibrate.search.effect_forms import EffectForms
from edesign.calibrate.search.rounds import Rounds
from edesign.calibrate.search.workbench import FEW, NONE, Workbench

_SECOND = 3  # models in which other effects are tried again in finer forms
_WELL_ABOVE = 2.0  # times noise: a model that leaves less is not held against others begun elsewhere
_BEGINNINGS = 2  # effects to which others are added, of those that were not the best alone


class SecondLook:
    """What is looked at again before the search ends.

    Args:
        bench: what all parts of the search share.
        forms: the search among forms.
        rounds: adds effects.
    """

    def __init__(self, bench: Workbench, forms: EffectForms, rounds: Rounds) -> None:
        self.bench = bench
        self.forms = forms
        self.rounds = rounds
        self.begun: set[str] = set()  # effects to which others were added
        self.beginnings = _BEGINNINGS

    def look(self, current: Judged) -> Judged | None:
        """A model that came near it, with other effects or one more, and is better in finer forms or with the law
        fitted again; None: there is none.
        """
        labels = current.labels
        if current.fitted.reduced <= _WELL_ABOVE:
            return None
        beside = [NONE, *(labels - {label} for label in sorted(labels))]
        best: dict[tuple[str, ...], Judged] = {}
        for others in beside if len(labels) >= FEW else [*beside, labels]:
            for judged in [*self.bench.rivals.get((others, False), ()), *self.bench.rivals.get((others, True), ())]:
                names = judged.names
                if names != current.names:
                    best[names] = min(best.get(names, judged), judged, key=lambda one: one.fitted.chi2)
        near = sorted(best.values(), key=lambda judged: judged.fitted.chi2)[:_SECOND]
        found = []
        for judged in near:
            if judged.fitted.chi2 <= BEHIND * current.fitted.chi2:
                begun = self.bench.certain(self.bench.freed_if_half(judged))
                found.append(self.bench.in_doubt(self.forms.as_fine_as_needed(begun, -1)))
        best_of_all = simplest([current, *found])
        return self._begun_with_another(current) if best_of_all is current else best_of_all

    def _begun_with_another(self, current: Judged) -> Judged | None:
        """A model that is better, of two effects of which the first did much alone but was not the best then; None:
        there is none.
        """
        alone: dict[str, Judged] = {}
        for judged in [*self.bench.rivals.get((NONE, False), ()), *self.bench.rivals.get((NONE, True), ())]:
            name = judged.fitted.model.effects[0].name
            alone[name] = min(alone.get(name, judged), judged, key=lambda one: one.fitted.chi2)
        self.begun.update(current.names)
        others = [judged for name, judged in alone.items() if name not in self.begun]
        for judged in sorted(others, key=lambda one: one.fitted.chi2)[: self.beginnings]:
            first = judged.fitted.model.effects[0].name
            self.begun.add(first)
            self.beginnings -= 1
            self.bench.tell(f"two effects, {first} one of them")
            found, _ = self.rounds.one_more(judged, judged)
            if found is None or found.fitted.chi2 > BEHIND * current.fitted.chi2:
                continue
            found = self.forms.finer(self.forms.reformed(found))
            if simplest([current, found]) is found:
                self.beginnings = 0
                return found
        return None
