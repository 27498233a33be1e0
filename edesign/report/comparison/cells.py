"""What a comparison with reference values consists of: cells, changes, tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

_ROUNDING = 1e-9  # of a difference that is to be equal to its bar


@dataclass(frozen=True)
class ComparedCell:
    """A printed value and the value of the archive in its place, both in `unit`.

    Attributes:
        quantity: label of the row.
        source: measure, or group and variable of the archive.
        found: None if the archive does not have it; `reason` says why.
        within: largest difference allowed, relative to the reference; None: no bar.
        note: on the printed value.
        statistic: over records; "" for a variable.
        variant, level: of a response, else "".
        index: storey, mode ... of a variable, else "".
        count, of: the value is made of `count` of `of` histories; 0 of 0 for a variable.
        missing: names of the histories without a value.
    """

    quantity: str
    source: str
    unit: str
    reference: float
    found: float | None
    within: float | None = None
    note: str = ""
    statistic: str = ""
    variant: str = ""
    level: str = ""
    index: str = ""
    count: int = 0
    of: int = 0
    missing: tuple[str, ...] = ()
    reason: str = ""

    @property
    def difference(self) -> float | None:
        """The relative difference (found - reference) / |reference|; None without a value or if the reference is 0."""
        if self.found is None or self.reference == 0.0:
            return None
        return (self.found - self.reference) / abs(self.reference)

    @property
    def inside(self) -> bool | None:
        """Whether the difference is within the bar, which a missing value is not; None without a bar."""
        if self.within is None:
            return None
        return self.difference is not None and abs(self.difference) <= self.within * (1.0 + _ROUNDING)


@dataclass(frozen=True)
class ComparedChange:
    """The change from one variant to another that is printed, and the one found; both ratios.

    Attributes:
        quantity: label of the row.
        of, against: variants; the change is (of - against) / against.
        found: None where one of the two is missing.
    """

    quantity: str
    of: str
    against: str
    level: str
    reference: float
    found: float | None
    note: str = ""

    @property
    def difference(self) -> float | None:
        """The difference of the two changes, `found` minus `reference`; None if nothing was found."""
        return None if self.found is None else self.found - self.reference


@dataclass(frozen=True)
class ComparedTable:
    """A table of a reference file beside an archive; `over` is the dimension of variables, "" for responses."""

    title: str
    kind: Literal["responses", "variables"]
    cells: tuple[ComparedCell, ...]
    changes: tuple[ComparedChange, ...] = ()
    over: str = ""
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Comparison:
    """An archive beside a reference file.

    Attributes:
        archive, reference: the files.
        title: of the reference.
        reasons: why a history has no value, by its name.
        notes: on the whole.
    """

    archive: str
    reference: str
    title: str
    tables: tuple[ComparedTable, ...]
    reasons: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def cells(self) -> tuple[ComparedCell, ...]:
        """The cells of all tables."""
        return tuple(cell for table in self.tables for cell in table.cells)

    @property
    def absent(self) -> tuple[ComparedCell, ...]:
        """The printed values for which the archive has no value."""
        return tuple(cell for cell in self.cells if cell.found is None)

    @property
    def outside(self) -> tuple[ComparedCell, ...]:
        """The cells that are outside their bars."""
        return tuple(cell for cell in self.cells if cell.inside is False)
