"""Reader of the older CSMIP volume 2 files (.V2): per channel acceleration, velocity and displacement in turn."""

from __future__ import annotations

import re
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.channels import Channel, choose
from edesign.ground_motion.fixed_width import FieldFormat, field_format, is_end_of_data, read_fields
from edesign.ground_motion.record import Record
from edesign.ground_motion.text import read_lines
from edesign.tables.text import number

DATA = re.compile(
    r"\s*([0-9]+)\s+points\s+of\s+accel\w*\s+data\s+equally\s+spaced\s+at\s+(\S+)\s+sec\s*"
    r"(?:,\s*in\s+|[.,]*\s*\(units:\s*)([^\s)]+)",  # the latter in files of the 1980s
    re.IGNORECASE,
)
_CHANNEL = re.compile(r"\bChan\s+([0-9]+)\s*:\s*(\S+(?:\s+Deg)?)", re.IGNORECASE)
_MAGNITUDE = re.compile(r"\bM[A-Za-z]\s*[:=]\s*([0-9.]+)")
_UNITS = ("cm/sec2", "cm/sec/sec", "cm/s/s", "cm/s2")
_EVENT, _STATION = 8, 6  # lines of the text header, from 0


def read_csmip(path: Path | str, component: str | int | None = None, name: str = "") -> Record:
    """Read the corrected acceleration of one channel.

    Args:
        path: the file.
        component: number of the channel or its orientation (`360 Deg`, `360`, `Up`); needed if there are several.
        name: of the record; its file name without ending by default.

    Raises:
        InputError: no data of corrected acceleration, truncated, another unit than cm/s2, something else than finite
            numbers, or `component` does not name one channel.
    """
    path = Path(path)
    return choose(path, channels_of(path), component).record(path, name)


def channels_of(path: Path) -> list[Channel]:
    """Read the corrected acceleration of all channels; errors as `read_csmip`."""
    lines = read_lines(path)
    channels: list[Channel] = []
    start = 0
    for i, line in enumerate(lines):
        if match := DATA.match(line):
            channels.append(_channel(path, lines, start, i, match))
        elif is_end_of_data(line):
            start = i + 1
    if not channels:
        raise InputError(
            f"{path}: no line such as `12000 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)`"
        )
    return channels


def _channel(path: Path, lines: list[str], start: int, at: int, match: re.Match[str]) -> Channel:
    where = f"{path}:{at + 1}"
    count, unit = int(match[1]), match[3].rstrip(".,").lower()
    step = number(match[2], path, at + 1, "the time step in s")
    if count < 2:
        raise InputError(f"{where}: {count} points; a record needs at least 2")
    if step <= 0.0:
        raise InputError(f"{where}: the time step must be greater than zero, not {step:g} s")
    if unit not in _UNITS:
        raise InputError(
            f"{where}: unknown unit of acceleration `{unit}`; of CSMIP files volume 2 is read, which has cm/sec2"
        )
    layout = _layout(lines, at, path)
    values = read_fields(lines, at + 1, count, layout, path)
    _no_more(path, lines, at, count, layout)
    texts = [" ".join(line.split()) for line in lines[start:at]]
    number_of, orientation = next(((m[1], m[2]) for text in texts if (m := _CHANNEL.search(text))), ("1", ""))
    parts = [texts[k] for k in (_EVENT, _STATION) if k < len(texts)]
    magnitudes = [m[0] for text in texts[: _EVENT + 3] if (m := _MAGNITUDE.search(text))]
    names = (number_of, orientation, re.sub(r"\s*deg", "", orientation, flags=re.IGNORECASE))
    label = ": ".join(part for part in (number_of, orientation) if part)
    about = ", ".join(part for part in ("CSMIP volume 2", *parts, *magnitudes) if part)
    return Channel(label, tuple(n for n in names if n), [0.01 * value for value in values], step, about)


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
        raise InputError(f"{path}:{end + 1}: more data than the {count} points announced in line {at + 1}")
