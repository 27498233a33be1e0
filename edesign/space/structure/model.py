"""The numerical model of a space frame: members with the properties of their sections."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.core.space import PROPERTIES, SpaceMembers, SpaceModel
from edesign.project.building.building import Steel
from edesign.space.structure.frame import SpaceFrame

MASTER = "floor."
"""Beginning of the names of nodes at the centres of mass of diaphragms."""
TENSION_ONLY_SHARE = 0.5
"""Share of its area that a brace has in the model if it does not count in compression."""
GRAVITY_SHARE = 1e-6
"""Share of its area that a brace has under gravity: it then carries a millionth of what it would by its own stiffness.

Source: EN 1998-1:2004, 6.7.2(1)P: under gravity only beams and columns resist. Floors still need something that holds
them where all beams of a direction are pinned.
"""


def space_model(frame: SpaceFrame, materials: Mapping[str, Steel], gravity: bool = False) -> SpaceModel:
    """Return the model of a frame; the master of each diaphragm is at the centre of its mass.

    Braces that do not count in compression come in pairs, of which one is in tension. In a linear model each has half
    its area, so that a pair is as stiff as the one that acts (`TENSION_ONLY_SHARE`; EN 1998-1, 6.7.2(2)P).

    Args:
        materials: of the file, by name.
        gravity: braces hold the floors in place and carry nothing else, `GRAVITY_SHARE` of their area; but those beside
            seismic links, on which beams rest, have all of it.

    Raises:
        CoreError: the structure is a mechanism, or is not connected to its supports.
    """
    members = frame.members
    start, end = frame.ends
    properties = dict(zip(PROPERTIES, member_properties(frame, materials, gravity).T, strict=True))
    return SpaceModel(
        coordinates=frame.coordinates,
        node_floor=frame.node_diaphragm,
        masters=masters(frame),
        fixed=frame.fixed,
        springs=frame.springs,
        members=SpaceMembers(
            start=start,
            end=end,
            web=np.array([member.web for member in members]),
            ends=np.array([member.ends for member in members]),
            axial_only=np.array([member.axial_only for member in members]),
            **properties,
        ),
        node_names=frame.node_names,
        member_names=tuple(member.name for member in members),
    )


def member_properties(frame: SpaceFrame, materials: Mapping[str, Steel], gravity: bool = False) -> np.ndarray:
    """Return the properties of the members in the model, in the order of `PROPERTIES`.

    Args:
        gravity: see `space_model`.

    Returns:
        (n_members, 8), SI.
    """
    pairs, of_members = frame.sections
    table = []
    for name, of in pairs:
        section, steel = frame.section(name), materials[of]
        G = steel.E / (2.0 * (1.0 + steel.nu))
        table.append([steel.E, G, *(getattr(section, key) for key in PROPERTIES[2:])])
    found = np.array(table)[of_members]
    found[:, PROPERTIES.index("A")] *= np.where(frame.in_compression, 1.0, TENSION_ONLY_SHARE)
    stiffer = np.array([member.stiffness_factor for member in frame.members])
    axial = np.array([member.axial_only for member in frame.members], dtype=bool)
    found[:, PROPERTIES.index("A")] *= np.where(axial, stiffer, 1.0)
    found[:, PROPERTIES.index("I_y")] *= np.where(axial, 1.0, stiffer)
    if gravity:
        braces = [member.kind == "brace" and not member.eccentric for member in frame.members]
        found[braces, PROPERTIES.index("A")] *= GRAVITY_SHARE
    return found


def masters(frame: SpaceFrame) -> np.ndarray:
    """Return the centre of mass of each diaphragm, or of its nodes if it has no mass, (n_diaphragms, 2) m."""
    found = []
    for number in range(len(frame.diaphragms)):
        own = frame.node_diaphragm == number
        mass = frame.node_mass[own]
        found.append(np.average(frame.coordinates[own, :2], axis=0, weights=mass if mass.any() else None))
    return np.array(found).reshape(-1, 2)
