"""How members are modelled."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.positions import Place, Position
from edesign.project.reading.base import Model

GeometryKind = Literal["linear", "p_delta", "corotational"]


class Geometry(Model):
    """Geometric transformation of each kind of member.

    Attributes:
        columns: geometric transformation of columns; P-Delta effects need `p_delta` or `corotational`.
        beams: geometric transformation of beams.
        braces: geometric transformation of braces.
    """

    columns: GeometryKind = "p_delta"
    beams: GeometryKind = "linear"
    braces: GeometryKind = "linear"


class RigidEnds(Model):
    """Ends of members that do not bend.

    Attributes:
        columns: rigid end of columns: a length, or its share of half the depth of the deepest beam at the node.
        beams: rigid end of beams: a length, or its share of half the depth of the deepest column at the node.
    """

    columns: Place = Position(0.0, True)
    beams: Place = Position(0.0, True)


class Elements(Model):
    """Gauss-Lobatto points along a fibre member, geometric transformations, and rigid ends.

    Attributes:
        integration_points: Gauss-Lobatto points along a member with fibres, or along each piece between loads on it.
        geometry: geometric transformation of each kind of member.
        rigid_ends: ends of columns and beams that do not bend.
    """

    integration_points: Annotated[int, Field(ge=2, le=10)] = 5
    geometry: Geometry = Geometry()
    rigid_ends: RigidEnds = RigidEnds()
