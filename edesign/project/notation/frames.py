"""Plane frames of a building, by their grid lines: `2`, `A-C`, `X2`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from edesign.project.notation.names import line_index
from edesign.project.notation.selections import items_of, selection, written
from edesign.project.notation.written import Written
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen

Direction = Literal["x", "y"]

_FRAME = re.compile(
    r"\s*(?:([XY])(?=[A-Z0-9]))?([A-Z]{1,2}|[0-9]{1,3})\s*(?:-\s*([XY](?=[A-Z0-9]))?([A-Z]{1,2}|[0-9]{1,3})\s*)?"
)

Span = tuple[int, int]
"""First and last, counted from 0."""


@dataclass(frozen=True)
class FrameItem:
    """Frames of one direction; `text` as written."""

    text: str
    along: Direction
    span: Span


@dataclass(frozen=True)
class FrameSelection:
    """Frames given by their grid lines; without items all of a direction."""

    items: tuple[FrameItem, ...] = ()

    @property
    def is_all(self) -> bool:
        """Whether every frame of the direction is selected."""
        return not self.items

    def numbers(self, count: int) -> tuple[int, ...]:
        """Return the selected ones of the frames 0 to count - 1 of a direction."""
        return tuple(n for n in range(count) if self.is_all or any(within(n, item.span) for item in self.items))

    def __str__(self) -> str:
        """The selection as it may be written in a file."""
        return "all" if self.is_all else written([item.text for item in self.items])


def parse_frames(value: Any) -> FrameSelection:
    """Read a selection of frames.

    Raises:
        PydanticCustomError: not a selection, or a range that runs backwards.
    """
    if isinstance(value, FrameSelection):
        return value
    if value == "all":
        return FrameSelection()
    return FrameSelection(tuple(_frames(item, at) for item, at in items_of(value, "A-C")))


Frames = Annotated[
    FrameSelection,
    Written(
        parse_frames,
        selection(
            "selection of frames",
            r"[XY]?(?:[A-Z]{1,2}|[0-9]{1,3})(?:\s*-\s*[XY]?(?:[A-Z]{1,2}|[0-9]{1,3}))?",
            ("all",),
            "`all`, `2`, `A`, `A-C` or `[X1, X4]`",
            True,
        ),
    ),
]
ALL_FRAMES = FrameSelection()


_LINE = re.compile(r"([A-Z]+)([0-9]+)")


def frames_of_line(line: str) -> tuple[str, ...]:
    """Return the plane frames that a column line stands in: X2 and YA of A2; none of a line of a plane frame."""
    found = _LINE.fullmatch(line)
    return (f"X{found[2]}", f"Y{found[1]}") if found is not None else ()


def frames_of_member(name: str) -> tuple[str, ...]:
    """Return the plane frames of a building that a member or damper stands in, by its name.

    A column C_A2_3 stands in two, X2 and YA; BX_2_1_5, DX_2_1_3_r and VX_2_1_3 in X2; members of a plane frame in none.
    """
    kind, *parts = name.split("_")
    if kind == "C":
        return frames_of_line(parts[0])
    return (kind[1] + parts[0],) if kind[1:] in ("X", "Y") else ()


def within(number: int, span: Span | None) -> bool:
    """Return whether a number is in a span; None takes all."""
    return span is None or span[0] <= number <= span[1]


def _frames(item: Any, at: tuple[int, ...]) -> FrameItem:
    match = None if isinstance(item, (bool, float, list, tuple, dict)) else _FRAME.fullmatch(str(item))
    if not match:
        raise refuse(
            f"{as_seen(item)} is no selection of frames; write `all`, `2`, `A`, `A-C` or `[X1, X4]` [E-VALUE-01]", *at
        )
    said, first, said_last, last = match.groups()
    last = last or first
    if first.isdigit() != last.isdigit():
        raise refuse(f"`{item}`: both ends of a range are written alike, as `A-C` or `1-2` [E-VALUE-01]", *at)
    along: Direction = "x" if first.isdigit() else "y"
    if any(letter not in (None, along.upper()) for letter in (said, said_last)):
        raise refuse(
            f"`{item}`: frames along x have numbers (`X2`), frames along y have letters (`YA`) [E-VALUE-01]", *at
        )
    numbers = [line_number(end, item, at) if along == "x" else line_index(end) for end in (first, last)]
    return FrameItem(str(item).strip(), along, span_of(item, numbers[0], numbers[1], at))


def line_number(text: str, item: Any, at: tuple[int, ...]) -> int:
    """Return the number of a line across y from 0, which is written from 1.

    Args:
        item: that it is a part of.
        at: place of the item in a list.

    Raises:
        PydanticCustomError: it is 0.
    """
    if int(text) < 1:
        raise refuse(f"`{item}`: lines across y are numbered from 1 [E-VALUE-01]", *at)
    return int(text) - 1


def span_of(item: Any, first: int, last: int, at: tuple[int, ...]) -> Span:
    """Return a span that does not run backwards.

    Args:
        first, last: numbers of its ends, from 0.
        at: place of the item in a list.

    Raises:
        PydanticCustomError: it runs backwards.
    """
    if first > last:
        raise refuse(f"the range `{item}` runs backwards [E-VALUE-04]", *at)
    return first, last
