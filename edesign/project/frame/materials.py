"""Uniaxial steel laws."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.notation.units import Hardening, PositiveStress
from edesign.project.reading.base import Model, by_key


class ElasticMaterial(Model):
    """Linear elastic; E in Pa."""

    law: Literal["elastic"]
    E: PositiveStress


class BilinearMaterial(Model):
    """Elastic-plastic with kinematic hardening; E, fy in Pa, hardening = post-yield / elastic stiffness."""

    law: Literal["bilinear"]
    E: PositiveStress
    fy: PositiveStress
    hardening: Hardening = 0.0


class MenegottoPintoMaterial(Model):
    """Menegotto-Pinto steel; E, fy in Pa; R0, cR1, cR2 shape the transition from elastic to plastic."""

    law: Literal["menegotto_pinto"]
    E: PositiveStress
    fy: PositiveStress
    hardening: Hardening = 0.0
    R0: Annotated[float, Field(gt=0)] = 20.0
    cR1: Annotated[float, Field(ge=0, lt=1)] = 0.925
    cR2: Annotated[float, Field(gt=0)] = 0.15


Material = Annotated[
    Annotated[ElasticMaterial, Tag("?law=elastic")]
    | Annotated[BilinearMaterial, Tag("?law=bilinear")]
    | Annotated[MenegottoPintoMaterial, Tag("?law=menegotto_pinto")],
    Discriminator(by_key("law")),
]
