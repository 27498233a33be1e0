"""What the parts of a reference file have to say about each other."""

from __future__ import annotations

from collections.abc import Sequence

from pydantic_core import PydanticCustomError

from edesign.project.criteria.measures import MEASURES, SHORT_NAMES
from edesign.project.notation.printed_unit import unit_factor
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.study.reference import Cell, Reference, ResponseRow, ResponseTable, VariableTable

PROFILES = {
    "interstorey_drift": "storey_drift",
    "residual_interstorey_drift": "residual_storey_drift",
    "final_interstorey_drift": "final_storey_drift",
    "roof_acceleration": "floor_acceleration",
}
"""Measures that have a profile over the height, and its name (edesign.assess.profile)."""


def check_reference(reference: Reference, problems: Problems) -> None:
    """Check a reference file beyond its schema.

    Args:
        reference: the reference file, which has no schema problems.
    """
    _check_unique(problems, ("tables",), [table.title for table in reference.tables], "title")
    for i, table in enumerate(reference.tables):
        _check_unique(problems, ("tables", i, "rows"), [row.label for row in table.rows], "label")
        if isinstance(table, ResponseTable):
            _check_responses(table, i, problems)
        else:
            _check_variables(table, i, problems)


def _check_unique(problems: Problems, keys: Keys, names: Sequence[str], key: str) -> None:
    first: dict[str, int] = {}
    for i, name in enumerate(names):
        other = first.setdefault(name, i)
        if other != i:
            line = problems.node((*keys, other, key)).mark.line
            problems.at_value((*keys, i, key), f"there is already the {key} `{name}` in line {line} [E-NAME-02]")


def _check_responses(table: ResponseTable, i: int, problems: Problems) -> None:
    """Units, statistics, bars and changes of a table fit together."""
    names = {(variant, level) for row in table.rows for variant, level, _ in row.cells()}
    variants = list(dict.fromkeys(variant for row in table.rows for variant in row.values))
    _check_bar_names(problems, ("tables", i), table.within, names)
    if table.change is not None:
        for key, variant in (("of", table.change.of), ("against", table.change.against)):
            if variant not in variants:
                problems.at_value(("tables", i, "change", key), unknown_name("variant", variant, variants))
    for j, row in enumerate(table.rows):
        keys: Keys = ("tables", i, "rows", j)
        try:
            unit_factor(row.unit, MEASURES[SHORT_NAMES[row.measure]].kind.unit)
        except PydanticCustomError as error:
            problems.at_value((*keys, "unit"), error.message())
        _check_statistic(table, row, keys, problems)
        _check_bar_names(problems, keys, row.within, {(variant, level) for variant, level, _ in row.cells()})
        for variant, level, cell in row.cells():
            _check_bar(problems, (*keys, "values", variant, level), cell, table.bar(row, variant, level, cell))
        _check_change(table, row, keys, problems)


def _check_statistic(table: ResponseTable, row: ResponseRow, keys: Keys, problems: Problems) -> None:
    if (row.statistic or table.statistic) != "mean_profile":
        return
    at = (*keys, "statistic" if row.statistic else "measure")
    if row.measure not in PROFILES:
        message = (
            f"`{row.measure}` has no profile over the height; `mean_profile` needs one of {listed(PROFILES)}"
            " [E-CRIT-04]"
        )
        problems.at_value(at, message)
    for key in ("storeys", "members"):
        if getattr(row, key) is not None:
            problems.at_key((*keys, key), "`mean_profile` is taken over the whole height [E-CRIT-04]")


def _check_change(table: ResponseTable, row: ResponseRow, keys: Keys, problems: Problems) -> None:
    if row.change and table.change is None:
        problems.at_key(
            (*keys, "change"), "the table does not say of what; it needs `change: {of: ..., against: ...}` [E-KEY-02]"
        )
    for variant in (table.change.against, table.change.of) if table.change is not None else ():
        for level in row.change:
            if level not in row.values.get(variant, {}):
                problems.at_key(
                    (*keys, "change", level), f"there is no value of `{variant}` at `{level}` in this row [E-NAME-01]"
                )


def _check_bar(problems: Problems, keys: Keys, cell: Cell, bar: float | None) -> None:
    if cell.value == 0.0 and bar is not None:
        problems.at_value(keys, "a difference from 0 is no percentage; this value can have no bar `within` [E-CRIT-04]")


def _check_bar_names(problems: Problems, keys: Keys, bar: object, names: set[tuple[str, str]]) -> None:
    """The variants and levels of a bar have values."""
    if not isinstance(bar, dict):
        return
    variants = sorted({variant for variant, _ in names})
    for variant, levels in bar.items():
        if variant not in variants:
            problems.at_key((*keys, "within", variant), unknown_name("variant", variant, variants))
            continue
        known = sorted(level for name, level in names if name == variant)
        for level in levels if isinstance(levels, dict) else ():
            if level not in known:
                problems.at_key((*keys, "within", variant, level), unknown_name("level", level, known))


def _check_variables(table: VariableTable, i: int, problems: Problems) -> None:
    """All rows of a table are of one length, that of its labels; bars have something to be relative to."""
    length = len(table.rows[0].values) if table.labels is None else len(table.labels)
    of = "values of the first row" if table.labels is None else "labels"
    for j, row in enumerate(table.rows):
        keys: Keys = ("tables", i, "rows", j)
        if len(row.values) != length:
            problems.at_value((*keys, "values"), f"{len(row.values)} values for {length} {of} [E-VALUE-04]")
        for k, cell in enumerate(row.cells()):
            if cell is not None:
                _check_bar(problems, (*keys, "values", k), cell, table.bar(row, cell))
