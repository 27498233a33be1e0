"""Reader of K-NET and KiK-net ASCII files: 17 lines of header, then counts of the recorder, usually eight a line.

Source: NIED, K-NET ASCII format: acceleration (gal) = (count - mean of the counts) times the scale factor.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.facts import Facts, positive
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_rate
from edesign.tables.text import number

FIRST, RATE, SCALE = "Origin Time", "Sampling Freq(Hz)", "Scale Factor"  # in any case
_PEAK = "Max. Acc. (gal)"
_HEADER_LINES = 17
_VALUE_COLUMN = 18  # where values begin in every line of the header
_RATE = re.compile(r"([0-9.]+)\s*Hz", re.IGNORECASE)
_SCALE = re.compile(r"([0-9.]+)\s*\(\s*gal\s*\)\s*/\s*([0-9.]+)", re.IGNORECASE)
# KiK-net numbers its components: 1 to 3 at depth, 4 to 6 at the surface
_KIK_NET = {"1": "NS1", "2": "EW1", "3": "UD1", "4": "NS2", "5": "EW2", "6": "UD2"}


def has_key(line: str, key: str) -> bool:
    """Say whether a line of the header begins with a key.

    Args:
        key: as the network writes it.
    """
    return line[: len(key)].lower() == key.lower()


def has_header(lines: list[str]) -> bool:
    """Say whether lines begin as such a file does."""
    return has_key(lines[0], FIRST) and any(has_key(line, RATE) for line in lines)


def channels_of(path: Path) -> list[Channel]:
    """Read a file of one component; the mean of all samples is subtracted, as NIED recommends.

    The component is called `E-W`, `EW`, ...

    Raises:
        InputError: the header is incomplete or not of this form, something else than whole numbers, or fewer or more
            samples than duration and frequency say.
    """
    lines = read_lines(path)
    if len(lines) <= _HEADER_LINES or not has_key(lines[_HEADER_LINES - 1], "Memo"):
        raise InputError(
            f"{path}:{min(len(lines), _HEADER_LINES)}: a K-NET file has {_HEADER_LINES} lines of header, the last of "
            "them `Memo.`, and samples after them [E-REC-01]"
        )
    rate = _match(path, lines, RATE, _RATE, "`100Hz`")
    scale = _match(path, lines, SCALE, _SCALE, "`3920(gal)/6182761`")
    frequency = number(rate[1], path, _line(path, lines, RATE))
    numerator, denominator = (number(scale[k], path, _line(path, lines, SCALE)) for k in (1, 2))
    check_rate(f"{path}:{_line(path, lines, RATE)}", frequency)
    if min(numerator, denominator) <= 0.0:
        raise InputError(f"{path}:{_line(path, lines, SCALE)}: the scale factor must be greater than zero [E-REC-04]")
    counts = np.array(_counts(path, lines))
    duration = number(_value(path, lines, "Duration Time(s)"), path, _line(path, lines, "Duration Time(s)"), "a time")
    if abs(counts.size - duration * frequency) >= 1.0:
        raise InputError(
            f"{path}:{len(lines)}: {counts.size} samples, but {duration:g} s at {frequency:g} Hz are "
            f"{duration * frequency:g} [E-REC-05]"
        )
    gal = numerator / denominator * (counts - counts.mean())
    _check_peak(path, lines, gal)
    code = _value(path, lines, "Dir.")
    direction = _KIK_NET.get(code, code)
    event = f"{_value(path, lines, FIRST)}, M {_value(path, lines, 'Mag.')}"
    about = f"K-NET, {event}, {_value(path, lines, 'Station Code')}, mean of {counts.mean():.6g} counts subtracted"
    channel = Channel(direction, (code,), (0.01 * gal).tolist(), 1.0 / frequency, about)
    return [channel]


def _check_peak(path: Path, lines: list[str], gal: np.ndarray) -> None:
    """The peak is that of the header, which NIED rounds to 0.001 gal after subtracting its own mean of the counts."""
    for i, line in enumerate(lines[:_HEADER_LINES], start=1):
        if has_key(line, _PEAK):
            check_peak(f"{path}:{i}", line[len(_PEAK) :].strip(), float(np.abs(gal).max()), "gal")


def _counts(path: Path, lines: list[str]) -> list[float]:
    counts: list[float] = []
    for i, line in enumerate(lines[_HEADER_LINES:], _HEADER_LINES + 1):
        for word in line.split():
            count = number(word, path, i, "a count of the recorder")
            if count != int(count):
                raise InputError(
                    f"{path}:{i}: `{word}` is not a whole number; a count of the recorder is expected here [E-REC-08]"
                )
            counts.append(count)
    return counts


def _line(path: Path, lines: list[str], key: str) -> int:
    """The line of the header (from 1) that begins with `key`."""
    for i, line in enumerate(lines[:_HEADER_LINES], start=1):
        if has_key(line, key):
            return i
    raise InputError(f"{path}:{_HEADER_LINES}: the header has no line `{key}` [E-REC-03]")


def _value(path: Path, lines: list[str], key: str) -> str:
    line = lines[_line(path, lines, key) - 1]
    return line[max(_VALUE_COLUMN, len(key)) :].strip() or line[len(key) :].strip()


def _match(path: Path, lines: list[str], key: str, pattern: re.Pattern[str], example: str) -> re.Match[str]:
    value = _value(path, lines, key)
    match = pattern.fullmatch(value)
    if match is None:
        raise InputError(
            f"{path}:{_line(path, lines, key)}: {key}: `{value}`; a value such as {example} is expected [E-REC-04]"
        )
    return match


def facts_of(path: Path) -> Facts:
    """Return what the header says of earthquake and station.

    Raises:
        InputError: the file cannot be read.
    """
    lines = read_lines(path)[:_HEADER_LINES]
    values = {key: line[len(key) :].strip() for line in lines for key in _FACTS if has_key(line, key)}
    origin = values.get(FIRST)
    year = int(origin[:4]) if origin and origin[:4].isdigit() else None
    return Facts(origin, year, values.get("Station Code"), magnitude=positive(values.get("Mag.", "")))


_FACTS = (FIRST, "Mag.", "Station Code")

FORMAT = RecordFormat(
    "K-NET/KiK-net ASCII",
    has_header,
    channels_of,
    several=False,
    keeps_suffix=True,
    suffixes=(".ns", ".ew", ".ud", *(f".{c}{k}" for c in ("ns", "ew", "ud") for k in (1, 2))),
    facts=facts_of,
)
