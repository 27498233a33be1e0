"""The steels of a building: what the design asks of them, and their law in analyses."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.frame.materials import BilinearMaterial, ElasticMaterial, Material, MenegottoPintoMaterial
from edesign.project.notation.units import Hardening, PositiveDensity, PositiveStress
from edesign.project.reading.base import Model

_LAWS: dict[str, type[ElasticMaterial | BilinearMaterial | MenegottoPintoMaterial]] = {
    "elastic": ElasticMaterial,
    "bilinear": BilinearMaterial,
    "menegotto_pinto": MenegottoPintoMaterial,
}


class Steel(Model):
    """A steel: elastic in the design, with a law in analyses.

    Attributes:
        E: modulus of elasticity (EN 1993-1-1, 3.2.6(1)).
        fy: yield strength.
        nu: Poisson's ratio.
        density: density, for the self weight (EN 1991-1-1, Table A.4).
        law: law of fibres and braces in analyses; the elastic design does not ask for it.
        hardening: stiffness after yielding over the elastic stiffness.
        R0: curvature of the first transition from elastic to plastic, of `menegotto_pinto`.
        cR1: decrease of the curvature with plastic excursion, of `menegotto_pinto`.
        cR2: decrease of the curvature with plastic excursion, of `menegotto_pinto`.

    Source of the defaults: EN 1993-1-1:2005, 3.2.6(1); EN 1991-1-1:2002, Table A.4.
    """

    E: PositiveStress = 210e9
    fy: PositiveStress
    nu: Annotated[float, Field(ge=0.0, lt=0.5)] = 0.3
    density: PositiveDensity = 7850.0
    law: Literal["elastic", "bilinear", "menegotto_pinto"] = "bilinear"
    hardening: Hardening = 0.0
    R0: Annotated[float, Field(gt=0)] = 20.0
    cR1: Annotated[float, Field(ge=0, lt=1)] = 0.925
    cR2: Annotated[float, Field(gt=0)] = 0.15

    @property
    def without_meaning(self) -> tuple[str, ...]:
        """The keys that are given, and that the law does not have."""
        of_laws = ("hardening", "R0", "cR1", "cR2")
        return tuple(k for k in of_laws if k in self.model_fields_set and k not in _LAWS[self.law].model_fields)

    @property
    def material(self) -> Material:
        """The steel as the materials of a plane frame are written."""
        found = _LAWS[self.law]
        return found.model_construct(**{key: getattr(self, key) for key in found.model_fields})
