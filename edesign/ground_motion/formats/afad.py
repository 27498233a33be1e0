"""Reader of AFAD's own text files: a header of lines `KEY : VALUE`, then columns of the three components in gal.

Source: files of the Turkish national strong-motion network (kyhdata.deprem.gov.tr). Its later service, TADAS, gives
files of the ESM format.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.facts import Facts, positive
from edesign.ground_motion.formats.knet import has_key
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.project.reading.problems import listed
from edesign.tables.text import number

FIRST = "STRONG GROUND MOTION RECORDS OF TUR"  # as the file begins; the country is written in more than one way
COUNT, STEP, PEAKS = "NUMBER OF DATA", "SAMPLING INTERVAL", "RAW PGA VALUES"
_KEY = re.compile(r"\s*([A-Z][A-Z ]*?)\s*(?:\(([^)]*)\))?\s*:\s*(.*?)\s*$", re.IGNORECASE)  # key, unit, value
_COLUMNS = re.compile(r"\s*[A-Z]-[A-Z](?:\s+[A-Z]-[A-Z])*\s*$", re.IGNORECASE)  # N-S E-W U-D
_PEAK = re.compile(r"\(([A-Z]-[A-Z])\)\s*([-+0-9.Ee]+)", re.IGNORECASE)
_UNITS = {"gal": ACCELERATION_UNITS["cm/s^2"], "cm/s2": ACCELERATION_UNITS["cm/s^2"]}
_NAMES = {"N-S": ("N", "HNN"), "E-W": ("E", "HNE"), "U-D": ("U", "Z", "HNZ")}
_Header = Mapping[str, tuple[int, str, str]]  # key: line from 1, unit, value


def has_first(lines: list[str]) -> bool:
    """Say whether the first line is that of such a file."""
    return any(FIRST in line.upper() for line in lines[:1])


def channels_of(path: Path) -> list[Channel]:
    """Read the three components of a file; the header gives step, number, unit and peaks of the samples.

    Its components are called N-S, E-W and U-D, or by their first letters.

    Raises:
        InputError: a key is missing, an unknown unit, not as many lines as the header says, something else than
            finite numbers, or a peak that is not the one that the header states.
    """
    lines = read_lines(path, "iso-8859-9")
    at = next((i for i, line in enumerate(lines) if _COLUMNS.match(line)), None)
    if at is None:
        raise InputError(f"{path}: no line names the components of the columns, such as `N-S  E-W  U-D` [E-REC-03]")
    header = {m[1].upper(): (i, m[2] or "", m[3]) for i, line in enumerate(lines[:at], 1) if (m := _KEY.match(line))}
    line, unit, stated = _value(path, header, PEAKS)
    if unit.lower() not in _UNITS:
        raise InputError(f"{path}:{line}: unknown unit `{unit}` of {PEAKS}; read are {listed(_UNITS)} [E-REC-10]")
    line, unit_of_step, text = _value(path, header, STEP)
    step = number(text, path, line, f"{STEP}, the time step in s,")
    if unit_of_step.lower() not in ("sec", "s"):
        raise InputError(f"{path}:{line}: {STEP} is expected in sec, not in `{unit_of_step}` [E-REC-10]")
    check_step(f"{path}:{line}", step, f"{STEP} {text}")
    components = lines[at].upper().split()
    rows = _rows(path, lines, at + 1, len(components))
    line, _, text = _value(path, header, COUNT)
    if not text.isdecimal() or len(rows) != int(text):
        raise InputError(
            f"{path}:{len(lines)}: {len(rows)} lines of samples, but {COUNT} = {text} in line {line} [E-REC-05]"
        )
    samples = np.array(rows)
    _check_peaks(path, header, components, samples)
    about = _about(header)
    return [
        Channel(label, _NAMES.get(label, ()), (_UNITS[unit.lower()] * column).tolist(), step, about)
        for label, column in zip(components, samples.T, strict=True)
    ]


def _value(path: Path, header: _Header, key: str) -> tuple[int, str, str]:
    if key not in header:
        raise InputError(
            f"{path}:{len(header) or 1}: the header has no line `{key}` (it has {listed(header, 6)}) [E-REC-03]"
        )
    if not header[key][2]:
        raise InputError(f"{path}:{header[key][0]}: `{key}` has no value [E-REC-03]")
    return header[key]


def _rows(path: Path, lines: Sequence[str], start: int, width: int) -> list[list[float]]:
    rows = []
    for i, line in enumerate(lines[start:], start + 1):
        words = line.split()
        if words and len(words) != width:
            raise InputError(
                f"{path}:{i}: {len(words)} numbers; each line has one of each of the {width} components [E-REC-07]"
            )
        if words:
            rows.append([number(word, path, i) for word in words])
    return rows


def _check_peaks(path: Path, header: _Header, components: Sequence[str], samples: np.ndarray) -> None:
    """The columns have the peaks of the header: so their order and unit are those that it names."""
    line, unit, stated = header[PEAKS]
    peaks = {m[1].upper(): m[2] for m in _PEAK.finditer(stated)}
    for label, column in zip(components, samples.T, strict=True):
        if label not in peaks:
            raise InputError(f"{path}:{line}: {PEAKS} has no value of {label} [E-REC-03]")
        peak, found = number(peaks[label], path, line, f"the peak of {label}"), float(np.max(np.abs(column)))
        last_digit = 10.0 ** -len(peaks[label].partition(".")[2])
        if abs(abs(peak) - found) > last_digit:
            raise InputError(
                f"{path}:{line}: the header has a peak of {peaks[label]} {unit} for {label}, the column {found:g}; "
                "the file is damaged, or its columns are not what the header says [E-REC-22]"
            )


def _about(header: _Header) -> str:
    def said(key: str) -> str:
        return header.get(key, (0, "", ""))[2]

    place = " ".join(part for part in (said("STATION ID"), said("PLACE")) if part)
    parts = ("AFAD, unprocessed", said("EARTHQUAKE DATE"), said("EARTHQUAKE MAGNITUDE"), place)
    return ", ".join(part for part in parts if part)


def facts_of(path: Path) -> Facts:
    """Return what the header says of earthquake and station.

    Raises:
        InputError: the file cannot be read.
    """
    lines = read_lines(path, "iso-8859-9")[:20]
    values = {key: line.partition(":")[2].strip() for line in lines for key in _FACTS if has_key(line, key)}
    date, size, station = (values.get(key, "") for key in _FACTS)
    return Facts(
        date or None,
        int(date[:4]) if date[:4].isdigit() else None,
        station or None,
        magnitude=positive(size) if size.lower().endswith("mw") else None,
    )


_FACTS = ("EARTHQUAKE DATE", "EARTHQUAKE MAGNITUDE", "STATION ID")

FORMAT = RecordFormat("AFAD text with three components", has_first, channels_of, facts=facts_of)
