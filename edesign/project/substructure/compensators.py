"""Compensators of the delay: each makes the command of the actuator from the target displacement."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.notation.units import Duration, PositiveFactor, PositiveRatio, PositiveStiffness, PositiveTime
from edesign.project.notation.written import Written, as_kept, words_or
from edesign.project.reading.base import Model, by_key
from edesign.project.substructure.quantities import (
    Alpha,
    AlphaList,
    Delay,
    Hertz,
    NoNegativeDashpot,
    NoNegativeLength,
    NoNegativeRate,
    NumberRange,
    Rate,
    TimeRange,
    TimeRate,
    TimeSquaredRange,
    TimeSquaredRate,
)

PolynomialOrder = Annotated[int, Field(ge=0, le=4)]
Spacing = Literal["delay", "step"]
Derivatives = Literal["model", "differences"]


class NoCompensator(Model):
    """The target is the command."""

    kind: Literal["none"]


class PolynomialCompensator(Model):
    """A polynomial through the last order + 1 targets, extrapolated over the `delay` (Horiuchi et al., 1999).

    `spacing`: the targets are a delay apart, or a main step.
    """

    kind: Literal["polynomial"]
    delay: Delay
    order: PolynomialOrder = 3
    spacing: Spacing = "delay"


class LeastSquaresPolynomialCompensator(Model):
    """A polynomial fitted to the last `points` targets, extrapolated over the `delay` (Wallace et al., 2005)."""

    kind: Literal["least_squares_polynomial"]
    delay: Delay
    order: PolynomialOrder
    points: Annotated[int, Field(ge=1, le=256)]


class LinearAccelerationCompensator(Model):
    """The acceleration goes on in a straight line over the `delay` (Horiuchi & Konno, 2001)."""

    kind: Literal["linear_acceleration"]
    delay: Delay


class InverseCompensator(Model):
    """The inverse of a first-order lag that takes as long as the `delay` (Chen & Ricles, 2009)."""

    kind: Literal["inverse"]
    delay: Delay


class PhaseLeadCompensator(Model):
    """(lead s + 1) / (lag s + 1); both times in s."""

    kind: Literal["phase_lead"]
    lead: PositiveTime
    lag: PositiveTime


class FixedAlphaCompensator(Model):
    """Constant coefficients of displacement, velocity, acceleration and jerk, of the first two at least.

    Source: thesis Eq. 6.16.
    """

    kind: Literal["fixed_alpha"]
    alpha: AlphaList


class Filter(Model):
    """Low-pass Butterworth filter of the command and of the measured displacement; the cutoff is in Hz."""

    order: Annotated[int, Field(ge=1, le=8)] = 6
    cutoff: Hertz = 20.0


class AlphaLimits(Model):
    """Least and largest coefficients; the defaults are those of thesis 6.2.4."""

    a0: NumberRange = (0.7, 1.3)
    a1: TimeRange = (0.0, 0.04)
    a2: TimeSquaredRange = (0.0, 8e-4)


class AlphaRates(Model):
    """Largest changes of the coefficients in a second; the defaults are those of thesis 6.2.4."""

    a0: Rate = 2.0
    a1: TimeRate = 0.05
    a2: TimeSquaredRate = 1e-3


def _no_filter(value: Any) -> Any:
    return None if value == "none" else value


class _AdaptiveTimeSeries(Model):
    """What both forms of ATS share.

    The coefficients stay at their `initial` values until the measured displacement exceeds the `threshold` (m).
    `derivatives` of the target come from the numerical part (`model`), or are backward differences (Eq. 6.17).
    """

    initial: Alpha = (1.0, 0.010, 6e-5)
    threshold: NoNegativeLength = 1e-4
    filter: Annotated[Filter | None, Written(_no_filter, words_or(as_kept, "none"))] = Filter()
    limits: AlphaLimits = AlphaLimits()
    rates: AlphaRates = AlphaRates()
    derivatives: Derivatives = "model"


class AtsCompensator(_AdaptiveTimeSeries):
    """Adaptive time series (Chae et al., 2013): least squares over the last `window` (s), one sample in `every`."""

    kind: Literal["ats"]
    window: PositiveTime = 1.0
    every: Annotated[int, Field(ge=1)] = 16


class ModifiedAtsCompensator(_AdaptiveTimeSeries):
    """Adaptive time series with all samples, whose weight falls by `forgetting` in each step (thesis 6.2.3)."""

    kind: Literal["modified_ats"]
    forgetting: PositiveRatio = 0.996


class LiveDelayCompensator(Model):
    """A polynomial over the delay that zero crossings give (Darby et al., 2002); `delay` (s) is where it begins.

    Of each error of the delay the `share` is taken. Crossings count between peaks above the `threshold` (m).
    """

    kind: Literal["live_delay"]
    delay: Delay
    order: PolynomialOrder = 3
    share: PositiveRatio = 0.5
    limits: TimeRange = (0.0, 0.04)
    threshold: NoNegativeLength = 1e-4


class ModelFeedforwardCompensator(Model):
    """The inverse of the rig as a series of two to four terms (Phillips & Spencer, 2013).

    `alpha` None: Taylor's series of the rig of the file, three terms.
    """

    kind: Literal["model_feedforward"]
    alpha: AlphaList | None = None


class SmithCompensator(Model):
    """A Smith predictor: the target is the command, and what the delay costs is added to the measured force.

    Delay (s) and gain are those of the rig, stiffness (N/m) and `damping` (N s/m) those of the specimen.
    """

    kind: Literal["smith"]
    delay: Delay
    stiffness: PositiveStiffness
    damping: NoNegativeDashpot = 0.0
    gain: PositiveFactor = 1.0


class PiPhaseLeadCompensator(Model):
    """A PI controller behind a phase lead of the target: the sample of the benchmark of Silva et al. (2020).

    (proportional + integral / s) on the target led by (lead s + 1) / (lag s + 1), less what is measured.
    """

    kind: Literal["pi_phase_lead"]
    proportional: PositiveFactor
    integral: NoNegativeRate
    lead: Duration
    lag: PositiveTime


Compensator = Annotated[
    Annotated[NoCompensator, Tag("?kind=none")]
    | Annotated[PolynomialCompensator, Tag("?kind=polynomial")]
    | Annotated[LeastSquaresPolynomialCompensator, Tag("?kind=least_squares_polynomial")]
    | Annotated[LinearAccelerationCompensator, Tag("?kind=linear_acceleration")]
    | Annotated[InverseCompensator, Tag("?kind=inverse")]
    | Annotated[PhaseLeadCompensator, Tag("?kind=phase_lead")]
    | Annotated[FixedAlphaCompensator, Tag("?kind=fixed_alpha")]
    | Annotated[AtsCompensator, Tag("?kind=ats")]
    | Annotated[ModifiedAtsCompensator, Tag("?kind=modified_ats")]
    | Annotated[LiveDelayCompensator, Tag("?kind=live_delay")]
    | Annotated[ModelFeedforwardCompensator, Tag("?kind=model_feedforward")]
    | Annotated[SmithCompensator, Tag("?kind=smith")]
    | Annotated[PiPhaseLeadCompensator, Tag("?kind=pi_phase_lead")],
    Discriminator(by_key("kind")),
]
