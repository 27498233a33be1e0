"""Tables of response measures: record by record, and their statistics for each variant and hazard level."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

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
    levels = list(dict.fromkeys(found.level for found in sets))
    ordered = [found for level in levels for found in sets if found.level == level and found.completed]
    over = [measure_statistics(found) for found in ordered]
    pairs = [_pair(ordered[_first(ordered, at)], found) for at, found in enumerate(ordered)]
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
        table.notes += [pair.note for pair in pairs if pair is not None and pair.note]
        table.notes += missing_notes(sets)
        tables.append(table)
    return tables


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
    records, others = _records(found), _records(first)
    common = set(records.values()) & set(others.values())
    if not common:
        return None
    note = ""
    if set(records.values()) != common or set(others.values()) != common:
        count = "1 record" if len(common) == 1 else f"{len(common)} records"
        note = f"diff. of {label(found)}: over the {count} that {label(first)} has too"
    base = measure_statistics(first, {name for name, record in others.items() if record in common})
    return _Pair(base, measure_statistics(found, {name for name, record in records.items() if record in common}), note)


def _records(found: HistorySet) -> dict[str, str]:
    """The record of each completed history."""
    return {name: str(group.attributes.get("record") or name) for name, group in found.completed.items()}


def _headers(ordered: Sequence[HistorySet], pairs: Sequence[_Pair | None]) -> list[str]:
    headers = []
    for found, pair in zip(ordered, pairs, strict=True):
        headers += [label(found)] if pair is None else [label(found), DIFFERENCE]
    return headers


def _difference(base: float | None, value: float | None) -> str:
    if value is None or base is None or abs(base) < ROUNDING:
        return "-"
    return formatted(100.0 * (value / base - 1.0), "+.1f")


def _first(ordered: Sequence[HistorySet], at: int) -> int:
    """Position of the first variant at the level of a set."""
    return next(i for i, found in enumerate(ordered) if found.level == ordered[at].level)
