"""What supports and foundations carry under histories: extremes of the reactions, each with what acts with it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from edesign.assess.member_uses import SupportForces, in_words, rule_of, support_forces
from edesign.assess.sets import HistorySet
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.report.assessment.measure_tables import label
from edesign.report.response.use_tables import NOTHING
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_M

SUPPORTS = TableSpec[SupportForces](
    "support_forces",
    "{whose}: reactions of supports",
    (text("support"), text("extreme")),  # and V, H, M, and the history
    keys=2,
    each="Reactions of supports",
)
NOTE = (
    "Gravity included. V upwards on the structure: negative is uplift. H and M are magnitudes, and act with V at the "
    "instant of the extreme"
)
MEANS = ", {count} motions: means of the extremes and of what acts with each ({code}), not of one step"


def support_tables(sets: Iterable[HistorySet], hazard: Hazard | None) -> Iterator[Table]:
    """Return the table of each set of histories, for the design of foundations and column bases.

    Args:
        sets: those of archives that do not know the extremes are left out.
        hazard: of the file, whose code says what counts of several motions.
    """
    rules = rules_in_force(hazard)
    for found in sets:
        rows = support_forces(found, rules)
        if not rows:
            continue
        axes = ("",) if len(rows[0].H) == 1 else ("_x", "_y")
        columns: list[Column[SupportForces]] = [col("V", KN, "V", 4)]
        columns += [_of("H", axis, at) for at, axis in enumerate(axes)]
        columns += [_of("M", axis, at) for at, axis in enumerate(axes)]
        mean = rule_of(found, rules) == "mean"
        note = f"{NOTE}{MEANS.format(count=found.motions, code=in_words(rules)) if mean else ''}."
        columns.append(text("largest in" if mean else "history", "history", broken=1))
        yield SUPPORTS.of(rows, more=columns, whose=label(found), notes=wrapped(note))


def _of(symbol: str, axis: str, at: int) -> Column[SupportForces]:
    return col(
        f"{symbol}{axis}", KN if symbol == "H" else KN_M, lambda row: getattr(row, symbol)[at], 4, negligible=NOTHING
    )
