"""The part of a table below its headers: what stands there and is no row is left out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from edesign.errors import InputError
from edesign.tables.form import SIGNS, Form, cells
from edesign.tables.text import TableText, like_number

_LABELS = ("trace_values", "values", "data")  # in the first cell of the first row, of exports with a column of labels


@dataclass(frozen=True)
class Body:
    """The part of a table below its headers, while it is read.

    Attributes:
        text: of the table.
        headers: of its columns.
        numbers: of the lines, from 1.
        lines: below the headers and units.
        form: how the table stands in its file.
    """

    text: TableText
    headers: list[str]
    numbers: list[int]
    lines: list[str]
    form: Form


def without_repeats(body: Body, names: Callable[[str], bool]) -> Body:
    """Leave out lines below the first numbers that are those of headers, units, or what stands above them.

    Lines above the headers come again with other times and counts (`Stored at: 200 cycle`): they are known by their
    first cell, as far as that is a word.

    Args:
        names: whether a cell is a header.

    Raises:
        InputError: such a line has headers, so that another table begins.
    """
    above = [(n, line) for n, line in zip(body.text.numbers, body.text.lines, strict=True) if n < body.form.first_line]
    known = {line.strip() for _, line in above}
    sign = body.form.delimiter
    titles = {cells(line, sign)[0] for n, line in above if body.form.header_line and n < body.form.header_line}
    titles = {title for title in titles if title and not like_number(title)} if sign != "blanks" else set()
    titles_above = [n for n, _ in above if body.form.header_line and n < body.form.header_line]
    kept: list[int] = []
    for i, line in enumerate(body.lines):
        if line.strip() in known:
            while kept and i - kept[-1] <= len(titles_above) and _stands_above(body.lines[kept[-1]], body):
                kept.pop()  # what stood above the headers the first time, in other words
            continue
        if not line.lstrip(' "')[:1].isalpha():
            kept.append(i)
            continue
        row = cells(line, sign)
        if sum(map(names, row)) > 1:
            raise InputError(
                f"{body.text.path}:{body.numbers[i]}: another table begins here, with other headers than in line "
                f"{body.form.header_line}; `table: {{skip: {body.numbers[i] - 1}}}` reads it alone, and the one above "
                "needs a file of its own [E-TABLE-06]"
            )
        if row[0] not in titles:
            kept.append(i)
    count = len(body.lines) - len(kept)
    if not count or body.form.header_line is None:
        return body
    numbers, lines = [body.numbers[i] for i in kept], [body.lines[i] for i in kept]
    return replace(body, numbers=numbers, lines=lines, form=replace(body.form, repeated=count))


def _stands_above(line: str, body: Body) -> bool:
    """Whether a line is no row: its cells are of another number than the headers, and words are among them."""
    row = cells(line, body.form.delimiter)
    return len(row) != len(body.headers) and not all(like_number(cell) for cell in row if cell)


def without_empty_columns(body: Body) -> Body:
    """Leave out columns at either end that have nothing in all rows, but for a label in the first one."""
    sign, headers, lines = SIGNS[body.form.delimiter], body.headers, body.lines
    if sign is None:
        return body
    without_headers = body.form.header_line is None
    while (
        len(headers) > 1
        and (headers[-1] == "" or without_headers)
        and all(line.rstrip(" ").endswith(sign) for line in lines)
    ):
        headers, lines = headers[:-1], [line.rstrip(" ")[:-1] for line in lines]
    label, _, rest = lines[0].partition(sign)
    if label.strip(' ":').lower() in ("", *_LABELS) and all(line.lstrip(" ").startswith(sign) for line in lines[1:]):
        headers, lines = headers[1:], [rest, *(line.lstrip(" ")[1:] for line in lines[1:])]
    return replace(body, headers=headers, lines=lines)
