"""The search for a placement of dampers in a study file: candidate places, a catalogue with costs, limits."""

from __future__ import annotations

from typing import Annotated, Literal, NamedTuple

from pydantic import Field

from edesign.project.analysis.damping import State
from edesign.project.dampers.dampers import (
    AnyChosenBrace,
    BraceSection,
    BraceStiffness,
    ChosenBrace,
    Count,
    Layers,
)
from edesign.project.dampers.verification import PlacementVerify
from edesign.project.notation.frames import Direction, Frames, FrameSelection
from edesign.project.notation.selections import ALL_NUMBERS, Numbers, NumberSelection
from edesign.project.notation.several import Names, ShortName
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    Factor,
    PositiveArea,
    PositiveFactor,
    PositiveLength,
    UnitRatio,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Kind = Literal["chevron", "rising", "falling", "storey"]


ItemBrace = Annotated[
    Literal["rigid"] | BraceStiffness | BraceSection | ChosenBrace | AnyChosenBrace,
    OneOf(
        otherwise=BraceStiffness,
        force=ChosenBrace,
        choose=AnyChosenBrace,
        section=BraceSection,
        material=BraceSection,
    ),
]
"""Braces of an item; without a `force` histories choose the section from lists."""


class CatalogueItem(Model):
    """The equipment of one place: equal dampers side by side behind their brace.

    Attributes:
        law: one of `dampers.laws` of the project.
        number: dampers side by side in a place.
        layers: layers of elastomer; without the key those of the prototype.
        layer_area: area of a layer; without the key that of the prototype.
        layer_thickness: thickness of a layer; without the key that of the prototype.
        scale: factor on the forces of a law without prototype.
        design_deformation: amplitude at which it counts in natural modes; without the key that of the estimate in each
            place.
        brace: brace in series with the dampers of a place; lists without a force get the section that holds the
            histories.
        kind: how the dampers stand, in place of the `kind` of the design.
        cost: cost of one damper, in any currency.
    """

    law: str
    number: Count = 1
    layers: Layers | None = None
    layer_area: PositiveArea | None = None
    layer_thickness: PositiveLength | None = None
    scale: PositiveFactor | None = None
    design_deformation: PositiveLength | None = None
    brace: ItemBrace = "rigid"
    kind: Kind | None = None
    cost: PositiveFactor


class Costs(Model):
    """The costs beside the dampers: for each equipped place (brace, connections), storey, and bay.

    Attributes:
        place: cost of each equipped place, for brace and connections.
        storey: cost of each equipped storey.
        bay: cost of each equipped bay.
    """

    place: Factor = 0.0
    storey: Factor = 0.0
    bay: Factor = 0.0


class LayoutLimits(Model):
    """The limits of the allowed layouts.

    Attributes:
        most_dampers: largest number of dampers.
        mirrored: whether layouts are symmetric about the middle of the frame.
        continuous: whether no place is empty below a damper of its bay, down to the lowest candidate.
        storey_groups: storeys that are equipped alike in each bay, such as `[1-3, 4-6]`.
    """

    most_dampers: Annotated[int, Field(ge=1, le=100_000)] | None = None
    mirrored: bool = False
    continuous: bool = False
    storey_groups: tuple[Numbers, ...] = ()


class CandidatePlaces(Model):
    """Candidate places in frames of one direction of a building; the bays of a frame are equipped alike.

    Attributes:
        along: direction of the frames.
        frames: frames of this direction, such as `2`, `A-C`, `[X1, X4]`.
        bays: bays of each frame, which are equipped alike in a storey.
        storeys: candidate storeys; without the key those of the design.
        tied: whether these frames are equipped alike.
    """

    along: Direction
    frames: Frames
    bays: Numbers
    storeys: Numbers | None = None
    tied: bool = False


class CandidateBays(NamedTuple):
    """Candidate places in bays and storeys, of a building in frames of one direction.

    Attributes:
        along: direction of the frames; None in a plane frame.
        frames: frames of this direction; None in a plane frame.
        bays: bays, counted from 1.
        storeys: storeys, counted from 1.
        tied: whether frames are equipped alike.
    """

    along: Direction | None
    frames: FrameSelection | None
    bays: NumberSelection
    storeys: NumberSelection
    tied: bool = False

    def __str__(self) -> str:
        return f"{self.bays} of {self.frames} along {self.along}" if self.along is not None else str(self.bays)


class PlacementDesign(Model):
    """The layout of least cost with which histories meet the criteria.

    Attributes:
        method: search of a layout at least cost.
        kind: how the dampers stand.
        bays: candidate bays of a plane frame.
        places: candidate places of a building.
        storeys: candidate storeys.
        beside: designs above this one whose dampers stand in the frame while this one is searched.
        catalogue: items that a place may get, by name.
        costs: costs beside those of the dampers.
        limits: which layouts are allowed.
        temperature: temperature of the dampers; without the key that of their laws.
        state: state of the frame whose modes order candidates: under the gravity combination, or unloaded.
        level: hazard level whose spectrum orders candidates; without the key the first of `verify`.
        inherent_damping: damping of the frame without dampers, for that order; without the key that of `damping`.
        monotone: whether the search assumes that more dampers never harm.
        verify: histories and criteria that decide.
    """

    method: Literal["placement"]
    kind: Kind
    bays: Numbers | None = None
    places: tuple[CandidatePlaces, ...] = ()
    storeys: Numbers = ALL_NUMBERS
    beside: Names | tuple[()] = ()
    catalogue: Annotated[dict[ShortName, CatalogueItem], Field(min_length=1, max_length=8)]
    costs: Costs = Costs()
    limits: LayoutLimits = LayoutLimits()
    temperature: Temperature | None = None
    state: State = "gravity"
    level: str | None = None
    inherent_damping: UnitRatio | None = None
    monotone: bool = True
    verify: PlacementVerify

    @property
    def candidates(self) -> tuple[CandidateBays, ...]:
        """The candidate places: one entry of a plane frame, of a building those of `places`."""
        if self.bays is not None:
            return (CandidateBays(None, None, self.bays, self.storeys),)
        return tuple(
            CandidateBays(at.along, at.frames, at.bays, at.storeys or self.storeys, at.tied) for at in self.places
        )

    def kinds_of(self, item: CatalogueItem) -> tuple[Kind, ...]:
        """Return the kinds in which an item may stand: diagonals of mirrored layouts lean both ways."""
        kind = item.kind or self.kind
        return ("rising", "falling") if self.limits.mirrored and kind in ("rising", "falling") else (kind,)
