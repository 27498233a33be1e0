"""Rigid floors and masses of a building in the core's model."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.core import Model
from edesign.frame.tuned_masses import Attached
from edesign.project.building.building import Building
from edesign.project.building.layout import Diaphragm
from edesign.project.building.names import node_name
from edesign.space.nonlinear.gravity import GravityLoads
from edesign.space.structure.frame import NO_DIAPHRAGM, SpaceFrame
from edesign.space.structure.load_cases import on_members
from edesign.space.structure.masses import mass_shift
from edesign.space.structure.model import MASTER, masters

IN_PLACE = (0.0, 0.0)
"""The eccentricity of masses that stand where loads and members put them."""


def add_masses(
    building: Building,
    frame: SpaceFrame,
    model: Model,
    attachments: Sequence[Attached] = (),
    eccentricity: tuple[float, float] = IN_PLACE,
) -> tuple[list[int], dict[str, float], dict[str, float]]:
    """Add diaphragms and masses to a model, which has the nodes of the frame in their order.

    Each diaphragm has a master at its centre of mass, with its mass and its moment of inertia in plan. Masses that
    resist vertical motion stay at the nodes, and so do loads where the masses of floors stand beside their places.
    Across its direction a tuned mass moves with its floor, as a part of it.

    Args:
        building: from `load_building`.
        eccentricity: by what shares of the lengths of each diaphragm its masses stand beside their places.

    Returns:
        Masters of the diaphragms, masses that resist horizontal motion by name of the node, kg, without tuned masses,
        and those of the masters that resist turns about the vertical, kg m2.
    """
    found: list[int] = []
    masses: dict[str, float] = {}
    turning: dict[str, float] = {}
    single, shift = frame.node_mass.copy(), mass_shift(frame, eccentricity)
    for number, (diaphragm, centre) in enumerate(zip(frame.diaphragms, masters(frame), strict=True)):
        nodes = np.flatnonzero(frame.node_diaphragm == number)
        riders = [item for item in attachments if ridden(frame, item) == number]
        at = [attachment_place(frame, item)[:2] for item in riders]
        plan = np.vstack([frame.coordinates[nodes, :2] + shift[nodes], *at])
        own, centre = frame.node_mass[nodes], centre + shift[nodes[0]]
        along = [np.append(own, [item.mass * (item.direction != axis) for item in riders]) for axis in (0, 1)]
        # what moves along y turns the floor by its lever along x
        x, y = (of @ plan[:, i] / of.sum() if of.any() else centre[i] for i, of in enumerate(along[::-1]))
        name = master_name(diaphragm)
        master = model.node(name, float(x), float(y), float(frame.levels[diaphragm.floor]))
        found.append(master)
        model.fix(master, uz=True, rx=True, ry=True)
        model.diaphragm(master, nodes.tolist())
        in_x, in_y = along
        inertia = float(in_x @ (plan[:, 1] - y) ** 2 + in_y @ (plan[:, 0] - x) ** 2)
        model.mass(master, float(in_x.sum()), float(in_y.sum()), inertia)
        if own.any():
            masses[name], turning[name] = float(own.sum()), inertia
        single[nodes] = 0.0
    for item in attachments:
        if ridden(frame, item) == NO_DIAPHRAGM:
            model.mass(_line_node(frame, item), *(item.mass * (item.direction != axis) for axis in (0, 1)))
    upright = vertical_masses(building, frame)
    for node, name in enumerate(frame.node_names):
        if single[node] > 0.0 or upright[node] > 0.0:
            model.mass(node, float(single[node]), float(single[node]), mz=float(upright[node]))
        if single[node] > 0.0:
            masses[name] = float(single[node])
    return found, masses, turning


def attachment_place(frame: SpaceFrame, item: Attached) -> np.ndarray:
    """Return the place of a tuned mass on its column line, or at the centre of the mass of its rigid floor, (3,) m."""
    if item.at:
        return np.asarray(frame.coordinates[_line_node(frame, item)])
    return np.append(masters(frame)[ridden(frame, item)], frame.levels[item.floor])


def ridden(frame: SpaceFrame, item: Attached) -> int:
    """Return the number of the diaphragm that a tuned mass stands on; `NO_DIAPHRAGM`: it stands at a node alone."""
    if item.at:
        return int(frame.node_diaphragm[_line_node(frame, item)])
    return [at.floor for at in frame.diaphragms].index(item.floor)


def _line_node(frame: SpaceFrame, item: Attached) -> int:
    return frame.node_names.index(node_name(item.at, item.floor))


def master_name(diaphragm: Diaphragm) -> str:
    """Return the name of the node at the centre of mass of a diaphragm."""
    return f"{MASTER}{diaphragm}"


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
