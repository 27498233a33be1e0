"""Tables of numbers with the line of each row: exports of test machines, property tables, records of structures."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.notation.table_format import Delimiter, TableFormat
from edesign.project.reading.file_bytes import read_file
from edesign.tables import labview, matlab
from edesign.tables.body import Body, without_empty_columns, without_repeats
from edesign.tables.form import (
    SIGNS,
    Form,
    are_units,
    cells,
    decimal_of,
    decimal_said,
    delimiter_of,
    find_blank_header,
    find_header,
    first_numbers,
    header_cells,
    mark_of,
)
from edesign.tables.rows import clocks_in_seconds, rows_of_numbers
from edesign.tables.text import TableText, is_number, like_number, table_text


@dataclass(frozen=True)
class Table:
    """A table of numbers as it is in a file.

    Attributes:
        path: the file.
        header_line: line of the headers, from 1; that of the first numbers if there are none.
        headers: one of each column; its number if there are none.
        rows: (n, columns), finite numbers; nan in columns that are not read.
        lines: line of each row, (n,).
        form: how it was read.
        clocks: columns that are clock times in the file; here they are seconds since the first row.
    """

    path: Path
    header_line: int
    headers: tuple[str, ...]
    rows: np.ndarray
    lines: np.ndarray
    form: Form
    clocks: frozenset[int] = frozenset()

    def where(self, column: int | None = None, row: int | None = None) -> str:
        """Return `file:line, column 2 (force_kN)` for messages.

        Args:
            column: from 0; None: the message is about the whole line.
            row: from 0; None: the line of the headers.
        """
        line = self.header_line if row is None else int(self.lines[row])
        place = f"{self.path}:{line}"
        return place if column is None else f"{place}, column {column + 1} (`{self.headers[column]}`)"


def read_table(
    path: Path,
    what: str,
    example: str,
    names: Callable[[str], bool] | None = None,
    content: bytes | None = None,
    given: TableFormat | None = None,
    read: Callable[[Sequence[str]], Collection[int]] | None = None,
) -> Table:
    """Read a table of numbers; blank lines and lines that begin with # are skipped.

    Exports of test machines are read too: lines above the headers, a line of units below them, headers that come
    again, columns without header and values at either end, and decimal commas where semicolons, tabs or blanks stand
    between the columns.

    Args:
        path: the file; its encoding, and the sign between its columns, are found if they are not said.
        what: it is, for messages: "test file".
        example: headers of such a file.
        names: whether a cell is a header; the headers then stand in the first line with two of them. None: in the
            first line.
        content: of the file, if it has been read.
        given: what is said of the format.
        read: columns that are read, from 0, by the headers; others may have anything in their cells. None: all.

    Raises:
        InputError: the file cannot be read, has no headers or rows, or a cell that is empty or no finite number; or
            it may be read in two ways.
    """
    data = read_file(path, what) if content is None else content
    if matlab.is_matlab(data):
        return _of_signals(path, data, given)
    text = table_text(path, what, given, content=data)
    if not text.lines:
        raise InputError(f"{path}: the {what} is empty; its first line is like `{example}` [E-TABLE-04]")
    if labview.is_labview(text.lines):
        text = labview.plain_table(text)
    body = (
        _without_headers(text, given)
        if given and given.headers is False
        else _below_headers(text, example, names, given)
    )
    body = without_repeats(body, names) if names is not None else body
    if not body.lines:
        raise InputError(f"{path}:{body.form.header_line}: there is no row below the headers [E-TABLE-04]")
    body = without_empty_columns(body)
    headers, delimiter, first = body.headers, body.form.delimiter, body.numbers[0]
    if "" in headers:
        raise InputError(
            f"{path}:{body.form.header_line}: column {headers.index('') + 1} has no header "
            f"(a `{SIGNS[delimiter]}` too many?) [E-TABLE-05]"
        )
    lines = body.lines
    if delimiter != "comma":
        in_file = text.decimal or decimal_said(text.lines)
        decimal = decimal_of(text, lines, first, delimiter, given.decimal if given else None, in_file)
        body = replace(body, form=replace(body.form, decimal=decimal))
        if decimal == "comma":
            lines = [line.replace(",", ".") for line in lines]
    elif given and given.decimal == "comma":
        raise InputError(
            f"{path}:{first}: decimal commas and commas between the columns cannot be distinguished [E-TABLE-09]"
        )
    lines, clocks = clocks_in_seconds(path, lines, body.numbers, delimiter)
    rows = rows_of_numbers(
        path, headers, body.numbers, lines, delimiter, range(len(headers)) if read is None else read(headers)
    )
    place = first if body.form.header_line is None else body.form.header_line
    return Table(path, place, tuple(headers), rows, np.array(body.numbers), body.form, clocks)


def _of_signals(path: Path, content: bytes, given: TableFormat | None) -> Table:
    """The signals of a MATLAB file of dSPACE; its rows are numbered as its samples are."""
    if given is not None and given.model_fields_set:
        raise InputError(
            f"{path}: this is a MATLAB file, and `table` says how a text stands; leave the key out [E-TABLE-15]"
        )
    headers, rows = matlab.read_signals(path, content)
    form = Form("utf-8", 1, None, 1, "comma", mark=matlab.MARK, says_itself=True, file="MATLAB 5")
    return Table(path, 1, tuple(headers), rows, np.arange(1, len(rows) + 1), form)


def _without_headers(text: TableText, given: TableFormat) -> Body:
    """A table of which it is said that it has no headers: its columns are called by their numbers."""
    delimiter = given.delimiter or delimiter_of(text.lines[0])
    if given.delimiter is None and delimiter == "comma" and "," not in text.lines[0]:
        delimiter = "blanks"
    width = len(cells(text.lines[0], delimiter))
    form = Form(text.encoding, None, None, text.numbers[0], delimiter, skipped=given.skip or 0)
    return Body(text, [str(i) for i in range(1, width + 1)], text.numbers, text.lines, form)


def _below_headers(
    text: TableText, example: str, names: Callable[[str], bool] | None, given: TableFormat | None
) -> Body:
    path, numbers, lines = text.path, text.numbers, text.lines
    top, delimiter = _top(lines, names, given)
    if top and not _below_preamble(lines[:top], delimiter):
        raise InputError(f"{path}:{numbers[0]}: numbers stand above the headers in line {numbers[top]} [E-TABLE-05]")
    rest = lines[top + 1 :]
    width = next((len(row) for row in map(str.split, rest) if all(map(like_number, row))), None)
    headers = header_cells(lines[top], delimiter, width)
    if len(headers) == 1 and len(headers[0].split()) > 2:
        raise InputError(
            f"{path}:{numbers[top]}: there is one column; commas, semicolons or tabs stand between columns [E-TABLE-05]"
        )
    known = 0 if names is None else sum(map(names, headers))
    if any(map(is_number, headers)) and known < 2:  # transducers may be called by their numbers, beside known names
        raise InputError(f"{path}:{numbers[top]}: headers are missing; the first line is like `{example}` [E-TABLE-05]")
    units_line = None
    below = header_cells(rest[0], delimiter, len(headers)) if rest else []
    said = given.units_row if given else None
    if said and rest and len(below) != len(headers):
        raise InputError(
            f"{path}:{numbers[top + 1]}: a line of {len(headers)} units is needed here, as `units_row` says; it has "
            f"{len(below)} cells [E-TABLE-05]"
        )
    if said or said is None and names is not None and are_units(below, len(headers)):
        units_line = numbers[top + 1] if rest else None
        headers = [
            f"{name} ({unit.strip('()[] ')})" if unit.strip("()[] -") else name
            for name, unit in zip(headers, below, strict=True)
        ]
        rest = rest[1:]
    at = len(lines) - len(rest)
    mark = text.mark or mark_of(lines[: top + 1])
    skipped = (given.skip or 0 if given else 0) + top + text.above
    first = numbers[at] if rest else text.last
    says_itself = bool(text.mark) or decimal_said(lines) is not None
    form = Form(
        text.encoding, numbers[top], units_line, first, delimiter, skipped=skipped, mark=mark, says_itself=says_itself
    )
    return Body(text, headers, numbers[at:], rest, form)


def _top(lines: list[str], names: Callable[[str], bool] | None, given: TableFormat | None) -> tuple[int, Delimiter]:
    """Which line has the headers, and the sign between its columns."""
    if names is not None:
        found = find_header(lines, names, given)
        if found is not None:
            return found
        if given is None or given.delimiter is None:
            blank = find_blank_header(lines, names)
            if blank is not None and (blank == 0 or given is None or given.skip is None):
                return blank, "blanks"
    delimiter = given.delimiter if given and given.delimiter else delimiter_of(lines[0])
    if names is not None and (given is None or given.skip is None):
        for sign in (delimiter, *(sign for sign in SIGNS if sign not in (delimiter, "blanks"))):
            start = first_numbers(lines, sign)
            if start is not None and start > 1:  # names that nobody knows: the nearest line of words as wide
                width = len(cells(lines[start], sign))
                words = [i for i in range(start) if are_units(cells(lines[i], sign), width)]
                if words:
                    return words[-2] if words[-2:] == [start - 2, start - 1] else words[-1], sign
    return 0, delimiter


def _below_preamble(lines: list[str], delimiter: Delimiter) -> bool:
    """Whether lines above the headers are no rows of numbers, which would be lost."""
    return not any(len(row) > 1 and all(map(like_number, row)) for row in (cells(line, delimiter) for line in lines))
