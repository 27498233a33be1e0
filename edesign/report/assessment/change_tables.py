"""Tables of how far single storeys and members change from the first variant to each other one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from edesign.archive.dataset import Group
from edesign.assess.changes import Change, Tension, in_common, largest_change, tension
from edesign.assess.sets import HistorySet
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import DIFFERENCE, first_of_level, label
from edesign.report.tables.table import Table, formatted, number

ROWS = (  # name, quantity, unit of the name in SI
    ("storey drift [%]", "storey_drift", 0.01),
    ("residual storey drift [%]", "residual_storey_drift", 0.01),
    ("storey shear [kN]", "storey_shear", 1e3),
    ("floor acceleration [m/s2]", "floor_acceleration", 1.0),
    ("column axial force [kN]", "column_axial_force", 1e3),
    ("brace axial force [kN]", "brace_axial_force", 1e3),
    ("beam plastic rotation [mrad]", "beam_plastic_rotation", 1e-3),
    ("column plastic rotation [mrad]", "column_plastic_rotation", 1e-3),
    ("brace ductility", "brace_ductility", 1.0),
)
SHORT = (("drift", "storey_drift"), ("column force", "column_axial_force"))
MOST_ROWS = 6


@dataclass(frozen=True)
class _Pair:
    """The histories of the first variant of a level and of another one under the records that both have."""

    first: HistorySet
    found: HistorySet
    before: list[Group]
    after: list[Group]

    def change(self, quantity: str) -> Change | None:
        return largest_change(self.before, self.after, quantity)

    def of_the_same_records(self) -> bool:
        """Whether both have been completed under the same records."""
        return len(self.before) == len(self.first.completed) and len(self.after) == len(self.found.completed)


def changes_table(sets: Sequence[HistorySet]) -> Table:
    """Return where each quantity changes most from the first variant of a level to each other one.

    Args:
        sets: the histories by variant and level.
    """
    columns = ("histories", "quantity", "most in", "before", "after", DIFFERENCE)
    title = "Storeys, floors and members whose response grows most, or falls least"
    table = Table(title, columns, left=3, name="largest_changes")
    for pair in _pairs(sets):
        for name, quantity, unit in ROWS:
            found = pair.change(quantity)
            if found is None or max(found.before, found.after) <= ROUNDING:
                continue
            cells = [number(value, 4, unit, ROUNDING) for value in (found.before, found.after)]
            table.rows.append([label(pair.found), name, found.place, *cells, _percent(found)])
    if table.rows:
        table.notes.append(
            "Before: in the first variant of the level. Each storey, floor and member is compared with itself, by the "
            "mean over the records that both have."
        )
        table.notes += tension_notes(sets)
    return table


def changes_in_short(sets: Sequence[HistorySet]) -> Table:
    """Return the largest changes of a storey's drift and a column's force, and tension, a row for each variant.

    Args:
        sets: the histories by variant and level.
    """
    pairs = list(_pairs(sets))
    columns = [(title, quantity) for title, quantity in SHORT if any(pair.change(quantity) for pair in pairs)]
    headers = ("histories", *(title for title, _ in columns), "tension, any record (before)")
    firsts = dict.fromkeys(pair.first.variant for pair in pairs)
    title = f"Storey and column that grow most, or fall least, from {', '.join(firsts)}"
    table = Table(title, headers, left=len(headers), name="changes_in_short")
    for pair in pairs[:MOST_ROWS]:
        cells = []
        for _, quantity in columns:
            found = pair.change(quantity)
            cells.append("-" if found is None else f"{_percent(found)} % {found.place}")
        before, now = (tension(found.completed.values()) for found in (pair.first, pair.found))
        there = "none" if now is None else f"{number(now.force, 3, 1e3)} kN {now.column}"
        alike = pair.of_the_same_records()
        there += "" if before is None or not alike else f" ({number(before.force, 3, 1e3)} kN)"
        table.rows.append([label(pair.found), *cells, there])
    if len(pairs) > MOST_ROWS:
        table.notes.append(f"and {len(pairs) - MOST_ROWS} more, among all tables")
    return table


def tension_notes(sets: Sequence[HistorySet]) -> list[str]:
    """Return a line for each set with columns that go into tension, and those that lift their supports.

    Args:
        sets: the histories by variant and level.
    """
    notes = []
    for found in dict.fromkeys(label(one) for one in sets):
        of = next(one for one in sets if label(one) == found)
        pulled = tension(of.completed.values())
        if pulled is not None:
            notes.append(f"{found}: {_tension(pulled)}")
    return notes


def _tension(found: Tension) -> str:
    count = len(found.columns)
    text = f"{count} column{'s' * (count > 1)} in tension, most {found.column}, {number(found.force, 3, 1e3)} kN"
    lifting = len(found.lifting)
    return text + (f"; {lifting} of them in storey 1, which pull{'s' * (lifting == 1)} at supports" if lifting else "")


def _pairs(sets: Sequence[HistorySet]) -> Iterator[_Pair]:
    """Each set with the first of its level, where they have records in common."""
    for first, found in first_of_level(sets):
        if found is not first:
            before, after = in_common(first, found)
            if before:
                yield _Pair(first, found, list(before.values()), list(after.values()))


def _percent(found: Change) -> str:
    if found.before <= ROUNDING:
        return "-"
    return formatted(100.0 * (found.after / found.before - 1.0), "+.1f")
