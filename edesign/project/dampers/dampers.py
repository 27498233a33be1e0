"""Dampers in the frame: their laws, where they stand, their size, their braces; tuned mass and liquid dampers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.dampers.isolation import Isolation
from edesign.project.notation.selections import Numbers
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    Factor,
    PositiveArea,
    PositiveFactor,
    PositiveFrequency,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveStiffness,
)
from edesign.project.reading.base import Model, by_key, by_shape, keys_in, plain_or_list
from edesign.project.reading.problems import listed

Layers = Annotated[int, Field(ge=1, le=1000)]
Count = Annotated[int, Field(ge=1, le=1000)]


class Prototype(Model):
    """The damper that the parameters of a law belong to: layers of elastomer in shear."""

    layers: Layers
    layer_area: PositiveArea
    layer_thickness: PositiveLength


class Effect(Model):
    """An effect that tests have shown and the law has not; `parameters` are read by the effect itself."""

    name: str
    form: str
    parameters: dict[str, Any] = {}


class LawDescription(Model):
    """A law with its parameters, as a project and a law file (of `edesign fit`) give it.

    `parameters` are read by the law itself: a mapping of values with units, or the name of a published set; so is
    `temperature_law`. `effects` amend the law. `standard_errors` and `tested` come from a fit: how sure the parameters
    are, and the range of the tests.
    """

    type: str | None = None
    parameters: str | dict[str, Any] | None = None
    temperature_law: dict[str, Any] | None = None
    effects: tuple[Effect, ...] = ()
    prototype: Prototype | None = None
    standard_errors: dict[str, Any] | None = None
    tested: dict[str, str] | None = None


class DamperLaw(LawDescription):
    """A law of the project at a temperature (degC; None: that of the parameters); `file` is a law file.

    `property_factor` multiplies all forces: a property modification factor of EN 15129 or ASCE 7.
    """

    file: Annotated[str, Field(min_length=1)] | None = None
    temperature: Temperature | None = None
    property_factor: PositiveFactor = 1.0


class BraceStiffness(Model):
    """Stiffness in series with a damper, along its deformation; `play` of its pins from end to end."""

    stiffness: Annotated[
        Annotated[PositiveStiffness, Tag("?plain")] | Annotated[tuple[PositiveStiffness, ...], Tag("?list")],
        Discriminator(plain_or_list),
    ]
    play: PositiveLength | None = None


class BraceSection(Model):
    """Braces of a section and material; their stiffness follows from the geometry."""

    section: str
    material: str


Areas = Annotated[
    Annotated[PositiveArea, Tag("?plain")] | Annotated[tuple[PositiveArea, ...], Tag("?list")],
    Discriminator(plain_or_list),
]
Lengths = Annotated[
    Annotated[PositiveLength, Tag("?plain")] | Annotated[tuple[PositiveLength, ...], Tag("?list")],
    Discriminator(plain_or_list),
]
Scales = Annotated[
    Annotated[PositiveFactor, Tag("?plain")] | Annotated[tuple[PositiveFactor, ...], Tag("?list")],
    Discriminator(plain_or_list),
]


def _brace_shape(value: Any) -> str:
    if by_shape(value) == "?plain":
        return "?plain"
    keys = keys_in(value)
    return "?section" if "section" in keys or "material" in keys else "?stiffness"


Brace = Annotated[
    Annotated[Literal["rigid"], Tag("?plain")]
    | Annotated[BraceStiffness, Tag("?stiffness")]
    | Annotated[BraceSection, Tag("?section")],
    Discriminator(_brace_shape),
]


PROTOTYPE_SCALE = "the law `{}` has a `prototype`: give the size of the layers, not a `scale`"
BRACE_KINDS = ("chevron_braces", "rising", "falling", "nodes")
"""Of dampers that stand along the length of a brace."""


def restrained_misfits(kind: str, brace: object, kinds: Iterable[str] = BRACE_KINDS) -> dict[str, str]:
    """Return what buckling-restrained braces must not have, by its key, in words.

    Args:
        kind: how they stand.
        brace: in series with them; the stiffness factor of the law counts their ends.
        kinds: that may be given here.
    """
    found = {}
    if kind not in BRACE_KINDS:
        message = f"`{kind}` acts horizontally, and a buckling-restrained brace along its length"
        found["kind"] = f"{message}; take {listed(kinds)}"
    if brace != "rigid":
        found["brace"] = "the ends of a buckling-restrained brace are in its `KF`; leave this key out"
    return found


class _Sized(Model):
    """A law at the size of the device; `number` of them stand side by side.

    Layers are those of the prototype unless given; histories that strain them beyond `strain_limit` are warned of.
    `scale` multiplies the forces of a law without prototype.
    `design_deformation` is the amplitude of damper and brace at which they count in natural modes. Buckling-restrained
    braces can act from the beginning (`carries_gravity`); other dampers are set in under the gravity loads.
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
    braces of a chevron, from the feet of the bay to the middle of the beam above; rising, falling: along the diagonal,
    seen from left to right; storey: horizontal between the floors above and below.
    """

    kind: Literal["chevron", "chevron_braces", "rising", "falling", "storey"]
    bays: Numbers
    storeys: Numbers


class DamperBetween(_Sized):
    """A damper along the line between two nodes."""

    kind: Literal["nodes"]
    nodes: Annotated[tuple[str, str], Field(strict=False)]


Device = Annotated[
    Annotated[DamperRun, Tag("?kind=chevron")]
    | Annotated[DamperRun, Tag("?kind=chevron_braces")]
    | Annotated[DamperRun, Tag("?kind=rising")]
    | Annotated[DamperRun, Tag("?kind=falling")]
    | Annotated[DamperRun, Tag("?kind=storey")]
    | Annotated[DamperBetween, Tag("?kind=nodes")],
    Discriminator(by_key("kind")),
]


class TunedMass(Model):
    """A mass on a spring and dashpot on a floor (thesis Eqs. 2.26-2.28); frequency in Hz, damping of critical."""

    kind: Literal["tuned_mass"]
    floor: Annotated[int, Field(ge=1)]
    mass: PositiveMass
    frequency: PositiveFrequency
    damping: Factor


class TunedLiquid(Model):
    """Water sloshing in rectangular tanks on a floor (thesis Eqs. 2.31-2.33), as an equivalent tuned mass.

    `number` tanks of inner `length` along the frame and `width`, filled to `depth`; `damping` of the sloshing is a
    share of critical.
    """

    kind: Literal["tuned_liquid"]
    floor: Annotated[int, Field(ge=1)]
    number: Count = 1
    length: PositiveLength
    width: PositiveLength
    depth: PositiveLength
    damping: PositiveRatio


Attachment = Annotated[
    Annotated[TunedMass, Tag("?kind=tuned_mass")] | Annotated[TunedLiquid, Tag("?kind=tuned_liquid")],
    Discriminator(by_key("kind")),
]


class Dampers(Model):
    """All dampers of the building, and its isolators; analyses with `dampers: false` leave them out."""

    laws: dict[str, DamperLaw] = {}
    devices: tuple[Device, ...] = ()
    attachments: tuple[Attachment, ...] = ()
    isolation: Isolation | None = None

    @property
    def none(self) -> bool:
        """Whether there are laws at most, and nothing that has them."""
        return not (self.devices or self.attachments or self.isolation)

    @property
    def used_laws(self) -> frozenset[str]:
        """Names of the laws that some damper or isolator has."""
        base = () if self.isolation is None else (*self.isolation.isolators, *self.isolation.beside)
        return frozenset(item.law for item in (*self.devices, *base))
