"""Rows of a table as numbers, with the place of a cell that is none."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Sequence
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.notation.table_format import Delimiter
from edesign.tables.form import SIGNS, cells
from edesign.tables.text import clock_seconds, is_clock, is_number

_BLOCK = 10_000  # lines that are read at a time: of a table with a fault, one block is read slowly
_GROUPED = re.compile(r"[-+]?\d{1,3}(?:,\d{3})+\.\d*")
"""A number between quotes whose commas cannot be decimal ones, as a point stands behind them: `"1,000.25"`."""


def clocks_in_seconds(
    path: Path, lines: list[str], numbers: Sequence[int], delimiter: Delimiter
) -> tuple[list[str], frozenset[int]]:
    """Return lines with seconds since the first row in place of clock times, and the columns that had clock times.

    Args:
        path: of the file, for messages.
        lines: of the table below its headers.
        numbers: numbers of these lines in the file, from 1.
        delimiter: the sign between cells.
    """
    sign = SIGNS[delimiter]
    clocks = [] if sign is None else [i for i, cell in enumerate(cells(lines[0], delimiter)) if is_clock(cell)]
    if not clocks or sign is None:
        return lines, frozenset()
    rows = [cells(line, delimiter) for line in lines]
    for column in clocks:
        try:
            seconds = clock_seconds(path, [row[column] for row in rows], numbers)
        except IndexError:  # a row that is too short, which the reader of numbers reports
            return lines, frozenset()
        for row, second in zip(rows, seconds, strict=True):
            row[column] = second
    return [sign.join(row) for row in rows], frozenset(clocks)


def rows_of_numbers(
    path: Path, headers: list[str], numbers: list[int], lines: list[str], delimiter: Delimiter, read: Collection[int]
) -> np.ndarray:
    """Read rows of finite numbers, (n, columns); nan in the cells of other columns than `read` that have none.

    Args:
        path: of the file, for messages.
        numbers: numbers of the lines in the file, from 1.
        lines: of the table below its headers.
        delimiter: the sign between cells.
        read: columns that are read, from 0.

    Raises:
        InputError: a row is too short or long, or a cell is empty or no finite number.
    """
    blocks = []
    for first in range(0, len(lines), _BLOCK):
        block = lines[first : first + _BLOCK]
        rows = _quickly(block, len(headers), delimiter)
        if rows is None:  # the slow way, which knows the place
            places = numbers[first : first + _BLOCK]
            rows = np.array(
                [_row(path, headers, n, line, delimiter, read) for n, line in zip(places, block, strict=True)]
            )
        blocks.append(rows)
    return np.concatenate(blocks)


def _quickly(lines: list[str], columns: int, delimiter: Delimiter) -> np.ndarray | None:
    """Rows of finite numbers, as far as NumPy reads them; None if it does not."""
    try:
        if not all(map(str.strip, lines)):
            return None  # NumPy leaves out lines without anything
        rows = np.loadtxt(lines, delimiter=SIGNS[delimiter], comments=None, ndmin=2)
    except ValueError:
        return None
    return rows if rows.shape == (len(lines), columns) and bool(np.isfinite(rows).all()) else None


def _row(
    path: Path, headers: Sequence[str], line: int, row: str, delimiter: Delimiter, read: Collection[int]
) -> list[float]:
    found = cells(row, delimiter)
    if len(found) != len(headers):
        hint = ""
        if delimiter == "comma" and len(found) > len(headers):
            hint = "; if these are decimal commas, write points, or semicolons between the columns"
        raise InputError(
            f"{path}:{line}: {len(found)} cells; the headers name {len(headers)} columns{hint} [E-TABLE-07]"
        )
    values = []
    for i, (header, cell) in enumerate(zip(headers, found, strict=True), 1):
        if i - 1 not in read and not is_number(cell):
            values.append(math.nan)
            continue
        if delimiter == "comma" and _GROUPED.fullmatch(cell):
            cell = cell.replace(",", "")
        place = f"{path}:{line}, column {i} (`{header}`)"
        if not cell:
            raise InputError(f"{place}: the cell is empty [E-TABLE-08]")
        if not is_number(cell):
            hint = "; decimals stand behind a point, not a comma" if "," in cell else ""
            if ":" in cell:
                hint = "; clock times stand as 13:05:07.250, a date before them as 2024-05-01 or 01.05.2024"
            raise InputError(f"{place}: `{cell[:40]}` is not a number{hint} [E-TABLE-08]")
        if not np.isfinite(float(cell)):
            raise InputError(f"{place}: `{cell[:40]}` is not a finite number [E-TABLE-08]")
        values.append(float(cell))
    return values
