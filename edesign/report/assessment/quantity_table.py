"""What criteria may limit, as tables: quantities at their places, and response measures of a frame."""

from __future__ import annotations

from edesign.project.criteria.criterion_quantities import QUANTITIES, keys_of
from edesign.project.criteria.measures import MEASURES, short_name
from edesign.report.tables.column import text
from edesign.report.tables.table import Table, TableSpec


def _said(unit: str) -> str | None:
    """A unit as printed; a ratio has none."""
    return None if unit in ("", "1") else unit


QUANTITIES_OF_CRITERIA = TableSpec[str](
    "quantities_of_criteria",
    "Quantities of criteria",
    (
        text("quantity", str),
        text("unit", lambda name: _said(QUANTITIES[name].kind.unit)),
        text("keys", lambda name: ", ".join(keys_of(name)) or None),
        text("in buildings", lambda name: ", ".join(QUANTITIES[name].in_space) or None),
        text("histories", lambda name: QUANTITIES[name].kept or None),
        text("meaning", lambda name: QUANTITIES[name].meaning, broken=1),
    ),
    notes=(
        "in buildings: keys that say where; plane frames have none of them",
        "histories: what `outputs: histories` of the study must keep for it",
    ),
    keys=5,
)
MEASURES_OF_CRITERIA = TableSpec[str](
    "measures_of_criteria",
    "Measures of criteria",
    (
        text("measure", short_name),
        text("unit", lambda name: _said(MEASURES[name].kind.unit)),
        text("in buildings", lambda name: ", ".join(MEASURES[name].in_space) or None),
    ),
    keys=2,
)


def quantities_table() -> Table:
    """Return all archived quantities that a criterion may limit, with the keys that say where and of what."""
    return QUANTITIES_OF_CRITERIA.of(QUANTITIES)


def measures_table() -> Table:
    """Return all response measures that a criterion may limit; they are of the whole frame unless places are chosen."""
    return MEASURES_OF_CRITERIA.of(MEASURES)
