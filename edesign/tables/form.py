"""How a table stands in its file: headers, units, signs between columns and before decimals; said or found."""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass

from edesign.errors import InputError
from edesign.project.notation.table_format import Decimal, Delimiter, Encoding, TableFormat
from edesign.tables.text import TableText, like_number

SIGNS: dict[Delimiter, str | None] = {"comma": ",", "semicolon": ";", "tab": "\t", "blanks": None}
"""Signs between the columns; None: any number of blanks and tabs."""

_HEADER_WORD = re.compile(r"\S+(?: [(\[][^)\]]*[)\]])?")  # between blanks; `Time (s)` is one
_WIDE_GAP = re.compile(r"\s{2,}|\t")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:,\d{3})+")
_POINTS = re.compile(r"(?<![\d.,])[-+]?\d{1,3}(?:\.\d{3})+,\d+(?![\d.,])")
"""A number with points between thousands and a decimal comma: `1.100,5`."""
_MARKS = {
    "MTS": re.compile(r"MTS[\d*]*\||\bMTS\b|TestSuite|MultiPurpose"),
    "Instron": re.compile(r"\bInstron\b|Bluehill|WaveMatrix|\bTestAnlage\b", re.IGNORECASE),
    "dSPACE": re.compile(r"dSPACE|ControlDesk|trace_values|Platform\(\)://|Model Root/", re.IGNORECASE),
}
"""What machines leave in the lines above the numbers."""
_MARKED = (100, 500)  # lines, and characters of them, in which marks are looked for
_ABOVE = 1000  # lines among which the headers are; exports of test machines have some dozens above them
_MTS_SIGNS = re.compile(r"\W*MTS[^|]*(?:\|[^|]*){4}\|(?P<decimal>[.,])\|")
"""Such as `MTS793|MPT|DEU|1|2|,|.|:|1|0|0|A`: after language and versions the signs of decimals, dates and times."""


@dataclass(frozen=True)
class Form:
    """The form of a table in its file: encoding, header, delimiter, decimal sign.

    Attributes:
        encoding: of the file.
        header_line: line of the headers; None: there are none.
        units_line: line of the units; None: there is none.
        first_line: that of the first numbers.
        delimiter: between the columns.
        decimal: before the decimals.
        skipped: lines above the headers that were not read.
        repeated: lines below the first numbers that repeat headers or units, and were not read.
        mark: maker of the test machine or controller whose marks the file has; empty: none is known.
        says_itself: the file says how it stands, as its maker has it, and nothing need be said of it.
        file: kind of a file that is no text; then only its columns and rows count.
    """

    encoding: Encoding
    header_line: int | None
    units_line: int | None
    first_line: int
    delimiter: Delimiter
    decimal: Decimal = "point"
    skipped: int = 0
    repeated: int = 0
    mark: str = ""
    says_itself: bool = False
    file: str = ""

    @property
    def words(self) -> str:
        """The unusual parts of the form in words; empty for UTF-8 with one line of headers, commas and points."""
        parts = [f"as exported by {self.mark}"] if self.mark else []
        if self.encoding != "utf-8":
            parts.append(self.encoding)
        if self.skipped:
            parts.append(f"{self.skipped} lines above the headers left out" if self.skipped > 1 else "1 line left out")
        if self.header_line is None:
            parts.append("no headers")
        if self.units_line is not None:
            parts.append(f"units in line {self.units_line}")
        if self.delimiter != "comma":
            between = {"semicolon": "semicolons", "tab": "tabs", "blanks": "blanks"}[self.delimiter]
            parts.append(f"{between} between columns")
        if self.decimal == "comma":
            parts.append("decimal commas")
        if self.repeated:
            parts.append(f"{self.repeated} repeated line{'s' * (self.repeated > 1)} of headers left out")
        return ", ".join(parts)


def decimal_said(lines: Sequence[str]) -> Decimal | None:
    """Return the sign before decimals that the first line of MTS's files says; None: they are of others."""
    match = _MTS_SIGNS.match(lines[0]) if lines else None
    return None if match is None else "comma" if match["decimal"] == "," else "point"


def mark_of(lines: Sequence[str]) -> str:
    """Return the maker whose marks are in lines; empty: no known maker."""
    text = "\n".join(line[: _MARKED[1]] for line in lines[: _MARKED[0]])
    return next((maker for maker, mark in _MARKS.items() if mark.search(text)), "")


def cells(line: str, delimiter: Delimiter) -> list[str]:
    """Return the cells of a line without the quotes around them.

    Args:
        line: without its line feed.
        delimiter: the sign between cells, or blanks.
    """
    sign = SIGNS[delimiter]
    if sign is None:
        return line.split()
    parts = line.split(sign)
    if '"' in line:  # a sign between quotes parts no columns
        with suppress(csv.Error):
            parts = next(csv.reader([line], delimiter=sign, skipinitialspace=True))
    return [cell.strip().strip('"').strip() for cell in parts]


