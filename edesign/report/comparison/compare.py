"""An archive beside reference values: every printed cell, what was found in its place, and the difference."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.archive.reader import Archive
from edesign.assess.statistics import STATISTICS, statistics
from edesign.project.criteria.measures import MEASURES, SHORT_NAMES
from edesign.project.notation.printed_unit import unit_factor
from edesign.project.records.records import record_of
from edesign.project.study.reference import Cell, Reference, ResponseRow, ResponseTable, Statistic
from edesign.report.comparison.cells import ComparedCell, ComparedChange, ComparedTable, Comparison
from edesign.report.comparison.histories import ComparedHistory, Wanted, compared_histories, wanted
from edesign.report.comparison.variables import compare_variables

_STATISTICS = {**STATISTICS, "minimum": lambda found: found.minimum}


def compare(archive: Archive, reference: Reference) -> Comparison:
    """Compare an archive, complete or partial, with reference values.

    Raises:
        ArchiveError: the archive is damaged.
        InputError: the reference asks for a variable that its group does not have, or in a unit of another dimension.
    """
    responses = [table for table in reference.tables if isinstance(table, ResponseTable)]
    asked = {wanted(row) for table in responses for row in table.rows}
    histories = compared_histories(archive, asked) if asked else []
    tables = [
        compare_responses(table, histories)
        if isinstance(table, ResponseTable)
        else compare_variables(archive, reference, i, table)
        for i, table in enumerate(reference.tables)
    ]
    reasons = {history.name: history.reason for history in histories if history.reason}
    incomplete = "" if archive.complete else "the archive is not complete: the run goes on or was interrupted"
    notes = tuple(filter(None, (incomplete, archive.damage_in_short())))
    return Comparison(str(archive.path), str(reference.path), reference.title, tuple(tables), reasons, notes)


def compare_responses(table: ResponseTable, histories: Sequence[ComparedHistory]) -> ComparedTable:
    """Compare one table of statistics with the histories of an archive.

    Args:
        table: the table of the reference.
    """
    cells: list[ComparedCell] = []
    changes: list[ComparedChange] = []
    notes: list[str] = []
    for row in table.rows:
        statistic = row.statistic or table.statistic
        found = {}
        for variant, level, cell in row.cells():
            of = [history for history in histories if history.belongs(variant, level, table.records)]
            bar = table.bar(row, variant, level, cell)
            found[variant, level] = _compare_cell(row, statistic, (variant, level), cell, bar, of)
            suites = sorted({record_of(history.record) for history in of if history.record})
            if len(suites) > 1:
                notes.append(f"{variant}, {level}: records of {', '.join(suites)} together; `records` chooses")
        cells += found.values()
        changes += _compare_changes(table, row, found)
    return ComparedTable(table.title, "responses", tuple(cells), tuple(changes), notes=tuple(dict.fromkeys(notes)))


def _compare_cell(
    row: ResponseRow,
    statistic: Statistic,
    place: tuple[str, str],
    cell: Cell,
    bar: float | None,
    histories: Sequence[ComparedHistory],
) -> ComparedCell:
    variant, level = place
    if statistic == "mean_profile":
        value, missing = _mean_profile(row.measure, histories)
    else:
        value, missing = _statistic(wanted(row), statistic, histories)
    factor = unit_factor(row.unit, MEASURES[SHORT_NAMES[row.measure]].kind.unit)
    reason = "" if histories else f"no history of `{variant}` at `{level}`"
    return ComparedCell(
        quantity=row.label,
        source=row.measure,
        unit=row.unit,
        reference=cell.value,
        found=None if value is None else value / factor,
        within=bar,
        note="; ".join(note for note in (row.note, cell.note) if note),
        statistic=statistic,
        variant=variant,
        level=level,
        count=len(histories) - len(missing),
        of=len(histories),
        missing=missing,
        reason=reason if value is not None or not histories else "no history has a value",
    )


def _statistic(
    measure: Wanted, statistic: Statistic, histories: Sequence[ComparedHistory]
) -> tuple[float | None, tuple[str, ...]]:
    found = statistics({history.name: history.values.get(measure) for history in histories})
    return _STATISTICS[statistic](found), found.missing


def _mean_profile(measure: str, histories: Sequence[ComparedHistory]) -> tuple[float | None, tuple[str, ...]]:
    """The largest value over the height of the mean over the histories."""
    profiles = [history.profiles[measure] for history in histories if measure in history.profiles]
    missing = tuple(history.name for history in histories if measure not in history.profiles)
    return float(np.max(np.mean(profiles, axis=0))) if profiles else None, missing


def _compare_changes(
    table: ResponseTable, row: ResponseRow, found: dict[tuple[str, str], ComparedCell]
) -> list[ComparedChange]:
    changes: list[ComparedChange] = []
    if table.change is None:
        return changes
    of, against = table.change.of, table.change.against
    for level, cell in row.changes():
        value, base = found[of, level].found, found[against, level].found
        change = (value - base) / base if value is not None and base else None
        changes.append(ComparedChange(row.label, of, against, level, cell.value / 100.0, change, cell.note or ""))
    return changes
