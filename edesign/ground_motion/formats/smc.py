"""Reader of the SMC format of the United States Geological Survey: one component in cm/s2.

Source: USGS National Strong-Motion Project, SMC-format data files: 11 lines of text, 48 integers, 50 reals, comments,
then samples, or pairs of time and acceleration where the header has no sampling rate.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import FieldFormat, read_fields
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.sampled_pairs import evenly_sampled
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_rate, check_step

TITLE = re.compile(r"\s*([0-6])\s+(UNCORRECTED|CORRECTED|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER|UNKNOWN)\b(.*)", re.I)
_TEXTS, _INTEGERS, _REALS = 11, 48, 50
_COMMENTS, _COUNT = 15, 16  # of the integers, from 0
_RATE, _MAXIMUM, _MINIMUM = 1, 29, 31  # of the reals, from 0
_AZIMUTH, _VERTICAL = 13, 12  # of the integers: bearing of the component; angle from the vertical
_DIGITS = 5  # of the samples, at the least (8E10.4 and E10.4E1)


def has_title(lines: list[str]) -> bool:
    """Say whether lines begin as an SMC file does: kind of the data, then the line `*`, with 48 integers to come."""
    return bool(lines) and TITLE.match(lines[0]) is not None and any(line.strip() == "*" for line in lines[1:_TEXTS])


def channels_of(path: Path) -> list[Channel]:
    """Read a file of one component, corrected or uncorrected; its peaks must be those that the header states.

    The component is called by its bearing in degrees, or `Up`.

    Raises:
        InputError: velocity, displacement or spectra; a header that is not of this form; truncated; something else
            than finite numbers; a peak that is not that of the header.
    """
    lines = read_lines(path)
    title = TITLE.match(lines[0])
    if title is None:
        raise InputError(f"{path}:1: an SMC file begins with a line such as `2 CORRECTED ACCELEROGRAM` [E-REC-01]")
    if title[2].upper() not in ("UNCORRECTED", "CORRECTED") and "ACCEL" not in title[3].upper():
        raise InputError(f"{path}:1: the file holds `{lines[0].strip()}`; only accelerograms are read [E-REC-09]")
    missing = f"{path}:{len(lines)}: the file ends within its headers of {_TEXTS} + 6 + 10 lines [E-REC-05]"
    if len(lines) < _TEXTS + 17:
        raise InputError(missing)
    integers = read_fields(lines, _TEXTS, _INTEGERS, FieldFormat(8, 10, True), path, "a whole number of the header")
    reals = read_fields(lines, _TEXTS + 6, _REALS, FieldFormat(5, 15, False), path, "a real number of the header")
    null, unknown = integers[0], reals[0]
    comments = 0 if integers[_COMMENTS] == null else int(integers[_COMMENTS])
    count, start = int(integers[_COUNT]), _TEXTS + 16 + comments
    if count < 2:
        raise InputError(f"{path}:{_TEXTS + 3}: {count} samples; a record needs at least 2 [E-REC-21]")
    if start >= len(lines):
        raise InputError(missing)
    rate, done = reals[_RATE], ""
    layout = FieldFormat(8, _width(lines[start]), False)
    values = np.array(read_fields(lines, start, count, layout, path))
    end = start + layout.lines(count)
    rest = [line for line in lines[end:] if line.strip()]
    if len(rest) > (1 if rate == unknown else 0):  # published files of pairs have a line that belongs to nothing
        raise InputError(f"{path}:{end + 1}: more data than the {count} numbers of line {_TEXTS + 3} [E-REC-06]")
    accelerations = values if rate != unknown else values[1::2]
    _check_peaks(path, reals, unknown, accelerations)
    if rate == unknown:
        times = values[: 2 * accelerations.size : 2]
        digit = 10.0 ** (np.floor(np.log10(max(float(times[-1]), 1e-9))) + 1 - _DIGITS)
        accelerations, step, done = evenly_sampled(f"{path}:{start + 1}", times, accelerations, float(digit))
        check_step(f"{path}:{start + 1}", step)
    else:
        check_rate(f"{path}:{_TEXTS + 7}", rate)
        step = 1.0 / rate
    label, names = _component(lines, integers, null)
    about = ", ".join(part for part in (*_about(lines, title[2]), done) if part)
    return [Channel(label, names, (0.01 * accelerations).tolist(), step, about)]


def _width(line: str) -> int:
    """Width of a field: 10 as documented; 8 numbers fill a line, and some programs write them wider."""
    text = line.rstrip()
    return len(text) // 8 if len(text) % 8 == 0 and text.count(".") == 8 else 10


def _check_peaks(path: Path, reals: list[float], unknown: float, values: np.ndarray) -> None:
    """The largest and the smallest value are those of the header, to the digits of the samples."""
    for at, found in ((_MAXIMUM, float(values.max())), (_MINIMUM, float(values.min()))):
        if reals[at] != unknown:
            digit = 10.0 ** (np.floor(np.log10(max(abs(found), 1e-9))) + 1 - _DIGITS)
            line = _TEXTS + 6 + at // 5 + 1
            check_peak(f"{path}:{line}", f"{reals[at]:.6E}", found, "cm/s2", float(digit))


def _component(lines: list[str], integers: list[float], null: float) -> tuple[str, tuple[str, ...]]:
    said = lines[5].partition("component=")[2].strip()
    if integers[_VERTICAL] in (0, 180):
        label = "Up" if integers[_VERTICAL] == 0 else "Down"
        return label, (said,) if said else ()
    bearing = "" if integers[_AZIMUTH] == null else f"{int(integers[_AZIMUTH])}"
    return bearing or said or "1", tuple(name for name in (bearing, said, f"{bearing} deg") if name)


def _about(lines: list[str], kind: str) -> tuple[str, ...]:
    station = lines[5].partition("component=")[0].partition("=")[2].strip()
    event = " ".join(lines[3].split())
    magnitude = re.search(r"Moment Mag=\s*([0-9.]+)", lines[4])
    return f"SMC, {kind.lower()}", event, f"Mw {magnitude[1]}" if magnitude else "", station


FORMAT = RecordFormat("SMC of the USGS", has_title, channels_of)
