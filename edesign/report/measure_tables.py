"""Tables of response measures: record by record, and their statistics for each variant and hazard level."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from edesign.assess.measures import response_measures
from edesign.assess.sets import HistorySet, measure_statistics
from edesign.assess.statistics import STATISTICS, Statistics
from edesign.report.measure_columns import MEASURE_COLUMNS, MEASURE_ROWS, ROUNDING
from edesign.report.table import Table, number

STATISTIC_TITLES = {"mean": "Mean", "maximum": "Maximum", "median": "Median", "84%": "84 % percentile (counted)"}


def label(found: HistorySet) -> str:
    """Return the variant and level of a set for headers and titles."""
    return ", ".join(part for part in (found.variant, found.level) if part) or "histories"


def record_measures_table(found: HistorySet) -> Table:
    """Return the response measures of each record of a variant at a level, and below them their statistics."""
    measures = {name: response_measures(group) for name, group in found.completed.items()}
    shown = [c for c in MEASURE_COLUMNS if any(item[c[1]] is not None for item in measures.values())]
    table = Table(f"{label(found)}: response measures (largest absolute values)", ("record", *(c[0] for c in shown)))
    records = {name: str(found.histories[name].attributes.get("record") or name) for name in measures}
    unique = len(set(records.values())) == len(records)
    for name, item in measures.items():
        cells = [number(item[measure], scale=unit, negligible=ROUNDING) for _, measure, unit in shown]
        table.rows.append([records[name] if unique else name, *cells])
    over = measure_statistics(found)
    for statistic, of in STATISTICS.items() if len(measures) > 1 else ():
        cells = [number(of(over[c[1]]), scale=c[2], negligible=ROUNDING) for c in shown]
        table.rows.append([STATISTIC_TITLES[statistic].lower(), *cells])
    if len(measures) > 1:
        spread = [number(over[c[1]].dispersion, 3) for c in shown]
        table.rows.append(["dispersion (of ln)", *spread])
    table.notes += missing_notes([found], labelled=False)
    return table


def statistics_tables(sets: Sequence[HistorySet]) -> list[Table]:
    """Return a table for each statistic: rows are measures, columns variants at levels.

    At each level the difference of every further variant from the first one follows it, in per cent.

    Source: form of thesis Tables 5.8 (mean) and 5.9 (maximum).
    """
    levels = list(dict.fromkeys(found.level for found in sets))
    ordered = [found for level in levels for found in sets if found.level == level and found.completed]
    over = [measure_statistics(found) for found in ordered]
    values = {measure: [each[measure] for each in over] for _, measure, _ in MEASURE_ROWS}
    shown = [row for row in MEASURE_ROWS if any(item.count for item in values[row[1]])]
    tables = []
    for statistic, of in STATISTICS.items() if ordered else ():
        table = Table(f"{STATISTIC_TITLES[statistic]} response", ("measure", *_headers(ordered)))
        for name, measure, unit in shown:
            table.rows.append([name, *_cells(ordered, values[measure], of, unit)])
        counts = "; ".join(f"{label(found)}: {len(found.completed)} of {len(found.histories)}" for found in ordered)
        table.notes.append(f"Histories: {counts}")
        table.notes += missing_notes(sets)
        tables.append(table)
    return tables


def missing_notes(sets: Sequence[HistorySet], labelled: bool = True) -> list[str]:
    """Return a line for each set with histories that failed or have not run: they are in no statistic."""
    notes = []
    for found in sets:
        for names, what in ((found.failed, "failed"), (found.not_run, "not run")):
            if names:
                whose = f"{label(found)}: " if labelled else ""
                notes.append(
                    f"{whose}{what}, in no statistic ({len(names)} of {len(found.histories)}): {', '.join(names)}"
                )
    return notes


def _headers(ordered: Sequence[HistorySet]) -> list[str]:
    headers = []
    for at, found in enumerate(ordered):
        headers.append(label(found))
        if _first(ordered, at) != at:
            headers.append("diff. [%]")
    return headers


def _cells(
    ordered: Sequence[HistorySet], values: Sequence[Statistics], of: Callable[[Statistics], float | None], unit: float
) -> list[str]:
    cells = []
    for at in range(len(ordered)):
        value = of(values[at])
        cells.append(number(value, scale=unit, negligible=ROUNDING))
        first = _first(ordered, at)
        if first != at:
            base = of(values[first])
            cells.append(f"{100.0 * (value / base - 1.0):+.1f}" if value is not None and base else "-")
    return cells


def _first(ordered: Sequence[HistorySet], at: int) -> int:
    """Position of the first variant at the level of a set."""
    return next(i for i, found in enumerate(ordered) if found.level == ordered[at].level)
