"""Search for the best choice of k records: all of them where they are few, else greedy with exchanges."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from math import comb

import numpy as np

from edesign.ground_motion.selection_scaling import Library

_BATCH = 500  # choices that are compared at a time: keeps the arrays small
_EXCHANGED = 5  # how many of the grown choices, the best, are improved by exchanges
_PASSES = 50  # of exchanges; each pass improves the choice, so far fewer are needed

Choice = tuple[int, ...]
Rank = tuple[float, float, Choice]
"""Shortfall, misfit, indices: the smaller the better; indices break ties."""


@dataclass(frozen=True)
class Cap:
    """Largest number of records of one kind that may be chosen.

    Attributes:
        labels: kind of each candidate.
        most: how many of one label.
        of: what the labels are, for messages.
    """

    labels: tuple[Hashable, ...]
    most: int
    of: str


def search(library: Library, caps: Sequence[Cap], count: int, exhaustive_limit: int) -> tuple[Choice, bool]:
    """Return the best choice found, indices rising, and whether all were compared.

    Args:
        caps: what a choice keeps to; each lies within the one before it, so that a choice that keeps to them can
            always be completed.
        count: records wanted; the caller made sure that so many can be had.
        exhaustive_limit: up to how many combinations all are compared.

    Returns:
        The choice; True where all choices were compared.
    """
    n = len(library.pga)
    allowed = _Allowed(caps)
    if comb(n, count) <= exhaustive_limit:
        return _best(library, (choice for choice in combinations(range(n), count) if allowed(choice)))[2], True
    # the first record decides much of what a greedy search finds, so each takes its turn
    grown = sorted({_grow(library, allowed, first, count) for first in range(n)})
    return min(_exchange(library, allowed, rank) for rank in grown[:_EXCHANGED])[2], False


class _Allowed:
    """Whether a choice keeps to the numbers of records of one kind."""

    def __init__(self, caps: Sequence[Cap]) -> None:
        self.caps = caps

    def __call__(self, choice: Choice) -> bool:
        return all(max(Counter(cap.labels[i] for i in choice).values()) <= cap.most for cap in self.caps)


def _best(library: Library, choices: Iterator[Choice]) -> Rank:
    best: Rank | None = None
    while batch := list(islice(choices, _BATCH)):
        scaling = library.scale(np.array(batch))
        order = np.lexsort((scaling.misfit, scaling.shortfall))[0]  # stable: the first of equals
        rank = (float(scaling.shortfall[order]), float(scaling.misfit[order]), batch[order])
        best = rank if best is None or rank < best else best
    assert best is not None  # the caller leaves at least one admissible choice
    return best


def _grow(library: Library, allowed: _Allowed, first: int, count: int) -> Rank:
    """Add the record that does best until there are enough."""
    rank = _best(library, iter(((first,),)))
    while len(choice := rank[2]) < count:
        others = (i for i in range(len(library.pga)) if i not in choice)
        rank = _best(library, (tuple(sorted((*choice, i))) for i in others if allowed((*choice, i))))
    return rank


def _exchange(library: Library, allowed: _Allowed, rank: Rank) -> Rank:
    """Replace one record by another as long as that is better."""
    for _ in range(_PASSES):
        better = min(rank, _best(library, _neighbours(rank[2], allowed, len(library.pga))))
        if better[:2] >= rank[:2]:
            break
        rank = better
    return rank


def _neighbours(choice: Choice, allowed: _Allowed, n: int) -> Iterator[Choice]:
    """The choice itself and all that differ from it in one record."""
    yield choice
    for out in choice:
        kept = tuple(i for i in choice if i != out)
        for new in range(n):
            if new not in choice and allowed((*kept, new)):
                yield tuple(sorted((*kept, new)))
