"""Limits that virtual substructure tests met, and indicators that are not determined, as tables."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.report.drawing.captions import plain
from edesign.report.substructure.results import SubstructureResults
from edesign.report.substructure.tables import LIMIT_COLUMNS, LIMITED_THERE, limits_met, outcome_of
from edesign.report.tables.cell import Rounded
from edesign.report.tables.column import text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.substructure.advice.recommendation import ADAPTIVE

NONE_MET = "No limit of the rig or of coefficients was met, as far as that was kept."
COEFFICIENTS = ("alpha_0", "alpha_1", "alpha_2")
"""By the bits of `limited`."""


LIMITS = TableSpec[Row](
    "limits_met",
    "Limits that were met",
    LIMIT_COLUMNS,
    notes=("Of coefficients: least or largest value, or largest rate.", *wrapped(LIMITED_THERE)),
    keys=3,
)
UNDETERMINED = TableSpec[Row](
    "indicators_missing",
    "Indicators that are not determined",
    (text("test"), text("compensator"), text("indicator"), text("why", broken=1)),
    keys=4,
)
RUNS_SO_FAR = TableSpec[Row](
    "runs_so_far",
    "Runs so far",
    (text("test"), text("compensator"), text("outcome"), text("why", broken=1)),
    keys=4,
)


def limits_table(results: SubstructureResults) -> Table:
    """Return the limits of rig and compensators that each run met; no rows if none was met."""
    runs = [(test, name) for test in results.tests for name in results.compensators(test)]
    met = [limit for run in runs for limit in (*_rig(results, *run), *_series(results, *run))]
    notes = [] if met else [NONE_MET]
    if unknown := sorted({name for test in results.tests for name in _unknown(results, test)}):
        notes += wrapped(f"Not known of {', '.join(unknown)}: coefficients were not kept over time.")
    return LIMITS.of(met, notes=notes)


def _unknown(results: SubstructureResults, test: str) -> list[str]:
    """The adaptive compensators of a test of which nothing shows whether they met a limit."""
    adaptive = [name for name in results.compensators(test) if results.kind(name) in ADAPTIVE]
    found = {name: results.histories(test, name) for name in adaptive}
    return [name for name, group in found.items() if group is not None and "limited" not in group.variables]


def _rig(results: SubstructureResults, test: str, name: str) -> list[Row]:
    run = results.run(test, name)
    return limits_met(run) if run is not None else []


def _series(results: SubstructureResults, test: str, name: str) -> Iterator[Row]:
    series = results.series(test, name)
    limited = series.of("limited") if series is not None else None
    if series is None or limited is None or not limited.size:
        return
    time, bits = series.time, limited.astype(int)
    for i, what in enumerate(COEFFICIENTS):
        met = np.flatnonzero((bits >> i) & 1)
        if met.size:
            times = (time[met[0]], time[met[-1]], met.size * (time[-1] - time[0]) / (time.size - 1))
            yield (test, name, what, *(Rounded(plain(value), value) for value in times))


def undetermined_table(results: SubstructureResults) -> Table:
    """Return the indicators that could not be computed for a run, with the reason; no rows if all could."""
    stored = results.runs[0].group.attributes if results.runs else {}
    said = stored.get("undetermined", stored.get("untold"))  # as archives before 0.1.0 call it
    rows: list[Row] = []
    for line in said if isinstance(said, list) else []:
        place, _, rest = str(line).partition(": ")
        test, _, compensator = place.partition("/")
        indicator, _, why = rest.partition(": ")
        rows.append((test, compensator, indicator, why))
    return UNDETERMINED.of(rows)


def runs_so_far_table(results: SubstructureResults) -> Table:
    """Return the outcome of runs whose indicators are not archived, as in an interrupted archive."""
    rows: list[Row] = []
    for test in results.tests:
        for name in results.compensators(test):
            group = results.histories(test, name)
            if results.run(test, name) is None and group is not None:
                outcome, why = (str(group.attributes.get(key) or "-") for key in ("outcome", "reason"))
                rows.append((test, name, outcome_of(outcome), why))
    return RUNS_SO_FAR.of(rows)
