"""Reader of CSMIP files of evenly spaced points: volume 1 (.V1, .RAW, uncorrected, in g) and volume 2 (.V2).

Volume 2 has acceleration, velocity and displacement of each channel in turn, in cm/s2; so has that of the University
of Southern California.
"""

from __future__ import annotations

import re
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import FieldFormat, field_format, is_end_of_data, read_fields
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_rate, check_step
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.tables.text import number

DATA = re.compile(
    r"\s*([0-9]{1,9})\s+points\s+of\s+acc\w*\s+data\s+equally\s+spaced\s+at\s+(\S+)\s+sec\s*"
    # the second in files of the 1980s, the third in those of USC, which may leave the unit out
    r"(?:,\s*in\s+|[.,]*\s*\(units:\s*|[.,]*\s*in\s+units\s+|[.,]*\s*$)([^\s)]*)",
    re.IGNORECASE,
)
_RATED = re.compile(
    r"\s*([0-9]{1,9})\s+accelerogram\s+points\s+at\s+(\S+)\s+pts/sec\s+in\s+units\s+of\s+(\S+)", re.IGNORECASE
)
SPECTRA = re.compile(r"\s*Response and Fourier amplitude spectra\b", re.IGNORECASE)
_CHANNEL = re.compile(r"\bChan\s+([0-9]{1,9})\s*:\s*(\S+(?:\s+Deg)?)", re.IGNORECASE)
_MAGNITUDE = re.compile(r"\bM[A-Za-z]\s*[:=]\s*([0-9.]+)")
_UNITS = {**dict.fromkeys(("cm/sec2", "cm/sec/sec", "cms/sec/sec", "cm/s/s", "cm/s2"), 0.01), "g": STANDARD_GRAVITY}
_PEAK = re.compile(r"\bPeak\s+acceleration\s*=\s*(\S+)\s+(\S+)", re.IGNORECASE)  # of volume 2
_MAXIMUM = re.compile(r"\bMax\s*=\s*(\S+?)\.?\s+(g)\b", re.IGNORECASE)  # of volume 1; volume 2 repeats it
_COMPONENT = re.compile(r"\s*COMP\s+(\S+)")  # of USC
_EVENT, _STATION = 8, 6  # lines of the text header, from 0; volume 1 lacks the first of them


def _data_line(line: str) -> re.Match[str] | None:
    """Match a line that announces accelerations: number of points, their step or rate, and their unit."""
    return DATA.match(line) or _RATED.match(line)


def has_data(lines: list[str]) -> bool:
    """Say whether lines announce evenly spaced accelerations, or are those of a file of volume 3."""
    return bool(lines) and (SPECTRA.match(lines[0]) is not None or any(_data_line(line) for line in lines))


def channels_of(path: Path) -> list[Channel]:
    """Read the acceleration of all channels; each peak must be that of the header.

    A channel is called by its number or its orientation (`360 Deg`, `360`, `Up`).

    Raises:
        InputError: no evenly spaced accelerations, truncated, another unit than cm/s2 or g, something else than
            finite numbers, or a peak that is not that of the header.
    """
    lines = read_lines(path)
    if SPECTRA.match(lines[0]):
        raise InputError(
            f"{path}:1: a file of CSMIP volume 3 holds response and Fourier spectra, no accelerations; the record is "
            "in the file of volume 2 (.V2) [E-REC-09]"
        )
    channels: list[Channel] = []
    start = 0
    for i, line in enumerate(lines):
        if match := _data_line(line):
            channels.append(_channel(path, lines, start, i, match))
        elif is_end_of_data(line):
            start = i + 1
    if not channels:
        raise InputError(
            f"{path}: no line such as `12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)`"
            " [E-REC-03]"
        )
    return channels


