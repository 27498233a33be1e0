"""Columns of tests of dampers: `force_kN` is a force in kN, and so is `Kraft` with `kN` in a line below."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean
from edesign.tables.quantities import (
    QUANTITIES,
    name_and_unit,
    names_quantity,
    other_quantity_of,
    quantity_of,
    scaled_unit,
    spelled,
)
from edesign.tables.table import Table

_MISSPELT = 0.75  # likeness of names from which a header is one misspelt: of `forse` and `force` it is 0.8


@dataclass(frozen=True)
class Chosen:
    """The columns that a file names for a table.

    Attributes:
        columns: header or number, from 1, by quantity; if there are any, no other column is read.
        units: by quantity, in place of those of the headers.
        reversed: quantities that have the other sign in the file.
    """

    columns: Mapping[str, int | str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    reversed: Sequence[str] = ()

    def names(self, header: str) -> bool:
        """Return whether a cell is a header: a chosen one, or one that names a quantity."""
        return header in self.columns.values() or names_quantity(header)

    def read_of(self, headers: Sequence[str]) -> list[int]:
        """Return the columns that are read, from 0: those that are said, or else named; all, if there are none."""
        said = [_places_of(headers, wanted) for wanted in self.columns.values()]
        places = [at for found in said or candidates(headers).values() for at in found]
        return places if places and all(said) else list(range(len(headers)))


def columns_in_si(table: Table, chosen: Chosen | None = None) -> tuple[dict[str, np.ndarray], list[str]]:
    """Return columns by quantity in s, m, N, degC, and the headers of other columns, which are not read.

    Args:
        table: headers name quantity and unit: `force_kN`, also `Force (kN)`, `Axial Force [kN]` or `Load kN`.
        chosen: what is said of the columns.

    Raises:
        InputError: a header is nearly that of a quantity, has no unit or one of another quantity, a quantity comes
            twice, or a column that is said is not there.
    """
    chosen = chosen or Chosen()
    places = _said(table, chosen.columns) if chosen.columns else _found(table)
    found = {}
    for quantity, i in places.items():
        unit = chosen.units.get(quantity)
        factor, zero = _said_unit(table, i, quantity, unit) if unit else _factors(table, i, quantity)
        with np.errstate(over="ignore"):
            found[quantity] = factor * table.rows[:, i] + zero
        if (beyond := np.flatnonzero(~np.isfinite(found[quantity]))).size:
            row = int(beyond[0])
            raise InputError(
                f"{table.where(i, row)}: {table.rows[row, i]:g} is beyond all numbers in SI units [E-TABLE-08]"
            )
        if quantity in chosen.reversed:
            found[quantity] = -found[quantity]
    for quantity in (*chosen.units, *chosen.reversed):
        if quantity not in found:
            raise InputError(
                f"{table.where()}: the unit or sign of {quantity} is said, but there is no column of it [E-TABLE-10]"
            )
    return found, [header for i, header in enumerate(table.headers) if i not in places.values()]


def candidates(headers: Sequence[str]) -> dict[str, list[int]]:
    """Return the columns that may be each quantity, from 0: of plain names, of others where no column has one."""
    names = [name_and_unit(header)[0] for header in headers]
    found: dict[str, list[int]] = {}
    for meaning in (quantity_of, other_quantity_of):
        new: dict[str, list[int]] = {}
        for i, name in enumerate(names):
            if (quantity := meaning(name)) is not None and quantity not in found:
                new.setdefault(quantity, []).append(i)
        found |= new
    return found


def unit_of(table: Table, column: int, quantity: str) -> str | None:
    """Return the unit of a column as `QUANTITIES` has it; None: no known unit.

    Args:
        column: from 0.
        quantity: a key of `QUANTITIES`.
    """
    if column in table.clocks and quantity == "time":
        return "s"
    unit = name_and_unit(table.headers[column])[1]
    return spelled(unit) if unit and spelled(unit) in QUANTITIES[quantity] else None


def need(table: Table, columns: Mapping[str, np.ndarray], *quantities: str) -> None:
    """Check that a table has columns of the quantities that are needed.

    Args:
        table: the table, for messages.
        columns: values by quantity.

    Raises:
        InputError: one is missing.
    """
    for quantity in quantities:
        if quantity not in columns:
            example = f"{quantity}_{next(iter(QUANTITIES[quantity]))}"
            raise InputError(
                f"{table.where()}: there is no column of {quantity}, such as `{example}` "
                f"(the columns are: {', '.join(table.headers)}) [E-TABLE-10]"
            )


def _found(table: Table) -> dict[str, int]:
    """Columns by quantity, each by the one header that names it."""
    found = candidates(table.headers)
    say = ", ".join(f"{quantity}: {places[-1] + 1}" for quantity, places in found.items())
    for i, header in enumerate(table.headers):
        name, unit = name_and_unit(header)
        if quantity_of(name) or other_quantity_of(name):
            continue
        if near := difflib.get_close_matches(name.strip().lower(), QUANTITIES, 1, _MISSPELT):
            meant = f"{near[0]}_{unit}" if unit in QUANTITIES[near[0]] else near[0]
            raise InputError(
                f"{table.where(i)}: the column is unknown; did you mean `{meant}`? (allowed: "
                f"{', '.join(QUANTITIES)}, with their unit: `force_kN`); or say by `columns` which ones are read"
                " [E-TABLE-11]"
            )
    for quantity, (first, *others) in found.items():
        if others:
            raise InputError(
                f"{table.where(others[0])}: column {first + 1} (`{table.headers[first]}`) may be the {quantity} too; "
                f"say which one by `columns`, such as `columns: {{{say}}}` [E-TABLE-11]"
            )
    return {quantity: places[0] for quantity, places in found.items()}


def _said(table: Table, columns: Mapping[str, int | str]) -> dict[str, int]:
    """Columns that are said, from 0."""
    places: dict[str, int] = {}
    for quantity, wanted in columns.items():
        where = _places_of(table.headers, wanted)
        if isinstance(wanted, int) and not where:
            raise InputError(
                f"{table.where()}: there is no column {wanted} ({quantity}); the columns are numbered 1 to "
                f"{len(table.headers)} [E-TABLE-10]"
            )
        if len(where) != 1:
            hint = did_you_mean(str(wanted), table.headers)
            said = f"there are {len(where)} columns" if where else "there is no column"
            raise InputError(
                f"{table.where()}: {said} `{wanted}` ({quantity}){hint} (the columns are: {', '.join(table.headers)})"
                " [E-TABLE-10]"
            )
        at = where[0]
        if at in places.values():
            raise InputError(f"{table.where(at)}: the column cannot be two quantities [E-TABLE-11]")
        places[quantity] = at
    return places


def _places_of(headers: Sequence[str], wanted: int | str) -> list[int]:
    """Columns that a number, a header or its name fits, from 0."""
    if isinstance(wanted, int):
        return [wanted - 1] if 1 <= wanted <= len(headers) else []
    return [i for i, header in enumerate(headers) if header == wanted] or [
        i for i, header in enumerate(headers) if name_and_unit(header)[0].strip() == wanted
    ]


def _said_unit(table: Table, i: int, quantity: str, unit: str) -> tuple[float, float]:
    units = QUANTITIES[quantity]
    if spelled(unit) in units:
        return units[spelled(unit)]
    factor = scaled_unit(unit, {name: one for name, (one, zero) in units.items() if not zero})
    if factor is None:
        raise InputError(
            f"{table.where(i)}: `{unit}` is no unit of {quantity} (allowed: {', '.join(units)}, also with a number: "
            f"`{next(iter(units))}/10`) [E-TABLE-12]"
        )
    return factor, 0.0


def _factors(table: Table, i: int, name: str) -> tuple[float, float]:
    units = QUANTITIES[name]
    header = table.headers[i]
    if quantity_of(name_and_unit(header)[0]) is None:
        header = header.rpartition("/")[2]  # of a path
    unit = name_and_unit(header)[1]
    if unit is None and i in table.clocks:
        return 1.0, 0.0
    if unit is None:
        raise InputError(
            f"{table.where(i)}: the unit is missing; write {_listed(name)}, or say it by `units` [E-TABLE-12]"
        )
    plain = spelled(unit)
    if plain in units:
        return units[plain]
    other = next((quantity for quantity, them in QUANTITIES.items() if plain in them), None)
    said = f"`{unit}` is a unit of {other}, not of {name}" if other else f"the unit `{unit}` is unknown"
    near = did_you_mean(f"{name}_{unit}", _names(name))
    raise InputError(f"{table.where(i)}: {said}{near} (allowed: {_listed(name)}) [E-TABLE-12]")


def _names(quantity: str) -> list[str]:
    return [f"{quantity}_{unit}" for unit in QUANTITIES[quantity]]


def _listed(quantity: str) -> str:
    return ", ".join(f"`{name}`" for name in _names(quantity))
