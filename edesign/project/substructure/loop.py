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
    """The errors of the readings: noise, and steps of a converter.

    Attributes:
        encoder_noise: standard deviation of the displacement; without the key that of the rig file, or none.
        force_noise: standard deviation of the force.
        bits: bits of the converters of displacement and force; without the key there are no steps.
        displacement_range: range of the displacement to either side; without the key the stroke of the rig.
        force_range: range of the force to either side; without the key the force of the rig.
        force_delay: delay of the load cell and its filter.
    """

    encoder_noise: NoNegativeLength | None = None
    force_noise: NoNegativeForce = 0.0
    bits: Annotated[int, Field(ge=4, le=32)] | None = None
    displacement_range: PositiveLength | None = None
    force_range: PositiveForce | None = None
    force_delay: Delay = 0.0


class Loop(Model):
    """The time steps of the loop.

    Attributes:
        main_step: time step of the numerical part and the compensator.
        sub_steps: steps of the rig in a main step.
        force: whether the force of the specimen is extrapolated over the step, or held as it was last.
        unseen_delay: main steps from the target to the compensator, which this cannot identify.
        seed: seed of the noise.
    """

    main_step: PositiveTime = 1e-3
    sub_steps: Annotated[int, Field(ge=1, le=1000)] = 5
    force: ForceOfStep = "extrapolated"
    unseen_delay: Annotated[Steps, Field(le=100)] = 0
    seed: Annotated[int, Field(ge=0)] = 1


class Integration(Model):
    """The integration of the numerical part.

    Attributes:
        method: method of integration; `exact` is that of a linear numerical part.
        rho_inf: spectral radius at infinite frequency, of `kr_alpha` only.
        frame_steps: steps of a frame that may yield in a main step.
    """

    method: Method = "exact"
    rho_inf: UnitRatio = 0.75
    frame_steps: Annotated[int, Field(ge=1, le=1000)] = 1
