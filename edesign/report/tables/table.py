"""Tables as data: a declaration of columns, and the values of rows. How they look is the matter of whoever prints them.

PERIODS = TableSpec(
    "periods",
    "{analysis}: periods",
    (count("mode", "number"), col("T", S, "period", form=".4f"), col("effective mass", PERCENT, "mass", form=".2f")),
    each="Periods",
)
table = PERIODS.of(modes, analysis=name)
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic

from edesign.notebook import table_html
from edesign.report.tables.cell import Cell, Marked, State, Value
from edesign.report.tables.column import Column, Item
from edesign.report.tables.unit import Unit

Row = tuple[Value, ...]
"""An item that is the values of its row, where no object has them."""
MORE: Column[Any] = Column("...")
"""Stands in a declaration where the columns are that only one table has; without it they are the last."""


ROUNDING = 1e-12
"""Of the largest quantity of a unit in a table: what sums of thousands of doubles, of 2.2e-16 each, leave of zero."""


@dataclass
class Table:
    """A table of values under typed columns.

    Attributes:
        title: one line above.
        columns: what the values of a row are.
        rows: values in SI, as many as columns in each row.
        notes: lines below.
        keys: number of columns, from the first, that name the rows.
        headings: lines across the whole table, each by the number of the row that it stands above.
        each: of a table that each analysis or member has one of: what such tables have in common, and whose this is. In
            files they are one table.
        name: of the table in files; "": it is made of the title.
        headed: whether its headers are printed.
        formulas: whether headers and notes have symbols of formulas.
        names_kept: whether names of analyses stay as they are, where a page says others in words.
        owner: design or variant that it is of, where each has such a table; sheets of workbooks begin with it.
    """

    title: str
    columns: tuple[Column[Any], ...] = ()
    rows: list[list[Value]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    keys: int = 1
    headings: dict[int, str] = field(default_factory=dict)
    each: tuple[str, str] | None = None
    name: str = ""
    headed: bool = True
    formulas: bool = False
    names_kept: bool = False
    owner: str = ""

    @property
    def headers(self) -> list[str]:
        """The headers with units, as printed; [] where they are not."""
        return [column.head for column in self.columns] if self.headed else []

    @property
    def texts(self) -> list[list[str]]:
        """The rows as people read them; what is rounding beside the largest quantity of its unit is 0."""
        least = self._rounding()
        return [
            ["0" if _is_rounding(value, least[i]) else c.text(value) for i, (c, value) in enumerate(pairs)]
            for pairs in (list(zip(self.columns, row, strict=True)) for row in self.rows)
        ]

    def _rounding(self) -> list[float]:
        """For each column the magnitude below which a value is rounding; 0: it has no unit, or no numbers."""
        largest: dict[str, float] = {}
        units = [c.unit.name if isinstance(c.unit, Unit) and c.kind == "number" else "" for c in self.columns]
        for row in self.rows:
            for unit, value in zip(units, row, strict=True):
                if unit and isinstance(value, float) and math.isfinite(value):
                    largest[unit] = max(largest.get(unit, 0.0), abs(value))
        return [ROUNDING * largest.get(unit, 0.0) for unit in units]

    def column(self, name: str) -> list[Value]:
        """Return the values of a column by its name in files."""
        at = [column.in_files for column in self.columns].index(name)
        return [row[at] for row in self.rows]

    def in_words(self, say: Callable[[str], str]) -> Table:
        """Return the table with its texts said in another way; numbers stay."""
        return replace(
            self,
            title=say(self.title),
            columns=tuple(replace(column, header=say(column.header)) for column in self.columns),
            rows=[[_said(value, say) for value in row] for row in self.rows],
            notes=[say(note) for note in self.notes],
        )

    def _repr_html_(self) -> str:
        return table_html(self.title, self.headers, self.texts, self.notes, self.keys)


def _is_rounding(value: Value, least: float) -> bool:
    return isinstance(value, float) and 0.0 < abs(value) < least


def state_of(value: Value) -> State:
    """Return whether a value is a good, bad or open verdict, "" for any other value."""
    return value.state if isinstance(value, Cell) else ""


def _said(value: Value, say: Callable[[str], str]) -> Value:
    if isinstance(value, str):
        return say(value)
    return value.in_words(say) if isinstance(value, Cell) else value


@dataclass(frozen=True)
class TableSpec(Generic[Item]):
    """What a table is: its name, its title, its columns.

    Attributes:
        name: by which the table is known, and of its file.
        title: one line; it may have words in braces that `of` is given, as may headers and notes: `{whose}: periods`.
        columns: in the order in which they are printed.
        notes: lines below, where there are rows.
        signs: notes on marks of values, `*: of the column base`; each is printed where a value has the mark it begins
            with.
        keys: number of columns, from the first, that name the rows.
        each: title of the one table that files have where each analysis or member has one.
        formulas: whether headers and notes have symbols of formulas; they have if a column is one of formulas.
        headed: whether headers are printed; a table of notes alone has none.
        optional: whether each column is left out where no row has a value.
        named_by_title: whether files are named by the title, as it distinguishes studies.
        named_as: name of the file of tables that share one; "": `name`.
        names_kept: see `Table`.
        most: rows that are printed; 0: all.
        cut: note of a table with more rows: `The first {shown} of {all} column bases.`, or `and {more} more`
    """

    name: str
    title: str
    columns: tuple[Column[Item], ...]
    notes: Sequence[str] = ()
    signs: tuple[str, ...] = ()
    keys: int = 1
    each: str = ""
    formulas: bool = False
    headed: bool = True
    optional: bool = False
    named_by_title: bool = False
    named_as: str = ""
    names_kept: bool = False
    most: int = 0
    cut: str = ""

    def of(
        self,
        items: Iterable[Item],
        *,
        more: Sequence[Column[Item]] = (),
        without: Collection[str] = (),
        notes: Iterable[str] = (),
        units: Mapping[str, Unit] | None = None,
        heading: Callable[[Item], str] | None = None,
        whose: str = "",
        owner: str = "",
        **words: object,
    ) -> Table:
        """Return the table of some items.

        Args:
            items: a row each; one may be a tuple of the values (`Row`), in the order of the columns.
            more: columns that only this table has, in the place of `MORE`.
            without: names of columns that it has not.
            notes: lines below those of the declaration.
            units: of columns that leave them open, by their key.
            heading: of an item; where it changes, it stands across the table.
            whose: the analysis or member whose table it is, where each has one; `{whose}` in the title.
            owner: see `Table`.
            **words: for what is in braces in title, headers and notes.
        """
        words = {"whose": whose, **words}
        declared = [column for column in self.columns if column.in_files not in without]
        at = declared.index(MORE) if MORE in declared else len(declared)
        made = [*declared[:at], *more, *declared[at + 1 :]]
        chosen = list(items)
        shown = chosen[: self.most] if self.most else chosen
        rows = [[column.of(item, number) for number, column in enumerate(made)] for item in shown]
        needed = [not (self.optional or column.optional) for column in made]
        kept = [i for i, always in enumerate(needed) if always or any(row[i] is not None for row in rows)]
        lines = [note.format(**words) for note in self.notes] if rows else []
        if len(shown) < len(chosen):
            counts = {"shown": len(shown), "all": len(chosen), "more": len(chosen) - len(shown)}
            lines.append(self.cut.format(**counts, **words))
        marks = {value.after.strip()[:1] for row in rows for value in row if isinstance(value, Marked)}
        lines += [note for note in self.signs if note[0] in marks]
        return Table(
            title=self.title.format(**words),
            columns=tuple(_worded(made[i], words, units or {}) for i in kept),
            rows=[[row[i] for i in kept] for row in rows],
            notes=[*lines, *notes],
            keys=self.keys,
            headings=_headings(shown, heading) if heading is not None else {},
            each=(self.each, whose) if self.each else None,
            name="" if self.named_by_title else self.named_as or self.name,
            headed=self.headed and bool(kept),
            formulas=self.formulas or any(column.symbols for column in made),
            names_kept=self.names_kept,
            owner=owner,
        )


def _worded(column: Column[Item], words: Mapping[str, object], units: Mapping[str, Unit]) -> Column[Item]:
    unit = units[column.unit] if isinstance(column.unit, str) else column.unit
    header = column.header.format(**words) if "{" in column.header else column.header
    return replace(column, unit=unit, header=header)


def _headings(items: Sequence[Item], heading: Callable[[Item], str]) -> dict[int, str]:
    found: dict[int, str] = {}
    last = ""
    for number, item in enumerate(items):
        words = heading(item)
        if words != last:
            found[number] = last = words
    return found
