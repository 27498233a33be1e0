"""Floors and storeys of a plane frame: what moves as one, and what holds it."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.frame.frame_model import Direction, DriftLine, Floor, Member, Storey, Sum, Terms
from edesign.frame.loads import floor_loads
from edesign.project.frame.frame import Frame
from edesign.project.notation import names
from edesign.project.project import Project

ACROSS = Direction("", degree=0)
"""In which floors of a plane frame move."""
UP = 1
"""Its degree along the vertical."""


def frame_floors(project: Project, nodes: Mapping[str, int]) -> tuple[Floor, ...]:
    """Return the floors above the base; each node on a column line counts alike in its mean.

    Args:
        nodes: ids by name.
    """
    frame, gravity = project.frame, floor_loads(project).tolist()
    return tuple(
        Floor(
            floor,
            level,
            (tuple(((1.0, nodes[name], ACROSS.degree),) for name in _on_lines(frame, floor)),),
            tuple(name for name, (_, y) in frame.nodes.items() if y == level),
            gravity[floor],
        )
        for floor, level in enumerate(frame.levels[1:], start=1)
    )


def frame_storeys(frame: Frame, nodes: Mapping[str, int], members: Mapping[str, Member]) -> tuple[Storey, ...]:
    """Return the storeys; columns and braces carry their shear.

    Args:
        nodes: ids by name.
    """
    shears: list[Terms] = [() for _ in frame.storey_heights]
    for line, storey in frame.column_at:
        element = members[names.column_name(line, storey)].at_end(1)
        shears[storey - 1] += ((1.0, "global_force", element, 3),)
    for bay, storey, way in frame.brace_at:
        element = members[frame.brace_name(bay, storey, way)].element
        upper_end = 3 if way == "r" else 0
        shears[storey - 1] += ((1.0, "global_force", element, upper_end),)
    return tuple(
        Storey(i, height, (tuple(_drift(nodes, *at, height) for at in _verticals(frame, i)),), (shear,))
        for i, (height, shear) in enumerate(zip(frame.storey_heights, shears, strict=True), start=1)
    )


def _verticals(frame: Frame, storey: int) -> list[tuple[str, str, str]]:
    """Name, upper and lower node of each line that has a column in the storey, from the left.

    Without any column they are those of the lines with nodes above and below, and else the leading nodes.
    """
    lines = [(line, names.node_name(line, storey), names.node_name(line, storey - 1)) for line in frame.lines]
    chosen = [at for at in lines if (at[0], storey) in frame.column_at]
    if not chosen:
        chosen = [at for at in lines if at[1] in frame.nodes and at[2] in frame.nodes]
    if not chosen:
        chosen = [("", _on_lines(frame, storey)[0], next(iter(_on_lines(frame, storey - 1)), ""))]
    return chosen


def _on_lines(frame: Frame, floor: int) -> list[str]:
    """Names of the nodes at a floor on column lines, from the left."""
    return [name for line in frame.lines if (name := names.node_name(line, floor)) in frame.nodes]


def _drift(nodes: Mapping[str, int], line: str, upper: str, lower: str, height: float) -> DriftLine:
    above: Sum = ((1.0 / height, nodes[upper], ACROSS.degree),)
    ratio = (*above, (-1.0 / height, nodes[lower], ACROSS.degree)) if lower in nodes else above
    return DriftLine(line, ratio)
