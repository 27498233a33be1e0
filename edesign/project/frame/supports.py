"""Supports of the column bases of a plane frame."""

from __future__ import annotations

from typing import Annotated, Literal

from edesign.project.frame.foundations import FootingSupport
from edesign.project.notation.quantities import ROTATIONAL_STIFFNESS, STIFFNESS
from edesign.project.notation.units import (
    Hardening,
    PositiveForce,
    PositiveMoment,
    PositiveRotationalStiffness,
    PositiveStiffness,
    restraint,
)
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

SupportKind = Literal["fixed", "pinned", "roller"]


class YieldingTranslation(Model):
    """A spring along a direction; with a resistance it yields.

    Attributes:
        stiffness: stiffness along the direction.
        resistance: force at which the spring yields; without the key it stays elastic.
        hardening: stiffness after yielding over that before.
    """

    stiffness: PositiveStiffness
    resistance: PositiveForce | None = None
    hardening: Hardening = 0.0


class VerticalSpring(YieldingTranslation):
    """A vertical spring; with uplift it carries no tension, and `resistance` is that to being pressed down.

    Attributes:
        uplift: whether the spring carries no tension; `resistance` is then that to being pressed down.
    """

    uplift: bool = False


class YieldingRotation(Model):
    """A spring that turns; with a resistance it yields.

    Attributes:
        stiffness: rotational stiffness.
        resistance: moment at which the spring yields; without the key it stays elastic.
        hardening: stiffness after yielding over that before.
    """

    stiffness: PositiveRotationalStiffness
    resistance: PositiveMoment | None = None
    hardening: Hardening = 0.0


Restraint = Literal["fixed", "free"] | float
_DIRECTION = "a direction is `fixed`, `free`, a stiffness, or a mapping with one", "fixed", "free"
_Translation = Annotated[Restraint, restraint(STIFFNESS, *_DIRECTION)]
_Rotation = Annotated[Restraint, restraint(ROTATIONAL_STIFFNESS, *_DIRECTION)]
Horizontal = Annotated[_Translation | YieldingTranslation, OneOf()]
Vertical = Annotated[_Translation | VerticalSpring, OneOf()]
Turning = Annotated[_Rotation | YieldingRotation, OneOf()]


class SupportSprings(Model):
    """A support by directions: `fixed`, `free`, or a spring.

    Attributes:
        horizontal: `fixed`, `free`, a stiffness, or a spring that yields.
        vertical: `fixed`, `free`, a stiffness, or a spring that yields or lifts off.
        rotation: `fixed`, `free`, a rotational stiffness, or a spring that yields.
    """

    horizontal: Horizontal = "fixed"
    vertical: Vertical = "fixed"
    rotation: Turning = "fixed"


Support = Annotated[
    SupportKind | SupportSprings | FootingSupport, OneOf(otherwise=SupportSprings, footing=FootingSupport)
]


def support_name(support: SupportKind | SupportSprings | FootingSupport) -> str:
    """Return `fixed`, `pinned`, `roller`, `springs`, or `footing`."""
    if isinstance(support, FootingSupport):
        return "footing"
    return "springs" if isinstance(support, SupportSprings) else support


def springs_of(support: SupportKind | SupportSprings) -> SupportSprings:
    """Return a support by directions."""
    if isinstance(support, SupportSprings):
        return support
    return SupportSprings(
        horizontal="free" if support == "roller" else "fixed",
        rotation="fixed" if support == "fixed" else "free",
    )
