"""Soils, and footings on them under the columns."""

from __future__ import annotations

from typing import Annotated, Literal

from edesign.project.notation.units import (
    NotNegativeLength,
    PoissonRatio,
    PositiveAcceleration,
    PositiveDensity,
    PositiveLength,
    PositiveRatio,
    PositiveStress,
    PositiveTime,
    PositiveVelocity,
    UnitRatio,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Formula = Literal["pais_kausel", "gazetas"]


class Eurocode8Strain(Model):
    """Moduli and damping of EN 1998-5:2004, Table 4.1, at `acceleration` = alpha S g on the surface.

    Attributes:
        code: the tables of EN 1998-5.
        acceleration: acceleration alpha S g on the surface.
    """

    code: Literal["en1998_5"]
    acceleration: PositiveAcceleration


class Asce7Strain(Model):
    """Moduli and damping of ASCE/SEI 7-16, Tables 19.3-2 and 19.3-3, at `acceleration` = S_DS g / 2.5.

    Attributes:
        code: the tables of ASCE/SEI 7-16.
        site_class: site class of ASCE/SEI 7.
        acceleration: acceleration S_DS g / 2.5.
    """

    code: Literal["asce7"]
    site_class: Literal["A", "B", "C", "D", "E"]
    acceleration: PositiveAcceleration


class GivenStrain(Model):
    """Shear modulus under the earthquake over that at small strains.

    Attributes:
        code: a ratio that is given.
        modulus_ratio: shear modulus under the earthquake over that at small strains.
    """

    code: Literal["given"]
    modulus_ratio: PositiveRatio


Strain = Annotated[Eurocode8Strain | Asce7Strain | GivenStrain, OneOf("code")]


class Soil(Model):
    """A soil as a half-space: at small strains, and what the strains of the earthquake leave of it.

    Attributes:
        density: density of the soil.
        shear_wave_velocity: shear wave velocity at small strains; this key or `shear_modulus`.
        shear_modulus: shear modulus at small strains; this key or `shear_wave_velocity`.
        poisson: Poisson's ratio, at most 0.5, that of saturated clay.
        strain: what the strains of the earthquake leave of the modulus; without the key all of it.
        damping: hysteretic damping, of critical; without the key that of the code of `strain`.
    """

    density: PositiveDensity
    shear_wave_velocity: PositiveVelocity | None = None
    shear_modulus: PositiveStress | None = None
    poisson: PoissonRatio
    strain: Strain | None = None
    damping: UnitRatio | None = None


class Footing(Model):
    """A rigid rectangular footing.

    Attributes:
        soil: name of the soil that the footing stands on.
        length: length along the frame, or along x of a building.
        width: width across the frame, or along y of a building.
        embedment: depth of the underside below ground.
        wall_contact: height of the walls that the soil touches; without the key all of the embedment.
        formula: formulas of the static stiffness.
        radiation: whether waves that the footing sends into the ground damp it.
        period: period at which stiffness and damping are taken; without the key the first of the frame on its footings.
        thickness: thickness of the block, for its mass and weight; without the key it has none.
        density: density of the block; needs `thickness`.
        uplift: whether the footing lifts off.
        bearing_resistance: pressure at which the soil gives way; needs `uplift: true`.
    """

    soil: str
    length: PositiveLength
    width: PositiveLength
    embedment: NotNegativeLength = 0.0
    wall_contact: NotNegativeLength | None = None
    formula: Formula = "pais_kausel"
    radiation: bool = True
    period: PositiveTime | None = None
    thickness: PositiveLength | None = None
    density: PositiveDensity = 2500.0
    uplift: bool = False
    bearing_resistance: PositiveStress | None = None

    @property
    def contact(self) -> float:
        """Height of the walls that the soil touches, m."""
        return self.embedment if self.wall_contact is None else self.wall_contact


class FootingSupport(Model):
    """A support that is a footing on soil.

    Attributes:
        footing: the footing under the column.
    """

    footing: Footing
