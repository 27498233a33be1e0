"""A table as data: what it says, not how it looks. Cells that show numbers keep them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from edesign.notebook import table_html

SCIENTIFIC = 1e7  # from here on a number is no measure of a building, only a sign that something went wrong


class NumberText(str):
    """The text of a number, rounded for people, that keeps the number itself for files and programs.

    Args:
        text: as shown.
        value: the number in the unit that is shown; the only other truth about it is the text, which is made from it.
        unit: that the text ends in, where the numbers of a column have several.
    """

    value: float
    unit: str

    def __new__(cls, text: str, value: float = math.nan, unit: str = "") -> NumberText:
        """Make the text; see the class for its arguments."""
        made = super().__new__(cls, text)
        made.value, made.unit = value, unit
        return made


@dataclass
class Table:
    """A table of texts under headers that carry the units; cells of numbers are `NumberText`.

    Attributes:
        title: one line above.
        columns: headers.
        rows: cells, as many as columns in each row.
        notes: lines below.
        left: number of columns, from the first, that hold text and are aligned left.
        sentences: number of the column, from 0, whose cells may be broken into lines where the table is too wide; of
            several the first is broken first.
        formulas: numbers of the columns, from 0, whose cells are formulas: `N_b,y,Rd / gamma_M1`; headers and notes of
            the table are so too. None: there are no formulas in it.
        joined: numbers of the columns, from 0, that stay beside the column before them where a wide table is cut.
        headings: lines across the whole table, each by the number of the row that it stands above.
        each: of a table that each analysis or member has one of: what such tables have in common, and whose this is. In
            files they are one table.
        name: of the table in files; it stays when the title changes. "": it is made of the title.
        units: of the columns whose headers name none, where the title says it to people; () if there are none.
    """

    title: str
    columns: Sequence[str] = ()
    rows: list[list[str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    left: int = 1
    sentences: int | tuple[int, ...] | None = None
    formulas: tuple[int, ...] | None = None
    joined: tuple[int, ...] = ()
    headings: dict[int, str] = field(default_factory=dict)
    each: tuple[str, str] | None = None
    units: Sequence[str] = ()
    name: str = ""

    def _repr_html_(self) -> str:
        return table_html(self.title, self.columns, self.rows, self.notes, self.left)

    @property
    def sentence_columns(self) -> tuple[int, ...]:
        """Numbers of the columns that may be broken into lines."""
        if self.sentences is None:
            return ()
        return (self.sentences,) if isinstance(self.sentences, int) else self.sentences


def number(value: float | None, digits: int = 4, scale: float = 1.0, negligible: float = 0.0) -> str:
    """Return a number with significant digits, "-" for None.

    Args:
        value: in SI.
        digits: significant digits.
        scale: the unit shown, in SI (1e3 for kN).
        negligible: smaller values, in SI, are rounding and are shown as 0.
    """
    if value is None:
        return "-"
    if abs(value) < negligible:
        return NumberText("0", 0.0)
    shown = value / scale
    if abs(shown) >= SCIENTIFIC:
        return NumberText(f"{shown:.{digits - 1}e}", float(shown))
    text = f"{shown:.0f}" if abs(shown) >= 10**digits else f"{shown:#.{digits}g}".rstrip(".")
    return NumberText(text, float(shown))


def formatted(value: float | None, form: str) -> str:
    """Return a number in a form of Python's, "-" for None.

    Args:
        value: in the unit shown; whole numbers stay whole.
        form: `.2f`, `.4g`, `d`.
    """
    if value is None:
        return "-"
    return NumberText(format(value, form), int(value) if isinstance(value, (int, np.integer)) else float(value))


def marked(text: str, mark: str, unit: str = "") -> str:
    """Return a number with a mark or its unit behind it, still as a number: `1.2*`, `3.4 %`; a text with the same.

    Args:
        text: the text.
        mark: the mark or unit.
        unit: the unit.
    """
    shown = f"{text}{mark}{' ' * bool(unit)}{unit}"
    return NumberText(shown, text.value, unit) if isinstance(text, NumberText) else shown


def said_of(cell: str, words: str) -> str:
    """Return the text of a number with words behind it, still as a number: `3.4 % (mean of 20)`.

    Args:
        cell: the text of the number.
        words: the words behind the number, with the blank before them.
    """
    return NumberText(f"{cell}{words}", cell.value, cell.unit) if isinstance(cell, NumberText) else f"{cell}{words}"


def whole(value: float | None) -> str:
    """Return a count, "-" for None."""
    if value is None:
        return "-"
    return NumberText(f"{value:.0f}", int(value) if float(value).is_integer() else float(value))


def seconds(value: float | None) -> str:
    """Return a time in s to the millisecond, so that a column of them can be compared; "-" for None."""
    return formatted(value, ".3f")


def finite(value: Any) -> Any:
    """Return `value` with None in place of every number that is not finite, which JSON cannot hold."""
    if isinstance(value, Mapping):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