def header_cells(line: str, delimiter: Delimiter, width: int | None = None) -> list[str]:
    """Return the cells of a line of headers; between blanks, `Time (s)` is one cell.

    Two blanks may part names of several words.

    Args:
        delimiter: between them.
        width: number of columns, if it is known.
    """
    if delimiter != "blanks":
        return cells(line, delimiter)
    apart = _WIDE_GAP.split(line.strip())
    return apart if len(apart) == width else _HEADER_WORD.findall(line)


def find_header(
    lines: Sequence[str], names: Callable[[str], bool], given: TableFormat | None
) -> tuple[int, Delimiter] | None:
    """Return the first line with two names or more, and the sign between its columns; None without one.

    Args:
        names: says whether a cell is a header.
        given: the form that the file of the user states; None: nothing is stated.

    Returns:
        Index of the line, from 0, and the sign between columns.
    """
    signs: tuple[Delimiter, ...] = ("semicolon", "tab", "comma")
    if given is not None and given.delimiter is not None:
        signs = (given.delimiter,)
    for i, line in enumerate(lines[:_ABOVE]):
        found, sign = max(
            ((sum(map(names, header_cells(line, sign))), sign) for sign in signs), key=lambda pair: pair[0]
        )
        if found > 1:
            return i, sign
        if given is not None and given.skip is not None:
            return None
    return None


def find_blank_header(lines: Sequence[str], names: Callable[[str], bool]) -> int | None:
    """Return the first line with two names between blanks above numbers between blanks; None without one.

    A line of units may be between them.

    Args:
        names: says whether a cell is a header.

    Returns:
        Index of the line, from 0.
    """
    for i, line in enumerate(lines[:_ABOVE]):
        below = [lines[k].split() for k in range(i + 1, min(i + 3, len(lines)))]
        row = next((row for row in below if all(map(like_number, row))), None)
        if row is not None and len(row) > 1:  # the last line has nothing below it
            headers = header_cells(line, "blanks", len(row))
            return i if len(headers) == len(row) and sum(map(names, headers)) > 1 else None
    return None


def first_numbers(lines: Sequence[str], delimiter: Delimiter) -> int | None:
    """Return the first line with several cells that are all numbers; None without one.

    Args:
        delimiter: the sign between cells.

    Returns:
        Index of the line, from 0.
    """
    for i, line in enumerate(lines[:_ABOVE]):
        row = cells(line, delimiter)
        if len(row) > 1 and any(row) and all(like_number(cell) for cell in row if cell):
            return i
    return None


def delimiter_of(line: str) -> Delimiter:
    """Return the sign between the cells of a line of headers or numbers: a comma, unless it has another one only."""
    order: tuple[Delimiter, ...] = ("comma", "semicolon", "tab")
    return next((sign for sign in order if str(SIGNS[sign]) in line), "comma")


def are_units(row: Sequence[str], width: int) -> bool:
    """Return whether cells below headers are units: words and no number."""
    return len(row) == width and any(row) and not any(map(like_number, row))


def decimal_of(
    text: TableText,
    lines: Sequence[str],
    first: int,
    delimiter: Delimiter,
    given: Decimal | None,
    in_file: Decimal | None = None,
) -> Decimal:
    """Return the decimal sign: a comma if numbers have at most one comma each, and no point anywhere.

    Args:
        text: of the table, for messages.
        first: number of the line of the first of them.
        delimiter: between the columns, no comma.
        given: what is said.
        in_file: what the file says, which counts where its numbers may be read in two ways.

    Raises:
        InputError: every comma may as well part thousands, or a decimal comma is said and points stand there.
    """
    with_comma = [line for line in lines if "," in line]
    if not with_comma:
        return given or "point"
    points = next((i for i, line in enumerate(lines) if "." in line), None)
    if points is not None and (given == "comma" or any(_POINTS.search(line) for line in with_comma)):
        line = lines[points] if given == "comma" else next(filter(_POINTS.search, with_comma))
        row = cells(line, delimiter)
        column = next((i for i, cell in enumerate(row) if _POINTS.fullmatch(cell)), None)
        column = next(i for i, cell in enumerate(row) if "." in cell) if column is None else column
        at = text.numbers[text.lines.index(line)] if line in text.lines else first
        raise InputError(
            f"{text.path}:{at}, column {column + 1}: `{row[column][:40]}` has a point where commas stand before "
            "decimals; export the table without signs between thousands [E-TABLE-09]"
        )
    if given is not None:
        return given
    if points is not None:
        return "point"
    commas = [cell for line in with_comma for cell in cells(line, delimiter) if "," in cell]
    if any(cell.count(",") > 1 for cell in commas):
        return "point"
    if all(map(_THOUSANDS.fullmatch, commas)):
        if in_file is not None:
            return in_file
        raise InputError(
            f"{text.path}:{first}: is `{commas[0]}` {commas[0].replace(',', '.')} or {commas[0].replace(',', '')}? "
            "every comma of the table has three digits behind it; write `table: {decimal: comma}` if commas stand "
            "before decimals; if they part thousands, export the table without them [E-TABLE-09]"
        )
    return "comma"
