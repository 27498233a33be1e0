"""The elevation of a plane frame of a building: its members, supports and dampers to scale."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from edesign.project.building.building import Building
from edesign.project.building.names import frame_name
from edesign.project.notation.axes import LETTERED, NUMBERED
from edesign.project.notation.frames import Direction, frames_of_line, frames_of_member
from edesign.project.notation.names import base_device_name, isolator_name
from edesign.report.drawing.frame_drawing import (
    DAMPER,
    DamperDrawing,
    Line,
    Point,
    damper_in_bay,
    draw_to_scale,
    straight_damper,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


_IN_BAY = re.compile(rf"([VRFS])([XY])_({LETTERED}|{NUMBERED})_([0-9]+)_([0-9]+)(?:_(r|f))?(?:_[0-9]+)?")


class DamperBay(NamedTuple):
    """What the name of a damper says: kind, axis X or Y, grid line, bay, storey, and half of a chevron (r or f)."""

    kind: str
    axis: str
    line: str
    bay: int
    storey: int
    half: str


def damper_bay(name: str) -> DamperBay | None:
    """Return in which bay a damper of a building stands; None of dampers between nodes.

    Args:
        name: such as VX_2_1_3, or VX_2_1_3_2 of a second one there.
    """
    found = _IN_BAY.fullmatch(name)
    if found is None:
        return None
    kind, axis, line, bay, storey, half = found.groups()
    return DamperBay(kind, axis, line, int(bay), int(storey), half or "")


def frame_names(building: Building) -> list[str]:
    """Return the names of the plane frames of a building, those along x first.

    Args:
        building: as its file says.
    """
    along: tuple[Direction, ...] = ("x", "y")
    return [frame_name(axis, number, building.axes) for axis in along for number in range(building.n_frames(axis))]


@dataclass(frozen=True)
class BuildingElevation:
    """The elevation of one plane frame of a building.

    Attributes:
        building: as its file says.
        name: of the frame, such as X2.
    """

    building: Building
    name: str

    @property
    def _along(self) -> Direction:
        return "x" if self.name.startswith("X") else "y"

    @property
    def width(self) -> float:
        """Of all bays, m."""
        return self.building.coordinates(self._along)[-1]

    @property
    def height(self) -> float:
        """Above the base, m."""
        return self.building.levels[-1]

    @property
    def bay(self) -> float:
        """Width of a mean bay, m."""
        return self.width / self.building.n_bays(self._along)

    @cached_property
    def lines(self) -> Mapping[str, Line]:
        """Start and end of every member by its name, m."""
        ends = self.building.grid.ends
        return {
            member: (self._seen(start), self._seen(end))
            for member, (start, end) in ends.items()
            if self.name in frames_of_member(member)
        }

    def draw(self, axes: Axes, dampers: Sequence[str], isolated: bool = False) -> None:
        """Draw members, supports and the dampers of the frame to scale, without scales and frame of the axes.

        Args:
            axes: in m, with equal scales afterwards.
            dampers: names of those that stand in the frame, without isolators.
            isolated: whether it stands on its isolators, if it has any.
        """
        for name in dampers:
            drawing = self.damper(name)
            for (x0, y0), (x1, y1) in drawing.braces if drawing is not None else ():
                axes.plot((x0, x1), (y0, y1), color=DAMPER, lw=1.4, zorder=1.8)
        bases, isolation = self._bases(), self.building.isolation if isolated else None
        of_base = []
        if isolation is not None:
            lines, grid = tuple(line for line, _, _ in bases), self.building.grid
            of_base = [isolator_name(line) for one in isolation.isolators for line in one.under(lines, grid)]
            beside = (one for one in isolation.beside if self._along in one.axes)
            of_base += [base_device_name(line) for one in beside for line in one.under(lines, grid)]
        draw_to_scale(axes, self, bases, of_base, self.width)

    def damper(self, name: str) -> DamperDrawing | None:
        """Return the lines of a damper; None of one that stands elsewhere, or where there is no such bay or storey.

        Args:
            name: such as VX_2_1_3, or N_A1.0_B1.1 between nodes, which both stand in the frame.
        """
        nodes = self.building.grid.nodes
        if name.startswith("N_"):
            ends = name.split("_")[1:3]
            if not all(node in nodes and self.name in frames_of_line(node.partition(".")[0]) for node in ends):
                return None
            start, end = (self._seen(node) for node in ends)
            return straight_damper(start, end)
        place = damper_bay(name)
        x, levels = self.building.coordinates(self._along), self.building.levels
        if place is None or place.axis + place.line != self.name:
            return None
        if not (1 <= place.bay < len(x) and 1 <= place.storey < len(levels)):
            return None
        bay = x[place.bay - 1], x[place.bay], levels[place.storey - 1], levels[place.storey]
        return damper_in_bay(place.kind, *bay, place.half)

    def _seen(self, node: str) -> Point:
        place = self.building.grid.nodes[node]
        return place["xy".index(self._along)], place[-1]

    def _bases(self) -> list[tuple[str, float, str]]:
        """Lines and places of the column bases of the frame, and whether each is fixed, pinned or on springs in it."""
        found = []
        for line, storey in self.building.layout.column_at:
            frame = frame_name(self._along, line.frame(self._along), line.axes)
            if storey == 1 and frame == self.name:
                support = self.building.support(line)
                turn = getattr(support, "ry" if self._along == "x" else "rx", "footing")
                kind = {"fixed": "fixed", "free": "pinned"}.get(turn, "springs")
                found.append((str(line), self.building.place(line)["xy".index(self._along)], kind))
        return sorted(found, key=lambda base: base[1])
