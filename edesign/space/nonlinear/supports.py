"""Supports of a building in the core's model, and turns of nodes that nothing restrains."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.core import Model
from edesign.frame.footings import FootingSprings
from edesign.frame.supports import BuiltFooting, Direction, Grounds, add_footing, support_springs
from edesign.project.building.building import Building
from edesign.project.building.names import node_name
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.nonlinear.gravity import member_axes
from edesign.space.nonlinear.masses import master_name
from edesign.space.structure.frame import NO_DIAPHRAGM, SpaceFrame

_IN_PLAN = np.array([True, True, False, False, False, True])
_SETTLED = 0.5  # of the component of a local axis along the global one that it is


@dataclass(frozen=True)
class BuiltSupports:
    """Where a building stands, by name of the supported node.

    Attributes:
        restrained: which degrees are.
        grounds: the other ends of springs.
        footings: in the core.
    """

    restrained: dict[str, tuple[bool, ...]] = field(default_factory=dict)
    grounds: dict[str, Grounds] = field(default_factory=dict)
    footings: dict[str, BuiltFooting] = field(default_factory=dict)


def add_supports(
    building: Building,
    frame: SpaceFrame,
    model: Model,
    footings: Mapping[str, FootingSprings],
    masters: Sequence[int],
) -> BuiltSupports:
    """Support column bases and floors that the ground holds, and fix turns that nothing restrains or works on.

    A diaphragm that is fixed in plan is so at its master, where its reactions are.

    Args:
        building: from `load_building`.
        model: of the core, which has the nodes of the frame in their order.
        footings: by lines of columns; a line whose footing is not among them is fixed.
        masters: ids, by diaphragm.
    """
    found = BuiltSupports()
    of_diaphragms: dict[int, np.ndarray] = {}
    loose = unrestrained_turns(frame)
    on_footings = {node_name(line, 0): footings.get(line) for line in building.footings}
    for node, name in enumerate(frame.node_names):
        fixed = frame.fixed[node].copy()
        if (tied := int(frame.node_diaphragm[node])) != NO_DIAPHRAGM and (fixed & _IN_PLAN).any():
            of_diaphragms[tied] = fixed & _IN_PLAN
            fixed &= ~_IN_PLAN
        held = fixed.copy()
        held[3:] |= loose[node]
        held |= name in on_footings and on_footings[name] is None
        if held.any():
            model.fix(node, **dict(zip(model.degrees, held.tolist(), strict=True)))
        restrained = fixed | (frame.springs[node] > 0.0)
        if restrained.any():
            found.restrained[name] = tuple(restrained.tolist())
        if name in on_footings:
            if footing := on_footings[name]:
                place = model.node_places[node]
                found.grounds[name], found.footings[name] = add_footing(model, name, node, place, footing)
        elif frame.springs[node].any():
            springs: list[Direction] = [value if value > 0.0 else "free" for value in frame.springs[node].tolist()]
            found.grounds[name] = support_springs(model, name, node, model.node_places[node], springs)
    for number, fixed in of_diaphragms.items():
        ux, uy, _, _, _, rz = found.restrained[master_name(frame.diaphragms[number])] = tuple(fixed.tolist())
        model.fix(masters[number], ux=ux, uy=uy, rz=rz, uz=True, rx=True, ry=True)
    return found


def weights_of(footings: Mapping[str, BuiltFooting], factor: float) -> dict[str, float]:
    """Return the weights of the blocks of footings in the gravity combination, N, by the node on them.

    Args:
        factor: of permanent loads.
    """
    return {name: factor * built.springs.mass * STANDARD_GRAVITY for name, built in footings.items()}


def unrestrained_turns(frame: SpaceFrame) -> np.ndarray:
    """Return which turns of nodes about x, y, z neither a support, a rigid floor nor a member restrains, (n_nodes, 3).

    Members restrain the turns about their strong and weak axes where their ends are rigid. About its own axis a member
    hands a turn on from node to node, so that it restrains one where the other is. Members but for bars stand along
    the axes of the building.
    """
    held = frame.fixed[:, 3:] | (frame.springs[:, 3:] > 0.0)
    held[:, 2] |= frame.node_diaphragm != NO_DIAPHRAGM
    along = np.argmax(np.abs(member_axes(frame)) > _SETTLED, axis=2)
    handed = []
    for member, (twist, about_y, about_z) in zip(frame.members, along, strict=True):
        if member.axial_only:
            continue
        of_start, of_end = member.ends[:2], member.ends[2:]
        for node, stiffness in ((member.start, of_start), (member.end, of_end)):
            held[node, about_y] |= stiffness[0] > 0.0
            held[node, about_z] |= stiffness[1] > 0.0
        handed.append((member.start, member.end, int(twist)))
    settled = False
    while not settled:
        settled = True
        for start, end, axis in handed:
            if held[start, axis] != held[end, axis]:
                held[start, axis] = held[end, axis] = True
                settled = False
    return np.asarray(~held)
