"""Selections in a building: column lines (`A2`, `A-C`, `A1-C2`) and bays in plan."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Any

from edesign.project.building.names import ColumnLine
from edesign.project.notation.axes import LETTERED, NUMBERED, Direction, GridAxes, Span
from edesign.project.notation.selections import ALL_NUMBERS, Numbers, items_of, selection
from edesign.project.notation.written import Written
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import as_seen

_END = rf"({LETTERED})?({NUMBERED})?"
_LINES = re.compile(rf"\s*{_END}\s*(?:-\s*{_END}\s*)?")


@dataclass(frozen=True)
class ColumnLineItem:
    """A block of column lines by the names of its first and last grid lines; None takes all of that direction."""

    text: str
    x: tuple[str, str] | None
    y: tuple[str, str] | None

    def spans(self, axes: GridAxes) -> Iterator[tuple[Direction, Span | None]]:
        """Yield directions with the first and last grid line across each; None: there is no such line."""
        if self.x is not None:
            yield "x", axes.span("x", self.x)
        if self.y is not None:
            yield "y", axes.span("y", self.y)

    def __contains__(self, line: ColumnLine) -> bool:
        at = {"x": line.i, "y": line.j}
        return all(span is not None and span[0] <= at[way] <= span[1] for way, span in self.spans(line.axes))


@dataclass(frozen=True)
class ColumnLineSelection:
    """Column lines given as blocks; without items all of them."""

    items: tuple[ColumnLineItem, ...] = ()

    @property
    def is_all(self) -> bool:
        """Whether every column line is selected."""
        return not self.items

    def __contains__(self, line: ColumnLine) -> bool:
        return self.is_all or any(line in item for item in self.items)

    def lines(self, n_x: int, n_y: int, axes: GridAxes) -> Iterator[ColumnLine]:
        """Yield the selected ones of the column lines of a plan, each once.

        Args:
            n_x: number of lines along x.
            n_y: number of lines along y.
        """
        return (line for i in range(n_x) for j in range(n_y) if (line := ColumnLine(i, j, axes)) in self)


class Panels(Model):
    """Bays of the plan: those of some bays along x and some along y.

    Attributes:
        x: bays along x, counted from 1.
        y: bays along y, counted from 1.
    """

    x: Numbers = ALL_NUMBERS
    y: Numbers = ALL_NUMBERS

    @property
    def is_all(self) -> bool:
        """Whether every bay of the plan is selected."""
        return self.x.is_all and self.y.is_all

    def numbers(self, n_x: int, n_y: int) -> Iterator[tuple[int, int]]:
        """Yield the selected bays (along x, along y) of a plan; both count from 1."""
        for i in self.x.numbers(1, n_x):
            for j in self.y.numbers(1, n_y):
                yield i, j


def parse_column_lines(value: Any) -> ColumnLineSelection:
    """Read a selection of column lines.

    Raises:
        PydanticCustomError: not a selection.
    """
    if isinstance(value, ColumnLineSelection):
        return value
    if value == "all":
        return ColumnLineSelection()
    return ColumnLineSelection(tuple(_column_lines(item, at) for item, at in items_of(value, "A1-C2")))


def _panels(value: Any) -> Any:
    """`all` and a single block of bays are lists of one."""
    if value == "all":
        return ({},)
    return (value,) if isinstance(value, dict) else value


ColumnLines = Annotated[
    ColumnLineSelection,
    Written(
        parse_column_lines,
        selection(
            "selection of column lines",
            rf"(?=[A-Z0-9])(?:{LETTERED})?(?:{NUMBERED})?(?:\s*-\s*(?:{LETTERED})?(?:{NUMBERED})?)?",
            ("all",),
            "`all`, `A2`, `A`, `2` or `A1-C2`",
            True,
        ),
    ),
]
Bays = Annotated[
    tuple[Panels, ...], Written(_panels, lambda inner: {"anyOf": [{"const": "all"}, inner()["items"], inner()]})
]

ALL_COLUMN_LINES = ColumnLineSelection()
ALL_BAYS = (Panels(),)


def panels_in(bays: tuple[Panels, ...], n_x: int, n_y: int) -> frozenset[tuple[int, int]]:
    """Return the bays (along x, along y) of a plan that a selection takes."""
    return frozenset(place for block in bays for place in block.numbers(n_x, n_y))


def parts_of(panels: frozenset[tuple[int, int]]) -> tuple[frozenset[tuple[int, int]], ...]:
    """Return the parts of some bays of a plan that hang together by common sides, that with the first bay first."""
    found, left = [], set(panels)
    while left:
        part, edge = set[tuple[int, int]](), {min(left)}
        while edge:
            part |= edge
            beside = {(i + a, j + b) for i, j in edge for a, b in ((1, 0), (-1, 0), (0, 1), (0, -1))}
            edge = (beside & left) - part
        found.append(frozenset(part))
        left -= part
    return tuple(found)


def _column_lines(item: Any, at: tuple[int, ...]) -> ColumnLineItem:
    match = _LINES.fullmatch(str(item)) if isinstance(item, (str, int)) and not isinstance(item, bool) else None
    if not match or not any(match.groups()):
        raise refuse(
            f"{as_seen(item)} is no selection of column lines; write `all`, `A2`, `A`, `2`, `A1-C2` [E-VALUE-01]", *at
        )
    letter, number, last_letter, last_number = match.groups()
    ranges = "-" in str(item)
    if ranges and (letter is None, number is None) != (last_letter is None, last_number is None):
        raise refuse(f"`{item}`: both ends of a range are written alike, as `A1-C2`, `A-C` or `1-2` [E-VALUE-01]", *at)
    x = (letter, last_letter or letter) if letter else None
    y = (number, last_number or number) if number else None
    return ColumnLineItem(str(item).strip(), x, y)
