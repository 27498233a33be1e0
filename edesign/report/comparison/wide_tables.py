"""A comparison as wide tables for a page: variants and their change side by side."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from operator import itemgetter

from edesign.report.comparison.cells import ComparedCell, ComparedTable, Comparison
from edesign.report.comparison.tables import (
    DIFFERENCE,
    PRINTED,
    WORDS,
    Notes,
    common_note,
    found,
    groups,
    made_of,
    missing_notes,
    name_of,
    statistic_note,
    usual_statistic,
)
from edesign.report.tables.cell import Marked, Value
from edesign.report.tables.column import Column, col, literal, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT

WIDEST = 130
"""Characters of the headers of a wide table of variables."""

_BESIDE = 20  # characters of the two columns beside a reference
Row = list[Value]
"""The values of a row by their columns."""
WIDE = TableSpec[Row]("compared_side_by_side", "{title}", (text("{of}", itemgetter(0)),))  # and what is beside it


def _columns(headers: Sequence[str], changes: bool = False) -> list[Column[Row]]:
    """For each header of a reference three columns, and the two of a change."""
    made: list[Column[Row]] = []
    for header in headers:
        at = 1 + len(made)
        made.append(col(literal(header), ONE, itemgetter(at), form=PRINTED))
        made.append(col("here", ONE, itemgetter(at + 1)))
        made.append(col("diff.", PERCENT, itemgetter(at + 2), form=DIFFERENCE, bare=True))
    if changes:
        at = 1 + len(made)
        made.append(col("change %, reference", PERCENT, itemgetter(at), form=PRINTED, silent=True))
        made.append(col("here", PERCENT, itemgetter(at + 1), form=DIFFERENCE, silent=True))
    return made


def wide_tables(comparison: Comparison) -> list[Table]:
    """Return a table for each level, with variants and their change side by side, and one for each set of variables."""
    tables = []
    for table in comparison.tables:
        if table.kind == "responses":
            levels = list(dict.fromkeys(cell.level for cell in table.cells))
            made = [_wide_responses(table, comparison, level) for level in levels]
        else:
            made = [_wide_variables(table, rows, i == 0) for i, rows in enumerate(_beside(table))]
        made[-1].notes += [note for note in table.notes if note not in made[-1].notes]
        tables += made
    return tables


def _wide_responses(table: ComparedTable, comparison: Comparison, level: str) -> Table:
    cells = [cell for cell in table.cells if cell.level == level]
    variants = list(dict.fromkeys(cell.variant for cell in cells))
    notes, usual = Notes(), usual_statistic(table.cells)
    changes = {change.quantity: change for change in table.changes if change.level == level}
    by_quantity: dict[str, dict[str, ComparedCell]] = {}
    for cell in cells:
        by_quantity.setdefault(cell.quantity, {})[cell.variant] = cell
    rows: list[Row] = []
    for quantity, row in by_quantity.items():
        first = next(iter(row.values()))
        line: Row = [name_of(first) + notes.mark(statistic_note(first, usual))]
        for variant in variants:
            line += _wide_cell(row.get(variant), notes)
        change = changes.get(quantity)
        line += ["", ""] if change is None else [Marked(change.reference, notes.mark(change.note)), change.found]
        rows.append(line)
    counts = [next(cell for cell in cells if cell.variant == variant) for variant in variants]
    made = "; ".join(f"{cell.variant}: {WORDS[usual]}{made_of(cell)}" for cell in counts if cell.of)
    more = _columns([f"{variant}, reference" for variant in variants], bool(changes))
    texts = [note for note in [*notes.lines, made, *missing_notes(cells, comparison)] if note]
    return WIDE.of(rows, title=f"{table.title} - {level}", of="quantity", more=more, notes=texts)


def _wide_cell(cell: ComparedCell | None, notes: Notes | None) -> Row:
    if cell is None:
        return ["", "", ""]
    mark = "" if notes is None else notes.mark(cell.note)
    return [Marked(cell.reference, mark), found(cell), cell.difference]


def _beside(table: ComparedTable) -> list[list[list[ComparedCell]]]:
    """The rows of a table of variables, in parts that are not too wide."""
    parts: list[list[list[ComparedCell]]] = []
    width = WIDEST
    for row in groups(table, ("quantity",)):
        of_row = len(name_of(row[0])) + _BESIDE
        if width + of_row > WIDEST:
            parts.append([])
            width = 0
        parts[-1].append(row)
        width += of_row
    return parts


def _wide_variables(table: ComparedTable, rows: list[list[ComparedCell]], first: bool) -> Table:
    notes = Notes()
    heads = [name_of(row[0]) + "".join(notes.mark(note) for note in common_note(row)) for row in rows]
    lines: list[Row] = []
    for cells in zip(*rows, strict=True):
        beside = [_wide_cell(cell, None if common_note(row) else notes) for cell, row in zip(cells, rows, strict=True)]
        lines.append([cells[0].index, *chain.from_iterable(beside)])
    reasons = dict.fromkeys(cell.reason for row in rows for cell in row if cell.reason)
    title, texts = table.title if first else "", [*notes.lines, *reasons]
    return WIDE.of(lines, title=title, of=table.over, more=_columns(heads), notes=texts)
