"""Tables on a terminal (rich) or as plain text, for files and pipes; control characters in them are written out."""

from __future__ import annotations

import os
import sys
import textwrap
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import zip_longest
from shutil import get_terminal_size
from typing import TextIO

from edesign.report.tables.table import Table, state_of
from edesign.report.tables.visible import visible, visible_line

PAPER = 80  # characters of a line of text, and of what is printed in short
WIDEST = 120  # characters of a line in files and pipes that no table passes
NARROWEST = 20  # characters of a line that a table is laid out for at least
_GAP = 2  # between columns
_LEAST = 12  # characters of a line inside a cell
_COLOURS = {"good": "green", "bad": "red", "open": "yellow", "": ""}  # of verdicts, on a terminal


@dataclass(frozen=True)
class Printed:
    """A table as texts, or a part of one that fits a line.

    Attributes:
        title: one line above.
        columns: headers; () without.
        rows: texts.
        notes: lines below.
        left: number of columns, from the first, that are aligned left.
        sentences: numbers of the columns that may be broken into lines, the first of them first.
        joined: numbers of the columns that stay beside the one before them.
        headings: lines across the table, by the number of the row below.
        colours: of the texts of verdicts, for each column.
    """

    title: str
    columns: Sequence[str] = ()
    rows: list[list[str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    left: int = 1
    sentences: tuple[int, ...] = ()
    joined: tuple[int, ...] = ()
    headings: dict[int, str] = field(default_factory=dict)
    colours: Sequence[Mapping[str, str]] = ()


def printed(table: Table | Printed) -> Printed:
    """Return a table as texts, with control characters written out, so that columns are as wide as they look."""
    if isinstance(table, Printed):
        return table
    broken_ = sorted((column.broken, i) for i, column in enumerate(table.columns) if column.broken)
    colours: list[dict[str, str]] = [{} for _ in table.columns]
    rows = [[visible_line(text) for text in row] for row in table.texts]
    for row, shown in zip(table.rows, rows, strict=True):
        for value, text, of in zip(row, shown, colours, strict=True):
            if state := state_of(value):
                of[text] = _COLOURS[state]
    return Printed(
        title=visible_line(table.title),
        columns=[visible_line(header) for header in table.headers],
        rows=rows,
        notes=[visible(note) for note in table.notes],
        left=table.keys,
        sentences=tuple(i for _, i in broken_),
        joined=tuple(i for i, column in enumerate(table.columns) if column.joined),
        headings={row: visible_line(heading) for row, heading in table.headings.items()},
        colours=colours,
    )


def print_tables(tables: Iterable[Table], stream: TextIO | None = None, widest: int = WIDEST) -> None:
    """Print tables, none wider than the terminal: with rich where the stream is one, as plain aligned text elsewhere.

    Args:
        tables: in their order.
        stream: where to print; None: standard output.
        widest: characters of a line where the stream is no terminal; less if the variable COLUMNS says so.
    """
    stream = sys.stdout if stream is None else stream
    shown = [printed(table) for table in tables]
    if stream.isatty():
        _print_rich(shown, stream)
    else:
        width = max(_width(stream, widest), NARROWEST)
        stream.write("\n\n".join(plain(part) for table in shown for part in fitted(table, width)) + "\n")


def wrapped(text: str) -> list[str]:
    """Return a text as lines of a page."""
    return textwrap.wrap(text, PAPER)


def filled(text: str, stream: TextIO | None = None, widest: int = WIDEST) -> str:
    """Return a paragraph in lines no longer than the terminal, or than `widest` where the stream is none.

    Where the variable COLUMNS is set, it counts in both.

    Args:
        stream: where it is printed; None: standard output.
        widest: characters of a line.
    """
    stream = sys.stdout if stream is None else stream
    return "\n".join(_whole_words(text, max(_width(stream, widest), NARROWEST)))


def progress_text(label: str, text: str, stream: TextIO) -> str:
    """Return a line of progress, on a terminal broken between words under its label.

    Args:
        label: before the text.
        stream: where it is printed.
    """
    if not stream.isatty():
        return label + text
    before = " " * len(label)
    room = max(get_terminal_size().columns, NARROWEST + len(label))
    kept = text[: len(text) - len(text.lstrip())]  # what is set in stays so
    lines = _whole_words(text.lstrip(), room - len(label) - len(kept) - 2) or [""]
    return label + f"\n{before}{kept}  ".join([kept + lines[0], *lines[1:]])


def _width(stream: TextIO, widest: int) -> int:
    """Characters of a line, at most `widest`, of a terminal, or as the variable COLUMNS has it; `widest` without."""
    known = stream.isatty() or os.environ.get("COLUMNS", "").isdigit()
    return min(get_terminal_size((widest, 24)).columns, widest) if known else widest


def in_facts(label: str, text: str, indent: int, width: int) -> list[str]:
    """Return a label and the lines of a text beside it, broken between words where they are longer than a line.

    Args:
        label: before the first line.
        text: of one or more lines; what of one goes on in the next is two characters further to the right.
        indent: characters before the text.
        width: characters of a line.
    """
    lines: list[str] = []
    for whole in text.split("\n"):
        first, *more = _whole_words(whole, width - indent - 2) if len(whole) > width - indent else [whole]
        lines += [f"{label if not lines else '':<{indent}}{first}", *(f"{'':<{indent + 2}}{line}" for line in more)]
    return lines


def fitted(table: Table | Printed, width: int) -> list[Printed]:
    """Return a table as one or more tables below each other that are no wider than a line.

    Columns of sentences are broken into lines first; what is still too wide is cut between columns; what is too wide
    even then, such as a path longer than the line, is broken inside of its words.

    Args:
        width: characters of a line.
    """
    shown = _noted(printed(table), width)
    if not shown.columns:
        return [_facts_in_lines(shown, width)]
    return [_forced(_without_gaps(part), width) for part in folded(broken(shown, width), width)]


def _facts_in_lines(table: Printed, width: int) -> Printed:
    """The table without headers with its last column broken into lines; paths in it stay whole."""
    if not table.rows:
        return table
    before = sum(max(len(row[i]) for row in table.rows) + _GAP for i in range(len(table.rows[0]) - 1))
    return _in_lines(table, {len(table.rows[0]) - 1: max(width - before, _LEAST)}, _whole_words)


def _without_gaps(table: Printed) -> Printed:
    """The table without rows that are empty in this part of it."""
    kept = [number for number, row in enumerate(table.rows) if any(row)]
    headings = {kept.index(number): heading for number, heading in table.headings.items()}
    return replace(table, rows=[table.rows[number] for number in kept], headings=headings)


def _noted(table: Printed, width: int) -> Printed:
    """The table with its notes broken into lines; names and paths stay whole."""
    notes = [line for note in table.notes for line in _whole_words(note, width) or [""]]
    headings = {row: "\n    ".join(_whole_words(text, width - 4)) for row, text in table.headings.items()}
    title = "\n".join(_whole_words(table.title, width))
    return replace(table, title=title, notes=notes, headings=headings)


def _whole_words(text: str, width: int) -> list[str]:
    return textwrap.wrap(text, width, break_long_words=False, break_on_hyphens=False)


def _indent(table: Printed) -> int:
    """Characters before the rows, which stand below headings of their own."""
    return 2 if table.headings else 0


def _widths(table: Printed) -> list[int]:
    return [max(len(row[i]) for row in (table.columns, *table.rows)) for i in range(len(table.columns))]


def broken(table: Printed, width: int) -> Printed:
    """Return a table whose columns of sentences are broken into lines, rows of their own, so that it fits.

    No column becomes narrower than its longest word, so that names can be copied.

    Args:
        table: the table; one without such columns, or that fits, is returned as it is.
        width: characters of a line.
    """
    if not table.columns or not table.rows:
        return table
    widths = _widths(table)
    over = _indent(table) + sum(widths) + _GAP * (len(widths) - 1) - width
    rooms: dict[int, int] = {}
    for column in table.sentences:
        if over > 0:
            word = max((len(word) for row in table.rows for word in row[column].split()), default=0)
            least = max(len(table.columns[column]), min(_LEAST, widths[column]), word)
            rooms[column] = max(widths[column] - over, least)
            over -= widths[column] - rooms[column]
    return _in_lines(table, rooms, _whole_words) if rooms else table


def _in_lines(table: Printed, rooms: dict[int, int], wrap: Callable[[str, int], list[str]]) -> Printed:
    """The table with the cells of some columns broken into lines, each a row of its own."""
    rows: list[list[str]] = []
    headings = {}
    for number, row in enumerate(table.rows):
        if number in table.headings:
            headings[len(rows)] = table.headings[number]
        cells = [wrap(cell, rooms[i]) if i in rooms else [cell] for i, cell in enumerate(row)]
        rows += [list(line) for line in zip_longest(*cells, fillvalue="")]
    return replace(table, rows=rows, headings=headings)


def plain(table: Table | Printed) -> str:
    """Return a table as aligned text without colours."""
    shown = printed(table)
    lines = [shown.title] if shown.title else []
    lines += ["".join(text for text, _ in line).rstrip() for line in _lines(shown)]
    return "\n".join([*lines, *shown.notes])


def _lines(table: Printed) -> Iterator[list[tuple[str, str]]]:
    """Headers, a rule below them, and rows with their headings: pieces of text, each with its style on a terminal."""
    if not table.rows and not table.columns:
        return
    cells = [list(table.columns), *table.rows] if table.columns else table.rows
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))]
    before = " " * _indent(table)
    if table.columns:
        yield [(before, ""), (_joined(table, list(table.columns), widths), "bold")]
        yield [(before, ""), ((" " * _GAP).join("-" * width for width in widths), "dim")]
    for number, row in enumerate(table.rows):
        if number in table.headings:
            yield [(table.headings[number], "bold")]
        pieces = [(before, "")]
        for i, cell in enumerate(row):
            colour = table.colours[i].get(cell, "") if table.colours else ""
            pieces.append((_aligned(table, i, cell, widths[i]), colour))
            pieces.append((" " * _GAP, ""))
        yield pieces[:-1]


