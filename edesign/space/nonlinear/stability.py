"""What moves of a building that does not stand, in words: the building, a floor, or members at a node."""

from __future__ import annotations

import re

import numpy as np

from edesign.core import Modes
from edesign.frame.frame_model import FrameModel, RigidPart
from edesign.project.building.building import Building
from edesign.project.reading.problems import listed
from edesign.space.nonlinear.masses import MASTER

_FREE = re.compile(rf"((?:[A-Z]+\d+\.|{re.escape(MASTER)}(?:\d+\.)?|B[XY]_\w+\.?)\d*)\.(ux|uy|uz|rx|ry|rz)\b")
_ALONG = {"ux": "slides along x", "uy": "slides along y", "uz": "moves up and down"}


def free_motion(building: Building, text: str) -> str:
    """Return what a mechanism is, from the free degrees that an error names; "" if it names none.

    Args:
        building: from `load_building`.
    """
    named = _FREE.findall(text)
    if not named:
        return ""
    degrees = {degree for _, degree in named}
    turns = {degree for degree in degrees if degree.startswith("r")}
    level = {node: round(place[2], 6) for node, place in building.grid.nodes.items()}
    floors = {building.levels.index(level[node]) for node, _ in named if node in level}
    floors |= {int(node.removeprefix(MASTER).partition(".")[0]) for node, _ in named if node.startswith(MASTER)}
    if degrees == turns and not any(node.startswith(MASTER) for node, _ in named):
        node, degree = named[0]
        members = [name for name, ends in building.grid.ends.items() if node in ends]
        return f"{listed(members)} turn freely about {degree[1]} at {node}"
    subject = "the building" if 0 in floors else f"floor {min(floors)}"
    along = degrees - turns
    if len(along) == 1 and not any(node.startswith(MASTER) and degree == "rz" for node, degree in named):
        return f"{subject} {_ALONG[along.pop()]}"
    return f"{subject} turns about the vertical" if "uz" not in along else f"{subject} tilts"


def softest_motion(frame: FrameModel, modes: Modes) -> str:
    """Return which floor moves most in the first mode, and how.

    Args:
        frame: of the building.
    """
    found = []
    for body in (body for floor in frame.floors for body in floor.parts or (floor,)):
        x, y = (float(np.mean([modes.moved(one)[0] for one in alike])) for alike in body.movers)
        plan = np.array([frame.places[node][:2] for node in body.nodes])
        radius = 0.5 * float(np.hypot(*np.ptp(plan, axis=0)))
        turn = float(modes.moved(body.turn)[0]) * radius if body.turn else 0.0
        words = ("sways along x", "sways along y", "turns about the vertical")
        most = int(np.argmax(np.abs([x, y, turn])))
        subject = f"diaphragm {body.name}" if isinstance(body, RigidPart) else f"floor {body.number}"
        found.append((abs((x, y, turn)[most]), f"{subject} {words[most]}"))
    return max(found)[1]
