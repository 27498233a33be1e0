"""Reader of files of the COSMOS strong-motion data format (.V1, .V2, .V2c): one or more channels of acceleration.

Source: COSMOS Strong Motion Data Format, version 1.20 (2001): text, integer, real and comment headers, then data.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import field_format, is_end_of_data, read_fields
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.tables.text import number

TITLE = re.compile(r"\s*(.*?)\s*\(Format\s+v\s*([0-9.]+)\s+with\s+([0-9]{1,9})\s+text\s+lines\s*\)", re.IGNORECASE)
_SECTION = re.compile(
    r"\s*([0-9]{1,9})\s+(Integer|Real)-header\s+values\s+follow\s+on\s+([0-9]{1,9})\s+lines", re.IGNORECASE
)
_COMMENTS = re.compile(r"\s*([0-9]{1,9})\s+Comment", re.IGNORECASE)
_DATA = re.compile(
    r"\s*([0-9]{1,9})\s+(.*?)\s*pts\s*,\s*approx\s+([0-9.]+)\s*secs?\s*,"
    # with -i, as capitals and small letters of all but two signs take long to look up
    r"\s*units\s*=\s*((?-i:[^(,])*?)[\s.]*(?:\(\s*([0-9]{1,9})\s*\))?[\s,]*Format",
    re.IGNORECASE,
)
_DECIMALS = re.compile(r"\(\s*[0-9]*\s*F\s*[0-9]+\.([0-9]{1,9})", re.IGNORECASE)
_CHANNEL = re.compile(r"\s*Sta\w*\s+Cha\w*\s*:?\s*([0-9?]+)\s*:?\s*(.*?)\s*(?:\(|Location|$)", re.IGNORECASE)
_MAGNITUDE = re.compile(r"\bM[A-Za-z]{0,2}\s*=\s*[0-9.]+")
_SCNL = re.compile(r"<SCNL>\s*([^\s.]+)\.([^\s.]+)\.")

# item of the real header, counted from 1: sample interval of the data, ms (item 34 is that of the recorder, s)
_SAMPLE_INTERVAL = 62
_MAXIMUM = 64  # of the data, in their unit
_UNKNOWN = -999.0  # "value unknown" in all headers
# COSMOS table 2: code of the unit, factor to m/s2
_UNIT_CODES = {2: STANDARD_GRAVITY, 4: 0.01, 7: 0.0254, 10: 0.01, 11: STANDARD_GRAVITY / 1000.0}
_UNIT_NAMES = {"g": STANDARD_GRAVITY, "mg": STANDARD_GRAVITY / 1000.0, "gal": 0.01, "in/sec2": 0.0254}
_UNIT_NAMES |= dict.fromkeys(("cm/sec2", "cm/sec/sec", "cm/s/s", "cm/s2", "cm/s^2", "cm/sec^2"), 0.01)


def has_title(lines: list[str]) -> bool:
    """Say whether one of the first two lines is the title of such a file."""
    return any(TITLE.match(line) for line in lines[:2])


def channels_of(path: Path) -> list[Channel]:
    """Read all channels of acceleration in physical units (volume 1 or 2); other quantities are passed over.

    A channel is called by its number, its orientation (`340 deg`, `340`, `Up`) or its channel code.

    Raises:
        InputError: not of this format, truncated, wrong counts, raw counts instead of accelerations, unknown unit
            or time step, or something else than finite numbers.
    """
    lines = read_lines(path)
    channels: list[Channel] = []
    seen: list[str] = []
    at = 0
    while at < len(lines):
        if not lines[at].strip():
            at += 1
            continue
        block = _block(path, lines, at)
        seen.append(block.quantity)
        if "accel" in block.quantity.lower():
            channels.append(_channel(path, lines, block))
        at = block.end
    if not channels:
        raise InputError(f"{path}: the file holds no acceleration, but: {', '.join(seen)} [E-REC-09]")
    return channels


@dataclass(frozen=True)
class _Block:
    """Where the parts of one channel stand; lines are indices from 0."""

    start: int
    texts: int
    real: list[float]
    comments: list[str]
    data: int  # the line that announces the data
    count: int
    quantity: str
    seconds: float
    unit: str
    unit_code: int | None
    values: list[float]
    digit: float  # one unit in the last digit of the values
    end: int  # the line after the channel


def _block(path: Path, lines: list[str], start: int) -> _Block:
    title = TITLE.match(lines[start])
    if title is None:
        raise InputError(
            f"{path}:{start + 1}: a channel of a COSMOS file begins with a line such as "
            "`Corrected acceleration (Format v01.20 with 13 text lines)` [E-REC-01]"
        )
    at = start + int(title[3])
    headers: dict[str, list[float]] = {}
    comments: list[str] = []
    while True:
        if at >= len(lines):
            raise InputError(
                f"{path}:{len(lines)}: the file ends within the headers of the channel of line {start + 1} [E-REC-05]"
            )
        if section := _SECTION.match(lines[at]):
            layout = field_format(lines[at], path, at + 1)
            count, kind = int(section[1]), section[2].lower()
            if layout.lines(count) != int(section[3]):
                raise InputError(
                    f"{path}:{at + 1}: {count} values in this format take {layout.lines(count)} lines, not {section[3]}"
                    " [E-REC-04]"
                )
            headers[kind] = read_fields(lines, at + 1, count, layout, path, f"a value of the {kind} header")
            at += 1 + int(section[3])
        elif remark := _COMMENTS.match(lines[at]):
            comments = lines[at + 1 : at + 1 + int(remark[1])]
            at += 1 + int(remark[1])
        elif data := _DATA.match(lines[at]):
            break
        else:
            raise InputError(
                f"{path}:{at + 1}: a header or `12000 acceleration pts, approx 60 secs, units=cm/sec2 (04),"
                f"Format=(8f10.3)` is expected here, not `{lines[at].strip()[:40]}` [E-REC-06]"
            )
    count = int(data[1])
    if count < 2:
        raise InputError(f"{path}:{at + 1}: {count} points; a record needs at least 2 [E-REC-21]")
    layout = field_format(lines[at], path, at + 1)
    values = read_fields(lines, at + 1, count, layout, path)
    end = at + 1 + layout.lines(count)
    if end < len(lines) and is_end_of_data(lines[end]):
        end += 1
    elif end < len(lines) and lines[end].strip() and TITLE.match(lines[end]) is None:
        raise InputError(f"{path}:{end + 1}: more data than the {count} points announced in line {at + 1} [E-REC-06]")
    return _Block(
        start,
        int(title[3]),
        headers.get("real", []),
        comments,
        at,
        count,
        data[2],
        number(data[3], path, at + 1, "the duration in s"),
        data[4].lower(),
        int(data[5]) if data[5] else None,
        values,
        10.0 ** -int(decimals[1]) if (decimals := _DECIMALS.search(lines[at])) else 0.0,
        end,
    )


def _channel(path: Path, lines: list[str], block: _Block) -> Channel:
    factor = _factor(path, block)
    step = _time_step(path, block)
    _check_peak(path, block, factor)
    texts = [line.strip() for line in lines[block.start : block.start + block.texts]]
    about, label, names = _description(texts, block.comments)
    return Channel(label, names, [factor * value for value in block.values], step, about)


def _factor(path: Path, block: _Block) -> float:
    """Factor of the data to m/s2."""
    where = f"{path}:{block.data + 1}"
    if block.unit.startswith("count") or block.unit_code == 50:
        raise InputError(
            f"{where}: the data are raw counts of the recorder, not accelerations; use a V1 or V2 file [E-REC-09]"
        )
    by_name = _UNIT_NAMES.get(block.unit)
    by_code = _UNIT_CODES.get(block.unit_code) if block.unit_code is not None else by_name
    if by_code is None or (by_name is not None and not math.isclose(by_name, by_code)):
        code = "" if block.unit_code is None else f" ({block.unit_code:02d})"
        raise InputError(
            f"{where}: unknown unit of acceleration `{block.unit}`{code}; read are cm/sec2 (04) and g (02) [E-REC-10]"
        )
    return by_code


def _check_peak(path: Path, block: _Block, factor: float) -> None:
    """The data have the peak of the real header, to its digits.

    It is in the unit of the data; of uncorrected data in g some networks give it in cm/s2.
    """
    stated = block.real[_MAXIMUM - 1] if len(block.real) >= _MAXIMUM else _UNKNOWN
    if stated in (_UNKNOWN, 0.0):
        return
    found = max(abs(value) for value in block.values)
    in_cm = 100.0 * factor * found
    scale = min((1.0, found), (100.0 * factor, in_cm), key=lambda pair: abs(abs(stated) - pair[1]))[0]
    where, unit = f"{path}:{block.data + 1}", block.unit if scale == 1.0 else "cm/sec2"
    check_peak(where, f"{stated:.7g}", scale * found, unit, scale * block.digit)


def _time_step(path: Path, block: _Block) -> float:
    """The step of the data, s; it must fit the approximate duration that the data header gives."""
    where = f"{path}:{block.data + 1}"
    if len(block.real) < _SAMPLE_INTERVAL or block.real[_SAMPLE_INTERVAL - 1] == _UNKNOWN:
        raise InputError(
            f"{where}: the real header does not give the sample interval (its value {_SAMPLE_INTERVAL}, ms) [E-REC-03]"
        )
    step = block.real[_SAMPLE_INTERVAL - 1] / 1000.0
    check_step(where, step)
    if abs(block.count * step - block.seconds) > 1.0 + 0.01 * block.seconds:  # it is written in whole seconds
        raise InputError(
            f"{where}: {block.count} points at the {step:g} s of the real header last {block.count * step:g} s, "
            f"but this line says about {block.seconds:g} s [E-REC-18]"
        )
    return step


def _description(texts: list[str], comments: list[str]) -> tuple[str, str, tuple[str, ...]]:
    """What the headers say: event and station; label of the channel; its other names."""
    title = TITLE.match(texts[0])
    parts = [] if title is None else [f"{title[1]} (COSMOS v{title[2]})"]
    parts += texts[1:2]
    if len(texts) > 2 and (magnitudes := _MAGNITUDE.findall(texts[2])):
        parts.append(" ".join(magnitudes))
    station = next((text for text in texts if text.lower().startswith("statn")), "")
    parts.append(" ".join(station.partition("Code:")[2].split() or station.split()))
    number, orientation = "", ""
    for text in texts:
        if match := _CHANNEL.match(text):
            number, orientation = match[1].strip("?"), match[2]
    codes = [match[2] for line in comments if (match := _SCNL.search(line))]
    label = ": ".join(part for part in (number or "".join(codes[:1]), orientation) if part) or "1"
    bearing = re.match(r"([0-9]+)\s*deg", orientation, re.IGNORECASE)
    names = [number, orientation, bearing[1] if bearing else "", *codes]
    return ", ".join(" ".join(part.split()) for part in parts if part), label, tuple(n for n in names if n)


FORMAT = RecordFormat("COSMOS .V1/.V2/.V2c", has_title, channels_of)
