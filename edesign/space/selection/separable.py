"""A model of all checks in which each group acts by its own section: what exchanges of many groups together would do.

A utilisation that goes with powers of the strengths and stiffnesses of groups is a sum of their parts in logarithms.
The parts come from designs that were analysed and differ in one group; so forces that move to other members, storeys
that drift, and Omega that multiplies the forces of columns are in them, whatever drives a group.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from itertools import combinations

import numpy as np

from edesign.codes.ec8.concentric_braces import HOMOGENEITY
from edesign.space.selection.evaluate import Choice, Evaluation
from edesign.space.selection.groups import Group

ROUNDING = 1e-5
"""Of sums of logarithms in single precision."""
TOGETHER = 256
"""Choices whose excess is found at once."""


class Separable:
    """The model about a choice that was analysed.

    Args:
        base: the choice.
        groups: with their sections.
        alike: how many diagonals must have like Omega, a number for each direction.
        cost: of a choice.
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
        more, ratios = found.logs - self._logs(found.choice), found.logs.size - sum(self._alike)
        self._missed[:ratios] += np.where(found.logs > 0.0, np.maximum(more, 0.0), 0.0)[:ratios]
        self._missed[ratios:] += more[ratios:]
        self._refused.add(found.choice)

    def proposal(self) -> Choice | None:
        """Return the cheapest choice of known sections that meets all checks, or has the least excess, by the model.

        Returns:
            The choice, found by exchanges of one and two groups; None if the model has nothing better than the base.
        """
        at = self.base.choice
        least = before = float(self._excess(self.base.logs[None])[0])
        while least > 0.0:
            step = self._nearer(at, least, wide=False) or self._nearer(at, least, wide=True)
            if step is None:
                break
            at, least = step
        while least == 0.0 and (cheaper := self._cheaper(at)) is not None:
            at = cheaper
        better = self._cost(at) < self.base.cost * (1.0 - 1e-12) if self.base.met else least < before
        return at if better and at not in self._refused else None

    def _logs(self, choice: Choice) -> np.ndarray:
        found = self.base.logs + self._missed
        for part, now, before in zip(self._part, choice, self.base.choice, strict=True):
            if now != before:
                found = found + (part[now] - part[before])
        return np.asarray(found)

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

    def _exchanges(self, at: Choice, wide: bool) -> tuple[list[tuple[int, ...]], list[tuple[int, int]], np.ndarray]:
        """Places of single exchanges that are made together, the single exchanges, and what these do to the logs."""
        single = [(group, k) for group, part in enumerate(self._part) for k in sorted(part) if k != at[group]]
        change = np.array([self._part[group][k] - self._part[group][at[group]] for group, k in single])
        places: list[tuple[int, ...]] = [(i,) for i in range(len(single))]
        if wide:
            places += [(i, j) for i, j in combinations(range(len(single)), 2) if single[i][0] != single[j][0]]
        return places, single, change

    def _made(self, at: Choice, single: Sequence[tuple[int, int]], places: Sequence[int]) -> Choice:
        numbers = list(at)
        for place in places:
            group, numbers[single[place][0]] = single[place]
        return tuple(numbers)

    def _steel(self, at: Choice, single: Sequence[tuple[int, int]]) -> list[float]:
        """What the steel of single exchanges costs more."""
        return [self._groups[group].cost[k] - self._groups[group].cost[at[group]] for group, k in single]

    def _nearer(self, at: Choice, least: float, wide: bool) -> tuple[Choice, float] | None:
        """The exchange that takes away most excess for its cost, and what excess is left."""
        places, single, change = self._exchanges(at, wide)
        more, here = self._steel(at, single), self._logs(at)
        gains: list[tuple[float, float, tuple[int, ...]]] = []
        for some in _parts(places):
            logs = here + np.array([change[list(of)].sum(axis=0) for of in some])
            for of, excess in zip(some, self._excess(logs).tolist(), strict=True):
                cost = sum(more[place] for place in of)
                if excess < least * (1.0 - 1e-6):
                    gains.append(((least - excess) / cost if cost > 0.0 else math.inf, excess, of))
        for _, excess, of in sorted(gains, key=lambda row: (-row[0], row[1])):
            if self._allowed(choice := self._made(at, single, of)):
                return choice, excess
        return None

    def _cheaper(self, at: Choice) -> Choice | None:
        """The cheapest exchange with which all checks stay met."""
        places, single, change = self._exchanges(at, wide=True)
        more, here, cost = self._steel(at, single), self._logs(at), self._cost(at)
        ordered = sorted((sum(more[place] for place in of), of) for of in places)
        for some in _parts([of for less, of in ordered if less < 0.0]):
            logs = here + np.array([change[list(of)].sum(axis=0) for of in some])
            for of, excess in zip(some, self._excess(logs).tolist(), strict=True):
                if excess == 0.0 and self._allowed(choice := self._made(at, single, of)) and self._cost(choice) < cost:
                    return choice
        return None


def _parts(places: Sequence[tuple[int, ...]]) -> Iterable[Sequence[tuple[int, ...]]]:
    return (places[k : k + TOGETHER] for k in range(0, len(places), TOGETHER))
