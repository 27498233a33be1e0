"""Tables of numbers in CSV files under one line of headers, with the line of each row."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.reading.file_bytes import read_file


@dataclass(frozen=True)
class CsvTable:
    """A table as it stands in a file.

    Attributes:
        path: the file.
        header_line: line of the headers, from 1.
        headers: one of each column.
        rows: (n, columns), finite numbers.
        lines: line of each row, (n,).
    """

    path: Path
    header_line: int
    headers: tuple[str, ...]
    rows: np.ndarray
    lines: np.ndarray

    def where(self, column: int | None = None, row: int | None = None) -> str:
        """`file:line, column 2 (force_kN)` for messages; without a row the line of the headers."""
        line = self.header_line if row is None else int(self.lines[row])
        place = f"{self.path}:{line}"
        return place if column is None else f"{place}, column {column + 1} (`{self.headers[column]}`)"


def read_csv_table(
    path: Path,
    what: str,
    example: str,
    names: Callable[[str], bool] | None = None,
    content: bytes | None = None,
) -> CsvTable:
    """Read a table; blank lines and lines that begin with # are skipped.

    Exports of test machines are read too: lines above the headers, a line of units below them, columns without header
    and values at the end, and decimal commas where semicolons or tabs stand between the columns.

    Args:
        path: the file: UTF-8 with or without byte order mark; commas, semicolons or tabs between the columns.
        what: it is, for messages: "test file".
        example: headers of such a file.
        names: whether a cell is a header; the headers then stand in the first line with two of them. None: in the
            first line.
        content: of the file, if it has been read.

    Raises:
        InputError: the file cannot be read, has no headers or rows, or a cell that is empty or no finite number.
    """
    numbers, lines = _kept(path, read_file(path, what) if content is None else content)
    if not lines:
        raise InputError(f"{path}: the {what} is empty; its first line is like `{example}`")
    top, delimiter = _top(lines, names)
    if top and not _below_preamble(lines[:top], delimiter):
        raise InputError(f"{path}:{numbers[0]}: numbers stand above the headers in line {numbers[top]}")
    numbers, lines = numbers[top:], lines[top:]
    headers = _cells(lines[0], delimiter)
    if len(headers) == 1 and len(headers[0].split()) > 2:
        raise InputError(f"{path}:{numbers[0]}: there is one column; commas, semicolons or tabs stand between columns")
    if any(_is_number(cell) for cell in headers):
        raise InputError(f"{path}:{numbers[0]}: headers are missing; the first line is like `{example}`")
    numbers, header_line, lines = numbers[1:], numbers[0], lines[1:]
    if names is not None and lines and _are_units(lines[0], headers, delimiter):
        units = _cells(lines[0], delimiter)
        headers = [
            f"{name} ({unit.strip('()[] ')})" if unit else name for name, unit in zip(headers, units, strict=True)
        ]
        numbers, lines = numbers[1:], lines[1:]
    if not lines:
        raise InputError(f"{path}:{header_line}: there is no row below the headers")
    if headers[-1] == "" and all(line.rstrip().endswith(delimiter) for line in lines):
        headers, lines = headers[:-1], [line.rstrip()[:-1] for line in lines]
    if "" in headers:
        raise InputError(
            f"{path}:{header_line}: column {headers.index('') + 1} has no header (a `{delimiter}` too many?)"
        )
    if delimiter != "," and _decimal_commas(lines, delimiter):
        lines = [line.replace(",", ".") for line in lines]
    try:
        rows = np.loadtxt(lines, delimiter=delimiter, comments=None, ndmin=2)
        good = rows.shape[1] == len(headers) and bool(np.isfinite(rows).all())
    except ValueError:
        good = False
    if not good:  # the slow way, which knows the place
        rows = np.array(
            [_row(path, tuple(headers), n, line, delimiter) for n, line in zip(numbers, lines, strict=True)]
        )
    return CsvTable(path, header_line, tuple(headers), rows, np.array(numbers))


def _top(lines: list[str], names: Callable[[str], bool] | None) -> tuple[int, str]:
    """Which line has the headers, and the sign between its columns."""
    if names is not None:
        for i, line in enumerate(lines):
            found, sign = max(
                ((sum(map(names, _cells(line, sign))), sign) for sign in ";\t,"), key=lambda pair: pair[0]
            )
            if found > 1:
                return i, sign
    return 0, next((sign for sign in ",;\t" if sign in lines[0]), ",")


def _below_preamble(lines: list[str], delimiter: str) -> bool:
    """Whether lines above the headers are no rows of numbers, which would be lost."""
    rows = (_cells(line, delimiter) for line in lines)
    return not any(len(row) > 1 and all(map(_like_number, row)) for row in rows)


def _are_units(line: str, headers: list[str], delimiter: str) -> bool:
    """Whether the line below the headers has words and no number: units."""
    cells = _cells(line, delimiter)
    return len(cells) == len(headers) and any(cells) and not any(map(_like_number, cells))


def _decimal_commas(lines: list[str], delimiter: str) -> bool:
    """Whether numbers have a comma before their decimals: at most one each, and no point anywhere."""
    return (
        any("," in line for line in lines)
        and not any("." in line for line in lines)
        and all(cell.count(",") <= 1 for line in lines for cell in line.split(delimiter))
    )


def _cells(line: str, delimiter: str) -> list[str]:
    return [cell.strip().strip('"').strip() for cell in line.split(delimiter)]


def _kept(path: Path, data: bytes) -> tuple[list[int], list[str]]:
    """Numbers and text of the lines that are neither blank nor comments."""
    if b"\0" in data:
        raise InputError(f"{path}: this is not a text file in UTF-8")
    lines = data.decode("utf-8-sig", errors="replace").splitlines()
    kept = [(i, line) for i, line in enumerate(lines, 1) if line.strip(" \t,;") and not line.lstrip().startswith("#")]
    return [i for i, _ in kept], [line for _, line in kept]


def _row(path: Path, headers: tuple[str, ...], line: int, row: str, delimiter: str) -> list[float]:
    cells = row.split(delimiter)
    if len(cells) != len(headers):
        hint = ""
        if delimiter == "," and len(cells) > len(headers):
            hint = "; if these are decimal commas, write points, or semicolons between the columns"
        raise InputError(f"{path}:{line}: {len(cells)} cells; the headers name {len(headers)} columns{hint}")
    values = []
    for i, (header, cell) in enumerate(zip(headers, cells, strict=True), 1):
        text = cell.strip().strip('"').strip()
        place = f"{path}:{line}, column {i} (`{header}`)"
        if not text:
            raise InputError(f"{place}: the cell is empty")
        if not _is_number(text):
            hint = "; decimals stand behind a point, not a comma" if "," in text else ""
            raise InputError(f"{place}: `{text[:40]}` is not a number{hint}")
        if not np.isfinite(float(text)):
            raise InputError(f"{place}: `{text[:40]}` is not a finite number")
        values.append(float(text))
    return values


def _like_number(cell: str) -> bool:
    """Whether a cell is a number, also one with a decimal comma."""
    return _is_number(cell.replace(",", "."))


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell  # which Python allows between digits
