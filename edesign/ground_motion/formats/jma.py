"""Reader of the Japan Meteorological Agency's strong-motion tables (.csv): three components in gal.

Source: JMA, strong-motion data of major earthquakes: lines `SITE CODE=`, `LAT.=`, `LON.=`, `SAMPLING RATE=`, `UNIT  =`,
`INITIAL TIME =`, then the names of the columns and the samples.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_rate
from edesign.project.reading.problems import listed
from edesign.tables.text import number

_KEY = re.compile(r"\s*([A-Za-z][A-Za-z. ]*?)\s*=\s*(.*?)[\s,]*$")  # keys count in capitals
_SITE, _UNIT, _START = "SITE CODE", "UNIT", "INITIAL TIME"
_RATES = ("SAMPLING RATE", "SAMPLING FREQ")
_NAMES = {"NS": ("N-S", "N"), "EW": ("E-W", "E"), "UD": ("U-D", "U")}


def has_header(lines: list[str]) -> bool:
    """Say whether lines begin as such a table does."""
    keys = {match[1].upper() for line in lines[:10] if (match := _KEY.match(line))}
    return {_SITE, _UNIT} <= keys and any(rate in keys for rate in _RATES)


def channels_of(path: Path) -> list[Channel]:
    """Read the three components of a table; the recorder's offset is in them.

    The components are called NS, EW and UD.

    Raises:
        InputError: a key is missing, another unit than gal, something else than finite numbers, or lines of another
            number of columns.
    """
    lines = read_lines(path, "cp932")
    header = {match[1].upper(): (i, match[2]) for i, line in enumerate(lines[:10], 1) if (match := _KEY.match(line))}
    rate_key = next((key for key in _RATES if key in header), None)
    if rate_key is None or _UNIT not in header:
        raise InputError(
            f"{path}:1: the header has no `SAMPLING RATE=` or no `UNIT  =` (it has {listed(header)}) [E-REC-03]"
        )
    at, unit = header[_UNIT]
    if not re.match(r"gal\b", unit, re.IGNORECASE):
        raise InputError(f"{path}:{at}: UNIT = `{unit}`; gal(cm/s/s) is expected [E-REC-10]")
    at, text = header[rate_key]
    rate = number(re.sub(r"\s*Hz$", "", text, flags=re.IGNORECASE), path, at, f"{rate_key} in Hz")
    check_rate(f"{path}:{at}", rate)
    first = max(line for line, _ in header.values())
    while first < len(lines) and not lines[first].strip(" ,"):
        first += 1
    labels = [cell.strip() for cell in lines[first].rstrip(" ,").split(",")] if first < len(lines) else []
    if not labels or not all(re.fullmatch(r"[A-Za-z]+[-A-Za-z0-9]*", label) for label in labels):
        raise InputError(
            f"{path}:{first + 1}: the names of the columns, such as `NS,EW,UD`, are expected here [E-REC-03]"
        )
    rows = []
    for i, line in enumerate(lines[first + 1 :], first + 2):
        cells = line.strip().rstrip(" ,").split(",")
        if not line.strip(" ,"):
            continue
        if len(cells) != len(labels):
            raise InputError(
                f"{path}:{i}: {len(cells)} numbers; each line has one of each of {listed(labels)} [E-REC-07]"
            )
        rows.append([number(cell.strip(), path, i) for cell in cells])
    if len(rows) < 2:
        raise InputError(f"{path}:{len(lines)}: {len(rows)} lines of samples; a record needs at least 2 [E-REC-21]")
    said = [header[key][1] for key in (_START, _SITE) if key in header]
    about = ", ".join(part for part in ("JMA, unprocessed", *said) if part)
    return [
        Channel(label, _NAMES.get(label.upper(), ()), (0.01 * column).tolist(), 1.0 / rate, about)
        for label, column in zip(labels, np.array(rows).T, strict=True)
    ]


FORMAT = RecordFormat("JMA (Japan) .csv", has_header, channels_of)
