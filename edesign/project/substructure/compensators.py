"""Compensators of the delay: each makes the command of the actuator from the target displacement."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.notation.units import Duration, PositiveFactor, PositiveRatio, PositiveStiffness, PositiveTime
from edesign.project.notation.written import Written, as_kept, words_or
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
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
    """The target is the command.

    Attributes:
        kind: no compensator.
    """

    kind: Literal["none"]


class PolynomialCompensator(Model):
    """A polynomial through the last order + 1 targets, extrapolated over the delay (Horiuchi et al., 1999).

    Attributes:
        kind: polynomial extrapolation.
        delay: delay of the rig.
        order: order of the polynomial.
        spacing: whether the targets are a delay apart, or a main step.
    """

    kind: Literal["polynomial"]
    delay: Delay
    order: PolynomialOrder = 3
    spacing: Spacing = "delay"


class LeastSquaresPolynomialCompensator(Model):
    """A polynomial fitted to the last targets, extrapolated over the delay (Wallace et al., 2005).

    Attributes:
        kind: extrapolation by least squares.
        delay: delay of the rig.
        order: order of the polynomial.
        points: targets that are fitted, a main step apart; at least order + 1.
    """

    kind: Literal["least_squares_polynomial"]
    delay: Delay
    order: PolynomialOrder
    points: Annotated[int, Field(ge=1, le=256)]


class LinearAccelerationCompensator(Model):
    """The acceleration goes on in a straight line over the delay (Horiuchi & Konno, 2001).

    Attributes:
        kind: linear acceleration.
        delay: delay of the rig.
    """

    kind: Literal["linear_acceleration"]
    delay: Delay


class InverseCompensator(Model):
    """The inverse of a first-order lag that takes as long as the delay (Chen & Ricles, 2009).

    Attributes:
        kind: inverse compensation.
        delay: delay of the rig.
    """

    kind: Literal["inverse"]
    delay: Delay


class PhaseLeadCompensator(Model):
    """(lead s + 1) / (lag s + 1).

    Attributes:
        kind: phase lead.
        lead: time constant of the lead, longer than the lag.
        lag: time constant of the lag.
    """

    kind: Literal["phase_lead"]
    lead: PositiveTime
    lag: PositiveTime


class FixedAlphaCompensator(Model):
    """Constant coefficients of displacement, velocity, acceleration and jerk, of the first two at least.

    Attributes:
        kind: constant coefficients.
        alpha: coefficients of displacement (-), velocity (s), acceleration (s^2) and jerk (s^3); two at least.

    Source: thesis Eq. 6.16.
    """

    kind: Literal["fixed_alpha"]
    alpha: AlphaList


class Filter(Model):
    """Low-pass Butterworth filter of the command and of the measured displacement.

    Attributes:
        order: order of the filter: 2, 4, 6 or 8.
        cutoff: cutoff frequency, below half the rate of the main step.
    """

    order: Annotated[int, Field(ge=1, le=8)] = 6
    cutoff: Hertz = 20.0


class AlphaLimits(Model):
    """Least and largest coefficients; the defaults are those of thesis 6.2.4.

    Attributes:
        a0: least and largest coefficient of the displacement.
        a1: least and largest coefficient of the velocity.
        a2: least and largest coefficient of the acceleration.
    """

    a0: NumberRange = (0.7, 1.3)
    a1: TimeRange = (0.0, 0.04)
    a2: TimeSquaredRange = (0.0, 8e-4)


class AlphaRates(Model):
    """Largest changes of the coefficients in a second; the defaults are those of thesis 6.2.4.

    Attributes:
        a0: largest change of the coefficient of the displacement in a second.
        a1: largest change of the coefficient of the velocity in a second.
        a2: largest change of the coefficient of the acceleration in a second.
    """

    a0: Rate = 2.0
    a1: TimeRate = 0.05
    a2: TimeSquaredRate = 1e-3


def _no_filter(value: Any) -> Any:
    return None if value == "none" else value


class _AdaptiveTimeSeries(Model):
    """What both forms of ATS share.

    Attributes:
        initial: coefficients until the measured displacement exceeds the threshold.
        threshold: measured displacement from which on the coefficients adapt.
        filter: filter of the command and of the measured displacement, or `none`.
        limits: least and largest coefficients.
        rates: largest changes of the coefficients in a second.
        derivatives: derivatives of the target: of the numerical part, or backward differences (Eq. 6.17).
    """

    initial: Alpha = (1.0, 0.010, 6e-5)
    threshold: NoNegativeLength = 1e-4
    filter: Annotated[Filter | None, Written(_no_filter, words_or(as_kept, "none"))] = Filter()
    limits: AlphaLimits = AlphaLimits()
    rates: AlphaRates = AlphaRates()
    derivatives: Derivatives = "model"


class AtsCompensator(_AdaptiveTimeSeries):
    """Adaptive time series (Chae et al., 2013), by least squares over the last samples.

    Attributes:
        kind: adaptive time series.
        window: time of the samples that count, in whole main steps.
        every: one sample in so many counts.
    """

    kind: Literal["ats"]
    window: PositiveTime = 1.0
    every: Annotated[int, Field(ge=1)] = 16


class ModifiedAtsCompensator(_AdaptiveTimeSeries):
    """Adaptive time series with all samples, whose weight falls step by step (thesis 6.2.3).

    Attributes:
        kind: modified adaptive time series.
        forgetting: weight of a sample after one step, from 2/3 to 1.
    """

    kind: Literal["modified_ats"]
    forgetting: PositiveRatio = 0.996


class LiveDelayCompensator(Model):
    """A polynomial over the delay that zero crossings give (Darby et al., 2002).

    Attributes:
        kind: delay found during the test.
        delay: delay at the beginning.
        order: order of the polynomial.
        share: share of each error of the delay that is taken.
        limits: least and largest delay.
        threshold: displacement of the peaks between which crossings count.
    """

    kind: Literal["live_delay"]
    delay: Delay
    order: PolynomialOrder = 3
    share: PositiveRatio = 0.5
    limits: TimeRange = (0.0, 0.04)
    threshold: NoNegativeLength = 1e-4


class ModelFeedforwardCompensator(Model):
    """The inverse of the rig as a series of two to four terms (Phillips & Spencer, 2013).

    Attributes:
        kind: feedforward by a model of the rig.
        alpha: coefficients of the series; without the key Taylor's series of the rig of the file, three terms.
    """

    kind: Literal["model_feedforward"]
    alpha: AlphaList | None = None


class SmithCompensator(Model):
    """A Smith predictor: the target is the command, and what the delay costs is added to the measured force.

    Attributes:
        kind: Smith predictor.
        delay: delay of the rig.
        stiffness: stiffness of the specimen in the model.
        damping: damping coefficient of the specimen in the model.
        gain: gain of the rig in the model.
    """

    kind: Literal["smith"]
    delay: Delay
    stiffness: PositiveStiffness
    damping: NoNegativeDashpot = 0.0
    gain: PositiveFactor = 1.0


class PiPhaseLeadCompensator(Model):
    """A PI controller behind a phase lead of the target: the sample of the benchmark of Silva et al. (2020).

    (proportional + integral / s) on the target led by (lead s + 1) / (lag s + 1), less what is measured.

    (proportional + integral / s) on the target led by (lead s + 1) / (lag s + 1), less what is measured.

    Attributes:
        kind: PI controller behind a phase lead.
        proportional: proportional gain of the controller.
        integral: integral gain of the controller.
        lead: time constant of the lead.
        lag: time constant of the lag.
    """

    kind: Literal["pi_phase_lead"]
    proportional: PositiveFactor
    integral: NoNegativeRate
    lead: Duration
    lag: PositiveTime


Compensator = Annotated[
    NoCompensator
    | PolynomialCompensator
    | LeastSquaresPolynomialCompensator
    | LinearAccelerationCompensator
    | InverseCompensator
    | PhaseLeadCompensator
    | FixedAlphaCompensator
    | AtsCompensator
    | ModifiedAtsCompensator
    | LiveDelayCompensator
    | ModelFeedforwardCompensator
    | SmithCompensator
    | PiPhaseLeadCompensator,
    OneOf("kind"),
]
