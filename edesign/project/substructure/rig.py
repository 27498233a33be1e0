"""The rig: how the actuator follows its command, how far, fast and strong it is, and what the rig gives way."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, FiniteFloat

from edesign.project.notation.units import (
    Duration,
    PositiveFactor,
    PositiveForce,
    PositiveLength,
    PositiveStiffness,
    PositiveTime,
    PositiveVelocity,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
from edesign.project.substructure.quantities import (
    Alpha,
    Delay,
    Hertz,
    NoNegativeLength,
    Rate,
)

MOST_STATES = 12
"""Largest order of a transfer function."""


class Limits(Model):
    """The limits of the actuator to either side; without a key there is no limit.

    Attributes:
        stroke: largest displacement to either side.
        velocity: velocity of the piston without load at full flow.
        force: force at which the piston stands still.
    """

    stroke: PositiveLength | None = None
    velocity: PositiveVelocity | None = None
    force: PositiveForce | None = None


class Flexibility(Model):
    """The flexibility between actuator and specimen.

    Attributes:
        stiffness: stiffness between actuator and specimen.
        corrected: whether the command grows by what the encoder is behind the actuator's own transducer.
    """

    stiffness: PositiveStiffness
    corrected: bool = True


class _Rig(Model):
    """What all rigs share.

    Attributes:
        limits: what the actuator reaches.
        flexibility: what gives way between actuator and specimen; without the key nothing.
    """

    limits: Limits = Limits()
    flexibility: Flexibility | None = None


class IdealRig(_Rig):
    """A rig that follows every command at once.

    Attributes:
        kind: displacement equals command.
    """

    kind: Literal["ideal"]


class DelayRig(_Rig):
    """A pure delay, and a gain.

    Attributes:
        kind: pure delay.
        delay: delay before all else.
        gain: displacement over command at rest.
    """

    kind: Literal["delay"]
    delay: Delay
    gain: PositiveFactor = 1.0


class FirstOrderRig(_Rig):
    """The lag gain exp(-delay s) / (time_constant s + 1).

    Attributes:
        kind: first-order lag.
        time_constant: time constant of the lag.
        delay: delay before all else.
        gain: displacement over command at rest.
    """

    kind: Literal["first_order"]
    time_constant: PositiveTime
    delay: Delay = 0.0
    gain: PositiveFactor = 1.0


class SecondOrderRig(_Rig):
    """The oscillator gain exp(-delay s) w^2 / (s^2 + 2 damping w s + w^2), w = 2 pi frequency.

    Attributes:
        kind: second-order oscillator.
        frequency: own frequency of the oscillator.
        damping: damping ratio of the oscillator.
        delay: delay before all else.
        gain: displacement over command at rest.
    """

    kind: Literal["second_order"]
    frequency: Hertz
    damping: PositiveFactor
    delay: Delay = 0.0
    gain: PositiveFactor = 1.0


class TransferFunctionRig(_Rig):
    """The transfer function numerator(s) / denominator(s) exp(-delay s).

    Attributes:
        kind: transfer function.
        numerator: coefficients in SI units, the highest power of s first.
        denominator: coefficients in SI units, the highest power of s first; at most of order 12.
        delay: delay before all else.
    """

    kind: Literal["transfer_function"]
    numerator: Annotated[tuple[float, ...], Field(min_length=1)]
    denominator: Annotated[tuple[float, ...], Field(min_length=1, max_length=MOST_STATES + 1)]
    delay: Delay = 0.0


class ServoHydraulicRig(_Rig):
    """A valve in a displacement loop, and the oil: valve_time_constant q' + q = proportional_gain (u - x), u late.

    q is the velocity of the piston without load. The force of the specimen shortens the column of oil and, with limits
    of velocity and force, takes from the flow.

    Attributes:
        kind: servo-hydraulic actuator, not linear.
        proportional_gain: gain of the displacement loop.
        valve_time_constant: time constant of the valve.
        delay: delay of the displacement that is fed back.
        oil_stiffness: stiffness of the column of oil; without the key it does not give way.
    """

    kind: Literal["servo_hydraulic"]
    proportional_gain: Rate
    valve_time_constant: Duration = 0.0
    delay: Delay = 0.0
    oil_stiffness: PositiveStiffness | None = None


class RigInFile(_Rig):
    """A rig that stands in a file of its own; its limits and flexibility count unless they are given here.

    Attributes:
        file: rig file, relative to this file; its limits and flexibility count unless they are given here.
    """

    file: Annotated[str, Field(min_length=1)]


RigModel = Annotated[
    IdealRig | DelayRig | FirstOrderRig | SecondOrderRig | TransferFunctionRig | ServoHydraulicRig, OneOf("kind")
]
"""A rig whose behaviour is known."""

AnyRig = Annotated[
    IdealRig | DelayRig | FirstOrderRig | SecondOrderRig | TransferFunctionRig | ServoHydraulicRig | RigInFile,
    OneOf("kind", file=RigInFile),
]


class RigFile(Model):
    """A rig file, as `edesign rts identify` writes it.

    Attributes:
        rig: how the actuator follows its command.
        alpha: coefficients a0 (-), a1 (s), a2 (s^2) that turn the displacement of the rig into its command.
        encoder_noise: standard deviation of the measured displacement.
        standard_errors: standard errors of the values, by name.
        covariance: covariance of the errors, in SI, in the order of `standard_errors`.
        source: what the values come from.
    """

    rig: RigModel
    alpha: Alpha | None = None
    encoder_noise: NoNegativeLength | None = None
    standard_errors: dict[str, Any] = {}
    covariance: tuple[tuple[FiniteFloat, ...], ...] | None = None
    source: str = ""
