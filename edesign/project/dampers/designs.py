"""Designs of dampers in a study file: where they stand, what they shall reach, how they are sized and verified."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, Discriminator, Field, Tag

from edesign.project.analysis.damping import State
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.dampers.verification import HystereticVerify, Verify, ViscousVerify
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    LeastBrace,
    PositiveFactor,
    PositiveForce,
    PositiveFrequency,
    PositiveLength,
    PositiveRatio,
    PositiveStiffness,
    PositiveStress,
    UnitRatio,
    parse_ratio,
)
from edesign.project.notation.written import Written, ratio, words_or
from edesign.project.reading.base import Model, by_key, by_shape, keys_in, plain_or_list, refuse
from edesign.project.reading.problems import did_you_mean, listed

Count = Annotated[int, Field(ge=1, le=1000)]


def _by_keys(value: Any) -> str:
    """Tag of properties: the word `law`, or the key that a mapping has."""
    if not isinstance(value, (Mapping, BaseModel)):
        return "?plain"
    keys = keys_in(value)
    return next((f"?{key}" for key in ("table", "file") if key in keys), "?values")


FOLLOWED = ("spectrum", "histories")
"""What says the strain that dampers reach, where a design follows it."""


def _strain(value: Any) -> Any:
    if isinstance(value, str) and value.isidentifier() and value not in FOLLOWED:
        hint = did_you_mean(value, FOLLOWED)
        raise refuse(f"`{value}` is unknown{hint} (a strain such as `20 %`, or {listed(FOLLOWED)})")
    return value if value in FOLLOWED else parse_ratio(value, 0.0, math.inf, low_allowed=False)


class TableProperties(Model):
    """A published table of measured properties."""

    table: Literal["thesis_appendix_a"]


class FileProperties(Model):
    """A table of measured properties, a CSV file as `edesign characterise` writes it; relative to the study file."""

    file: Annotated[str, Field(min_length=1)]


class FixedProperties(Model):
    """Storage modulus (Pa) and loss factor, whatever the frequency."""

    G_storage: PositiveStress
    loss_factor: PositiveFactor


Properties = Annotated[
    Annotated[Literal["law"], Tag("?plain")]
    | Annotated[TableProperties, Tag("?table")]
    | Annotated[FileProperties, Tag("?file")]
    | Annotated[FixedProperties, Tag("?values")],
    Discriminator(_by_keys),
]


class BraceRatio(Model):
    """Braces of a storey together, along its drift, as a multiple of the stiffness of the storey."""

    ratio: LeastBrace


Brace = Annotated[
    Annotated[Literal["rigid"], Tag("?plain")] | Annotated[BraceRatio, Tag("?mapping")],
    Discriminator(by_shape),
]


class Extremes(Model):
    """Property modification factors; 1 where not given."""

    ageing: PositiveFactor = 1.0
    test: PositiveFactor = 1.0
    specification: PositiveFactor = 1.0


class Bounds(Model):
    """Upper and lower bound of the dampers' properties.

    `upper` and `lower` are factors by themselves (EN 15129), or are made of factors of ageing, tests and specification
    (ASCE/SEI 7-16, 18.2.4.5). `temperatures` (degC) are the lowest and highest in service.
    """

    upper: PositiveFactor | None = None
    lower: PositiveFactor | None = None
    upper_factors: Extremes | None = None
    lower_factors: Extremes | None = None
    temperatures: tuple[Temperature, Temperature] | None = None


class _Design(Model):
    """What all methods need to know.

    `drift` is the target storey drift, `level` the hazard level at which estimates by the response spectrum are made.
    """

    law: str
    kind: Literal["chevron", "chevron_braces", "rising", "falling", "storey"]
    bays: Numbers
    storeys: Numbers = ALL_NUMBERS
    number: Count = 1
    temperature: Temperature | None = None
    drift: PositiveRatio | None = None
    storey_stiffness: Annotated[
        Annotated[Literal["computed"], Tag("?plain")] | Annotated[tuple[PositiveStiffness, ...], Tag("?list")],
        Discriminator(plain_or_list),
    ] = "computed"
    state: State = "gravity"
    level: str | None = None
    inherent_damping: UnitRatio | None = None
    bounds: Bounds | None = None


class _ElastomerDesign(_Design):
    """Dampers with layers of elastomer.

    Properties are taken at `strain`, at `temperature` (degC) and at `frequency` (Hz; two: the mean of the values at
    both; none: followed from the first mode with dampers). The strain may be followed too: it is then the one that the
    dampers reach in the estimate by the response spectrum, or in the histories of `verify`.
    """

    layers: Count | None = None
    properties: Properties = "law"
    strain: Annotated[
        float | Literal["spectrum", "histories"],
        Written(_strain, words_or(ratio(0.0, math.inf, low_allowed=False), *FOLLOWED)),
    ]
    frequency: (
        Annotated[
            Annotated[PositiveFrequency, Tag("?plain")]
            | Annotated[tuple[PositiveFrequency, PositiveFrequency], Tag("?list")],
            Discriminator(plain_or_list),
        ]
        | None
    ) = None
    layer_thickness: PositiveLength | None = None
    strain_limit: PositiveFactor | None = None
    verify: Verify | None = None


class StrainEnergyDesign(_ElastomerDesign):
    """The iterative procedure of thesis 5.3.4 by modal strain energy: stiffness in proportion to the storeys."""

    method: Literal["strain_energy"]
    damping: PositiveRatio | None = None
    brace: Brace = "rigid"
    braces_in_target: bool = False
    distribution: Literal["storey_stiffness", "uniform", "strain_energy", "least_area"] = "storey_stiffness"
    target_in: Literal["storeys", "first_mode"] | None = None


class SimplifiedDesign(_ElastomerDesign):
    """The simplified procedure of Fan and Lee (thesis 5.3.4): the least beta with which static forces meet a drift."""

    method: Literal["simplified"]
    alpha: PositiveFactor = 10.0
    beta: tuple[PositiveFactor, PositiveFactor] = (0.5, 5.0)
    beta_step: PositiveFactor = 0.1
    forces: Literal["first_mode", "heights"] = "first_mode"
    low_temperature: Temperature | None = None


class RoofAmplitude(Model):
    """Amplitude of the first mode at the roof."""

    roof_displacement: PositiveLength


class DriftAmplitude(Model):
    """Amplitude of the first mode by its largest storey drift."""

    drift: PositiveRatio


def _amplitude(value: Any) -> str:
    if by_shape(value) == "?plain":
        return "?plain"
    keys = keys_in(value)
    return "?drift" if "drift" in keys else "?roof_displacement"


Amplitude = Annotated[
    Annotated[Literal["spectrum"], Tag("?plain")]
    | Annotated[RoofAmplitude, Tag("?roof_displacement")]
    | Annotated[DriftAmplitude, Tag("?drift")],
    Discriminator(_amplitude),
]

VISCOUS_LAWS = ("viscous", "viscous_power", "maxwell", "maxwell_power")


class ViscousDesign(_Design):
    """Viscous dampers for a damping of the first mode, or for a drift with the least coefficients.

    `amplitude` is that of the vibration in the first mode in which the dashpots count with their energy.
    """

    method: Literal["viscous"]
    damping: PositiveRatio | None = None
    amplitude: Amplitude | None = None
    brace: Brace = "rigid"
    distribution: Literal["storey_stiffness", "storey_shear", "strain_energy", "uniform", "least_coefficient"] = (
        "storey_stiffness"
    )
    verify: ViscousVerify | None = None


DESIGNED_BRACES = ("chevron_braces", "rising", "falling")
"""Kinds of dampers of a design that stand along the length of a brace."""
HYSTERETIC_LAWS = ("friction", "elastic_plastic", "self_centring", "ramberg_osgood", "bouc_wen", "buckling_restrained")


class Optimum(Model):
    """The share of the storey shears for which histories answer least.

    `range` is that of the shares. What is made least is the demand over the limit of the criteria of `verify`: that of
    the worst of them, or their mean.
    """

    range: tuple[PositiveRatio, PositiveRatio] = (0.05, 1.0)
    least: Literal["worst", "mean"] = "worst"


class HystereticDesign(_Design):
    """Dampers that yield or slip: for a share of the storey shears, for a damping, or for the least response.

    `amplitude` is that of the vibration in the first mode in which the dampers count with the secant of their loops;
    `shear` says which shears are shared, those of the spectrum if a level is given, or gives them, storey by storey.
    """

    method: Literal["hysteretic"]
    shear_share: PositiveRatio | None = None
    damping: PositiveRatio | None = None
    optimum: Optimum | None = None
    shear: (
        Annotated[
            Annotated[Literal["spectrum", "first_mode"], Tag("?plain")]
            | Annotated[tuple[PositiveForce, ...], Tag("?list")],
            Discriminator(plain_or_list),
        ]
        | None
    ) = None
    amplitude: Amplitude = "spectrum"
    equivalent_damping: Literal["amplitude", "average"] = "amplitude"
    brace: Brace = "rigid"
    distribution: Literal["storey_shear", "storey_stiffness", "strain_energy", "uniform"] = "storey_shear"
    verify: HystereticVerify | None = None


ElastomerDesign = StrainEnergyDesign | SimplifiedDesign
SizedDesign = ElastomerDesign | ViscousDesign | HystereticDesign
"""Designs that find the size of one kind of damper in given places."""
Design = Annotated[
    Annotated[StrainEnergyDesign, Tag("?method=strain_energy")]
    | Annotated[SimplifiedDesign, Tag("?method=simplified")]
    | Annotated[ViscousDesign, Tag("?method=viscous")]
    | Annotated[HystereticDesign, Tag("?method=hysteretic")]
    | Annotated[PlacementDesign, Tag("?method=placement")],
    Discriminator(by_key("method")),
]
