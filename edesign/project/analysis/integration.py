"""Time integration of histories."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import PositiveTime, UnitRatio
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Tolerance = Annotated[float, Field(gt=0, lt=1)]


class _Integration(Model):
    """What all methods share.

    Attributes:
        time_step: step of the analysis; without the key that of the record.
        tolerance: largest unbalanced force over the largest force on a member's end so far, without dimension.
    """

    time_step: PositiveTime | None = None
    tolerance: Tolerance = 1e-7


class NewmarkIntegration(_Integration):
    """Newmark (1959); the defaults are the constant average acceleration.

    Attributes:
        method: Newmark's method.
        gamma: parameter gamma of Newmark.
        beta: parameter beta of Newmark.
    """

    method: Literal["newmark"]
    gamma: Annotated[float, Field(ge=0.5, le=1)] = 0.5
    beta: Annotated[float, Field(gt=0, le=0.5)] = 0.25


class HHTIntegration(_Integration):
    """Hilber, Hughes & Taylor (1977): alpha between -1/3 and 0; 0 is Newmark's average acceleration.

    Attributes:
        method: the method of Hilber, Hughes and Taylor.
        alpha: parameter alpha; 0 has no numerical damping.
    """

    method: Literal["hht"]
    alpha: Annotated[float, Field(ge=-1 / 3, le=0)] = -0.05


class GeneralisedAlphaIntegration(_Integration):
    """Chung & Hulbert (1993): spectral radius at infinite frequency between 0 and 1 (no numerical damping).

    Attributes:
        method: the generalised-alpha method of Chung and Hulbert.
        rho_inf: spectral radius at infinite frequency; 1 has no numerical damping.
    """

    method: Literal["generalised_alpha"]
    rho_inf: UnitRatio = 0.9


Integration = Annotated[NewmarkIntegration | HHTIntegration | GeneralisedAlphaIntegration, OneOf("method")]