def _channel(path: Path, lines: list[str], start: int, at: int, match: re.Match[str]) -> Channel:
    where = f"{path}:{at + 1}"
    texts = [" ".join(line.split()) for line in lines[start:at]]
    if _is_usc(texts):  # its lines end with their length, and with the volume that they come from
        texts = [re.sub(r"\s[0-9]+\s?(VOL1)?$", "", text) for text in texts]
    peak = next((found for text in texts if (found := _PEAK.search(text))), None)
    count, unit = int(match[1]), (match[3] or (peak[2] if peak is not None else "")).rstrip(".,").lower()
    step = number(match[2], path, at + 1, "the time step in s")
    if count < 2:
        raise InputError(f"{where}: {count} points; a record needs at least 2 [E-REC-21]")
    if match.re is _RATED:
        check_rate(where, step)
        step = 1.0 / step
    check_step(where, step)
    if unit not in _UNITS:
        raise InputError(f"{where}: unknown unit of acceleration `{unit}`; read are {', '.join(_UNITS)} [E-REC-10]")
    layout = _layout(lines, at, path)
    values = read_fields(lines, at + 1, count, layout, path)
    _no_more(path, lines, at, count, layout)
    corrected = unit != "g"
    _check_peak(path, lines, (start, at), values, corrected)
    number_of, orientation = next(((m[1], m[2]) for text in texts if (m := _CHANNEL.search(text))), ("1", ""))
    if not orientation:
        orientation = next((m[1] for text in texts if (m := _COMPONENT.match(text))), "")
    shift = 0 if corrected else 1
    parts = [texts[k - shift] for k in (_EVENT, _STATION) if k - shift < len(texts)]
    magnitudes = [m[0] for text in texts[: _EVENT + 3] if (m := _MAGNITUDE.search(text))]
    names = (number_of, orientation, re.sub(r"\s*deg", "", orientation, flags=re.IGNORECASE))
    label = ": ".join(part for part in (number_of, orientation) if part)
    who = "volume 2, University of Southern California form" if _is_usc(texts) else "CSMIP volume 2"
    about = ", ".join(
        part for part in (who if corrected else "CSMIP volume 1, uncorrected", *parts, *magnitudes) if part
    )
    acceleration = [_UNITS[unit] * value for value in values]
    return Channel(label, tuple(n for n in names if n), acceleration, step, about)


def _is_usc(texts: list[str]) -> bool:
    return any("OF VOLUME I:" in text for text in texts[:3])


def _check_peak(path: Path, lines: list[str], header: tuple[int, int], values: list[float], corrected: bool) -> None:
    """The samples have the peak of the header, to its digits; `header` are its lines, from 0."""
    pattern = _PEAK if corrected else _MAXIMUM
    example = lines[header[1] + 1].split(".", 1)[1:]
    digits = len(re.match(r"[0-9]*", example[0])[0]) if example else 0  # type: ignore[index]
    for i, line in enumerate(lines[header[0] : header[1]], header[0] + 1):
        if match := pattern.search(line):
            found = max(abs(value) for value in values)
            check_peak(f"{path}:{i}", match[1], found, "cm/s2" if corrected else "g", 10.0**-digits)
            return


def _layout(lines: list[str], at: int, path: Path) -> FieldFormat:
    """The format in the line that announces the data; where it has none, that of the first line of the data.

    Fortran writes a number at the right end of its field, so a line ends with a field, and its width is the length of
    the line over the number of decimal points. The other lines are checked against it as they are read.
    """
    first = lines[at + 1].rstrip() if at + 1 < len(lines) else ""
    fields = first.count(".")
    if "(" in re.sub(r"\(units:[^)]*\)", "", lines[at], flags=re.IGNORECASE) or not fields or len(first) % fields:
        return field_format(lines[at], path, at + 1)
    return FieldFormat(fields, len(first) // fields, whole=False)


def _no_more(path: Path, lines: list[str], at: int, count: int, layout: FieldFormat) -> None:
    """The line after the data announces velocities or ends the channel."""
    end = at + 1 + layout.lines(count)
    if (
        end < len(lines)
        and lines[end].strip()
        and not is_end_of_data(lines[end])
        and "points" not in lines[end].lower()
    ):
        raise InputError(f"{path}:{end + 1}: more data than the {count} points announced in line {at + 1} [E-REC-06]")


FORMAT = RecordFormat("CSMIP .V1/.V2", has_data, channels_of)
