"""Reference files: published or earlier results, as printed, with which an archive is compared."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

from pydantic import AfterValidator, Discriminator, Field, PrivateAttr, Tag, WithJsonSchema

from edesign.project.criteria.measures import SHORT_NAMES
from edesign.project.notation.units import PositiveFactor
from edesign.project.project import Identifier
from edesign.project.reading.base import FormatVersion, Model, by_key, by_shape, refuse
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.problems import did_you_mean, listed

Text = Annotated[str, Field(min_length=1)]
Statistic = Literal["mean", "median", "84%", "maximum", "minimum", "mean_profile"]


def _known_measure(value: str) -> str:
    if value not in SHORT_NAMES:
        hint = did_you_mean(value, SHORT_NAMES)
        raise refuse(f"there is no measure `{value}`{hint} (allowed: {listed(SHORT_NAMES, 40)})")
    return value


class Cell(Model):
    """One printed value.

    `within` is the largest difference that is allowed, relative to it; `note` says what is to be known of it, such as
    a misprint.
    """

    value: float
    within: PositiveFactor | None = None
    note: Text | None = None


Printed = Annotated[Annotated[float, Tag("?plain")] | Annotated[Cell, Tag("?mapping")], Discriminator(by_shape)]
LevelBar = Annotated[
    Annotated[PositiveFactor, Tag("?plain")] | Annotated[dict[Identifier, PositiveFactor], Tag("?mapping")],
    Discriminator(by_shape),
]
Bar = Annotated[
    Annotated[PositiveFactor, Tag("?plain")] | Annotated[dict[Identifier, LevelBar], Tag("?mapping")],
    Discriminator(by_shape),
]
"""One for all, or by variant, or by variant and level."""


class Change(Model):
    """Two variants of which a table prints the change: (`of` - `against`) / `against`."""

    of: Identifier
    against: Identifier


class ResponseRow(Model):
    """A response measure: values by variant and level in `unit`; `change` by level, in per cent.

    `storeys` and `members` restrict a measure of storeys or members to some of them.
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
        """Variant, level and value of each cell."""
        for variant, levels in self.values.items():
            for level, value in levels.items():
                yield variant, level, _cell(value)

    def changes(self) -> Iterator[tuple[str, Cell]]:
        """Level and printed change (per cent)."""
        for level, value in self.change.items():
            yield level, _cell(value)


class ResponseTable(Model):
    """Statistics over records of response measures.

    `statistic` holds for rows that have none of their own; `records` restricts it to the histories of one record or
    suite of the project.
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
        """The bar of a cell (a ratio): its own, that of its row, that of the table."""
        for bar in (cell.within, row.within, self.within):
            found = _bar(bar, variant, level)
            if found is not None:
                return found
        return None


class VariableRow(Model):
    """A variable of a group of the archive: its values in `unit`, in the order of the archive; null leaves one out."""

    variable: Text
    label: Text
    unit: Text
    within: PositiveFactor | None = None
    note: Text | None = None
    values: Annotated[tuple[Printed | None, ...], Field(min_length=1)]

    def cells(self) -> tuple[Cell | None, ...]:
        """The values; None where the source has none to compare."""
        return tuple(None if value is None else _cell(value) for value in self.values)


class VariableTable(Model):
    """Variables of one group of the archive, such as `designs/NAME` or `analyses/NAME`.

    `over` is their dimension (storey, mode); `labels` name its values, otherwise those of the archive do. Of variables
    with further dimensions `at` chooses the place in each of these.
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
        """The bar of a cell (a ratio): its own, that of its row, that of the table."""
        return next((bar for bar in (cell.within, row.within, self.within) if bar is not None), None)


ReferenceTable = Annotated[
    Annotated[ResponseTable, Tag("?kind=responses")] | Annotated[VariableTable, Tag("?kind=variables")],
    Discriminator(by_key("kind")),
]


class Reference(FileModel):
    """A validated reference file; values are as printed, in the units of their rows. Made by `load_reference`."""

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
