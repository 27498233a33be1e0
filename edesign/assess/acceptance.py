"""Plastic rotations that the performance levels of standards allow the ends of a steel member."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from edesign.codes.asce41 import steel as asce41
from edesign.codes.ec3.classes import (
    class_of_part,
    epsilon,
    internal_part_limits,
    outstand_limits,
    plastic_part_in_compression,
)
from edesign.codes.ec8.verification import existing_steel as en1998_3
from edesign.codes.fema356 import steel as fema356
from edesign.codes.fema356.sections import ISection
from edesign.codes.fema356.strength import column_yield_rotation

Kind = Literal["column", "beam"]
ELASTIC_ROTATION = 0.001
"""Plastic rotation, rad, up to which a member without allowed plastic rotation counts as elastic.

Fibre sections yield from the outside inwards: a plastic rotation of this size is a section whose outer fibres have
yielded, about a tenth of theta_y, and no hinge.
"""


@dataclass(frozen=True)
class FrameMember:
    """Column or beam with what standards ask of it.

    Attributes:
        storey: of a column; of a beam the one below its floor.
        length: between the nodes, m; rigid ends are not deducted.
        strength: P_CL of a column, N; infinite for a beam.
        axis: about which its rotation is limited: "y" of a member of a building, "" of a plane frame, which has one.
        gravity: P_G of a column, N, not negative; None: it is not known, and the largest compression stands for it.
    """

    name: str
    kind: Kind
    storey: int
    length: float
    section: ISection
    strength: float = math.inf
    axis: str = ""
    gravity: float | None = None

    def limits(self, compression: float) -> fema356.RotationLimits | None:
        """Return the plastic rotations that FEMA 356 allows, rad; None for a force-controlled column.

        Args:
            compression: P, N; not negative.
        """
        if self.kind == "beam":
            return self._of_beam
        return fema356.column_rotations(self.section, self.length, compression, self.strength)

    def allowed(self, level: str, compression: float) -> float:
        """Return the plastic rotation that FEMA 356 allows, rad; a force-controlled column stays elastic.

        Args:
            level: IO, LS or CP.
            compression: P, N; not negative.
        """
        limits = self.limits(compression)
        return ELASTIC_ROTATION if limits is None else limits.allowed(level)

    @cached_property
    def _of_beam(self) -> fema356.RotationLimits:
        return fema356.beam_rotations(self.section, self.length)


@dataclass(frozen=True)
class Allowed:
    """Plastic rotations that a standard allows a member.

    Attributes:
        rotations: by performance level, rad; None: the member has to stay elastic.
        axial_ratio: axial force of a column over what the standard divides it by, 0 of beams.
        elastic: why it has to stay elastic, in words; "" where it has not.
    """

    rotations: Mapping[str, float] | None
    axial_ratio: float = 0.0
    elastic: str = ""

    def rotation(self, level: str) -> float:
        """Return the plastic rotation that a level allows, rad; `ELASTIC_ROTATION` where none is allowed.

        Args:
            level: short name of the performance level.
        """
        return ELASTIC_ROTATION if self.rotations is None else self.rotations[level]


def _of_fema356(member: FrameMember, compression: float) -> Allowed:
    limits, ratio = member.limits(compression), compression / member.strength
    if limits is None:
        return Allowed(None, ratio, f"is force-controlled (P/P_CL = {ratio:.2f})")
    return Allowed({level: limits.allowed(level) for level in ("IO", "LS", "CP")}, ratio)


def _of_asce41(member: FrameMember, compression: float) -> Allowed:
    if member.kind == "beam":
        limits: asce41.PlasticRotations | None = asce41.beam_rotations(member.section, member.length)
        ratio = 0.0
    else:
        gravity = compression if member.gravity is None else member.gravity
        limits = asce41.column_rotations(member.section, member.length, gravity)
        ratio = gravity / member.section.yield_axial_force
    if limits is None:
        return Allowed(None, ratio, f"is force-controlled (P_G/P_ye = {ratio:.2f})")
    return Allowed({level: limits.allowed(level) for level in ("IO", "LS", "CP")}, ratio)


def _of_en1998_3(member: FrameMember, compression: float) -> Allowed:
    section = member.section
    force = compression if member.kind == "column" else 0.0
    ratio, found = force / section.yield_axial_force, section_class(section, force)
    rotations = en1998_3.plastic_rotations(found, ratio, column_yield_rotation(section, member.length, force))
    if rotations is not None:
        return Allowed(rotations, ratio)
    why = f"nu = {ratio:.2f}" if ratio > en1998_3.LARGEST_AXIAL_RATIO else f"class {found}"
    return Allowed(None, ratio, f"has no plastic rotation in Table B.1 ({why})")


def section_class(section: ISection, compression: float) -> int:
    """Return the class of an I section in compression and bending about its axis, 1, 2, or 3 for any higher one.

    Args:
        section: with its flange outstand and thickness of web.
        compression: N, not negative.

    Source: EN 1993-1-1:2005, Table 5.2.
    """
    of_steel, depth = epsilon(section.expected_yield), section.web_slenderness * section.web_thickness
    alpha = plastic_part_in_compression(compression, depth, section.web_thickness, section.expected_yield)
    web = class_of_part(section.web_slenderness, internal_part_limits(of_steel, alpha))
    return min(max(web, class_of_part(section.flange_outstand, outstand_limits(of_steel))), 3)


ACCEPTANCE: Mapping[str, Callable[[FrameMember, float], Allowed]] = {
    "fema356": _of_fema356,
    "asce41-17": _of_asce41,
    "en1998-3": _of_en1998_3,
}
"""What each standard allows a member under the largest compression of a history (N, not negative), by its key."""
