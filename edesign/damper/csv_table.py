"""Tables of numbers in CSV files under one line of headers, with the line of each row."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.file_bytes import read_file


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


def read_csv_table(path: Path, what: str, example: str) -> CsvTable:
    """Read a table; blank lines and lines that begin with # are skipped.

    Args:
        path: the file: UTF-8 with or without byte order mark; commas, semicolons or tabs between the columns.
        what: it is, for messages: "test file".
        example: headers of such a file.

    Raises:
        InputError: the file cannot be read, has no headers or rows, or a cell that is empty or no finite number.
    """
    numbers, lines = _kept(path, what)
    if not lines:
        raise InputError(f"{path}: the {what} is empty; its first line is like `{example}`")
    delimiter = next((sign for sign in ",;\t" if sign in lines[0]), ",")
    headers = tuple(cell.strip().strip('"').strip() for cell in lines[0].split(delimiter))
    if len(headers) == 1 and len(headers[0].split()) > 2:
        raise InputError(f"{path}:{numbers[0]}: there is one column; commas, semicolons or tabs stand between columns")
    if any(_is_number(cell) for cell in headers):
        raise InputError(f"{path}:{numbers[0]}: headers are missing; the first line is like `{example}`")
    if "" in headers:
        raise InputError(
            f"{path}:{numbers[0]}: column {headers.index('') + 1} has no header (a `{delimiter}` too many?)"
        )
    numbers, header_line, lines = numbers[1:], numbers[0], lines[1:]
    if not lines:
        raise InputError(f"{path}:{header_line}: there is no row below the headers")
    try:
        rows = np.loadtxt(lines, delimiter=delimiter, comments=None, ndmin=2)
        good = rows.shape[1] == len(headers) and bool(np.isfinite(rows).all())
    except ValueError:
        good = False
    if not good:  # the slow way, which knows the place
        rows = np.array([_row(path, headers, n, line, delimiter) for n, line in zip(numbers, lines, strict=True)])
    return CsvTable(path, header_line, headers, rows, np.array(numbers))


def _kept(path: Path, what: str) -> tuple[list[int], list[str]]:
    """Numbers and text of the lines that are neither blank nor comments."""
    data = read_file(path, what)
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
            hint = "; if these are decimal commas, write points"
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


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell  # which Python allows between digits
