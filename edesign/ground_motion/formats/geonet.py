"""Reader of the accelerograms of GeoNet, New Zealand (.V1A uncorrected, .V2A corrected): three components in mm/s2.

Source: GNS Science, strong motion file formats: for each component 16 lines of text, 40 integers (10I8), 60 reals
(10F8), accelerations (10F8.1), and in corrected files velocities and displacements.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import FieldFormat, read_fields
from edesign.ground_motion.formats.header_peak import check_peak, last_place
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.tables.text import number

TITLE = re.compile(r"\s*(Uncorrected|Corrected)\s+accelerogram\b(.*)", re.IGNORECASE)
_MARK = re.compile(r"(Raw readings|corrected data)\b.*\bintervals", re.IGNORECASE)  # in line 11 of the text
_PEAK = re.compile(r"Acceleration:\s*peak\s+(\S+)\s*mm/s/s", re.IGNORECASE)
_UNIT = re.compile(r"units of\s+(\S+)\s*mm/s/s", re.IGNORECASE)
_INTERVAL = re.compile(r"\b(?:at|intervals of)\s+([0-9]*\.[0-9]+)\s*s(?:ec)?(?:\s+intervals)?\s*$", re.IGNORECASE)
_TEXTS = 16
_HEADER = _TEXTS + 4 + 6
_FIELDS = 10
_LAYOUT = FieldFormat(_FIELDS, 8, True)  # of all numbers; a point may be missing where they are large
_WITHOUT_POINT = 9999.5  # mm/s2
_DIGITIZED, _SAMPLES, _VELOCITIES, _DISPLACEMENTS = 30, 33, 34, 35  # of the integers, from 0: numbers of samples
_DIRECTION = 27  # of the integers: bearing of the component, degrees
_STEP = 25  # of the reals, from 0: interval of these samples, s (24 is that of the recorder)


def has_title(lines: list[str]) -> bool:
    """Say whether lines begin as a GeoNet file does."""
    return bool(lines) and TITLE.match(lines[0]) is not None and any(_MARK.search(line) for line in lines[9:13])


def channels_of(path: Path) -> list[Channel]:
    """Read the acceleration of all components; velocities and displacements are passed over.

    A component is called as in the file (`N10E`, `S16W`, `Up`), or by its bearing in degrees.

    Raises:
        InputError: a header that is not of this form; truncated; something else than finite numbers; a peak that is
            not that of the header.
    """
    lines = read_lines(path)
    channels: list[Channel] = []
    at = 0
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        channel, at = _channel(path, lines, at)
        channels.append(channel)
    return channels


def _channel(path: Path, lines: list[str], start: int) -> tuple[Channel, int]:
    """The component that begins at line `start` (from 0), and the line after it."""
    title = TITLE.match(lines[start])
    if title is None:
        raise InputError(
            f"{path}:{start + 1}: a component of a GeoNet file begins with a line such as `Corrected accelerogram ...`"
            " [E-REC-01]"
        )
    if start + _HEADER >= len(lines):
        raise InputError(
            f"{path}:{len(lines)}: the file ends within the {_HEADER} lines of header of a component [E-REC-05]"
        )
    texts = lines[start : start + _TEXTS]
    integers = read_fields(lines, start + _TEXTS, 40, _LAYOUT, path, "a whole number of the header")
    reals = read_fields(lines, start + _TEXTS + 4, 60, _LAYOUT, path, "a real number of the header")
    corrected = title[1].lower() == "corrected"
    count, step = int(integers[_SAMPLES] or integers[_DIGITIZED]), reals[_STEP]
    if count < 2:
        raise InputError(f"{path}:{start + _TEXTS + 4}: {count} samples; a record needs at least 2 [E-REC-21]")
    check_step(f"{path}:{start + _TEXTS + 7}", step)
    for i, text in enumerate(texts, start + 1):
        if (match := _INTERVAL.search(text)) and abs(number(match[1], path, i) - step) > last_place(match[1]):
            raise InputError(
                f"{path}:{i}: samples at {match[1]} s, but {step:g} s among the numbers of the header [E-REC-18]"
            )
    units = [(i, match[1]) for i, text in enumerate(texts, start + 1) if (match := _UNIT.search(text))]
    unit = number(units[0][1], path, units[0][0], "the unit of the samples in mm/s/s") if units else 1.0
    values = unit * np.array(_samples(path, lines, start + _HEADER, count))
    for i, text in enumerate(texts, start + 1):
        if (match := _PEAK.search(text)) is not None:
            peak = float(np.abs(values).max())
            check_peak(f"{path}:{i}", match[1], peak, "mm/s2", unit if peak >= _WITHOUT_POINT * unit else 0.1 * unit)
    counts = (count, int(integers[_VELOCITIES]), int(integers[_DISPLACEMENTS])) if corrected else (count,)
    end = start + _HEADER + sum(-(-number // _FIELDS) for number in counts)
    if end > len(lines):
        raise InputError(
            f"{path}:{len(lines)}: the file ends within the velocities and displacements of a component [E-REC-05]"
        )
    label = next((text.split()[1] for text in texts if re.match(r"\s*Component\s+\S", text)), f"{len(lines)}")
    bearing = () if label.lower() in ("up", "down") else (f"{int(integers[_DIRECTION])}",)
    return Channel(label, bearing, (0.001 * values).tolist(), step, _about(texts, title[1].lower())), end


def _samples(path: Path, lines: list[str], first: int, count: int) -> list[float]:
    """The samples; those above 9999.9 mm/s2 are written as whole numbers, and no others."""
    values = read_fields(lines, first, count, _LAYOUT, path)
    for k, value in enumerate(values):
        i, at = first + k // _FIELDS, 8 * (k % _FIELDS)
        word = lines[i][at : at + 8].strip()
        if abs(value) < _WITHOUT_POINT and "." not in word:
            raise InputError(f"{path}:{i + 1}: `{word}` has no decimal point; it cannot be read safely [E-REC-08]")
    return values


def _about(texts: list[str], kind: str) -> str:
    magnitude = re.search(r"\b(M[A-Za-z]?)\s+([0-9.]+)\s*$", texts[8])
    site = re.match(r"\s*Site\s+(\S+)", texts[1])
    parts = (
        f"GeoNet, {kind}",
        " ".join(texts[7].split()),
        f"{magnitude[1]} {magnitude[2]}" if magnitude else "",
        " ".join(part for part in (site[1] if site else "", " ".join(texts[2].split())) if part),
    )
    return ", ".join(part for part in parts if part)


FORMAT = RecordFormat("GeoNet .V1A/.V2A", has_title, channels_of)
