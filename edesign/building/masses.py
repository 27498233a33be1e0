"""Masses at the nodes."""

from __future__ import annotations

from edesign.building.loads import beam_loads, node_loads
from edesign.errors import InputError
from edesign.project import names
from edesign.project.loads import Combination
from edesign.project.project import Project
from edesign.project.units import STANDARD_GRAVITY


def node_masses(project: Project) -> dict[str, float]:
    """Return the mass of every node that has one, in kg, by name.

    Given masses are taken as they are. From loads, a node gets its own load and that of half the span of each beam that
    ends there, divided by the standard acceleration of gravity.

    Raises:
        InputError: loads upwards would give a negative mass.
    """
    masses = project.masses
    if masses is None:
        return {}
    if masses.from_loads is not None:
        return _from_loads(project, masses.from_loads)
    return {
        names.node_name(*place): given.mass
        for given in masses.given or ()
        for place in project.frame.node_places(given.lines, given.floors)
    }


def _from_loads(project: Project, factors: Combination) -> dict[str, float]:
    frame = project.frame
    weights = node_loads(project, factors)
    on_beams = beam_loads(project, factors)
    for bay, floor in frame.beam_at:
        half_span = 0.5 * frame.bay_widths[bay - 1]
        load = on_beams.get(names.beam_name(bay, floor), 0.0)
        for line in frame.bay_lines(bay):
            node = names.node_name(line, floor)
            weights[node] = weights.get(node, 0.0) + load * half_span
    for node, weight in weights.items():
        if weight < 0.0:
            where = project.where("masses", "from_loads")
            raise InputError(
                f"{where}: masses.from_loads: node {node} would get the mass of a load upwards, {weight:g} N"
            )
    return {node: weights[node] / STANDARD_GRAVITY for node in frame.nodes if weights.get(node, 0.0) > 0.0}
