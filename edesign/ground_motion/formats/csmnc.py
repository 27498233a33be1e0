"""Reader of the China Strong Motion Network Centre (.dat): one component in cm/s2.

Source: files of the Institute of Engineering Mechanics, China Earthquake Administration: 16 lines of text, then
samples of equal width.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import without_padding
from edesign.ground_motion.formats.header_peak import check_peak, last_place
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.tables.text import number

_COUNT = re.compile(r"\s*NO\.?\s+OF\s+POINTS\s*:\s*(\S+)\s+EQUALLY\s+SPACED\s+INTERVALS\s+OF\s*:\s*(\S+)\s+SEC", re.I)
_UNIT = re.compile(r"\s*(.*?)\s+UNIT\s*:\s*(\S+)", re.IGNORECASE)
_PEAK = re.compile(r"\s*PEAK\s+VALUE\s*:\s*(\S+)", re.IGNORECASE)
_COMPONENT = re.compile(r"\s*COMP\.?\s+(\S+)", re.IGNORECASE)
_MAGNITUDE = re.compile(r"\s*MAGNITUDE\s+([0-9.]+)\s*(?:\((\w+)\))?", re.IGNORECASE)
_STATION = re.compile(r"\s*STATION\s*:\s*(\S+)", re.IGNORECASE)
_UNITS = {"CM/SEC/SEC": 0.01, "CM/SEC2": 0.01, "CM/S/S": 0.01, "GAL": 0.01, "CM/S2": 0.01}
_NUMBER = re.compile(r"\s*([-+]?[0-9]*\.[0-9]+(?:[ED][-+]?[0-9]{1,2})?)(?=[-+\s]|$)", re.IGNORECASE)
_TEXTS = 20  # lines within which the samples begin


def has_header(lines: list[str]) -> bool:
    """Say whether lines have the header of such a file."""
    head = lines[:_TEXTS]
    return any(_COUNT.match(line) for line in head) and any(_PEAK.match(line) for line in head)


def channels_of(path: Path) -> list[Channel]:
    """Read a file of one component; step, number, unit and peak come from the header.

    The component is called EW, NS or UD.

    Raises:
        InputError: velocity or displacement, another unit than cm/s2, not as many samples as the header says,
            something else than finite numbers, or a peak that is not that of the header.
    """
    lines = read_lines(path, "gb18030")
    found = {
        key: _line(path, lines, pattern, what)
        for key, pattern, what in (
            ("count", _COUNT, "NO. OF POINTS: ...  EQUALLY SPACED INTERVALS OF: ...  SEC"),
            ("unit", _UNIT, "UNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC"),
            ("peak", _PEAK, "PEAK VALUE: ..."),
            ("component", _COMPONENT, "COMP. EW"),
        )
    }
    at, match = found["unit"]
    quantity, unit = match[1].upper(), match[2].upper()
    if "ACCEL" not in quantity or unit not in _UNITS:
        raise InputError(f"{path}:{at}: `{match[0].strip()}`; only accelerations in CM/SEC/SEC are read [E-REC-09]")
    at, match = found["count"]
    count = int(number(match[1], path, at, "the number of points"))
    step = number(match[2], path, at, "the interval in s")
    check_step(f"{path}:{at}", step)
    if count < 2:
        raise InputError(f"{path}:{at}: {count} points; a record needs at least 2 [E-REC-21]")
    values, digit = _samples(path, lines, at, count)
    if len(values) != count:
        raise InputError(f"{path}:{len(lines)}: {len(values)} samples, but {count} points in line {at} [E-REC-05]")
    samples = np.array(values)
    at, match = found["peak"]
    check_peak(f"{path}:{at}", match[1], float(np.abs(samples).max()), "cm/s2", digit)
    label = found["component"][1][1]
    acceleration = (_UNITS[unit] * samples).tolist()
    return [Channel(label, (label[:1],), acceleration, step, _about(lines, quantity))]


def _line(path: Path, lines: list[str], pattern: re.Pattern[str], what: str) -> tuple[int, re.Match[str]]:
    for i, line in enumerate(lines[:_TEXTS], 1):
        if match := pattern.match(line):
            return i, match
    raise InputError(f"{path}:{min(len(lines), _TEXTS)}: none of the first lines is such as `{what}` [E-REC-01]")


def _samples(path: Path, lines: list[str], header: int, count: int) -> tuple[list[float], float]:
    """The samples, below the first line after `header` that has nothing but numbers, and the last digit of the peak."""
    values: list[float] = []
    digit, peak, words = 0.0, -1.0, list[str]()
    for i, line in enumerate(lines[header:], header + 1):
        if not line.strip() or (not values and _NUMBER.sub("", line).strip()):
            continue
        if _NUMBER.sub("", line).strip():
            raise InputError(f"{path}:{i}: `{line.strip()[:60]}`: accelerations are expected here [E-REC-08]")
        words = _NUMBER.findall(line)
        for word in words:
            values.append(number(word, path, i))
            if abs(values[-1]) > peak:
                digit, peak = last_place(word), abs(values[-1])
    return without_padding(values, count, len(words)), digit


def _about(lines: list[str], quantity: str) -> str:
    head = lines[:_TEXTS]
    magnitude = next((found for line in head if (found := _MAGNITUDE.match(line))), None)
    station = next((found[1] for line in head if (found := _STATION.match(line))), "")
    parts = (
        "CSMNC (China)",
        quantity.replace("ACCELERATION", "").strip().lower(),
        " ".join(lines[2].split()) if len(lines) > 2 else "",
        f"{magnitude[2] or 'M'} {magnitude[1]}" if magnitude else "",
        station,
    )
    return ", ".join(part for part in parts if part)


FORMAT = RecordFormat("CSMNC (China) .dat", has_header, channels_of)
