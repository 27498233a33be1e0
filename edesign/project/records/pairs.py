"""Pairs of horizontal components for buildings: where they come from, and how they act on the building."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator

from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.records.records import (
    ChosenRecords,
    CombinedSpectrum,
    Component,
    FemaP695Record,
    FileRecord,
    PairRecord,
    RecordsOfSuite,
    StructdynRecord,
    SuiteRecords,
    TwoComponents,
)

Axis = Literal["x", "y"]


def _both_axes(value: Any) -> Any:
    if not isinstance(value, (tuple, list)) or sorted(map(str, value)) != ["x", "y"]:
        raise refuse("the axes of both components are needed, `[x, y]` or `[y, x]` [E-VALUE-03]")
    return tuple(value)


class _InSpace(Model):
    """How pairs act on a building in space, and how both components are scaled together.

    Attributes:
        components: axes of the building along which the first and the second component act at the angle zero.
        spectrum: spectrum of both components that `match` compares with that of the hazard; without the key that of
            the code's rule.
    """

    components: Annotated[tuple[Axis, Axis], BeforeValidator(_both_axes)] = ("x", "y")
    spectrum: CombinedSpectrum | None = None


class SuitePairs(RecordsOfSuite, _InSpace):
    """The pairs of a suite file: components of one `pair`, whose directions are `a`, `b`, and `v` for vertical.

    Attributes:
        only: the pairs that are taken, by their numbers; without the key all.
        vertical: whether the vertical components act too.
    """

    only: Numbers = ALL_NUMBERS
    vertical: bool = False


class OnePair(TwoComponents, _InSpace):
    """One pair of components by their files, or from packages.

    Attributes:
        vertical: vertical component of the same recording; without the key there is none.
    """

    vertical: Component | None = None


InSpace = SuitePairs | OnePair
"""Pairs whose components act at once; a reference to one of a suite is `NAME/NUMBER`."""

Pairs = Annotated[SuitePairs | OnePair, OneOf(suite=SuitePairs, pair=OnePair)]

BuildingRecord = Annotated[
    FileRecord | StructdynRecord | FemaP695Record | SuiteRecords | ChosenRecords | SuitePairs | OnePair,
    OneOf(
        "package",
        FileRecord,
        choose=ChosenRecords,
        pair=OnePair,
        components=SuitePairs,
        suite=SuiteRecords,
    ),
]
"""Of a suite, `components` says that its pairs act at once."""

AnyRecord = FileRecord | StructdynRecord | FemaP695Record | SuiteRecords | ChosenRecords | PairRecord | InSpace
"""Of a plane frame or a building."""
