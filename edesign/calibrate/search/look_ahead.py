"""One step ahead: an effect that is not the one that does most alone may be one of the two that do most together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from edesign.calibrate.evidence import Judged, compare, simplest
from edesign.calibrate.search.begun import may_join
from edesign.calibrate.search.contest import BEHIND, shortlist
from edesign.calibrate.search.misses import matters
from edesign.calibrate.search.screening import Signature, screen, screen_again
from edesign.calibrate.search.workbench import HOPELESS, NONE, Workbench
from edesign.calibrate.side_by_side import side_by_side

_PERHAPS = 1.5
"""Times what the best pair promises to leave: linear estimates miss so much."""
_NEAR_FLOOR = 2.0  # times noise: what promises to leave no more beside the best one is tried there first
_SCREENED, _EACH = 20, 2  # second effects that are screened beside a first one, and that may be fitted
_FITTED = 4  # pairs in all
_PLAIN = {True: 7, False: 3}  # pairs with a plainer form: beside the law as declared, and fitted again
_FREED = 2  # pairs beside the law as declared, beside which it is fitted


class LookAhead:
    """What second effects promise beside each of the first ones, by signatures that are known.

    Args:
        bench: what all parts of the search share.
    """

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench

    def two(self, current: Judged) -> Judged | None:
        """A model with two effects that is clearly better than the one that `current` has, neither of them that one, or
        one of them in a plainer form, as a finer one may have taken what is another's; None: there is none.
        """
        if len(current.names) != 1 or current.at_floor:
            return None
        fitted, first = current.fitted, current.fitted.model.effects[0]
        rivals = self.bench.rivals.get((NONE, fitted.model.held), ())
        every = (*self.bench.beside_declared, *self.bench.beside_refit)
        known = [one for one in every if one.candidate.name != first.name]
        left = self._left(current, [one for one in rivals if one.names[0] != first.name], known)
        own = min((chi2 for pair, chi2 in left.items() if _begins(pair, first.name)), default=math.inf)
        likely: list[Signature] = []
        if own > _NEAR_FLOOR * fitted.samples:
            likely = _best(
                {pair: chi2 for pair, chi2 in left.items() if not _begins(pair, first.name) and chi2 <= _PERHAPS * own}
            )
        plainer = [one for one in rivals if one.names[0] == first.name and _size(one) < _size(current)]
        for plainest in sorted(plainer, key=lambda one: (_size(one), _chi2(one)))[:1]:
            likely += _seconds(plainest, known)[: _PLAIN[fitted.model.held]]
        clear = [pair for pair in self._fitted(current, likely) if matters(pair, current, self.bench.left)]
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
        left = self._left(best, held, self.bench.beside_declared)
        perhaps = {pair: chi2 for pair, chi2 in left.items() if chi2 <= _PERHAPS * rival.fitted.chi2}
        for pair in sorted(self._fitted(best, _best(perhaps)), key=_chi2):
            if pair.fitted.chi2 <= rival.fitted.chi2:
                likely.setdefault(pair.names, pair)
        pairs = [*likely.values()][:_FREED]
        found = [pair for pair in pairs if pair.at_floor]
        found += self.bench.freed_all([pair for pair in pairs if not pair.at_floor])
        enough = [pair for pair in found if rival.fitted.chi2 > HOPELESS * pair.fitted.chi2]
        return simplest(enough) if enough else None

    def _left(self, current: Judged, others: Sequence[Judged], known: Sequence[Signature]) -> dict[Signature, float]:
        """What pairs of effects promise to leave (chi2), the first one the best of each that is not far behind."""
        best = {current.names[0]: current}
        for judged in sorted(others, key=_chi2):
            best.setdefault(judged.names[0], judged)
        firsts = [one for one in best.values() if one.fitted.chi2 <= BEHIND * current.fitted.chi2]
        self.bench.tell("looking a second effect ahead")
        given = [thing for one in firsts for thing in (*one.fitted.model.given, *one.fitted.slopes)]
        given += [signature.candidate for signature in known]
        seconds = side_by_side(lambda one: _seconds(one, known)[:_EACH], firsts, self.bench.workers, given)
        return {pair: one.fitted.chi2 - pair.gain for one, found in zip(firsts, seconds, strict=True) for pair in found}

    def _fitted(self, current: Judged, pairs: Sequence[Signature]) -> list[Judged]:
        """Those of pairs that are clearly better than a model."""
        found = self.bench.fit_best(pairs, current.fitted.chi2)
        return [pair for pair in found if compare(pair, current).clear]


def _seconds(first: Judged, known: Sequence[Signature]) -> list[Signature]:
    """The most promising second effects beside a first one, of those that are so if they do the same there as alone."""
    effects = first.fitted.model.effects
    able = [one for one in known if may_join(one.candidate, effects) and one.candidate.name != effects[0].name]
    likely = {one.candidate.label: one.candidate for one in screen_again(first.fitted, able)[:_SCREENED]}
    return shortlist(screen(first.fitted, [*likely.values()]))


def _best(left: Mapping[Signature, float]) -> list[Signature]:
    return sorted(left, key=lambda pair: left[pair])[:_FITTED]


def _begins(pair: Signature, name: str) -> bool:
    return pair.model.effects[0].name == name


def _size(model: Judged) -> int:
    return len(model.fitted.model.effects[0].unknowns)


def _chi2(judged: Judged) -> float:
    return judged.fitted.chi2
