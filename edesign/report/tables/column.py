"""Columns of tables: header, unit, digits, and where the value of a row comes from.

A column is made by `col` (numbers), `count` (whole numbers), `text`, `formula` or `verdict`:

    col("drift", PERCENT, lambda storey: storey.drift, digits=3)   prints `drift [%]` and, for 0.01234, `1.23`
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from numbers import Real
from operator import attrgetter
from typing import Any, Generic, Literal, TypedDict, TypeVar, Unpack, cast

import numpy as np

from edesign.report.tables.cell import Cell, Marked, Plain, Value
from edesign.report.tables.number import significant
from edesign.report.tables.unit import ONE, Unit

Item = TypeVar("Item")
"""What a row of a table is made of."""
Source = Callable[[Item], Any] | str
"""The value of an item in SI: a function of it, its attribute, `mode.share` too, or its key where it is a mapping."""
NO_VALUE = ("", "-")
"""Texts that stand for what is missing."""


@dataclass(frozen=True)
class Column(Generic[Item]):
    """A column of a table.

    Attributes:
        header: without the unit, which stands behind it in brackets, or in the place of `[]`.
        value: of an item; "": its key or attribute that is named as the header; of a tuple, what stands at the place of
            the column.
        kind: numbers stand right, texts left.
        unit: of its numbers; a str is the key of a unit that the table is made with.
        digits: significant ones.
        form: of Python's, such as `.2f`, in place of significant digits.
        negligible: magnitude in SI below which a number is rounding, and printed as 0.
        mark: sign behind the value of an item, "" for none.
        missing: what is printed for None.
        name: in files; "": the header.
        optional: whether the column is left out where no row has a value.
        broken: where a table is too wide for a terminal, columns are broken into lines in this order; 0: not at all.
        joined: whether it stays beside the column before it where a wide table is cut.
        bare: whether the unit stands in the header without brackets.
        silent: whether the header says no unit, as the title does.
        as_shown: whether files have the printed text too.
        symbols: whether its cells are formulas.
    """

    header: str
    value: Source[Item] = ""
    kind: Literal["number", "count", "text", "verdict"] = "number"
    unit: Unit | str = ONE
    digits: int = 4
    form: str = ""
    negligible: float = 0.0
    mark: Callable[[Item], str] | None = None
    missing: str = "-"
    name: str = ""
    optional: bool = False
    broken: int = 0
    joined: bool = False
    bare: bool = False
    silent: bool = False
    as_shown: bool = False
    symbols: bool = False

    @property
    def numeric(self) -> bool:
        """Whether it is a column of numbers."""
        return self.kind in ("number", "count")

    @property
    def head(self) -> str:
        """The header with its unit, as printed."""
        unit = self._unit.name
        sign = "" if not unit or self.silent else unit if self.bare else f"[{unit}]"
        if "[]" in self.header:
            return self.header.replace("[]", sign).replace("  ", " ").strip()
        return f"{self.header} {sign}" if sign else self.header

    @property
    def in_files(self) -> str:
        """The name in files, without the unit."""
        return self.name or " ".join(self.header.replace("[]", "").split())

    @property
    def unit_in_files(self) -> str:
        """The unit of its numbers in files."""
        return self._unit.in_files

    @property
    def _unit(self) -> Unit:
        assert isinstance(self.unit, Unit), f"column {self.header}: no unit {self.unit!r}"
        return self.unit

    def text(self, value: Value) -> str:
        """Return a value as people read it."""
        if isinstance(value, Cell):
            return value.text(self)
        if value is None:
            return self.missing
        if isinstance(value, str):
            return value
        if self.kind == "count":
            return f"{value:.0f}"
        if abs(value) < self.negligible:
            return "0"
        return format(self._shown(value), self.form) if self.form else significant(self._shown(value), self.digits)

    def data(self, value: Value) -> Plain:
        """Return what files get of a value: the number in the unit of the column with all digits, a text, or None."""
        if isinstance(value, Cell):
            return value.data(self)
        if value is None or value in NO_VALUE:
            return None
        if self.as_shown:
            return self.text(value)
        if isinstance(value, str):
            return value
        if self.kind == "count":
            return int(value) if float(value).is_integer() else float(value)
        if abs(value) < self.negligible:
            return 0.0
        shown = self._shown(value)
        return shown if self.form and isinstance(shown, int) else float(shown)

    def of(self, item: Item, number: int = 0) -> Value:
        """Return the value of an item, in SI, with its mark; of a tuple that which stands at the column's number."""
        found: Any
        if type(item) is tuple and not self.value:
            found = cast(tuple[Any, ...], item)[number]
        elif isinstance(self.value, str):
            found = _named(item, self.value or self.header)
        else:
            found = self.value(item)
        value = _plain(found, self.numeric)
        sign = self.mark(item) if self.mark is not None else ""
        return Marked(value, sign) if sign else value

    def _shown(self, value: float) -> float:
        return value if self._unit.si == 1.0 else value / self._unit.si


