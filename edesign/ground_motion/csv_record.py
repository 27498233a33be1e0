"""Reader of records in tables of text (.csv, .txt, .dat, .acc): accelerations, or times and accelerations."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.text import number, read_lines
from edesign.ground_motion.units import ACCELERATION_UNITS
from edesign.project.problems import did_you_mean

_UNEVEN = 0.1  # of a step: times in files are rounded; a missing line moves the others by half a step or more
_ROUNDING = 1e-6  # relative, between a given step and that of the time column
_COMMENTS = ("#", "%")
_HEADER_WORD = re.compile(r"\S+(?: [(\[][^)\]]*[)\]])?")  # between blanks; `Time (s)` is one


def read_csv(
    path: Path | str,
    acceleration_unit: str,
    time_step: float | None = None,
    time_column: int | str | None = None,
    acceleration_column: int | str | None = None,
    name: str = "",
) -> Record:
    """Read a record from a table separated by commas, semicolons or blanks, with or without one line of headers.

    Without columns named, one column is the acceleration, and of two the first is the time (s). The motion begins at
    the first sample, whatever time it bears.

    Args:
        path: the file.
        acceleration_unit: "g", "m/s^2", "cm/s^2" or "mm/s^2"; a table does not say it, so it must be declared.
        time_step: s; needed without a time column, and checked against it otherwise.
        time_column, acceleration_column: header, or number from 1.
        name: of the record; its file name without ending by default.

    Raises:
        InputError: unreadable file, unknown unit or column, something else than finite numbers, lines of different
            length, fewer than two samples, no time step, or times that are not evenly spaced.
    """
    path = Path(path)
    if not acceleration_unit:
        raise InputError(
            f"{path}: a table does not say the unit of its accelerations; declare it: {', '.join(ACCELERATION_UNITS)}"
        )
    if acceleration_unit not in ACCELERATION_UNITS:
        raise InputError(f"{path}: unknown unit `{acceleration_unit}`; allowed: {', '.join(ACCELERATION_UNITS)}")
    header, rows, places = _table(path)
    width = len(rows[0])
    if acceleration_column is None:
        if width > 2:
            raise InputError(f"{path}:{places[0]}: {width} columns; name the one that is the acceleration")
        at, when = width - 1, 0 if width == 2 and time_column is None else None
    else:
        at, when = _column(path, acceleration_column, header, width), None
    if time_column is not None:
        when = _column(path, time_column, header, width)
        if when == at:
            raise InputError(f"{path}: column {at + 1} cannot be both time and acceleration")
    samples = [number(row[at], path, line) for row, line in zip(rows, places, strict=True)]
    if when is not None:
        times = [number(row[when], path, line, "a time in s") for row, line in zip(rows, places, strict=True)]
        time_step = _uniform_step(path, np.array(times), places, time_step)
    if time_step is None:
        raise InputError(f"{path}: the file has no column of times; a time step is needed")
    if not time_step > 0.0:
        raise InputError(f"{path}: the time step must be greater than zero, not {time_step:g} s")
    factor = ACCELERATION_UNITS[acceleration_unit]
    return Record(name or path.stem, factor * np.array(samples), time_step, f"{path.name} in {acceleration_unit}")


def _table(path: Path) -> tuple[list[str], list[list[str]], list[int]]:
    """Header (empty if there is none), rows of text, and the line of each row; blank lines and comments are skipped."""
    lines = read_lines(path)
    kept = table_lines(lines)
    if not kept:
        raise InputError(f"{path}: the file has no samples")
    places = [i for i, _ in kept]
    delimiter = _delimiter(kept)
    if delimiter:
        rows = [[cell.strip() for cell in row] for row in csv.reader((line for _, line in kept), delimiter=delimiter)]
    else:
        rows = [line.split() for _, line in kept]
    header: list[str] = []
    if not any(is_number(cell) for cell in rows[0]):
        header, rows, places = rows[0], rows[1:], places[1:]
        if not delimiter:
            header = _HEADER_WORD.findall(kept[0][1])
    if len(rows) < 2:
        raise InputError(f"{path}:{len(lines)}: a record needs at least two samples, not {len(rows)}")
    width = len(header or rows[0])
    for row, line in zip(rows, places, strict=True):
        if len(row) != width:
            raise InputError(f"{path}:{line}: {len(row)} columns; the lines before have {width}")
    return header, rows, places


def table_lines(lines: list[str]) -> list[tuple[int, str]]:
    """Number (from 1) and text of the lines that are neither blank nor comments, which begin with # or %."""
    return [(i, line) for i, line in enumerate(lines, 1) if line.strip() and not line.lstrip().startswith(_COMMENTS)]


def _delimiter(kept: list[tuple[int, str]]) -> str:
    """Semicolon, comma, or nothing for blanks: what the first two lines are separated by."""
    second = kept[min(1, len(kept) - 1)][1]  # the first may be the headers, in which blanks mean nothing
    found = next((char for char in ";," if char in kept[0][1] + second), "")
    return found or ("" if re.search(r"\S\s+\S", second) else ",")


def is_number(cell: str) -> bool:
    """Whether a cell is a number as Python reads it, infinite and nan too."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _column(path: Path, wanted: int | str, header: list[str], width: int) -> int:
    if isinstance(wanted, int):
        if not 1 <= wanted <= width:
            raise InputError(f"{path}: there is no column {wanted}; the columns are numbered 1 to {width}")
        return wanted - 1
    if not header:
        raise InputError(
            f"{path}: there is no column `{wanted}`: the file has no headers; give the number of the column"
        )
    if wanted not in header:
        hint = did_you_mean(wanted, header)
        raise InputError(f"{path}: there is no column `{wanted}`{hint} (the columns are: {', '.join(header)})")
    return header.index(wanted)


def _uniform_step(path: Path, times: np.ndarray, places: list[int], given: float | None) -> float:
    """The step of evenly spaced times, s; a given one is returned if it is the same."""
    steps = np.diff(times)
    backwards = np.flatnonzero(steps <= 0.0)
    if backwards.size:
        at = int(backwards[0]) + 1
        raise InputError(
            f"{path}:{places[at]}: the time {times[at]:g} s is not after the time {times[at - 1]:g} s before it"
        )
    mean = float((times[-1] - times[0]) / steps.size)
    even = times[0] + mean * np.arange(times.size)
    if np.max(np.abs(times - even)) > _UNEVEN * mean:
        usual = float(np.sort(steps)[(steps.size - 1) // 2])  # the median, one of the steps that occur
        at = int(np.argmax(np.abs(steps - usual))) + 1
        raise InputError(
            f"{path}:{places[at]}: the times are not evenly spaced: here the step is {steps[at - 1]:g} s, "
            f"mostly {usual:g} s"
        )
    if given is not None:
        if abs(given - mean) > max(_ROUNDING, _UNEVEN / steps.size) * mean:
            raise InputError(f"{path}: the time column has a step of {mean:g} s, but {given:g} s is given")
        return given
    return float(f"{mean:.9g}")  # the decimal number that the file means
