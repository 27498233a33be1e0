"""Tables of response measures: record by record, and their statistics for each variant and hazard level."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from edesign.assess.changes import in_common
from edesign.assess.sets import HistorySet, measure_statistics
from edesign.assess.statistics import STATISTICS, Statistics
from edesign.report.assessment.measure_columns import MEASURE_COLUMNS, MEASURE_ROWS, ROUNDING
from edesign.report.tables.table import Table, formatted, number

STATISTIC_TITLES = {"mean": "Mean", "maximum": "Maximum", "median": "Median", "84%": "84 % percentile (counted)"}
STATISTIC_NAMES = {
    "mean": "mean_response",
    "maximum": "maximum_response",
    "median": "median_response",
    "84%": "percentile_84_response",
}
MAIN = (
    "roof_displacement_m",
    "interstorey_drift",
    "residual_interstorey_drift",
    "base_shear_N",
    "column_base_shear_N",
    "roof_acceleration_m_s2",
    "beam_plastic_rotation_rad",
    "column_plastic_rotation_rad",
    "brace_ductility",
    "damper_strain",
    "damper_deformation_m",
    "damper_force_N",
)
"""Measures of which the means are told where there is room for few."""
DIFFERENCE = "diff. [%]"
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
    shown = [c for c in MEASURE_COLUMNS if any(item[c[1]] is not None for item in measures.values())]
    table = Table(f"{label(found)}: response measures (largest absolute values)", ("record", *(c[0] for c in shown)))
    table.each = ("Response measures of each record (largest absolute values)", label(found))
    table.name = "record_response"
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

    Where no set has more than one history, all statistics are its values, and stand in one table.

    At each level the difference of every further variant from the first one follows it, in per cent: over the records
    that both have completed; left out where there is none.

    Source: form of thesis Tables 5.8 (mean) and 5.9 (maximum).
    """
    of_levels = first_of_level(sets)
    ordered = [found for _, found in of_levels]
    over = [measure_statistics(found) for found in ordered]
    pairs = [_pair(first, found) for first, found in of_levels]
    shown = [row for row in MEASURE_ROWS if any(each[row[1]].count for each in over)]
    tables = []
    single = all(len(found.completed) == 1 for found in ordered)
    titles = (
        {"maximum": "Response"} if single else {key: f"{title} response" for key, title in STATISTIC_TITLES.items()}
    )
    for statistic, title in titles.items() if ordered else ():
        of = STATISTICS[statistic]
        headers = ("measure", *_headers(ordered, pairs))
        joined = tuple(i for i, header in enumerate(headers) if header == DIFFERENCE)
        table = Table(title, headers, joined=joined, name="response" if single else STATISTIC_NAMES[statistic])
        for name, measure, unit in shown:
            cells = []
            for each, pair in zip(over, pairs, strict=True):
                cells.append(number(of(each[measure]), scale=unit, negligible=ROUNDING))
                if pair is not None:
                    cells.append(_difference(of(pair.base[measure]), of(pair.own[measure])))
            table.rows.append([name, *cells])
        counts = "; ".join(f"{label(found)}: {len(found.completed)} of {len(found.histories)}" for found in ordered)
        table.notes.append(f"Histories: {counts}")
        table.notes += [LARGEST] if any(pairs) else []
        table.notes += [pair.note for pair in pairs if pair is not None and pair.note]
        table.notes += missing_notes(sets)
        tables.append(table)
    return tables


def first_of_level(sets: Sequence[HistorySet]) -> list[tuple[HistorySet, HistorySet]]:
    """Return each set with completed histories behind the first such set of its level, level by level.

    Args:
        sets: the histories by variant and level.
    """
    found: list[tuple[HistorySet, HistorySet]] = []
    for level in dict.fromkeys(one.level for one in sets):
        there = [one for one in sets if one.level == level and one.completed]
        found += [(there[0], one) for one in there]
    return found


def missing_notes(sets: Sequence[HistorySet], labelled: bool = True) -> list[str]:
    """Return a line for each set with histories that failed or have not run: they are in no statistic.

    Args:
        sets: the histories by variant and level.
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


def _headers(ordered: Sequence[HistorySet], pairs: Sequence[_Pair | None]) -> list[str]:
    headers = []
    for found, pair in zip(ordered, pairs, strict=True):
        headers += [label(found)] if pair is None else [label(found), DIFFERENCE]
    return headers


def _difference(base: float | None, value: float | None) -> str:
    if value is None or base is None or abs(base) < ROUNDING:
        return "-"
    return formatted(100.0 * (value / base - 1.0), "+.1f")
