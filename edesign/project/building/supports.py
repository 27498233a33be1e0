"""Supports of the column bases."""

from __future__ import annotations

from typing import Annotated, Literal

from edesign.project.frame.foundations import FootingSupport
from edesign.project.notation.quantities import ROTATIONAL_STIFFNESS, STIFFNESS
from edesign.project.notation.selections import Numbers
from edesign.project.notation.units import restraint
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

DIRECTIONS = ("ux", "uy", "uz", "rx", "ry", "rz")


Restraint = Literal["fixed", "free"] | float
_DIRECTION = "a direction is `fixed`, `free`, or has a stiffness", "fixed", "free"
Translation = Annotated[Restraint, restraint(STIFFNESS, *_DIRECTION)]
Rotation = Annotated[Restraint, restraint(ROTATIONAL_STIFFNESS, *_DIRECTION)]


class Springs(Model):
    """A support by directions, global.

    Attributes:
        ux: displacement along x: `fixed`, `free`, or a stiffness.
        uy: displacement along y: `fixed`, `free`, or a stiffness.
        uz: displacement upwards: `fixed`, `free`, or a stiffness.
        rx: rotation about x: `fixed`, `free`, or a rotational stiffness.
        ry: rotation about y: `fixed`, `free`, or a rotational stiffness.
        rz: rotation about the vertical axis: `fixed`, `free`, or a rotational stiffness.
    """

    ux: Translation = "fixed"
    uy: Translation = "fixed"
    uz: Translation = "fixed"
    rx: Rotation = "fixed"
    ry: Rotation = "fixed"
    rz: Rotation = "fixed"

    def all(self) -> tuple[Restraint, ...]:
        """The restraints of ux, uy, uz, rx, ry and rz."""
        return self.ux, self.uy, self.uz, self.rx, self.ry, self.rz


FIXED = Springs()
PINNED = Springs(rx="free", ry="free")
"""A pin about both horizontal axes; the turn about the vertical axis is fixed."""


class RestrainedFloors(Model):
    """Floors above the base that the ground holds in plan, as of a basement; a spring is that of the whole floor.

    Attributes:
        floors: floors that are held.
        ux: displacement along x: `fixed`, `free`, or a stiffness.
        uy: displacement along y: `fixed`, `free`, or a stiffness.
        rz: rotation about the vertical axis: `fixed`, `free`, or a rotational stiffness.
    """

    floors: Numbers
    ux: Translation = "fixed"
    uy: Translation = "fixed"
    rz: Rotation = "fixed"

    def all(self) -> tuple[Restraint, ...]:
        """The restraints of ux, uy, uz, rx, ry and rz."""
        return self.ux, self.uy, "free", "free", "free", self.rz


Support = Annotated[
    Literal["fixed", "pinned"] | Springs | FootingSupport, OneOf(otherwise=Springs, footing=FootingSupport)
]


def springs_of(support: Literal["fixed", "pinned"] | Springs | FootingSupport) -> Springs | FootingSupport:
    """Return a support by directions; a footing as it is."""
    if not isinstance(support, str):
        return support
    return FIXED if support == "fixed" else PINNED
