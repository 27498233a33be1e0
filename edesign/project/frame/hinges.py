"""Plastic hinges lumped at members' ends, semi-rigid joints, and panel zones that shear."""

from __future__ import annotations

from typing import Annotated, Literal

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
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

Ends = Literal["both", "start", "end"]


class HingeSide(Model):
    """A hinge turned one way; what is not given is as for the other way.

    Attributes:
        M_y: effective yield moment.
        M_c_ratio: moment at capping over M_y.
        M_r_ratio: residual moment over M_y, kappa.
        theta_p: plastic rotation from yield to capping.
        theta_pc: rotation from capping to no moment.
        theta_u: rotation at which the hinge ends.
        D: rate of deterioration in this direction.
    """

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
        M_c_ratio: moment at capping over M_y.
        M_r_ratio: residual moment over M_y, kappa.
        theta_p: plastic rotation from yield to capping.
        theta_pc: rotation from capping to no moment.
        theta_u: rotation at which the hinge ends.
        Lambda: reference cumulative rotation of deterioration; without the key there is none.
        Lambda_s: reference cumulative rotation of strength alone; without the key `Lambda`.
        Lambda_c: reference cumulative rotation of the line after capping alone; without the key `Lambda`.
        Lambda_k: reference cumulative rotation of the unloading stiffness alone; without the key `Lambda`.
        c: exponent of deterioration.
        D: rate of deterioration.
        hogging: of beams, the values under moments that pull at the top, where they differ.
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
    """A reduced beam section, with the letters of its cut in design guides.

    Attributes:
        a: distance from the face of the column to the cut.
        b: length of the cut.
        c: depth of the cut on each side of the flange.
    """

    a: PositiveLength
    b: PositiveLength
    c: PositiveLength


class AnyHinges(Model):
    """Plastic hinges at the ends of members that stay elastic between them.

    Attributes:
        beams: beams that have the hinges; this key or `columns`.
        columns: columns that have the hinges; this key or `beams`.
        ends: ends of the members that have the hinges.
        parameters: values of the hinge, or the regression of Lignos and Krawinkler (2011) for beams of I sections.
        reduced_section: reduced section of the beams, where the hinges are.
        distance: distance from the node to the hinge; without the key 0, or the middle of the reduced section.
        unbraced_length: length L_b between lateral braces, for the regression; without the key the most of AISC 341-10,
            D1.2b.
        stiffness_ratio: stiffness of the hinge over that of the member, n.
    """

    beams: Model | None = None
    columns: Model | None = None
    ends: Ends = "both"
    parameters: Annotated[Literal["lignos_krawinkler_2011"] | HingeValues, OneOf()]
    reduced_section: ReducedSection | None = None
    distance: PositiveLength | None = None
    unbraced_length: PositiveLength | None = None
    stiffness_ratio: PositiveFactor = 10.0


class Hinges(AnyHinges):
    """Plastic hinges at the ends of members of a plane frame, which stay elastic between them.

    Attributes:
        beams: beams that have the hinges; this key or `columns`.
        columns: columns that have the hinges; this key or `beams`.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None


class AnyJoints(Model):
    """Semi-rigid joints: springs between members' ends and their nodes (EN 1993-1-8, 5.1).

    Attributes:
        beams: beams whose ends turn; this key or `columns`.
        columns: columns whose ends turn; this key or `beams`.
        ends: ends of the members that turn.
        stiffness: rotational stiffness S_j of the analysis (EN 1993-1-8, 5.1).
        resistance: design moment resistance M_j,Rd, beyond which the joint yields; without the key it stays elastic.
        hardening: stiffness beyond the resistance over the stiffness before.
    """

    beams: Model | None = None
    columns: Model | None = None
    ends: Ends = "both"
    stiffness: PositiveRotationalStiffness
    resistance: PositiveMoment | None = None
    hardening: Hardening = 0.0


class Joints(AnyJoints):
    """Semi-rigid joints of a plane frame.

    Attributes:
        beams: beams whose ends turn; this key or `columns`.
        columns: columns whose ends turn; this key or `beams`.
    """

    beams: BeamPlaces | None = None
    columns: ColumnPlaces | None = None


class AnyPanelZones(Model):
    """Joints whose panel shears.

    Attributes:
        floors: floors of the joints, counted from 1.
        doubler: thickness of the doubler plates together.
        hardening: slope beyond the full shear over that before yield (0.03: Gupta & Krawinkler 1999).
    """

    floors: Numbers
    doubler: PositiveLength | None = None
    hardening: Hardening = 0.03


class PanelZones(AnyPanelZones):
    """Joints of a plane frame whose panel shears.

    Attributes:
        lines: column lines of the joints.
    """

    lines: Lines = ALL_LINES
