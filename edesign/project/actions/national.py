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
        raise refuse("psi_0, psi_1 and psi_2 are needed, for example `[0.7, 0.5, 0.3]` [E-VALUE-01]")
    psi_0, psi_1, psi_2 = (parse_ratio(of, 0.0, 1.0) for of in value)
    if psi_1 < psi_2:
        raise refuse(
            f"psi_1 = {psi_1:g} is less than psi_2 = {psi_2:g}: frequent values are at least quasi-permanent ones"
            " [E-VALUE-04]"
        )
    return psi_0, psi_1, psi_2


def by_importance(value: Any) -> Any:
    """Check that the factor of class II is 1, by which all others are defined.

    Raises:
        PydanticCustomError: the factor of class II is another one.
    """
    if isinstance(value, dict) and "II" in value and value["II"] != 1.0:
        raise refuse("gamma_I of class II is 1.0 by definition (EN 1998-1, 4.2.5(5)P) [E-VALUE-02]", "II")
    return value


Psi = Annotated[tuple[float, float, float], Written(_psi, items(*(ratio(0.0, 1.0),) * 3))]
"""psi_0, psi_1 and psi_2."""


class VerticalSpectrumParameters(Model):
    """The vertical spectrum (EN 1998-1, 3.2.2.3(1)P).

    Attributes:
        ratio: a_vg over a_g.
        F_0: largest amplification of the vertical spectrum.
        T_B: first corner period.
        T_C: second corner period.
        T_D: third corner period.
    """

    ratio: PositiveFactor | None = None
    F_0: PositiveFactor | None = None
    T_B: PositiveTime | None = None
    T_C: PositiveTime | None = None
    T_D: PositiveTime | None = None


class ActionFactors(Model):
    """Partial factors of actions and xi of Eq. 6.10b (EN 1990, Table A1.2(B)).

    Attributes:
        G_sup: partial factor of unfavourable permanent actions.
        G_inf: partial factor of favourable permanent actions.
        Q: partial factor of variable actions.
        xi: reduction factor of permanent actions in Eq. 6.10b.
    """

    G_sup: Factor | None = None
    G_inf: Factor | None = None
    Q: Factor | None = None
    xi: UnitRatio | None = None


class ResistanceFactors(Model):
    """Partial factors of resistance (EN 1993-1-1, 6.1(1)).

    Attributes:
        M0: partial factor of cross-sections.
        M1: partial factor of members, for instability.
        M2: partial factor of cross-sections in tension to fracture, and of joints.
    """

    M0: PositiveFactor | None = None
    M1: PositiveFactor | None = None
    M2: PositiveFactor | None = None


class NationalValues(Model):
    """Parameters of EN 1990, EN 1993-1-1 and EN 1998-1 that the file states; names as in the data of the countries.

    Of a table those entries count that are given; the rest stays that of the country, or recommended.

    Attributes:
        vertical: vertical spectrum for the type in `spectrum` (EN 1998-1, 3.2.2.3(1)P).
        lower_bound_factor: lower bound beta of the design spectrum (EN 1998-1, 3.2.2.5(4)P).
        importance_factors: gamma_I by importance class (EN 1998-1, 4.2.5(5)P); class II is 1.0.
        phi: factor phi by occupancy of storeys (EN 1998-1, Table 4.2).
        displacement_reduction: reduction nu of the action by importance class (EN 1998-1, 4.4.3.2(2)).
        low_ductility_q: behaviour factor of low ductility, DCL (EN 1998-1, 6.1.2(1)).
        material_overstrength: material overstrength gamma_ov (EN 1998-1, 6.2(3)).
        post_buckling: gamma_pb, what is left of a diagonal in compression (EN 1998-1, 6.7.4(2)).
        psi: psi_0, psi_1 and psi_2 by category (EN 1990, Table A1.1).
        action_factors: partial factors of actions (EN 1990, Table A1.2(B)).
        resistance_factors: partial factors of resistance (EN 1993-1-1, 6.1).
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
        """Return the parameters that the file states, by name; tables are mappings."""
        return self.model_dump(exclude_none=True)
