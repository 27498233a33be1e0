"""Properties of damper tests as tables and as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from edesign.damper.testing.properties import CycleProperties, Properties
from edesign.report.tables.table import Table, finite, formatted, number, whole

_COLUMNS = ("strain [%]", "f [Hz]", "G' [MPa]", "G_eq [MPa]", "G'' [MPa]", "n [-]")


def properties_table(title: str, found: Mapping[str, Properties], notes: list[str] | None = None) -> Table:
    """Return the mean properties of each test.

    Args:
        title: above the table.
        found: by name of the test.
        notes: lines below.
    """
    columns = ("test", "T [degC]", *_COLUMNS, "cycles")
    rows = [
        [name, number(row.temperature_C, 3), *_cells(row), f"{row.cycles[0]}-{row.cycles[1]}"]
        for name, row in found.items()
    ]
    return Table(title, columns if rows else (), rows, notes or [])


def cycle_properties_table(title: str, each: CycleProperties) -> Table:
    """Return the properties of each full cycle of a test."""
    columns = ("block", "cycle", "start [s]", *_COLUMNS)
    rows = [
        [whole(each.block[i]), whole(each.cycle[i]), formatted(each.start[i], ".3f"), *_cells(_row(each, i))]
        for i in range(each.block.size)
    ]
    return Table(title, columns, rows, left=0)


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


def _cells(row: Properties) -> list[str]:
    moduli = (number(value, 4, 1e6) for value in (row.G_storage, row.G_eq, row.G_loss))
    return [number(row.strain, 4, 1e-2), number(row.frequency, 4), *moduli, number(row.loss_factor, 4)]
