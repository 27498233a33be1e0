"""The loop: sensors, time steps, and how the numerical part is integrated."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import PositiveForce, PositiveLength, PositiveTime, UnitRatio
from edesign.project.reading.base import Model
from edesign.project.substructure.quantities import Delay, NoNegativeForce, NoNegativeLength, Steps

Method = Literal[
    "exact",
    "newmark_explicit",
    "central_difference",
    "cr",
    "kr_alpha",
    "chang",
    "alpha_os",
    "bogacki_shampine",
]
ForceOfStep = Literal["extrapolated", "held"]


class Sensors(Model):
    """What the readings add: noise as standard deviations (m, N), and steps of a converter of so many `bits`.

    The ranges (m, N) are to either side; without them they are the limits of stroke and force. `force_delay` is in s.
    """

    encoder_noise: NoNegativeLength | None = None
    force_noise: NoNegativeForce = 0.0
    bits: Annotated[int, Field(ge=4, le=32)] | None = None
    displacement_range: PositiveLength | None = None
    force_range: PositiveForce | None = None
    force_delay: Delay = 0.0


class Loop(Model):
    """The main step (s) of numerical part and compensator, and in how many sub-steps the rig follows.

    `force`: the numerical part takes the force of the specimen extrapolated over the step, or held as it was last.
    `unseen_delay`: main steps from the target to the compensator, which this cannot identify. `seed` is of the noise.
    """

    main_step: PositiveTime = 1e-3
    sub_steps: Annotated[int, Field(ge=1, le=1000)] = 5
    force: ForceOfStep = "extrapolated"
    unseen_delay: Annotated[Steps, Field(le=100)] = 0
    seed: Annotated[int, Field(ge=0)] = 1


class Integration(Model):
    """How the numerical part is integrated; `rho_inf` is of `kr_alpha` only.

    A frame that may yield is integrated as its project says, in `frame_steps` a main step.
    """

    method: Method = "exact"
    rho_inf: UnitRatio = 0.75
    frame_steps: Annotated[int, Field(ge=1, le=1000)] = 1
