"""The seismic action at the site: code, ground acceleration, ground, and the levels that are looked at."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from edesign.project.base import Model, refuse
from edesign.project.national import NationalValues
from edesign.project.units import (
    TIME,
    PositiveAcceleration,
    PositiveFactor,
    PositiveRatio,
    PositiveTime,
    parse_quantity,
    parse_ratio,
)

YEAR = 365.25 * 86400.0
"""The Julian year that units of the project file mean by `year`, s."""

LevelName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


def _zone(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (int, str)) or not str(value).strip():
        raise refuse("a zone of the country is needed: its number or name, for example `3` or `Z3`")
    return str(value).strip()


def _spectrum_type(value: Any) -> int:
    if type(value) is not int or value not in (1, 2):  # `true` is equal to 1
        raise refuse("the type of spectrum is 1 or 2")
    return value


def _probability(value: Any) -> float:
    return parse_ratio(value, 0.0, 1.0, low_allowed=False, high_allowed=False)


def _behaviour_factor(value: Any) -> float:
    return parse_ratio(value, 1.0, math.inf)


def _return_period(value: Any) -> float:
    seconds = parse_quantity(value, TIME, "positive")
    if seconds < YEAR * (1.0 - 1e-9):
        raise refuse(f"`{value}` is shorter than a year; a return period is written like `475 year`")
    return seconds


class SpectrumParameters(Model):
    """Values of the site that replace those of the table: soil factor, and corner periods in s."""

    S: PositiveFactor | None = None
    T_B: PositiveTime | None = None
    T_C: PositiveTime | None = None
    T_D: PositiveTime | None = None


class Level(Model):
    """A hazard level, by exactly one of: probability of exceedance in 50 years, return period (s), class, factor."""

    probability: Annotated[float, BeforeValidator(_probability)] | None = None
    return_period: Annotated[float, BeforeValidator(_return_period)] | None = None
    importance_class: Literal["I", "II", "III", "IV"] | None = None
    gamma_I: PositiveFactor | None = None


class Hazard(Model):
    """The reference action (`zone` of a `country`, or `a_gR` in m/s2), the shape of its spectrum, and the levels.

    `national` states parameters in place of those of the country.
    `damping` is that of the elastic spectrum, `behaviour_factor` belongs to the design spectrum, `k` is the exponent of
    the hazard curve that levels given by probability or return period need.
    """

    code: Literal["ec8-2004"]
    country: str | None = None
    zone: Annotated[str, BeforeValidator(_zone)] | None = None
    a_gR: PositiveAcceleration | None = None
    ground: Literal["A", "B", "C", "D", "E"]
    spectrum: Annotated[Literal[1, 2], BeforeValidator(_spectrum_type)]
    damping: PositiveRatio = 0.05
    parameters: SpectrumParameters = SpectrumParameters()
    national: NationalValues = NationalValues()
    behaviour_factor: Annotated[float, BeforeValidator(_behaviour_factor)] | None = None
    k: PositiveFactor | None = None
    levels: dict[LevelName, Level] = {}
