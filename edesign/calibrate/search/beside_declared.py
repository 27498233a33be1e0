"""Effects beside the law as it was declared: one number against the many of a law that is fitted again."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibrate.evidence import CLEAR, Judged, compare, simplest
from edesign.calibrate.fit import fit
from edesign.calibrate.search.begun import may_join
from edesign.calibrate.search.contest import shortlist
from edesign.calibrate.search.effect_forms import LIKELY, EffectForms
from edesign.calibrate.search.misses import matters
from edesign.calibrate.search.workbench import NONE, Workbench, of_left_out, worse

_HOPED = 0.7  # of what is left over noise, all of which must go: so much by a linear estimate


class BesideDeclared:
    """One effect or two, the law held.

    Args:
        bench: what all parts of the search share.
        forms: the search among forms.
    """

    def __init__(self, bench: Workbench, forms: EffectForms) -> None:
        self.bench = bench
        self.forms = forms

    def one(self, declared: Judged) -> list[Judged]:
        """Models with one effect beside the law as declared: a gain, say, is all moduli changed alike, one number
        against nine.
        """
        self.bench.tell("screening effects beside the law as declared")
        self.bench.beside_declared = self.bench.screened(declared.fitted, self.bench.candidates(declared))
        found = self.bench.fit_best(shortlist(self.bench.beside_declared))
        self.bench.rivals[NONE, True] = found
        return found

    def two(self, best: Judged, free: Judged, freed: Judged) -> Judged | None:
        """Two effects beside the law as declared, where one does nearly as much as all of the law's parameters fitted
        again: what is beside that refit may be its symptoms. They must beat a model whose law is fitted.

        Args:
            best: the best model with one effect beside the law as declared.
            free: the best model with the law fitted.
            freed: `best`, with the law fitted.
        """
        known = best.fitted.model.effects
        self.bench.tell(f"screening effects beside {known[0].name} and the law as declared")
        pool = [c for c in self.bench.candidates(best) if may_join(c, known)]
        found = self.bench.fit_best(shortlist(self.bench.screened(best.fitted, pool)))
        rivals = (free, best, freed)
        least = min(rival.fitted.chi2 for rival in rivals)
        if any(judged.fitted.chi2 <= CLEAR * least for judged in found):
            found += self.forms.other_forms_of_likely(found)
        clear = [judged for judged in found if all(compare(judged, rival).clear for rival in rivals)]
        if not clear:  # the declared law may be off
            likely = self.bench.freed_all(sorted(found, key=of_left_out)[:LIKELY])
            clear = [judged for judged in likely if all(compare(judged, rival).clear for rival in rivals)]
        return simplest(clear) if clear else None

    def instead_of_refit(self, current: Judged) -> Judged:
        """The law as declared with a second effect, where that leaves noise alone as the law fitted again does: one
        effect has not so many parameters as a law.
        """
        model = current.fitted.model
        if model.held or not self.bench.may_refit or len(model.effects) != 1 or not current.at_floor:
            return current
        held = replace(model, held=True)
        alone = Judged(fit(held, held.coordinates(None, current.fitted.parts)))
        self.bench.tell(f"an effect beside {model.effects[0].name} in the place of the law fitted again")
        pool = [c for c in self.bench.candidates(alone) if c.name != model.effects[0].name]
        hoped = _HOPED * (alone.fitted.chi2 - alone.fitted.samples)
        likely = [one for one in self.bench.screened(alone.fitted, pool, roughly=True) if one.gain >= hoped]
        found = self.bench.fit_best(shortlist(likely))
        as_good = [judged for judged in found if judged.at_floor and not worse(judged, current)]
        return simplest([current, *(judged for judged in as_good if matters(judged, alone, self.bench.left))])
