"""Floors and storeys of a building: what moves as one, what drifts, and what holds it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.frame.frame_model import Direction, DriftLine, Floor, Member, Storey, Sum, Terms
from edesign.project.building.building import Building
from edesign.project.building.names import ColumnLine, column_name, frame_name, node_name
from edesign.space.nonlinear.gravity import GravityLoads
from edesign.space.nonlinear.masses import master_name
from edesign.space.structure.frame import AXES, SpaceFrame
from edesign.space.structure.plan_outline import corners

DIRECTIONS = tuple(Direction(axis, degree) for degree, axis in enumerate(AXES))
"""In which floors of a building move."""
UP, TURN = 2, 5
"""Degrees of the core along the vertical and about it."""
_PLACES = 6  # decimals of m and of shares of the mass in which equal ones agree
_UPPER_END = 6  # columns and braces end above; forces of their ends come after those of their starts


def building_floors(
    building: Building, frame: SpaceFrame, gravity: GravityLoads, nodes: Mapping[str, int], masters: Mapping[int, int]
) -> tuple[Floor, ...]:
    """Return the floors above the base; named places are the column lines at the corners of their outlines.

    A floor that is not rigid moves as its masses do in the mean.

    Args:
        building: from `load_building`.
        nodes: ids by name.
        masters: ids by rigid floor.
    """
    found = []
    for floor, level in enumerate(building.levels[1:], start=1):
        there = np.flatnonzero(frame.level_of_nodes == floor)
        names = [frame.node_names[node] for node in there]
        points: dict[str, tuple[Sum, ...]] = {}
        for line in (ColumnLine(*corner) for corner in corners(building.layout.floors[floor])):
            if (name := node_name(line, floor)) in nodes:
                points[str(line)] = tuple(((1.0, nodes[name], axis.degree),) for axis in DIRECTIONS)
        if floor in masters:
            master = masters[floor]
            movers: tuple[tuple[Sum, ...], ...] = tuple((((1.0, master, axis.degree),),) for axis in DIRECTIONS)
            turn: Sum = ((1.0, master, TURN),)
            names.append(master_name(floor))
        else:
            mass = frame.node_mass[there] if frame.node_mass[there].any() else np.ones(there.size)
            shares = list(zip((mass / mass.sum()).tolist(), there.tolist(), strict=True))
            movers = tuple(
                (tuple((share, node, axis.degree) for share, node in shares if share > 0.0),) for axis in DIRECTIONS
            )
            turn = ()
        found.append(Floor(floor, level, movers, tuple(names), float(gravity.of_levels[floor]), turn, points))
    return tuple(found)


def control_node(roof: Floor, places: Sequence[Sequence[float]]) -> int:
    """Return the node whose displacement pushes control: that nearest to the roof's centre of mass.

    Of a rigid roof it is the centre of mass itself, and of nodes equally near the one with most mass.

    Args:
        places: of all nodes by their ids, m.

    Source: EN 1998-1, 4.3.3.4.2.3(1).
    """
    shares = {node: share for share, node, _ in roof.movers[0][0]}
    centre = sum(share * np.asarray(places[node][:UP]) for node, share in shares.items())
    apart = {node: float(np.linalg.norm(np.asarray(places[node][:UP]) - centre)) for node in shares}
    return min(shares, key=lambda node: (round(apart[node], _PLACES), -round(shares[node], _PLACES)))


def building_storeys(
    building: Building, frame: SpaceFrame, nodes: Mapping[str, int], members: Mapping[str, Member]
) -> tuple[Storey, ...]:
    """Return the storeys; they drift on the lines of their columns, and columns and braces carry their shear.

    Args:
        building: from `load_building`.
        nodes: ids by name.
    """
    layout = building.layout
    braces = [(place.storey, name) for place in layout.brace_at for name in (place.name("r"), place.name("f"))]
    centres = mass_centres(frame)
    found = []
    for storey, height in enumerate(building.storey_heights, start=1):
        lines = [line for line, at in layout.column_at if at == storey]
        holding = [members[column_name(line, storey)] for line in lines]
        holding += [members[name] for at, name in braces if at == storey and name in members]
        if not lines:
            lines = [line for line in layout.node_lines[storey] if line in layout.node_lines[storey - 1]]
        shear: list[Terms] = [
            tuple((1.0, "global_force", member.at_end(1), _UPPER_END + axis.degree) for member in holding)
            for axis in DIRECTIONS
        ]
        drifts = tuple(tuple(_drift(nodes, line, storey, height, axis) for line in lines) for axis in DIRECTIONS)
        torque = _torque(holding, frame.coordinates[[nodes[member.end] for member in holding], :2] - centres[storey])
        found.append(Storey(storey, height, drifts, tuple(shear), torque))
    return tuple(found)


def mass_centres(frame: SpaceFrame) -> np.ndarray:
    """Return the centre of mass of each level from the base, of its nodes where it has no mass, (n_levels, 2) m.

    Args:
        frame: of the building.
    """
    found = []
    for level in range(frame.n_floors + 1):
        there = frame.level_of_nodes == level
        mass = frame.node_mass[there]
        found.append(np.average(frame.coordinates[there, :2], axis=0, weights=mass if mass.any() else None))
    return np.array(found)


def _torque(holding: Sequence[Member], arms: np.ndarray) -> Terms:
    """The moment of forces on the upper ends of members about a vertical, which is so far from each, (n, 2) m."""
    terms: list[tuple[float, str, int, int]] = []
    for member, (x, y) in zip(holding, arms.tolist(), strict=True):
        own = [] if member.torque is None else [(1.0, TURN)]
        for arm, degree in ((-y, 0), (x, 1), *own):
            terms.append((arm, "global_force", member.at_end(1), _UPPER_END + degree))
    return tuple(terms)


def _drift(nodes: Mapping[str, int], line: ColumnLine, storey: int, height: float, direction: Direction) -> DriftLine:
    above, below = (nodes[node_name(line, floor)] for floor in (storey, storey - 1))
    ratio = ((1.0 / height, above, direction.degree), (-1.0 / height, below, direction.degree))
    frames = (frame_name("x", line.j),) if direction.name == "x" else (frame_name("y", line.i),)
    return DriftLine(str(line), ratio, frames)
