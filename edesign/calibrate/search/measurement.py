"""Faults of the measurement alone, before all other effects are sought."""

from __future__ import annotations

from edesign.calibrate.evidence import CLEAR, Judged, compare, simplest
from edesign.calibrate.search.contest import FITTED, both, shortlist
from edesign.calibrate.search.pairs import joint_gains, likely_pairs
from edesign.calibrate.search.screening import Signature
from edesign.calibrate.search.workbench import RIVALS, Workbench


class Measurement:
    """Zero, drift, gain, hum and lag of the channels.

    They are common, and cheap to predict: most take the force of the law as it is. So they are sought first, and a
    search that takes its time with a slow law has them. A search that comes to its end finds them among all effects.

    Args:
        bench: what all parts of the search share.

    Attributes:
        found: the best model with one or two faults of the measurement alone, if they remove most of what its rival
            leaves.
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
            self.bench.beside_declared = self._beside(declared, rival)
            if self.found is None and refit is not declared:
                self.bench.tell("faults of the measurement beside the law fitted again")
                self._beside(refit, rival)
        finally:
            self.bench.known.clear()  # what is fitted in search of all effects begins anew

    def _beside(self, law: Judged, rival: Judged) -> list[Signature]:
        """One fault, or two: those that by a linear estimate remove as much as is asked for. Signatures of all."""
        fitted = law.fitted
        most = (1.0 - CLEAR) * (rival.fitted.chi2 - fitted.samples) + fitted.samples
        pool = [candidate for candidate in self.bench.candidates(law) if candidate.kind == "instrument"]
        signatures = self.bench.screened(fitted, pool)
        single = [one for one in signatures if fitted.chi2 - one.gain <= most]
        self._keep(self.bench.fit_best(shortlist(single)[:RIVALS]), rival)
        if self.found is None or not self.found.at_floor:
            pairs = likely_pairs(fitted, signatures[:FITTED], RIVALS)
            hoped = [pair for pair in pairs if fitted.chi2 - joint_gains(fitted, pair)[0, 1] <= most]
            self._keep(self.bench.fit_best([both(*pair) for pair in hoped]), rival)
        return signatures

    def _keep(self, tried: list[Judged], rival: Judged) -> None:
        clear = [judged for judged in tried if compare(judged, rival).clear]
        if clear:
            self.found = simplest(clear if self.found is None else [self.found, *clear])
