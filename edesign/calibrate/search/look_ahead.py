"""One step ahead: an effect that is not the one that does most alone may be one of the two that do most together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from edesign.calibrate.evidence import Judged, compare, simplest
from edesign.calibrate.search.begun import may_join
from edesign.calibrate.search.contest import BEHIND, shortlist
from edesign.calibrate.search.screening import Signature, screen_again
from edesign.calibrate.search.workbench import HOPELESS, NONE, Workbench
from edesign.calibrate.side_by_side import side_by_side

_PERHAPS = 1.5
"""Times what the best pair promises to leave: linear estimates miss so much."""
_NEAR_FLOOR = 2.0  # times noise: what promises to leave no more beside the best one is tried there first
_EACH, _FITTED = 2, 4  # second effects beside each first one, and pairs in all, that are fitted
_FREED = 2  # pairs beside the law as declared, beside which it is fitted


class LookAhead:
    """What second effects promise beside each of the first ones, by signatures that are known.

    Args:
        bench: what all parts of the search share.
    """

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench

    def two(self, current: Judged) -> Judged | None:
        """A model with two effects, neither of them the one that `current` has, that is clearly better; None: there is
        none, or this one promises to leave little with a second one.
        """
        if len(current.names) != 1 or current.at_floor:
            return None
        fitted, first = current.fitted, current.names[0]
        others = [one for one in self.bench.rivals.get((NONE, fitted.model.held), ()) if one.names[0] != first]
        left = self._left(current, others, [*self.bench.beside_declared, *self.bench.beside_refit])
        own = min((left[pair] for pair in left if _begins(pair, first)), default=math.inf)
        if own <= _NEAR_FLOOR * fitted.samples:
            return None
        clear = self._fitted(
            current, {pair: left[pair] for pair in left if left[pair] <= _PERHAPS * own and not _has(pair, first)}
        )
        return simplest(clear) if clear else None

    def beside_declared(self, best: Judged, held: Sequence[Judged], rival: Judged) -> Judged | None:
        """Two effects beside the law as declared, or beside the law fitted again, where one never suffices; None: there
        are none.

        Args:
            best: the best model with one effect beside the law as declared.
            held: all of them.
            rival: the best model with one effect, the law fitted again.
        """
        likely: dict[tuple[str, ...], Judged] = {}
        for pair in sorted(self._fitted(best, self._left(best, held, self.bench.beside_declared)), key=_chi2):
            if pair.fitted.chi2 <= rival.fitted.chi2:
                likely.setdefault(pair.names, pair)
        found = [pair if pair.at_floor else self.bench.freed(pair) for pair in [*likely.values()][:_FREED]]
        enough = [pair for pair in found if rival.fitted.chi2 > HOPELESS * pair.fitted.chi2]
        return simplest(enough) if enough else None

    def _left(self, current: Judged, others: Sequence[Judged], known: Sequence[Signature]) -> dict[Signature, float]:
        """What pairs of effects promise to leave (chi2)."""
        best = {current.names[0]: current}
        for judged in sorted(others, key=_chi2):
            best.setdefault(judged.names[0], judged)
        firsts = [judged for judged in best.values() if judged.fitted.chi2 <= BEHIND * current.fitted.chi2]
        self.bench.tell("looking a second effect ahead")
        given = [thing for one in firsts for thing in (*one.fitted.model.given, *one.fitted.slopes)]
        given += [signature.candidate for signature in known]
        seconds = side_by_side(lambda one: _seconds(one, known), firsts, self.bench.workers, given)
        return {pair: one.fitted.chi2 - pair.gain for one, found in zip(firsts, seconds, strict=True) for pair in found}

    def _fitted(self, current: Judged, left: Mapping[Signature, float]) -> list[Judged]:
        """Those of the most promising pairs that are clearly better than a model."""
        likely = sorted(left, key=lambda pair: left[pair])[:_FITTED]
        found = self.bench.fit_best(likely, current.fitted.chi2)
        return [pair for pair in found if compare(pair, current).clear]


def _seconds(first: Judged, known: Sequence[Signature]) -> list[Signature]:
    """The most promising second effects beside a first one, as if they did the same there."""
    effects = first.fitted.model.effects
    able = [one for one in known if may_join(one.candidate, effects) and one.candidate.name != effects[0].name]
    return shortlist(screen_again(first.fitted, able))[:_EACH]


def _begins(pair: Signature, name: str) -> bool:
    return pair.model.effects[0].name == name


def _has(pair: Signature, name: str) -> bool:
    return any(effect.name == name for effect in pair.model.effects)


def _chi2(judged: Judged) -> float:
    return judged.fitted.chi2
