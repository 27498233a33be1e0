"""The load cases of the elastic design: those of the loads, with patterns, and the own ones of the file, as wind."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from edesign.project.building.building import Building
from edesign.project.building.names import ColumnLine, node_name
from edesign.project.building.own_cases import FacadePressure, FloorForce, LoadCaseOfFile, cases_of, facing
from edesign.space.structure.area_loads import BeamShare
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.load_cases import LoadSum, add_area, case_of, load_cases

_X, _Y, _RZ = 0, 1, 5


def design_cases(building: Building, frame: SpaceFrame) -> dict[str, LoadCase]:
    """Return the load cases of the elastic design by name; a reversed one is two: `wind_x` and `-wind_x`.

    Args:
        building: from `load_building`.
    """
    found = load_cases(building, frame, building.loads.pattern != "none")
    for name, case, factor in cases_of(building.loads.cases):
        found[name] = _own_case(building, frame, name, case, factor)
    return found


def _own_case(building: Building, frame: SpaceFrame, name: str, case: LoadCaseOfFile, factor: float) -> LoadCase:
    loads = LoadSum(case.category)
    for area in case.areas:
        add_area(building, loads, area, factor * area.q)
    for beam in case.beams:
        for place in building.layout.beam_places(beam):
            if place in building.layout.beam_at:
                loads.add(place, BeamShare(factor * beam.q))
    found = case_of(name, loads, frame)
    nodes = {node: i for i, node in enumerate(frame.node_names)}
    for force in case.nodes:
        for floor in force.floors.numbers(1, building.n_storeys):
            for line in building.lines_of(force.at):
                if line in building.layout.node_lines[floor]:
                    found.nodal[nodes[node_name(line, floor)], :3] += np.array([force.x, force.y, -force.down]) * factor
    for of_floor in case.floors:
        _add_floor_force(building, frame, found.nodal, of_floor, factor)
    for facade in case.facades:
        axis, inwards = facing(facade.side)
        for line, floor, size in facade_areas(building, facade):
            found.nodal[nodes[node_name(line, floor)], axis] += factor * inwards * facade.pressure * size
    return replace(found, own=True, relieving=case.relieving)


def _add_floor_force(
    building: Building, frame: SpaceFrame, nodal: np.ndarray, force: FloorForce, factor: float
) -> None:
    """Add the force on each floor at one of the nodes that it ties, with its moment about this node."""
    for floor in force.floors.numbers(1, building.n_storeys):
        number = next(k for k, at in enumerate(frame.diaphragms) if at.floor == floor)
        node = int(np.flatnonzero(frame.node_diaphragm == number)[0])
        x, y = floor_middle(building, floor) if force.at is None else (force.at.x, force.at.y)
        beside_x, beside_y = x - frame.coordinates[node, 0], y - frame.coordinates[node, 1]
        nodal[node, [_X, _Y]] += np.array([force.x, force.y]) * factor
        nodal[node, _RZ] += (beside_x * force.y - beside_y * force.x) * factor


def floor_middle(building: Building, floor: int) -> tuple[float, float]:
    """Return the middle of the extent of a floor, m: half-way between its outermost lines."""
    panels = building.layout.floors[floor]
    middle = []
    for k, along in enumerate(("x", "y")):
        places = building.coordinates("x" if along == "x" else "y")
        numbers = [panel[k] for panel in panels]
        middle.append(0.5 * (places[min(numbers) - 1] + places[max(numbers)]))
    return middle[0], middle[1]


def facade_areas(building: Building, facade: FacadePressure) -> Iterator[tuple[ColumnLine, int, float]]:
    """Yield column line, floor and the area of facade whose load comes there, m2; floor 0 is the base.

    A storey of height h and a bay of width b bring h b / 4 to each of the four nodes at their corners.
    """
    for storey in facade.storeys.numbers(1, building.n_storeys):
        height = building.storey_heights[storey - 1]
        for lines, width in building.layout.faces(storey, facade.side):
            for line in lines:
                for floor in (storey - 1, storey):
                    yield line, floor, 0.25 * height * width
