"""The cells of a table of samples: its headers, units, and rows, as they stand in the file."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.units import ACCELERATION_UNITS, acceleration_factor
from edesign.project.notation.table_format import Delimiter, TableFormat
from edesign.tables.form import SIGNS, Form, decimal_of, header_cells, mark_of
from edesign.tables.text import clock_seconds, is_clock, is_number, like_number, number, table_text

ROWS, COLUMNS = "`layout: rows` (--layout rows)", "`layout: columns` (--layout columns)"
_HEAD = 20  # rows, among which words may be such as stand above samples
_ENOUGH = 3  # rows of numbers in turn, with which the samples begin
_SECONDS = ("s", "sec", "Sec")
_SPELLED = {"m/s2": "m/s^2", "m/s²": "m/s^2", "cm/s2": "cm/s^2", "cm/s²": "cm/s^2", "gal": "cm/s^2", "mm/s2": "mm/s^2"}
_DECIMAL_COMMAS = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?(?:\s+[-+]?\d+,\d+(?:[eE][-+]?\d+)?)+")


@dataclass(frozen=True)
class RecordTable:
    """The cells of a file as text, with points before decimals; blank lines and comments are left out.

    Attributes:
        path: of the file.
        header: names of the columns, empty if there are none.
        units: of the columns, empty if the file has no line of them.
        rows: cells of each line below.
        places: number of each of these lines, from 1.
        form: how they stand in the file.
    """

    path: Path
    header: list[str]
    units: list[str]
    rows: list[list[str]]
    places: list[int]
    form: Form

    @classmethod
    def read(cls, path: Path, given: TableFormat | None) -> RecordTable:
        """Read the cells of a file.

        Args:
            given: what is said of how the table stands in it.

        Raises:
            InputError: it cannot be read, has no samples, or may be read in two ways.
        """
        given = given or TableFormat()
        text = table_text(path, "record file", given, ("#", "%"), blank=None)
        if not text.lines:
            raise InputError(f"{path}: the file has no samples [E-REC-21]")
        delimiter = given.delimiter or _delimiter(text.lines)
        sign = SIGNS[delimiter]
        if sign:
            split = _split(text.lines, sign)
        else:
            split = [line.split() for line in text.lines]
        top = _top(split, given)
        headers = split[top - 1] if top else []
        units = given.units_row if given.units_row is not None else top > 1 and _units(split[top - 1])
        if top and units:
            headers = split[top - 2]
        if top == len(split):
            raise InputError(f"{path}:{text.last}: a record needs at least two samples, not 0 [E-REC-21]")
        if headers and not sign:
            headers = header_cells(text.lines[top - (2 if units else 1)], delimiter, len(split[top]))
        form = Form(
            text.encoding,
            text.numbers[top - (2 if units else 1)] if top else None,
            text.numbers[top - 1] if top and units else None,
            text.numbers[top],
            delimiter,
            skipped=max(0, top - (2 if units else 1)) + (given.skip or 0),
            mark=mark_of(text.lines[:top]),
        )
        rows, places = split[top:], text.numbers[top:]
        if delimiter != "comma":
            decimal = decimal_of(text, text.lines[top:], places[0], delimiter, given.decimal)
            form = replace(form, decimal=decimal)
            if decimal == "comma":
                rows = [[cell.replace(",", ".") for cell in row] for row in rows]
        elif given.decimal == "comma":
            raise InputError(
                f"{path}:{places[0]}: decimal commas and commas between columns cannot be distinguished [E-TABLE-09]"
            )
        return cls(path, headers, split[top - 1] if top and units else [], _clocks(path, rows, places), places, form)

    @property
    def width(self) -> int:
        """Number of columns."""
        return len(self.header or self.rows[0])

    @property
    def where(self) -> str:
        """File and line of the first numbers."""
        return f"{self.path}:{self.places[0]}"

    def numbers(self, column: int, what: str = "an acceleration") -> list[float]:
        """Return the numbers of a column.

        Args:
            column: its number, from 0.
            what: is read, for messages.

        Raises:
            InputError: a word of the column is no finite number; names file and line.
        """
        words = [row[column] for row in self.rows]
        try:
            values = list(map(float, words))
            if np.isfinite(values).all() and not any("_" in word for word in words):
                return values
        except ValueError:
            pass  # the slow way knows the place
        for row, i in zip(self.rows[:_HEAD], self.places, strict=False):
            if (
                column < len(row)
                and row[column]
                and not any(map(str.isdigit, row[column]))
                and not is_number(row[column])
            ):
                raise InputError(
                    f"{self.path}:{i}: `{row[column][:40]}` is not a number; {what} is expected here "
                    "(`table: {skip: ...}` leaves lines out that stand above the headers or samples) [E-REC-08]"
                )
        return [number(row[column], self.path, i, what) for row, i in zip(self.rows, self.places, strict=True)]

    def check_width(self, may_be_rows: bool) -> None:
        """Check that the lines are of one length, and two at least.

        Args:
            may_be_rows: whether the message advises to read lines of several samples.

        Raises:
            InputError: they are not.
        """
        hint = f"; if the numbers are samples in turn, write {ROWS}"
        if self.header or self.width == 1 or not may_be_rows:
            hint = ""
        width = self.width
        for row, line in zip(self.rows, self.places, strict=True):
            if len(row) != width:
                raise InputError(
                    f"{self.path}:{line}: {len(row)} columns; the lines before have {width}{hint} [E-REC-07]"
                )
        if len(self.rows) < 2:
            raise InputError(
                f"{self.where}: a record needs at least two samples, not {len(self.rows)}{hint} [E-REC-21]"
            )


def form_in_words(form: Form, given: TableFormat | None) -> str:
    """Return how a table was read, where that was said or is not plain."""
    found = (
        form.skipped or form.units_line or form.decimal == "comma" or form.encoding in ("utf-16", "gbk", "shift-jis")
    )
    return form.words if found or given is not None else ""


def _split(lines: list[str], sign: str) -> list[list[str]]:
    """Cells of lines, each by itself: a quote that is not closed does not go on in the next line."""
    if any('"' in line for line in lines):
        try:
            rows = list(csv.reader(lines, delimiter=sign))
        except csv.Error:  # a field that is too long
            rows = []
        if len(rows) == len(lines):
            return [[cell.strip() for cell in row] for row in rows]
    return [[cell.strip() for cell in line.split(sign)] for line in lines]


def _top(rows: list[list[str]], given: TableFormat) -> int:
    """How many lines stand above the numbers: words, then headers, then units.

    Words above the headers are left out only where headers without any number stand below them, and no row of numbers
    above; else the first line has the headers, if it has no number, and the reader of numbers reports what is wrong.
    """
    if given.headers is False:
        return 0
    if given.headers or given.units_row:
        return min(
            len(rows), 2 if given.units_row else 1 + (len(rows) > 1 and given.units_row is None and _units(rows[1]))
        )
    plain = 0 if any(map(like_number, rows[0])) else 1
    top = next((i for i in range(len(rows)) if all(map(_is_row, rows[i : i + _ENOUGH]))), 0)
    headers = top - (2 if top > 1 and _units(rows[top - 1]) else 1)
    if top <= 1 or headers < 0 or any(map(_is_row, rows[:top])) or any(map(like_number, rows[headers])):
        return plain
    above = rows[headers - 1] if headers else []
    ambiguous = headers and len(above) == len(rows[headers]) > 1 and not any(map(like_number, above))
    return plain if ambiguous or given.skip is not None and headers else top


def _is_row(row: list[str]) -> bool:
    return any(row) and all(like_number(cell) for cell in row if cell)


def _units(row: list[str]) -> bool:
    """Say whether words below headers are units of times and accelerations, at least one of them."""
    return any(_plain(cell) in (*_SECONDS, *ACCELERATION_UNITS) for cell in row)


def _plain(unit: str) -> str:
    """A unit without brackets, its square as ^2."""
    bare = unit.strip('()[]" ')
    return _SPELLED.get(bare.lower(), bare)


def _clocks(path: Path, rows: list[list[str]], places: list[int]) -> list[list[str]]:
    """Put seconds since the first row in place of clock times in the first column."""
    if not rows[0] or not is_clock(rows[0][0]):
        return rows
    seconds = clock_seconds(path, [row[0] if row else "" for row in rows], places)
    return [[second, *row[1:]] for second, row in zip(seconds, rows, strict=True)]


def check_units(table: RecordTable, when: int | None, at: int, unit: str) -> None:
    """Refuse units in the file that are not those that are read.

    Args:
        table: with a line of units, or without.
        when: column of times, if there is one.
        at: column of accelerations.
        unit: that is declared.

    Raises:
        InputError: times are not in s, or accelerations in another unit.
    """
    if len(table.units) != table.width:
        return
    where = f"{table.path}:{table.form.units_line}"
    if when is not None and (said := _plain(table.units[when])) and said not in _SECONDS:
        raise InputError(f"{where}: times are read in s, and the unit of `{table.header[when]}` is `{said}` [E-REC-12]")
    said = _plain(table.units[at])
    if said in ACCELERATION_UNITS and acceleration_factor(unit) != ACCELERATION_UNITS[said]:
        raise InputError(f"{where}: the unit of `{table.header[at]}` is `{said}`, but `{unit}` is declared [E-REC-12]")


def _delimiter(lines: list[str]) -> Delimiter:
    """Semicolon, comma, or blanks: what the first two lines are separated by."""
    second = lines[min(1, len(lines) - 1)]  # the first may be the headers, in which blanks mean nothing
    if all(_DECIMAL_COMMAS.fullmatch(line.strip()) for line in lines[-2:]):
        return "blanks"
    found: tuple[Delimiter, ...] = ("semicolon", "comma")
    for name in found:
        if str(SIGNS[name]) in lines[0] + second:
            return name
    return "blanks" if re.search(r"\S\s+\S", second) else "comma"


def acceleration_unit_of(table: RecordTable, column: int) -> str | None:
    """Return the unit of a column that its header, or the line of units, says: `acc (g)`; None: none that is known.

    Args:
        column: its number, from 0.
    """
    header = table.header[column] if column < len(table.header) else ""
    words = [table.units[column] if column < len(table.units) else "", *re.findall(r"[(\[]([^)\]]*)[)\]]", header)]
    words += [header.rpartition(sign)[2] for sign in ("_", " ") if sign in header]
    return next((_plain(word) for word in words if _plain(word) in ACCELERATION_UNITS), None)
