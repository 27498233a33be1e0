"""Reader of the European strong-motion database (ISESD, and its CD-ROM, .cor): one corrected component in m/s2.

Source: Ambraseys et al. (2000, 2004), Dissemination of European Strong-Motion Data: lines `key: value`, processing
history, then blocks of accelerations, velocities and displacements.
"""

from __future__ import annotations

import re
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import without_padding
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.tables.text import number

_KEY = re.compile(r"\s*([a-zA-Z][a-zA-Z &/]*?)\s*:\s+(.*?)\s*$")  # keys count in small letters
_BLOCK = re.compile(r"\s*->\s*(.*?)\s*$")
_STEP, _COUNT, _UNITS = "sampling period", "number of samples", "units"
_ORIENTATION, _START = "orientation of transducer", "time of first sample"
_NUMBER = re.compile(r"\s*([-+]?[0-9]*\.[0-9]+(?:[EeDd][-+]?[0-9]{2})?)")


def has_header(lines: list[str]) -> bool:
    """Say whether lines have the header of such a file."""
    keys = {match[1].lower() for line in lines if (match := _KEY.match(line))}
    return {_STEP, _COUNT, _UNITS} <= keys


def channels_of(path: Path) -> list[Channel]:
    """Read the corrected acceleration of a file; velocities and displacements are passed over.

    The component is called as the header orients the transducer (`NS`, `Z`, ...).

    Raises:
        InputError: a key is missing, no corrected accelerations (uncorrected ones, or spectra), another unit than
            m/s2, not as many samples as the header says, or something else than finite numbers.
    """
    lines = read_lines(path)
    blocks = [(i, match[1]) for i, line in enumerate(lines) if (match := _BLOCK.match(line))]
    first = blocks[0][0] if blocks else len(lines)
    header: dict[str, tuple[int, str]] = {}
    for i, line in enumerate(lines[:first], 1):
        if match := _KEY.match(line):
            header.setdefault(match[1].lower(), (i, match[2]))
    for key in (_STEP, _COUNT, _UNITS):
        if key not in header:
            raise InputError(f"{path}:{max(1, first)}: the header has no line `{key}:` [E-REC-03]")
    start = next((i for i, title in blocks if re.match(r"corrected\s+acc", title, re.IGNORECASE)), None)
    if start is None:
        seen = ", ".join(title for _, title in blocks) or "no block `-> ...`"
        raise InputError(
            f"{path}: `-> corrected acceleration time histories` is expected, but the file has {seen} [E-REC-09]"
        )
    at, unit = header[_UNITS]
    if not re.match(r"(m/s\*s|m/s2|m/s\^2|m/s/s)", unit, re.IGNORECASE):
        raise InputError(f"{path}:{at}: units `{unit}`; accelerations in m/s*s are expected first [E-REC-10]")
    at, text = header[_STEP]
    step = number(text.rstrip("sS "), path, at, f"{_STEP} in s")
    check_step(f"{path}:{at}", step, f"{_STEP}: {text}")
    at, text = header[_COUNT]
    count = int(number(text, path, at, _COUNT))
    values = _values(path, lines, start + 1, count)
    if len(values) != count:
        raise InputError(
            f"{path}:{start + 1}: {len(values)} accelerations below this line, but {count} in line {at} [E-REC-05]"
        )
    label = header.get(_ORIENTATION, (0, ""))[1]
    about = ", ".join(
        part
        for part in (
            "European strong-motion database, corrected",
            header.get(_START, (0, ""))[1],
            *(f"{key} {header[key][1]}" for key in ("earthquake code", "station code") if key in header),
        )
        if part
    )
    return [Channel(label, (label[:1],), values, step, about)]


def _values(path: Path, lines: list[str], start: int, count: int) -> list[float]:
    """The numbers below a line, up to the next block or the line STOP; neighbours may touch."""
    values, words = list[float](), list[str]()
    for i, line in enumerate(lines[start:], start + 1):
        if _BLOCK.match(line) or line.strip().upper().startswith("STOP"):
            break
        if _NUMBER.sub("", line).strip():
            raise InputError(f"{path}:{i}: `{line.strip()[:60]}`: accelerations are expected here [E-REC-08]")
        if found := _NUMBER.findall(line):
            words = found
            values += [number(word, path, i) for word in words]
    return without_padding(values, count, len(words))


FORMAT = RecordFormat("European strong-motion database .cor", has_header, channels_of)
