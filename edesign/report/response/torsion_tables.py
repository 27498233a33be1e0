"""How buildings twist: drifts of column lines against each other, and turns of floors."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.assess.sets import HistorySet
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import tables_of_sets
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import MRAD, ONE, PERCENT


class _Twist(NamedTuple):
    """A storey in one direction: means over the motions of a set.

    Attributes:
        least, largest: drift ratios of the column lines that drift least and most, each by its own peak.
        line: the one that drifts most.
        ratio: the largest over the mean of all lines.
        turn: of the floor above about the vertical, rad; None: it is not rigid.
    """

    storey: int
    direction: str
    least: float
    largest: float
    line: str
    ratio: float
    turn: float | None


TORSION = TableSpec[_Twist](
    "torsion",
    "{whose}: torsion",
    (
        count("storey"),
        text("direction"),
        col("least drift", PERCENT, "least", negligible=ROUNDING),
        col("largest drift", PERCENT, "largest", negligible=ROUNDING),
        text("at", "line"),
        col("largest / mean", ONE, "ratio", form=".2f"),
        col("turn", MRAD, "turn", negligible=ROUNDING, optional=True),
    ),
    notes=(
        "Mean over the motions, of each the worst of its angles and places of the masses; of column lines, each by its "
        "own peak; largest / mean: over the mean of all lines; turn: of the floor above about the vertical.",
    ),
)


def torsion_tables(sets: Iterable[HistorySet]) -> Iterator[Table]:
    """Return a table of each set of histories of a building; plane frames have none."""
    return tables_of_sets(sets, "line_drift_max", lambda motions, whose: TORSION.of(_twists(motions), whose=whose))


def _mean_peak(motions: Sequence[Sequence[Group]], quantity: str) -> np.ndarray | None:
    each = [[values for group in groups if (values := peak(group, quantity)) is not None] for groups in motions]
    found = [np.max(values, axis=0) for values in each if values]
    return np.mean(found, axis=0) if found else None


def _twists(motions: Sequence[Sequence[Group]]) -> Iterator[_Twist]:
    first = motions[0][0]
    lines, turn = _mean_peak(motions, "line_drift"), _mean_peak(motions, "floor_rotation")
    if lines is None:
        return
    names = [str(name).rpartition(".")[0] for name in first.coords["drift_line"].values]
    of = np.asarray(first.variables["drift_line_storey"].values)
    for at, direction in enumerate(first.coords["direction"].values):
        for i, storey in enumerate(first.coords["storey"].values):
            own = np.flatnonzero(of == storey)
            drifts = lines[own, at]
            worst = int(np.argmax(drifts))
            yield _Twist(
                int(storey),
                str(direction),
                float(drifts.min()),
                float(drifts[worst]),
                names[own[worst]],
                float(drifts[worst] / drifts.mean()) if drifts.mean() > ROUNDING else 1.0,
                None if turn is None else float(turn[i]),
            )
