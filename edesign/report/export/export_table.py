"""A table as programs read it: columns of numbers with their units, and of texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.report.export.names import unique_names
from edesign.report.tables.cell import Cell
from edesign.report.tables.cell import Plain as Value
from edesign.report.tables.column import NO_VALUE, text
from edesign.report.tables.table import Table

_FIRST = "what"
"""The header of a first column without one."""


@dataclass(frozen=True)
class ExportColumn:
    """A column.

    Attributes:
        name: unique in its table.
        unit: of its numbers, "" for texts and where there is none.
        values: a number, a text, or None for what is missing, for each row.
        texts: the numbers as they are shown to people; () where they are shown with all digits.
        long_name: more words about it, "" without.
    """

    name: str
    unit: str
    values: Sequence[Value]
    texts: Sequence[str] = ()
    long_name: str = ""

    @property
    def header(self) -> str:
        """The name with the unit, such as `drift [%]`."""
        return f"{self.name} [{self.unit}]" if self.unit not in ("", "1") else self.name

    @property
    def numeric(self) -> bool:
        """Whether the column has numbers only."""
        return any(_is_number(value) for value in self.values) and not any(isinstance(v, str) for v in self.values)


@dataclass(frozen=True)
class ExportTable:
    """A table of an archive.

    Attributes:
        name: by which it is chosen; of its file.
        title: one line.
        columns: each with as many values.
        notes: lines below.
        left: number of columns, from the first, that name the rows.
        sheet: its name in a workbook, before it is cut; "": `name`.
    """

    name: str
    title: str
    columns: tuple[ExportColumn, ...]
    notes: tuple[str, ...] = field(default=())
    left: int = 1
    sheet: str = ""

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.columns[0].values) if self.columns else 0


def export_table(name: str, table: Table, title: str = "") -> ExportTable:
    """Return a table of `edesign show` or of the report with its numbers.

    Args:
        name: by which it is chosen.
        table: one without rows has its notes as rows.
        title: where the table has none.
    """
    table = table
    if not table.rows:
        return ExportTable(name, table.title or title, (ExportColumn("text", "", list(table.notes)),))
    names = unique_names([column.in_files or _FIRST for column in table.columns], " ")
    printed = list(zip(*table.texts, strict=True))
    columns = []
    for i, column in enumerate(table.columns):
        cells = [row[i] for row in table.rows]
        values = [column.data(cell) for cell in cells]
        own = [cell.own_unit() if isinstance(cell, Cell) else "" for cell in cells]
        several = len({of for of, shown in zip(own, printed[i], strict=True) if shown not in NO_VALUE}) > 1
        unit = column.unit_in_files or ("" if several else next(filter(None, own), ""))
        shown = printed[i] if any(_is_number(value) for value in values) else ()
        columns.append(ExportColumn(names[i], unit, values, shown))
        if several and not column.unit_in_files:
            columns.append(ExportColumn(f"unit of {names[i]}", "", [of or None for of in own]))
    return ExportTable(name, table.title or title, tuple(columns), tuple(table.notes), table.keys)


def as_one(common: str, given: Sequence[tuple[str, Table]]) -> Table:
    """Return one table for those that several analyses or members have, with the name of each in the first column.

    Args:
        common: title of all.
        given: each with the name whose it is; columns that a table lacks are empty.
    """
    tables = [(of, table) for of, table in given]
    columns = {column.head: column for _, table in reversed(tables) for column in reversed(table.columns)}
    heads = list(dict.fromkeys(column.head for _, table in tables for column in table.columns))
    first = tables[0][1]
    made = Table(common, (text("of", ""), *(columns[head] for head in heads)), keys=1 + first.keys, name=first.name)
    for of, table in tables:
        for row in table.rows:
            cells = {column.head: cell for column, cell in zip(table.columns, row, strict=True)}
            made.rows.append([of, *(cells.get(head) for head in heads)])
    made.notes = list(dict.fromkeys(note for _, table in tables for note in table.notes))
    return made


def _is_number(value: Value) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
