"""The load cases of a building: permanent loads, self weight, and the variable loads of each category."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from edesign.project.building.building import Building
from edesign.project.building.layout import edges
from edesign.project.building.loads import Areas, BeamLoad, NodeLoad, PerimeterLoad
from edesign.project.building.names import BeamPlace, node_name
from edesign.project.building.own_cases import CaseArea
from edesign.project.building.places import panels_in
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.structure.area_loads import BeamShare, bay_shares, part_share
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.secondary_beams import own_weight

PERMANENT, NON_STRUCTURAL, SELF_WEIGHT = "G", "G2", "self_weight"
ALWAYS = (PERMANENT, NON_STRUCTURAL, SELF_WEIGHT)
"""Permanent cases."""
PATTERNED = tuple("ABCDEFG")
"""Categories of imposed loads that may act on parts of floors (EN 1991-1-1, 6.2.1(1))."""
Load = Areas | PerimeterLoad | BeamLoad | NodeLoad
_ALTERNATES = {"chessboard": (1, 1), "strips_x": (1, 0), "strips_y": (0, 1)}
"""Whether loaded and bare bays alternate along x and along y; they always do from floor to floor."""

_MOST_PARTS = 3  # of a beam, with a link in its middle
_AT_NODE = 1e-9  # share of a beam


@dataclass
class LoadSum:
    """Loads of one case that add up, downwards: on whole beams and on nodes."""

    category: str
    uniform: dict[BeamPlace, float] = field(default_factory=lambda: defaultdict(float))
    points: dict[tuple[BeamPlace, float], float] = field(default_factory=lambda: defaultdict(float))
    nodes: dict[str, float] = field(default_factory=lambda: defaultdict(float))

    def add(self, place: BeamPlace, share: BeamShare) -> None:
        """Add the share of a beam."""
        if share.uniform:
            self.uniform[place] += share.uniform
        for position, force in share.points:
            self.points[place, position] += force


def load_cases(building: Building, frame: SpaceFrame, pattern: bool = False) -> dict[str, LoadCase]:
    """Return the load cases of a building by name: `G`, `G2`, `self_weight`, and `Q_B` and so on.

    Args:
        building: from `load_building`.
        pattern: whether area loads of the categories A to G are two cases, `Q_B1` and `Q_B2`, as `loads.pattern` says.

    Raises:
        InputError: a section is not known.
    """
    sums = {PERMANENT: LoadSum("permanent")}
    for load in building.loads.items:
        if load.G != 0.0:
            _add(building, sums[PERMANENT], load, load.G)
        if load.G2 != 0.0:
            _add(building, sums.setdefault(NON_STRUCTURAL, LoadSum("permanent")), load, load.G2)
        if isinstance(load, Areas) and (weight := own_weight(building, load)):
            _add_secondary(building, sums[PERMANENT], load, weight)
        if pattern and load.Q != 0.0 and isinstance(load, Areas) and load.category in PATTERNED:
            for half in (1, 2):
                case = sums.setdefault(f"{_live_case(load.category)}{half}", LoadSum(load.category))
                add_area(building, case, load, load.Q, half)
        elif load.Q != 0.0 and load.category is not None:
            case = sums.setdefault(_live_case(load.category), LoadSum(load.category))
            _add(building, case, load, load.Q)
        if isinstance(load, BeamLoad):
            _add_points(building, sums, load)
            _add_parts(building, sums, load)
    cases = {name: case_of(name, found, frame) for name, found in sums.items()}
    if building.loads.self_weight:
        cases[SELF_WEIGHT] = self_weight(building, frame)
    return {name: cases[name] for name in sorted(cases, key=lambda name: (name not in ALWAYS, name))}


def _live_case(category: str) -> str:
    """Return the name of the load case of a category of use: `Q_B`.

    Args:
        category: of use, A to H.
    """
    return f"Q_{category}"


def on_nodes(frame: SpaceFrame, case: LoadCase, but: np.ndarray | None = None) -> np.ndarray:
    """Return what each node carries of a case if its members are simply supported, (n_nodes, 3) N, global.

    Args:
        but: (n_members,) members whose loads do not count; None: all count.
    """
    found = case.nodal[:, :3].copy()
    start, end = frame.ends
    counts = np.ones(len(frame.members)) if but is None else np.where(but, 0.0, 1.0)
    half = 0.5 * case.uniform * (frame.length * counts)[:, None]
    np.add.at(found, start, half)
    np.add.at(found, end, half)
    place, points = case.point_position[:, None], case.point_force * counts[case.point_member, None]
    np.add.at(found, start[case.point_member], (1.0 - place) * points)
    np.add.at(found, end[case.point_member], place * points)
    return found


def _add(building: Building, case: LoadSum, load: Load, value: float) -> None:
    layout = building.layout
    if isinstance(load, Areas):
        add_area(building, case, load, value)
    elif isinstance(load, PerimeterLoad):
        for floor in load.floors.numbers(1, building.n_storeys):
            for place, count in layout.floor_edges[floor].items():
                if count == 1:
                    case.add(place, BeamShare(value))
    elif isinstance(load, BeamLoad):
        for place in layout.beam_places(load):
            if place in layout.beam_at:
                case.add(place, BeamShare(value))
    else:
        for floor in load.floors.numbers(1, building.n_storeys):
            for line in building.lines_of(load.at):
                if line in layout.node_lines[floor]:
                    case.nodes[node_name(line, floor)] += value


def _add_points(building: Building, sums: dict[str, LoadSum], load: BeamLoad) -> None:
    """Add the forces at places along beams."""
    places = [place for place in building.layout.beam_places(load) if place in building.layout.beam_at]
    for point in load.points:
        for value, category in ((point.G, "permanent"), (point.Q, load.category)):
            if value == 0.0 or category is None:
                continue
            name = PERMANENT if category == "permanent" else _live_case(category)
            case = sums.setdefault(name, LoadSum(category))
            for place in places:
                width = building.widths(place.along)[place.bay - 1]
                case.add(place, BeamShare(0.0, tuple((at.share(width), value) for at in point.at)))


def _add_parts(building: Building, sums: dict[str, LoadSum], load: BeamLoad) -> None:
    """Add the loads on parts of beams; of a beam in parts each has its own share."""
    layout = building.layout
    for part in load.partial:
        for place in layout.beam_places(load):
            if place not in layout.beam_at:
                continue
            width = building.widths(place.along)[place.bay - 1]
            start, end = part.start.share(width), part.end.share(width)
            ends = [start, *(cut for cut in layout.cuts(place).values() if start < cut < end), end]
            for values, category in ((part.G, "permanent"), (part.Q, load.category)):
                if not any(values) or category is None:
                    continue
                case = sums.setdefault(
                    PERMANENT if category == "permanent" else _live_case(category), LoadSum(category)
                )
                at_ends = np.interp(ends, [start, end], values)
                for low, high, *loads in zip(ends, ends[1:], at_ends, at_ends[1:], strict=False):
                    case.add(place, part_share(float(low), float(high), width, (float(loads[0]), float(loads[1]))))


def add_area(
    building: Building, case: LoadSum, load: Areas | CaseArea, value: float, half: Literal[0, 1, 2] = 0
) -> None:
    """Add what a load on bays brings to beams.

    Args:
        value: N/m2, downwards.
        half: 1 or 2: of the bays alone that `loads.pattern` puts into this half; 0: of all.
    """
    widths_x, widths_y = building.widths("x"), building.widths("y")
    wanted = panels_in(load.bays, len(widths_x), len(widths_y))
    of_x, of_y = _ALTERNATES.get(building.loads.pattern, (0, 0))
    for floor in load.floors.numbers(1, building.n_storeys):
        for panel in sorted(wanted & building.layout.floors[floor]):
            if half and (panel[0] * of_x + panel[1] * of_y + floor) % 2 != half - 1:
                continue
            width_x, width_y = widths_x[panel[0] - 1], widths_y[panel[1] - 1]
            shares = bay_shares(value, width_x, width_y, load.spans, load.secondary_beams)
            for place in edges(panel, floor, building.axes):
                case.add(place, shares.along_x if place.along == "x" else shares.along_y)


def _add_secondary(building: Building, case: LoadSum, load: Areas, weight: float) -> None:
    """Add the weight of secondary beams, N/m, to the beams that they rest on."""
    widths_x, widths_y = building.widths("x"), building.widths("y")
    parts = load.secondary_beams + 1
    for floor in load.floors.numbers(1, building.n_storeys):
        for i, j in sorted(panels_in(load.bays, len(widths_x), len(widths_y)) & building.layout.floors[floor]):
            length = widths_y[j - 1] if load.spans == "x" else widths_x[i - 1]
            share = BeamShare(points=tuple((k / parts, 0.5 * weight * length) for k in range(1, parts)))
            for place in edges((i, j), floor, building.axes):
                if place.along == load.spans:
                    case.add(place, share)


def case_of(name: str, loads: LoadSum, frame: SpaceFrame) -> LoadCase:
    """Return a sum of loads as a case; those of a beam in parts go to these and to the nodes between them."""
    nodes = {node: i for i, node in enumerate(frame.node_names)}
    members = {member.name: i for i, member in enumerate(frame.members)}
    nodal, uniform = np.zeros((len(nodes), 6)), np.zeros((len(members), 3))
    points: list[tuple[int, float, float]] = []
    for node, force in loads.nodes.items():
        nodal[nodes[node], 2] -= force
    for place, load in loads.uniform.items():
        for member in members_of(place, members):
            uniform[member, 2] -= load
    for (place, position), force in loads.points.items():
        for member in members_of(place, members):
            start, end = frame.members[member].part
            if end < 1.0 and abs(position - end) < _AT_NODE:
                nodal[frame.members[member].end, 2] -= force
                break
            if position < end or end == 1.0:
                points.append((member, (position - start) / (end - start), force))
                break
    return LoadCase(
        name=name,
        category=loads.category,
        nodal=nodal,
        uniform=uniform,
        point_member=np.array([member for member, _, _ in points], int),
        point_position=np.array([position for _, position, _ in points], float),
        point_force=np.array([(0.0, 0.0, -force) for _, _, force in points], float).reshape(-1, 3),
    )


def members_of(place: BeamPlace, members: dict[str, int]) -> list[int]:
    """Return the member of a beam, or those of its parts."""
    name = str(place)
    if name in members:
        return [members[name]]
    return [members[part] for k in range(1, _MOST_PARTS + 1) if (part := f"{name}_{k}") in members]


def on_members(frame: SpaceFrame, case: LoadCase) -> np.ndarray:
    """Return the whole load of a case on each member, (n_members, 3) N, global."""
    found = case.uniform * frame.length[:, None]
    np.add.at(found, case.point_member, case.point_force)
    return found


def self_weight(building: Building, frame: SpaceFrame) -> LoadCase:
    """Return the weight of the members."""
    pairs, of_members = frame.sections
    weight = [frame.section(name).A * building.materials[steel].density * STANDARD_GRAVITY for name, steel in pairs]
    uniform = np.zeros((len(frame.members), 3))
    uniform[:, 2] = -np.array(weight)[of_members]
    none = np.zeros(0)
    nodal = np.zeros((len(frame.node_names), 6))
    return LoadCase(SELF_WEIGHT, "permanent", nodal, uniform, none.astype(int), none, none.reshape(0, 3))
