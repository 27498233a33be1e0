"""Properties of damper tests as tables and as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Any, NamedTuple

from edesign.damper.testing.properties import CycleProperties, Properties
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.number import finite
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import DEGC, HZ, MPA, ONE, PERCENT, S, Unit


class _Test(NamedTuple):
    name: str
    mean: Properties


class _Cycle(NamedTuple):
    block: int
    cycle: int
    start: float
    mean: Properties


_COLUMNS: tuple[Column[Any], ...] = (
    col("strain", PERCENT, "mean.strain"),
    col("f", HZ, "mean.frequency"),
    col("G'", MPA, "mean.G_storage"),
    col("G_eq", MPA, "mean.G_eq"),
    col("G''", MPA, "mean.G_loss"),
    col("n", Unit("-"), "mean.loss_factor"),
)
PROPERTIES = TableSpec[_Test](
    "properties_of_tests",
    "{title}",
    (
        text("test", "name"),
        col("T", DEGC, "mean.temperature_C", 3),
        *_COLUMNS,
        col("cycles", ONE, lambda test: f"{test.mean.cycles[0]}-{test.mean.cycles[1]}"),
    ),
    named_by_title=True,
)
EACH_CYCLE = TableSpec[_Cycle](
    "properties_of_cycles",
    "{title}",
    (count("block"), count("cycle"), col("start", S, form=".3f"), *_COLUMNS),
    keys=0,
    named_by_title=True,
)


def properties_table(title: str, found: Mapping[str, Properties], notes: list[str] | None = None) -> Table:
    """Return the mean properties of each test.

    Args:
        title: above the table.
        notes: lines below.
    """
    spec = PROPERTIES if found else replace(PROPERTIES, columns=())
    return spec.of(map(_Test, found, found.values()), notes=notes or (), title=title)


def cycle_properties_table(title: str, each: CycleProperties) -> Table:
    """Return the properties of each full cycle of a test."""
    cycles = range(each.block.size)
    return EACH_CYCLE.of(
        (_Cycle(each.block[i], each.cycle[i], each.start[i], _row(each, i)) for i in cycles), title=title
    )


def properties_data(found: Mapping[str, Properties], cycles: Mapping[str, CycleProperties]) -> dict[str, Any]:
    """Return properties and those of each cycle as JSON data, SI units.

    Args:
        found: mean properties, by name of the test.
        cycles: properties of each cycle, by name of the test.
    """
    tests: dict[str, Any] = {name: {"mean": finite(asdict(row))} for name, row in found.items()}
    for name, each in cycles.items():
        tests.setdefault(name, {})["each_cycle"] = finite({key: column.tolist() for key, column in vars(each).items()})
    return {"units": {"strain": "1", "frequency": "Hz", "G": "Pa", "temperature": "degC", "time": "s"}, "tests": tests}


def _row(each: CycleProperties, i: int) -> Properties:
    names = ("G_storage", "G_eq", "G_loss", "loss_factor")
    moduli = {name: float(getattr(each, name)[i]) for name in names}
    cycle = int(each.cycle[i])
    return Properties(float(each.strain[i]), float(each.frequency[i]), 0.0, **moduli, cycles=(cycle, cycle))
