"""Numbers in fields of fixed width, as Fortran writes them; neighbours may touch."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.header_peak import last_place
from edesign.tables.text import is_number, number

_FORMAT = re.compile(r"\(\s*([0-9]{0,4})\s*([FEGI])\s*([0-9]{1,4})(?:\.([0-9]+))?\s*\)", re.IGNORECASE)
_TOUCHING = re.compile(r"(?<=[0-9.])(?=[-+])")
_END = re.compile(r"\s*(/&|-*\s*End[- ]of[- ]data)", re.IGNORECASE)


@dataclass(frozen=True)
class FieldFormat:
    """A Fortran format such as (8F10.3): 8 fields a line, each 10 characters wide."""

    fields: int
    width: int
    whole: bool

    def lines(self, count: int) -> int:
        """Return the number of lines that hold `count` values."""
        return -(-count // self.fields)


def field_format(text: str, path: Path, line: int) -> FieldFormat:
    """Find the format in a line that announces values.

    Args:
        path: of the file, for messages.
        line: its number, for messages.

    Raises:
        InputError: there is none that is read here.
    """
    match = _FORMAT.search(text)
    if match is None or int(match[1] or 1) < 1 or int(match[3]) < 1:
        raise InputError(
            f"{path}:{line}: no format of the numbers such as (8F10.3) or (10I8) is found in this line [E-REC-03]"
        )
    return FieldFormat(int(match[1] or 1), int(match[3]), match[2].upper() == "I")


def read_fields(
    lines: Sequence[str], start: int, count: int, layout: FieldFormat, path: Path, what: str = "an acceleration"
) -> list[float]:
    """Read `count` values from the lines that begin at index `start`.

    Args:
        start: index of the first line.
        path: of the file, for messages.
        what: is read, for messages.

    Raises:
        InputError: too few or too many values, but for zeros that fill up the last line, or something else than finite
            numbers; names file and line.
    """
    values: list[float] = []
    for i in range(start, start + layout.lines(count)):
        if i >= len(lines) or is_end_of_data(lines[i]):
            raise InputError(
                f"{path}:{min(i + 1, len(lines))}: the data end after {len(values)} of the {count} values announced "
                f"in line {start} [E-REC-05]"
            )
        text = lines[i].rstrip()
        expected = min(layout.fields, count - len(values))
        seen = -(-len(text) // layout.width)
        if expected < seen <= layout.fields and _is_zero(text[expected * layout.width :], layout.width):
            seen = expected
        if seen != expected:
            raise InputError(
                f"{path}:{i + 1}: {seen} fields of {layout.width} characters; {expected} are expected here [E-REC-07]"
            )
        for k in range(expected):
            word = text[k * layout.width : (k + 1) * layout.width].strip()
            value = number(word, path, i + 1, what)
            if not layout.whole and "." not in word:
                # Fortran would put the point by the format, other readers would not: a factor of 10^d between them
                raise InputError(f"{path}:{i + 1}: `{word}` has no decimal point; it cannot be read safely [E-REC-08]")
            values.append(value)
    return values


def _is_zero(text: str, width: int) -> bool:
    """Whether all fields of a part of a line are zeros, with which some programs fill up the last one."""
    words = [text[k : k + width].strip() for k in range(0, len(text), width)]
    return all(is_number(word) and float(word) == 0.0 for word in words)


def without_padding(values: list[float], count: int, rest: int) -> list[float]:
    """Return numbers without the zeros with which a program filled up their last line.

    Args:
        count: of those that the header announces.
    """
    return values[:count] if 0 < len(values) - count < rest and not any(values[count:]) else values


def words_of(line: str) -> list[str]:
    """Return the numbers of a line as words; a sign parts neighbours that touch: `0.1E-02-0.2E-02`.

    Args:
        line: of numbers with a decimal point.
    """
    words = line.split()
    if all(word.count(".") < 2 for word in words):
        return words
    return [part for word in words for part in _TOUCHING.split(word)]


def is_end_of_data(line: str) -> bool:
    """Say whether the line closes the data of a channel: `/& ... End of data`, `End-of-data for Chan 1`."""
    return _END.match(line) is not None


def read_rows(
    lines: Iterable[tuple[int, str]], width: int, path: Path, each: str, end: int
) -> tuple[np.ndarray, list[float]]:
    """Read lines of numbers apart, or of ten characters each (nF10.3) where neighbours touch; blank lines are skipped.

    Args:
        lines: of the samples, with their numbers in the file.
        path: of the file, for messages.
        each: what each line has, for messages.
        end: number of the last line of the file, for messages.

    Returns:
        The numbers (rows, width), and one unit in the last digit of each column.

    Raises:
        InputError: another number of numbers in a line, something else than finite numbers, or less than two lines.
    """
    rows = []
    places = [0.0] * width
    for i, line in lines:
        words = line.split()
        if not words:
            continue
        if len(words) != width:
            words = [line[k * 10 : (k + 1) * 10].strip() for k in range(-(-len(line.rstrip()) // 10))]
        if len(words) != width:
            raise InputError(f"{path}:{i}: {len(words)} numbers; each line has {each} [E-REC-07]")
        rows.append([number(word, path, i) for word in words])
        digits = [last_place(word) for word in words]
        places = [min(place, digit) if place else digit for place, digit in zip(places, digits, strict=True)]
    if len(rows) < 2:
        raise InputError(f"{path}:{end}: {len(rows)} lines of samples; a record needs at least 2 [E-REC-21]")
    return np.array(rows), places
