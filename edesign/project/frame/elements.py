"""How members are modelled."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.positions import Place, Position
from edesign.project.reading.base import Model

GeometryKind = Literal["linear", "p_delta", "corotational"]


class Geometry(Model):
    """Geometric transformation of each kind of member."""

    columns: GeometryKind = "p_delta"
    beams: GeometryKind = "linear"
    braces: GeometryKind = "linear"


class RigidEnds(Model):
    """Ends of members that do not bend: their length (m), or its share of half the depth of what the member meets."""

    columns: Place = Position(0.0, True)
    beams: Place = Position(0.0, True)


class Elements(Model):
    """Gauss-Lobatto points along a fibre member, geometric transformations, and rigid ends."""

    integration_points: Annotated[int, Field(ge=2, le=10)] = 5
    geometry: Geometry = Geometry()
    rigid_ends: RigidEnds = RigidEnds()
