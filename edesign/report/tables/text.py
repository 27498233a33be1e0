"""Tables on a terminal (rich) or as plain text, for files and pipes; control characters in them are written out."""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Iterable
from dataclasses import replace
from itertools import zip_longest
from typing import TextIO

from edesign.report.tables.table import Table
from edesign.report.tables.visible import visible, visible_line

PAPER = 80  # characters of a line in files and pipes, to which sentences are broken
WIDEST = 120  # characters of a line there that no table of numbers passes
_GAP = 2  # between columns
_LEAST = 12  # characters of a line inside a cell
_COLOURS = {"completed": "green", "failed": "red", "not run": "yellow"}  # of cells, on a terminal


def print_tables(tables: Iterable[Table], stream: TextIO | None = None) -> None:
    """Print tables: with rich where the stream is a terminal, as plain aligned text elsewhere."""
    stream = sys.stdout if stream is None else stream
    shown = [_visible(table) for table in tables]
    if stream.isatty():
        _print_rich(shown, stream)
    else:
        parts = [part for table in shown for part in folded(broken(_noted(table), PAPER, _GAP), WIDEST)]
        stream.write("\n\n".join(plain(part) for part in parts) + "\n")


def wrapped(text: str) -> list[str]:
    """Return a text as lines of a page."""
    return textwrap.wrap(text, PAPER)


def _visible(table: Table) -> Table:
    """The table with the control characters of its texts written out, so that columns are as wide as they look."""
    rows = [[visible_line(cell) for cell in row] for row in table.rows]
    columns = [visible_line(header) for header in table.columns]
    notes = [visible(note) for note in table.notes]
    return replace(table, title=visible_line(table.title), columns=columns, rows=rows, notes=notes)


def _noted(table: Table) -> Table:
    """The table with its notes broken into lines of files and pipes; names and paths stay whole."""
    wrap = textwrap.TextWrapper(WIDEST, break_long_words=False, break_on_hyphens=False)
    return replace(table, notes=[line for note in table.notes for line in wrap.wrap(note) or [""]])


def broken(table: Table, width: int, gap: int) -> Table:
    """Return a table whose columns of sentences are broken into lines, rows of their own, so that it fits.

    Args:
        table: the table; one without such columns, or that fits, is returned as it is.
        width: characters of a line.
        gap: characters between columns.
    """
    widths = [max(len(row[i]) for row in (table.columns, *table.rows)) for i in range(len(table.columns))]
    over = sum(widths) + gap * (len(widths) - 1) - width
    rooms: dict[int, int] = {}
    for column in table.sentence_columns if table.rows else ():
        if over > 0:
            rooms[column] = max(widths[column] - over, len(table.columns[column]), min(_LEAST, widths[column]))
            over -= widths[column] - rooms[column]
    if not rooms:
        return table
    rows = []
    for row in table.rows:
        cells = [textwrap.wrap(cell, rooms[i]) if i in rooms else [cell] for i, cell in enumerate(row)]
        rows += [list(line) for line in zip_longest(*cells, fillvalue="")]
    return replace(table, rows=rows)


def plain(table: Table) -> str:
    """Return a table as aligned text without colours or lines."""
    lines = [table.title] if table.title else []
    cells = [list(table.columns), *table.rows] if table.columns else table.rows
    widths = [max(len(row[i]) for row in cells) for i in range(len(cells[0]))] if cells else []
    for position, row in enumerate(cells):
        aligned = [
            cell.ljust(width) if i < table.left or i in table.sentence_columns else cell.rjust(width)
            for i, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(aligned).rstrip())
        if position == 0 and table.columns:
            lines.append("  ".join("-" * width for width in widths))
    return "\n".join([*lines, *table.notes])


def folded(table: Table, width: int) -> list[Table]:
    """Cut a table that is wider than `width` characters into tables below each other that repeat its first column.

    Args:
        table: the table; one without headers is returned as it is.
        width: characters of a line; of a column that is wider alone the cells are folded later.
    """
    if not table.columns or not table.rows:
        return [table]
    widths = [max(len(row[i]) for row in (table.columns, *table.rows)) + _GAP for i in range(len(table.columns))]
    parts: list[list[int]] = [[0]]
    for i in range(1, len(widths)):
        if len(parts[-1]) > 1 and sum(widths[j] for j in parts[-1]) + widths[i] > width:
            parts.append([0])
        parts[-1].append(i)
    tables = []
    for number, part in enumerate(parts, start=1):
        title = table.title if number == 1 else ""
        notes = table.notes if number == len(parts) else []
        rows = [[row[i] for i in part] for row in table.rows]
        left = sum(i < table.left for i in part)
        sentences = tuple(part.index(i) for i in table.sentence_columns if i in part)
        tables.append(Table(title, [table.columns[i] for i in part], rows, notes, left, sentences))
    return tables


def _print_rich(tables: Iterable[Table], stream: TextIO) -> None:
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table as RichTable
    from rich.text import Text  # in which brackets and colons are no markup

    console = Console(file=stream, highlight=False)
    fitting = [broken(table, console.width, _GAP) for table in tables]
    for table in [part for whole in fitting for part in folded(whole, console.width)]:
        if table.title:
            console.print(Text(table.title, style="bold"))
        if table.rows:
            shown = RichTable(box=SIMPLE_HEAD, show_header=bool(table.columns), padding=(0, 1, 0, 0))
            for i in range(len(table.rows[0])):
                header = Text(table.columns[i]) if table.columns else ""
                text = i < table.left or i in table.sentence_columns
                shown.add_column(header, justify="left" if text else "right", overflow="fold")
            for row in table.rows:
                shown.add_row(*(Text(cell, style=_COLOURS.get(cell, "")) for cell in row))
            console.print(shown)
        for note in table.notes:
            console.print(Text(note))
        console.print()
