"""Plastic hinges lumped at members' ends, joints that turn, and panel zones that shear."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Discriminator, Tag

from edesign.project.frame.members import BeamPlaces, ColumnPlaces
from edesign.project.notation.selections import ALL_LINES, Lines, Numbers
from edesign.project.notation.units import (
    Hardening,
    PositiveFactor,
    PositiveLength,
    PositiveMoment,
    PositiveRotation,
    PositiveRotationalStiffness,
    UnitRatio,
)
from edesign.project.reading.base import Model, by_shape

Ends = Literal["both", "start", "end"]


class HingeSide(Model):
    """A hinge turned one way; what is not given is as for the other way."""

    M_y: PositiveMoment | None = None
    M_c_ratio: PositiveFactor | None = None
    M_r_ratio: UnitRatio | None = None
    theta_p: PositiveRotation | None = None
    theta_pc: PositiveRotation | None = None
    theta_u: PositiveRotation | None = None
    D: UnitRatio | None = None


class HingeValues(Model):
    """Moment and rotation of a hinge, after Ibarra, Medina & Krawinkler (2005) and Lignos & Krawinkler (2011).

    Attributes:
        M_y: effective yield moment.
        M_c_ratio: moment at capping / M_y.
        M_r_ratio: residual moment / M_y, kappa.
        theta_p, theta_pc, theta_u: rotations from yield to capping, from there to no moment, and at the end.
        Lambda: reference cumulative rotation of all deterioration; or one of each.
        Lambda_s, Lambda_c, Lambda_k: of strength, of the line after capping, of the unloading stiffness.
        c: exponent of deterioration.
        D: rate of deterioration.
        hogging: of beams, values under moments that pull at the top, where they differ.
    """

    M_y: PositiveMoment
    M_c_ratio: PositiveFactor = 1.1
    M_r_ratio: UnitRatio = 0.4
    theta_p: PositiveRotation
    theta_pc: PositiveRotation
    theta_u: PositiveRotation
    Lambda: PositiveRotation | None = None
    Lambda_s: PositiveRotation | None = None
    Lambda_c: PositiveRotation | None = None
    Lambda_k: PositiveRotation | None = None
    c: PositiveFactor = 1.0
    D: UnitRatio = 1.0
    hogging: HingeSide = HingeSide()


class ReducedSection(Model):
    """A reduced beam section: from the column's face to the cut, length of the cut, depth of the cut on each side."""

    a: PositiveLength
    b: PositiveLength
    c: PositiveLength


class Hinges(Model):
    """Plastic hinges at the ends of members that stay elastic between them.

    Attributes:
        beams, columns: which members (one of the two keys).
        ends: where.
        parameters: of the hinge; or the regression, for beams of I sections.
        reduced_section: of beams.
        distance: from the node to the hinge.
        unbraced_length: L_b of the regression.
        stiffness_ratio: n, stiffness of the hinge / that of the member.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None
    ends: Ends = "both"
    parameters: Annotated[
        Annotated[Literal["lignos_krawinkler_2011"], Tag("?plain")] | Annotated[HingeValues, Tag("?mapping")],
        Discriminator(by_shape),
    ]
    reduced_section: ReducedSection | None = None
    distance: PositiveLength | None = None
    unbraced_length: PositiveLength | None = None
    stiffness_ratio: PositiveFactor = 10.0


class Joints(Model):
    """Joints that turn: springs between members' ends and their nodes (EN 1993-1-8, 5.1).

    Attributes:
        beams, columns: which members (one of the two keys).
        ends: where.
        stiffness: S_j of the analysis.
        resistance: M_j,Rd; without it the joint stays elastic.
        hardening: stiffness beyond M_j,Rd / S_j.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None
    ends: Ends = "both"
    stiffness: PositiveRotationalStiffness
    resistance: PositiveMoment | None = None
    hardening: Hardening = 0.0


class PanelZones(Model):
    """Joints whose panel shears.

    Attributes:
        lines, floors: which joints.
        doubler: thickness of doubler plates, together.
        hardening: slope beyond the full shear over that before yield (0.03: Gupta & Krawinkler 1999).
    """

    lines: Lines = ALL_LINES
    floors: Numbers
    doubler: PositiveLength | None = None
    hardening: Hardening = 0.03
