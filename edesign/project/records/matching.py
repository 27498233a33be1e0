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
        raise refuse("two bounds are needed, the lower one first, for example `[0.05 s, 6 s]`")
    return tuple(value)


PeriodBand = Annotated[tuple[PositiveTime, PositiveTime], BeforeValidator(_ascending)]
FactorBounds = Annotated[tuple[PositiveFactor, PositiveFactor], BeforeValidator(_ascending)]


class Matching(Model):
    """Fit of a record to the 5 % (or other) elastic spectrum of the `hazard` at gamma_I = 1.

    Where each level of the hazard has a spectrum of its own, `level` says which. A record of the vertical `component`
    is fitted to the vertical spectrum.

    `method` is `wavelets` (time domain), `frequency` (Fourier transform) or `scale` (one factor, shape unchanged);
    `periods` (s) is the band of the fit, `scale_bounds` limits the constant factor.
    """

    level: LevelName | None = None
    component: Literal["horizontal", "vertical"] = "horizontal"
    method: Literal["wavelets", "frequency", "scale"] = "wavelets"
    periods: PeriodBand = Field(default=(0.05, 6.0))
    scale_bounds: FactorBounds = Field(default=(0.1, 10.0))
