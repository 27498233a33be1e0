"""What to analyse."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from edesign.project.base import Model, by_key
from edesign.project.damping import ModeNumber, State
from edesign.project.units import Duration, PositiveAcceleration, PositiveFactor, PositiveLength, PositiveRatio

Steps = Annotated[int, Field(ge=1, le=1_000_000)]
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
    or `damper_deformation` (m); with neither their small vibrations count.
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


class PushoverAnalysis(_Analysis):
    """Lateral load of a fixed pattern under gravity, up to a roof drift (roof displacement / height)."""

    kind: Literal["pushover"]
    pattern: Literal["first_mode", "uniform", "triangular"]
    roof_drift: PositiveRatio
    steps: Steps = 200


class HistoryAnalysis(_Analysis):
    """The response to a record under gravity.

    The record is scaled to the peak `pga` (m/s2), or by `scale`; without both it is used as recorded.
    `free_vibration` (s) is added after its end. `level` is a free label of the hazard level. With `collapse_drift` the
    history ends as collapsed when the drift ratio of a storey passes it.
    """

    kind: Literal["history"]
    record: str
    pga: PositiveAcceleration | None = None
    scale: PositiveFactor | None = None
    free_vibration: Duration = 0.0
    level: Label = ""
    collapse_drift: PositiveRatio | None = None


Analysis = Annotated[
    Annotated[ModalAnalysis, Tag("?kind=modal")]
    | Annotated[GravityAnalysis, Tag("?kind=gravity")]
    | Annotated[PushoverAnalysis, Tag("?kind=pushover")]
    | Annotated[HistoryAnalysis, Tag("?kind=history")],
    Discriminator(by_key("kind")),
]
