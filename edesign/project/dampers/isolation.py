"""Base isolation: isolators under the column lines, what acts beside them, and the base that stands on them."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.frame.sections import SectionAxis
from edesign.project.frame.supports import Turning, Vertical
from edesign.project.notation.selections import ALL_LINES, Lines
from edesign.project.notation.units import LineLoad, PositiveArea, PositiveFactor, PositiveLength, PositiveMass
from edesign.project.reading.base import Model

Count = Annotated[int, Field(ge=1, le=1000)]

WEIGHED = "friction_pendulum"
"""The law whose forces are proportional to the weight on it, which is its first parameter."""
NEEDS_STIFFNESS = "what presses on the isolator at every moment is known where its `vertical` has a stiffness"


class BaseDevice(Model):
    """A law between the ground and the base, horizontally, at some column lines; `number` of them at each.

    Layers are those of the law's prototype unless given. `scale` multiplies the forces of a law without prototype.
    """

    lines: Lines = ALL_LINES
    law: str
    number: Count = 1
    layers: Count | None = None
    layer_area: PositiveArea | None = None
    layer_thickness: PositiveLength | None = None
    scale: PositiveFactor | None = None


class Isolator(BaseDevice):
    """An isolator under some column lines, which carries the column.

    `vertical` is what one of them is in that direction. A friction pendulum has the `weight` that stands on it under
    the gravity combination, or in histories at every moment, or that of its law.
    """

    vertical: Vertical = "fixed"
    weight: Literal["gravity", "varying", "law"] | None = None


class BaseBeams(Model):
    """Elastic beams of an isolated base, from the foot of each column to the next one."""

    section: str
    material: str
    axis: SectionAxis = "strong"


class IsolatedBase(Model):
    """The slab or grid of beams on the isolators, rigid horizontally, at floor 0.

    `G` and `Q` are its loads along the frame (N/m); `mass` (kg) is all of it, without it the base has that of its loads
    if `masses.from_loads` says so. The feet of the columns turn with its `beams`; or `rotation` holds them, as a
    support would.
    """

    G: LineLoad = 0.0
    Q: LineLoad = 0.0
    mass: PositiveMass | None = None
    beams: BaseBeams | None = None
    rotation: Turning | None = None


class Isolation(Model):
    """An isolated base; its isolators count in natural modes at `design_displacement` (m)."""

    isolators: Annotated[tuple[Isolator, ...], Field(min_length=1)]
    beside: tuple[BaseDevice, ...] = ()
    base: IsolatedBase
    design_displacement: PositiveLength
