"""Reader of volume 1 (uncorrected) accelerograms in the form of the California Institute of Technology.

It is written by older CSMIP, the University of Southern California, RENADIC (Chile) and BHRC (Iran): for each channel
13 lines of text, 7 of integers and 7 of reals, then pairs of time and acceleration, of BHRC accelerations, in g/10.

Source: Hudson, Trifunac & Brady (1969-1975), Caltech EERL; Shakal & Huang (1985), CSMIP OSMS 85-03.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import is_end_of_data, without_padding
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.sampled_pairs import evenly_sampled
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.tables.text import number

_TITLE = re.compile(
    r"\s*(?:UNCORRECTED ACCELEROGRAM DATA\b|FILE\s+\d+\s+OF UNCORRECTED ACCELEROGRAM|\*\s*VOL1DS)", re.I
)
_UNIT = re.compile(r"UNITS\b.*\bSEC(?:ONDS)?\s+AND\s+G\s*(/\s*10)?", re.IGNORECASE)
_COUNT = re.compile(r"NO\.?\s+OF\s+POINTS\s*=\s*([0-9]{1,9}).*?=\s*([0-9.]+)", re.IGNORECASE)
_PEAK = re.compile(r"\bMAX\s*=\s*([-+0-9.]+)\s*G\b", re.IGNORECASE)
_CHANNEL = re.compile(r"\s*CHAN\s+([0-9]{1,9})\s*:\s*(\S+(?:\s+DEG)?)", re.IGNORECASE)
_COMPONENT = re.compile(r"\s*COMP\s+(\S+)", re.IGNORECASE)
_AZIMUTHS = re.compile(r"Azimuth\s+L\s*([0-9]{1,9})\s+T\s*([0-9]{1,9})", re.IGNORECASE)
_MAGNITUDE = re.compile(r"\b(M[LWS])\s*=?\s*([1-9][0-9.]*)", re.IGNORECASE)
_ACCELERATIONS_ALONE = "*"  # how titles of BHRC begin; half a file of pairs has as many numbers as points too
_TEXTS, _HEADER = 13, 27
_STATION, _EVENT = 5, 1  # lines of the text, from 0
_NUMBER = re.compile(r"\s*[-+]?[0-9]*\.[0-9]+(?:E[-+]?[0-9]+)?", re.IGNORECASE)


def has_header(lines: list[str]) -> bool:
    """Say whether lines begin as such a file does; volume 1 files of evenly spaced points are those of `csmip`."""
    return bool(lines) and _TITLE.match(lines[0]) is not None and any(_UNIT.search(line) for line in lines[:_TEXTS])


def channels_of(path: Path) -> list[Channel]:
    """Read the uncorrected acceleration of all channels; uneven times are interpolated, which `source` says.

    A channel is called by its number, its orientation (`90 DEG`, `UP`, `EW`) or its component (`N08W`, `L1`).

    Raises:
        InputError: a header that is not of this form; another unit than g or g/10; truncated; something else than
            finite numbers; times that don't rise; a peak that is not that of the header.
    """
    lines = read_lines(path)
    channels: list[Channel] = []
    at = 0
    while at < len(lines):
        # blank, or a remark without a number that a system left behind the data
        if not lines[at].strip() or (channels and not re.search(r"[0-9]", lines[at]) and not _TITLE.match(lines[at])):
            at += 1
            continue
        if _TITLE.match(lines[at]) is None:
            raise InputError(
                f"{path}:{at + 1}: more data than the header announces, or a channel that does not begin with a line "
                f"such as `UNCORRECTED ACCELEROGRAM DATA`: `{lines[at].strip()[:40]}` [E-REC-06]"
            )
        channel, at = _channel(path, lines, at, len(channels) + 1)
        channels.append(channel)
    return channels


def _channel(path: Path, lines: list[str], start: int, position: int) -> tuple[Channel, int]:
    texts = lines[start : start + _TEXTS]
    unit = next((match for text in texts if (match := _UNIT.search(text))), None)
    stated = next(((i, match) for i, text in enumerate(texts, start + 1) if (match := _COUNT.search(text))), None)
    if unit is None or stated is None:
        raise InputError(
            f"{path}:{start + 1}: the {_TEXTS} lines of text from here have no `NO. OF POINTS = ...`, or no "
            "`UNITS ... SEC AND G/10` [E-REC-03]"
        )
    factor = 0.1 if unit[1] else 1.0
    line, count = stated[0], int(stated[1][1])
    alone = texts[0].lstrip().startswith(_ACCELERATIONS_ALONE)
    numbers, digits, end = _numbers(path, lines, start + _HEADER, count if alone else 2 * count)
    if numbers.size == 2 * count:
        values = numbers[1::2]
        samples, step, done = evenly_sampled(f"{path}:{start + _HEADER + 1}", numbers[::2], values, 10.0**-digits)
    elif numbers.size == count and alone:
        duration = number(stated[1][2].rstrip("."), path, line, "the duration in s")
        values, samples, step, done = numbers, numbers, round(duration / count, 6), ""
    else:
        raise InputError(
            f"{path}:{end}: {numbers.size} numbers, but the {count} points of line {line} are {count} pairs of time "
            "and acceleration, or of BHRC as many accelerations [E-REC-05]"
        )
    if count < 2:
        raise InputError(f"{path}:{line}: {count} points; a record needs at least 2 [E-REC-21]")
    check_step(f"{path}:{line}", step)
    for i, text in enumerate(texts, start + 1):
        if match := _PEAK.search(text):
            peak = factor * float(np.abs(values).max())
            check_peak(f"{path}:{i}", match[1].rstrip("."), peak, "g", factor * 10.0**-digits)
    label, names = _label(texts, position)
    about = ", ".join(part for part in (*_about(texts), done) if part)
    acceleration = (STANDARD_GRAVITY * factor * samples).tolist()
    if end < len(lines) and is_end_of_data(lines[end]):
        end += 1
    return Channel(label, names, acceleration, step, about), end


def _numbers(path: Path, lines: list[str], first: int, count: int) -> tuple[np.ndarray, int, int]:
    """The numbers of a channel, their decimal digits, and the line (from 0) after them.

    Neighbours may touch: all have as many decimals as the first, so each ends with them.
    """
    if first >= len(lines):
        raise InputError(
            f"{path}:{len(lines)}: the file ends within the {_HEADER} lines of header of a channel [E-REC-05]"
        )
    example = _NUMBER.match(lines[first])
    if example is None:
        raise InputError(f"{path}:{first + 1}: `{lines[first].strip()[:40]}`: the samples are expected here [E-REC-08]")
    mantissa, exponent, _ = example[0].strip().upper().partition("E")
    digits = len(mantissa.partition(".")[2])
    pattern = re.compile(rf"\s*([-+]?[0-9]*\.[0-9]{{{digits}}}" + (r"[ED][-+][0-9]{2}" if exponent else "") + ")", re.I)
    values, words = list[float](), list[str]()
    at = first
    while at < len(lines) and not is_end_of_data(lines[at]) and _TITLE.match(lines[at]) is None:
        text = lines[at].rstrip()
        found = pattern.findall(text)
        if not found and not re.search(r"[0-9]", text):
            break
        words = found
        if pattern.sub("", text).strip():
            raise InputError(
                f"{path}:{at + 1}: `{text.strip()[:60]}`: numbers such as `{example[0].strip()}` are expected"
                " [E-REC-08]"
            )
        values += [number(word, path, at + 1) for word in words]
        at += 1
    return np.array(without_padding(values, count, len(words))), digits, at


def _label(texts: list[str], position: int) -> tuple[str, tuple[str, ...]]:
    for text in texts:
        if match := _CHANNEL.match(text):
            orientation = " ".join(match[2].split())
            plain = re.sub(r"\s*deg$", "", orientation, flags=re.IGNORECASE)
            return f"{int(match[1])}: {orientation}", (str(int(match[1])), orientation, plain)
        if match := _COMPONENT.match(text):
            letter = match[1][0].upper()
            azimuths = next((found for line in texts if (found := _AZIMUTHS.search(line))), None)
            known = (azimuths[1] if letter == "L" else azimuths[2]) if azimuths and letter in "LT" else ""
            short = (letter,) if match[1][1:].isdecimal() and len(match[1]) == 2 else ()
            return match[1], tuple(name for name in (str(position), known, *short) if name)
    return str(position), ()


def _about(texts: list[str]) -> tuple[str, ...]:
    if texts[0].lstrip().startswith(_ACCELERATIONS_ALONE):  # BHRC: the station stands before its coordinates
        station = next((text.split("Station")[0] for text in texts if "Station" in text), "")
        event = next((text.partition(":")[2] for text in texts if text.lower().startswith("origin")), "")
        who = "BHRC Iran"
    else:
        station, event = texts[_STATION], texts[_EVENT]
        who = "RENADIC" if any("RENADIC" in text for text in texts) else ""
    if "FILE" in texts[0][:6]:  # lines of USC end with their length
        station, event = (re.sub(r"\s+[0-9]+\s*(VOL1)?\s*$", "", text) for text in (station, event))
    magnitude = next((f"{match[1]} {match[2]}" for text in texts if (match := _MAGNITUDE.search(text))), "")
    parts = (who, "volume 1, uncorrected", event, magnitude, station)
    return tuple(" ".join(part.split()) for part in parts if part.strip())


FORMAT = RecordFormat("volume 1 of CSMIP, USC, RENADIC and BHRC", has_header, channels_of)
