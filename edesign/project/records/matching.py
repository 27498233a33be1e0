"""How records are fitted to the spectrum of the hazard."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.project.actions.hazard_base import LevelName
from edesign.project.notation.units import PositiveFactor, PositiveTime
from edesign.project.reading.base import Model, refuse


def _ascending(value: Any) -> Any:
    """Two bounds, the lower one first; they are still text here, so the values are compared after reading."""
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise refuse("two bounds are needed, the lower one first, for example `[0.05 s, 6 s]` [E-VALUE-04]")
    return tuple(value)


PeriodBand = Annotated[tuple[PositiveTime, PositiveTime], BeforeValidator(_ascending)]
FactorBounds = Annotated[tuple[PositiveFactor, PositiveFactor], BeforeValidator(_ascending)]


class Matching(Model):
    """Fit of a record to the 5 % (or other) elastic spectrum of the `hazard` at gamma_I = 1.

    Attributes:
        level: level that the record is fitted to, where each level has a spectrum of its own.
        component: component of the ground motion whose spectrum the record is fitted to.
        method: wavelets in the time domain, a factor on the Fourier transform, or one constant factor.
        periods: band of the fit, the shorter period first.
        scale_bounds: bounds of the constant factor that is applied before the shape is changed.
    """

    level: LevelName | None = None
    component: Literal["horizontal", "vertical"] = "horizontal"
    method: Literal["wavelets", "frequency", "scale"] = "wavelets"
    periods: PeriodBand = Field(default=(0.05, 6.0))
    scale_bounds: FactorBounds = Field(default=(0.1, 10.0))
