"""What criteria may limit, as tables: quantities at their places, and response measures of a frame."""

from __future__ import annotations

from edesign.project.criteria.criterion_quantities import QUANTITIES, keys_of
from edesign.project.criteria.measures import MEASURE_KINDS, short_name
from edesign.report.tables.table import Table


def quantities_table() -> Table:
    """Return all archived quantities that a criterion may limit, with the keys that say where and of what."""
    rows = [
        [
            name,
            "-" if item.kind.unit in ("", "1") else item.kind.unit,
            ", ".join(keys_of(name)) or "-",
            item.kept or "-",
            item.meaning,
        ]
        for name, item in QUANTITIES.items()
    ]
    columns = ("quantity", "unit", "keys", "histories", "meaning")
    note = "histories: what `outputs: histories` of the study must keep for it"
    return Table("Quantities of criteria", columns, rows, [note], left=5, sentences=4, name="quantities_of_criteria")


def measures_table() -> Table:
    """Return all response measures that a criterion may limit; they are of the whole frame unless places are chosen."""
    rows = [[short_name(name), "-" if kind.unit == "1" else kind.unit] for name, kind in MEASURE_KINDS.items()]
    return Table("Measures of criteria", ("measure", "unit"), rows, left=2, name="measures_of_criteria")
