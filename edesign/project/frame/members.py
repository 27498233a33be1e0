"""Where columns, beams and braces stand, which are missing, and which ends are released."""

from __future__ import annotations

from typing import Literal

from edesign.project.frame.braces import BraceBuckling
from edesign.project.frame.sections import SectionAxis
from edesign.project.notation.selections import ALL_LINES, ALL_NUMBERS, Lines, Numbers
from edesign.project.notation.units import BucklingLengthFactor
from edesign.project.reading.base import Model

BraceKind = Literal["rising", "falling", "cross", "chevron", "v"]


class ColumnPlaces(Model):
    """Columns on some lines in some storeys.

    Attributes:
        lines: column lines, named A, B, ... from the left.
        storeys: storeys, counted from 1 at the bottom.
    """

    lines: Lines = ALL_LINES
    storeys: Numbers


class BeamPlaces(Model):
    """Beams in some bays at some floors.

    Attributes:
        bays: bays, counted from 1 at the left.
        floors: floors, counted from 1; floor s closes storey s.
    """

    bays: Numbers = ALL_NUMBERS
    floors: Numbers


class ColumnRun(ColumnPlaces):
    """Columns of one section and material; a later run overrides an earlier one where they overlap.

    Attributes:
        section: name of a profile of the catalogue, such as `HEB450`, of a hollow section, or of `sections`.
        material: one of `materials`.
        axis: axis of the section about which the columns bend in the plane of the frame.
    """

    section: str
    material: str
    axis: SectionAxis = "strong"


class BeamRun(BeamPlaces):
    """Beams of one section and material; a later run overrides an earlier one where they overlap.

    Attributes:
        section: name of a profile of the catalogue, such as `IPE450`, of a hollow section, or of `sections`.
        material: one of `materials`.
        axis: axis of the section about which the beams bend in the plane of the frame.
    """

    section: str
    material: str
    axis: SectionAxis = "strong"


class BraceRun(Model):
    """Pin-ended braces; rising and falling are seen from left to right, cross is both.

    Attributes:
        bays: bays in which the braces stand, counted from 1.
        storeys: storeys in which the braces stand, counted from 1.
        kind: how they stand, seen from left to right; a cross is two braces, a chevron meets the beam above, a v that
            below.
        section: name of a profile of the catalogue, of a hollow section, or of `sections`.
        material: one of `materials`.
        compression: whether they count in compression; if not, each has half its area (EN 1998-1, 6.7.2(2)P).
        buckling_length_factor: buckling length over the length between nodes, at least 0.1.
        buckling: the braces buckle in the analysis; `{}` takes all defaults, without the key they do not.
    """

    bays: Numbers
    storeys: Numbers
    kind: BraceKind
    section: str
    material: str
    compression: bool = True
    buckling_length_factor: BucklingLengthFactor = 1.0
    buckling: BraceBuckling | None = None


class Missing(Model):
    """Members that the regular grid has and this frame has not.

    Attributes:
        columns: columns of the grid that do not stand.
        beams: beams of the grid that do not stand.
    """

    columns: tuple[ColumnPlaces, ...] = ()
    beams: tuple[BeamPlaces, ...] = ()


class Release(Model):
    """Moment releases at member ends; start is the left end of a beam, the lower end of a column.

    Attributes:
        beams: beams whose ends are released; this key or `columns`.
        columns: columns whose ends are released; this key or `beams`.
        ends: released ends; the start is the left end of a beam, the lower end of a column.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None
    ends: Literal["both", "start", "end"]
