"""What moves of a building that is a mechanism, in words: the building, a floor, or members at a node."""

from __future__ import annotations

import re

from edesign.project.building.building import Building
from edesign.project.notation.axes import LETTERED, NUMBERED
from edesign.project.reading.problems import listed
from edesign.space.structure.model import MASTER

_LINE = LETTERED + NUMBERED
_FREE = re.compile(rf"((?:{_LINE}\.|{re.escape(MASTER)}(?:\d+\.)?|B[XY]_[\w']+\.?)\d*)\.(ux|uy|uz|rx|ry|rz)\b")
_OF_A_FLOOR = re.compile(rf"\b(ux|uy|rz) of the diaphragm of {_LINE}\.(\d+)")
_ALONG = {"ux": "slides along x", "uy": "slides along y", "uz": "moves up and down"}


def free_motion(building: Building, text: str) -> str:
    """Return what a mechanism is, from the free degrees that an error names; "" if it names none.

    Args:
        building: from `load_building`.
    """
    named = _FREE.findall(_OF_A_FLOOR.sub(rf"{MASTER}\2.\1", text))
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
