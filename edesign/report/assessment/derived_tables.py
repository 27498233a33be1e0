"""Tables of the variants that a study made of others: measures by value, and envelopes over bounds of the dampers."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.assess.sets import HistorySet, measure_statistics
from edesign.project.study.study import Study
from edesign.report.assessment.derived_results import Bounded, Sweep, bounded, sweeps
from edesign.report.assessment.measure_columns import MEASURE_COLUMNS, MEASURE_ROWS, ROUNDING
from edesign.report.assessment.measure_tables import missing_notes
from edesign.report.tables.table import Table, number


def derived_tables(study: Study, sets: Sequence[HistorySet]) -> list[Table]:
    """Return a table of each sweep and of each variant with bounds, level by level.

    Args:
        study: the study.
        sets: the histories by variant and level.
    """
    tables = [sweep_table(sweep) for sweep in sweeps(study, sets)]
    return tables + [bounds_table(found) for found in bounded(study, sets)]


def sweep_table(sweep: Sweep) -> Table:
    """Return the mean measures for each value."""
    columns = [(header, key, unit) for header, key, unit in MEASURE_COLUMNS if key in sweep.measures]
    table = Table(f"Mean response by {sweep.title}", ("value", *(header for header, _, _ in columns), "of"))
    for value, found in zip(sweep.values, sweep.sets, strict=True):
        statistics = measure_statistics(found)
        means = [number(statistics[key].mean, 4, unit, ROUNDING) for _, key, unit in columns]
        table.rows.append([value, *means, f"{len(found.completed)}/{len(found.histories)}"])
    names = [found.variant for found in sweep.sets]
    many = f"Variants {names[0]} to {names[-1]}" if len(names) > 1 else f"Variant {names[0]}"
    table.notes = [
        f"Value: {sweep.vary.place}.",
        f"{many}; of: histories that were completed.",
        *missing_notes(sweep.sets),
    ]
    return table


def bounds_table(found: Bounded) -> Table:
    """Return the mean measures with each bound of the dampers' properties, and which of them is the largest."""
    statistics = {side: measure_statistics(one) for side, one in found.sets.items()}
    at = f" at {found.level}" if found.level else ""
    title = f"Mean response of {found.of}{at} with bounds of its dampers"
    table = Table(title, ("measure", *statistics, "envelope", "governs"))
    for name, key, unit in MEASURE_ROWS:
        means = {side: mean for side, of in statistics.items() if (mean := of[key].mean) is not None}
        if not means:
            continue
        largest = max(means, key=means.__getitem__)
        cells = [number(means.get(side), 4, unit, ROUNDING) for side in statistics]
        governs = largest if len(means) == len(statistics) and means[largest] > ROUNDING else "-"
        table.rows.append([name, *cells, number(means[largest], 4, unit, ROUNDING), governs])
    table.notes = missing_notes(list(found.sets.values()))
    return table
