"""Masses at the nodes."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.frame.leaning_column import leaning_masses
from edesign.frame.loads import beam_loads, node_loads
from edesign.project.actions.loads import Combination
from edesign.project.notation import names
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project

STILL_BEAMS = "beams_without_vertical_motion"
"""Attribute of a history with vertical motion: the names that `still_beams` returns."""


def node_masses(project: Project) -> dict[str, float]:
    """Return the mass of every node that has one, in kg, by name: that of the frame, and what leans on it.

    Given masses are taken as they are. From loads, a node gets its own load and what each beam that ends there
    would bring as a simply supported one, divided by the standard acceleration of gravity. Horizontal loads on columns
    have no mass. That of the leaning column stands at the leading nodes of the floors.

    Raises:
        InputError: loads upwards would give a negative mass.
    """
    found, leaning = _frame_masses(project), leaning_masses(project)
    if not leaning:
        return found
    both = {node: found.get(node, 0.0) + leaning.get(node, 0.0) for node in project.frame.nodes}
    return {node: mass for node, mass in both.items() if mass > 0.0}


def vertical_masses(project: Project) -> dict[str, float]:
    """Return the mass of every node that resists vertical motion, in kg, by name; the leaning column has none.

    Raises:
        InputError: loads upwards would give a negative mass.
    """
    if project.masses is None or project.masses.directions == "horizontal":
        return {}
    return _frame_masses(project)


def still_beams(project: Project) -> list[str]:
    """Return the names of the loaded beams that vertical ground motion does not bend.

    Masses stand at nodes. What a beam carries between two nodes that columns or braces support is at these nodes, and
    shakes the columns alone. A beam that is divided by a node with mass that hangs in it vibrates on its own.

    Raises:
        InputError: loads upwards would give a negative mass.
    """
    frame, masses = project.frame, vertical_masses(project)
    supported = {node for name, ends in frame.ends.items() if name not in frame.beam_members for node in ends}
    loaded = beam_loads(project, project.loads.gravity)
    return [
        name
        for name, beam in frame.beam_members.items()
        if name in loaded and all(node in supported or node not in masses for node in (beam.start, beam.end))
    ]


def _frame_masses(project: Project) -> dict[str, float]:
    """Mass of the nodes of the frame itself, kg, by name."""
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
    for name, loads in on_beams.items():
        beam = frame.beam_members[name]
        for node, weight in zip((beam.start, beam.end), loads.at_ends(beam.length), strict=True):
            weights[node] = weights.get(node, 0.0) + weight
    for node, weight in weights.items():
        if weight < 0.0:
            where = project.where("masses", "from_loads")
            raise InputError(
                f"{where}: masses.from_loads: node {node} would get the mass of a load upwards, {weight:g} N"
                " [E-MASS-01]"
            )
    return {node: weights[node] / STANDARD_GRAVITY for node in frame.nodes if weights.get(node, 0.0) > 0.0}
