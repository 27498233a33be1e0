"""Tables of response measures: record by record, and their statistics for each variant and hazard level."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from edesign.archive.dataset import Group
from edesign.assess.changes import in_common
from edesign.assess.sets import HistorySet, measure_statistics
from edesign.assess.statistics import STATISTICS, Statistics
from edesign.report.assessment.measure_columns import MEASURE_COLUMNS, MEASURE_ROWS, ROUNDING, Measure
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import Column, col, literal, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import ONE, PERCENT

RECORDS = TableSpec[Mapping[str, Any]](
    "record_response",
    "{whose}: response measures (largest absolute values)",
    (text("record"), *MEASURE_COLUMNS),
    each="Response measures of each record (largest absolute values)",
)
ROWS: tuple[Column[Measure], ...] = (text("measure", "head"),)  # and each variant at each level
RESPONSE = TableSpec[Measure]("response", "Response", ROWS)
MEAN = TableSpec[Measure]("mean_response", "Mean response", ROWS)
MAXIMUM = TableSpec[Measure]("maximum_response", "Maximum response", ROWS)
MEDIAN = TableSpec[Measure]("median_response", "Median response", ROWS)
PERCENTILE = TableSpec[Measure]("percentile_84_response", "84 % percentile (counted) response", ROWS)
OF_STATISTICS = {"mean": MEAN, "maximum": MAXIMUM, "median": MEDIAN, "84%": PERCENTILE}
DIFFERENCE = "diff."
"""Header of the column beside a variant: how far it is from the first variant of its level."""
LARGEST = (
    "Each value is the largest of all storeys, floors or members, wherever it stands; what grows most is another table."
)


def label(found: HistorySet) -> str:
    """Return the variant and level of a set for headers and titles."""
    return ", ".join(part for part in (found.variant, found.level) if part) or "histories"


def record_measures_table(found: HistorySet) -> Table:
    """Return the response measures of each record of a variant at a level, and below them their statistics."""
    measures = found.measures
    records = {name: str(found.histories[name].attributes.get("record") or name) for name in measures}
    unique = len(set(records.values())) == len(records)
    rows: list[Mapping[str, Any]] = [
        {"record": records[name] if unique else name, **item} for name, item in measures.items()
    ]
    if len(measures) > 1:
        over = measure_statistics(found)
        for statistic, of in STATISTICS.items():
            title = OF_STATISTICS[statistic].title.removesuffix(" response").lower()
            rows.append({"record": title, **{name: of(each) for name, each in over.items()}})
        rows.append({"record": "dispersion (of ln)", **{name: _spread(each) for name, each in over.items()}})
    return RECORDS.of(rows, whose=label(found), notes=[*motion_notes([found]), *missing_notes([found], labelled=False)])


def _spread(over: Statistics) -> Quantity | None:
    return None if over.dispersion is None else Quantity(over.dispersion, ONE, 3)


def statistics_tables(sets: Sequence[HistorySet]) -> list[Table]:
    """Return a table for each statistic: rows are measures, columns variants at levels.

    Where no set has more than one history, all statistics are its values, and stand in one table.

    At each level the difference of every further variant from the first one follows it, in per cent: over the records
    that both have completed; left out where there is none.

    Source: form of thesis Tables 5.8 (mean) and 5.9 (maximum).
    """
    of_levels = first_of_level(sets)
    if not of_levels:
        return []
    ordered = [found for _, found in of_levels]
    over = [measure_statistics(found) for found in ordered]
    pairs = [_pair(first, found) for first, found in of_levels]
    counts = "; ".join(f"{label(found)}: {len(found.completed)} of {len(found.histories)}" for found in ordered)
    notes = [f"Histories: {counts}", *([LARGEST] if any(pairs) else [])]
    notes += [pair.note for pair in pairs if pair is not None and pair.note]
    notes += [*motion_notes(sets), *missing_notes(sets)]
    shown = [row for row in MEASURE_ROWS if any(each[row.name].count for each in over)]
    single = all(len(found.completed) == 1 for found in ordered)
    return [
        spec.of(shown, more=list(_columns(ordered, over, pairs, STATISTICS[statistic])), notes=notes)
        for statistic, spec in ({"maximum": RESPONSE} if single else OF_STATISTICS).items()
    ]


def tables_of_sets(
    sets: Iterable[HistorySet], needed: str, table: Callable[[Sequence[Sequence[Group]], str], Table]
) -> Iterator[Table]:
    """Yield a table of each set whose completed histories have a variable.

    Args:
        needed: the variable, such as `section_use_max`, which histories of plane frames do not have.
        table: makes one of the histories by motion and the name of the set.
    """
    for found in sets:
        chosen = {name: group for name, group in found.completed.items() if needed in group.variables}
        if chosen:
            yield table(found.by_motion(chosen), label(found))


def first_of_level(sets: Sequence[HistorySet]) -> list[tuple[HistorySet, HistorySet]]:
    """Return each set with completed histories behind the first such set of its level, level by level."""
    found: list[tuple[HistorySet, HistorySet]] = []
    for level in dict.fromkeys(one.level for one in sets):
        there = [one for one in sets if one.level == level and one.completed]
        found += [(there[0], one) for one in there]
    return found


def motion_notes(sets: Sequence[HistorySet]) -> list[str]:
    """Return what statistics are taken of if motions have several histories, as those of buildings may."""
    counts = [len(set(found.motion_of.values())) for found in sets]
    if all(count == len(found.histories) for count, found in zip(counts, sets, strict=True)):
        return []
    number = " or ".join(map(str, dict.fromkeys(counts)))
    what = "motion" if number == "1" else "motions"
    return wrapped(f"Statistics: over {number} {what}; of each the worst of its angles and places of the masses.")


def missing_notes(sets: Sequence[HistorySet], labelled: bool = True) -> list[str]:
    """Return a line for each set with histories that failed or have not run: they are in no statistic.

    Args:
        labelled: whether the sets are named.
    """
    notes = []
    for found in sets:
        for names, what in ((found.failed, "failed"), (found.not_run, "not run")):
            if names:
                whose = f"{label(found)}: " if labelled else ""
                notes.append(
                    f"{whose}{what}, in no statistic ({len(names)} of {len(found.histories)}): {', '.join(names)}"
                )
    return notes


@dataclass(frozen=True)
class _Pair:
    """Statistics of the first variant and of another one over the records that both have."""

    base: Mapping[str, Statistics]
    own: Mapping[str, Statistics]
    note: str


def _pair(first: HistorySet, found: HistorySet) -> _Pair | None:
    """What a difference is taken of; None: the first itself, or no record in common."""
    if found is first:
        return None
    before, after = in_common(first, found)
    if not before:
        return None
    note = ""
    if len(before) < len(first.completed) or len(after) < len(found.completed):
        count = "1 record" if len(after) == 1 else f"{len(after)} records"
        note = f"diff. of {label(found)}: over the {count} that {label(first)} has too"
    return _Pair(measure_statistics(first, before), measure_statistics(found, after), note)


def _columns(
    sets: Sequence[HistorySet],
    over: Sequence[Mapping[str, Statistics]],
    pairs: Sequence[_Pair | None],
    of: Callable[[Statistics], float | None],
) -> Iterator[Column[Measure]]:
    """A statistic of each set, and beside it how far it is from that of the first one of its level."""
    for found, each, pair in zip(sets, over, pairs, strict=True):
        yield _column(label(found), each, of)
        if pair is not None:
            yield _difference(pair, of)


def _column(name: str, over: Mapping[str, Statistics], of: Callable[[Statistics], float | None]) -> Column[Measure]:
    return col(literal(name), ONE, lambda measure: measure.cell(of(over[measure.name])))


def _difference(pair: _Pair, of: Callable[[Statistics], float | None]) -> Column[Measure]:
    def value(measure: Measure) -> float | None:
        base, own = (of(side[measure.name]) for side in (pair.base, pair.own))
        return None if own is None or base is None or abs(base) < ROUNDING else own / base - 1.0

    return col(DIFFERENCE, PERCENT, value, form="+.1f", joined=True)
