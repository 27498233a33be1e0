"""A comparison as wide tables for a page: variants and their change side by side."""

from __future__ import annotations

from edesign.report.comparison.cells import ComparedCell, ComparedTable, Comparison
from edesign.report.comparison.tables import (
    WORDS,
    Notes,
    change_cells,
    common_note,
    found,
    groups,
    made_of,
    missing_notes,
    per_cent,
    printed,
    statistic_note,
    usual_statistic,
    with_unit,
)
from edesign.report.tables.table import Table

WIDEST = 130
"""Characters of the headers of a wide table of variables."""

_BESIDE = 20  # characters of the two columns beside a reference


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
    variants, notes, usual = (
        list(dict.fromkeys(cell.variant for cell in cells)),
        Notes(),
        usual_statistic(table.cells),
    )
    changes = {change.quantity: change for change in table.changes if change.level == level}
    columns = ["quantity"]
    for variant in variants:
        columns += [f"{variant}, reference", "here", "diff. %"]
    columns += ["change %, reference", "here"] if changes else []
    shown = Table(f"{table.title} - {level}", columns)
    rows: dict[str, dict[str, ComparedCell]] = {}
    for cell in cells:
        rows.setdefault(cell.quantity, {})[cell.variant] = cell
    for quantity, row in rows.items():
        first = next(iter(row.values()))
        line = [with_unit(quantity, first.unit) + notes.mark(statistic_note(first, usual))]
        for variant in variants:
            line += _wide_cell(row.get(variant), notes)
        if changes:
            change = changes.get(quantity)
            line += ["", ""] if change is None else change_cells(change)
            line[-2] += notes.mark(change.note) if change is not None else ""
        shown.rows.append(line)
    counts = [next(cell for cell in cells if cell.variant == variant) for variant in variants]
    made = "; ".join(f"{cell.variant}: {WORDS[usual]}{made_of(cell)}" for cell in counts if cell.of)
    shown.notes = [*notes.lines, made]
    shown.notes = [note for note in [*shown.notes, *missing_notes(cells, comparison)] if note]
    return shown


def _wide_cell(cell: ComparedCell | None, notes: Notes | None) -> list[str]:
    if cell is None:
        return ["", "", ""]
    mark = "" if notes is None else notes.mark(cell.note)
    return [printed(cell.reference) + mark, found(cell), per_cent(cell.difference)]


def _beside(table: ComparedTable) -> list[list[list[ComparedCell]]]:
    """The rows of a table of variables, in parts that are not too wide."""
    parts: list[list[list[ComparedCell]]] = []
    width = WIDEST
    for row in groups(table, ("quantity",)):
        of_row = len(with_unit(row[0].quantity, row[0].unit)) + _BESIDE
        if width + of_row > WIDEST:
            parts.append([])
            width = 0
        parts[-1].append(row)
        width += of_row
    return parts


def _wide_variables(table: ComparedTable, rows: list[list[ComparedCell]], first: bool) -> Table:
    columns, notes = [table.over], Notes()
    for row in rows:
        mark = "".join(notes.mark(note) for note in common_note(row))
        columns += [with_unit(row[0].quantity, row[0].unit) + mark, "here", "diff. %"]
    shown = Table(table.title if first else "", columns)
    for cells in zip(*rows, strict=True):
        line = [cells[0].index]
        for cell, row in zip(cells, rows, strict=True):
            line += _wide_cell(cell, None if common_note(row) else notes)
        shown.rows.append(line)
    reasons = dict.fromkeys(cell.reason for row in rows for cell in row if cell.reason)
    shown.notes = [*notes.lines, *reasons]
    return shown
