"""What moves in a drawing of a frame: nodes, members between them, and dampers that hang on nodes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.project.frame.frame import Frame
from edesign.report.drawing.frame_drawing import Point, damper_drawing, member_lines

SAME = 1e-6  # m, within which a point is a node


@dataclass(frozen=True)
class Hung:
    """A point that moves with two nodes.

    Attributes:
        at: where it is, m.
        nodes: their positions among `Geometry.nodes`.
        share: 0: it moves with the first, 1: with the second, between: with both.
    """

    at: Point
    nodes: tuple[int, int]
    share: float


@dataclass(frozen=True)
class MovingDamper:
    """A damper.

    Attributes:
        name: of it.
        braces: lines that hold it.
        body: the line that it stands on; its color tells the force.
        span: the shares of this line between which the damper itself is.
    """

    name: str
    braces: tuple[tuple[Hung, Hung], ...]
    body: tuple[Hung, Hung]
    span: tuple[float, float]


@dataclass(frozen=True)
class Geometry:
    """A frame whose nodes move.

    Attributes:
        nodes: places by name, m.
        members: first and second node of each column, beam and brace by its name.
        dampers: those whose place the frame has.
        levels: of the floors from the base, m.
    """

    nodes: dict[str, Point]
    members: dict[str, tuple[int, int]]
    dampers: tuple[MovingDamper, ...]
    levels: tuple[float, ...]


def moving_frame(frame: Frame, dampers: tuple[str, ...]) -> Geometry:
    """Return what moves of a frame.

    Args:
        frame: its members.
        dampers: names of its dampers; those in places that the frame does not have, such as isolators, are left out.
    """
    at = {name: (float(x), float(y)) for name, (x, y) in frame.nodes.items()}
    members = {
        name: (_hung(at, start).nodes[0], _hung(at, end).nodes[0]) for name, (start, end) in member_lines(frame).items()
    }
    found = (_damper(frame, at, name) for name in dampers)
    return Geometry(at, members, tuple(damper for damper in found if damper), tuple(float(y) for y in frame.y))


def floor_shares(levels: tuple[float, ...], places: list[Point]) -> list[tuple[int, float]]:
    """Return for each node the floor below, from 0 for the base, and its share of the way to the next.

    Args:
        levels: of the floors from the base, m.
        places: of the nodes, m.
    """
    found = []
    for _, y in places:
        below = min(max(int(np.searchsorted(levels, y + SAME, side="right")) - 1, 0), len(levels) - 2)
        share = (y - levels[below]) / (levels[below + 1] - levels[below])
        found.append((below, min(max(share, 0.0), 1.0)))
    return found


def _damper(frame: Frame, at: dict[str, Point], name: str) -> MovingDamper | None:
    drawing = damper_drawing(frame, name)
    if drawing is None:
        return None
    if len(drawing.braces) == 2:  # a chevron: its apex stands on the floor below, the damper between apex and beam
        feet = [start for start, _ in drawing.braces]
        ends = [_hung(at, foot) for foot in feet]
        apex = Hung(drawing.at, (ends[0].nodes[0], ends[1].nodes[0]), 0.5)
        braces = tuple((end, apex) for end in ends)
        return MovingDamper(name, braces, (apex, _hung(at, drawing.at)), (0.0, 1.0))
    ((start, end),) = drawing.braces
    line = (_hung(at, start), _hung(at, end))
    return MovingDamper(name, (line,), line, (0.4, 0.6))


def _hung(at: dict[str, Point], point: Point) -> Hung:
    """A point on the nodes beside it at its level, or else on the nearest node."""
    x, y = point
    places = list(at.values())
    nearest = min(range(len(places)), key=lambda i: float(np.hypot(places[i][0] - x, places[i][1] - y)))
    if np.hypot(places[nearest][0] - x, places[nearest][1] - y) < SAME:
        return Hung(point, (nearest, nearest), 0.0)
    level = [i for i, place in enumerate(places) if abs(place[1] - y) < SAME]
    left = max((i for i in level if places[i][0] < x), key=lambda i: places[i][0], default=nearest)
    right = min((i for i in level if places[i][0] > x), key=lambda i: places[i][0], default=nearest)
    width = places[right][0] - places[left][0]
    return Hung(point, (left, right), (x - places[left][0]) / width if width > SAME else 0.0)
