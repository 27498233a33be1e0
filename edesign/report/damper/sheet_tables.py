"""A laboratory's sheet as tables and as data: properties of each test and cycle, and what is accepted."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from edesign.damper.testing.acceptance import GIVES_ENERGY, STANDARDS, Judged
from edesign.damper.testing.device_cycles import Run
from edesign.report.tables.cell import Quantity, Value, Verdict
from edesign.report.tables.column import Column, col, count, text, verdict
from edesign.report.tables.number import finite
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import DEGC, HZ, KJ, KN, KN_MM, MM, PERCENT, Unit

VERDICTS: dict[bool | None, Value] = {
    True: Verdict("met", "good"),
    False: Verdict("not met", "bad"),
    None: "not judged",
}
_REFERENCES = {
    "mean": "from the mean",
    "third": "from cycle 3",
    "first": "from cycle 1",
    "design": "from the law",
    "least": "least / largest",
}
COLUMNS: dict[str, Column[Row]] = {
    "displacement_max_mm": col("x+", MM),
    "displacement_min_mm": col("x-", MM),
    "force_max_kN": col("F+", KN),
    "force_min_kN": col("F-", KN),
    "storage_stiffness_kN_per_mm": col("k'", KN_MM),
    "loss_stiffness_kN_per_mm": col("k''", KN_MM),
    "equivalent_stiffness_kN_per_mm": col("k_eq", KN_MM),
    "damping_kN_s_per_mm": col("c", Unit("kN s/mm", 1e6)),
    "energy_kJ": col("W", KJ),
    "damping_ratio_percent": col("xi", PERCENT),
    "storage_from_third_percent": col("dk'", PERCENT, form=".2f"),
    "energy_from_third_percent": col("dW", PERCENT, form=".2f"),
}
"""Of the sheet of cycles, by the headers in CSV files."""

_OF_TESTS = tuple(COLUMNS)[4:10]
_OF_CYCLES = tuple(name for name in COLUMNS if name != "equivalent_stiffness_kN_per_mm")
_DEVIATIONS = tuple(COLUMNS)[-2:]

NOTES = [
    "k', k'': storage and loss stiffness; k' is the effective stiffness too, by the forces at the extremes of x",
    "k_eq: by the extremes of the force; c = k''/omega; W: energy; xi = W / (2 pi k' x0^2)",
]


class _Worst(NamedTuple):
    """The worst run by a criterion, with the number of the criterion and the name of the run."""

    number: int
    judged: Judged
    run: str


def _limit(worst: _Worst) -> str:
    criterion = worst.judged.criterion
    sign = ">= " if criterion.reference == "least" else ">= -" if criterion.fall_only else "+-"
    return f"{sign}{criterion.limit / PERCENT.si:g}"


def _deviation(worst: _Worst) -> Value:
    """The deviation with its sign, or the share of the largest, which has none."""
    if worst.judged.met is None:
        return None
    share = worst.judged.criterion.reference == "least"
    return Quantity(worst.judged.value, PERCENT, form=".1f" if share else "+.1f", beside=True)


TESTS = TableSpec[Row](
    "tests",
    "Tests: third cycle, and mean of all",
    (text("test"), text("cycle"), col("T", DEGC), col("f", HZ), col("x0", MM), *(COLUMNS[name] for name in _OF_TESTS)),
    notes=NOTES,
    keys=2,
)
CYCLES = TableSpec[Row](
    "cycles_of_run",
    "{title}, {frequency:.3g} Hz",
    (count("cycle"), col("T", DEGC), *(COLUMNS[name] for name in _OF_CYCLES)),
    notes=("dk', dW: deviation from the third cycle",),
    keys=0,
    named_by_title=True,
)
ACCEPTANCE = TableSpec[_Worst](
    "acceptance",
    "Acceptance",
    (
        count("no.", "number"),
        text("standard", lambda worst: STANDARDS[worst.judged.criterion.standard]),
        text("clause", "judged.criterion.clause"),
        text("quantity", "judged.criterion.quantity.name", broken=1),
        text("compared", lambda worst: _REFERENCES[worst.judged.criterion.reference]),
        replace(col("limit", PERCENT, _limit), symbols=True),
        col("worst", PERCENT, _deviation),
        text("test", lambda worst: None if worst.judged.met is None else worst.run, broken=2),
        count("cycle", "judged.cycle"),
        verdict("verdict", lambda worst: VERDICTS[worst.judged.met]),
    ),
    keys=5,
)


def name_of(run: Run, runs: Sequence[Run]) -> str:
    """Return the name of a test, with the number of the run where the test has several."""
    several = sum(other.test == run.test for other in runs) > 1
    return f"{run.test}, run {run.block}" if several else run.test


def _values_of(run: Run) -> dict[str, np.ndarray]:
    """Return the columns of `COLUMNS` of each cycle of a run, (n,) in SI."""
    loops = run.loops
    values = (
        *(loops.highest, loops.lowest, loops.largest, loops.smallest),
        *(run.storage_stiffness, run.loss_stiffness, run.equivalent_stiffness, run.damping),
        *(loops.work, run.damping_ratio),
        *(run.from_third(run.storage_stiffness), run.from_third(loops.work)),
    )
    return dict(zip(COLUMNS, values, strict=True))


def tests_table(runs: Sequence[Run]) -> Table:
    """Return the properties of each run in its third cycle, by which devices are accepted, and their mean."""
    rows: list[Row] = []
    for run in runs:
        values = _values_of(run)
        shown = (run.temperature_C, run.frequency, run.loops.amplitude, *(values[name] for name in _OF_TESTS))
        rows.append((name_of(run, runs), "3", *(finite(float(one[2])) for one in shown)))
        rows.append((name_of(run, runs), f"1-{run.cycles}", *(finite(float(np.mean(one))) for one in shown)))
    return TESTS.of(rows)


def cycles_table(run: Run, runs: Sequence[Run]) -> Table:
    """Return the sheet of a run: all properties of each cycle.

    Args:
        run: the run of a test.
        runs: the runs of the tests.
    """
    values = _values_of(run)
    title = name_of(run, runs) + (f": {run.title}" if run.title and run.title != run.test else "")
    rows: list[Row] = []
    for i in range(run.cycles):
        cells = (float(values[name][i]) for name in _OF_CYCLES[:-2])
        deviations = (float(values[name][i]) for name in _DEVIATIONS)
        rows.append((i + 1, finite(float(run.temperature_C[i])), *map(finite, cells), *deviations))
    return CYCLES.of(rows, title=title, frequency=np.mean(run.frequency))


def acceptance_table(judged: Sequence[Judged], runs: Sequence[Run]) -> Table:
    """Return the verdict of each criterion over all runs: the worst of them with its test and cycle."""
    worst = [worst_of(group) for group in _by_criterion(judged)]
    notes = []
    for why in dict.fromkeys(one.why for one in judged if one.why):
        alike = [one for one in judged if one.why == why]
        by_run = why == GIVES_ENERGY  # no criterion judges such a run
        named = dict.fromkeys(name_of(one.run, runs) if by_run else one.criterion.quantity.name for one in alike)
        notes.append(f"not judged: {', '.join(named)}: {why}")
    return ACCEPTANCE.of((_Worst(i + 1, one, name_of(one.run, runs)) for i, one in enumerate(worst)), notes=notes)


def _by_criterion(judged: Sequence[Judged]) -> list[list[Judged]]:
    """Group judged runs by their criterion, in the order of the criteria."""
    groups: dict[int, list[Judged]] = {}
    order: list[Any] = []
    for one in judged:
        if one.criterion not in order:
            order.append(one.criterion)
        groups.setdefault(order.index(one.criterion), []).append(one)
    return list(groups.values())


def worst_of(group: Sequence[Judged]) -> Judged:
    """Return the run that is farthest from its reference; one that was judged before those that were not."""
    known = [one for one in group if one.met is not None]
    if not known:
        return group[0]
    share = known[0].criterion.reference == "least" or known[0].criterion.fall_only
    return min(known, key=lambda one: one.value) if share else max(known, key=lambda one: abs(one.value))


def verdict_text(judged: Sequence[Judged], runs: Sequence[Run]) -> str:
    """Return the verdict in a sentence or two.

    Args:
        runs: the runs of the tests.
    """
    groups = _by_criterion(judged)
    failed = [worst_of(group) for group in groups if any(one.met is False for one in group)]
    open_ones = sum(all(one.met is None for one in group) for group in groups)
    left = f" {open_ones} could not be judged." if open_ones else ""
    count = len(groups) - open_ones
    if count == 0:
        return "Not judged: no criterion could be applied."
    reversed_ones = dict.fromkeys(name_of(one.run, runs) for one in judged if one.why == GIVES_ENERGY)
    if reversed_ones:
        left += f" Runs that could not be judged: {', '.join(reversed_ones)}."
    if not failed and reversed_ones:
        some = len(runs) - len(reversed_ones)
        return f"Not judged in full: all {count} criteria are met in {some} of {len(runs)} runs.{left}"
    if not failed:
        where = "the run" if len(runs) == 1 else f"all {len(runs)} runs"
        return f"Met: all {count} criteria are met in {where}.{left}"
    missed = "; ".join(
        f"{one.criterion.quantity.name} in {name_of(one.run, runs)}, cycle {one.cycle}: {100.0 * one.value:+.1f} % "
        f"{_REFERENCES[one.criterion.reference]}, {100.0 * one.criterion.limit:g} % allowed "
        f"({STANDARDS[one.criterion.standard]}, {one.criterion.clause})"
        for one in failed
    )
    return f"Not met: {len(failed)} of {count} criteria fail: {missed}.{left}"


def csv_rows(runs: Sequence[Run]) -> tuple[list[str], Iterator[list[Any]]]:
    """Return headers and rows of the sheet as CSV, one row for each cycle of each run."""

    def rows() -> Iterator[list[Any]]:
        for run in runs:
            values = _values_of(run)
            for i in range(run.cycles):
                cells = [finite(column.data(float(values[name][i]))) for name, column in COLUMNS.items()]
                about = [run.test, run.block, i + 1, float(run.loops.start[i]), float(run.frequency[i])]
                yield [*about, float(run.temperature_C[i]), *cells]

    return ["test", "run", "cycle", "start_s", "frequency_Hz", "temperature_C", *COLUMNS], rows()


def sheet_json(runs: Sequence[Run], judged: Sequence[Judged], notes: Sequence[str]) -> dict[str, Any]:
    """Return the sheet as JSON data in SI units; numbers that are not finite are null.

    Args:
        runs: the runs of the tests.
        notes: what the reader of the files said.
    """
    return {
        "units": {"displacement": "m", "force": "N", "stiffness": "N/m", "damping": "N*s/m", "energy": "J"},
        "runs": [
            {
                "test": run.test,
                "run": run.block,
                "frequency": run.frequency.tolist(),
                "temperature_C": run.temperature_C.tolist(),
                **{name: finite(values.tolist()) for name, values in _plain(run).items()},
            }
            for run in runs
        ],
        "acceptance": [
            {
                "test": one.run.test,
                "run": one.run.block,
                "standard": STANDARDS[one.criterion.standard],
                "clause": one.criterion.clause,
                "quantity": one.criterion.quantity.name,
                "compared": one.criterion.reference,
                "limit": one.criterion.limit,
                "cycle": one.cycle,
                "value": finite(one.value),
                "met": one.met,
                **({"why": one.why} if one.why else {}),
            }
            for one in judged
        ],
        "notes": list(notes),
    }


def _plain(run: Run) -> dict[str, np.ndarray]:
    loops = run.loops
    return {
        "displacement_max": loops.highest,
        "displacement_min": loops.lowest,
        "force_max": loops.largest,
        "force_min": loops.smallest,
        "force_at_zero_rising": loops.at_zero_rising,
        "force_at_zero_falling": loops.at_zero_falling,
        "storage_stiffness": run.storage_stiffness,
        "loss_stiffness": run.loss_stiffness,
        "equivalent_stiffness": run.equivalent_stiffness,
        "damping": run.damping,
        "energy": loops.work,
        "damping_ratio": run.damping_ratio,
    }
