"""Tables of how far single storeys and members change from the first variant to each other one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.assess.changes import Change, Tension, in_common, largest_change, tension
from edesign.assess.sets import HistorySet
from edesign.report.assessment.measure_columns import ROUNDING, Measure
from edesign.report.assessment.measure_tables import DIFFERENCE, first_of_level, label
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, M_S2, MRAD, ONE, PERCENT

QUANTITIES = (
    Measure("storey drift", "storey_drift", PERCENT),
    Measure("residual storey drift", "residual_storey_drift", PERCENT),
    Measure("storey shear", "storey_shear", KN),
    Measure("floor acceleration", "floor_acceleration", M_S2),
    Measure("column axial force", "column_axial_force", KN),
    Measure("brace axial force", "brace_axial_force", KN),
    Measure("beam plastic rotation", "beam_plastic_rotation", MRAD),
    Measure("column plastic rotation", "column_plastic_rotation", MRAD),
    Measure("brace ductility", "brace_ductility", ONE),
)


@dataclass(frozen=True)
class _Pair:
    """The histories of the first variant of a level and of another one under the records that both have."""

    first: HistorySet
    found: HistorySet
    before: dict[str, Group]
    after: dict[str, Group]

    def change(self, quantity: str) -> Change | None:
        return largest_change(self.first.by_motion(self.before), self.found.by_motion(self.after), quantity)

    def of_the_same_records(self) -> bool:
        """Whether both have been completed under the same records."""
        return len(self.before) == len(self.first.completed) and len(self.after) == len(self.found.completed)


class _Row(NamedTuple):
    """A quantity that changes from one set of histories to another."""

    histories: str
    quantity: Measure
    change: Change


def _growth(found: Change) -> float | None:
    return None if found.before <= ROUNDING else found.after / found.before - 1.0


GROWTH: Column[Change] = col(DIFFERENCE, PERCENT, _growth, form="+.1f")
CHANGES = TableSpec[_Row](
    "largest_changes",
    "Storeys, floors and members whose response grows most, or falls least",
    (
        text("histories"),
        text("quantity", "quantity.head"),
        text("most in", "change.place"),
        col("before", ONE, lambda row: row.quantity.cell(row.change.before)),
        col("after", ONE, lambda row: row.quantity.cell(row.change.after)),
        col(DIFFERENCE, PERCENT, lambda row: _growth(row.change), form="+.1f"),
    ),
    notes=(
        "Before: in the first variant of the level. Each storey, floor and member is compared with itself, by the "
        "mean over the records that both have. Of one record at several angles, or with masses at several places, the "
        "worst history counts.",
    ),
    keys=3,
)


def _largest(quantity: str) -> Callable[[_Pair], str | None]:
    """The place where a quantity changes most, with the change."""

    def of(pair: _Pair) -> str | None:
        found = pair.change(quantity)
        return None if found is None else f"{GROWTH.text(_growth(found))} % {found.place}"

    return of


def _tensions(pair: _Pair) -> str:
    """The largest tension in any record, and in brackets that of the first variant."""
    before, now = (tension(found.completed.values()) for found in (pair.first, pair.found))
    there = "none" if now is None else f"{_in_kn(now.force)} {now.column}"
    alike = pair.of_the_same_records()
    return there + ("" if before is None or not alike else f" ({_in_kn(before.force)})")


def _in_kn(force: float) -> str:
    return f"{significant(force / 1e3, 3)} kN"


CHANGES_IN_SHORT = TableSpec[_Pair](
    "changes_in_short",
    "Storey and column that grow most, or fall least, from {firsts}",
    (
        text("histories", lambda pair: label(pair.found)),
        text("drift", _largest("storey_drift"), optional=True),
        text("column force", _largest("column_axial_force"), optional=True),
        text("tension, any record (before)", _tensions),
    ),
    keys=4,
    most=6,
    cut="and {more} more, among all tables",
)


def changes_table(sets: Sequence[HistorySet]) -> Table:
    """Return where each quantity changes most from the first variant of a level to each other one."""
    rows = [
        _Row(label(pair.found), quantity, found)
        for pair in _pairs(sets)
        for quantity in QUANTITIES
        if (found := pair.change(quantity.name)) is not None and max(found.before, found.after) > ROUNDING
    ]
    return CHANGES.of(rows, notes=tension_notes(sets) if rows else ())


def changes_in_short(sets: Sequence[HistorySet]) -> Table:
    """Return the largest changes of a storey's drift and a column's force, and tension, a row for each variant."""
    pairs = list(_pairs(sets))
    return CHANGES_IN_SHORT.of(pairs, firsts=", ".join(dict.fromkeys(pair.first.variant for pair in pairs)))


def tension_notes(sets: Sequence[HistorySet]) -> list[str]:
    """Return a line for each set with columns that go into tension, and those that lift their supports."""
    notes = []
    for found in dict.fromkeys(label(one) for one in sets):
        of = next(one for one in sets if label(one) == found)
        pulled = tension(of.completed.values())
        if pulled is not None:
            notes.append(f"{found}: {_tension(pulled)}")
    return notes


def _tension(found: Tension) -> str:
    count = len(found.columns)
    text = f"{count} column{'s' * (count > 1)} in tension, most {found.column}, {_in_kn(found.force)}"
    lifting = len(found.lifting)
    return text + (f"; {lifting} of them in storey 1, which pull{'s' * (lifting == 1)} at supports" if lifting else "")


def _pairs(sets: Sequence[HistorySet]) -> Iterator[_Pair]:
    """Each set with the first of its level, where they have records in common."""
    for first, found in first_of_level(sets):
        if found is not first:
            before, after = in_common(first, found)
            if before:
                yield _Pair(first, found, before, after)
