"""Limits that virtual substructure tests met, and indicators that are not determined, as tables."""

from __future__ import annotations

import numpy as np

from edesign.report.drawing.captions import plain
from edesign.report.substructure.results import SubstructureResults
from edesign.report.substructure.tables import HELD_THERE, limit_cells
from edesign.report.tables.table import NumberText, Table
from edesign.report.tables.text import wrapped
from edesign.substructure.advice.recommendation import ADAPTIVE

NONE_MET = "No limit of the rig or of coefficients was met, as far as that was kept."
COEFFICIENTS = ("alpha_0", "alpha_1", "alpha_2")
"""By the bits of `limited`."""


def limits_table(results: SubstructureResults) -> Table:
    """Return the limits of rig and compensators that each run met; no rows if none was met."""
    table = Table(
        "Limits that were met",
        ("test", "compensator", "limit", "first [s]", "last [s]", "in all [s]"),
        left=3,
        name="limits_met",
    )
    for test in results.tests:
        for name in results.compensators(test):
            table.rows += [[test, name, *cells] for cells in _rig(results, test, name) + _series(results, test, name)]
    if table.rows:
        table.notes.append("Of coefficients: least or largest value, or largest rate.")
        table.notes += wrapped(HELD_THERE)
    else:
        table.notes.append(NONE_MET)
    if unknown := sorted({name for test in results.tests for name in _unknown(results, test)}):
        table.notes += wrapped(f"Not known of {', '.join(unknown)}: coefficients were not kept over time.")
    return table


def _unknown(results: SubstructureResults, test: str) -> list[str]:
    """The adaptive compensators of a test of which nothing tells whether they met a limit."""
    adaptive = [name for name in results.compensators(test) if results.kind(name) in ADAPTIVE]
    found = {name: results.histories(test, name) for name in adaptive}
    return [name for name, group in found.items() if group is not None and "limited" not in group.variables]


def _rig(results: SubstructureResults, test: str, name: str) -> list[list[str]]:
    run = results.run(test, name)
    return [[f"rig: {what}", *times] for what, *times in limit_cells(run)] if run is not None else []


def _series(results: SubstructureResults, test: str, name: str) -> list[list[str]]:
    series = results.series(test, name)
    limited = series.of("limited") if series is not None else None
    if limited is None or not limited.size:
        return []
    assert series is not None
    time, bits = series.time, limited.astype(int)
    rows = []
    for i, what in enumerate(COEFFICIENTS):
        met = np.flatnonzero((bits >> i) & 1)
        if met.size:
            times = (time[met[0]], time[met[-1]], met.size * (time[-1] - time[0]) / (time.size - 1))
            rows.append([what, *(NumberText(plain(value), float(value)) for value in times)])
    return rows


def undetermined_table(results: SubstructureResults) -> Table:
    """Return the indicators that could not be computed for a run, with the reason; no rows if all could."""
    table = Table(
        "Indicators that are not determined",
        ("test", "compensator", "indicator", "why"),
        left=4,
        sentences=3,
        name="indicators_missing",
    )
    stored = results.runs[0].group.attributes if results.runs else {}
    said = stored.get("undetermined", stored.get("untold"))  # as archives before 0.1.0 call it
    for line in said if isinstance(said, list) else []:
        place, _, rest = str(line).partition(": ")
        test, _, compensator = place.partition("/")
        indicator, _, why = rest.partition(": ")
        table.rows.append([test, compensator, indicator, why])
    return table


def runs_so_far_table(results: SubstructureResults) -> Table:
    """Return the outcome of runs whose indicators are not archived, as in an interrupted archive."""
    table = Table("Runs so far", ("test", "compensator", "outcome", "why"), left=4, sentences=3, name="runs_so_far")
    for test in results.tests:
        for name in results.compensators(test):
            group = results.histories(test, name)
            if results.run(test, name) is None and group is not None:
                said = [str(group.attributes.get(key) or "-") for key in ("outcome", "reason")]
                table.rows.append([test, name, *said])
    return table
