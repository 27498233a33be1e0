"""A frame's elevation: members to scale, braces, dampers."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from edesign.project.frame.frame import Frame
from edesign.project.frame.supports import support_name
from edesign.project.notation import names
from edesign.report.drawing.style import MEAN

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Point = tuple[float, float]
Line = tuple[Point, Point]
STEEL, DAMPER = "#8a8f98", "#3aa08f"
GAP = 0.025  # from the base of an isolated frame to the middle of its isolators, of its height
MARGIN = 0.06  # below and above the frame, of its height
SMALL, SOFT = 6.0, "#5a5f66"  # points and colour of the names of axes
LONG_NAME = 2  # letters of a column line, beyond which names stand upright
SUPPORTS = {"fixed": "s", "pinned": "^", "roller": "o", "springs": "D", "footing": "D"}  # their markers
_SHAPES = {"V": "chevron", "R": "rising", "F": "falling", "S": "storey"}


@dataclass(frozen=True)
class DamperDrawing:
    """A damper in an elevation: the lines of its braces, and where it stands itself, m."""

    braces: tuple[Line, ...]
    at: Point


class Elevation(Protocol):
    """A plane frame as it is drawn: of its own, or one of a building."""

    @property
    def width(self) -> float:
        """Of all bays, m."""

    @property
    def height(self) -> float:
        """Above the base, m."""

    @property
    def bay(self) -> float:
        """Width of a mean bay, m."""

    @property
    def lines(self) -> Mapping[str, Line]:
        """Start and end of every member by its name, m."""

    def damper(self, name: str) -> DamperDrawing | None:
        """Return the lines of a damper by its name; None: it does not stand in this frame."""

    def draw(self, axes: Axes, dampers: Sequence[str], isolated: bool = False) -> None:
        """Draw members, supports and those of the dampers that stand in it to scale."""


@dataclass(frozen=True)
class FrameElevation:
    """The elevation of a plane frame.

    Attributes:
        frame: of the project.
    """

    frame: Frame

    @property
    def width(self) -> float:
        """Of all bays, m."""
        return self.frame.x[-1]

    @property
    def height(self) -> float:
        """Above the base, m."""
        return self.frame.height

    @property
    def bay(self) -> float:
        """Width of a mean bay, m."""
        return self.frame.x[-1] / self.frame.n_bays

    @cached_property
    def lines(self) -> Mapping[str, Line]:
        """Start and end of every member by its name, m; columns start below, beams and braces at the left."""
        frame, found = self.frame, {}
        for line, storey in frame.column_at:
            x = frame.x[frame.lines.index(line)]
            found[names.column_name(line, storey)] = ((x, frame.levels[storey - 1]), (x, frame.levels[storey]))
        ends = {name: (beam.start, beam.end) for name, beam in frame.beam_members.items()}
        ends |= {frame.brace_name(*place): frame.brace_nodes(*place) for place in frame.brace_at}
        return found | {name: (frame.nodes[start], frame.nodes[end]) for name, (start, end) in ends.items()}

    def damper(self, name: str) -> DamperDrawing | None:
        """Return the lines of a damper by its name, such as V_1_3 or N_A0_B1; None if the frame has no such place."""
        frame = self.frame
        kind, first, second, *_ = [*name.split("_"), "", ""]
        if kind == "N":
            known = first in frame.nodes and second in frame.nodes
            return straight_damper(frame.nodes[first], frame.nodes[second]) if known else None
        if kind[0] not in _SHAPES or (place := names.bay_of(name)) is None:
            return None
        of_building, number, storey, way = place
        bay = frame.bay_named(of_building, number)
        if bay is None or not 1 <= storey <= frame.n_storeys:
            return None
        left, right, low, high = frame.x[bay - 1], frame.x[bay], frame.levels[storey - 1], frame.levels[storey]
        return damper_in_bay(kind[0], left, right, low, high, way)

    def draw(self, axes: Axes, dampers: Sequence[str], isolated: bool = False) -> None:
        """Draw the frame to scale; its isolators are among the dampers.

        Args:
            axes: in m, with equal scales afterwards.
        """
        frame = self.frame
        for name in dampers:
            draw_damper(axes, self.damper(name))
        bases = [
            (line, x, support_name(frame.support(line)) if (line, 1) in frame.column_at else "")
            for line, x in zip(frame.lines, frame.x, strict=True)
            if names.node_name(line, 0) in frame.nodes
        ]
        right = self.width
        if frame.leaning_column is not None:
            right += 0.5 * frame.bay_widths[-1]
            _draw_leaning_column(axes, frame, right)
        of_base = dampers if any(name.startswith("I_") for name in dampers) else ()
        draw_to_scale(axes, self, bases, of_base, right)


def draw_to_scale(
    axes: Axes, elevation: Elevation, bases: Sequence[tuple[str, float, str]], of_base: Collection[str], right: float
) -> None:
    """Draw members, and what they stand on: signs of supports, or a base on isolators; without scales and frame.

    Args:
        axes: in m, with equal scales afterwards.
        bases: column bases from the left: line, place in m, and kind of the support, one of `SUPPORTS`; "": none.
        of_base: names of isolators, and of what acts beside them; (): the frame is not isolated.
        right: end of what is drawn, m.
    """
    for braces, width in ((True, 1.0), (False, 1.6)):
        members = [ends for name, ends in elevation.lines.items() if name.startswith("D") == braces]
        draw_lines(axes, members, color=STEEL, lw=width, zorder=1.5)
    below = GAP * elevation.height if of_base else 0.0
    if of_base:
        _draw_isolation(axes, {line: x for line, x, _ in bases}, of_base, below)
    for line, x, kind in bases:
        if kind and names.isolator_name(line) not in of_base:
            axes.plot(x, 0.0, marker=SUPPORTS[kind], ms=5.0, mfc="white", mec=MEAN, mew=0.7, zorder=2, clip_on=False)
    aside = 0.04 * max(elevation.width, elevation.height)
    upwards = min(aside, MARGIN * elevation.height)
    axes.set_aspect("equal")
    axes.set_xlim(-aside, right + aside)
    axes.set_ylim(-upwards - 2.0 * below, elevation.height + upwards)
    axes.set_axis_off()
    name_axes(
        axes, [(line, x) for line, x, _ in bases], sorted({y for ends in elevation.lines.values() for _, y in ends})
    )


def draw_lines(axes: Axes, lines: Iterable[Sequence[Point] | np.ndarray], **looks: Any) -> None:
    """Draw lines through points as one path, which is small and quick.

    Args:
        lines: points of each, (n, 2).
        **looks: properties of matplotlib.
    """
    gap = np.full((1, 2), np.nan)
    points = [part for line in lines for part in (np.asarray(line, dtype=float), gap)]
    if points:
        axes.plot(*np.concatenate(points).T, **looks)


def name_axes(axes: Axes, lines: Sequence[tuple[str, float]], levels: Sequence[float]) -> None:
    """Write the names of column lines below an elevation, and the numbers of its floors at the left.

    Args:
        axes: in m, with its limits set.
        lines: names and places, m.
        levels: of the base and the floors, m.
    """
    turned = 90.0 if any(len(name) > LONG_NAME for name, _ in lines) else 0.0
    low, left = axes.get_ylim()[0], axes.get_xlim()[0]
    for name, x in lines:
        axes.text(x, low, name, ha="center", va="top", fontsize=SMALL, color=SOFT, rotation=turned)
    for floor, y in enumerate(levels):
        axes.text(left, y, str(floor), ha="right", va="center", fontsize=SMALL, color=SOFT)


def straight_damper(start: Point, end: Point) -> DamperDrawing:
    """Return the lines of a damper between two points, m."""
    return DamperDrawing(((start, end),), (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])))


def damper_in_bay(kind: str, left: float, right: float, low: float, high: float, half: str) -> DamperDrawing:
    """Return the lines of a damper in a bay, m.

    Args:
        kind: V, R, F or S.
        left: place of the column line at the left.
        right: place of that at the right.
        low: level of the floor below.
        high: level of the floor above.
        half: "r" or "f" of one in place of a brace of a chevron.
    """
    apex = (0.5 * (left + right), high)
    if kind == "V" and half:
        line = ((left, low), apex) if half == "r" else (apex, (right, low))
        return straight_damper(*line)
    if kind == "V":
        return DamperDrawing((((left, low), apex), ((right, low), apex)), apex)
    lines: dict[str, Line] = {
        "R": ((left, low), (right, high)),
        "F": ((left, high), (right, low)),
        "S": ((apex[0], low), apex),
    }
    return straight_damper(*lines[kind])


def _draw_isolation(axes: Axes, bases: Mapping[str, float], dampers: Collection[str], below: float) -> None:
    """The base, isolators `below` it (m), and a mark beside each line where something else acts on the base."""
    places = list(bases.values())
    axes.plot((places[0], places[-1]), (0.0, 0.0), color=STEEL, lw=2.6, zorder=1.5)
    for line, x in bases.items():
        if names.isolator_name(line) in dampers:
            axes.plot(x, -below, marker="s", ms=5.0, color=DAMPER, mec="white", mew=0.4, zorder=2, clip_on=False)
            axes.plot(x, -2.0 * below, marker="_", ms=10.0, color=MEAN, mew=0.9, zorder=2, clip_on=False)
        if names.base_device_name(line) in dampers:
            axes.plot(x + 2.0 * below, -below, marker="D", ms=3.4, color=DAMPER, mec="white", mew=0.4, clip_on=False)


def draw_damper(axes: Axes, drawing: DamperDrawing | None, color: str = DAMPER, marker: str = "s") -> None:
    """Draw a damper with its braces; None: it stands nowhere here.

    Args:
        color: colour of the lines.
        marker: matplotlib's marker of the damper.
    """
    if drawing is None:
        return
    for (x0, y0), (x1, y1) in drawing.braces:
        axes.plot((x0, x1), (y0, y1), color=color, lw=0.7, zorder=1)
    axes.plot(*drawing.at, marker=marker, ms=3.6, color=color, mec="white", mew=0.4, zorder=2)


def _draw_leaning_column(axes: Axes, frame: Frame, x: float) -> None:
    """Struts between hinges at x m, and the ties that hold them to the floors."""
    hinges = [x] * len(frame.levels), frame.levels
    axes.plot(*hinges, color=STEEL, lw=1.2, zorder=1.5)
    axes.plot(*hinges, marker="o", ls="none", ms=3.0, mfc="white", mec=MEAN, mew=0.6, zorder=2)
    for y in frame.levels[1:]:
        axes.plot((frame.x[-1], x), (y, y), color=STEEL, lw=0.7, ls=(0, (4, 3)), zorder=1)
