"""Reader of the ASCII files of ESM and ITACA: lines `KEY: VALUE`, then one sample a line.

Source: Engineering Strong Motion database (Luzi et al. 2020), header format DYNA 1.2 of 64 lines.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, choose
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.ground_motion.record import Record
from edesign.project.reading.problems import listed
from edesign.tables.text import number

KEY = re.compile(r"\s*([A-Z][A-Z0-9_/^]*)\s*:\s*(.*?)\s*$", re.IGNORECASE)
_PEAK = re.compile(r"PGA_(.+)$")
STEP, COUNT = "SAMPLING_INTERVAL_S", "NDATA"
_Header = Mapping[str, tuple[int, str]]  # key: line from 1, value


def read_esm(path: Path | str, component: str | None = None, name: str = "") -> Record:
    """Read a file of one component; the header gives step, number and unit of the samples.

    Args:
        path: the file.
        component: if given it must be that of the file: its stream (`HNE`) or the last letter of it.
        name: of the record; its file name without ending by default.

    Raises:
        InputError: a key is missing, the data are no acceleration or in an unknown unit, not as many samples as
            NDATA says, something else than finite numbers, or another component.
    """
    path = Path(path)
    lines = read_lines(path)
    first = next((i for i, line in enumerate(lines) if not KEY.match(line)), len(lines))
    header = {m[1].upper(): (i, m[2]) for i, line in enumerate(lines[:first], start=1) if (m := KEY.match(line))}
    _, quantity = header.get("DATA_TYPE", (0, "ACCELERATION"))
    if quantity.upper() != "ACCELERATION":
        raise InputError(f"{path}:{header['DATA_TYPE'][0]}: the file holds `{quantity}`; only ACCELERATION is read")
    at, unit = _value(path, header, "UNITS")
    unit = unit.lower()
    if unit not in ACCELERATION_UNITS:
        raise InputError(f"{path}:{at}: unknown unit `{unit}`; allowed: {', '.join(ACCELERATION_UNITS)}")
    at, text = _value(path, header, STEP)
    step = number(text, path, at, f"{STEP}, the time step in s,")
    check_step(f"{path}:{at}", step, f"{STEP}: {text}")
    at, text = _value(path, header, COUNT)
    count = number(text, path, at, f"{COUNT}, the number of samples,")
    if count != int(count) or count < 2:
        raise InputError(f"{path}:{at}: {COUNT} = {text}; a whole number of at least 2 samples is expected")
    samples = [number(line.strip(), path, i) for i, line in enumerate(lines[first:], first + 1) if line.strip()]
    if len(samples) != count:
        raise InputError(f"{path}:{len(lines)}: {len(samples)} samples, but {COUNT} = {text} in line {at}")
    _check_peak(path, header, unit, np.array(samples))
    stream = header.get("STREAM", (0, ""))[1]
    channel = Channel(
        stream, (stream[-1:],), (ACCELERATION_UNITS[unit] * np.array(samples)).tolist(), step, _about(header)
    )
    return choose(path, [channel], component).record(path, name)


def _check_peak(path: Path, header: _Header, unit: str, samples: np.ndarray) -> None:
    """The samples have the peak of the header, which stands in a unit of its own: PGA_CM/S^2."""
    for key, (line, stated) in header.items():
        match = _PEAK.match(key)
        if match is None or not stated or match[1].lower() not in ACCELERATION_UNITS:
            continue
        factor = ACCELERATION_UNITS[unit] / ACCELERATION_UNITS[match[1].lower()]
        number(stated, path, line, key)
        check_peak(f"{path}:{line}", stated, factor * float(np.abs(samples).max()), match[1].lower(), 1e-6 * factor)


def _value(path: Path, header: _Header, key: str) -> tuple[int, str]:
    if key not in header:
        raise InputError(f"{path}:{len(header) or 1}: the header has no line `{key}:` (it has {listed(header, 6)})")
    if not header[key][1]:
        raise InputError(f"{path}:{header[key][0]}: `{key}:` has no value")
    return header[key]


def _about(header: _Header) -> str:
    def said(key: str, prefix: str = "") -> str:
        value = header.get(key, (0, ""))[1]
        return prefix + value if value and value.lower() != "none" else ""

    station = " ".join(part for part in (said("NETWORK"), said("STATION_CODE"), said("STATION_NAME")) if part)
    event = said("EVENT_NAME") or said("EVENT_ID")
    parts = (event, said("EVENT_DATE_YYYYMMDD"), said("MAGNITUDE_W", "Mw ") or said("MAGNITUDE_L", "ML "), station)
    return ", ".join(part for part in (*parts, said("PROCESSING", "processing: ")) if part)
