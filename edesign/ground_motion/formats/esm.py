"""Reader of the ASCII files of ESM and ITACA: lines `KEY: VALUE`, then one sample a line.

Source: Engineering Strong Motion database (Luzi et al. 2020), header format DYNA 1.2 of 64 lines.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.facts import Facts, positive
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.project.reading.problems import listed
from edesign.tables.text import number

KEY = re.compile(r"\s*([A-Z][A-Z0-9_/^]*)\s*:\s*(.*?)\s*$", re.IGNORECASE)
_PEAK = re.compile(r"PGA_(.+)$")
STEP, COUNT = "SAMPLING_INTERVAL_S", "NDATA"
_Header = Mapping[str, tuple[int, str]]  # key: line from 1, value


def has_key(lines: list[str]) -> bool:
    """Say whether a line has a key that only such files have."""
    return not {STEP, COUNT}.isdisjoint(match[1].upper() for line in lines if (match := KEY.match(line)))


def channels_of(path: Path) -> list[Channel]:
    """Read a file of one component; the header gives step, number and unit of the samples.

    The component is called by its stream (`HNE`) or the last letter of it.

    Raises:
        InputError: a key is missing, the data are no acceleration or in an unknown unit, not as many samples as
            NDATA says, or something else than finite numbers.
    """
    lines = read_lines(path)
    first = next((i for i, line in enumerate(lines) if not KEY.match(line)), len(lines))
    header = {m[1].upper(): (i, m[2]) for i, line in enumerate(lines[:first], start=1) if (m := KEY.match(line))}
    _, quantity = header.get("DATA_TYPE", (0, "ACCELERATION"))
    if quantity.upper() != "ACCELERATION":
        raise InputError(
            f"{path}:{header['DATA_TYPE'][0]}: the file holds `{quantity}`; only ACCELERATION is read [E-REC-09]"
        )
    at, unit = _value(path, header, "UNITS")
    unit = unit.lower()
    if unit not in ACCELERATION_UNITS:
        raise InputError(f"{path}:{at}: unknown unit `{unit}`; allowed: {', '.join(ACCELERATION_UNITS)} [E-REC-10]")
    at, text = _value(path, header, STEP)
    step = number(text, path, at, f"{STEP}, the time step in s,")
    check_step(f"{path}:{at}", step, f"{STEP}: {text}")
    at, text = _value(path, header, COUNT)
    count = number(text, path, at, f"{COUNT}, the number of samples,")
    if count != int(count) or count < 2:
        raise InputError(f"{path}:{at}: {COUNT} = {text}; a whole number of at least 2 samples is expected [E-REC-04]")
    samples = [number(line.strip(), path, i) for i, line in enumerate(lines[first:], first + 1) if line.strip()]
    if len(samples) != count:
        raise InputError(f"{path}:{len(lines)}: {len(samples)} samples, but {COUNT} = {text} in line {at} [E-REC-05]")
    _check_peak(path, header, unit, np.array(samples))
    stream = header.get("STREAM", (0, ""))[1]
    channel = Channel(
        stream, (stream[-1:],), (ACCELERATION_UNITS[unit] * np.array(samples)).tolist(), step, _about(header)
    )
    return [channel]


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
        raise InputError(
            f"{path}:{len(header) or 1}: the header has no line `{key}:` (it has {listed(header, 6)}) [E-REC-03]"
        )
    if not header[key][1]:
        raise InputError(f"{path}:{header[key][0]}: `{key}:` has no value [E-REC-03]")
    return header[key]


def _about(header: _Header) -> str:
    def said(key: str, prefix: str = "") -> str:
        value = header.get(key, (0, ""))[1]
        return prefix + value if value and value.lower() != "none" else ""

    station = " ".join(part for part in (said("NETWORK"), said("STATION_CODE"), said("STATION_NAME")) if part)
    event = said("EVENT_NAME") or said("EVENT_ID")
    parts = (event, said("EVENT_DATE_YYYYMMDD"), said("MAGNITUDE_W", "Mw ") or said("MAGNITUDE_L", "ML "), station)
    return ", ".join(part for part in (*parts, said("PROCESSING", "processing: ")) if part)


def facts_of(path: Path) -> Facts:
    """Return what the header says of earthquake and station.

    Raises:
        InputError: the file cannot be read.
    """
    said = {m[1].upper(): m[2] for line in read_lines(path)[:64] if (m := KEY.match(line)) and m[2].lower() != "none"}
    date, event = said.get("EVENT_DATE_YYYYMMDD", ""), said.get("EVENT_NAME") or said.get("EVENT_ID")
    return Facts(
        event or date or None,
        int(date[:4]) if date[:4].isdigit() else None,
        " ".join(said[key] for key in ("NETWORK", "STATION_CODE") if said.get(key)) or None,
        magnitude=positive(said.get("MAGNITUDE_W", "")),
        v_s30=positive(said.get("VS30_M/S", "")),
    )


FORMAT = RecordFormat("ESM/ITACA ASCII", has_key, channels_of, several=False, facts=facts_of)
