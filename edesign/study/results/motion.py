"""The motion of a frame as it can be drawn: thinned out displacements of nodes and plastic rotations of members."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame import FrameModel
from edesign.study.results.recording import SINGLE, Quantity, coordinate

MOST_PICTURES = 600
"""Of a history: 15 a second of a motion of 40 s. All its samples would make the archive many times larger."""
SHORTEST = 1.0 / 30.0
"""Time between two pictures, s: more of them the eye does not separate."""
MOTION_TIME = "motion_time"
NODES = "node_displacement"
FINENESS = 2000
"""Steps, at least, up to the largest value of a quantity. Where the largest displacement is drawn as a tenth of a
screen, a step is a twentieth of a point of it. Values of all digits would make the motion four times larger."""


def node_displacements(frame: FrameModel, group: Group) -> Quantity:
    """Return the displacements and rotations of all nodes, and add the names of the nodes to the group.

    Args:
        group: of the history.
    """
    coordinate(group, "node", list(frame.nodes), "", "node of the frame")
    degrees = frame.model.degrees
    plane = frame.model.dimension == 2
    label = "to the right (m), upwards (m), anticlockwise (rad)" if plane else "along an axis (m), about it (rad)"
    coordinate(group, "node_degree", list(degrees), "", label)
    cells = tuple(((1.0, "displacement", number, at),) for number in frame.nodes.values() for at in range(len(degrees)))
    label = "displacement (m) and rotation (rad) of the node relative to the ground, gravity included"
    return Quantity(NODES, ("node", "node_degree"), (len(frame.nodes), len(degrees)), cells, "", label, True, ())


def picture_stride(time: np.ndarray) -> int:
    """Return the number of samples from one picture to the next.

    Args:
        time: of the samples, evenly spaced, s.
    """
    step = float(time[1] - time[0]) if time.size > 1 else SHORTEST
    return max(1, math.ceil(time.size / MOST_PICTURES), math.ceil(SHORTEST / step - 1e-9))


def store_motion(group: Group, quantities: Sequence[Quantity], response: Response) -> None:
    """Add quantities at the times of the pictures to a group.

    Args:
        group: of the history, with the coordinates of their dimensions.
        quantities: whose history was kept.
        response: of the history.
    """
    stride = picture_stride(response.time)
    coordinate(group, MOTION_TIME, response.time[::stride], "s", "time of the pictures of the motion")
    for quantity in quantities:
        shares = quantity.values(response)[::stride]
        translations = (shares.shape[-1] + 1) // 2 if quantity.name == NODES else None
        values = as_seen(shares, translations).astype(SINGLE)
        label = f"{quantity.long_name}, rounded for pictures"
        group.add(quantity.name, (MOTION_TIME, *quantity.dims), values, quantity.unit, label)


def as_seen(values: np.ndarray, translations: int | None = None) -> np.ndarray:
    """Return values rounded to multiples of a power of two, `FINENESS` or more of them up to the largest.

    Rotations of nodes, in rad, have the step of their displacements, in m: a member of 8 m is drawn nearer than that.

    Args:
        values: (pictures, ...); of nodes (pictures, nodes, degrees).
        translations: how many degrees of a node are displacements, not rotations; None: the values are not of nodes.
    """
    largest = float(np.max(np.abs(values[..., :translations]), initial=0.0))
    if not (np.isfinite(largest) and largest > 0.0):
        return values
    step = 2.0 ** math.floor(math.log2(largest / FINENESS))
    return np.asarray(step * np.rint(values / step))


def without_histories(quantities: Sequence[Quantity], moving: Sequence[Quantity]) -> list[Quantity]:
    """Return quantities, without the histories of those that `store_motion` stores.

    Args:
        quantities: all that are recorded.
        moving: those that `store_motion` stores at the times of the pictures.
    """
    named = {quantity.name for quantity in moving}
    return [replace(one, history=False) if one.name in named else one for one in quantities]
