"""A round of the search: one effect more, or two that hide each other."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.evidence import CLEAR, SHARE, Judged, compare, simplest
from edesign.calibrate.search.begun import may_join
from edesign.calibrate.search.contest import FITTED, both, shortlist
from edesign.calibrate.search.effect_forms import EffectForms
from edesign.calibrate.search.misses import matters, more_than_misses, nearly_all
from edesign.calibrate.search.pairs import likely_pairs
from edesign.calibrate.search.screening import Signature, screen_again
from edesign.calibrate.search.selection import Refused
from edesign.calibrate.search.workbench import FEW, HOPELESS, RIVALS, Workbench, labels_of, of_left_out

_PAIRS = 4  # pairs fitted in a round
_ELSEWHERE = 8  # forms fitted from the law as declared
_HOPED = 0.7  # of what a fit must remove: so much by a linear estimate
_FAR = 0.5  # coordinates: factors of e


class Rounds:
    """What is added to a model.

    Args:
        bench: what all parts of the search share.
        forms: the search among forms.
    """

    def __init__(self, bench: Workbench, forms: EffectForms) -> None:
        self.bench = bench
        self.forms = forms

    def in_pairs(self, current: Judged) -> Judged | None:
        """A model in which two effects stand in the place of one that was a compromise between them; None: there is
        none, the search takes too long, or there are several effects.
        """
        effects = current.fitted.model.effects
        if len(effects) > 1 or effects[0].slow or not more_than_misses(current, self.bench.left):
            return None
        without = self.bench.without(current, effects[0])
        self.bench.tell(f"two effects in the place of {effects[0].name}")
        signatures = self.bench.screened(without.fitted, self.bench.candidates(without))
        pair = self._pair(without, shortlist(signatures), signatures)
        if pair is None or not matters(pair, current, self.bench.left):
            return None
        evidence = compare(pair, current)
        return pair if evidence.beyond_chance and evidence.share >= CLEAR else None

    def one_more(self, current: Judged, rival: Judged, further: Sequence[Judged] = ()) -> tuple[Judged | None, Refused]:
        """The best model with one effect more, or two, and what came near; None: chance may have made it.

        Args:
            current: the model to which effects are added.
            rival: the model to beat.
            further: models with one effect more that were fitted before.
        """
        known = current.fitted.model.effects
        number = len(known) + 1
        more = not known or more_than_misses(current, self.bench.left)
        names = {effect.name for effect in known}
        # finer forms of these were tried: a second form has nothing to add
        shaped = {part[0].name for part in current.fitted.parts if part[0].finer or self.bench.problem.finer(part)}
        almost_all = nearly_all(current)
        others = more or math.isfinite(almost_all)
        pool = [
            c
            for c in self.bench.candidates(current)
            if may_join(c, known) and (others or c.name in names) and c.name not in shaped
        ]
        self.bench.tell(f"effect {number}: screening {len(pool)} forms of effects")
        signatures = self.bench.screened(current.fitted, pool)
        if not known:
            self.bench.beside_refit = signatures
        likely = _HOPED * almost_all
        short = shortlist([s for s in signatures if more or s.candidate.name in names or s.gain >= likely])
        if short:
            self.bench.tell(f"effect {number}: fitting {', '.join(dict.fromkeys(s.candidate.name for s in short))}")
        elsewhere = []
        unfitted = current.fitted.model.coordinates()
        if not known and unfitted.size and float(np.max(np.abs(current.fitted.x - unfitted))) > _FAR:
            # the refit has gone far to make up for what is missing, and searches from there may not find back
            elsewhere = shortlist(screen_again(self.bench.unfitted(current), self.bench.beside_declared))[:_ELSEWHERE]
        tried = [*self.bench.fit_best([*short, *elsewhere]), *further]
        tried = [*dict.fromkeys((*tried, *self.forms.other_forms_of_likely(tried)))]  # some forms are likely twice
        tried += self._simpler_to_the_end(tried)
        if tried and (ahead := min(tried, key=of_left_out)).at_floor:
            tried += self.forms.with_plainer(ahead, len(known))
        self.bench.rivals[labels_of(known), current.fitted.model.held] = tried
        if not tried:
            return None, ()
        near = sorted(tried, key=of_left_out)[:3]
        refused = tuple((judged.fitted.model.effects[-1], compare(judged, rival)) for judged in near)
        best = simplest([judged for judged in tried if compare(judged, rival).adopts] or tried)
        evidence = compare(best, rival)
        if more and not (evidence.adopts and evidence.share >= CLEAR) and len(known) < FEW:
            pair = self._pair(current, short, signatures)
            if pair is not None:
                together = compare(pair, rival)
                alone = max(evidence.share, 0.0)
                needed = together.share - alone > SHARE * (1.0 - alone) and together.share > 2.0 * SHARE
                if together.beyond_chance and needed and matters(pair, rival, self.bench.left):
                    return pair, refused
        if evidence.adopts and matters(best, rival, self.bench.left):
            return best, refused
        return None, refused

    def _simpler_to_the_end(self, tried: Sequence[Judged]) -> list[Judged]:
        """Where the best model leaves noise alone, simpler ones fitted on with as little belief in the declared
        parameters: what is left by the model to which they were added made that more.
        """
        best = min(tried, key=lambda judged: judged.fitted.chi2, default=None)
        if best is None or not best.at_floor:
            return []
        near = [
            judged
            for judged in tried
            if judged.fitted.freedom < best.fitted.freedom
            and judged.fitted.model.misfit > best.fitted.misfit
            and judged.fitted.chi2 <= HOPELESS * best.fitted.chi2
        ]
        near.sort(key=lambda judged: judged.fitted.chi2)
        misfit = best.fitted.misfit
        return self.bench.fit_from([(replace(j.fitted.model, misfit=misfit), j.fitted.x) for j in near[:RIVALS]])

    def _pair(self, current: Judged, tried: Sequence[Signature], all_: Sequence[Signature]) -> Judged | None:
        """The best pair of effects that a linear estimate makes look good together."""
        pool = list({id(s): s for s in (*tried, *all_[:FITTED])}.values())
        pairs = likely_pairs(current.fitted, pool, _PAIRS)
        self.bench.tell("fitting pairs: " + ", ".join(f"{a.candidate.name} + {b.candidate.name}" for a, b in pairs))
        found = self.bench.fit_best([both(*pair) for pair in pairs])
        return min(found, key=of_left_out, default=None)
