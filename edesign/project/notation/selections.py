"""Selections of storeys, floors, bays, points and lines: `all`, `3`, `1-4`, `[1, 3, 5-7]`, `A-D`, `[A, D]`."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from edesign.project.notation.names import LINE, line_index, plain_line
from edesign.project.notation.written import SHARED, SchemaMaker, Written, given
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen

_NUMBER_RANGE = re.compile(r"\s*([0-9]{1,6})\s*(?:-\s*([0-9]{1,6})\s*)?")
_LINE_RANGE = re.compile(rf"\s*({LINE})\s*(?:-\s*({LINE})\s*)?")


@dataclass(frozen=True)
class NumberSelection:
    """Numbers given as ranges, ends included; `is_all` means every number that exists.

    Attributes:
        ranges: (first, last) of each item as written, empty with `is_all` or for `none`.
    """

    ranges: tuple[tuple[int, int], ...] = ()
    is_all: bool = False

    def numbers(self, first: int, last: int) -> tuple[int, ...]:
        """Return the selected numbers among first..last, ascending, each once.

        Args:
            first: the smallest number.
            last: the largest number.
        """
        if self.is_all:
            return tuple(range(first, last + 1))
        found = {n for a, b in self.ranges for n in range(max(a, first), min(b, last) + 1)}
        return tuple(sorted(found))

    def __str__(self) -> str:
        return "all" if self.is_all else written([_span(str(a), str(b)) for a, b in self.ranges])


@dataclass(frozen=True)
class LineSelection:
    """Column lines given as ranges, ends included; `is_all` means every line.

    Attributes:
        ranges: (first, last) of each item as written, empty with `is_all`.
    """

    ranges: tuple[tuple[str, str], ...] = ()
    is_all: bool = False

    def names(self, lines: Sequence[str]) -> tuple[str, ...]:
        """Return the selected lines in the order of `lines`, each once."""
        if self.is_all:
            return tuple(lines)
        place = {line: i for i, line in enumerate(lines)}
        spans = [tuple(place.get(end, _beyond(end)) for end in ends) for ends in self.ranges]
        return tuple(line for line, i in place.items() if any(a <= i <= b for a, b in spans))

    def __str__(self) -> str:
        return "all" if self.is_all else written([_span(a, b) for a, b in self.ranges])


def _beyond(line: str) -> float:
    """The place of a line that the frame does not have: that of its letters; nowhere if it has a name of its own."""
    return line_index(line) if plain_line(line) else math.nan


def parse_numbers(value: Any) -> NumberSelection:
    """Read a selection of numbers.

    Raises:
        PydanticCustomError: not a selection, or a range that runs backwards.
    """
    if isinstance(value, NumberSelection):
        return value
    if value == "all":
        return NumberSelection(is_all=True)
    return NumberSelection(tuple(_number_range(item, at) for item, at in items_of(value, "1-4")))


def parse_numbers_or_none(value: Any) -> NumberSelection:
    """Read a selection of numbers that may also be `none`."""
    return NumberSelection() if value == "none" else parse_numbers(value)


def parse_lines(value: Any) -> LineSelection:
    """Read a selection of column lines.

    Raises:
        PydanticCustomError: not a selection, or a range that runs backwards.
    """
    if isinstance(value, LineSelection):
        return value
    if value == "all":
        return LineSelection(is_all=True)
    return LineSelection(tuple(_line_range(item, at) for item, at in items_of(value, "A-D")))


def selection(title: str, one: str, words: Sequence[str], example: str, numbers: bool) -> SchemaMaker:
    """Return the maker of the schema of a selection.

    Args:
        title: what is selected.
        one: expression of an item that is text.
        words: that stand alone.
        example: for people.
        numbers: whether an item may be a plain number.
    """
    item: dict[str, Any] = {
        "type": "string",
        "pattern": rf"^\s*(?:{one})\s*$",
        "patternErrorMessage": f"a {title} is written like {example}",
    }
    alone = {**item, "pattern": rf"^\s*(?:{'|'.join([*words, one])})\s*$"}
    number: list[dict[str, Any]] = [{"type": "integer", "minimum": 0}] if numbers else []
    each = {"anyOf": [item, *number]} if numbers else item
    several = {"type": "array", "minItems": 1, "items": each}
    shown = re.findall(r"`(\w+-\w+)`", example)[:1]
    return given({"title": title, "anyOf": [alone, *number, several], "examples": shown, SHARED: title})


_NUMBERS = r"[0-9]{1,6}(?:\s*-\s*[0-9]{1,6})?"
_SHOWN = "`all`, `3`, `1-4` or `[1, 3, 5-7]`"
SELECTED_NUMBERS = selection("selection of numbers", _NUMBERS, ("all",), _SHOWN, True)
Numbers = Annotated[NumberSelection, Written(parse_numbers, SELECTED_NUMBERS)]
NumbersOrNone = Annotated[
    NumberSelection,
    Written(
        parse_numbers_or_none,
        selection("selection of numbers, or none", _NUMBERS, ("all", "none"), f"`none`, {_SHOWN}", True),
    ),
]
Lines = Annotated[
    LineSelection,
    Written(
        parse_lines,
        selection(
            "selection of lines",
            rf"{LINE}(?:\s*-\s*{LINE})?",
            ("all",),
            "`all`, `B`, `A-D` or `[A, C-D]`",
            False,
        ),
    ),
]

ALL_NUMBERS = NumberSelection(is_all=True)
NO_NUMBERS = NumberSelection()
ALL_LINES = LineSelection(is_all=True)


def items_of(value: Any, example: str) -> list[tuple[Any, tuple[int, ...]]]:
    """Return the items of a selection with their path below it.

    Args:
        value: of the file: one item, or a list.
        example: a range, for the message.

    Raises:
        PydanticCustomError: the list is empty.
    """
    if isinstance(value, (list, tuple)):
        if not value:
            raise refuse(
                f"the list is empty; write `all`, one, a range such as `{example}`, or a list of these [E-VALUE-01]"
            )
        return [(item, (i,)) for i, item in enumerate(value)]
    return [(value, ())]


def _number_range(item: Any, at: tuple[int, ...]) -> tuple[int, int]:
    match = None if isinstance(item, (bool, float)) else _NUMBER_RANGE.fullmatch(str(item))
    if not match:
        raise refuse(f"{as_seen(item)} is no selection; write `all`, `3`, `1-4` or `[1, 3, 5-7]` [E-VALUE-01]", *at)
    first, last = int(match[1]), int(match[2] or match[1])
    if first > last:
        raise refuse(f"the range `{item}` runs backwards; write `{last}-{first}` [E-VALUE-04]", *at)
    return first, last


def _line_range(item: Any, at: tuple[int, ...]) -> tuple[str, str]:
    match = _LINE_RANGE.fullmatch(item) if isinstance(item, str) else None
    if not match:
        raise refuse(
            f"{as_seen(item)} is no selection of lines; write `all`, `B`, `A-D` or `[A, C-D]` [E-VALUE-01]", *at
        )
    first, last = match[1], match[2] or match[1]
    if plain_line(first) and plain_line(last) and line_index(first) > line_index(last):
        raise refuse(f"the range `{item}` runs backwards; write `{last}-{first}` [E-VALUE-04]", *at)
    return first, last


def _span(first: str, last: str) -> str:
    return first if first == last else f"{first}-{last}"


def written(items: list[str]) -> str:
    """Return items of a selection as they may be written in a file: one, or a list."""
    if not items:
        return "none"
    return items[0] if len(items) == 1 else f"[{', '.join(items)}]"
