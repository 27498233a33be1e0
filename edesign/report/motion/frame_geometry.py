"""What moves of a plane frame: its members, and dampers, isolators and tuned masses at their places."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from edesign.project.frame.frame import Frame
from edesign.project.frame.supports import support_name
from edesign.project.notation import names
from edesign.project.notation.names import tuned_mass_floor
from edesign.report.drawing.frame_drawing import FrameElevation
from edesign.report.motion.geometry import (
    BELOW,
    GROUND,
    SAME,
    SIGN,
    Geometry,
    Hung,
    MovingDamper,
    MovingMass,
    Place,
    Support,
)


def moving_frame(frame: Frame, dampers: tuple[str, ...], masses: tuple[str, ...] = ()) -> Geometry:
    """Return what moves of a frame.

    Args:
        frame: its members.
        dampers: names of its dampers and isolators; those in places that the frame does not have are left out.
        masses: names of its tuned masses.
    """
    at: dict[str, Place] = {name: (float(x), float(y)) for name, (x, y) in frame.nodes.items()}
    drawn = FrameElevation(frame)
    members = {name: (_hung(at, start).nodes[0], _hung(at, end).nodes[0]) for name, (start, end) in drawn.lines.items()}
    order = {name: i for i, name in enumerate(at)}
    column_bases = {line: names.node_name(line, 0) for line in frame.lines if (line, 1) in frame.column_at}
    isolated = any(names.isolator_name(line) in dampers for line in column_bases)
    supports = (
        []
        if isolated
        else [
            Support(support_name(frame.support(line)), order[column_base]) for line, column_base in column_bases.items()
        ]
    )
    base = [order[column_base] for column_base in column_bases.values()] if isolated else []
    own = Geometry(at, members, (), tuple(float(y) for y in frame.levels), tuple(supports), tuple(base))
    found = (_damper(drawn, at, name) or _of_base(frame, own, name) for name in dampers)
    return replace(own, dampers=tuple(damper for damper in found if damper), masses=tuple(_masses(frame, own, masses)))


def _of_base(frame: Frame, own: Geometry, name: str) -> MovingDamper | None:
    """An isolator under a column, or what acts beside it, from the ground to the column base; None: it is neither."""
    for line, x in zip(frame.lines, frame.x, strict=True):
        column_base = next((i for i, node in enumerate(own.nodes) if node == names.node_name(line, 0)), None)
        if column_base is None or not own.base:
            continue
        top = Hung((float(x), float(frame.levels[0])), (column_base, column_base), 0.0)
        if name == names.isolator_name(line):
            return MovingDamper(name, (), (Hung((float(x), own.ground), GROUND, 0.0), top), (0.0, 1.0), SIGN * own.size)
        beside = names.base_device_name(line)
        if name == beside or name.startswith(f"{beside}_"):  # the second one at a column base is G_A_2
            shift = 1.5 + (int(name[len(beside) + 1 :]) - 1 if name != beside else 0)
            below_it = Hung((float(x) + shift * BELOW * own.size, own.ground), GROUND, 0.0)
            return MovingDamper(name, ((below_it, top),), (below_it, top), (0.3, 0.7))
    return None


def _masses(frame: Frame, own: Geometry, masses: tuple[str, ...]) -> Iterator[MovingMass]:
    """Tuned masses over the middles of bays, from the left; those for which there is no bay left stand closer."""
    count: dict[int, int] = {}
    for name in masses:
        floor = tuned_mass_floor(name)
        number = count[floor] = count.get(floor, 0) + 1
        in_all = sum(tuned_mass_floor(other) == floor for other in masses)
        parts = max(in_all, frame.n_bays)
        left, right = float(frame.x[0]), float(frame.x[-1])
        x = left + (number - 0.5) / parts * (right - left)
        yield MovingMass(name, _hung(own.nodes, (x, float(frame.levels[floor]))))


def _damper(frame: FrameElevation, at: dict[str, Place], name: str) -> MovingDamper | None:
    drawing = frame.damper(name)
    if drawing is None:
        return None
    if len(drawing.braces) == 2:  # a chevron: its apex stands on the floor below, the damper between apex and beam
        lower = [start for start, _ in drawing.braces]
        ends = [_hung(at, end) for end in lower]
        apex = Hung(drawing.at, (ends[0].nodes[0], ends[1].nodes[0]), 0.5)
        braces = tuple((end, apex) for end in ends)
        return MovingDamper(name, braces, (apex, _hung(at, drawing.at)), (0.0, 1.0))
    ((start, end),) = drawing.braces
    line = (_hung(at, start), _hung(at, end))
    return MovingDamper(name, (line,), line, (0.4, 0.6))


def _hung(at: dict[str, Place], point: Place) -> Hung:
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
