"""What histories have shown so far, and what it says of layouts that were not analysed."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.study.design.loop import RoundOutcome, demand_of
from edesign.study.placement.space import Layout, LayoutSpace

Estimates = Callable[[Layout], np.ndarray]
"""Estimated responses of a layout, all positive; a fixed number of them."""

_FEWEST = 3  # layouts from which the spread of ratios shows which response a criterion follows


@dataclass(frozen=True)
class Analysed:
    """A layout with the verdicts on its histories.

    Attributes:
        number: in the order of analysis, from 1.
        cost: in units of the prices.
        outcome: verdicts of the criteria.
    """

    number: int
    layout: Layout
    cost: int
    outcome: RoundOutcome

    @property
    def rank(self) -> tuple[int, float, Layout]:
        """The rank among layouts that meet the criteria: by cost, worst ratio, and the layout itself."""
        return self.cost, self.outcome.demand, self.layout


class Knowledge:
    """The layouts that were analysed so far.

    Args:
        estimates: of their responses.

    Attributes:
        analysed: in their order.
    """

    def __init__(self, space: LayoutSpace, estimates: Estimates) -> None:
        self.space, self.estimates = space, estimates
        self.analysed: list[Analysed] = []
        self._at: dict[Layout, Analysed] = {}
        self._responses: list[np.ndarray] = []  # logarithms of the estimates
        self._demands: dict[str, list[float]] = {}  # of the ratios of each verdict; nan where it does not apply

    def __contains__(self, layout: Layout) -> bool:
        return layout in self._at

    def add(self, layout: Layout, outcome: RoundOutcome) -> Analysed:
        """Add the outcome of a layout.

        Args:
            layout: the option at each position.

        Returns:
            The layout with its cost and worst ratio.
        """
        found = Analysed(len(self.analysed) + 1, layout, self.space.cost(layout), outcome)
        self.analysed.append(found)
        self._at[layout] = found
        self._responses.append(np.log(self.estimates(layout)))
        demands = {verdict.name: math.log(demand_of(verdict)) for verdict in outcome.verdicts}
        for name in {*self._demands, *demands}:
            before = self._demands.setdefault(name, [math.nan] * (len(self.analysed) - 1))
            before.append(demands.get(name, math.nan))
        return found

    @property
    def best(self) -> Analysed | None:
        """The cheapest layout that meets all criteria; of equally cheap ones that with the smallest worst ratio."""
        return min((one for one in self.analysed if one.outcome.met), key=lambda one: one.rank, default=None)

    @property
    def nearest_miss(self) -> Analysed:
        """The layout with the smallest worst ratio whatever its cost, for searches in which none meets the criteria."""
        return min(self.analysed, key=lambda one: (one.outcome.demand, one.cost, one.layout))

    @property
    def missed(self) -> np.ndarray:
        """Layouts that missed a criterion, (layouts, positions)."""
        return self._rows(met=False)

    def harmed_by_more(self) -> int:
        """The number of layouts that missed although they have nowhere less than one that met the criteria."""
        met, missed = self._rows(met=True), self._rows(met=False)
        return sum(bool(np.any(np.all(self.space.not_larger[met, row], axis=1))) for row in missed)

    def predicted(self, layouts: Sequence[Layout]) -> np.ndarray:
        """Return the predicted worst ratio of demand to limit of layouts, (layouts,), from the nearest analysed ones.

        The ratio of a verdict follows the estimated response that its ratios followed best so far, from where it was
        in the analysed layouts with the fewest other positions (their geometric mean).
        """
        rows = np.array([one.layout for one in self.analysed], dtype=np.int8)
        differing = np.array([np.count_nonzero(rows != np.array(one, dtype=np.int8), axis=1) for one in layouts])
        near = differing == differing.min(axis=1, keepdims=True)
        own = np.log([self.estimates(one) for one in layouts])
        found = np.full(len(layouts), -np.inf)
        for demand in self._demands.values():
            known = np.flatnonzero(~np.isnan(demand))
            offsets = np.array(demand)[known, None] - np.array(self._responses)[known]
            # while few are known the first response stands for all
            follows = 0 if known.size < _FEWEST else int(np.argmin(np.var(offsets, axis=0)))
            count = near[:, known].sum(axis=1)
            mean = near[:, known] @ offsets[:, follows] / np.maximum(count, 1)
            found = np.maximum(found, np.where(count > 0, mean + own[:, follows], -np.inf))
        return np.exp(np.where(np.isfinite(found), found, 0.0))

    def _rows(self, met: bool) -> np.ndarray:
        rows = [one.layout for one in self.analysed if one.outcome.met == met]
        return np.array(rows, dtype=np.int8).reshape(-1, len(self.space.positions))
