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
    """Columns on some lines in some storeys."""

    lines: Lines = ALL_LINES
    storeys: Numbers


class BeamPlaces(Model):
    """Beams in some bays at some floors."""

    bays: Numbers = ALL_NUMBERS
    floors: Numbers


class ColumnRun(ColumnPlaces):
    """Columns of one section and material; a later run overrides an earlier one where they overlap.

    `axis` is that of the section about which they bend in the plane of the frame.
    """

    section: str
    material: str
    axis: SectionAxis = "strong"


class BeamRun(BeamPlaces):
    """Beams of one section and material; a later run overrides an earlier one where they overlap.

    `axis` is that of the section about which they bend in the plane of the frame.
    """

    section: str
    material: str
    axis: SectionAxis = "strong"


class BraceRun(Model):
    """Pin-ended braces; rising and falling are seen from left to right, cross is both.

    A chevron is two braces to the middle of the beam above, a v two from the middle of the beam below. Their buckling
    length is `buckling_length_factor` times the length between nodes. Without `compression` one of each pair is meant
    to act, the one in tension; each then has half its area. With `buckling` they buckle in the analysis.
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
    """Members that the regular grid has and this frame has not."""

    columns: tuple[ColumnPlaces, ...] = ()
    beams: tuple[BeamPlaces, ...] = ()


class Release(Model):
    """Moment releases at member ends; start is the left end of a beam, the lower end of a column."""

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None
    ends: Literal["both", "start", "end"]
