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
    for name, load in on_beams.items():
        beam = frame.beam_members[name]
        for node in (beam.start, beam.end):
            weights[node] = weights.get(node, 0.0) + load * 0.5 * beam.length
    for node, weight in weights.items():
        if weight < 0.0:
            where = project.where("masses", "from_loads")
            raise InputError(
                f"{where}: masses.from_loads: node {node} would get the mass of a load upwards, {weight:g} N"
            )
    return {node: weights[node] / STANDARD_GRAVITY for node in frame.nodes if weights.get(node, 0.0) > 0.0}
