"""The programme: what is done with the rig, test by test."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

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
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf
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
    """Noise between two frequencies.

    Attributes:
        type: band-limited noise.
        displacement: peak of the displacement.
        band: least and largest frequency.
        duration: length of the command.
        seed: seed of the noise.
    """

    type: Literal["random"]
    displacement: PositiveLength
    band: Band
    duration: PositiveTime
    seed: Annotated[int, Field(ge=0)] = 1


class SineCommand(Model):
    """Sines of one amplitude, some cycles of each frequency, one after the other.

    Attributes:
        type: sines.
        displacement: amplitude of the displacement.
        frequency: frequency, or a list of them.
        cycles: cycles of each frequency.
        joined: whether the sines follow without a rest between them.
    """

    type: Literal["sine"]
    displacement: PositiveLength
    frequency: Hertzes
    cycles: Annotated[int, Field(ge=1, le=100_000)] = 8
    joined: bool = True


class SweepCommand(Model):
    """A sine of one amplitude whose frequency changes in proportion to time.

    Attributes:
        type: frequency sweep.
        displacement: amplitude of the displacement.
        band: first and last frequency.
        duration: length of the command.
    """

    type: Literal["sweep"]
    displacement: PositiveLength
    band: SweepBand
    duration: PositiveTime


class CommandInFile(Model):
    """A displacement history from a CSV file.

    Attributes:
        file: CSV file of time and displacement, relative to this file.
        displacement: peak that the history is scaled to; without the key it is taken as it is.
    """

    file: Annotated[str, Field(min_length=1)]
    displacement: PositiveLength | None = None


Command = Annotated[RandomCommand | SineCommand | SweepCommand | CommandInFile, OneOf("type", file=CommandInFile)]


class _Test(Model):
    """What all tests share.

    Attributes:
        name: unique name of the test.
    """

    name: TestName


class CommandTest(_Test):
    """The target is given, and the force of the specimen acts on nothing.

    Attributes:
        kind: the target is given.
        command: the target.
    """

    kind: Literal["command"]
    command: Command


class RecordTest(_Test):
    """A test under a record.

    Attributes:
        record: one of `records`; without the key that of the structure's analysis.
        scale: factor of the record; without the key 1, or that of the analysis.
        free_vibration: time after the end of the record; without the key none, or that of the analysis.
    """

    record: Annotated[str, Field(min_length=1)] | None = None
    scale: PositiveFactor | None = None
    free_vibration: Duration | None = None


class RtsTest(RecordTest):
    """A real-time test.

    Attributes:
        kind: a real-time substructure test.
    """

    kind: Literal["rts"]


class Undershoot(Model):
    """The actuator stops short of each increment.

    Attributes:
        kind: undershoot.
        share: share of each increment that is missing.
    """

    kind: Literal["undershoot"]
    share: PositiveRatio


class Lag(Model):
    """The actuator stays behind, against the direction of each increment.

    Attributes:
        kind: lag.
        displacement: displacement by which the actuator is behind.
    """

    kind: Literal["lag"]
    displacement: PositiveLength


class ControlNoise(Model):
    """Where the actuator stops is off at random.

    Attributes:
        kind: random error.
        displacement: standard deviation of the displacement.
        seed: seed of the noise.
    """

    kind: Literal["noise"]
    displacement: PositiveLength
    seed: Annotated[int, Field(ge=0)] = 1


AnyControlError = Annotated[Undershoot | Lag | ControlNoise, OneOf("kind")]


class PseudoDynamicTest(RecordTest):
    """A pseudo-dynamic test, slower than the earthquake.

    Attributes:
        kind: a pseudo-dynamic test.
        physical: whether the damper alone is tested, or the whole structure with an actuator a degree.
        time_scale: how many times as slow as the earthquake.
        error: control error of the actuators; without the key there is none.
        feedback: displacement from which the integration goes on.
    """

    kind: Literal["pseudo_dynamic"]
    physical: Literal["specimen", "structure"] = "specimen"
    time_scale: PositiveFactor = 100.0
    error: AnyControlError | None = None
    feedback: Literal["measured", "computed"] = "measured"


class EffectiveForceTest(RecordTest):
    """An effective force test: the force of the actuator is what the ground would do.

    Attributes:
        kind: an effective force test.
        gain: gain of the force loop.
        oil_stiffness: stiffness of the oil column; without the key it is rigid.
        velocity_feedback: share of the velocity that is fed back.
    """

    kind: Literal["effective_force"]
    gain: PositiveVelocityPerForce
    oil_stiffness: PositiveStiffness | None = None
    velocity_feedback: UnitRatio = 0.0


class Table(Model):
    """A shaking table.

    Attributes:
        mass: mass of the table.
        oil_frequency: frequency of the table on its oil.
        gain: gain of the displacement loop.
        leakage: rate at which the force of the actuator fades; without the key 2 `gain`.
    """

    mass: PositiveMass
    oil_frequency: Hertz
    gain: Rate
    leakage: NoNegativeRate | None = None


class ShakingTableTest(RecordTest):
    """The whole structure on a shaking table.

    Attributes:
        kind: a shaking table test.
        table: the table.
        iterations: corrections of the command before the test.
    """

    kind: Literal["shaking_table"]
    table: Table
    iterations: Annotated[int, Field(ge=0, le=20)] = 0


AnyTest = Annotated[CommandTest | RtsTest | PseudoDynamicTest | EffectiveForceTest | ShakingTableTest, OneOf("kind")]
