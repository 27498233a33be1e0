"""Columns, beams and braces of a building, how their ends are held, and which members are missing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from edesign.project.building.names import Direction
from edesign.project.building.places import ALL_COLUMN_LINES, ALL_FRAMES, ColumnLines, Frames
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.several import ShortName
from edesign.project.notation.units import ROTATIONAL_STIFFNESS, held
from edesign.project.notation.written import Written, as_kept, either, quantity, words_or
from edesign.project.reading.base import Model

BraceKind = Literal["rising", "falling", "alternating", "cross", "chevron", "v"]
CHEVRONS = ("chevron", "v")
"""Braces that meet a beam in the middle of its span."""


def _ends(value: Any) -> Any:
    """One word or stiffness stands for both ends."""
    return value if isinstance(value, Mapping) else {"start": value, "end": value}


End = Annotated[
    Literal["rigid", "pinned"] | float,
    held(ROTATIONAL_STIFFNESS, "an end is `rigid`, `pinned`, or has a stiffness", "rigid", "pinned"),
]
"""Of a member about its strong axis: `rigid`, `pinned`, or a rotational stiffness, N m/rad."""


class Ends(Model):
    """The ends of a beam; start is the one with the smaller coordinate.

    A pinned end is free about both axes of the section, but transmits torsion; a stiffness acts about the strong axis.
    """

    start: End = "rigid"
    end: End = "rigid"


class ColumnPlaces(Model):
    """Columns on some column lines in some storeys."""

    at: ColumnLines = ALL_COLUMN_LINES
    storeys: Numbers = ALL_NUMBERS


class ColumnRun(ColumnPlaces):
    """Columns of one section; `strong` is the direction in whose frames they bend about their strong axis."""

    section: str
    material: str
    strong: Direction
    group: ShortName | None = None


class BeamPlaces(Model):
    """Beams in some bays of some frames of one direction, at some floors."""

    along: Direction
    frames: Frames = ALL_FRAMES
    bays: Numbers = ALL_NUMBERS
    floors: Numbers = ALL_NUMBERS


class BeamRun(BeamPlaces):
    """Beams of one section."""

    section: str
    material: str
    ends: Annotated[
        Ends, Written(_ends, either(as_kept, words_or(quantity(ROTATIONAL_STIFFNESS, "positive"), "rigid", "pinned")))
    ] = Ends()
    group: ShortName | None = None


class BraceRun(Model):
    """Pin-ended braces in some bays of some frames of one direction, in some storeys.

    Rising and falling are seen with the axis of the frame to the right. Alternating diagonals rise where bay plus
    storey is even. A cross is two diagonals without a joint between them. A chevron meets the beam above in the middle
    of its span, `v` the beam below. `compression`: whether braces count in compression; None is what EN 1998-1,
    6.7.2(2)P says of their kind.
    """

    along: Direction
    frames: Frames
    bays: Numbers
    storeys: Numbers = ALL_NUMBERS
    kind: BraceKind
    section: str
    material: str
    compression: bool | None = None
    group: ShortName | None = None

    @property
    def in_compression(self) -> bool:
        """Whether the analysis counts these braces in compression.

        Source: EN 1998-1:2004, 6.7.2(2)P: of diagonals the tension ones alone, of V bracings both.
        """
        return self.kind in CHEVRONS if self.compression is None else self.compression


class Missing(Model):
    """Members that the regular grid has and this building has not."""

    columns: tuple[ColumnPlaces, ...] = ()
    beams: tuple[BeamPlaces, ...] = ()
