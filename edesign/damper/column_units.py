"""Columns of test files: `force_kN` is a force in kN."""

from __future__ import annotations

import difflib
import re
from collections.abc import Mapping

import numpy as np

from edesign.damper.csv_table import CsvTable
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean

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

# other names of the quantities on test machines, behind what they put before them
_NAMES = {
    "time": ("time",),
    "displacement": ("displacement", "stroke", "deformation", "disp"),
    "force": ("force", "load"),
    "temperature": ("temperature", "temp"),
}
_BEFORE = re.compile(r"(?:axial|actuator|elapsed|running|total)[ _]")
_BRACKETED = re.compile(r"(?P<name>[^\[(]*)[\[(](?P<unit>[^\])]*)[\])]")
_MISSPELT = 0.75  # likeness of names from which a header is one misspelt: of `forse` and `force` it is 0.8
_SPELLED = {"°C": "C", "°F": "F", "µm": "um", "μm": "um", "sec": "s", "Sec": "s", "seconds": "s"}


def columns_in_si(table: CsvTable) -> tuple[dict[str, np.ndarray], list[str]]:
    """Columns by quantity, in s, m, N, degC, and the headers of columns of other quantities, which are not read.

    Args:
        table: headers name quantity and unit: `force_kN`, also `Force (kN)`, `Axial Force [kN]` or `Load kN`.

    Raises:
        InputError: a header is nearly that of a quantity, has no unit or one of another quantity, or a quantity comes
            twice.
    """
    found: dict[str, np.ndarray] = {}
    first: dict[str, int] = {}
    others = []
    for i, header in enumerate(table.headers):
        name, unit = _parts(header)
        quantity = _quantity(name)
        if quantity is None:
            if near := difflib.get_close_matches(name.strip().lower(), QUANTITIES, 1, _MISSPELT):
                meant = f"{near[0]}_{unit}" if unit in QUANTITIES[near[0]] else near[0]
                raise InputError(
                    f"{table.where(i)}: the column is unknown; did you mean `{meant}`? (allowed: "
                    f"{', '.join(QUANTITIES)}, with their unit: `force_kN`)"
                )
            others.append(header)
            continue
        factor, zero = _factors(table, i, quantity, unit)
        if quantity in found:
            raise InputError(f"{table.where(i)}: there is a {quantity} already in column {first[quantity] + 1}")
        values = table.rows[:, i]
        found[quantity], first[quantity] = factor * values + zero, i
    return found, others


def names_quantity(header: str) -> bool:
    """Whether a header names a quantity, with a unit or without."""
    return _quantity(_parts(header)[0]) is not None


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


def _parts(header: str) -> tuple[str, str | None]:
    """Name and unit of `force_kN`, `Axial Force (kN)`, `Load kN`, `time`."""
    if match := _BRACKETED.fullmatch(header):
        return match["name"], match["unit"].strip() or None
    name, _, unit = header.rpartition("_")
    if name and (_quantity(name) or _is_unit(unit)):
        return name, unit
    name, _, unit = header.rpartition(" ")
    return (name, unit) if name and _is_unit(unit) else (header, None)


def _quantity(name: str) -> str | None:
    """What a name means; None: another quantity."""
    plain = _BEFORE.sub("", name.strip().lower())
    return next((quantity for quantity, names in _NAMES.items() if plain in names), None)


def _factors(table: CsvTable, i: int, name: str, unit: str | None) -> tuple[float, float]:
    units = QUANTITIES[name]
    if unit is None:
        raise InputError(f"{table.where(i)}: the unit is missing; write {_listed(name)}")
    spelled = _spelled(unit)
    if spelled in units:
        return units[spelled]
    other = next((quantity for quantity, them in QUANTITIES.items() if spelled in them), None)
    said = f"`{unit}` is a unit of {other}, not of {name}" if other else f"the unit `{unit}` is unknown"
    near = did_you_mean(f"{name}_{unit}", _names(name))
    raise InputError(f"{table.where(i)}: {said}{near} (allowed: {_listed(name)})")


def _is_unit(text: str) -> bool:
    return any(_spelled(text) in units for units in QUANTITIES.values())


def _spelled(unit: str) -> str:
    return _SPELLED.get(unit, unit)


def _names(quantity: str) -> list[str]:
    return [f"{quantity}_{unit}" for unit in QUANTITIES[quantity]]


def _listed(quantity: str) -> str:
    return ", ".join(f"`{name}`" for name in _names(quantity))