def _joined(table: Printed, row: list[str], widths: list[int]) -> str:
    return (" " * _GAP).join(_aligned(table, i, cell, widths[i]) for i, cell in enumerate(row))


def _aligned(table: Printed, column: int, cell: str, width: int) -> str:
    return cell.ljust(width) if column < table.left or column in table.sentences else cell.rjust(width)


def folded(table: Printed, width: int) -> list[Printed]:
    """Cut a table that is wider than `width` characters into tables below each other that repeat its first column.

    Where rows are alike there, the next columns of its left are repeated too, as far as they take half a line.

    Args:
        table: the table; one without headers is returned as it is.
        width: characters of a line; a column that is wider alone stands alone.
    """
    if not table.columns or not table.rows:
        return [table]
    widths = [one + _GAP for one in _widths(table)]
    room = width + _GAP - _indent(table)
    repeated = _telling_apart(table, widths, room)
    blocks: list[list[int]] = []
    for i in range(len(repeated), len(widths)):
        if i in table.joined and blocks:
            blocks[-1].append(i)
        else:
            blocks.append([i])
    parts: list[list[int]] = [[*repeated]]
    for block in blocks:
        if len(parts[-1]) > len(repeated) and sum(widths[j] for j in (*parts[-1], *block)) > room:
            parts.append([*repeated])
        parts[-1] += block
    if len(parts) == 1:
        return [table]
    tables = []
    for number, part in enumerate(parts, start=1):
        tables.append(
            replace(
                table,
                title=table.title if number == 1 else "",
                columns=[table.columns[i] for i in part],
                rows=[[row[i] for i in part] for row in table.rows],
                notes=table.notes if number == len(parts) else [],
                left=sum(i < table.left for i in part),
                sentences=tuple(part.index(i) for i in table.sentences if i in part),
                joined=tuple(part.index(i) for i in table.joined if i in part),
                colours=[table.colours[i] for i in part] if table.colours else (),
            )
        )
    return tables


