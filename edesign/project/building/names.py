"""Names of column lines, frames, nodes and members of a building.

Lines across x have letters, lines across y have numbers: column line B3 is the second along x and the third along y.
A plan may have other names for them, which places carry as `axes`.
"""

from __future__ import annotations

from typing import NamedTuple

from edesign.project.notation.axes import Direction, GridAxes


class ColumnLine(NamedTuple):
    """A vertical line of columns; both numbers count from 0."""

    i: int
    j: int
    axes: GridAxes

    def __str__(self) -> str:
        return f"{self.axes.name('x', self.i)}{self.axes.name('y', self.j)}"

    def frame(self, along: Direction) -> int:
        """Return the number of the frame along a direction in which it stands, from 0."""
        return self.j if along == "x" else self.i


class BeamPlace(NamedTuple):
    """The place of a beam: frame counts from 0, bay and floor from 1."""

    along: Direction
    frame: int
    bay: int
    floor: int
    axes: GridAxes

    def __str__(self) -> str:
        return f"B{self.along.upper()}_{line_label(self.along, self.frame, self.axes)}_{self.bay}_{self.floor}"

    @property
    def lines(self) -> tuple[ColumnLine, ColumnLine]:
        """The column lines at its start and end."""
        return bay_lines(self.along, self.frame, self.bay, self.axes)


class BracePlace(NamedTuple):
    """The place of a brace: frame counts from 0, bay and storey from 1."""

    along: Direction
    frame: int
    bay: int
    storey: int
    axes: GridAxes

    def __str__(self) -> str:
        return f"D{self.along.upper()}_{line_label(self.along, self.frame, self.axes)}_{self.bay}_{self.storey}"

    def name(self, way: str) -> str:
        """Return the name of the brace that goes one way, `r` rising or `f` falling."""
        return f"{self}_{way}"

    @property
    def lines(self) -> tuple[ColumnLine, ColumnLine]:
        """The column lines of its bay."""
        return bay_lines(self.along, self.frame, self.bay, self.axes)


def bay_lines(along: Direction, frame: int, bay: int, axes: GridAxes) -> tuple[ColumnLine, ColumnLine]:
    """Return the column lines at the two ends of a bay of a frame.

    Args:
        along: direction of the frame, x or y.
        frame: number of the frame, from 0.
        bay: number of the bay, from 1.
    """
    if along == "x":
        return ColumnLine(bay - 1, frame, axes), ColumnLine(bay, frame, axes)
    return ColumnLine(frame, bay - 1, axes), ColumnLine(frame, bay, axes)


def line_label(along: Direction, frame: int, axes: GridAxes) -> str:
    """Return the label of the grid line of a frame: `2` of a frame along x, `A` of one along y.

    Args:
        along: direction of the frame, x or y.
        frame: number of the frame, from 0.
    """
    return axes.name("y" if along == "x" else "x", frame)


def frame_name(along: Direction, frame: int, axes: GridAxes) -> str:
    """Return the name of a plane frame: `X2` along x on line 2, `YA` along y on line A.

    Args:
        along: direction of the frame, x or y.
        frame: number of the frame, from 0.
    """
    return along.upper() + line_label(along, frame, axes)


def node_name(line: ColumnLine | str, floor: int) -> str:
    """Return the name of a node: `A2.3` on column line A2 at floor 3.

    Args:
        floor: number of the floor; 0 is the base.
    """
    return f"{line}.{floor}"


def column_name(line: ColumnLine, storey: int) -> str:
    """Return the name of a column: `C_A2_3` on column line A2 in storey 3.

    Args:
        storey: number of the storey, from 1.
    """
    return f"C_{line}_{storey}"
