"""A comparison as tables for a terminal: a narrow block for each variant and level."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from edesign.report.comparison.cells import ComparedCell, ComparedChange, ComparedTable, Comparison
from edesign.report.tables.table import Table, formatted, number

WORDS = {
    "mean": "mean",
    "median": "median",
    "84%": "84 % percentile",
    "maximum": "maximum",
    "minimum": "minimum",
    "mean_profile": "mean storey by storey, and its largest value,",
}


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


def printed(value: float) -> str:
    """Return a reference value as it is written in its file."""
    return formatted(value, ".10g")


def found(cell: ComparedCell) -> str:
    """Return the value that was found with at least as many significant digits as the printed one (3 to 5)."""
    shown = printed(cell.reference).lstrip("-").partition("e")[0].replace(".", "").lstrip("0")
    return number(cell.found, min(max(len(shown), 3), 5))


def per_cent(ratio: float | None, digits: int = 1) -> str:
    """Return a difference in per cent with its sign, "-" for None.

    Args:
        ratio: the ratio; None: there is none.
        digits: number of digits.
    """
    return "-" if ratio is None else f"{100.0 * ratio:+.{digits}f}"


def groups(table: ComparedTable, by: Sequence[str]) -> list[list[ComparedCell]]:
    """Return the cells of a table in groups that agree in the attributes `by`, in their order.

    Args:
        table: the compared table.
        by: names of the attributes in which the cells of a group agree.
    """
    made: dict[tuple[str, ...], list[ComparedCell]] = {}
    for cell in table.cells:
        made.setdefault(tuple(getattr(cell, name) for name in by), []).append(cell)
    return list(made.values())


def with_unit(label: str, unit: str) -> str:
    """Return a label with its unit in brackets.

    Args:
        label: the label.
        unit: the unit.
    """
    return label if unit == "1" else f"{label} [{unit}]"


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
    shown = Table(f"{table.title} - {first.variant}, {first.level}: {WORDS[usual]}{made_of(first) if even else ''}")
    if not any(cell.of for cell in cells):
        shown.notes = missing_notes(cells, comparison)
        return shown
    shown.columns = ["quantity", "reference", "here", "diff. %"]
    shown.columns += [*(["bar %"] if bars else []), *([] if even else ["of"])]
    for cell in cells:
        label = with_unit(cell.quantity, cell.unit) + notes.mark(cell.note) + notes.mark(statistic_note(cell, usual))
        count = [] if even else [f"{cell.count}/{cell.of}"]
        shown.rows.append([label, printed(cell.reference), found(cell), per_cent(cell.difference)])
        shown.rows[-1] += [*(_bar(cell) if bars else []), *count]
    shown.notes = [*notes.lines, *missing_notes(cells, comparison)]
    return shown


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
        cell: the printed value and the one found.
        usual: the statistic of most cells.
    """
    return "" if cell.statistic == usual else f"{WORDS[cell.statistic]} of the histories"


def _bar(cell: ComparedCell) -> list[str]:
    if cell.within is None:
        return ["-"]
    return [f"{100.0 * cell.within:g} {'met' if cell.inside else 'NOT met'}"]


def missing_notes(cells: Iterable[ComparedCell], comparison: Comparison) -> list[str]:
    """Return notes on the histories without a value, each with the reason, and on absent values.

    Args:
        cells: the cells of the table.
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
    first = changes[0]
    shown = Table(
        f"{table.title} - change from {first.against} to {first.of}, {level}",
        ["quantity", "reference %", "here %", "points"],
    )
    for change in changes:
        shown.rows.append(
            [change.quantity + notes.mark(change.note), *change_cells(change), per_cent(change.difference)]
        )
    shown.notes = notes.lines
    return shown


def change_cells(change: ComparedChange) -> list[str]:
    """Return the printed change and the one found, in per cent."""
    return [formatted(100.0 * change.reference, ".10g"), per_cent(change.found)]


def _variable_block(table: ComparedTable, cells: list[ComparedCell], bars: bool) -> Table:
    notes = Notes()
    title = f"{table.title} - {with_unit(cells[0].quantity, cells[0].unit)}"
    shown = Table(title, [table.over, "reference", "here", "diff. %", *(["bar %"] if bars else [])])
    of_all = common_note(cells)
    for cell in cells:
        values = [printed(cell.reference), found(cell), per_cent(cell.difference)]
        mark = "" if of_all else notes.mark(cell.note)
        shown.rows.append([cell.index + mark, *values, *(_bar(cell) if bars else [])])
    shown.notes = [*of_all, *notes.lines, *dict.fromkeys(cell.reason for cell in cells if cell.reason)]
    return shown


def common_note(cells: Sequence[ComparedCell]) -> list[str]:
    """Return the note of all cells, if they share one; else []."""
    notes = {cell.note for cell in cells}
    return [note for note in notes if note and len(notes) == 1]


def _heading(comparison: Comparison) -> Table:
    rows = [["archive", comparison.archive], ["reference", comparison.reference]]
    return Table(comparison.title, (), rows, list(comparison.notes), left=2)


def _summary(comparison: Comparison) -> Table:
    cells = comparison.cells
    notes = [f"{len(cells)} reference values, {len(cells) - len(comparison.absent)} of them found"]
    barred = [cell for cell in cells if cell.within is not None]
    if barred:
        notes.append(f"{len(barred)} of them have a bar, {len(barred) - len(comparison.outside)} are within it")
    return Table("", (), notes=notes)
