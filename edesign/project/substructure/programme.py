"""The programme: what is done with the rig, test by test."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.notation.units import (
    Duration,
    PositiveFactor,
    PositiveLength,
    PositiveMass,
    PositiveRatio,
    PositiveStiffness,
    PositiveTime,
    UnitRatio,
)
from edesign.project.reading.base import Model, by_key
from edesign.project.substructure.quantities import (
    Band,
    Hertz,
    Hertzes,
    NoNegativeRate,
    PositiveVelocityPerForce,
    Rate,
    SweepBand,
)

TestName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


class RandomCommand(Model):
    """Noise between two frequencies (Hz) whose peak is the displacement (m)."""

    type: Literal["random"]
    displacement: PositiveLength
    band: Band
    duration: PositiveTime
    seed: Annotated[int, Field(ge=0)] = 1


class SineCommand(Model):
    """Sines of one amplitude (m), so many cycles of each frequency (Hz), one after the other.

    `joined`: without a rest between them.
    """

    type: Literal["sine"]
    displacement: PositiveLength
    frequency: Hertzes
    cycles: Annotated[int, Field(ge=1, le=100_000)] = 8
    joined: bool = True


class SweepCommand(Model):
    """A sine of one amplitude (m) whose frequency goes from one to the other in proportion to time."""

    type: Literal["sweep"]
    displacement: PositiveLength
    band: SweepBand
    duration: PositiveTime


class CommandInFile(Model):
    """A displacement history from a CSV file, scaled to the displacement (m) as its peak if that is given."""

    file: Annotated[str, Field(min_length=1)]
    displacement: PositiveLength | None = None


def _which(value: Any) -> str:
    in_file = "file" in value if isinstance(value, Mapping) else isinstance(value, CommandInFile)
    return "?file" if in_file else by_key("type")(value)


Command = Annotated[
    Annotated[RandomCommand, Tag("?type=random")]
    | Annotated[SineCommand, Tag("?type=sine")]
    | Annotated[SweepCommand, Tag("?type=sweep")]
    | Annotated[CommandInFile, Tag("?file")],
    Discriminator(_which),
]


class _Test(Model):
    """What all tests share."""

    name: TestName


class CommandTest(_Test):
    """The target is given, and the force of the specimen acts on nothing."""

    kind: Literal["command"]
    command: Command


class RecordTest(_Test):
    """A test under a record, scaled, with time after its end (s); without a record that of the structure's analysis."""

    record: Annotated[str, Field(min_length=1)] | None = None
    scale: PositiveFactor | None = None
    free_vibration: Duration | None = None


class RtsTest(RecordTest):
    """A real-time test."""

    kind: Literal["rts"]


class Undershoot(Model):
    """The actuator stops short of each increment by a share of it."""

    kind: Literal["undershoot"]
    share: PositiveRatio


class Lag(Model):
    """The actuator stays behind by a displacement (m), against the direction of each increment."""

    kind: Literal["lag"]
    displacement: PositiveLength


class ControlNoise(Model):
    """Where the actuator stops is off at random, with a standard deviation (m)."""

    kind: Literal["noise"]
    displacement: PositiveLength
    seed: Annotated[int, Field(ge=0)] = 1


AnyControlError = Annotated[
    Annotated[Undershoot, Tag("?kind=undershoot")]
    | Annotated[Lag, Tag("?kind=lag")]
    | Annotated[ControlNoise, Tag("?kind=noise")],
    Discriminator(by_key("kind")),
]


class PseudoDynamicTest(RecordTest):
    """A pseudo-dynamic test, `time_scale` times as slow as the earthquake.

    `physical`: the damper alone is tested, or the whole structure with an actuator a degree. `feedback`: the
    integration goes on from the displacement that was measured, or the one that was computed.
    """

    kind: Literal["pseudo_dynamic"]
    physical: Literal["specimen", "structure"] = "specimen"
    time_scale: PositiveFactor = 100.0
    error: AnyControlError | None = None
    feedback: Literal["measured", "computed"] = "measured"


class EffectiveForceTest(RecordTest):
    """An effective force test: gain of the force loop (m/s/N), oil (N/m), share of the velocity that is fed back."""

    kind: Literal["effective_force"]
    gain: PositiveVelocityPerForce
    oil_stiffness: PositiveStiffness | None = None
    velocity_feedback: UnitRatio = 0.0


class Table(Model):
    """A shaking table: its mass (kg), the frequency of the oil below it (Hz), gain of its loop and leakage (1/s)."""

    mass: PositiveMass
    oil_frequency: Hertz
    gain: Rate
    leakage: NoNegativeRate | None = None


class ShakingTableTest(RecordTest):
    """The whole structure on a shaking table, whose command is corrected in so many iterations before."""

    kind: Literal["shaking_table"]
    table: Table
    iterations: Annotated[int, Field(ge=0, le=20)] = 0


AnyTest = Annotated[
    Annotated[CommandTest, Tag("?kind=command")]
    | Annotated[RtsTest, Tag("?kind=rts")]
    | Annotated[PseudoDynamicTest, Tag("?kind=pseudo_dynamic")]
    | Annotated[EffectiveForceTest, Tag("?kind=effective_force")]
    | Annotated[ShakingTableTest, Tag("?kind=shaking_table")],
    Discriminator(by_key("kind")),
]
