"""Where hinges, joints and panel zones stand in a building."""

from __future__ import annotations

from edesign.project.building.members import BeamPlaces, ColumnPlaces
from edesign.project.building.places import ALL_COLUMN_LINES, ColumnLines
from edesign.project.frame.hinges import AnyHinges, AnyJoints, AnyPanelZones


class BuildingHinges(AnyHinges):
    """Plastic hinges about the strong axis, at the ends of members of a building that stay elastic between them.

    Attributes:
        beams: beams that have the hinges; this key or `columns`.
        columns: columns that have the hinges; this key or `beams`.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None


class BuildingJoints(AnyJoints):
    """Semi-rigid joints of a building, which turn about the strong axis; its elastic design knows `ends` of beams.

    Attributes:
        beams: beams whose ends turn; this key or `columns`.
        columns: columns whose ends turn; this key or `beams`.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None


class BuildingPanelZones(AnyPanelZones):
    """Joints whose panel shears where the columns bend about their strong axis; across it they are rigid.

    Attributes:
        at: column lines of the joints.
    """

    at: ColumnLines = ALL_COLUMN_LINES
