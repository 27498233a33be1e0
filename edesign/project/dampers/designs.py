"""Designs of dampers in a study file: where they stand, what they shall reach, how they are sized and verified."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, NamedTuple

from pydantic import Field

from edesign.project.analysis.damping import State
from edesign.project.dampers.dampers import AnyChosenBrace, BraceSection, Stiffnesses
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.dampers.verification import HystereticVerify, Verify, ViscousVerify
from edesign.project.notation.frames import Direction, Frames, FrameSelection
from edesign.project.notation.repeated import Repeated, equal_values
from edesign.project.notation.selections import ALL_NUMBERS, Numbers, NumberSelection
from edesign.project.notation.several import Names
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import (
    LeastBrace,
    PositiveFactor,
    PositiveForce,
    PositiveFrequency,
    PositiveLength,
    PositiveRatio,
    PositiveStress,
    UnitRatio,
    parse_ratio,
)
from edesign.project.notation.written import Written, ratio, words_or
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import did_you_mean, listed

Count = Annotated[int, Field(ge=1, le=1000)]


FOLLOWED = ("spectrum", "histories")
"""What says the strain that dampers reach, where a design follows it."""


def _strain(value: Any) -> Any:
    if isinstance(value, str) and value.isidentifier() and value not in FOLLOWED:
        hint = did_you_mean(value, FOLLOWED)
        raise refuse(f"`{value}` is unknown{hint} (a strain such as `20 %`, or {listed(FOLLOWED)}) [E-VALUE-03]")
    return value if value in FOLLOWED else parse_ratio(value, 0.0, math.inf, low_allowed=False)


class TableProperties(Model):
    """A published table of measured properties.

    Attributes:
        table: Tables A.1 to A.4 of the thesis.
    """

    table: Literal["thesis_appendix_a"]


class FileProperties(Model):
    """A table of measured properties, a CSV file as `edesign characterise` writes it; relative to the study file.

    Attributes:
        file: CSV file of `edesign characterise`, relative to the study file.
    """

    file: Annotated[str, Field(min_length=1)]


class FixedProperties(Model):
    """Storage modulus (Pa) and loss factor, whatever the frequency.

    Attributes:
        G_storage: storage shear modulus.
        loss_factor: loss factor.
    """

    G_storage: PositiveStress
    loss_factor: PositiveFactor


Properties = Annotated[
    Literal["law"] | TableProperties | FileProperties | FixedProperties,
    OneOf(otherwise=FixedProperties, table=TableProperties, file=FileProperties),
]


class BraceRatio(Model):
    """Braces of a storey together, along its drift, as a multiple of the stiffness of the storey.

    Attributes:
        ratio: stiffness of the braces of a storey together over that of the storey.
    """

    ratio: LeastBrace


class DesignedBrace(AnyChosenBrace):
    """Braces of which the program chooses the section in each storey, by the forces of the dampers of the design.

    Attributes:
        ratio: least stiffness of the braces of a storey together over that of the storey.
        same_depth: whether all storeys have one nominal depth.
        most_sections: largest number of different sections.
        level: hazard level whose forces they hold; without the key that of the design. The histories of `verify` run at
            it too.
    """

    ratio: LeastBrace | None = None
    same_depth: bool = False
    most_sections: Count | None = None
    level: str | None = None


Brace = Annotated[
    Literal["rigid"] | BraceRatio | BraceSection | DesignedBrace,
    OneOf(otherwise=BraceRatio, choose=DesignedBrace, section=BraceSection, material=BraceSection),
]
HeldBrace = BraceSection | DesignedBrace
"""Braces of sections, whose strength counts."""


class Extremes(Model):
    """Property modification factors; 1 where not given.

    Attributes:
        ageing: factor of ageing and environment.
        test: factor of tests: heating, rate, scragging.
        specification: factor of the tolerance of production.
    """

    ageing: PositiveFactor = 1.0
    test: PositiveFactor = 1.0
    specification: PositiveFactor = 1.0


class Bounds(Model):
    """Upper and lower bound of the dampers' properties.

    Attributes:
        upper: upper property modification factor (EN 15129), at least 1.
        lower: lower property modification factor (EN 15129), at most 1.
        upper_factors: upper factors by cause, combined by ASCE/SEI 7-16, 18.2.4.5.
        lower_factors: lower factors by cause, combined by ASCE/SEI 7-16, 18.2.4.5.
        temperatures: lowest and highest temperature in service.
    """

    upper: PositiveFactor | None = None
    lower: PositiveFactor | None = None
    upper_factors: Extremes | None = None
    lower_factors: Extremes | None = None
    temperatures: tuple[Temperature, Temperature] | None = None


Kind = Literal["chevron", "chevron_braces", "rising", "falling", "storey"]


class DesignPlaces(Model):
    """Places of a design whose dampers stand alike.

    Attributes:
        kind: how the dampers stand here.
        frames: of a building, the frames of the design's direction; without the key those of the design.
        bays: bays that get dampers of this kind.
        storeys: storeys that get them; without the key those of the design.
    """

    kind: Kind
    frames: Frames | None = None
    bays: Numbers
    storeys: Numbers | None = None


class DesignRun(NamedTuple):
    """Dampers of a design that stand alike: their kind, and where (see `InBays`)."""

    kind: Kind
    along: Direction | None
    frames: FrameSelection | None
    bays: NumberSelection
    storeys: NumberSelection


class _Design(Model):
    """What all methods need to know.

    Attributes:
        law: one of `dampers.laws` of the project.
        kind: how the dampers stand, as in the project file; with `places` these say it.
        along: of a building, the direction of the frames that get dampers, in which the design acts.
        frames: of a building, the frames of this direction that get dampers.
        bays: bays that get dampers; with `places` these say it.
        places: bays of different kinds, such as rising and falling ones, that share the target.
        storeys: storeys that get dampers.
        beside: designs above this one whose dampers stand in the frame while this one is sized and verified.
        number: dampers side by side at each place.
        temperature: temperature of the dampers, also in the histories; without the key that of the law.
        drift: target storey drift.
        storey_stiffness: stiffness of the storeys: computed, or one value for each storey of the frame.
        state: state of the frame whose modes count: under the gravity combination, or unloaded.
        level: hazard level of estimates by the response spectrum.
        inherent_damping: damping of the frame without dampers, for estimates; without the key the ratio of `damping` of
            the project.
        bounds: upper and lower properties of the dampers.
    """

    law: str
    kind: Kind | None = None
    along: Direction | None = None
    frames: Frames | None = None
    bays: Numbers | None = None
    places: tuple[DesignPlaces, ...] = ()
    storeys: Numbers = ALL_NUMBERS
    beside: Names | tuple[()] = ()
    number: Count = 1
    temperature: Temperature | None = None
    drift: PositiveRatio | None = None
    storey_stiffness: Annotated[Literal["computed"] | Stiffnesses, OneOf()] = "computed"
    state: State = "gravity"
    level: str | None = None
    inherent_damping: UnitRatio | None = None
    bounds: Bounds | None = None

    @property
    def brace_level(self) -> str | None:
        """Hazard level whose forces braces of sections hold; None: they have no sections, or no level is named."""
        brace = getattr(self, "brace", None)
        if not isinstance(brace, BraceSection | DesignedBrace):
            return None
        return getattr(brace, "level", None) or self.level

    @property
    def runs(self) -> tuple[DesignRun, ...]:
        """The dampers of each kind: those of `places`, or the one of `kind` and `bays`."""
        if self.kind is not None and self.bays is not None:
            return (DesignRun(self.kind, self.along, self.frames, self.bays, self.storeys),)
        return tuple(
            DesignRun(at.kind, self.along, at.frames or self.frames, at.bays, at.storeys or self.storeys)
            for at in self.places
        )


class _ElastomerDesign(_Design):
    """Dampers with layers of elastomer.

    Attributes:
        layers: layers of one damper; without the key those of the prototype.
        properties: where storage modulus and loss factor come from.
        strain: shear strain at which properties are taken, or where it is followed: in the spectrum's estimate, or in
            histories.
        frequency: frequency at which properties are taken; of two the mean of the values; without the key that of the
            first mode.
        layer_thickness: thickness of a layer; without the key drift times height times cosine over `strain_limit`.
        strain_limit: largest shear strain, for the thickness; histories beyond it are warned of.
        verify: time histories that close the loop.
    """

    layers: Count | None = None
    properties: Properties = "law"
    strain: Annotated[
        float | Literal["spectrum", "histories"],
        Written(_strain, words_or(ratio(0.0, math.inf, low_allowed=False), *FOLLOWED)),
    ]
    frequency: Annotated[PositiveFrequency | tuple[PositiveFrequency, PositiveFrequency], OneOf()] | None = None
    layer_thickness: PositiveLength | None = None
    strain_limit: PositiveFactor | None = None
    verify: Verify | None = None


class StrainEnergyDesign(_ElastomerDesign):
    """The iterative procedure of thesis 5.3.4 by modal strain energy.

    Attributes:
        method: a damping ratio of the first mode by modal strain energy.
        damping: damping ratio that the dampers add to the first mode; all distributions but `least_area` need it.
        brace: braces of a storey together along its drift.
        braces_in_target: whether brace and damper together reach the target, not the damper alone; without the key they
            do, as far as the braces let them.
        distribution: stiffness of the dampers over the height; `least_area` finds the least in sum for the `drift`, by
            the estimate or, with `verify`, by histories.
        target_in: what has the target damping: the first mode (Eq. 5.6) or each storey (Eq. 5.9).
    """

    method: Literal["strain_energy"]
    damping: PositiveRatio | None = None
    brace: Brace = "rigid"
    braces_in_target: bool | None = None
    distribution: Literal["storey_stiffness", "uniform", "strain_energy", "least_area"] = "storey_stiffness"
    target_in: Literal["storeys", "first_mode"] = "first_mode"

    @property
    def counts_braces(self) -> bool:
        """Whether the target is of dampers and braces together."""
        return self.brace != "rigid" if self.braces_in_target is None else self.braces_in_target


class SimplifiedDesign(_ElastomerDesign):
    """The simplified procedure of Fan and Lee (thesis 5.3.4): the least beta with which static forces meet a drift.

    Attributes:
        method: the simplified procedure of Fan and Lee.
        alpha: braces over the stiffness of the storey; of braces of sections the least.
        brace: sections of the braces; without the key they have the stiffness alone.
        beta: range of the dampers over the stiffness of the storey.
        beta_step: step of beta between trials.
        forces: shape of the lateral forces (EN 1998-1, Eqs. 4.10 and 4.11).
        low_temperature: low end of the design range; needs `temperature`.
    """

    method: Literal["simplified"]
    alpha: PositiveFactor = 10.0
    brace: (
        Annotated[
            BraceSection | DesignedBrace,
            OneOf(otherwise=DesignedBrace, choose=DesignedBrace, section=BraceSection, material=BraceSection),
        ]
        | None
    ) = None
    beta: tuple[PositiveFactor, PositiveFactor] = (0.5, 5.0)
    beta_step: PositiveFactor = 0.1
    forces: Literal["first_mode", "heights"] = "first_mode"
    low_temperature: Temperature | None = None


class RoofAmplitude(Model):
    """Amplitude of the first mode at the roof.

    Attributes:
        roof_displacement: displacement of the roof in the first mode.
    """

    roof_displacement: PositiveLength


class DriftAmplitude(Model):
    """Amplitude of the first mode by its largest storey drift.

    Attributes:
        drift: drift of the storey that drifts most in the first mode.
    """

    drift: PositiveRatio


Amplitude = Annotated[
    Literal["spectrum"] | RoofAmplitude | DriftAmplitude, OneOf(otherwise=RoofAmplitude, drift=DriftAmplitude)
]

VISCOUS_LAWS = ("viscous", "viscous_power", "maxwell", "maxwell_power")


class ViscousDesign(_Design):
    """Viscous dampers for a damping of the first mode, or for a drift with the least coefficients.

    Attributes:
        method: a damping ratio of the first mode by viscous dampers.
        damping: damping ratio that the dampers add to the first mode; all distributions but `least_coefficient` need
            it.
        amplitude: amplitude of the first mode at which the dampers count with their energy; with a `level` that of its
            spectrum.
        brace: braces of a storey together along its drift.
        distribution: coefficients of the dampers over the height; `least_coefficient` finds the least in sum for the
            `drift`.
        verify: time histories that close the loop.
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
HYSTERETIC_TARGETS = ("shear_share", "damping", "optimum")
"""Keys of what hysteretic dampers shall reach; a design has one of them."""


