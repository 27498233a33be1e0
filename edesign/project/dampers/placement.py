"""The search for a placement of dampers in a study file: candidate places, a catalogue with costs, limits."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.analysis.damping import State
from edesign.project.dampers.dampers import Brace, Count, Layers
from edesign.project.dampers.verification import PlacementVerify
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.several import ShortName
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    Factor,
    PositiveArea,
    PositiveFactor,
    PositiveLength,
    UnitRatio,
)
from edesign.project.reading.base import Model

Kind = Literal["chevron", "rising", "falling", "storey"]


class CatalogueItem(Model):
    """What one place may be equipped with: `number` equal dampers side by side behind their braces.

    Sizes are those of a device of a project file, one value each. `kind` replaces that of the design; `cost` is that of
    one damper, in any currency.
    """

    law: str
    number: Count = 1
    layers: Layers | None = None
    layer_area: PositiveArea | None = None
    layer_thickness: PositiveLength | None = None
    scale: PositiveFactor | None = None
    design_deformation: PositiveLength | None = None
    brace: Brace = "rigid"
    kind: Kind | None = None
    cost: PositiveFactor


class Costs(Model):
    """What is paid beside the dampers: for each equipped place (brace, connections), storey, and bay."""

    place: Factor = 0.0
    storey: Factor = 0.0
    bay: Factor = 0.0


class LayoutLimits(Model):
    """Which layouts are allowed.

    `most_dampers` counts dampers; `mirrored` layouts are symmetric about the middle of the frame. `continuous` ones
    have no empty storey below a damper of the same bay, down to the lowest candidate. The storeys of each of
    `storey_groups` are equipped alike.
    """

    most_dampers: Annotated[int, Field(ge=1, le=100_000)] | None = None
    mirrored: bool = False
    continuous: bool = False
    storey_groups: tuple[Numbers, ...] = ()


class PlacementDesign(Model):
    """The layout of least cost with which histories meet the criteria.

    `level` is the hazard level whose spectrum the estimates take that put candidates in order; without it the first of
    `verify`. `monotone` lets the search leave out layouts on the assumption that more dampers never harm.
    """

    method: Literal["placement"]
    kind: Kind
    bays: Numbers
    storeys: Numbers = ALL_NUMBERS
    catalogue: Annotated[dict[ShortName, CatalogueItem], Field(min_length=1, max_length=8)]
    costs: Costs = Costs()
    limits: LayoutLimits = LayoutLimits()
    temperature: Temperature | None = None
    state: State = "gravity"
    level: str | None = None
    inherent_damping: UnitRatio | None = None
    monotone: bool = True
    verify: PlacementVerify

    def kinds_of(self, item: CatalogueItem) -> tuple[Kind, ...]:
        """The kinds in which an item may stand: diagonals of mirrored layouts lean both ways."""
        kind = item.kind or self.kind
        return ("rising", "falling") if self.limits.mirrored and kind in ("rising", "falling") else (kind,)
