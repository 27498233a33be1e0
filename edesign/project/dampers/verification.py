"""Time histories that verify a design of dampers: motions, criteria, and how long the search may go on."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.several import Names
from edesign.project.notation.units import Duration, PositiveRatio
from edesign.project.reading.base import Model

Rounds = Annotated[int, Field(ge=1, le=100)]
Budget = Annotated[int, Field(ge=1, le=1_000_000)]


class AnyVerify(Model):
    """The motions of the histories, and the criteria that have to be met.

    Attributes:
        records: records of the project for the histories.
        levels: hazard levels of the histories.
        criteria: criteria of the study that have to be met.
        free_vibration: time after the end of each record.
    """

    records: Names
    levels: Names | None = None
    criteria: Names
    free_vibration: Duration = 0.0


class LoopVerify(AnyVerify):
    """Rounds of histories, changing something, until the criteria are met.

    Attributes:
        rounds: largest number of rounds that may be tried.
        precision: relative width at which the search for the smallest value ends.
    """

    rounds: Rounds = 8
    precision: PositiveRatio = 0.05


class Verify(LoopVerify):
    """Of dampers with layers.

    Attributes:
        change: what a round that misses changes: the target, the area, or the thickness at the same stiffness.
    """

    change: Literal["target", "area", "thickness"] = "target"


class ViscousVerify(LoopVerify):
    """Of viscous dampers.

    Attributes:
        change: what a round that misses changes.
    """

    change: Literal["target", "coefficient"] = "target"


class HystereticVerify(LoopVerify):
    """Of hysteretic dampers.

    Attributes:
        rounds: largest number of rounds that may be tried.
        change: what a round that misses changes.
    """

    rounds: Rounds = 12
    change: Literal["target", "yield_force"] = "target"


class PlacementVerify(AnyVerify):
    """Of a placement.

    Attributes:
        budget: largest number of histories that the search runs.
    """

    budget: Budget = 500
