"""What stands where, by name, whether in a plane frame or in a building."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple, Protocol

from edesign.project.notation.frames import Direction, FrameSelection
from edesign.project.notation.selections import NumberSelection


class Run(Protocol):
    """Section and material of members."""

    @property
    def section(self) -> str:
        """Name of the section."""

    @property
    def material(self) -> str:
        """Name of the material."""


class InBays(Protocol):
    """What stands in bays and storeys, of a building in frames of one direction."""

    @property
    def along(self) -> Direction | None:
        """Direction of the frames; None in a plane frame."""

    @property
    def frames(self) -> FrameSelection | None:
        """Frames of this direction; None in a plane frame."""

    @property
    def bays(self) -> NumberSelection:
        """Bays, counted from 1."""

    @property
    def storeys(self) -> NumberSelection:
        """Storeys, counted from 1."""


class BayPlace(NamedTuple):
    """A bay in a storey; `frame` is the name of the plane frame of a building, "" of a project."""

    frame: str
    bay: int
    storey: int


class Grid(Protocol):
    """Members and nodes by name; `Frame` and `Layout` are such grids."""

    @property
    def n_storeys(self) -> int:
        """The number of storeys."""

    @property
    def storey_heights(self) -> tuple[float, ...]:
        """Height of each storey, bottom to top, m."""

    @property
    def levels(self) -> tuple[float, ...]:
        """Level of each floor from the base (floor 0) to the roof, m."""

    @property
    def height(self) -> float:
        """Level of the roof above the base, m."""

    @property
    def lines(self) -> tuple[str, ...]:
        """Names of the column lines: A, B, ... of a frame, A1, A2, ... of a building."""

    def lines_in(self, name: str) -> tuple[str, ...]:
        """Return the column lines that a name stands for: a line, or of a building a selection of them."""

    def lines_of(self, chosen: Any) -> tuple[str, ...]:
        """Return the names of the column lines of a selection of lines, or of a building of column lines."""

    def line_place(self, line: str) -> tuple[float, ...]:
        """Return the place of a column line in plan, m: x of a frame, x and y of a building."""

    @property
    def nodes(self) -> Mapping[str, tuple[float, ...]]:
        """Coordinates in m of every node that a member needs, by name; the last one is the level."""

    @property
    def members(self) -> Mapping[str, Run]:
        """Every member that stands, by name: columns, then beams, then braces; halves of beams are members."""

    @property
    def ends(self) -> Mapping[str, tuple[str, str]]:
        """Names of the start and end node of every member, by its name."""

    def bay_places(self, chosen: InBays) -> Iterator[BayPlace]:
        """Yield the places of what stands in bays, storey by storey."""

    def damper_names(self, kind: str, place: BayPlace) -> tuple[str, ...]:
        """Return the names of the dampers of a kind in a bay and storey."""

    def node_name(self, line: str, floor: int) -> str:
        """Return the name of the node on a column line at a floor; floor 0 is the base."""
