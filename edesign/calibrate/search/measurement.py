"""Faults of the measurement alone, before all other effects are sought."""

from __future__ import annotations

from edesign.calibrate.evidence import Judged, compare, simplest
from edesign.calibrate.search.begun import may_join
from edesign.calibrate.search.contest import shortlist
from edesign.calibrate.search.workbench import FEW, Workbench


class Measurement:
    """Zero, drift, gain, hum and lag of the channels.

    They are common, and cheap to predict: most take the force of the law as it is. So they are sought first, and a
    search that takes its time with a slow law has them. A search that comes to its end finds them among all effects.

    Args:
        bench: what all parts of the search share.

    Attributes:
        found: the best model with faults of the measurement alone, if it removes most of what its rival leaves.
    """

    def __init__(self, bench: Workbench) -> None:
        self.bench = bench
        self.found: Judged | None = None

    def look(self, declared: Judged, refit: Judged, rival: Judged) -> None:
        """Beside the law as declared, and if that is not enough beside the law fitted again.

        Args:
            declared: the law as declared.
            refit: the law fitted again.
            rival: the model to beat.
        """
        try:
            self.bench.tell("faults of the measurement beside the law as declared")
            self._add(declared, rival)
            if self.found is None and refit is not declared:
                self.bench.tell("faults of the measurement beside the law fitted again")
                self._add(refit, rival)
        finally:
            self.bench.known.clear()  # what is fitted in search of all effects begins anew

    def _add(self, current: Judged, rival: Judged) -> None:
        """Up to two faults, one after the other, each of which must be adopted beside the model before."""
        for _ in range(FEW):
            known = current.fitted.model.effects
            pool = [c for c in self.bench.candidates(current) if c.kind == "instrument" and may_join(c, known)]
            tried = self.bench.fit_best(shortlist(self.bench.screened(current.fitted, pool)))
            better = [judged for judged in tried if compare(judged, current).adopts]
            if not better:
                return
            current = simplest(better)
            if compare(current, rival).clear:
                self.found = current
            if current.at_floor:
                return
