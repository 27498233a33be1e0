"""A comparison as tables for a terminal: a narrow block for each variant and level."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from operator import itemgetter
from typing import NamedTuple

from edesign.report.comparison.cells import ComparedCell, ComparedChange, ComparedTable, Comparison
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT

WORDS = {
    "mean": "mean",
    "median": "median",
    "84%": "84 % percentile",
    "maximum": "maximum",
    "minimum": "minimum",
    "mean_profile": "mean storey by storey, and its largest value,",
}


PRINTED = ".10g"
"""Form of reference values: as they are written in their file."""
DIFFERENCE = "+.1f"
"""Form of differences in per cent."""


class _Row(NamedTuple):
    """A value with the words for it and the numbers of its notes."""

    label: str
    cell: ComparedCell


class _Change(NamedTuple):
    """A change with the words for it and the number of its note."""

    label: str
    change: ComparedChange


def found(cell: ComparedCell) -> Quantity | None:
    """Return the value that was found with at least as many significant digits as the printed one (3 to 5)."""
    digits = format(cell.reference, PRINTED).lstrip("-").partition("e")[0].replace(".", "").lstrip("0")
    return None if cell.found is None else Quantity(cell.found, ONE, min(max(len(digits), 3), 5))


def _bar(row: _Row) -> str | None:
    within = row.cell.within
    return None if within is None else f"{100.0 * within:g} {'met' if row.cell.inside else 'NOT met'}"


HEADING = TableSpec[tuple[str, str]](
    "compared_files", "{title}", (text("what", itemgetter(0)), text("file", itemgetter(1))), keys=2, headed=False
)
VALUES = TableSpec[_Row](
    "compared_values",
    "{title}",
    (
        text("{of}", "label"),
        col("reference", ONE, "cell.reference", form=PRINTED),
        col("here", ONE, lambda row: found(row.cell)),
        col("diff.", PERCENT, "cell.difference", form=DIFFERENCE, bare=True),
        text("bar %", _bar),
        count("of", lambda row: f"{row.cell.count}/{row.cell.of}"),
    ),
)
CHANGES = TableSpec[_Change](
    "compared_changes",
    "{title}",
    (
        text("quantity", "label"),
        col("reference", PERCENT, "change.reference", form=PRINTED, bare=True),
        col("here", PERCENT, "change.found", form=DIFFERENCE, bare=True),
        col("points", PERCENT, "change.difference", form=DIFFERENCE, silent=True),
    ),
)


def block_tables(comparison: Comparison, bars: bool = False) -> list[Table]:
    """Return a table for each variant and level, each change, and each variable: none wider than 80 characters.

    Args:
        comparison: of an archive.
        bars: show the bar of each cell and whether it holds.
    """
    tables = [_heading(comparison)]
    for table in comparison.tables:
        blocks: list[Table] = []
        if table.kind == "responses":
            for cells in groups(table, ("variant", "level")):
                blocks.append(_response_block(table, comparison, cells, bars))
            levels = dict.fromkeys(change.level for change in table.changes if change.found is not None)
            blocks += [_change_block(table, level) for level in levels]
        elif any(cell.found is not None for cell in table.cells):
            blocks += [_variable_block(table, cells, bars) for cells in groups(table, ("quantity",))]
        else:
            blocks.append(Table(table.title))
        blocks[-1].notes += [note for note in table.notes if note not in blocks[-1].notes]
        tables += blocks
    return [*tables, _summary(comparison)]


def groups(table: ComparedTable, by: Sequence[str]) -> list[list[ComparedCell]]:
    """Return the cells of a table in groups that agree in the attributes `by`, in their order."""
    made: dict[tuple[str, ...], list[ComparedCell]] = {}
    for cell in table.cells:
        made.setdefault(tuple(getattr(cell, name) for name in by), []).append(cell)
    return list(made.values())


def name_of(cell: ComparedCell) -> str:
    """Return the quantity of a value with its unit."""
    return cell.quantity if cell.unit == "1" else f"{cell.quantity} [{cell.unit}]"


class Notes:
    """Notes with their numbers; one that comes again has its number again."""

    def __init__(self) -> None:
        self.found: dict[str, int] = {}

    def mark(self, note: str) -> str:
        """Return the number of a note for the end of a label; nothing for an empty note."""
        return f" ({self.found.setdefault(note, len(self.found) + 1)})" if note else ""

    @property
    def lines(self) -> list[str]:
        """The notes with their numbers."""
        return [f"({count}) {note}" for note, count in self.found.items()]


def _response_block(table: ComparedTable, comparison: Comparison, cells: list[ComparedCell], bars: bool) -> Table:
    first, notes, usual = cells[0], Notes(), usual_statistic(table.cells)
    even = len({(cell.count, cell.of) for cell in cells}) == 1
    title = f"{table.title} - {first.variant}, {first.level}: {WORDS[usual]}{made_of(first) if even else ''}"
    if not any(cell.of for cell in cells):
        return Table(title, notes=missing_notes(cells, comparison))
    rows = [
        _Row(f"{name_of(cell)}{notes.mark(cell.note)}{notes.mark(statistic_note(cell, usual))}", cell) for cell in cells
    ]
    without = [*([] if bars else ["bar %"]), *(["of"] if even else [])]
    texts = [*notes.lines, *missing_notes(cells, comparison)]
    return VALUES.of(rows, title=title, of="quantity", without=without, notes=texts)


def made_of(cell: ComparedCell) -> str:
    """Return the number of histories behind a value, in words."""
    histories = "history" if cell.of == 1 else "histories"
    if not cell.of:
        return ""
    return f" of {cell.count} {histories}" if cell.count == cell.of else f" of {cell.count} of {cell.of} {histories}"


def usual_statistic(cells: Iterable[ComparedCell]) -> str:
    """Return the statistic of most cells."""
    names = [cell.statistic for cell in cells]
    return max(dict.fromkeys(names), key=names.count)


def statistic_note(cell: ComparedCell, usual: str) -> str:
    """Return a note on a statistic that is not the usual one of the table.

    Args:
        usual: the statistic of most cells.
    """
    return "" if cell.statistic == usual else f"{WORDS[cell.statistic]} of the histories"


def missing_notes(cells: Iterable[ComparedCell], comparison: Comparison) -> list[str]:
    """Return notes on the histories without a value, each with the reason, and on absent values.

    Args:
        comparison: an archive beside a reference file.
    """
    without: dict[str, dict[str, None]] = {}
    others: dict[str, None] = {}
    for cell in cells:
        for name in cell.missing:
            reason = comparison.reasons.get(name) or f"it has no {cell.source}"
            without.setdefault(reason, {})[name] = None
        if cell.reason and not cell.missing:
            others[cell.reason] = None
    return [*(f"without {', '.join(names)}: {reason}" for reason, names in without.items()), *others]


def _change_block(table: ComparedTable, level: str) -> Table:
    changes, notes = [change for change in table.changes if change.level == level], Notes()
    title = f"{table.title} - change from {changes[0].against} to {changes[0].of}, {level}"
    rows = [_Change(f"{change.quantity}{notes.mark(change.note)}", change) for change in changes]
    return CHANGES.of(rows, title=title, notes=notes.lines)


def _variable_block(table: ComparedTable, cells: list[ComparedCell], bars: bool) -> Table:
    notes, of_all = Notes(), common_note(cells)
    rows = [_Row(cell.index + ("" if of_all else notes.mark(cell.note)), cell) for cell in cells]
    texts = [*of_all, *notes.lines, *dict.fromkeys(cell.reason for cell in cells if cell.reason)]
    without = ("of",) if bars else ("of", "bar %")
    return VALUES.of(rows, title=f"{table.title} - {name_of(cells[0])}", of=table.over, without=without, notes=texts)


def common_note(cells: Sequence[ComparedCell]) -> list[str]:
    """Return the note of all cells, if they share one; else []."""
    notes = {cell.note for cell in cells}
    return [note for note in notes if note and len(notes) == 1]


def _heading(comparison: Comparison) -> Table:
    files = (("archive", comparison.archive), ("reference", comparison.reference))
    return HEADING.of(files, title=comparison.title, notes=comparison.notes)


def _summary(comparison: Comparison) -> Table:
    cells = comparison.cells
    notes = [f"{len(cells)} reference values, {len(cells) - len(comparison.absent)} of them found"]
    barred = [cell for cell in cells if cell.within is not None]
    if barred:
        notes.append(f"{len(barred)} of them have a bar, {len(barred) - len(comparison.outside)} are within it")
    return Table("", notes=notes)
