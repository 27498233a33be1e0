"""How members are modelled."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.base import Model

GeometryKind = Literal["linear", "p_delta", "corotational"]


class Geometry(Model):
    """Geometric transformation of each kind of member."""

    columns: GeometryKind = "p_delta"
    beams: GeometryKind = "linear"
    braces: GeometryKind = "linear"


class Elements(Model):
    """Gauss-Lobatto points along a fibre member, and geometric transformations."""

    integration_points: Annotated[int, Field(ge=2, le=10)] = 5
    geometry: Geometry = Geometry()
