"""A model of all checks in which each group acts by its own section: what exchanges of many groups together would do.

A utilisation that goes with powers of the strengths and stiffnesses of groups is a sum of their parts in logarithms.
The parts come from designs that were analysed and differ in one group; so forces that move to other members, storeys
that drift, and Omega that multiplies the forces of columns are in them, whatever drives a group.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import combinations

import numpy as np

from edesign.codes.ec8.steel.concentric_braces import HOMOGENEITY
from edesign.space.selection.evaluate import Choice, Evaluation
from edesign.space.selection.groups import Group

ROUNDING = 1e-5
"""Of sums of logarithms in single precision."""
TOGETHER = 256
"""Choices whose excess is found at once."""


class Separable:
    """The model about a choice that was analysed.

    Args:
        groups: with their sections.
        alike: how many diagonals must have like Omega, a number for each direction.
        allowed: whether a choice is.

    Attributes:
        base: the choice.
        stale: whether some parts come from another base.
    """

    def __init__(
        self,
        base: Evaluation,
        groups: Sequence[Group],
        alike: Iterable[int],
        cost: Callable[[Choice], float],
        allowed: Callable[[Choice], bool],
    ) -> None:
        self._groups, self._alike = tuple(groups), tuple(alike)
        self._cost, self._allowed = cost, allowed
        self._refused = set[Choice]()
        self.move(base)
        self.forget()

    def knows(self, group: int, number: int) -> bool:
        """Say whether the model knows a section of a group."""
        return number in self._part[group]

    def learn(self, found: Evaluation, group: int) -> None:
        """Take the part of another section of one group from a choice that differs from the base in it alone."""
        here = self._part[group][self.base.choice[group]]
        self._part[group][found.choice[group]] = here + found.logs - self.base.logs

    def move(self, base: Evaluation) -> None:
        """Take another choice, of known sections, as the base; parts stand until they are learnt anew."""
        self.base, self._missed, self.stale = base, np.zeros_like(base.logs), True

    def forget(self) -> None:
        """Forget all sections but those of the base."""
        self._part = [{number: np.zeros_like(self.base.logs)} for number in self.base.choice]
        self._missed, self.stale = np.zeros_like(self.base.logs), False

    def refuse(self, found: Evaluation) -> None:
        """Take into account by how much a proposal misses what the model said, so that its like do not come again."""
        said = self.base.logs + self._missed
        for part, now, before in zip(self._part, found.choice, self.base.choice, strict=True):
            said = said + (part[now] - part[before])
        more, ratios = found.logs - said, found.logs.size - sum(self._alike)
        self._missed[:ratios] += np.where(found.logs > 0.0, np.maximum(more, 0.0), 0.0)[:ratios]
        self._missed[ratios:] += more[ratios:]
        self._refused.add(found.choice)

    def proposal(self) -> Choice | None:
        """Return the cheapest choice of known sections that meets all checks, or has the least excess, by the model.

        Returns:
            The choice; None if the model has nothing better than the base.

        From the base the model goes on by exchanges of one and two groups. Where that comes to nothing better, each
        group in turn takes a cheaper section, and what then fails is mended likewise.
        """
        self._keep_what_may_be_missed()
        before = float(self._excess(self._logs(self.base.choice)[None])[0])
        at, least = self._settled(self.base.choice, before)
        if not self._improves(at, least, before):
            for group, part in enumerate(self._part):
                for k in sorted(part):
                    if self._groups[group].cost[k] >= self._groups[group].cost[at[group]]:
                        continue
                    other = (*at[:group], k, *at[group + 1 :])
                    mended, left = self._settled(other, float(self._excess(self._logs(other)[None])[0]))
                    if self._improves(mended, left, before) and self._cost(mended) < self._cost(at):
                        at, least = mended, left
        return at if self._improves(at, least, before) else None

    def _keep_what_may_be_missed(self) -> None:
        """Leave out of the proposal all utilisations that no choice of known sections takes beyond 1."""
        of_groups = [
            np.maximum.reduce(list(part.values())) - part[k]
            for part, k in zip(self._part, self.base.choice, strict=True)
        ]
        most = self.base.logs + self._missed + sum(of_groups)
        most[most.size - sum(self._alike) :] = np.inf
        self._rows = np.flatnonzero(most > 0.0)
        self._of_base = (self.base.logs + self._missed)[self._rows]
        self._short = [{k: of[self._rows] for k, of in part.items()} for part in self._part]

    def _improves(self, choice: Choice, least: float, before: float) -> bool:
        """Say whether the model holds a choice for better than the base, and it was not refused."""
        if choice in self._refused or not self._allowed(choice):
            return False
        if self.base.met:
            return least == 0.0 and self._cost(choice) < self.base.cost * (1.0 - 1e-12)
        return least < before

    def _settled(self, at: Choice, least: float) -> tuple[Choice, float]:
        """Exchange sections of one or two groups while that takes excess away, then while that costs less."""
        while least > 0.0:
            step = self._nearer(at, least, wide=False) or self._nearer(at, least, wide=True)
            if step is None:
                break
            at, least = step
        while least == 0.0 and (cheaper := self._cheaper(at)) is not None:
            at = cheaper
        return at, least

    def _logs(self, choice: Choice) -> np.ndarray:
        """The logarithms of a choice that may be above 0."""
        found = self._of_base.copy()
        for part, now, before in zip(self._short, choice, self.base.choice, strict=True):
            if now != before:
                found += part[now] - part[before]
        return found

    def _excess(self, logs: np.ndarray) -> np.ndarray:
        """The sum of max(u - 1, 0) of choices, (n_choices,)."""
        last, found = logs.shape[1], np.zeros(len(logs))
        for count in reversed(self._alike):
            ratios = logs[:, last - count : last]
            beyond = ratios - ratios.min(axis=1, keepdims=True) - np.log1p(HOMOGENEITY)
            found += np.expm1(np.maximum(beyond, 0.0)).sum(axis=1)
            last -= count
        found += np.expm1(np.maximum(logs[:, :last], 0.0)).sum(axis=1)
        return np.where(found <= ROUNDING, 0.0, found)

    def _exchanges(self, at: Choice, wide: bool) -> tuple[list[tuple[int, int]], np.ndarray, np.ndarray, np.ndarray]:
        """What may be exchanged, the last of it nothing; pairs of it; what each does to logarithms, and costs more."""
        single = [(group, k) for group, part in enumerate(self._short) for k in sorted(part) if k != at[group]]
        nothing = len(single)
        pairs = [(i, nothing) for i in range(nothing)]
        if wide:
            pairs += [(i, j) for i, j in combinations(range(nothing), 2) if single[i][0] != single[j][0]]
        change = [self._short[group][k] - self._short[group][at[group]] for group, k in single]
        costs = [self._groups[group].cost for group, _ in single]
        more = [cost[k] - cost[at[group]] for cost, (group, k) in zip(costs, single, strict=True)]
        none = np.zeros((1, self._rows.size))
        rows = np.concatenate([*(of[None] for of in change), none])
        return single, np.array(pairs, dtype=int).reshape(-1, 2), rows, np.array([*more, 0.0])

    def _made(self, at: Choice, single: Sequence[tuple[int, int]], pair: Iterable[int]) -> Choice:
        numbers = list(at)
        for place in pair:
            if place < len(single):
                group, number = single[place]
                numbers[group] = number
        return tuple(numbers)

    def _nearer(self, at: Choice, least: float, wide: bool) -> tuple[Choice, float] | None:
        """The exchange that takes away most excess for its cost, and what excess is left."""
        single, pairs, change, more = self._exchanges(at, wide)
        cost, here = more[pairs].sum(axis=1), self._logs(at)
        left = np.concatenate(
            [self._excess(here + change[one] + change[other]) for one, other in _parts(pairs)] or [np.zeros(0)]
        )
        gain = np.where(cost > 0.0, (least - left) / np.maximum(cost, 1e-300), np.inf)
        for place in np.lexsort((left, -gain)).tolist():
            if left[place] < least * (1.0 - 1e-6) and self._allowed(choice := self._made(at, single, pairs[place])):
                return choice, float(left[place])
        return None

    def _cheaper(self, at: Choice) -> Choice | None:
        """The cheapest exchange with which all checks stay met."""
        single, pairs, change, more = self._exchanges(at, wide=True)
        less, here, cost = more[pairs].sum(axis=1), self._logs(at), self._cost(at)
        order = np.argsort(less, kind="stable")
        pairs = pairs[order[less[order] < 0.0]]
        for number, (one, other) in enumerate(_parts(pairs)):
            for place in np.flatnonzero(self._excess(here + change[one] + change[other]) == 0.0).tolist():
                choice = self._made(at, single, pairs[number * TOGETHER + place])
                if self._allowed(choice) and self._cost(choice) < cost:
                    return choice
        return None


def _parts(pairs: np.ndarray) -> Iterable[np.ndarray]:
    """Pairs in parts that are looked at together, (2, n) each."""
    return (pairs[k : k + TOGETHER].T for k in range(0, len(pairs), TOGETHER))
