"""Records of SAP2000's tables by the names of what they describe."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable
from typing import TypeVar

from edesign.exchange.sap2000.model import Six, SixFlags
from edesign.exchange.sap2000.tables import Row, Tables
from edesign.project.reading.problems import did_you_mean

T = TypeVar("T")


def keyed(tables: Tables, table: str, key: str, make: Callable[[Row], T]) -> dict[str, T]:
    """Return the records of a table by a name that no other of them has.

    Raises:
        InputError: two records have one name.
    """
    found: dict[str, T] = {}
    for row in tables.of(table):
        name = row.text(key)
        if name in found:
            raise row.error(f"{key} {name} is there twice [E-SAP-06]")
        found[name] = make(row)
    return found


def known_name(row: Row, key: str, there: Collection[str], what: str) -> str:
    """Return the name in a field, which must be that of a part.

    Raises:
        InputError: there is no such part.
    """
    name = row.text(key)
    if name not in there:
        raise row.error(f"`{key}={name}`: there is no such {what}{did_you_mean(name, there)} [E-SAP-05]")
    return name


def six_flags(values: Iterable[bool]) -> SixFlags:
    """Return six flags as a tuple."""
    a, b, c, d, e, f = values
    return a, b, c, d, e, f


def six_values(values: Iterable[float]) -> Six:
    """Return six numbers as a tuple."""
    a, b, c, d, e, f = values
    return a, b, c, d, e, f
