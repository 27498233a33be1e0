"""Names of the grid lines of a building: those of its plans, or letters across x and numbers across y."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from edesign.project.notation.names import line_index, line_name, plain_line
from edesign.project.notation.written import Written, either, given, text
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen

Direction = Literal["x", "y"]

LETTERED = r"(?![XY][A-Z])[A-Z][A-Za-z']{0,3}"
"""Expression of the name of a grid line across x: `B`, `B'`, `Aa`; `XA` and `YA` are frames."""
NUMBERED = r"[0-9][0-9A-Za-z']{0,3}"
"""Expression of the name of a grid line across y: `2`, `2a`."""
COLUMN_LINE = re.compile(rf"({LETTERED})({NUMBERED})")
"""The name of a column line, with those of its grid lines across x and across y."""

Span = tuple[int, int]
"""First and last, counted from 0."""


@dataclass(frozen=True)
class GridAxes:
    """Names of the grid lines of a building in their order.

    Attributes:
        x: of those across x; empty: A, B, ...
        y: of those across y; empty: 1, 2, ...
    """

    x: tuple[str, ...] = ()
    y: tuple[str, ...] = ()

    def __hash__(self) -> int:
        return len(self.x) + len(self.y)  # places with their axes are keys; those of a building have the same

    def name(self, across: Direction, number: int) -> str:
        """Return the name of a grid line.

        Args:
            across: direction that the line crosses.
            number: of the line, from 0.
        """
        own = self.x if across == "x" else self.y
        if own:
            return own[number] if number < len(own) else "?"
        return line_name(number) if across == "x" else str(number + 1)

    def number(self, across: Direction, name: str) -> int | None:
        """Return the number of a grid line by its name, from 0; None: no line has it.

        Args:
            across: direction that the line crosses.
            name: as a file has it, right in its letters and figures.
        """
        own = self.x if across == "x" else self.y
        if own:
            return own.index(name) if name in own else None
        if across == "x":
            return line_index(name) if plain_line(name) else None
        return int(name) - 1 if name.isdigit() and int(name) > 0 else None

    def span(self, across: Direction, ends: tuple[str, str]) -> Span | None:
        """Return the numbers of the first and the last of a range of grid lines; None: there is no such line.

        Args:
            across: direction that the lines cross.
        """
        first, last = (self.number(across, name) for name in ends)
        return None if first is None or last is None else (first, last)


PLAIN_AXES = GridAxes()
"""A, B, ... across x and 1, 2, ... across y."""


def _lettered(value: Any) -> Any:
    if not isinstance(value, str) or not re.fullmatch(LETTERED, value):
        raise refuse(
            f"{as_seen(value)} names no line across x; write a capital letter, then letters or ', 4 at most, such as "
            "`B` or `B'`, and not `XA`, which is a frame [E-VALUE-01]"
        )
    return value


def _numbered(value: Any) -> Any:
    if isinstance(value, (bool, float)) or not re.fullmatch(rf"(?!0[0-9]){NUMBERED}", str(value)):
        raise refuse(
            f"{as_seen(value)} names no line across y; write a figure, no 0 before others, then figures, "
            "letters or ', 4 at most, such as `2` or `2a` [E-VALUE-01]"
        )
    return str(value)


LetteredAxis = Annotated[str, Written(_lettered, text("name of a line across x", LETTERED, "B", "B'"))]
NumberedAxis = Annotated[
    str,
    Written(
        _numbered,
        either(given({"type": "integer", "minimum": 0}), text("name of a line across y", NUMBERED, "2", "2a")),
    ),
]
