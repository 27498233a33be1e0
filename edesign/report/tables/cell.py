"""Cells of tables that say more than a number or a text: verdicts, marks, ranges, numbers with units of their own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

from edesign.report.tables.unit import Unit

if TYPE_CHECKING:
    from edesign.report.tables.column import Column

State = Literal["good", "bad", "open", ""]
Plain = float | int | str | bool | None
"""What a file can hold."""


class Cell:
    """A value that knows how its column prints it, and what of it goes into files."""

    state: State = ""
    """Of a verdict; "" for anything else."""

    def text(self, column: Column) -> str:
        """Return the cell as people read it in a column."""
        raise NotImplementedError

    def data(self, column: Column) -> Plain:
        """Return what files get: the number in the unit of the column, or a text."""
        return self.text(column)

    def own_unit(self) -> str:
        """Return the unit that the cell is printed with; "" where it has that of the column."""
        return ""

    def in_words(self, say: Callable[[str], str]) -> Cell:
        """Return the cell with its words said in another way."""
        return self


Value = Plain | Cell


@dataclass(frozen=True)
class Verdict(Cell):
    """An answer: its words, and whether it is a good one.

    Attributes:
        words: such as `not met`.
        state: good, bad, or open; it gives the colour.
    """

    words: str
    state: State

    def text(self, column: Column) -> str:
        """Return its words."""
        return self.words

    def in_words(self, say: Callable[[str], str]) -> Verdict:
        """Return the verdict in other words."""
        return replace(self, words=say(self.words))


def yes_or_no(good: bool) -> Verdict:
    """Return whether something is as it should be."""
    return Verdict("yes", "good") if good else Verdict("no", "bad")


@dataclass(frozen=True)
class Marked(Cell):
    """A value with signs before or behind it: `1.2*`, `> 100`, `3.4 % (mean of 20)`. In files it is the value alone.

    Attributes:
        value: of any kind.
        after: printed behind the value.
        before: printed before it.
    """

    value: Value
    after: str = ""
    before: str = ""

    def text(self, column: Column) -> str:
        """Return the value with its signs."""
        return f"{self.before}{column.text(self.value)}{self.after}"

    def data(self, column: Column) -> Plain:
        """Return the number; a text, or what is missing, keeps its signs."""
        found = column.data(self.value)
        return self.text(column) if found is None or isinstance(found, str) else found

    def own_unit(self) -> str:
        """Return the unit of the value."""
        return self.value.own_unit() if isinstance(self.value, Cell) else ""

    def in_words(self, say: Callable[[str], str]) -> Marked:
        """Return it with a text in other words."""
        if isinstance(self.value, str):
            return Marked(say(self.value), self.after, self.before)
        return replace(self, value=self.value.in_words(say)) if isinstance(self.value, Cell) else self


@dataclass(frozen=True)
class Quantity(Cell):
    """A number with a unit of its own, in a column of several.

    Attributes:
        value: in SI; None where it is missing.
        unit: of this number.
        digits: significant ones.
        form: of Python's, in place of digits.
        negligible: magnitude in SI below which it is 0.
        beside: whether the unit stands in another column, so that this one prints the number alone.
    """

    value: float | None
    unit: Unit
    digits: int = 4
    form: str = ""
    negligible: float = 0.0
    beside: bool = False

    def text(self, column: Column) -> str:
        """Return the number with its unit."""
        unit = "" if self.beside or not self.unit.name or self.value is None else f" {self.unit.name}"
        return self._column(column).text(self.value) + unit

    def data(self, column: Column) -> Plain:
        """Return the number in its own unit."""
        return self._column(column).data(self.value)

    def own_unit(self) -> str:
        """Return its unit, unless another column says it."""
        return "" if self.beside or self.value is None else self.unit.name

    def _column(self, column: Column) -> Column:
        return replace(
            column, kind="number", unit=self.unit, digits=self.digits, form=self.form, negligible=self.negligible
        )


@dataclass(frozen=True)
class Rounded(Cell):
    """A number with digits of its own, such as those that its error leaves.

    Attributes:
        words: the number as it is printed.
        value: in the unit that is printed.
    """

    words: str
    value: float

    def text(self, column: Column) -> str:
        """Return the number as it is printed."""
        return self.words

    def data(self, column: Column) -> Plain:
        """Return the number with all digits."""
        return float(self.value)


@dataclass(frozen=True)
class Listed(Cell):
    """Several values in one cell, each printed as the column prints it; a text in files.

    Attributes:
        values: of any kind.
        between: what separates them.
    """

    values: tuple[Value, ...]
    between: str = ", "

    def text(self, column: Column) -> str:
        """Return the values behind each other."""
        return self.between.join(column.text(value) for value in self.values) or column.missing
