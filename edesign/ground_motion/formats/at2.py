"""Reader of PEER .AT2 files: three lines of text, the line with number and step of the samples, samples in g."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.fixed_width import words_of
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.record import Record
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.tables.text import number

_HEADER_LINES = 4  # every form of the data base has so many; the samples follow
_LONG_HEADER = 8  # lines in which the header of other programs of PEER's form may end, if it says that the unit is g
_IN_G = re.compile(r"\b(?:IN|UNITS\s+OF|UNITS)\s+G\b", re.IGNORECASE)
_VALUE = r"([^\s,=]+)"
_NEW = re.compile(rf"\s*NPTS\s*=\s*{_VALUE}\s*,?\s*DT\s*=\s*([^\s,=]+?)(?:SEC[A-Z]*\.?)?(?=[\s,]|$)", re.IGNORECASE)
_OLD = re.compile(rf"\s*{_VALUE}\s+{_VALUE}\s+NPTS\s*,?\s*DT", re.IGNORECASE)
_OTHER_UNIT = re.compile(r"(VELOCITY|DISPLACEMENT)|UNITS OF\s+(?!G\b)(\S+)", re.IGNORECASE)


def read_at2(path: Path | str, name: str = "") -> Record:
    """Read a PEER record file, of the NGA form (`NPTS=  5372, DT=  .0100 SEC`) or the older `5372  0.0100  NPTS, DT`.

    Args:
        name: of the record; its file name without ending by default.

    Returns:
        The record in m/s2 (1 g = 9.80665 m/s2); its source is the file name and the title in its second line. It has as
        many samples as the header says; a remark reports others below that are not zero.

    Raises:
        InputError: the file cannot be read, has no such header, holds another quantity than acceleration in g, a time
            step that is not positive, something else than finite numbers, or less samples than it says.
    """
    path = Path(path)
    lines = read_lines(path)
    count, step, header = _header(path, lines)
    samples: list[float] = []
    for i, line in enumerate(lines[header:], start=header + 1):
        samples += [number(word, path, i) for word in words_of(line)]
    if len(samples) < count:
        raise InputError(
            f"{path}:{len(lines)}: the file ends after {len(samples)} samples, but NPTS = {count} in line {header}"
            " [E-REC-05]"
        )
    rest = np.array(samples[count:])
    remarks: tuple[str, ...] = ()
    if rest.any():  # zeros fill up the last line
        remarks = (f"{rest.size} more numbers than NPTS = {count} stand below, not all zero: they are left out",)
    title = " ".join(lines[1].split())
    source = f"{path.name}: {title}" if title else path.name
    return Record(name or path.stem, STANDARD_GRAVITY * np.array(samples[:count]), step, source, remarks=remarks)


def has_header(lines: list[str]) -> bool:
    """Say whether lines look like those of a PEER file, of acceleration or of another quantity."""
    return any(_NEW.match(line) or _OLD.match(line) for line in lines[: _header_lines(lines)])


def _header_lines(lines: list[str]) -> int:
    return _LONG_HEADER if any(_IN_G.search(line) for line in lines[:_LONG_HEADER]) else _HEADER_LINES


def _header(path: Path, lines: list[str]) -> tuple[int, float, int]:
    """Number of samples, step in s, and the number of the line where they stand."""
    for i, line in enumerate(lines[: _header_lines(lines)], start=1):
        match = _NEW.match(line) or _OLD.match(line)
        if match is None:
            if i >= 3 and (other := _OTHER_UNIT.search(line)):
                seen = other[1] or f"a unit `{other[2]}`"
                raise InputError(
                    f"{path}:{i}: the header says {seen.lower()}; only acceleration in g is read from AT2 files"
                    " [E-REC-09]"
                )
            continue
        count = number(match[1], path, i, "NPTS, the number of samples,")
        step = number(match[2], path, i, "DT, the time step in s,")
        if count != int(count) or count < 2:
            raise InputError(
                f"{path}:{i}: NPTS = {match[1]}; a whole number of at least 2 samples is expected [E-REC-04]"
            )
        check_step(f"{path}:{i}", step, f"DT = {match[2]}")
        return int(count), step, i
    raise InputError(
        f"{path}:{min(len(lines), _HEADER_LINES)}: none of the first {_HEADER_LINES} lines has the header of an AT2 "
        "file, `NPTS=  5372, DT=  .0100 SEC` or `5372  0.0100  NPTS, DT` [E-REC-01]"
    )
