"""What record files say of their earthquake and station, and which component they hold."""

from __future__ import annotations

import re
from pathlib import Path

from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.formats.read import COMPONENT_FORMATS
from edesign.ground_motion.peer_header import read_peer_header
from edesign.ground_motion.peer_name import PeerName
from edesign.project.records.records import FileFormat

_VERTICAL_WORD = re.compile(r"(up|ud|u-d|down|dwn|dn|vert|vertical|ver|vrt|v|z)[0-9]?", re.IGNORECASE)
_VERTICAL_NAME = re.compile(r"(UP|DWN|DOWN|VERT|VER|VRT)$|[-_.](V|Z|UD|U|D)$|HNZ$", re.IGNORECASE)
_RSN = re.compile(r"RSN0*([1-9][0-9]{0,5})_", re.IGNORECASE)


def facts_of(path: Path, file_format: FileFormat) -> Facts:
    """Return what a file and its name say of the recording.

    Raises:
        InputError: the file cannot be read.
    """
    rsn = _RSN.match(path.name)
    found = Facts(rsn=int(rsn[1]) if rsn else None)
    if file_format == "at2":
        header = read_peer_header(path)
        year = header.year
        if year is not None and year < 100:
            year += 1900  # two digits are of files of the last century
        return Facts(header.event or None, year, header.station or None).over(found)
    return COMPONENT_FORMATS[file_format].facts(path).over(found) if file_format in COMPONENT_FORMATS else found


def is_vertical(path: Path, label: str) -> bool:
    """Return whether a component is the vertical one, as far as its label or the name of its file shows.

    Args:
        label: of the component; "" without one.
    """
    if label:
        return any(_VERTICAL_WORD.fullmatch(word) for word in re.split(r"[\s:,]+", label)) or label.endswith("NZ")
    name = PeerName.parse(path.name)
    return _VERTICAL_NAME.search(name.component if name else path.stem) is not None
