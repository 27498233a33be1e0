"""Reader of Taiwan's Central Weather Bureau (now Administration): lines `#Key: value`, then time and three components.

Source: files of the Taiwan Strong Motion Instrumentation Program and of the earthquake early warning network.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import read_rows
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_rate
from edesign.project.reading.problems import listed
from edesign.tables.text import number

SEQUENCE, RATE, UNIT = "DataSequence", "SampleRate(Hz)", "AmplitudeUnit"
_KEY = re.compile(r"#\s*([A-Za-z][^:]*?)\s*:\s*(.*?)\s*$")
_PEAKS = re.compile(r"#\s*AmplitudeMAX\.?\s*([A-Z])\s*:\s*([-+0-9.]+)\s*~\s*([-+0-9.]+)", re.IGNORECASE)
_COMPONENT = re.compile(r"\b([UNEVZ])\s*\(\s*\+\s*\)", re.IGNORECASE)
_LENGTH = "RecordLength(sec)"
_NAMES = {"U": ("Z", "V", "Up"), "N": ("NS", "N-S", "HNN"), "E": ("EW", "E-W", "HNE")}


def has_header(lines: list[str]) -> bool:
    """Say whether lines have the header of such a file."""
    keys = {match[1].lower() for line in lines if (match := _KEY.match(line))}
    return {key.lower() for key in (SEQUENCE, RATE, UNIT)} <= keys


def channels_of(path: Path) -> list[Channel]:
    """Read the three components of a file.

    The components are called U, N and E.

    Raises:
        InputError: a key is missing, another unit than gal, something else than finite numbers, times that are not
            those of the sampling rate, truncated, or peaks that are not those of the header.
    """
    lines = read_lines(path, "big5")
    header = {match[1].lower(): (i, match[2]) for i, line in enumerate(lines, 1) if (match := _KEY.match(line))}
    for key in (SEQUENCE, RATE, UNIT):
        if key.lower() not in header:
            raise InputError(f"{path}:1: the header has no line `#{key}:` (it has {listed(header, 6)}) [E-REC-03]")
    at, unit = header[UNIT.lower()]
    if not re.match(r"gal\b", unit, re.IGNORECASE):
        raise InputError(f"{path}:{at}: {UNIT}: `{unit}`; gal is expected [E-REC-10]")
    at, sequence = header[SEQUENCE.lower()]
    labels = [label.upper() for label in _COMPONENT.findall(sequence)]
    if not labels or "time" not in sequence.lower():
        raise InputError(f"{path}:{at}: {SEQUENCE}: `{sequence}`; `Time U(+); N(+); E(+)` is expected [E-REC-04]")
    at, text = header[RATE.lower()]
    rate = number(text, path, at, f"{RATE}")
    check_rate(f"{path}:{at}", rate)
    below = [(i, line) for i, line in enumerate(lines, 1) if not line.lstrip().startswith("#")]
    each = f"the time and {len(labels)} accelerations"
    rows, places = read_rows(below, 1 + len(labels), path, each, len(lines))
    digit = min(places[1:])
    _check_times(path, rows[:, 0], rate, digit)
    if _LENGTH.lower() in header:
        at, text = header[_LENGTH.lower()]
        length = number(text, path, at, _LENGTH)
        if rows.shape[0] < length * rate - 1.0:  # whole seconds; files may have a sample more
            raise InputError(f"{path}:{len(lines)}: {rows.shape[0]} samples, but {length:g} s in line {at} [E-REC-05]")
    samples = dict(zip(labels, rows[:, 1:].T, strict=True))
    for i, line in enumerate(lines, 1):
        if (match := _PEAKS.match(line)) and match[1].upper() in samples:
            values = samples[match[1].upper()]
            for stated, found in ((match[2], float(values.max())), (match[3], float(values.min()))):
                check_peak(f"{path}:{i}", stated, found, "gal", digit)
    about = _about(header)
    return [
        Channel(label, _NAMES.get(label, ()), (0.01 * values).tolist(), 1.0 / rate, about)
        for label, values in samples.items()
    ]


def _check_times(path: Path, times: np.ndarray, rate: float, digit: float) -> None:
    apart = np.abs(times - times[0] - np.arange(times.size) / rate)
    if np.any(apart > max(0.0011, 2.0 * digit)):
        at = int(np.argmax(apart > max(0.0011, 2.0 * digit)))
        raise InputError(
            f"{path}: sample {at + 1} is at {times[at]:g} s, which does not fit {rate:g} samples a second [E-REC-18]"
        )


def _about(header: dict[str, tuple[int, str]]) -> str:
    def said(key: str) -> str:
        return next((value for name, (_, value) in header.items() if name.split("(")[0] == key.lower()), "")

    magnitude = said("Magnitude")
    station = " ".join(part for part in (said("StationCode"), said("StationName")) if part)
    corrected = ", offset removed" if "corr" in said(UNIT).lower() else ""
    parts = (f"CWB Taiwan, unprocessed{corrected}", said("Origin Time"), magnitude and f"ML {magnitude}", station)
    return ", ".join(part for part in parts if part)


FORMAT = RecordFormat("CWB (Taiwan) text", has_header, channels_of)
