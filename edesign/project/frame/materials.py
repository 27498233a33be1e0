"""Uniaxial steel laws."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import Hardening, PositiveStress
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf


class ElasticMaterial(Model):
    """Linear elastic steel.

    Attributes:
        law: linear elastic.
        E: modulus of elasticity.
    """

    law: Literal["elastic"]
    E: PositiveStress


class BilinearMaterial(Model):
    """Elastic-plastic steel with kinematic hardening.

    Attributes:
        law: elastic-plastic with kinematic hardening.
        E: modulus of elasticity.
        fy: yield stress.
        hardening: stiffness after yielding over the elastic stiffness.
    """

    law: Literal["bilinear"]
    E: PositiveStress
    fy: PositiveStress
    hardening: Hardening = 0.0


class MenegottoPintoMaterial(Model):
    """Menegotto and Pinto's steel.

    Attributes:
        law: Menegotto and Pinto's steel, with a smooth transition.
        E: modulus of elasticity.
        fy: yield stress.
        hardening: stiffness after yielding over the elastic stiffness.
        R0: curvature of the first transition from elastic to plastic.
        cR1: decrease of the curvature with plastic excursion.
        cR2: decrease of the curvature with plastic excursion.
    """

    law: Literal["menegotto_pinto"]
    E: PositiveStress
    fy: PositiveStress
    hardening: Hardening = 0.0
    R0: Annotated[float, Field(gt=0)] = 20.0
    cR1: Annotated[float, Field(ge=0, lt=1)] = 0.925
    cR2: Annotated[float, Field(gt=0)] = 0.15


Material = Annotated[ElasticMaterial | BilinearMaterial | MenegottoPintoMaterial, OneOf("law")]


def with_stiffness(material: Material, factor: float) -> Material:
    """Return a steel with another modulus and the strength that it has.

    Args:
        factor: by which E is multiplied.
    """
    return material if factor == 1.0 else material.model_copy(update={"E": factor * material.E})
