"""The search for the layout of least cost: up to one that meets all criteria, then down through all that are cheaper.

The search only puts layouts in an order; what it has proved in the end is found anew by `certify`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from edesign.study.design.loop import RoundOutcome
from edesign.study.placement.knowledge import Analysed, Estimates, Knowledge
from edesign.study.placement.space import Layout, LayoutSpace

Analyse = Callable[[Sequence[tuple[int, Layout]]], Iterator[RoundOutcome]]
"""Runs the histories of layouts with their numbers (from 1), and yields what they came to in the same order."""

BATCH = 4
"""Layouts that are analysed before the next are chosen. It does not follow the workers, as results must not either."""
MOST_ESTIMATED = 2000
"""Layouts that are estimated for one choice, some milliseconds each: those that cost most, which rule out most."""


def search(
    space: LayoutSpace,
    analyse: Analyse,
    estimates: Estimates,
    budget: int,
    monotone: bool,
    kept: Callable[[Knowledge], None] = lambda knowledge: None,
) -> Knowledge:
    """Analyse layouts until the cheapest that meets all criteria is proved, or the budget is spent.

    Args:
        analyse: runs the histories of layouts.
        estimates: of the responses of a layout, for the order.
        budget: layouts that may be analysed.
        monotone: whether layouts are left for later that have nowhere more than one that missed.
        kept: called after each layout.

    Returns:
        All that was analysed.
    """
    found = _Search(space, analyse, Knowledge(space, estimates), budget, monotone, kept)
    found.rise()
    found.improve()
    return found.knowledge


class _Search:
    def __init__(
        self,
        space: LayoutSpace,
        analyse: Analyse,
        knowledge: Knowledge,
        budget: int,
        monotone: bool,
        kept: Callable[[Knowledge], None],
    ) -> None:
        self.space, self.knowledge = space, knowledge
        self._analyse, self._budget, self._monotone, self._kept = analyse, budget, monotone, kept
        self._listed: tuple[int | None, np.ndarray | None] | None = None  # by the cost that is not exceeded

    @property
    def _left(self) -> int:
        return self._budget - len(self.knowledge.analysed)

    def rise(self) -> None:
        """From the empty layout up, by what lowers the predicted ratio most for its cost, until one meets."""
        layout = self.space.empty
        self._look([layout])
        while self._left > 0 and self.knowledge.best is None:
            before = layout
            while layout == before or (layout in self.knowledge) or self._predicted(layout) > 1.0:
                following = self._step_up(layout)
                if following is None:
                    break
                layout = following
            if layout in self.knowledge:
                return  # nothing can be added any more
            self._look([layout])

    def improve(self) -> None:
        """Analyse what may be cheaper, or as cheap and better, in the order of what it may bring, until nothing may."""
        while self._left > 0:
            batch = self._next()
            if not batch:
                return
            self._look(batch)

    def _look(self, layouts: Sequence[Layout]) -> None:
        chosen = layouts[: self._left]
        first = len(self.knowledge.analysed) + 1
        outcomes = self._analyse([(first + i, layout) for i, layout in enumerate(chosen)])
        for layout, outcome in zip(chosen, outcomes, strict=True):
            self.knowledge.add(layout, outcome)
            self._kept(self.knowledge)
        if self._monotone and self.knowledge.harmed_by_more():
            self._monotone = False

    def _step_up(self, layout: Layout) -> Layout | None:
        """The change of one position upwards that lowers the predicted ratio most for its cost."""
        cost, now = self.space.cost(layout), self._predicted(layout)
        larger = sorted(one for one in self.space.neighbours(layout, 1) if self.space.cost(one) > cost)
        if not larger:
            return None
        more = np.array([self.space.prices.value(self.space.cost(one) - cost) for one in larger])
        return larger[int(np.argmax((now - self.knowledge.predicted(larger)) / more))]

    def _predicted(self, layout: Layout) -> float:
        return float(self.knowledge.predicted([layout])[0])

    def _next(self) -> list[Layout]:
        """What to analyse next; nothing when the search is over."""
        best = self.knowledge.best
        centre = (best or self.knowledge.nearest_miss).layout
        bound = None if best is None else best.cost - 1
        near = self._near(centre, bound)
        chosen = self._first(self._open(near))
        if chosen:
            return chosen
        listed = self._all_up_to(bound)
        if listed is None:
            return self._hopeful(bound) or self._first(self._whole(near)) or self._last_resort(centre)
        chosen = self._first(self._open(listed))
        if chosen:
            return chosen
        # what the assumption leaves out, where all of it can be analysed, makes the proof one without it
        chosen = self._first(self._whole(listed))
        if chosen or best is None:
            return chosen or self._last_resort(centre)
        alike = self._all_up_to(best.cost)
        return [] if alike is None else self._first(self._whole(alike))

    def _near(self, centre: Layout, bound: int | None) -> list[Layout]:
        """Layouts up to a cost that differ from one in one or two positions."""
        return [one for one in self.space.neighbours(centre) if bound is None or self.space.cost(one) <= bound]

    def _hopeful(self, bound: int | None) -> list[Layout]:
        """Return the layouts near the cheaper near misses that are predicted to meet all criteria.

        It is for spaces that are too large to be listed.
        """
        missed = [one for one in self.knowledge.analysed if bound is None or one.cost <= bound]
        missed.sort(key=lambda one: (one.outcome.demand, one.layout))
        around = {near: None for one in missed[:BATCH] for near in self._near(one.layout, bound)}
        chosen = self._first(self._open(around))
        return [one for one in chosen if self._predicted(one) <= 1.0]

    def _last_resort(self, centre: Layout) -> list[Layout]:
        """Where nothing met yet: what differs in one position from the nearest miss, ruled out or not.

        The assumption may be false, as where dampers lock a storey; one that meets shows it, and the search goes on.
        """
        if self.knowledge.best is not None:
            return []
        return self._first([one for one in self.space.neighbours(centre, 1) if one not in self.knowledge])

    def _open(self, layouts: Iterable[Layout]) -> list[Layout]:
        """Those that were not analysed, and are not ruled out by one that missed if more dampers never harm."""
        left = [one for one in layouts if one not in self.knowledge]
        if not (self._monotone and left):
            return left
        out = self.space.below_some(np.array(left, dtype=np.int8), self.knowledge.missed)
        return [one for one, below in zip(left, out, strict=True) if not below]

    def _whole(self, layouts: Iterable[Layout]) -> list[Layout]:
        """Those that were not analysed, if the budget is enough for all of them."""
        left = [one for one in layouts if one not in self.knowledge]
        return left if len(left) <= self._left else []

    def _first(self, layouts: list[Layout]) -> list[Layout]:
        """The cheapest that are predicted to meet all criteria, then those that are nearest to it."""
        if len(layouts) > MOST_ESTIMATED:
            layouts = sorted(layouts, key=lambda one: (-self.space.cost(one), one))[:MOST_ESTIMATED]
        if not layouts:
            return []
        ratios = self.knowledge.predicted(layouts).tolist()
        ranked = [
            (ratio > 1.0, self.space.cost(one) if ratio <= 1.0 else 0, ratio, one)
            for ratio, one in zip(ratios, layouts, strict=True)
        ]
        return [one for *_, one in sorted(ranked)[:BATCH]]

    def _all_up_to(self, cost: int | None) -> list[Layout] | None:
        """All layouts up to a cost; None if they are too many to be listed."""
        if self._listed is None or self._listed[0] != cost:
            self._listed = (cost, self.space.listed(cost))
        rows = self._listed[1]
        return None if rows is None else [tuple(row) for row in rows.tolist()]


def chosen_of(knowledge: Knowledge) -> Analysed:
    """Return the chosen layout of a search: the best, or where none meets the criteria the nearest miss."""
    return knowledge.best or knowledge.nearest_miss
