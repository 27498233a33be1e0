"""The direction of a horizontal component, as names of components and headers of files say it."""

from __future__ import annotations

import math
import re
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.catalogue.file_facts import is_vertical
from edesign.ground_motion.formats.channels import choose
from edesign.ground_motion.formats.read import COMPONENT_FORMATS, detect
from edesign.ground_motion.peer_header import read_peer_header
from edesign.ground_motion.peer_name import PeerName
from edesign.project.records.records import FileFormat

_PEER = re.compile(r".*[A-Z0-9-](?P<degrees>[012][0-9]{2}|3[0-5][0-9]|360)", re.IGNORECASE)
_DEGREES = re.compile(r"(?:[0-9]+: *)?(?P<degrees>[0-9]{3}|[0-9]{1,3}(?= *deg))(?: *deg)?", re.IGNORECASE)
_BEARING = re.compile(r"(?:[0-9]+: *)?(?P<from>[NS]) *(?P<degrees>[0-9]{1,2}) *(?P<to>[EW])", re.IGNORECASE)
_COMPASS = re.compile(
    r"(?:.*?[-_.: ])??(?:[BEHS][GHLN](?=[NE]))?(?P<letter>N(?:-?S)?|E(?:-?W)?|S|W)[12]?", re.IGNORECASE
)
_OF_LETTER = {"N": 0.0, "E": 90.0, "S": 180.0, "W": 270.0}

RIGHT_ANGLE = math.radians(1.0)
"""By how much directions of a pair may miss a right angle, rad: both are printed in whole degrees."""


def azimuth_of(component: str) -> float | None:
    """Return the azimuth that the name of a component says.

    Known are codes of PEER (`H-E07140`, `TCU045-N`), degrees (`340 deg`), bearings (`N10E`) and points of the compass
    (`N-S`, `HNE`).

    Args:
        component: its name; numbers of channels (`1: 340 deg`) may stand before it.

    Returns:
        Clockwise from north, rad; None: the name does not say it.
    """
    name = component.strip()
    if found := _BEARING.fullmatch(name):
        degrees = float(found["degrees"])
        if found["from"].upper() == "S":
            degrees = 180.0 - degrees
        return math.radians((degrees if found["to"].upper() == "E" else -degrees) % 360.0)
    if found := _COMPASS.fullmatch(name):
        return math.radians(_OF_LETTER[found["letter"][0].upper()])
    if found := _DEGREES.fullmatch(name) or _PEER.fullmatch(name):
        return math.radians(float(found["degrees"]) % 360.0)
    return None


def azimuth_of_file(
    path: Path, file_format: FileFormat | None = None, component: str | int | None = None
) -> float | None:
    """Return the azimuth that a file says of a component.

    Args:
        file_format: its format; None: it is found.
        component: name or number in the file; None: the only one.

    Returns:
        Clockwise from north, rad; None: the file does not say it.

    Raises:
        InputError: the file cannot be read, or the component is the vertical one.
    """
    found = file_format or detect(path)
    label = choose(path, COMPONENT_FORMATS[found].channels(path), component).label if found in COMPONENT_FORMATS else ""
    if is_vertical(path, label):
        raise InputError(f"{path}: this is a vertical component, and a horizontal one is needed [E-PAIR-03]")
    if found != "at2":
        return azimuth_of(label)
    degrees, name = read_peer_header(path).azimuth, PeerName.parse(path.name)
    if degrees is None:
        return azimuth_of(name.component) if name else None
    return math.radians(degrees % 360)


def at_right_angles(first: float, second: float) -> bool:
    """Return whether two directions are at right angles, to the whole degree.

    Args:
        first: azimuth, rad.
        second: azimuth, rad.
    """
    return abs(math.cos(first - second)) <= math.sin(RIGHT_ANGLE) * (1.0 + 1e-9)
