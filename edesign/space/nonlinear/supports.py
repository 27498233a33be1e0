"""Supports of a building in the core's model, and turns of nodes that nothing restrains."""

from __future__ import annotations

import numpy as np

from edesign.core import Model
from edesign.frame.supports import Direction, Grounds, support_springs
from edesign.space.nonlinear.gravity import member_axes
from edesign.space.structure.frame import NO_DIAPHRAGM, SpaceFrame

_SETTLED = 0.5  # of the component of a local axis along the global one that it is


def add_supports(frame: SpaceFrame, model: Model) -> tuple[dict[str, tuple[bool, ...]], dict[str, Grounds]]:
    """Support the column bases, and fix turns that nothing restrains and nothing works on.

    Args:
        frame: of the building.
        model: of the core, which has the nodes of the frame in their order.

    Returns:
        By name of the supported node the degrees that are restrained, and the other ends of its springs.
    """
    supports: dict[str, tuple[bool, ...]] = {}
    grounds: dict[str, Grounds] = {}
    loose = unrestrained_turns(frame)
    for node, name in enumerate(frame.node_names):
        held = frame.fixed[node].copy()
        held[3:] |= loose[node]
        if held.any():
            model.fix(node, **dict(zip(model.degrees, held.tolist(), strict=True)))
        restrained = frame.fixed[node] | (frame.springs[node] > 0.0)
        if restrained.any():
            supports[name] = tuple(restrained.tolist())
        if frame.springs[node].any():
            springs: list[Direction] = [value if value > 0.0 else "free" for value in frame.springs[node].tolist()]
            grounds[name] = support_springs(model, name, node, model.node_places[node], springs)
    return supports, grounds


def unrestrained_turns(frame: SpaceFrame) -> np.ndarray:
    """Return which turns of nodes about x, y, z neither a support, a rigid floor nor a member restrains, (n_nodes, 3).

    Members restrain the turns about their strong and weak axes where their ends are rigid. About its own axis a member
    hands a turn on from node to node, so that it restrains one where the other is. Members but for bars stand along
    the axes of the building.
    """
    held = frame.fixed[:, 3:] | (frame.springs[:, 3:] > 0.0)
    held[:, 2] |= frame.node_floor != NO_DIAPHRAGM
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
