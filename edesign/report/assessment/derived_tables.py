"""Tables of the variants that a study made of others: measures by value, and envelopes over bounds of the dampers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from operator import itemgetter
from typing import Any, NamedTuple

from edesign.assess.sets import HistorySet, measure_statistics
from edesign.project.study.study import Study
from edesign.report.assessment.derived_results import Bounded, Sweep, bounded, sweeps
from edesign.report.assessment.measure_columns import MEASURE_COLUMNS, MEASURE_ROWS, ROUNDING, Measure
from edesign.report.assessment.measure_tables import missing_notes
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.table import MORE, Table, TableSpec
from edesign.report.tables.unit import ONE


class _Bound(NamedTuple):
    """The means of a measure by bound, SI; those of no history are left out."""

    measure: Measure
    means: Mapping[str, float]

    @property
    def largest(self) -> str:
        return max(self.means, key=self.means.__getitem__)


def _side(name: str) -> Column[_Bound]:
    return col(name, ONE, lambda one: one.measure.cell(one.means.get(name)))


SWEEP = TableSpec[Mapping[str, Any]](
    "sweep",
    "Mean response by {of}",
    (MORE, count("of")),  # a column for each place, and for each measure
    notes=("Values: {places}.", "{variants}; of: histories that were completed."),
    named_by_title=True,
)
BOUNDS = TableSpec[_Bound](
    "bounds",
    "Mean response of {of} with bounds of its dampers",
    (
        text("measure", "measure.head"),
        MORE,  # a column for each bound
        col("envelope", ONE, lambda one: one.measure.cell(one.means[one.largest])),
        text("governs", lambda one: one.largest if len(one.means) == 3 and one.means[one.largest] > ROUNDING else None),
    ),
    named_by_title=True,
)


def derived_tables(study: Study, sets: Sequence[HistorySet]) -> list[Table]:
    """Return a table of each sweep and of each variant with bounds, level by level."""
    tables = [sweep_table(sweep) for sweep in sweeps(study, sets)]
    return tables + [bounds_table(found) for found in bounded(study, sets)]


def sweep_table(sweep: Sweep) -> Table:
    """Return the mean measures for each combination of values."""
    places = sweep.vary.places
    heads = ["value"] if len(places) == 1 else list(sweep.quantities)
    means = [{name: one.mean for name, one in measure_statistics(found).items()} for found in sweep.sets]
    items = [
        {**dict(zip(places, point, strict=True)), "of": f"{len(found.completed)}/{len(found.histories)}", **of}
        for point, found, of in zip(sweep.points, sweep.sets, means, strict=True)
    ]
    names = [found.variant for found in sweep.sets]
    there: list[Column[Mapping[str, Any]]] = [
        text(head, itemgetter(place)) for head, place in zip(heads, places, strict=True)
    ]
    return SWEEP.of(
        items,
        more=[
            *there,
            *(replace(column, optional=False) for column in MEASURE_COLUMNS if column.value in sweep.measures),
        ],
        notes=missing_notes(sweep.sets),
        of=sweep.title,
        places="; ".join(f"{head} is {place}" for head, place in zip(sweep.quantities, places, strict=True)),
        variants=f"Variants {names[0]} to {names[-1]}" if len(names) > 1 else f"Variant {names[0]}",
    )


def bounds_table(found: Bounded) -> Table:
    """Return the mean measures with each bound of the dampers' properties, and which of them is the largest."""
    at = f" at {found.level}" if found.level else ""
    sides = [_side(name) for name in found.sets]
    return BOUNDS.of(_bounds(found), more=sides, notes=missing_notes(list(found.sets.values())), of=found.of + at)


def _bounds(found: Bounded) -> Iterator[_Bound]:
    statistics = {side: measure_statistics(one) for side, one in found.sets.items()}
    for measure in MEASURE_ROWS:
        means = {side: mean for side, of in statistics.items() if (mean := of[measure.name].mean) is not None}
        if means:
            yield _Bound(measure, means)
