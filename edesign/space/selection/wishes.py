"""What a fabricator asks of a choice: one nominal depth along a line, few different sections, few splices."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations, product

from edesign.frame.sections.steel_section import steel_section
from edesign.project.building.design import KINDS, Select
from edesign.space.selection.groups import Group
from edesign.space.structure.frame import SpaceFrame

DEPTHS = 3
"""Nominal depths by which a line becomes lower or higher in one step."""
Exchange = tuple[tuple[int, int], ...]
"""Groups with the numbers of their new sections."""


@dataclass(frozen=True)
class Wishes:
    """Wishes of a file; of one without them all choices are allowed, and nothing goes together.

    Attributes:
        groups: of members.
        lines: groups whose sections have one nominal depth, each group in one line at most.
        most: groups of a kind, and how many different sections they may have.
        spliced: pairs of groups (upper, lower) of columns, and how many columns of them stand on each other.
        joined: whether a splice where the section of a column changes has a price.
    """

    groups: tuple[Group, ...]
    lines: tuple[tuple[int, ...], ...] = ()
    most: tuple[tuple[tuple[int, ...], int], ...] = ()
    spliced: tuple[tuple[int, int, int], ...] = ()
    joined: bool = False

    @property
    def bind(self) -> bool:
        """Whether some choices are not allowed."""
        return bool(self.lines or self.most)

    @property
    def free(self) -> Wishes:
        """The same without what is not allowed."""
        return replace(self, lines=(), most=())

    @property
    def widen(self) -> bool:
        """Whether groups are exchanged together, or become larger for less."""
        return self.bind or self.joined

    def met(self, choice: Sequence[int]) -> bool:
        """Return whether a choice is allowed."""
        one_depth = all(len({self._depth(group, choice[group]) for group in line}) == 1 for line in self.lines)
        return one_depth and all(len(self._sections(of, choice)) <= limit for of, limit in self.most)

    def splices(self, choice: Sequence[int]) -> int:
        """Return how many columns have another section than the column below them."""
        return sum(n for upper, lower, n in self.spliced if self._name(upper, choice) != self._name(lower, choice))

    def raised(self, numbers: Sequence[int]) -> list[int] | None:
        """Return an allowed choice whose sections have the area of the given ones at least; None where none is found.

        A line takes the depth that costs least. Of too many sections the one goes that costs least to replace.
        """
        found = list(numbers)
        for _ in range(1 + sum(len(group.sections) for group in self.groups)):  # areas only grow
            if self.met(found):
                return found
            before = list(found)
            for line in self.lines:
                if len({self._depth(group, found[group]) for group in line}) > 1:
                    taken = min(self._at_depths(line, found), key=lambda of: self._cost(line, of), default=None)
                    if taken is None:
                        return None
                    for group, number in zip(line, taken, strict=True):
                        found[group] = number
            for of, limit in self.most:
                while len(self._sections(of, found)) > limit:
                    merged = min(self._merged(of, found), key=lambda exchange: self._more(found, exchange), default=())
                    if not merged:
                        return None
                    for group, number in merged:
                        found[group] = number
            if found == before:
                return None
        return None

    def exchanges(self, base: Sequence[int], single: Iterable[Exchange]) -> Iterator[Exchange]:
        """Yield what is exchanged together, and two of these or of the single exchanges of a choice at once.

        Args:
            single: exchanges of one group.
        """
        bound = list(dict.fromkeys(self._together(base)))
        yield from bound
        for one, other in combinations(dict.fromkeys([*bound, *single]), 2):
            if not {group for group, _ in one} & {group for group, _ in other}:
                yield (*one, *other)

    def _together(self, base: Sequence[int]) -> Iterator[Exchange]:
        for line in self.lines:
            yield from self._other_depths(line, base)
        for of, _ in self.most:
            yield from self._alike(of, base)
        for upper, lower, _ in self.spliced if self.joined else ():
            for group, like in ((upper, lower), (lower, upper)):
                number = self._number(group, self._name(like, base))
                if number is not None and number != base[group]:
                    yield ((group, number),)

    def _other_depths(self, line: tuple[int, ...], base: Sequence[int]) -> Iterator[Exchange]:
        """A line in the depths beside its own: each group with the next larger section, or the next cheaper one."""
        depths = self._depths(line)
        at = depths.index(self._depth(line[0], base[line[0]]))
        for depth in (*depths[max(at - DEPTHS, 0) : at], *depths[at + 1 : at + 1 + DEPTHS]):
            options = []
            for group in line:
                of, now = self.groups[group], base[group]
                here = self._of_depth(group, depth)
                larger = [k for k in here if of.area[k] >= of.area[now]]
                cheaper = [k for k in here if of.cost[k] <= of.cost[now]]
                options.append(dict.fromkeys((*cheaper[-1:], *larger[:1])))
            yield from (tuple(zip(line, numbers, strict=True)) for numbers in product(*options))

    def _alike(self, of: tuple[int, ...], base: Sequence[int]) -> Iterator[Exchange]:
        """Groups with one section take another one, near theirs or in use; each group alone one that is in use."""
        used = self._sections(of, base)
        for section in used:
            same = [group for group in of if self._name(group, base) == section]
            at = base[same[0]]
            near = self.groups[same[0]].sections[max(at - DEPTHS, 0) : at + DEPTHS + 1]
            for name in dict.fromkeys((*near, *used)):
                to = tuple((group, k) for group in same if (k := self._number(group, name)) is not None)
                if name != section and len(to) == len(same):
                    yield to
        for group in of:
            for name in used:
                number = self._number(group, name)
                if number is not None and number != base[group]:
                    yield ((group, number),)

    def _merged(self, of: tuple[int, ...], numbers: Sequence[int]) -> Iterator[Exchange]:
        """Two sections in use replaced by one that is as large in all their groups."""
        used = self._sections(of, numbers)
        every = dict.fromkeys(name for group in of for name in self.groups[group].sections)
        for pair in combinations(used, 2):
            same = [group for group in of if self._name(group, numbers) in pair]
            for name in every:
                to = [(group, number) for group in same if (number := self._number(group, name)) is not None]
                area = [self.groups[group].area for group in same]
                if len(to) == len(same) and all(
                    of_group[number] >= of_group[numbers[group]]
                    for of_group, (group, number) in zip(area, to, strict=True)
                ):
                    yield tuple(to)

    def _at_depths(self, line: tuple[int, ...], numbers: Sequence[int]) -> Iterator[tuple[int, ...]]:
        """A line in each of its depths with the cheapest sections that are as large."""
        for depth in self._depths(line):
            fits = [
                [k for k in self._of_depth(g, depth) if self.groups[g].area[k] >= self.groups[g].area[numbers[g]]]
                for g in line
            ]
            if all(fits):
                yield tuple(numbers[0] for numbers in fits)

    def _cost(self, line: Sequence[int], numbers: Sequence[int]) -> float:
        return math.fsum(self.groups[group].cost[number] for group, number in zip(line, numbers, strict=True))

    def _more(self, numbers: Sequence[int], exchange: Exchange) -> float:
        return math.fsum(self.groups[g].cost[k] - self.groups[g].cost[numbers[g]] for g, k in exchange)

    def _depths(self, line: Sequence[int]) -> list[int]:
        """The depths that all groups of a line have sections of."""
        every = [{nominal_depth(name) for name in self.groups[group].sections} for group in line]
        return sorted(set.intersection(*every))

    def _of_depth(self, group: int, depth: int) -> list[int]:
        return [k for k, name in enumerate(self.groups[group].sections) if nominal_depth(name) == depth]

    def _depth(self, group: int, number: int) -> int:
        return nominal_depth(self.groups[group].sections[number])

    def _name(self, group: int, choice: Sequence[int]) -> str:
        return self.groups[group].sections[choice[group]]

    def _number(self, group: int, section: str) -> int | None:
        of = self.groups[group].sections
        return of.index(section) if section in of else None

    def _sections(self, of: Sequence[int], choice: Sequence[int]) -> list[str]:
        """The different sections of groups."""
        return list(dict.fromkeys(self._name(group, choice) for group in of))


def nominal_depth(section: str) -> int:
    """Return the nominal depth of a section, the first number of its name: 300 of HEB300, 18 of W18X50.

    Of a name without number it is the depth itself, mm.
    """
    number = re.search(r"[0-9]+", section)
    return int(number[0]) if number else round(1e3 * steel_section(section).h)


def wishes_of(select: Select, frame: SpaceFrame, groups: Sequence[Group]) -> Wishes:
    """Return the wishes of a file.

    Args:
        frame: the building's.
        groups: of its members.
    """
    number = {group.name: i for i, group in enumerate(groups)}
    spliced = _spliced(frame, number)
    lines: list[tuple[int, ...]] = []
    if "columns" in select.same_depth:
        lines += _connected((upper, lower) for upper, lower in spliced)
    if "beams" in select.same_depth:
        lines += _connected(_beside(frame, number))
    kinds: Mapping[str, list[int]] = {
        kind: [i for i, group in enumerate(groups) if kind in (f"{group.kind}s", "all")] for kind in (*KINDS, "all")
    }
    most = tuple((tuple(kinds[kind]), limit) for kind, limit in select.most_sections.items() if kinds[kind])
    pairs = tuple((upper, lower, count) for (upper, lower), count in sorted(spliced.items()))
    return Wishes(tuple(groups), tuple(lines), most, pairs, bool(select.prices_each.splice))


def _spliced(frame: SpaceFrame, number: Mapping[str, int]) -> dict[tuple[int, int], int]:
    """Pairs of groups (upper, lower) of columns that stand on each other, and how many of these columns there are."""
    columns = [member for member in frame.members if member.kind == "column"]
    below = {member.end: member.group for member in columns}
    found: dict[tuple[int, int], int] = {}
    for member in columns:
        if (lower := below.get(member.start)) is not None and lower != member.group:
            pair = number[member.group], number[lower]
            found[pair] = found.get(pair, 0) + 1
    return found


def _beside(frame: SpaceFrame, number: Mapping[str, int]) -> Iterator[tuple[int, int]]:
    """Pairs of groups of beams that meet in one frame at a floor."""
    beams = [member for member in frame.members if member.kind == "beam"]
    ends = {(frame_name, member.end): member.group for member in beams for frame_name in member.frame}
    for member in beams:
        for frame_name in member.frame:
            if (left := ends.get((frame_name, member.start))) is not None and left != member.group:
                yield number[left], number[member.group]


def _connected(pairs: Iterable[tuple[int, int]]) -> list[tuple[int, ...]]:
    """The sets of numbers that pairs connect, each ascending."""
    found: list[set[int]] = []
    for pair in pairs:
        meeting = [one for one in found if one & set(pair)]
        found = [one for one in found if one not in meeting] + [set(pair).union(*meeting)]
    return sorted(tuple(sorted(one)) for one in found)
