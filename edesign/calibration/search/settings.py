"""Numbers of the search, each with its meaning and its source."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SearchSettings:
    """Numbers of the search.

    The first seven and the last say how wide it looks and how long: more costs time, and changes results where models
    are nearly as good. They were tried on campaigns of three foreign programs (blind/laboratories). The discrepancies
    are those of forms that are left out of the list in turn (benchmarks/effect_equations.py, 870 starts in four
    campaigns), rounded.

    Attributes:
        beam: models of different effects that are fitted to the end at each depth.
        singles: single effects that are fitted roughly beside a model.
        forms: equations of one effect among them.
        pairs: pairs of effects that are fitted roughly beside a model.
        others: equations of an adopted effect that are fitted in its place.
        rough_steps: of the fits by which models are put in order; a model stays behind if as many more, each as good as
            its last one, would not bring it up.
        depth: most effects of a model.
        shared_discrepancy: share of what an effect does by which its equation may be wrong, as other equations of it
            differ from it: the nearest one leaves 7 to 50 % (quartiles) of a form that is left out, 21 % in the median.
        own_discrepancy: the same in a way that no other equation of it has: all others together leave 3 to 29 %, 8 % in
            the median.
        median_discrepancy: median share of what an effect does by which its equation is wrong, where the tests show how
            much it is: the median that the nearest other equation leaves. A half-Cauchy prior with that median has the
            quartiles 9 and 51 %, those forms 7 and 50 %.
        least: root mean square of what an effect explains beside the others, of that of what was measured. Less is not
            separated from the instruments: a force transducer of class 1 reproduces no better (ISO 376:2011, table 2).
        share: of what is above noise without effects, that they must explain: as much as they leave. Where more is
            left, that is the main thing which the model lacks, and their numbers are its as much as theirs.
        effort: weighted predictions of all tests, after which the search ends unfinished: of 24 campaigns (seed 6102 of
            polytechnic and harbour) 22 ended within 8 600.
    """

    beam: int = 4
    singles: int = 10
    forms: int = 2
    pairs: int = 4
    others: int = 4
    rough_steps: int = 4
    depth: int = 4
    shared_discrepancy: float = 0.3
    own_discrepancy: float = 0.1
    median_discrepancy: float = 0.21
    least: float = 0.002
    share: float = 0.5
    effort: float = 10_000.0


SETTINGS = SearchSettings()
