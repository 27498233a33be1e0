"""What holds the feet of a plane frame's columns."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Tag

from edesign.project.base import Model, by_shape, refuse
from edesign.project.units import (
    FORCE,
    MOMENT,
    ROTATIONAL_STIFFNESS,
    STIFFNESS,
    Hardening,
    Kind,
    parse_quantity,
)

SupportKind = Literal["fixed", "pinned", "roller"]


def _quantity(kind: Kind) -> BeforeValidator:
    def read(value: Any) -> float:
        return parse_quantity(value, kind, "positive")

    return BeforeValidator(read)


def _held(kind: Kind) -> BeforeValidator:
    def read(value: Any) -> Any:
        if isinstance(value, str) and value in ("fixed", "free"):
            return value
        try:
            return parse_quantity(value, kind, "positive")
        except ValueError as error:
            raise refuse(f"a direction is `fixed`, `free`, a stiffness, or a mapping with one: {error}") from None

    return BeforeValidator(read)


class YieldingTranslation(Model):
    """A spring along a direction; with a resistance it yields."""

    stiffness: Annotated[float, _quantity(STIFFNESS)]
    resistance: Annotated[float, _quantity(FORCE)] | None = None
    hardening: Hardening = 0.0


class VerticalSpring(YieldingTranslation):
    """A vertical spring; with uplift it carries no tension, and `resistance` is that to being pressed down."""

    uplift: bool = False


class YieldingRotation(Model):
    """A spring that turns; with a resistance it yields."""

    stiffness: Annotated[float, _quantity(ROTATIONAL_STIFFNESS)]
    resistance: Annotated[float, _quantity(MOMENT)] | None = None
    hardening: Hardening = 0.0


Held = Literal["fixed", "free"] | float
Horizontal = Annotated[
    Annotated[Annotated[Held, _held(STIFFNESS)], Tag("?plain")] | Annotated[YieldingTranslation, Tag("?mapping")],
    Discriminator(by_shape),
]
Vertical = Annotated[
    Annotated[Annotated[Held, _held(STIFFNESS)], Tag("?plain")] | Annotated[VerticalSpring, Tag("?mapping")],
    Discriminator(by_shape),
]
Turning = Annotated[
    Annotated[Annotated[Held, _held(ROTATIONAL_STIFFNESS)], Tag("?plain")]
    | Annotated[YieldingRotation, Tag("?mapping")],
    Discriminator(by_shape),
]


class SupportSprings(Model):
    """A support by directions: `fixed`, `free`, or a spring."""

    horizontal: Horizontal = "fixed"
    vertical: Vertical = "fixed"
    rotation: Turning = "fixed"


Support = Annotated[
    Annotated[SupportKind, Tag("?plain")] | Annotated[SupportSprings, Tag("?mapping")], Discriminator(by_shape)
]


def support_name(support: SupportKind | SupportSprings) -> str:
    """Return `fixed`, `pinned`, `roller`, or `springs`."""
    return "springs" if isinstance(support, SupportSprings) else support


def springs_of(support: SupportKind | SupportSprings) -> SupportSprings:
    """Return a support by directions."""
    if isinstance(support, SupportSprings):
        return support
    return SupportSprings(
        horizontal="free" if support == "roller" else "fixed",
        rotation="fixed" if support == "fixed" else "free",
    )
