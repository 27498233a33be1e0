"""Time histories that verify a design of dampers: motions, criteria, and how long the search may go on."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.analysis.shaking import IN_PLACE, Angles, EccentricityRatio, Positions
from edesign.project.notation.several import Names
from edesign.project.notation.units import Duration, PositiveRatio
from edesign.project.reading.base import Model

Rounds = Annotated[int, Field(ge=1, le=100)]
Budget = Annotated[int, Field(ge=1, le=1_000_000)]


class AnyVerify(Model):
    """Verification of a design: the motions of its histories, and the criteria that they have to meet.

    Attributes:
        records: records of the project for the histories.
        levels: hazard levels of the histories.
        criteria: criteria of the study that have to be met.
        free_vibration: time after the end of each record.
        angles: of a building, angles by which each record is turned from x towards y; a history becomes one of each.
        eccentricity: of a building, where the masses of rigid floors stand: `0` in place, `+x-y` beside it towards x
            and against y; a history becomes one of each.
        eccentricity_ratio: how far beside it over the length of the floor; without the key `design.accidental_torsion`
            of the building, and 5 % without a design.
    """

    records: Names
    levels: Names | None = None
    criteria: Names
    free_vibration: Duration = 0.0
    angles: Angles = (0.0,)
    eccentricity: Positions = (IN_PLACE,)
    eccentricity_ratio: EccentricityRatio = None


class LoopVerify(AnyVerify):
    """Verification in rounds of histories that change the dampers until the criteria are met.

    Attributes:
        rounds: largest number of rounds that may be tried.
        precision: relative width at which the search for the smallest value ends.
    """

    rounds: Rounds = 8
    precision: PositiveRatio = 0.05


class Verify(LoopVerify):
    """Verification of a design of dampers with layers, in rounds of histories.

    Attributes:
        change: what a round that misses changes: the target, the area, or the thickness at the same stiffness.
    """

    change: Literal["target", "area", "thickness"] = "target"


class ViscousVerify(LoopVerify):
    """Verification of a design of viscous dampers, in rounds of histories.

    Attributes:
        change: what a round that misses changes.
    """

    change: Literal["target", "coefficient"] = "target"


class HystereticVerify(LoopVerify):
    """Verification of a design of hysteretic dampers, in rounds of histories.

    Attributes:
        rounds: largest number of rounds that may be tried.
        change: what a round that misses changes.
    """

    rounds: Rounds = 12
    change: Literal["target", "yield_force"] = "target"


class PlacementVerify(AnyVerify):
    """Verification of the layouts of a placement by histories.

    Attributes:
        budget: largest number of histories that the search runs.
    """

    budget: Budget = 500