class Optimum(Model):
    """The search for the share of the storey shears with the least response in histories.

    Attributes:
        range: shares that are looked at.
        least: what is made least: demand over limit of the worst criterion, or the mean over the criteria.
    """

    range: tuple[PositiveRatio, PositiveRatio] = (0.05, 1.0)
    least: Literal["worst", "mean"] = "worst"


Forces = Annotated[tuple[PositiveForce, ...], Repeated(equal_values("EqualForces", PositiveForce), 0)]
"""Of storeys from the lowest."""


class HystereticDesign(_Design):
    """Dampers that yield or slip: for a share of the storey shears, for a damping, or for the least response.

    Attributes:
        method: yield or slip forces by share, damping or optimum.
        shear_share: yield force of the storeys over their shear; this key, `damping` or `optimum`.
        damping: equivalent damping ratio that the dampers add to the first mode.
        optimum: the share for which histories answer least.
        shear: shears that are shared: by the spectrum of `level`, by the first mode, or one for each storey.
        amplitude: amplitude of the first mode at which the dampers count with the secant of their loops.
        equivalent_damping: whether the damping is that of a cycle of the amplitude, or the mean over all up to it.
        brace: braces of a storey together along its drift.
        distribution: yield forces of the dampers over the height.
        carries_gravity: whether buckling-restrained braces act from the beginning, under the gravity loads too; a frame
            that stands by them needs it.
        verify: time histories that close the loop.
    """

    method: Literal["hysteretic"]
    shear_share: PositiveRatio | None = None
    damping: PositiveRatio | None = None
    optimum: Optimum | None = None
    shear: Annotated[Literal["spectrum", "first_mode"] | Forces, OneOf()] | None = None
    amplitude: Amplitude = "spectrum"
    equivalent_damping: Literal["amplitude", "average"] = "amplitude"
    brace: Brace = "rigid"
    distribution: Literal["storey_shear", "storey_stiffness", "strain_energy", "uniform"] = "storey_shear"
    carries_gravity: bool = False
    verify: HystereticVerify | None = None


ElastomerDesign = StrainEnergyDesign | SimplifiedDesign
SizedDesign = ElastomerDesign | ViscousDesign | HystereticDesign
"""Designs that find the size of one kind of damper in given places."""
Design = Annotated[
    StrainEnergyDesign | SimplifiedDesign | ViscousDesign | HystereticDesign | PlacementDesign, OneOf("method")
]
