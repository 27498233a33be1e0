"""What an incremental study says over the life of a building: a hazard curve, years, losses by limit."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from edesign.project.actions.hazard_base import YEAR, LevelName
from edesign.project.notation.several import ShortName
from edesign.project.notation.units import Factor, PositiveAcceleration, PositiveTime, UnitRatio
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Dispersion = Annotated[Factor, Field(le=1.0)]
"""Standard deviation of a logarithm, at most 1, a factor of e. The three sources of FEMA P-695, 7.3.4, requirements,
test data and model, make 0.87 where each is at its worst, 0.5."""


class CurveOfLevels(Model):
    """A hazard curve through levels of the hazard.

    Attributes:
        levels: return period by hazard level.
    """

    levels: Annotated[dict[LevelName, PositiveTime], Field(min_length=2)]


class CurveOfIntensities(Model):
    """A hazard curve as a table.

    Attributes:
        intensities: ascending intensities.
        return_periods: return period of each intensity, ascending.
    """

    intensities: Annotated[tuple[PositiveAcceleration, ...], Field(min_length=2)]
    return_periods: Annotated[tuple[PositiveTime, ...], Field(min_length=2)]


HazardCurve = Annotated[CurveOfLevels | CurveOfIntensities, OneOf(otherwise=CurveOfIntensities, levels=CurveOfLevels)]


class LifeCycle(Model):
    """The rates at which limits are exceeded, and the losses over some years.

    Attributes:
        hazard_curve: how often intensities are exceeded.
        years: years that are looked at.
        dispersion: dispersion of modelling, added to that of the records by the root of the sum of squares.
        losses: loss where a limit is passed, by limit, as a share of the value of the building.
        discount: rate a year at which later losses count less.
    """

    hazard_curve: HazardCurve
    years: PositiveTime = 50.0 * YEAR
    dispersion: Dispersion = 0.0
    losses: dict[ShortName, UnitRatio] = {}
    discount: UnitRatio = 0.0
