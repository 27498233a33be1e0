"""Rigid floors and masses of a building in the core's model."""

from __future__ import annotations

import numpy as np

from edesign.core import Model
from edesign.project.building.building import Building
from edesign.space.nonlinear.gravity import GravityLoads
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.load_cases import on_members
from edesign.space.structure.masses import mass_shift
from edesign.space.structure.model import diaphragm_floors, masters

IN_PLACE = (0.0, 0.0)
"""The eccentricity of masses that stand where loads and members put them."""


def add_masses(
    building: Building, frame: SpaceFrame, model: Model, eccentricity: tuple[float, float] = IN_PLACE
) -> tuple[dict[int, int], dict[str, float], dict[str, float]]:
    """Add rigid floors and masses to a model, which has the nodes of the frame in their order.

    Each rigid floor has a master at its centre of mass, with its mass and its moment of inertia in plan. Masses that
    resist vertical motion stay at the nodes, and so do loads where the masses of floors stand beside their places.

    Args:
        building: from `load_building`.
        eccentricity: by what shares of the lengths of each rigid floor its masses stand beside their places.

    Returns:
        Masters by floor, masses that resist horizontal motion by name of the node, kg, and those of the masters that
        resist turns about the vertical, kg m2.
    """
    found: dict[int, int] = {}
    masses: dict[str, float] = {}
    turning: dict[str, float] = {}
    single, shift = frame.node_mass.copy(), mass_shift(frame, eccentricity)
    for floor, (x, y) in zip(diaphragm_floors(frame), masters(frame).tolist(), strict=True):
        nodes = np.flatnonzero(frame.node_floor == floor)
        own, plan = frame.node_mass[nodes], frame.coordinates[nodes, :2]
        aside_x, aside_y = shift[nodes[0]].tolist()
        master = found[floor] = model.node(master_name(floor), x + aside_x, y + aside_y, float(frame.levels[floor]))
        model.fix(master, uz=True, rx=True, ry=True)
        model.diaphragm(master, nodes.tolist())
        mass = float(own.sum())
        if mass > 0.0:
            name = master_name(floor)
            masses[name], turning[name] = mass, float(own @ np.sum((plan - (x, y)) ** 2, axis=1))
            model.mass(master, mass, mass, turning[name])
        single[nodes] = 0.0
    upright = vertical_masses(building, frame)
    for node, name in enumerate(frame.node_names):
        if single[node] > 0.0 or upright[node] > 0.0:
            model.mass(node, float(single[node]), float(single[node]), mz=float(upright[node]))
        if single[node] > 0.0:
            masses[name] = float(single[node])
    return found, masses, turning


def master_name(floor: int) -> str:
    """Return the name of the node at the centre of mass of a rigid floor."""
    return f"floor.{floor}"


def vertical_masses(building: Building, frame: SpaceFrame) -> np.ndarray:
    """Return the mass of each node that resists vertical motion, (n_nodes,) kg; none unless the file asks for it.

    Args:
        building: from `load_building`.
    """
    both = building.masses is not None and building.masses.directions == "both"
    return frame.node_mass if both else np.zeros_like(frame.node_mass)


def still_beams(building: Building, frame: SpaceFrame, loads: GravityLoads) -> tuple[str, ...]:
    """Return the names of the loaded beams that vertical ground motion does not bend.

    A beam vibrates on its own where it ends at a node with mass that no column or brace supports.

    Args:
        building: from `load_building`.
    """
    hanging = vertical_masses(building, frame) > 0.0
    for member in frame.members:
        if member.kind != "beam":
            hanging[[member.start, member.end]] = False
    loaded = np.any(on_members(frame, loads.case), axis=1)
    return tuple(
        member.name
        for member, carries in zip(frame.members, loaded, strict=True)
        if member.kind == "beam" and carries and not (hanging[member.start] or hanging[member.end])
    )
