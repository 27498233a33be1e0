"""Dampers in the frame: their laws, where they stand, their size, their braces; tuned mass and liquid dampers."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Annotated, Any, Literal, Self

from pydantic import Field

from edesign.project.dampers.isolation import AnyBaseDevice, Isolation
from edesign.project.frame.sections import SectionChoice
from edesign.project.notation.frames import Direction, Frames
from edesign.project.notation.repeated import EqualStiffnesses, Repeated, equal_values
from edesign.project.notation.selections import Numbers
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    BucklingLengthFactor,
    Factor,
    PositiveArea,
    PositiveFactor,
    PositiveForce,
    PositiveFrequency,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveStiffness,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import listed

Layers = Annotated[int, Field(ge=1, le=1000)]
Count = Annotated[int, Field(ge=1, le=1000)]


class Prototype(Model):
    """The damper that the parameters of a law belong to: layers of elastomer in shear.

    Attributes:
        layers: number of layers of elastomer.
        layer_area: area of a layer.
        layer_thickness: thickness of a layer.
    """

    layers: Layers
    layer_area: PositiveArea
    layer_thickness: PositiveLength


class Effect(Model):
    """An effect that tests have shown and the law has not; `parameters` are read by the effect itself.

    Attributes:
        name: name of the effect, such as `payne`.
        form: form of the effect, such as `whole`: its equation.
        placement: where the equation acts. `whole`: a factor on all of the law's force, a force beside it; `inside`:
            within a law that relaxes all of its forces, as `mgmm`; `springs` or `dashpots`: a factor on what these
            carry of the law's force.
        parameters: parameters of the effect, with units.
    """

    name: str
    form: str
    placement: Literal["whole", "inside", "springs", "dashpots"] = "whole"
    parameters: dict[str, Any] = {}


class LawDescription(Model):
    """A damper law with its parameters, as a project and a law file (of `edesign fit`) give it.

    Attributes:
        type: name of the law; `edesign laws` lists all.
        parameters: parameters with units, or the name of a published set.
        temperature_law: how parameters change with temperature.
        effects: effects that tests have shown and the law has not.
        prototype: damper that the parameters belong to; without the key the law has the size of the device.
        standard_errors: standard errors of the parameters, from a fit.
        tested: range of the tests that the parameters come from; use outside it is warned of.
    """

    type: str | None = None
    parameters: str | dict[str, Any] | None = None
    temperature_law: dict[str, Any] | None = None
    effects: tuple[Effect, ...] = ()
    prototype: Prototype | None = None
    standard_errors: dict[str, Any] | None = None
    tested: dict[str, str] | None = None


class DamperLaw(LawDescription):
    """A law of the project, in place or in a law file.

    Attributes:
        file: law file, relative to the project file, in place of type, parameters, temperature law and effects.
        temperature: temperature of the dampers; without the key that of the parameters.
        property_factor: factor on all forces: a property modification factor of EN 15129 or ASCE 7.
    """

    file: Annotated[str, Field(min_length=1)] | None = None
    temperature: Temperature | None = None
    property_factor: PositiveFactor = 1.0


Stiffnesses = Annotated[tuple[PositiveStiffness, ...], Repeated(EqualStiffnesses, 0)]
"""Of storeys from the lowest."""


class BraceStiffness(Model):
    """Stiffness in series with a damper, along its deformation.

    Attributes:
        stiffness: stiffness along the damper; one for all storeys, or a list from the lowest.
        play: clearance of the pins from end to end, within which the brace carries nothing.
    """

    stiffness: Annotated[PositiveStiffness | Stiffnesses, OneOf()]
    play: PositiveLength | None = None


class BraceSection(Model):
    """Braces of a section and material; their stiffness follows from the geometry.

    Attributes:
        section: name of a profile of the catalogue, or of `sections`; one, or a list by storeys from the lowest.
        material: one of `materials`.
        buckling_length_factor: buckling length over the length between nodes, at least 0.1.
    """

    section: Annotated[str | tuple[str, ...], OneOf()]
    material: str
    buckling_length_factor: BucklingLengthFactor = 1.0

    @property
    def sections(self) -> tuple[str, ...]:
        """The names of its sections, from the lowest storey."""
        return self.section if isinstance(self.section, tuple) else (self.section,)

    def of(self, index: int) -> str:
        """Return the name of the section in a storey.

        Args:
            index: of the storey among those of the dampers, from 0.
        """
        return self.sections[index if isinstance(self.section, tuple) else 0]


Raised = Annotated[float, Field(ge=1.0, le=10.0)]
"""A factor that makes a demand larger."""


class GivenFactors(Model):
    """Factors on what histories ask of dampers, and on what holds them.

    Attributes:
        stroke: on the deformation of dampers.
        velocity: on their velocity.
        overstrength: on the force of the dampers, at the stroke and velocity times their factors, that braces and
            connections hold.
        isolator_stroke: on the deformation of isolators.
    """

    stroke: Raised = 1.0
    velocity: Raised = 1.0
    overstrength: Raised = 1.0
    isolator_stroke: Raised = 1.0


class AnyChosenBrace(Model):
    """Braces whose section the program chooses: the lightest that is strong, and as stiff as asked for.

    Attributes:
        choose: families, patterns or sections to choose from, such as `[SHS, CHS168.3x8]`.
        material: one of `materials`, that yields.
        buckling_length_factor: buckling length over the length between nodes, at least 0.1.
        overstrength: factor on the force of the dampers that the braces hold.
        largest_slenderness: largest non-dimensional slenderness; without the key that of diagonals in EN 1998-1,
            6.7.3.
    """

    choose: SectionChoice
    material: str
    buckling_length_factor: BucklingLengthFactor = 1.0
    overstrength: Raised | None = None
    largest_slenderness: PositiveFactor = 2.0


class ChosenBrace(AnyChosenBrace):
    """Braces of dampers of a known force, of which the program chooses the section.

    Attributes:
        force: largest force of all dampers of a place along them; one, or a list by storeys from the lowest.
        stiffness: least stiffness along the damper; one, or a list by storeys from the lowest.
    """

    force: Annotated[PositiveForce | tuple[PositiveForce, ...], OneOf()]
    stiffness: Annotated[PositiveStiffness | tuple[PositiveStiffness, ...], OneOf()] | None = None


_Areas = Annotated[tuple[PositiveArea, ...], Repeated(equal_values("EqualAreas", PositiveArea), 0)]
Areas = Annotated[PositiveArea | _Areas, OneOf()]
_Lengths = Annotated[tuple[PositiveLength, ...], Repeated(equal_values("EqualLengths", PositiveLength), 0)]
Lengths = Annotated[PositiveLength | _Lengths, OneOf()]
_Scales = Annotated[tuple[PositiveFactor, ...], Repeated(equal_values("EqualScales", PositiveFactor), 0)]
Scales = Annotated[PositiveFactor | _Scales, OneOf()]


Brace = Annotated[
    Literal["rigid"] | BraceStiffness | BraceSection | ChosenBrace,
    OneOf(otherwise=BraceStiffness, choose=ChosenBrace, section=BraceSection, material=BraceSection),
]


SET_IN = "the law `{}` is of a damper that is set in under the gravity loads; leave this key out [E-DEVICE-02]"
PROTOTYPE_SCALE = "the law `{}` has a `prototype`: give the size of the layers, not a `scale` [E-KEY-03]"
BRACE_KINDS = ("chevron_braces", "rising", "falling", "nodes")
"""Of dampers that stand along the length of a brace."""


def restrained_misfits(kind: str, brace: object, kinds: Iterable[str] = BRACE_KINDS) -> dict[str, str]:
    """Return why a buckling-restrained brace must not have some keys, by the key.

    Args:
        kind: how they stand.
        brace: in series with them; the stiffness factor of the law counts their ends.
        kinds: that may be given here.
    """
    found = {}
    if kind not in BRACE_KINDS:
        message = f"`{kind}` acts horizontally, and a buckling-restrained brace along its length"
        found["kind"] = f"{message}; take {listed(kinds)} [E-DAMPER-05]"
    if brace != "rigid":
        found["brace"] = "the ends of a buckling-restrained brace are in its `KF`; leave this key out [E-KEY-03]"
    return found


class _Sized(Model):
    """A law at the size of the device.

    Attributes:
        law: one of `dampers.laws`.
        number: dampers side by side at each place.
        layers: layers of elastomer of one damper; without the key those of the prototype.
        layer_area: area of a layer, one or a list by storeys from the lowest; without the key that of the prototype.
        layer_thickness: thickness of a layer; without the key that of the prototype.
        strain_limit: largest shear strain that the layers are meant for; histories beyond it are warned of.
        scale: factor on the forces of a law without prototype; one, or a list by storeys from the lowest.
        design_deformation: amplitude of damper and brace at which they count in natural modes; one, or a list by
            storeys.
        brace: brace in series with the dampers of one place.
        carries_gravity: whether buckling-restrained braces act from the beginning, under the gravity loads too.
    """

    law: str
    number: Count = 1
    layers: Layers | None = None
    layer_area: Areas | None = None
    layer_thickness: PositiveLength | None = None
    strain_limit: PositiveFactor | None = None
    scale: Scales | None = None
    design_deformation: Lengths | None = None
    brace: Brace = "rigid"
    carries_gravity: bool = False


class DamperRun(_Sized):
    """Dampers in some bays and storeys; lists go up with the storeys.

    chevron: horizontal between the apex of a chevron brace and the beam above; chevron_braces: two in place of the
    braces of a chevron, from the lower corners of the bay to the middle of the beam above; rising, falling: along the
    diagonal, seen from left to right; storey: horizontal between the floors above and below.

    Attributes:
        kind: how they stand: `chevron` between a brace and the beam above, `chevron_braces` in place of two braces,
            along a diagonal, or between floors.
        along: of a building, the direction of the frames that they stand in.
        frames: of a building, the frames of this direction, such as `2`, `A-C`.
        bays: bays, counted from 1.
        storeys: storeys, counted from 1.
    """

    kind: Literal["chevron", "chevron_braces", "rising", "falling", "storey"]
    along: Direction | None = None
    frames: Frames | None = None
    bays: Numbers
    storeys: Numbers


class DamperBetween(_Sized):
    """A damper along the line between two nodes.

    Attributes:
        kind: along the line between two nodes.
        nodes: names of the two nodes, such as `[A0, B1]`, of a building `[A1.0, B1.1]`.
    """

    kind: Literal["nodes"]
    nodes: Annotated[tuple[str, str], Field(strict=False)]


Device = Annotated[DamperRun | DamperBetween, OneOf("kind")]


class TunedMass(Model):
    """A mass on a spring and dashpot on a floor (thesis Eqs. 2.26-2.28).

    Attributes:
        kind: tuned mass damper.
        floor: floor on which it stands, from 1 to the roof.
        mass: mass of the damper.
        frequency: own frequency of the damper.
        damping: damping of the damper, ratio of critical.
        direction: of a building, the direction that it moves in.
        at: of a building, the column line that it stands on, such as `A1`; without the key the centre of mass.
    """

    kind: Literal["tuned_mass"]
    floor: Annotated[int, Field(ge=1)]
    mass: PositiveMass
    frequency: PositiveFrequency
    damping: Factor
    direction: Direction | None = None
    at: str | None = None


class TunedLiquid(Model):
    """Water sloshing in rectangular tanks on a floor (thesis Eqs. 2.31-2.33), as an equivalent tuned mass.

    Attributes:
        kind: tuned liquid damper.
        floor: floor on which the tanks stand, from 1 to the roof.
        number: number of tanks.
        length: inner length of a tank along the frame, or along the direction.
        width: inner width of a tank.
        depth: depth of the water.
        damping: damping of the sloshing, ratio of critical.
        direction: of a building, the direction that the water moves in.
        at: of a building, the column line that they stand on, such as `A1`; without the key the centre of mass.
    """

    kind: Literal["tuned_liquid"]
    floor: Annotated[int, Field(ge=1)]
    number: Count = 1
    length: PositiveLength
    width: PositiveLength
    depth: PositiveLength
    damping: PositiveRatio
    direction: Direction | None = None
    at: str | None = None


Attachment = Annotated[TunedMass | TunedLiquid, OneOf("kind")]


class Dampers(Model):
    """All dampers of the building, and its isolators; analyses with `dampers: false` leave them out.

    Attributes:
        laws: damper laws by name.
        devices: dampers between floors or nodes, each with its place, law and size.
        attachments: tuned masses and tanks on floors.
        isolation: isolators under the columns, and the base on them.
    """

    laws: dict[str, DamperLaw] = {}
    devices: tuple[Device, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    isolation: Isolation | None = None

    def with_sections(self, named: Callable[[str], str]) -> Self:
        """Return the dampers with other names of the sections of their braces, which `named` makes of those written."""
        found = []
        for device in self.devices:
            brace = device.brace
            if isinstance(brace, BraceSection):
                names = tuple(map(named, brace.sections))
                other = brace.model_copy(update={"section": names if isinstance(brace.section, tuple) else names[0]})
                device = device.model_copy(update={"brace": other})
            found.append(device)
        return self.model_copy(update={"devices": tuple(found)})

    @property
    def none(self) -> bool:
        """Whether no damper stands in the frame, although laws may be given."""
        return not (self.devices or self.attachments or self.isolation)

    @property
    def used_laws(self) -> frozenset[str]:
        """The names of the laws that some damper or isolator has."""
        base: tuple[AnyBaseDevice, ...] = ()
        if self.isolation is not None:
            base = (*self.isolation.isolators, *self.isolation.beside)
        return frozenset(item.law for item in (*self.devices, *base))
