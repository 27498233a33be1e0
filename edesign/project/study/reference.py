"""Reference files: published or earlier results, as printed, with which an archive is compared."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Field, PrivateAttr, WithJsonSchema

from edesign.project.analysis_file import Identifier
from edesign.project.criteria.measures import SHORT_NAMES
from edesign.project.notation.units import PositiveFactor
from edesign.project.reading.base import FormatVersion, Model, refuse
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import did_you_mean, listed

Text = Annotated[str, Field(min_length=1)]
Statistic = Literal["mean", "median", "84%", "maximum", "minimum", "mean_profile"]


def _known_measure(value: str) -> str:
    if value not in SHORT_NAMES:
        hint = did_you_mean(value, SHORT_NAMES)
        raise refuse(f"there is no measure `{value}`{hint} (allowed: {listed(SHORT_NAMES, 40)}) [E-NAME-01]")
    return value


class Cell(Model):
    """One printed value.

    Attributes:
        value: value as printed.
        within: largest difference that is allowed, relative to the value.
        note: what is to be known of the value, such as a misprint.
    """

    value: float
    within: PositiveFactor | None = None
    note: Text | None = None


Printed = Annotated[float | Cell, OneOf()]
LevelBar = Annotated[PositiveFactor | dict[Identifier, PositiveFactor], OneOf()]
Bar = Annotated[PositiveFactor | dict[Identifier, LevelBar], OneOf()]
"""One for all, or by variant, or by variant and level."""


class Change(Model):
    """Two variants of which a table prints the change: (`of` - `against`) / `against`.

    Attributes:
        of: variant whose change it is.
        against: variant that it is compared with.
    """

    of: Identifier
    against: Identifier


class ResponseRow(Model):
    """A response measure with its values by variant and level.

    Attributes:
        measure: response measure, without the unit at the end of its name.
        storeys: storeys that count; without the key all.
        members: columns, beams or dampers that count; without the key all.
        label: name of the row for the output.
        unit: unit of the values, such as `cm`; of ratios `%` or `1`.
        statistic: statistic of this row in place of that of the table.
        within: largest difference that is allowed, in place of that of the table.
        note: note on all values of the row.
        values: printed values by variant, then level.
        change: printed change in per cent, by level.
    """

    measure: Annotated[Text, AfterValidator(_known_measure), WithJsonSchema({"enum": sorted(SHORT_NAMES)})]
    storeys: Annotated[tuple[Annotated[int, Field(ge=1)], ...], Field(min_length=1)] | None = None
    members: Annotated[tuple[Text, ...], Field(min_length=1)] | None = None
    label: Text
    unit: Text
    statistic: Statistic | None = None
    within: Bar | None = None
    note: Text | None = None
    values: Annotated[dict[Identifier, dict[Identifier, Printed]], Field(min_length=1)]
    change: dict[Identifier, Printed] = {}

    def cells(self) -> Iterator[tuple[str, str, Cell]]:
        """Yield variant, level and value of each cell."""
        for variant, levels in self.values.items():
            for level, value in levels.items():
                yield variant, level, _cell(value)

    def changes(self) -> Iterator[tuple[str, Cell]]:
        """Level and printed change (per cent)."""
        for level, value in self.change.items():
            yield level, _cell(value)


class ResponseTable(Model):
    """Statistics over records of response measures.

    Attributes:
        kind: statistics of responses.
        title: title of the table.
        source: where the values come from.
        statistic: statistic over the histories, for rows that have none of their own.
        records: record or suite of the project whose histories count; without the key all.
        within: largest difference that is allowed: for all, by variant, or by variant and level.
        change: two variants of which rows print the change, (of - against) / against.
        rows: rows of the table; labels differ.
    """

    kind: Literal["responses"]
    title: Text
    source: Text | None = None
    statistic: Statistic
    records: Text | None = None
    within: Bar | None = None
    change: Change | None = None
    rows: Annotated[tuple[ResponseRow, ...], Field(min_length=1)]

    def bar(self, row: ResponseRow, variant: str, level: str, cell: Cell) -> float | None:
        """Return the bar of a cell (a ratio): its own, that of its row, or that of the table.

        Args:
            level: name of the hazard level.
            cell: the printed value.
        """
        for bar in (cell.within, row.within, self.within):
            found = _bar(bar, variant, level)
            if found is not None:
                return found
        return None


class VariableRow(Model):
    """A variable of a group of the archive.

    Attributes:
        variable: name of the variable in the group.
        label: name of the row for the output.
        unit: unit of the values.
        within: largest difference that is allowed, in place of that of the table.
        note: note on all values of the row.
        values: printed values in the order of the archive; `null` leaves one out.
    """

    variable: Text
    label: Text
    unit: Text
    within: PositiveFactor | None = None
    note: Text | None = None
    values: Annotated[tuple[Printed | None, ...], Field(min_length=1)]

    def cells(self) -> tuple[Cell | None, ...]:
        """Return the values; None where the source has none to compare."""
        return tuple(None if value is None else _cell(value) for value in self.values)


class VariableTable(Model):
    """Variables of one group of the archive, such as `designs/NAME` or `analyses/NAME`.

    Attributes:
        kind: variables of the archive.
        title: title of the table.
        source: where the values come from.
        group: path of the group in the archive.
        over: dimension of the variables, such as `storey` or `mode`.
        at: place in each further dimension.
        labels: names of the values for the output; without the key those of the archive.
        within: largest difference that is allowed.
        rows: rows of the table.
    """

    kind: Literal["variables"]
    title: Text
    source: Text | None = None
    group: Text
    over: Text
    at: dict[Text, Text] = {}
    labels: tuple[Text, ...] | None = None
    within: PositiveFactor | None = None
    rows: Annotated[tuple[VariableRow, ...], Field(min_length=1)]

    def bar(self, row: VariableRow, cell: Cell) -> float | None:
        """Return the bar of a cell (a ratio): its own, that of its row, or that of the table.

        Args:
            cell: the printed value.
        """
        return next((bar for bar in (cell.within, row.within, self.within) if bar is not None), None)


ReferenceTable = Annotated[ResponseTable | VariableTable, OneOf("kind")]


class Reference(FileModel):
    """A reference file: published or earlier results, with which an archive is compared.

    Values are as printed, in the units of their rows. Made by `load_reference`.

    Attributes:
        edesign_reference: version of the file format.
        title: one line for the tables.
        source: where the values come from.
        tables: tables in the order of the output; titles differ.
    """

    edesign_reference: FormatVersion
    title: Text
    source: Text | None = None
    tables: Annotated[tuple[ReferenceTable, ...], Field(min_length=1)]

    _path: Path = PrivateAttr(default=Path("reference.yaml"))


def _cell(value: float | Cell) -> Cell:
    return value if isinstance(value, Cell) else Cell(value=value)


def _bar(bar: float | dict[str, float | dict[str, float]] | None, variant: str, level: str) -> float | None:
    of_variant = bar.get(variant) if isinstance(bar, dict) else bar
    return of_variant.get(level) if isinstance(of_variant, dict) else of_variant
