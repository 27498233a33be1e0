"""Floors and storeys of a building: what moves as one, what drifts, and what holds it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from edesign.frame.frame_model import Direction, DriftLine, Floor, Member, RigidPart, Storey, Sum, Terms
from edesign.project.building.building import Building
from edesign.project.building.names import ColumnLine, column_name, frame_name, node_name
from edesign.project.building.places import parts_of
from edesign.space.nonlinear.gravity import GravityLoads
from edesign.space.nonlinear.masses import master_name
from edesign.space.structure.frame import AXES, NO_DIAPHRAGM, SpaceFrame
from edesign.space.structure.plan_outline import corners

DIRECTIONS = tuple(Direction(axis, degree) for degree, axis in enumerate(AXES))
"""In which floors of a building move."""
UP, TURN = 2, 5
"""Degrees of the core along the vertical and about it."""
_PLACES = 6  # decimals of m and of shares of the mass in which equal ones agree
_UPPER_END = 6  # columns and braces end above; forces of their ends come after those of their starts


def building_floors(
    building: Building, frame: SpaceFrame, gravity: GravityLoads, nodes: Mapping[str, int], masters: Sequence[int]
) -> tuple[Floor, ...]:
    """Return the floors above the base; named places are the column lines at the corners of their outlines.

    A floor that is not rigid, or has several diaphragms, moves as its masses do in the mean.

    Args:
        building: from `load_building`.
        nodes: ids by name.
        masters: ids, by diaphragm.
    """
    found = []
    for floor, level in enumerate(building.levels[1:], start=1):
        there = np.flatnonzero(frame.level_of_nodes == floor)
        names = [frame.node_names[node] for node in there]
        points: dict[str, tuple[Sum, ...]] = {}
        for line in _corners(building, floor):
            if (name := node_name(line, floor)) in nodes:
                points[str(line)] = tuple(((1.0, nodes[name], axis.degree),) for axis in DIRECTIONS)
        parts = [_part(frame, number, master) for number, master in enumerate(masters) if _at(frame, number) == floor]
        if len(parts) == 1:
            movers, turn = parts[0].movers, parts[0].turn
        else:
            movers, turn = _mean(frame, there, masters), ()
        names += [part.nodes[-1] for part in parts]
        of_level = float(gravity.of_levels[floor])
        several = tuple(parts) if len(parts) > 1 else ()
        found.append(Floor(floor, level, movers, tuple(names), of_level, turn, points, several))
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


def _at(frame: SpaceFrame, number: int) -> int:
    return frame.diaphragms[number].floor


def _corners(building: Building, floor: int) -> Iterator[ColumnLine]:
    """Where the outlines of a floor turn, and those of its rigid parts."""
    for panels in dict.fromkeys((*parts_of(building.layout.floors[floor]), *building.rigid_parts(floor))):
        yield from (ColumnLine(*corner, building.axes) for corner in corners(panels))


def _part(frame: SpaceFrame, number: int, master: int) -> RigidPart:
    """A diaphragm, which moves as its master."""
    movers = tuple((((1.0, master, axis.degree),),) for axis in DIRECTIONS)
    nodes = [frame.node_names[node] for node in np.flatnonzero(frame.node_diaphragm == number)]
    at = frame.diaphragms[number]
    return RigidPart(str(at), movers, ((1.0, master, TURN),), (*nodes, master_name(at)))


def _mean(frame: SpaceFrame, there: np.ndarray, masters: Sequence[int]) -> tuple[tuple[Sum, ...], ...]:
    """The mean over the masses of nodes of a level, those of diaphragms at their masters."""
    mass = frame.node_mass[there] if frame.node_mass[there].any() else np.ones(there.size)
    shares: dict[int, float] = {}
    for share, node in zip((mass / mass.sum()).tolist(), there.tolist(), strict=True):
        tied = int(frame.node_diaphragm[node])
        moving = node if tied == NO_DIAPHRAGM else masters[tied]
        shares[moving] = shares.get(moving, 0.0) + share
    return tuple((tuple((of, at, axis.degree) for at, of in shares.items() if of > 0.0),) for axis in DIRECTIONS)


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
    """Return the centre of mass of each level from the base, of its nodes where it has no mass, (n_levels, 2) m."""
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
    frames = (frame_name("x", line.j, line.axes) if direction.name == "x" else frame_name("y", line.i, line.axes),)
    return DriftLine(str(line), ratio, frames)
