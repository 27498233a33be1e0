"""Columns of test files: `force_kN` is a force in kN."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np

from edesign.damper.csv_table import CsvTable
from edesign.errors import InputError
from edesign.project.problems import did_you_mean

Units = Mapping[str, tuple[float, float]]  # factor and zero: SI = factor * value + zero

TIME: Units = {"s": (1.0, 0.0), "ms": (1e-3, 0.0), "min": (60.0, 0.0)}
DISPLACEMENT: Units = {"mm": (1e-3, 0.0), "m": (1.0, 0.0), "cm": (1e-2, 0.0), "um": (1e-6, 0.0), "in": (0.0254, 0.0)}
FORCE: Units = {
    "kN": (1e3, 0.0),
    "N": (1.0, 0.0),
    "MN": (1e6, 0.0),
    "lbf": (4.4482216152605, 0.0),
    "kip": (4448.2216152605, 0.0),
}
TEMPERATURE: Units = {"C": (1.0, 0.0), "degC": (1.0, 0.0), "K": (1.0, -273.15), "F": (5.0 / 9.0, -160.0 / 9.0)}

QUANTITIES: dict[str, Units] = {
    "time": TIME,
    "displacement": DISPLACEMENT,
    "force": FORCE,
    "temperature": TEMPERATURE,
}

_HEADER = re.compile(r"(?P<name>[A-Za-z]+)(?:(?:_|\s*[\[(]\s*|\s+)(?P<unit>[^\W\d_]\w*|°C|µm)\s*[\])]?)?")
_SPELLED = {"°C": "C", "µm": "um", "sec": "s"}


def columns_in_si(table: CsvTable) -> dict[str, np.ndarray]:
    """Columns by quantity, in s, m, N, degC.

    Args:
        table: headers name quantity and unit: `force_kN`, also `Force (kN)` or `force [kN]`.

    Raises:
        InputError: a header names no quantity, no unit or one of another quantity, or a quantity comes twice.
    """
    found: dict[str, np.ndarray] = {}
    first: dict[str, int] = {}
    for i, header in enumerate(table.headers):
        quantity, (factor, zero) = _meaning(table, i, header)
        if quantity in found:
            raise InputError(f"{table.where(i)}: there is a {quantity} already in column {first[quantity] + 1}")
        values = table.rows[:, i]
        found[quantity], first[quantity] = factor * values + zero, i
    return found


def need(table: CsvTable, columns: Mapping[str, np.ndarray], *quantities: str) -> None:
    """Check that quantities are there.

    Raises:
        InputError: one is missing.
    """
    for quantity in quantities:
        if quantity not in columns:
            example = f"{quantity}_{next(iter(QUANTITIES[quantity]))}"
            raise InputError(
                f"{table.where()}: there is no column of {quantity}, such as `{example}` "
                f"(the columns are: {', '.join(table.headers)})"
            )


def _meaning(table: CsvTable, i: int, header: str) -> tuple[str, tuple[float, float]]:
    match = _HEADER.fullmatch(header)
    name = match["name"].lower() if match else ""
    if match is None or name not in QUANTITIES:
        usual = [f"{quantity}_{unit}" for quantity, units in QUANTITIES.items() for unit in units]
        hint = did_you_mean(header, usual) or did_you_mean(name, QUANTITIES)
        raise InputError(
            f"{table.where(i)}: the column is unknown{hint} (allowed: {', '.join(QUANTITIES)}, with their unit: "
            "`force_kN`)"
        )
    units = QUANTITIES[name]
    unit = _SPELLED.get(match["unit"] or "", match["unit"])
    if unit is None:
        raise InputError(f"{table.where(i)}: the unit is missing; write {_listed(name)}")
    if unit in units:
        return name, units[unit]
    other = next((quantity for quantity, them in QUANTITIES.items() if unit in them), None)
    said = f"`{unit}` is a unit of {other}, not of {name}" if other else f"the unit `{unit}` is unknown"
    raise InputError(f"{table.where(i)}: {said}{did_you_mean(header, _names(name))} (allowed: {_listed(name)})")


def _names(quantity: str) -> list[str]:
    return [f"{quantity}_{unit}" for unit in QUANTITIES[quantity]]


def _listed(quantity: str) -> str:
    return ", ".join(f"`{name}`" for name in _names(quantity))
