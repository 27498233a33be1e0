"""What a pushover pushes with, how far, and which target displacements are found from it."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.analysis.damping import ModeNumber
from edesign.project.analysis.shaking import Eccentric
from edesign.project.notation.several import Names, ShortName, several
from edesign.project.notation.units import Factor, PositiveRatio, PushedDrift
from edesign.project.notation.written import Written, one_or_list
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Steps = Annotated[int, Field(ge=1, le=1_000_000)]
PUSHOVER_STEPS = 200

NamedPattern = Literal["first_mode", "uniform", "triangular"]
FrameDirections = Literal["right", "left", "both"]
BuildingDirections = Literal["x+", "x-", "y+", "y-", "x", "y", "all"]
Directions = Literal[FrameDirections, BuildingDirections]
SEVERAL = {"both": ("right", "left"), "x": ("x+", "x-"), "y": ("y+", "y-"), "all": ("x+", "x-", "y+", "y-")}
"""Directions that one word stands for."""
WAYS = {
    "right": ("", 1.0),
    "left": ("", -1.0),
    "x+": ("x", 1.0),
    "x-": ("x", -1.0),
    "y+": ("y", 1.0),
    "y-": ("y", -1.0),
}
"""Axis, "" of a plane frame, and sign of each direction."""
SIDES = {"right": "to the right", "left": "to the left"} | {
    **{axis: f"along {axis}" for axis in ("x", "y")},
    **{f"{axis}{sign}": f"towards {sign}{axis}" for axis in ("x", "y") for sign in ("+", "-")},
}
"""Directions of pushes, as people read them."""
Method = Literal["n2", "fema356", "asce41"]
SiteClass = Literal["A", "B", "C", "D", "E", "F"]

METHODS: dict[Method, str] = {"n2": "N2", "fema356": "FEMA 356", "asce41": "ASCE 41"}
"""Methods for target displacements, as people read them."""


class GivenPattern(Model):
    """Lateral forces by exactly one of the keys.

    Attributes:
        mode: mass times this mode.
        modes: storey shears of the first so many modes under the spectrum of the hazard, by the root of the sum of
            squares.
        floors: shares of the floors from the lowest.
    """

    mode: ModeNumber | None = None
    modes: Annotated[int, Field(ge=2)] | None = None
    floors: Annotated[tuple[Factor, ...], Field(min_length=1)] | None = None

    @property
    def given(self) -> tuple[str, ...]:
        """The keys that are given."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)

    @property
    def name(self) -> str:
        """The name of the pattern in names of analyses."""
        if self.floors is not None:
            return "floors"
        return f"mode_{self.mode}" if self.mode is not None else f"modes_{self.modes}"


Pattern = NamedPattern | GivenPattern
_Choice = Annotated[NamedPattern | GivenPattern, OneOf()]


class Pushover(Model):
    """Lateral loads of fixed patterns under gravity, each up to a roof drift (roof displacement / height).

    Attributes:
        pattern: lateral forces; a list stands for several pushovers.
        direction: in which the structure is pushed; some words stand for several pushovers.
        roof_drift: last roof displacement over the height; without the key 150 % of the largest target displacement.
        steps: number of equal steps.
        targets: methods for target displacements, each a push of its own to every level.
        levels: hazard levels that targets are found for; without the key all.
        damping: damping of the spectrum that targets are taken from; without the key that of the hazard.
        site_class: site class of ASCE/SEI 41; without the key by the ground type.
    """

    pattern: Annotated[tuple[_Choice, ...], Field(min_length=1), Written(several, one_or_list)]
    direction: Directions
    roof_drift: PushedDrift | None = None
    steps: Steps = PUSHOVER_STEPS
    targets: Annotated[tuple[Method, ...], Written(several, one_or_list)] = ()
    levels: Names | None = None
    damping: PositiveRatio | None = None
    site_class: SiteClass | None = None

    @property
    def directions(self) -> tuple[str, ...]:
        """The directions in which the structure is pushed, one by one."""
        return SEVERAL.get(self.direction, (self.direction,))

    @property
    def axis(self) -> str:
        """The axis along which the structure is pushed in its first direction; "" of a plane frame."""
        return WAYS[self.directions[0]][0]

    @property
    def sign(self) -> float:
        """1 if it is pushed to the right or along the axis in its first direction, -1 if against it."""
        return WAYS[self.directions[0]][1]


class Pushovers(Pushover, Eccentric):
    """Pushovers of variants of a study, named VARIANT.NAME.

    Attributes:
        name: name of the pushovers, of letters, digits and `_ + -`.
        direction: in which a frame is pushed, `both` for two pushovers; a building needs one of its own: `x` stands for
            `x+` and `x-`, `y` likewise, `all` for all four.
        variants: variants of the study, or `all`.
    """

    direction: Directions = "right"
    name: ShortName = "push"
    variants: Names = ("all",)


def pattern_name(pattern: Pattern) -> str:
    """Return the name of a pattern in names of analyses."""
    return pattern.name if isinstance(pattern, GivenPattern) else pattern
