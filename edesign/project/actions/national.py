"""Nationally determined parameters that a file states in place of those of the country."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.project.notation.units import Factor, PositiveFactor, PositiveRatio, PositiveTime, UnitRatio, parse_ratio
from edesign.project.notation.written import Written, items, ratio
from edesign.project.reading.base import Model, refuse

ImportanceClass = Literal["I", "II", "III", "IV"]
Occupancy = Literal["roof", "correlated", "independent", "other"]
Category = Literal["A", "B", "C", "D", "E", "F", "G", "H", "snow", "snow_above_1000_m", "wind", "temperature"]


def _psi(value: Any) -> tuple[float, float, float]:
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise refuse("psi_0, psi_1 and psi_2 are needed, for example `[0.7, 0.5, 0.3]`")
    psi_0, psi_1, psi_2 = (parse_ratio(of, 0.0, 1.0) for of in value)
    if psi_1 < psi_2:
        raise refuse(
            f"psi_1 = {psi_1:g} is less than psi_2 = {psi_2:g}: frequent values are at least quasi-permanent ones"
        )
    return psi_0, psi_1, psi_2


def by_importance(value: Any) -> Any:
    """Check that the factor of class II is 1, by which all others are defined."""
    if isinstance(value, dict) and "II" in value and value["II"] != 1.0:
        raise refuse("gamma_I of class II is 1.0 by definition (EN 1998-1, 4.2.5(5)P)", "II")
    return value


Psi = Annotated[tuple[float, float, float], Written(_psi, items(*(ratio(0.0, 1.0),) * 3))]
"""psi_0, psi_1 and psi_2."""


class VerticalSpectrumParameters(Model):
    """a_vg / a_g, corner periods (s) and largest amplification of the vertical spectrum (EN 1998-1, 3.2.2.3(1)P)."""

    ratio: PositiveFactor | None = None
    F_0: PositiveFactor | None = None
    T_B: PositiveTime | None = None
    T_C: PositiveTime | None = None
    T_D: PositiveTime | None = None


class ActionFactors(Model):
    """Partial factors of actions and xi of Eq. 6.10b (EN 1990, Table A1.2(B))."""

    G_sup: Factor | None = None
    G_inf: Factor | None = None
    Q: Factor | None = None
    xi: UnitRatio | None = None


class ResistanceFactors(Model):
    """Partial factors of resistance (EN 1993-1-1, 6.1(1))."""

    M0: PositiveFactor | None = None
    M1: PositiveFactor | None = None
    M2: PositiveFactor | None = None


class NationalValues(Model):
    """Parameters of EN 1990, EN 1993-1-1 and EN 1998-1 that the file states; names as in the data of the countries.

    Of a table those entries count that are given; the rest stays that of the country, or recommended.
    """

    vertical: VerticalSpectrumParameters | None = None
    lower_bound_factor: UnitRatio | None = None
    importance_factors: Annotated[dict[ImportanceClass, PositiveFactor], BeforeValidator(by_importance)] | None = None
    phi: dict[Occupancy, UnitRatio] | None = None
    displacement_reduction: dict[ImportanceClass, PositiveRatio] | None = None
    low_ductility_q: Annotated[float, Field(ge=1.0, le=2.0)] | None = None
    material_overstrength: Annotated[float, Field(ge=1.0)] | None = None
    post_buckling: UnitRatio | None = None
    psi: dict[Category, Psi] | None = None
    action_factors: ActionFactors | None = None
    resistance_factors: ResistanceFactors | None = None

    def stated(self) -> dict[str, Any]:
        """Return what the file states, by name; tables as mappings."""
        return self.model_dump(exclude_none=True)
