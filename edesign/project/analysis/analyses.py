"""What to analyse."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.analysis.damping import ModeNumber, State
from edesign.project.analysis.pushover import (
    BuildingDirections,
    FrameDirections,
    Method,
    Pushover,
    Steps,
)
from edesign.project.analysis.shaking import IN_PLACE, Eccentric, Position, Shaking, eccentricity_of
from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.notation.units import (
    Duration,
    PositiveAcceleration,
    PositiveFactor,
    PositiveLength,
    PositiveRatio,
    SignedFactor,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=64)]
Label = Annotated[str, Field(max_length=64)]


class _Analysis(Model):
    """What all analyses share: a unique name, a label of the variant, and whether it has its dampers.

    Attributes:
        name: unique name, of letters, digits and `_ - .`.
        variant: free label of the variant of the building.
        dampers: whether the dampers, isolators and tuned masses are there.
    """

    name: Name
    variant: Label = ""
    dampers: bool = True


class ModalAnalysis(_Analysis):
    """Periods, shapes and modal masses of the first modes.

    Attributes:
        kind: natural modes.
        modes: how many modes.
        state: state of the frame: under the gravity combination, or unloaded.
        damper_strain: shear strain of the layers at which the stiffness of dampers counts; this key or
            `damper_deformation`.
        damper_deformation: deformation at which the stiffness of dampers counts; without both keys that of the devices.
    """

    kind: Literal["modal"]
    modes: ModeNumber
    state: State = "gravity"
    damper_strain: PositiveFactor | None = None
    damper_deformation: PositiveLength | None = None


class GravityAnalysis(_Analysis):
    """The gravity combination in equal steps.

    Attributes:
        kind: the gravity combination alone.
        steps: number of equal steps.
    """

    kind: Literal["gravity"]
    steps: Steps = 10


class PushoverAnalysis(_Analysis, Pushover):
    """Pushovers of a plane frame or of a building.

    Attributes:
        kind: pushovers under gravity.
    """

    kind: Literal["pushover"]


class FramePushover(PushoverAnalysis):
    """Pushovers: one of each pattern and direction, and of each method and level one up to its target displacement.

    Attributes:
        direction: in which the frame is pushed; `both` stands for two pushovers.
    """

    direction: FrameDirections = "right"


class BuildingPushover(PushoverAnalysis, Eccentric):
    """Pushovers: one of each pattern, direction and position of the masses, and to each target displacement one.

    Attributes:
        direction: in which the building is pushed; `x` stands for `x+` and `x-`, `y` likewise, `all` for all four.
    """

    direction: BuildingDirections


class TargetAnalysis(_Analysis, Pushover, Eccentric):
    """A pushover up to the target displacement of one method and level; part of the plan, no kind of the file.

    Attributes:
        kind: a pushover of a plan.
        method: method of the target displacement.
        level: hazard level of the target displacement.
    """

    kind: Literal["target"]
    method: Method
    level: Label


class VerticalMotion(Model):
    """Vertical ground motion beside the horizontal one: a multiple of the same record, or another record.

    Attributes:
        ratio: vertical over horizontal motion of the same record; below 0 the ground goes down where the record is
            positive.
        record: another record as vertical motion, scaled as the horizontal one if nothing else is said.
        pga: peak that the other record is scaled to.
        scale: factor of the other record.
    """

    ratio: SignedFactor | None = None
    record: str | None = None
    pga: PositiveAcceleration | None = None
    scale: PositiveFactor | None = None


class HistoryAnalysis(_Analysis):
    """The response to a record under gravity.

    Attributes:
        kind: a time history.
        record: one of `records`; of a suite all its recordings, some by `only` there, or one as `SUITE/RECORDING`.
        pga: peak that the record is scaled to; not of a fitted record.
        scale: factor of the record; not with `pga`, not of a fitted record.
        free_vibration: time after the end of the record.
        level: hazard level, needed if the record is fitted; without a `hazard` a free label.
        collapse_drift: drift ratio of a storey beyond which the history ends as collapsed; without the key equilibrium
            decides.
        vertical: ground motion upwards beside the record.
        wave_passage: the motion reaches the supports one after the other; without the key all at once.
    """

    kind: Literal["history"]
    record: str
    pga: PositiveAcceleration | None = None
    scale: PositiveFactor | None = None
    free_vibration: Duration = 0.0
    level: Label = ""
    collapse_drift: PositiveRatio | None = None
    vertical: VerticalMotion | None = None
    wave_passage: WavePassage | None = None

    @property
    def angle(self) -> float:
        """By how much the record is turned from x towards y, rad; that of the only one of a history of a plan."""
        return 0.0

    @property
    def position(self) -> Position:
        """Where the masses stand; the only place of a history of a plan."""
        return IN_PLACE

    def eccentricity_with(self, accidental_torsion: float) -> tuple[float, float]:
        """Return by what shares of the lengths of a floor its masses stand beside their places, along x and y.

        Args:
            accidental_torsion: of the building, where the history does not say how far.
        """
        return eccentricity_of(self.position, accidental_torsion)


class BuildingHistory(Shaking, HistoryAnalysis):
    """The response of a building to a record under gravity; a pair acts along x and y at once."""

    @property
    def angle(self) -> float:
        """By how much the record is turned from x towards y, rad; that of the only one of a history of a plan."""
        return self.angles[0]

    @property
    def position(self) -> Position:
        """Where the masses stand; the only place of a history of a plan."""
        return self.eccentricity[0]


Analysis = Annotated[ModalAnalysis | GravityAnalysis | FramePushover | HistoryAnalysis, OneOf("kind")]
"""Of a plane frame."""

BuildingAnalysis = Annotated[ModalAnalysis | GravityAnalysis | BuildingPushover | BuildingHistory, OneOf("kind")]

AnyAnalysis = ModalAnalysis | GravityAnalysis | PushoverAnalysis | HistoryAnalysis

PlannedAnalysis = AnyAnalysis | TargetAnalysis
"""What a plan is made of."""
