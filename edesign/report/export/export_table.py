"""A table as programs read it: columns of numbers with their units, and of texts."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.report.export.names import unique_names
from edesign.report.tables.table import NumberText, Table

Value = str | float | int | bool | None

_UNIT = re.compile(r"\s*\[([^\[\]]+)\]")
_BARE_UNIT = re.compile(r"\s+(%|ms|mm|kN|kJ|J|Hz)$")
_MISSING = ("-", "")
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
    """

    name: str
    title: str
    columns: tuple[ExportColumn, ...]
    notes: tuple[str, ...] = field(default=())
    left: int = 1

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
    if not table.rows:
        return ExportTable(name, table.title or title, (ExportColumn("text", "", list(table.notes)),))
    width = len(table.rows[0])
    headers = list(table.columns) or [_FIRST, "value", *(f"value {i}" for i in range(2, width))][:width]
    parts = [_name_and_unit(header) for header in headers]
    names = unique_names([part or _FIRST for part, _ in parts], " ")
    columns = []
    for i, (_, unit) in enumerate(parts):
        cells = [row[i] for row in table.rows]
        numbers = any(isinstance(cell, NumberText) for cell in cells)
        said = table.units[i] if table.units else ""
        own = [cell.unit if isinstance(cell, NumberText) else "" for cell in cells]
        several = len({of for of, cell in zip(own, cells, strict=True) if cell not in _MISSING}) > 1
        if not unit and not several:
            said = said or next(filter(None, own), "")
        columns.append(ExportColumn(names[i], unit or said, [_value(cell) for cell in cells], cells if numbers else ()))
        if not unit and several:
            columns.append(ExportColumn(f"unit of {names[i]}", "", [of or None for of in own]))
    return ExportTable(name, table.title or title, tuple(columns), tuple(table.notes), table.left)


def as_one(common: str, tables: Sequence[tuple[str, Table]]) -> Table:
    """Return one table for those that several analyses or members have, with the name of each in the first column.

    Args:
        common: title of all.
        tables: each with the name whose it is; columns that a table lacks are empty.
    """
    columns = list(dict.fromkeys(column for _, table in tables for column in table.columns))
    made = Table(common, ("of", *columns), left=1 + tables[0][1].left, name=tables[0][1].name)
    for of, table in tables:
        for row in table.rows:
            cells = dict(zip(table.columns, row, strict=True))
            made.rows.append([of, *(cells.get(column, "") for column in columns)])
    notes = dict.fromkeys(note for _, table in tables for note in table.notes)
    made.notes = list(notes)
    return made


def _name_and_unit(header: str) -> tuple[str, str]:
    """The parts of `drift [%]`, and of `root %`, as tables with many columns have it; `[-]` is no unit."""
    match = _UNIT.search(header) or _BARE_UNIT.search(header)
    if match is None:
        return header.strip(), ""
    unit = match[1].strip()
    return (header[: match.start()] + header[match.end() :]).strip(), "" if unit == "-" else unit


def _value(cell: str) -> Value:
    if isinstance(cell, NumberText):
        return cell.value
    return None if cell in _MISSING else str(cell)


def _is_number(value: Value) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
