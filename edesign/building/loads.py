"""Loads of a project: combinations, loads of each beam and node."""

from __future__ import annotations

from edesign.project import names
from edesign.project.loads import BeamLoad, Combination, NodeLoad
from edesign.project.project import Project


def combined(load: BeamLoad | NodeLoad, factors: Combination) -> float:
    """Return factors.G * G + factors.Q * Q of a load, positive downwards."""
    return factors.G * load.G + factors.Q * load.Q


def beam_loads(project: Project, factors: Combination) -> dict[str, float]:
    """Return the uniform load of every loaded beam in N/m, positive downwards, by name; loads on one beam add up.

    The halves of a beam that braces meet in the middle have their names.
    """
    found: dict[str, float] = {}
    for load in project.loads.beams:
        for place in project.frame.standing_beams(load):
            for name in dict.fromkeys(project.frame.ends_of_beam(*place)):
                found[name] = found.get(name, 0.0) + combined(load, factors)
    return {name: value for name, value in found.items() if value != 0.0}


def node_loads(project: Project, factors: Combination) -> dict[str, float]:
    """Return the load on every loaded node in N, positive downwards, by name; loads on one node add up."""
    found: dict[str, float] = {}
    for load in project.loads.nodes:
        for place in project.frame.node_places(load.lines, load.floors):
            name = names.node_name(*place)
            found[name] = found.get(name, 0.0) + combined(load, factors)
    return {name: value for name, value in found.items() if value != 0.0}


def gravity_load(project: Project) -> float:
    """Return the sum of the loads of the gravity combination on beams and nodes, N, positive downwards."""
    beams = project.frame.beam_members
    on_beams = beam_loads(project, project.loads.gravity)
    uniform = sum(load * beams[name].length for name, load in on_beams.items())
    return uniform + sum(node_loads(project, project.loads.gravity).values())
