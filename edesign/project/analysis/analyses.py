"""What to analyse."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.analysis.damping import ModeNumber, State
from edesign.project.analysis.pushover import Method, Pushover, Steps
from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.notation.units import (
    Duration,
    PositiveAcceleration,
    PositiveFactor,
    PositiveLength,
    PositiveRatio,
    SignedFactor,
)
from edesign.project.reading.base import Model, by_key

Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.-]*$", max_length=64)]
Label = Annotated[str, Field(max_length=64)]


class _Analysis(Model):
    """What all analyses share: a unique name, a label of the variant, and whether it has its dampers."""

    name: Name
    variant: Label = ""
    dampers: bool = True


class ModalAnalysis(_Analysis):
    """Periods, shapes and modal masses of the first `modes` modes.

    Dampers add their stiffness in steady vibration in the first mode, with an amplitude `damper_strain` of their layers
    or `damper_deformation` (m); with neither the `design_deformation` of the device, or small vibrations.
    """

    kind: Literal["modal"]
    modes: ModeNumber
    state: State = "gravity"
    damper_strain: PositiveFactor | None = None
    damper_deformation: PositiveLength | None = None


class GravityAnalysis(_Analysis):
    """The gravity combination in equal steps."""

    kind: Literal["gravity"]
    steps: Steps = 10


class PushoverAnalysis(_Analysis, Pushover):
    """Pushovers: one of each pattern and direction, and of each method and level one up to its target displacement."""

    kind: Literal["pushover"]


class TargetAnalysis(_Analysis, Pushover):
    """A pushover up to the target displacement of one method and level; part of the plan, no kind of the file."""

    kind: Literal["target"]
    method: Method
    level: Label


class VerticalMotion(Model):
    """Vertical ground motion beside the horizontal one: `ratio` times the same record, or another `record`.

    A `ratio` below 0 moves the ground down where the record is positive. The other record is scaled as the horizontal
    one, or to its own peak `pga` (m/s2), or by `scale`.
    """

    ratio: SignedFactor | None = None
    record: str | None = None
    pga: PositiveAcceleration | None = None
    scale: PositiveFactor | None = None


class HistoryAnalysis(_Analysis):
    """The response to a record under gravity.

    The record is scaled to the peak `pga` (m/s2), or by `scale`; without both it is used as recorded. `vertical` is the
    ground motion upwards beside it. `free_vibration` (s) is added after the end. `level` is a free label of the hazard
    level. With `wave_passage` the motion comes later to some feet. With `collapse_drift` the history ends as collapsed
    when the drift ratio of a storey passes it.
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


Analysis = Annotated[
    Annotated[ModalAnalysis, Tag("?kind=modal")]
    | Annotated[GravityAnalysis, Tag("?kind=gravity")]
    | Annotated[PushoverAnalysis, Tag("?kind=pushover")]
    | Annotated[HistoryAnalysis, Tag("?kind=history")],
    Discriminator(by_key("kind")),
]

PlannedAnalysis = Analysis | TargetAnalysis
"""What a plan is made of."""
