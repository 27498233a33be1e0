"""What moves of a building: its members, floors and dampers at their places."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations

import numpy as np

from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS, Layout, corners
from edesign.project.building.names import (
    BeamPlace,
    ColumnLine,
    Direction,
    bay_lines,
    line_label,
    node_name,
)
from edesign.project.building.supports import FIXED, PINNED, Springs
from edesign.project.frame.foundations import FootingSupport
from edesign.report.drawing.building_drawing import damper_bay
from edesign.report.motion.geometry import SAME, Geometry, Hung, MovingDamper, MovingMass, Place, Support

_MIDDLE = (0.4, 0.6)  # the shares of a diagonal between which its damper is drawn


def moving_building(building: Building, dampers: tuple[str, ...], masses: tuple[str, ...] = ()) -> Geometry:
    """Return what moves of a building.

    Args:
        building: its members.
        dampers: names of its dampers; those in places that the building does not have are left out.
        masses: names of its tuned masses.
    """
    layout = building.layout
    nodes: dict[str, Place] = {name: tuple(map(float, place)) for name, place in layout.nodes.items()}
    order = {name: i for i, name in enumerate(nodes)}
    members = {name: (order[start], order[end]) for name, (start, end) in layout.ends.items()}
    supports = [
        Support(_support_name(building.support(line)), order[node_name(line, 0)]) for line in layout.node_lines[0]
    ]
    at = _Points(building, nodes)
    return Geometry(
        nodes,
        members,
        tuple(damper for damper in map(at.damper, dampers) if damper is not None),
        tuple(float(level) for level in layout.levels),
        tuple(supports),
        masses=tuple(at.mass(name) for name in masses),
        hinged=_hinged(layout),
        slabs=_slabs(layout, order),
        grid=_grid(building),
    )


def _hinged(layout: Layout) -> frozenset[tuple[str, int]]:
    """Both ends of braces, and the pinned ends of beams."""
    found = {(place.name(way), end) for place in layout.brace_at for way in ("r", "f") for end in (0, 1)}
    for place, run in layout.beam_at.items():
        names = layout.beam_members(place)
        ends = ((names[0], 0, run.ends.start), (names[-1], 1, run.ends.end))
        found |= {(name, end) for name, end, joined in ends if joined in ("pinned", 0.0)}
    return frozenset(found & {(name, end) for name in layout.members for end in (0, 1)})


def _slabs(layout: Layout, order: dict[str, int]) -> tuple[tuple[tuple[int, int, int, int], ...], ...]:
    found = []
    for floor, panels in sorted(layout.floors.items()):
        around = [
            [order.get(node_name(line, floor), -1) for line in corners(panel, layout.axes)] for panel in sorted(panels)
        ]
        found.append(tuple((a, b, d, c) for a, b, c, d in around if min(a, b, c, d) >= 0))
    return tuple(found)


def _grid(building: Building) -> tuple[tuple[str, Place, Place], ...]:
    (x, y), axes = (building.coordinates(along) for along in DIRECTIONS), building.axes
    across = [(line_label("y", i, axes), (at, y[0], 0.0), (at, y[-1], 0.0)) for i, at in enumerate(x)]
    return tuple(across + [(line_label("x", j, axes), (x[0], at, 0.0), (x[-1], at, 0.0)) for j, at in enumerate(y)])


def _support_name(support: Springs | FootingSupport) -> str:
    if isinstance(support, FootingSupport):
        return "footing"
    if support in (FIXED, PINNED):
        return "fixed" if support == FIXED else "pinned"
    return "roller" if "free" in (support.ux, support.uy) else "springs"


class _Points:
    """Points of a building that move with its nodes.

    Args:
        nodes: their places by name, m.
    """

    def __init__(self, building: Building, nodes: dict[str, Place]) -> None:
        self._building, self._nodes = building, nodes
        self._order = {name: i for i, name in enumerate(nodes)}

    def damper(self, name: str) -> MovingDamper | None:
        """Return a damper by its name, such as VX_1_2_3 or N_A1.0_B1.1; None if the building has no such place."""
        if name.startswith("N_"):
            ends = [self._of_node(node) for node in name.split("_")[1:3]]
            return _between(name, *ends) if len(ends) == 2 else None
        found = damper_bay(name)
        if found is None:
            return None
        kind, axis, label, bay, storey, way = found
        along: Direction = "x" if axis == "X" else "y"
        frames = [line_label(along, i, self._building.axes) for i in range(self._building.n_frames(along))]
        if label not in frames:
            return None
        place = along, frames.index(label), bay
        low, high = storey - 1, storey
        (left, right), (upper_left, upper_right) = (self._corners(*place, floor) for floor in (low, high))
        apex, foot = self._middle(*place, high), self._middle(*place, low)
        if kind == "R":
            return _between(name, left, upper_right)
        if kind == "F":
            return _between(name, upper_left, right)
        if kind == "S":
            return _between(name, foot, apex)
        if way:
            return _between(name, left, apex) if way == "r" else _between(name, apex, right)
        if left is None or right is None or apex is None:
            return None
        # a chevron: its apex stands on the floor below, the damper between apex and beam
        below = Hung(apex.at, (left.nodes[0], right.nodes[0]), 0.5)
        return MovingDamper(name, ((left, below), (right, below)), (below, apex), (0.0, 1.0))

    def mass(self, name: str) -> MovingMass:
        """Return a tuned mass by its name, whose number is that in the file; without a column line amid its floor."""
        floor, number = (int(part) for part in name.split("_")[1:3])
        attachments = self._building.dampers.attachments if self._building.dampers is not None else ()
        item = attachments[number - 1] if number <= len(attachments) else None
        direction = 1 if item is not None and item.direction == "y" else 0
        at = self._of_node(node_name(item.at, floor)) if item is not None and item.at else None
        return MovingMass(name, at or self._amid(floor), direction)

    def _amid(self, floor: int) -> Hung:
        """The middle of the two nodes of a floor between which its middle is best met."""
        level = self._building.levels[floor]
        there = {i: np.array(place) for i, place in enumerate(self._nodes.values()) if abs(place[2] - level) < SAME}
        middle = np.mean(list(there.values()), axis=0)
        pair = min(combinations(there, 2), key=lambda ends: float(np.linalg.norm(_half(there, ends) - middle)))
        return Hung(tuple(_half(there, pair).tolist()), pair, 0.5)

    def _of_node(self, name: str) -> Hung | None:
        if name not in self._order:
            return None
        number = self._order[name]
        return Hung(self._nodes[name], (number, number), 0.0)

    def _corners(self, along: Direction, frame: int, bay: int, floor: int) -> tuple[Hung | None, Hung | None]:
        left, right = bay_lines(along, frame, bay, self._building.axes)
        return self._at(left, floor), self._at(right, floor)

    def _at(self, line: ColumnLine, floor: int) -> Hung | None:
        return self._of_node(node_name(line, floor))

    def _middle(self, along: Direction, frame: int, bay: int, floor: int) -> Hung | None:
        """The middle of a beam, or between two column bases."""
        found = self._of_node(str(BeamPlace(along, frame, bay, floor, self._building.axes)))
        left, right = self._corners(along, frame, bay, floor)
        if found is not None or left is None or right is None:
            return found
        at = tuple(0.5 * (a + b) for a, b in zip(left.at, right.at, strict=True))
        return Hung(at, (left.nodes[0], right.nodes[0]), 0.5)


def _half(places: Mapping[int, np.ndarray], ends: tuple[int, int]) -> np.ndarray:
    return np.asarray(0.5 * (places[ends[0]] + places[ends[1]]))


def _between(name: str, start: Hung | None, end: Hung | None) -> MovingDamper | None:
    if start is None or end is None:
        return None
    return MovingDamper(name, ((start, end),), (start, end), _MIDDLE)
