"""What record files say of their earthquake and station, and which component they hold."""

from __future__ import annotations

import re
from pathlib import Path

from edesign.ground_motion.catalogue.candidate import Facts
from edesign.ground_motion.formats import esm, knet
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.peer_header import read_peer_header
from edesign.ground_motion.peer_name import PeerName
from edesign.project.records.records import FileFormat

_VERTICAL_WORD = re.compile(r"(up|ud|u-d|down|dwn|dn|vert|vertical|ver|vrt|v|z)[0-9]?", re.IGNORECASE)
_VERTICAL_NAME = re.compile(r"(UP|DWN|DOWN|VERT|VER|VRT)$|[-_.](V|Z|UD|U|D)$|HNZ$", re.IGNORECASE)
_RSN = re.compile(r"RSN0*([1-9][0-9]{0,5})_", re.IGNORECASE)
_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?")


def facts_of(path: Path, file_format: FileFormat) -> Facts:
    """Return what a file and its name say of the recording.

    Args:
        path: of the file.
        file_format: its format.

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
    if file_format == "esm":
        said = {
            m[1].upper(): m[2]
            for line in read_lines(path)[:64]
            if (m := esm.KEY.match(line)) and m[2].lower() != "none"
        }
        station = " ".join(said[key] for key in ("NETWORK", "STATION_CODE") if said.get(key)) or None
        date, event = said.get("EVENT_DATE_YYYYMMDD", ""), said.get("EVENT_NAME") or said.get("EVENT_ID")
        return Facts(
            event or date or None,
            int(date[:4]) if date[:4].isdigit() else None,
            station,
            magnitude=_positive(said.get("MAGNITUDE_W", "")),
            v_s30=_positive(said.get("VS30_M/S", "")),
        ).over(found)
    if file_format == "afad":
        lines = read_lines(path, "iso-8859-9")[:20]
        values = {key: line.partition(":")[2].strip() for line in lines for key in _AFAD if knet.has_key(line, key)}
        date, size = values.get(_AFAD[0], ""), values.get(_AFAD[1], "")
        return Facts(
            date or None,
            int(date[:4]) if date[:4].isdigit() else None,
            values.get(_AFAD[2]) or None,
            magnitude=_positive(size) if size.lower().endswith("mw") else None,
        ).over(found)
    if file_format == "knet":
        lines = read_lines(path)[:17]
        values = {key: line[len(key) :].strip() for line in lines for key in _KNET if knet.has_key(line, key)}
        origin = values.get(knet.FIRST)
        year = int(origin[:4]) if origin and origin[:4].isdigit() else None
        return Facts(origin, year, values.get("Station Code"), magnitude=_positive(values.get("Mag.", ""))).over(found)
    return found


def is_vertical(path: Path, label: str) -> bool:
    """Return whether a component is the vertical one, as far as its label or the name of its file tells.

    Args:
        path: of the file.
        label: of the component; "" without one.
    """
    if label:
        return any(_VERTICAL_WORD.fullmatch(word) for word in re.split(r"[\s:,]+", label)) or label.endswith("NZ")
    name = PeerName.parse(path.name)
    return _VERTICAL_NAME.search(name.component if name else path.stem) is not None


_AFAD = ("EARTHQUAKE DATE", "EARTHQUAKE MAGNITUDE", "STATION ID")
_KNET = (knet.FIRST, "Mag.", "Station Code")


def _positive(text: str) -> float | None:
    match = _NUMBER.match(text)
    return float(match[0]) or None if match else None
