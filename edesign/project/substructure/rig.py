"""The rig: how the actuator follows its command, how far, fast and strong it is, and what the rig gives way."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, FiniteFloat, Tag

from edesign.project.notation.units import (
    Duration,
    PositiveFactor,
    PositiveForce,
    PositiveLength,
    PositiveStiffness,
    PositiveTime,
    PositiveVelocity,
)
from edesign.project.reading.base import Model, by_key
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
    """What the actuator reaches to either side: m, m/s, N; None: no limit.

    `velocity` is that of the piston without load at full flow, `force` that at which it stands still.
    """

    stroke: PositiveLength | None = None
    velocity: PositiveVelocity | None = None
    force: PositiveForce | None = None


class Flexibility(Model):
    """The stiffness (N/m) between actuator and specimen.

    `corrected`: the command is increased by what the encoder at the specimen is behind the actuator's own transducer.
    """

    stiffness: PositiveStiffness
    corrected: bool = True


class _Rig(Model):
    """What all rigs share."""

    limits: Limits = Limits()
    flexibility: Flexibility | None = None


class IdealRig(_Rig):
    """A rig that does what it is told, at once."""

    kind: Literal["ideal"]


class DelayRig(_Rig):
    """A pure delay (s), and a gain."""

    kind: Literal["delay"]
    delay: Delay
    gain: PositiveFactor = 1.0


class FirstOrderRig(_Rig):
    """gain exp(-delay s) / (time_constant s + 1)."""

    kind: Literal["first_order"]
    time_constant: PositiveTime
    delay: Delay = 0.0
    gain: PositiveFactor = 1.0


class SecondOrderRig(_Rig):
    """gain exp(-delay s) w^2 / (s^2 + 2 damping w s + w^2), w = 2 pi frequency (Hz)."""

    kind: Literal["second_order"]
    frequency: Hertz
    damping: PositiveFactor
    delay: Delay = 0.0
    gain: PositiveFactor = 1.0


class TransferFunctionRig(_Rig):
    """numerator(s) / denominator(s) exp(-delay s); coefficients in SI units, the highest power of s first."""

    kind: Literal["transfer_function"]
    numerator: Annotated[tuple[float, ...], Field(min_length=1)]
    denominator: Annotated[tuple[float, ...], Field(min_length=1, max_length=MOST_STATES + 1)]
    delay: Delay = 0.0


class ServoHydraulicRig(_Rig):
    """A valve in a displacement loop, and the oil: valve_time_constant q' + q = proportional_gain (u - x), u late.

    q is the velocity of the piston without load. The force of the specimen shortens the column of oil and, with
    limits of velocity and force, takes from the flow. `oil_stiffness` None: it does not give way.
    """

    kind: Literal["servo_hydraulic"]
    proportional_gain: Rate
    valve_time_constant: Duration = 0.0
    delay: Delay = 0.0
    oil_stiffness: PositiveStiffness | None = None


class RigInFile(_Rig):
    """A rig that stands in a file of its own; its limits and flexibility count unless they are given here."""

    file: Annotated[str, Field(min_length=1)]


def _which(value: Any) -> str:
    in_file = "file" in value if isinstance(value, Mapping) else isinstance(value, RigInFile)
    return "?file" if in_file else by_key("kind")(value)


RigModel = Annotated[
    Annotated[IdealRig, Tag("?kind=ideal")]
    | Annotated[DelayRig, Tag("?kind=delay")]
    | Annotated[FirstOrderRig, Tag("?kind=first_order")]
    | Annotated[SecondOrderRig, Tag("?kind=second_order")]
    | Annotated[TransferFunctionRig, Tag("?kind=transfer_function")]
    | Annotated[ServoHydraulicRig, Tag("?kind=servo_hydraulic")],
    Discriminator(by_key("kind")),
]
"""A rig whose behaviour is known."""

AnyRig = Annotated[
    Annotated[IdealRig, Tag("?kind=ideal")]
    | Annotated[DelayRig, Tag("?kind=delay")]
    | Annotated[FirstOrderRig, Tag("?kind=first_order")]
    | Annotated[SecondOrderRig, Tag("?kind=second_order")]
    | Annotated[TransferFunctionRig, Tag("?kind=transfer_function")]
    | Annotated[ServoHydraulicRig, Tag("?kind=servo_hydraulic")]
    | Annotated[RigInFile, Tag("?file")],
    Discriminator(_which),
]


class RigFile(Model):
    """A rig file, as `edesign rts identify` writes it.

    `alpha` are the coefficients a0 (-), a1 (s), a2 (s2) that turn its displacement into its command; `encoder_noise` is
    in m. `standard_errors` say how sure the values are, and `covariance` how their errors go together: in SI, rows and
    columns in the order of `standard_errors`. `source` says what they come from.
    """

    rig: RigModel
    alpha: Alpha | None = None
    encoder_noise: NoNegativeLength | None = None
    standard_errors: dict[str, Any] = {}
    covariance: tuple[tuple[FiniteFloat, ...], ...] | None = None
    source: str = ""