class Options(TypedDict, total=False):
    """What any column may say of itself; see `Column`."""

    missing: str
    name: str
    optional: bool
    broken: int
    joined: bool
    bare: bool
    silent: bool
    as_shown: bool
    mark: Callable[[Any], str] | None


def col(
    header: str,
    unit: Unit | str,
    value: Source[Item] = "",
    digits: int = 4,
    *,
    form: str = "",
    negligible: float = 0.0,
    **options: Unpack[Options],
) -> Column[Item]:
    """Return a column of numbers.

    Args:
        header: without the unit.
        unit: that is printed.
        value: of an item, SI; None where it is missing, a text where no number can say it. Not given: what the header
            names.
        digits: significant ones.
        form: of Python's, in place of digits: `.2f`.
        negligible: magnitude in SI below which a number is printed as 0.
        **options: see `Column`.
    """
    return Column(header, value, "number", unit, digits, form, negligible, **options)


def count(header: str, value: Source[Item] = "", **options: Unpack[Options]) -> Column[Item]:
    """Return a column of whole numbers; arguments as of `col`."""
    return Column(header, value, "count", **options)


def text(header: str, value: Source[Item] = "", **options: Unpack[Options]) -> Column[Item]:
    """Return a column of texts; arguments as of `col`."""
    return Column(header, value, "text", **options)


def formula(header: str, value: Source[Item] = "", **options: Unpack[Options]) -> Column[Item]:
    """Return a column of formulas such as `N_b,y,Rd / gamma_M1`; arguments as of `col`."""
    return Column(header, value, "text", symbols=True, **options)


def verdict(header: str, value: Source[Item] = "", **options: Unpack[Options]) -> Column[Item]:
    """Return a column of verdicts, whose cells are `Verdict`; arguments as of `col`."""
    return Column(header, value, "verdict", **options)


def known(name: str) -> Callable[[Any], float | None]:
    """Return the function that gives a value of an item by its name; None where it is not a number, NaN."""
    return lambda item: None if math.isnan(value := _named(item, name)) else value


def bounded(name: str) -> Callable[[Any], Any]:
    """Return the function that gives a value of an item by its name; None where it is infinite or not a number."""
    return lambda item: None if isinstance(value := _named(item, name), Real) and not math.isfinite(value) else value


def _named(item: Any, name: str) -> Any:
    return item[name] if isinstance(item, Mapping) else attrgetter(name)(item)


def literal(name: str) -> str:
    """Return a name of users as a header: its braces are none of a declaration."""
    return name.replace("{", "{{").replace("}", "}}")


def _plain(value: Any, numeric: bool) -> Value:
    """A value without types of numpy; whatever stands in a column of texts is one."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.item()
    if value is None or isinstance(value, (Cell, str)):
        return cast(Value, value)
    return cast(Value, value) if numeric else str(value)
