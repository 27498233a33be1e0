"""Plane frames of a building, by their grid lines: `2`, `A-C`, `X2`."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any

from edesign.project.notation.axes import COLUMN_LINE, LETTERED, NUMBERED, Direction, GridAxes, Span
from edesign.project.notation.selections import items_of, selection, written
from edesign.project.notation.written import Written
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen

_ONE = rf"(?:([XY])(?=[A-Z0-9]))?({LETTERED}|{NUMBERED})"
_FRAME = re.compile(rf"\s*{_ONE}\s*(?:-\s*{_ONE}\s*)?")


@dataclass(frozen=True)
class FrameItem:
    """Frames of one direction by the names of their grid lines; `text` as written."""

    text: str
    along: Direction
    ends: tuple[str, str]

    def span(self, axes: GridAxes) -> Span | None:
        """Return the numbers of the first and the last frame; None: there is no such frame."""
        return axes.span("y" if self.along == "x" else "x", self.ends)


@dataclass(frozen=True)
class FrameSelection:
    """Frames given by their grid lines; without items all of a direction."""

    items: tuple[FrameItem, ...] = ()

    @property
    def is_all(self) -> bool:
        """Whether every frame of the direction is selected."""
        return not self.items

    def numbers(self, count: int, axes: GridAxes) -> tuple[int, ...]:
        """Return the selected ones of the frames 0 to count - 1 of a direction."""
        spans = [span for item in self.items if (span := item.span(axes)) is not None]
        return tuple(n for n in range(count) if self.is_all or any(a <= n <= b for a, b in spans))

    def __str__(self) -> str:
        """The selection as it may be written in a file."""
        return "all" if self.is_all else written([item.text for item in self.items])


def parse_frames(value: Any) -> FrameSelection:
    """Read a selection of frames.

    Raises:
        PydanticCustomError: not a selection.
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
            rf"[XY]?(?:{LETTERED}|{NUMBERED})(?:\s*-\s*[XY]?(?:{LETTERED}|{NUMBERED}))?",
            ("all",),
            "`all`, `2`, `A`, `A-C` or `[X1, X4]`",
            True,
        ),
    ),
]
ALL_FRAMES = FrameSelection()


def frames_of_line(line: str) -> tuple[str, ...]:
    """Return the plane frames that a column line stands in: X2 and YA of A2; none of a line of a plane frame."""
    found = COLUMN_LINE.fullmatch(line)
    return (f"X{found[2]}", f"Y{found[1]}") if found is not None else ()


def frames_of_member(name: str) -> tuple[str, ...]:
    """Return the plane frames of a building that a member or damper stands in, by its name.

    A column C_A2_3 stands in two, X2 and YA; BX_2_1_5, DX_2_1_3_r and VX_2_1_3 in X2; members of a plane frame in none.
    """
    kind, *parts = name.split("_")
    if kind == "C":
        return frames_of_line(parts[0])
    return (kind[1] + parts[0],) if kind[1:] in ("X", "Y") else ()


def _frames(item: Any, at: tuple[int, ...]) -> FrameItem:
    match = _FRAME.fullmatch(str(item)) if isinstance(item, (str, int)) and not isinstance(item, bool) else None
    if not match:
        raise refuse(
            f"{as_seen(item)} is no selection of frames; write `all`, `2`, `A`, `A-C` or `[X1, X4]` [E-VALUE-01]", *at
        )
    said, first, said_last, last = match.groups()
    last = last or first
    if first[0].isdigit() != last[0].isdigit():
        raise refuse(f"`{item}`: both ends of a range are written alike, as `A-C` or `1-2` [E-VALUE-01]", *at)
    along: Direction = "x" if first[0].isdigit() else "y"
    if any(letter not in (None, along.upper()) for letter in (said, said_last)):
        raise refuse(
            f"`{item}`: frames along x have numbers (`X2`), frames along y have letters (`YA`) [E-VALUE-01]", *at
        )
    return FrameItem(str(item).strip(), along, (first, last))