def _telling_apart(table: Printed, widths: list[int], room: int) -> list[int]:
    """The first columns, of those at the left, by which no two rows are alike; the first where that takes much room."""
    rows = [row for row in table.rows if any(row[: table.left])]  # without the further lines of broken cells
    for count in range(1, max(1, table.left) + 1):
        alike = len({tuple(row[:count]) for row in rows}) < len(rows)
        if not alike and 2 * sum(widths[:count]) <= room:
            return list(range(count))
    return [0]


def _forced(table: Printed, width: int) -> Printed:
    """The table with its widest columns broken inside of words where it does not fit otherwise."""
    widths = _widths(table)
    over = _indent(table) + sum(widths) + _GAP * (len(widths) - 1) - width
    if over <= 0:
        return table
    narrow = list(widths)
    while over > 0 and max(narrow) > 1:
        narrow[narrow.index(max(narrow))] -= 1
        over -= 1
    rooms = {i: room for i, room in enumerate(narrow) if room < widths[i]}
    headers = [textwrap.wrap(text, narrow[i]) or [""] for i, text in enumerate(table.columns)]
    head, *more = (list(line) for line in zip_longest(*headers, fillvalue=""))
    cut = _in_lines(table, rooms, textwrap.wrap)
    headings = {number + len(more): text for number, text in cut.headings.items()}
    return replace(cut, columns=head, rows=[*more, *cut.rows], headings=headings)


def _print_rich(tables: Iterable[Printed], stream: TextIO) -> None:
    from rich.console import Console
    from rich.text import Text  # in which brackets and colons are no markup

    console = Console(file=stream, highlight=False)
    for table in (part for whole in tables for part in fitted(whole, max(console.width, NARROWEST))):
        if table.title:
            console.print(Text(table.title, style="bold"))
        for line in _lines(table):
            console.print(Text.assemble(*line), soft_wrap=True)
        for note in table.notes:
            console.print(Text(note), soft_wrap=True)
        console.print()
