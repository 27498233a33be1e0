"""A laboratory's sheet as tables and as data: properties of each test and cycle, and what is accepted."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from edesign.damper.testing.acceptance import GIVES_ENERGY, STANDARDS, Judged
from edesign.damper.testing.device_cycles import Run
from edesign.report.tables.table import Table, finite, number

VERDICTS = {True: "met", False: "not met", None: "not judged"}
_REFERENCES = {
    "mean": "from the mean",
    "third": "from cycle 3",
    "first": "from cycle 1",
    "design": "from the law",
    "least": "least / largest",
}
COLUMNS: dict[str, tuple[str, float]] = {
    "displacement_max_mm": ("x+ [mm]", 1e3),
    "displacement_min_mm": ("x- [mm]", 1e3),
    "force_max_kN": ("F+ [kN]", 1e-3),
    "force_min_kN": ("F- [kN]", 1e-3),
    "storage_stiffness_kN_per_mm": ("k' [kN/mm]", 1e-6),
    "loss_stiffness_kN_per_mm": ("k'' [kN/mm]", 1e-6),
    "equivalent_stiffness_kN_per_mm": ("k_eq [kN/mm]", 1e-6),
    "damping_kN_s_per_mm": ("c [kN s/mm]", 1e-6),
    "energy_kJ": ("W [kJ]", 1e-3),
    "damping_ratio_percent": ("xi [%]", 1e2),
    "storage_from_third_percent": ("dk' [%]", 1e2),
    "energy_from_third_percent": ("dW [%]", 1e2),
}
"""Of the sheet of cycles: header in CSV files, header of tables, and factor from SI."""

_DEVIATIONS = tuple(COLUMNS)[-2:]

NOTES = [
    "k', k'': storage and loss stiffness; k' is the effective stiffness too, by the forces at the extremes of x",
    "k_eq: by the extremes of the force; c = k''/omega; W: energy; xi = W / (2 pi k' x0^2)",
]


def name_of(run: Run, runs: Sequence[Run]) -> str:
    """Return the name of a test, with the number of the run where the test has several.

    Args:
        run: the run of a test.
        runs: the runs of the tests.
    """
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
    shown = list(COLUMNS)[4:10]
    heads = [COLUMNS[name][0] for name in shown]
    table = Table(
        "Tests: third cycle, and mean of all", ("test", "cycle", "T [degC]", "f [Hz]", "x0 [mm]", *heads), name="tests"
    )
    for run in runs:
        values = _values_of(run)
        for label, pick in (("3", lambda v: v[2]), (f"1-{run.cycles}", np.mean)):
            row = [_number(float(pick(values[name])), COLUMNS[name][1]) for name in shown]
            about = (run.temperature_C, run.frequency, 1e3 * run.loops.amplitude)
            table.rows.append([name_of(run, runs), label, *(_number(float(pick(one))) for one in about), *row])
    table.left = 2
    table.notes += NOTES
    return table


def cycles_table(run: Run, runs: Sequence[Run]) -> Table:
    """Return the sheet of a run: all properties of each cycle.

    Args:
        run: the run of a test.
        runs: the runs of the tests.
    """
    values = _values_of(run)
    shown = [name for name in COLUMNS if name != "equivalent_stiffness_kN_per_mm"]
    heads = [COLUMNS[name][0] for name in shown]
    title = name_of(run, runs) + (f": {run.title}" if run.title and run.title != run.test else "")
    table = Table(f"{title}, {np.mean(run.frequency):.3g} Hz", ("cycle", "T [degC]", *heads), left=0)
    for i in range(run.cycles):
        cells = [
            f"{COLUMNS[name][1] * values[name][i]:.2f}"
            if name in _DEVIATIONS
            else _number(float(values[name][i]), COLUMNS[name][1])
            for name in shown
        ]
        table.rows.append([str(i + 1), _number(float(run.temperature_C[i])), *cells])
    table.notes.append("dk', dW: deviation from the third cycle")
    return table


def acceptance_table(judged: Sequence[Judged], runs: Sequence[Run]) -> Table:
    """Return the verdict of each criterion over all runs: the worst of them with its test and cycle.

    Args:
        judged: the judged runs.
        runs: the runs of the tests.
    """
    table = Table(
        "Acceptance",
        ("no.", "standard", "clause", "quantity", "compared", "limit [%]", "worst [%]", "test", "cycle", "verdict"),
        left=5,
        sentences=(3, 7),
        formulas=(5,),
        name="acceptance",
    )
    for i, group in enumerate(_by_criterion(judged)):
        worst, criterion = worst_of(group), group[0].criterion
        limit = 100.0 * criterion.limit
        sign = ">= " if criterion.reference == "least" else ">= -" if criterion.fall_only else "+-"
        table.rows.append(
            [
                str(i + 1),
                STANDARDS[criterion.standard],
                criterion.clause,
                criterion.quantity.name,
                _REFERENCES[criterion.reference],
                f"{sign}{limit:g}",
                "-" if worst.met is None else f"{100.0 * worst.value:+.1f}".lstrip("+" if not _signed(worst) else ""),
                "-" if worst.met is None else name_of(worst.run, runs),
                "-" if worst.cycle is None else str(worst.cycle),
                VERDICTS[worst.met],
            ]
        )
    for why in dict.fromkeys(one.why for one in judged if one.why):
        alike = [one for one in judged if one.why == why]
        by_run = why == GIVES_ENERGY  # no criterion judges such a run
        named = dict.fromkeys(name_of(one.run, runs) if by_run else one.criterion.quantity.name for one in alike)
        table.notes.append(f"not judged: {', '.join(named)}: {why}")
    return table


def _signed(judged: Judged) -> bool:
    return judged.criterion.reference != "least"


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
        judged: the judged runs.
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
    told = "; ".join(
        f"{one.criterion.quantity.name} in {name_of(one.run, runs)}, cycle {one.cycle}: {100.0 * one.value:+.1f} % "
        f"{_REFERENCES[one.criterion.reference]}, {100.0 * one.criterion.limit:g} % allowed "
        f"({STANDARDS[one.criterion.standard]}, {one.criterion.clause})"
        for one in failed
    )
    return f"Not met: {len(failed)} of {count} criteria fail: {told}.{left}"


def csv_rows(runs: Sequence[Run]) -> tuple[list[str], Iterator[list[Any]]]:
    """Return headers and rows of the sheet as CSV, one row for each cycle of each run."""

    def rows() -> Iterator[list[Any]]:
        for run in runs:
            values = _values_of(run)
            for i in range(run.cycles):
                cells = [finite(factor * float(values[name][i])) for name, (_, factor) in COLUMNS.items()]
                about = [run.test, run.block, i + 1, float(run.loops.start[i]), float(run.frequency[i])]
                yield [*about, float(run.temperature_C[i]), *cells]

    return ["test", "run", "cycle", "start_s", "frequency_Hz", "temperature_C", *COLUMNS], rows()


def sheet_json(runs: Sequence[Run], judged: Sequence[Judged], notes: Sequence[str]) -> dict[str, Any]:
    """Return the sheet as JSON data in SI units; numbers that are not finite are null.

    Args:
        runs: the runs of the tests.
        judged: the judged runs.
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


def _number(value: float, scale: float = 1.0) -> str:
    return number(scale * value, 4) if math.isfinite(value) else "-"
