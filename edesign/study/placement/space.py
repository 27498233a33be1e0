"""All layouts of dampers that a search may choose from: what they cost, which are allowed, which has more than another.

A layout says of each position, places that are equipped alike, which option it has: 0 is empty, i the i-th item of the
catalogue.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property

import numpy as np

from edesign.project.notation.grid import BayPlace

Layout = tuple[int, ...]
MOST_LISTED = 200_000
"""Layouts that are held at a time: some 10 MB and seconds of work. Beyond, a search stays local."""


@dataclass(frozen=True)
class Position:
    """Places that are equipped alike.

    Attributes:
        places: of which each gets the dampers of an item.
        mirrored: which of them have diagonals that lean the other way.
        options: numbers of the items that may stand here.
        below: index of the position that has to be equipped first; None: none has.
    """

    places: tuple[BayPlace, ...]
    mirrored: tuple[bool, ...]
    options: tuple[int, ...]
    below: int | None = None


@dataclass(frozen=True)
class Prices:
    """Costs in whole multiples of one unit, so that equal costs are equal.

    Attributes:
        items: of a place equipped with each option, its dampers and what the place itself costs; 0 of the empty one.
        storey, bay: of each that has any damper.
        unit: that all are multiples of.
    """

    items: tuple[int, ...]
    storey: int
    bay: int
    unit: Decimal

    def value(self, cost: int) -> float:
        """Return a cost in the currency of the file."""
        return float(cost * self.unit)


def make_prices(dampers: Sequence[float], numbers: Sequence[int], place: float, storey: float, bay: float) -> Prices:
    """Return prices of the items of a catalogue as whole multiples of a decimal unit.

    Args:
        dampers: cost of one damper of each item.
        numbers: dampers in a place, of each item.
        place: cost of each equipped place.
        storey: cost of each storey with dampers.
        bay: cost of each bay with dampers.
    """
    written = [Decimal(repr(value)) for value in (*dampers, place, storey, bay)]
    unit = Decimal(1).scaleb(min(0, *(int(value.normalize().as_tuple().exponent) for value in written)))
    *own, at_place, at_storey, at_bay = (int(value / unit) for value in written)
    items = (0, *(number * cost + at_place for number, cost in zip(numbers, own, strict=True)))
    return Prices(items, at_storey, at_bay, unit)


@dataclass(frozen=True)
class LayoutSpace:
    """The layouts that the limits of a placement allow.

    Attributes:
        positions: one stack of bays after the other, upwards.
        prices: of options, storeys and bays.
        numbers: dampers in a place with each option, 0 first.
        most_dampers: of a layout; None: no limit.
        not_larger: (options, options) whether the first is the second, or has the same law and is nowhere larger.
    """

    positions: tuple[Position, ...]
    prices: Prices
    numbers: tuple[int, ...]
    most_dampers: int | None
    not_larger: np.ndarray

    @property
    def empty(self) -> Layout:
        """The layout without dampers."""
        return (0,) * len(self.positions)

    def cost(self, layout: Layout) -> int:
        """Return the cost of a layout in units of the prices."""
        equipped = [i for i, option in enumerate(layout) if option]
        own = sum(self.prices.items[layout[i]] * len(self.positions[i].places) for i in equipped)
        storeys = frozenset[int]().union(*(self._storeys[i] for i in equipped))
        bays = frozenset[tuple[str, int]]().union(*(self._bays[i] for i in equipped))
        return own + self.prices.storey * len(storeys) + self.prices.bay * len(bays)

    def dampers(self, layout: Layout) -> int:
        """Return the number of dampers of a layout."""
        return sum(self._dampers_at(i, option) for i, option in enumerate(layout))

    def allowed(self, layout: Layout) -> bool:
        """Return whether a layout of allowed options keeps the limits."""
        if self.most_dampers is not None and self.dampers(layout) > self.most_dampers:
            return False
        return all(
            at.below is None or not option or layout[at.below]
            for at, option in zip(self.positions, layout, strict=True)
        )

    @cached_property
    def size(self) -> int:
        """The number of allowed layouts, counted exactly position by position without listing them."""
        done = {0: 1}  # layouts of the positions so far, by their number of dampers
        column: dict[int, int] = {}  # those whose last position is equipped, in a column that goes on upwards
        for i, at in enumerate(self.positions):
            whole, standing = (done, done) if at.below is None else (done, column)
            with_damper: dict[int, int] = {}
            for option in at.options:
                for count, layouts in standing.items():
                    more = count + self._dampers_at(i, option)
                    if self.most_dampers is None:
                        more = 0  # numbers of dampers need not be distinguished
                    elif more > self.most_dampers:
                        continue
                    with_damper[more] = with_damper.get(more, 0) + layouts
            column = with_damper
            done = {key: whole.get(key, 0) + with_damper.get(key, 0) for key in {*whole, *with_damper}}
        return sum(done.values())

    def neighbours(self, layout: Layout, changes: int = 2) -> Iterator[Layout]:
        """Yield the allowed layouts that differ from one in one position, or in up to two.

        Args:
            layout: the option at each position.
            changes: the largest number of positions that differ, 1 or 2.
        """
        for i, at in enumerate(self.positions):
            for option in (0, *at.options):
                if option == layout[i]:
                    continue
                one = (*layout[:i], option, *layout[i + 1 :])
                if self.allowed(one):
                    yield one
                if changes < 2:
                    continue
                for j in range(i + 1, len(self.positions)):
                    for other in (0, *self.positions[j].options):
                        two = (*one[:j], other, *one[j + 1 :])
                        if other != layout[j] and self.allowed(two):
                            yield two

    def listed(self, most: int | None, at_most: int = MOST_LISTED) -> np.ndarray | None:
        """Return all layouts up to a cost, (layouts, positions); None if there are too many.

        Args:
            most: cost that is not exceeded, in units of the prices; None: whatever the cost.
            at_most: how many are too many.
        """
        if most is not None and most < 0:
            return np.empty((0, len(self.positions)), dtype=np.int8)
        found: list[Layout] = []
        # each layout is made once, from the one without its last equipped position; more dampers cost more
        open_layouts = [(self.empty, 0, 0, 0, frozenset[int](), frozenset[tuple[str, int]]())]
        while open_layouts:
            layout, first, own, dampers, storeys, bays = open_layouts.pop()
            found.append(layout)
            if len(found) > at_most:
                return None
            for i in range(first, len(self.positions)):
                at = self.positions[i]
                if at.below is not None and not layout[at.below]:
                    continue
                with_storeys, with_bays = storeys | self._storeys[i], bays | self._bays[i]
                shared = self.prices.storey * len(with_storeys) + self.prices.bay * len(with_bays)
                for option in at.options:
                    cost = own + self.prices.items[option] * len(at.places)
                    count = dampers + self._dampers_at(i, option)
                    too_many = self.most_dampers is not None and count > self.most_dampers
                    if not too_many and (most is None or cost + shared <= most):
                        larger = (*layout[:i], option, *layout[i + 1 :])
                        open_layouts.append((larger, i + 1, cost, count, with_storeys, with_bays))
        return np.array(found, dtype=np.int8)

    def below_some(self, layouts: np.ndarray, larger: np.ndarray) -> np.ndarray:
        """Return which layouts have nowhere more than at least one of others, (n,).

        Args:
            layouts: (n, positions).
            larger: (m, positions).
        """
        below = np.zeros(len(layouts), dtype=bool)
        for other in larger:
            left = np.flatnonzero(~below)
            below[left] = np.all(self.not_larger[layouts[left], other], axis=1)
        return below

    def above_all(self, layout: Layout) -> bool:
        """Return whether every layout has nowhere more than one."""
        return all(
            self.not_larger[other, option]
            for at, option in zip(self.positions, layout, strict=True)
            for other in (0, *at.options)
        )

    @cached_property
    def _storeys(self) -> tuple[frozenset[int], ...]:
        return tuple(frozenset(place.storey for place in at.places) for at in self.positions)

    @cached_property
    def _bays(self) -> tuple[frozenset[tuple[str, int]], ...]:
        return tuple(frozenset((place.frame, place.bay) for place in at.places) for at in self.positions)

    def _dampers_at(self, position: int, option: int) -> int:
        return self.numbers[option] * len(self.positions[position].places)


@dataclass(frozen=True)
class Stack:
    """Bays over the storeys that are equipped alike in each of them.

    Attributes:
        places: from the lowest storey up.
        last_bay: of their frames, for layouts that are symmetric about the middle of these; None: others.
    """

    places: tuple[BayPlace, ...]
    last_bay: int | None = None

    def leaning(self, place: BayPlace) -> bool:
        """Return whether diagonals of a place lean the other way."""
        return self.last_bay is not None and 2 * place.bay > self.last_bay + 1

    @property
    def has_middle(self) -> bool:
        """Whether a bay is its own mirror image."""
        return self.last_bay is not None and any(2 * place.bay == self.last_bay + 1 for place in self.places)


def make_positions(
    stacks: Iterable[Stack],
    options: Sequence[int],
    continuous: bool,
    groups: Sequence[Sequence[int]],
    leaning: Sequence[int],
) -> tuple[Position, ...]:
    """Return the positions of candidate places.

    Args:
        options: numbers of the items, from 1.
        continuous: whether no position is equipped above an empty one.
        groups: storeys that are equipped alike.
        leaning: options of diagonals, which have no mirror image of their own in the middle bay.

    Returns:
        The positions, stack by stack, each from the lowest storey up.
    """
    alike = {storey: tuple(group) for group in groups for storey in group}
    found: list[Position] = []
    for stack in stacks:
        allowed = tuple(one for one in options if not (stack.has_middle and one in leaning))
        rows = dict.fromkeys(alike.get(place.storey, (place.storey,)) for place in stack.places)
        for i, row in enumerate(rows):
            places = tuple(place for storey in row for place in stack.places if place.storey == storey)
            below = len(found) - 1 if continuous and i else None
            found.append(Position(places, tuple(map(stack.leaning, places)), allowed, below))
    return tuple(found)
