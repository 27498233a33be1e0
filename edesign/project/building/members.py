"""Columns, beams and braces of a building, how their ends are joined, and which members are missing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.building.places import ALL_COLUMN_LINES, ColumnLines
from edesign.project.notation.frames import ALL_FRAMES, Direction, Frames
from edesign.project.notation.quantities import ROTATIONAL_STIFFNESS
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.several import ShortName
from edesign.project.notation.units import (
    NotNegativeLength,
    PositiveLength,
    PositiveStress,
    UnitRatio,
    restraint,
)
from edesign.project.notation.written import Written, as_kept, either, quantity, words_or
from edesign.project.reading.base import Model

BraceKind = Literal["rising", "falling", "alternating", "cross", "chevron", "v"]
CHEVRONS = ("chevron", "v")
"""Braces that meet a beam in the middle of its span."""
NO_LAW_OF_LINKS = (
    "no element of modes, pushovers and histories yields in shear as a seismic link does; links have the elastic design"
)
AS_DEVICES = (
    "analyses in space have buckling-restrained braces as `dampers.devices`, with the same law and the area of the "
    "core over A_sc as `scale`: give them so in a file of their own"
)


def _ends(value: Any) -> Any:
    """One word or stiffness stands for both ends."""
    return value if isinstance(value, Mapping) else {"start": value, "end": value}


End = Annotated[
    Literal["rigid", "pinned"] | float,
    restraint(ROTATIONAL_STIFFNESS, "an end is `rigid`, `pinned`, or has a stiffness", "rigid", "pinned"),
]
"""Of a member about its strong axis: `rigid`, `pinned`, or a rotational stiffness, N m/rad."""


class Ends(Model):
    """The ends of a beam; start is the one with the smaller coordinate.

    A pinned end is free about both axes of the section, but transmits torsion; a stiffness acts about the strong axis.

    Attributes:
        start: the end with the smaller coordinate: `rigid`, `pinned`, or a rotational stiffness about the strong axis.
        end: the other end: `rigid`, `pinned`, or a rotational stiffness about the strong axis.
    """

    start: End = "rigid"
    end: End = "rigid"


class ColumnPlaces(Model):
    """Columns on some column lines in some storeys.

    Attributes:
        at: column lines, such as `A2`, `A`, `A1-C2`.
        storeys: storeys, counted from 1 at the bottom.
    """

    at: ColumnLines = ALL_COLUMN_LINES
    storeys: Numbers = ALL_NUMBERS


class ColumnRun(ColumnPlaces):
    """Columns of one section.

    Attributes:
        section: name of a profile of the catalogue, or of a hollow section.
        material: one of `materials`.
        strong: direction in whose frames the columns bend about their strong axis.
        group: columns of one group are designed as one; without the key the run is a group of its own.
    """

    section: str
    material: str
    strong: Direction
    group: ShortName | None = None


class BeamPlaces(Model):
    """Beams in some bays of some frames of one direction, at some floors.

    Attributes:
        along: direction of the beams.
        frames: frames of this direction, such as `2`, `A-C`.
        bays: bays of the frames, counted from 1.
        floors: floors, counted from 1.
    """

    along: Direction
    frames: Frames = ALL_FRAMES
    bays: Numbers = ALL_NUMBERS
    floors: Numbers = ALL_NUMBERS


class BeamSlab(Model):
    """A slab of concrete that acts with a beam, by full shear connection.

    Attributes:
        thickness: of the concrete; above the ribs where it lies on a profiled deck.
        ribs: height of the ribs of the deck, whose concrete does not count.
        E: modulus of the concrete; for actions that last about half of it (EN 1994-1-1, 5.4.2.2(11)).
        reinforcement: area of the bars along the beam over that of the concrete.
    """

    thickness: PositiveLength
    ribs: NotNegativeLength = 0.0
    E: PositiveStress
    reinforcement: UnitRatio = 0.0


class BeamRun(BeamPlaces):
    """Beams of one section.

    Attributes:
        section: name of a profile of the catalogue, or of a hollow section.
        material: one of `materials`.
        ends: how the ends are joined: `rigid`, `pinned`, a rotational stiffness, or a mapping of both.
        stiffness_factor: by which E I about the strong axis is multiplied, as for a slab that acts with the beam.
        slab: concrete that acts with the beam; the factor on E I follows from it, in place of `stiffness_factor`.
        group: beams of one group are designed as one; without the key the run is a group of its own.
    """

    section: str
    material: str
    ends: Annotated[
        Ends, Written(_ends, either(as_kept, words_or(quantity(ROTATIONAL_STIFFNESS, "positive"), "rigid", "pinned")))
    ] = Ends()
    stiffness_factor: Annotated[float, Field(ge=0.1, le=10.0)] = 1.0
    slab: BeamSlab | None = None
    group: ShortName | None = None


class BraceRun(Model):
    """Pin-ended braces in some bays of some frames of one direction, in some storeys.

    Rising and falling are seen with the axis of the frame to the right. Alternating diagonals rise where bay plus
    storey is even. A cross is two diagonals without a joint between them. A chevron meets the beam above in the middle
    of its span, `v` the beam below.

    With a seismic link braces meet a beam beside it: both of a chevron or `v` at the ends of the link in the middle of
    the span, one diagonal at the distance of the link from the upper column.

    Attributes:
        along: direction of the frames.
        frames: frames of this direction, such as `2`, `A-C`.
        bays: bays of the frames, counted from 1.
        storeys: storeys, counted from 1.
        kind: how the braces stand, seen with the axis of the frame to the right.
        link: length e of the seismic link in the beam that they meet (EN 1998-1, 6.8); without the key none.
        section: name of a profile of the catalogue, or of a hollow section; `BRB25` is a buckling-restrained brace with
            a steel core of 25 cm2.
        material: one of `materials`.
        law: of buckling-restrained braces, one of `dampers.laws` of the type `buckling_restrained`: the values of their
            manufacturer.
        compression: whether braces count in compression; without the key by their kind (EN 1998-1, 6.7.2(2)P).
        group: braces of one group are designed as one; without the key the run is a group of its own.
    """

    along: Direction
    frames: Frames
    bays: Numbers
    storeys: Numbers = ALL_NUMBERS
    kind: BraceKind
    link: PositiveLength | None = None
    section: str
    material: str
    law: str | None = None
    compression: bool | None = None
    group: ShortName | None = None

    @property
    def in_compression(self) -> bool:
        """Whether the analysis counts these braces in compression.

        Source: EN 1998-1:2004, 6.7.2(2)P: of diagonals the tension ones alone, of V bracings both; 6.8: braces beside
            links as well; buckling-restrained braces both ways.
        """
        both = self.kind in CHEVRONS or self.link is not None or self.law is not None
        return both if self.compression is None else self.compression


class Missing(Model):
    """Members that the regular grid has and this building has not.

    Attributes:
        columns: columns of the grid that do not stand.
        beams: beams of the grid that do not stand.
    """

    columns: tuple[ColumnPlaces, ...] = ()
    beams: tuple[BeamPlaces, ...] = ()
