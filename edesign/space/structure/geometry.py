"""The nodes and members of a building as a space frame, with its loads and masses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from edesign.project.building.building import Building
from edesign.project.building.layout import Point, ways
from edesign.project.building.members import BeamRun, BraceRun, End
from edesign.project.building.names import BeamPlace, BracePlace, ColumnLine, column_name, frame_name, node_name
from edesign.space.structure.frame import NO_DIAPHRAGM, RIGID, Member, SpaceFrame
from edesign.space.structure.load_cases import load_cases
from edesign.space.structure.masses import node_masses

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def space_frame(building: Building) -> SpaceFrame:
    """Return a building as nodes, members, load cases and masses.

    Load cases are `G`, the permanent loads of the file; `self_weight`, that of the members, if the file wants it; and
    `Q_B` and so on, the variable loads of each category. A beam that braces meet in the middle is two members with a
    node between them. The lower half of the first storey has no mass.

    Args:
        building: from `load_building`.

    Raises:
        InputError: a section is not known, or loads upwards would give a negative mass.
    """
    nodes, coordinates, floors = _nodes(building)
    fixed, springs = _supports(building, nodes)
    members = (*_columns(building, nodes), *_beams(building, nodes), *_braces(building, nodes, coordinates))
    bare = SpaceFrame(
        node_names=tuple(nodes),
        coordinates=coordinates,
        node_floor=floors,
        levels=np.array(building.levels),
        fixed=fixed,
        springs=springs,
        members=members,
        cases={},
        node_mass=np.zeros(len(nodes)),
    )
    loaded = replace(bare, cases=load_cases(building, bare))
    return replace(loaded, node_mass=node_masses(building, loaded))


def _nodes(building: Building) -> tuple[dict[str, int], np.ndarray, np.ndarray]:
    """Number of each node by name, coordinates, and floor of the diaphragm; floor by floor, middles of beams last."""
    layout = building.layout
    stiff = set(building.diaphragms.numbers(1, building.n_storeys))
    names, places, floors = [], [], []
    for floor, lines in layout.node_lines.items():
        for line in lines:
            names.append(node_name(line, floor))
            places.append((*building.grid(line), building.levels[floor]))
            floors.append(floor if floor in stiff else NO_DIAPHRAGM)
        for beam in sorted(beam for beam in layout.halved_beams if beam.floor == floor):
            (x0, y0), (x1, y1) = (building.grid(line) for line in beam.lines)
            names.append(str(beam))
            places.append((0.5 * (x0 + x1), 0.5 * (y0 + y1), building.levels[floor]))
            floors.append(floor if floor in stiff else NO_DIAPHRAGM)
    return {name: i for i, name in enumerate(names)}, np.array(places, float), np.array(floors)


def _supports(building: Building, nodes: Mapping[str, int]) -> tuple[np.ndarray, np.ndarray]:
    fixed = np.zeros((len(nodes), 6), bool)
    springs = np.zeros((len(nodes), 6))
    for line in building.layout.node_lines[0]:
        node = nodes[node_name(line, 0)]
        for axis, restraint in enumerate(building.support(line).all()):
            fixed[node, axis] = restraint == "fixed"
            springs[node, axis] = restraint if isinstance(restraint, float) else 0.0
    return fixed, springs


def _columns(building: Building, nodes: Mapping[str, int]) -> list[Member]:
    return [
        Member(
            name=column_name(line, storey),
            kind="column",
            start=nodes[node_name(line, storey - 1)],
            end=nodes[node_name(line, storey)],
            section=run.section,
            material=run.material,
            group=run.group or "",
            web=X if run.strong == "x" else Y,
            storey=storey,
            frame=_frames_of(line),
        )
        for (line, storey), run in building.layout.column_at.items()
    ]


def _frames_of(line: ColumnLine) -> tuple[str, str]:
    """Return the plane frames that a column line stands in."""
    return frame_name("x", line.j), frame_name("y", line.i)


def _beams(building: Building, nodes: Mapping[str, int]) -> list[Member]:
    found = []
    for place, run in building.layout.beam_at.items():
        start, end = (nodes[node_name(line, place.floor)] for line in place.lines)
        if place not in building.layout.halved_beams:
            found.append(_beam(place, run, str(place), start, end, run.ends.start, run.ends.end))
            continue
        middle = nodes[str(place)]
        first, second = half_names(place)
        found.append(_beam(place, run, first, start, middle, run.ends.start, "rigid"))
        found.append(_beam(place, run, second, middle, end, "rigid", run.ends.end))
    return found


def half_names(place: BeamPlace) -> tuple[str, str]:
    """Return the names of the two members of a beam that braces meet in the middle."""
    return f"{place}_1", f"{place}_2"


def _beam(place: BeamPlace, run: BeamRun, name: str, start: int, end: int, at_start: End, at_end: End) -> Member:
    return Member(
        name=name,
        kind="beam",
        start=start,
        end=end,
        section=run.section,
        material=run.material,
        group=run.group or "",
        web=Z,
        ends=(*_stiffness(at_start), *_stiffness(at_end)),
        storey=place.floor,
        frame=(frame_name(place.along, place.frame),),
        bay=place.bay,
    )


def _stiffness(end: End) -> tuple[float, float]:
    """Rotational stiffness about y and z of one end."""
    if isinstance(end, float):
        return end, RIGID
    return (RIGID, RIGID) if end == "rigid" else (0.0, 0.0)


def _braces(building: Building, nodes: Mapping[str, int], coordinates: np.ndarray) -> list[Member]:
    found = []
    for place, run in building.layout.brace_at.items():
        for way, points in ways(place, run).items():
            start, end = (nodes[_point_name(place, point)] for point in points)
            found.append(_brace(place, run, way, start, end, coordinates))
    return found


def _brace(place: BracePlace, run: BraceRun, way: str, start: int, end: int, coordinates: np.ndarray) -> Member:
    axis = coordinates[end] - coordinates[start]
    axis = axis / np.linalg.norm(axis)
    level = np.array(X if place.along == "x" else Y)
    web = (axis @ level) * np.array(Z) - axis[2] * level  # in the plane of the frame, at right angles to the brace
    return Member(
        name=place.name(way),
        kind="brace",
        start=start,
        end=end,
        section=run.section,
        material=run.material,
        group=run.group or "",
        web=(float(web[0]), float(web[1]), float(web[2])),
        ends=(0.0, 0.0, 0.0, 0.0),
        axial_only=True,
        bracing=run.kind,
        compression=run.in_compression,
        storey=place.storey,
        frame=(frame_name(place.along, place.frame),),
        bay=place.bay,
    )


def _point_name(place: BracePlace, point: Point) -> str:
    line, floor = point
    return node_name(line, floor) if line is not None else str(BeamPlace(*place[:3], floor))
