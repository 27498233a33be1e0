"""Tables of texts, until all tables are declared (`spec.py`), and `typed`, which lets them pass through to renderers.

This file goes with the last of them; nothing new is built on it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.notebook import table_html
from edesign.report.tables import spec
from edesign.report.tables.cell import Cell, Plain, State, Value, Verdict
from edesign.report.tables.column import Column
from edesign.report.tables.number import SCIENTIFIC as SCIENTIFIC
from edesign.report.tables.number import finite as finite
from edesign.report.tables.number import significant
from edesign.report.tables.unit import Unit

_GOOD = {"met", "passed", "satisfied", "completed", "achieved", "yes"}
_BAD = {"not met", "failed", "missed", "collapsed", "collapse", "not achieved", "no"}
_OPEN = {"not run", "interrupted", "open", "undecided", "not decided", "not applicable", "running"}
_UNIT = re.compile(r"\s*\[([^\[\]]+)\]")
_BARE_UNIT = re.compile(r"\s+(%|ms|mm|kN|kJ|J|Hz)$")
_NUMERIC = re.compile(r"(?:[-+−–<>≤≥~±*†\s\d.,%/()]|->|→|e[-+]\d+|nan|inf|of)*")


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


AnyTable = Table | spec.Table


def number(value: float | None, digits: int = 4, scale: float = 1.0, negligible: float = 0.0) -> str:
    """Return a number with significant digits, "-" for None.

    Args:
        value: in SI.
        scale: the unit shown, in SI (1e3 for kN).
        negligible: smaller values, in SI, are rounding and are shown as 0.
    """
    if value is None:
        return "-"
    if abs(value) < negligible:
        return NumberText("0", 0.0)
    shown = value / scale
    return NumberText(significant(shown, digits), float(shown))


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
    """Return a number with a mark or its unit behind it, still as a number: `1.2*`, `3.4 %`; a text with the same."""
    shown = f"{text}{mark}{' ' * bool(unit)}{unit}"
    return NumberText(shown, text.value, unit) if isinstance(text, NumberText) else shown


def said_of(cell: str, words: str) -> str:
    """Return the text of a number with words behind it, still as a number: `3.4 % (mean of 20)`.

    Args:
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


@dataclass(frozen=True)
class _Shown(Cell):
    """The number of a table of texts: as it is printed, and its value in the unit that is printed."""

    shown: str
    value: float
    unit: str

    def text(self, column: Column) -> str:
        """Return the text."""
        return self.shown

    def data(self, column: Column) -> Plain:
        """Return the number."""
        return self.value

    def own_unit(self) -> str:
        """Return the unit that the text ends in."""
        return self.unit


def typed(table: Table | spec.Table) -> spec.Table:
    """Return a table of texts as one of values: units are found in headers, verdicts by their words."""
    if isinstance(table, spec.Table):
        return table
    width = max((len(row) for row in (table.columns, *table.rows)), default=0)
    headers = list(table.columns) or ["what", "value", *(f"value {i}" for i in range(2, width))][:width]
    columns = tuple(_column(table, i, header) for i, header in enumerate(headers))
    rows = [[_cell(cell) for cell in row] for row in table.rows]
    return spec.Table(
        title=table.title,
        columns=columns,
        rows=rows,
        notes=table.notes,
        keys=table.left,
        headings=table.headings,
        each=table.each,
        name=table.name,
        headed=bool(table.columns),
        formulas=table.formulas is not None,
        names_kept=bool(table.columns) and table.columns[0] == "name of the analysis",
    )


def _column(table: Table, number: int, header: str) -> Column:
    name, unit = _name_and_unit(header)
    cells = [row[number] for row in table.rows]
    right = number >= table.left and all(_NUMERIC.fullmatch(cell) for cell in cells)
    said = table.units[number] if table.units else ""
    order = table.sentence_columns
    return Column(
        header,
        kind="number" if right else "text",
        unit=Unit(unit or said),
        name=name,
        broken=order.index(number) + 1 if number in order else 0,
        joined=number in table.joined,
        silent=True,
        symbols=number in (table.formulas or ()),
    )


def _cell(cell: str) -> Value:
    if isinstance(cell, NumberText):
        return _Shown(str(cell), cell.value, cell.unit)
    state = _state(cell)
    return Verdict(cell, state) if state else cell


def _state(cell: str) -> State:
    word = cell.rstrip("0123456789.<> ").strip().lower()  # of cells as `not met 1.20` too
    return "good" if word in _GOOD else "bad" if word in _BAD else "open" if word in _OPEN else ""


def _name_and_unit(header: str) -> tuple[str, str]:
    """The parts of `drift [%]`, and of `root %`, as tables with many columns have it; `[-]` is no unit."""
    match = _UNIT.search(header) or _BARE_UNIT.search(header)
    if match is None:
        return header.strip(), ""
    unit = match[1].strip()
    return (header[: match.start()] + header[match.end() :]).strip(), "" if unit == "-" else unit
