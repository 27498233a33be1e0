"""Members as struts: the compression at which they buckle by EN 1993-1-1, which the analysis of most does not follow.

A brace is a bar between two nodes and carries compression as it carries tension; a column is analysed in the plane of
the frame only. Both axes count here, with the buckling length between nodes (of braces times their factor).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from edesign.codes.ec3.buckling import (
    IMPERFECTION,
    NO_BUCKLING,
    Curve,
    angle_curve,
    buckling_resistance,
    critical_force,
    hollow_curve,
    reduction_factor,
    rolled_i_curve,
    slenderness,
    solid_curve,
    welded_box_curve,
    welded_i_curve,
)
from edesign.frame.sections.named_section import cross_section
from edesign.frame.sections.section import CrossSection
from edesign.frame.sections.steel_section import SteelSection, steel_section
from edesign.project.frame.braces import CAMBER
from edesign.project.frame.materials import ElasticMaterial, Material
from edesign.project.frame.members import BraceRun, ColumnRun
from edesign.project.frame.sections import PlateSection, RectangleSection, SectionAxis
from edesign.project.project import Project

AxisData = tuple[float, Curve]  # second moment of area, m4, and buckling curve


Kind = Literal["column", "brace", "brace of a damper"]


@dataclass(frozen=True)
class Strut:
    """A member in compression.

    Attributes:
        length: L_cr, m.
        slenderness: non-dimensional, about the axis that governs; of a steel that does not yield it is infinite.
        resistance: N_b,Rd, N; of a steel that does not yield N_cr.
        squash: A f_y, N; of a steel that does not yield infinite.
    """

    length: float
    slenderness: float
    resistance: float
    squash: float


@dataclass(frozen=True)
class Bar:
    """A member of a frame that is compressed.

    Attributes:
        name: of the column or brace, or of the damper that the brace belongs to.
        section: its name.
        strut: None: the section has no second moment of area, or the bar is not to be judged.
        compression: whether its compression is to be judged: not where it does not count, or the bar buckles itself.
    """

    name: str
    kind: Kind
    section: str
    strut: Strut | None
    compression: bool = True


def strut(project: Project, section: str, material: str, length: float) -> Strut | None:
    """Return a member as a strut; None if its section has no second moment of area.

    Rolled profiles count with their fillets, hollow sections with their own curve. An own elastic section has one axis,
    and curve c: its shape is not known. A stack of rectangles is taken as solid.

    Args:
        section: its name in the project.
        material: its name in the project.
        length: L_cr about both axes, m.

    Returns:
        Length, slenderness and resistances of the strut, or None.

    Source: EN 1993-1-1:2005, 6.3.1.
    """
    steel = project.materials[material]
    area, axes = _section(project, section, steel)
    return _strut(area, axes, steel, length) if axes else None


def section_strut(section: SteelSection, steel: Material, length: float) -> Strut | None:
    """Return a member of a steel section as a strut; None if its section has no second moments of area.

    Source and rules are those of `strut`.

    Args:
        section: its properties.
        steel: its law.
        length: L_cr about both axes, m.
    """
    area, axes = _of_section(section, steel)
    return _strut(area, axes, steel, length) if min(section.I_y, section.I_z) > 0.0 else None


def _strut(area: float, axes: list[AxisData], steel: Material, length: float) -> Strut:
    critical = [(critical_force(steel.E, inertia, length), curve) for inertia, curve in axes]
    if isinstance(steel, ElasticMaterial):
        return Strut(length, math.inf, min(force for force, _ in critical), math.inf)
    squash = area * steel.fy
    slendernesses = [(slenderness(area, steel.fy, force), curve) for force, curve in critical]
    chi, governing = min((reduction_factor(value, curve), value) for value, curve in slendernesses)
    return Strut(length, governing, buckling_resistance(area, steel.fy, chi), squash)


SMALLEST_CAMBER = 1e-5
"""Camber / length of a brace that by EN 1993-1-1, 6.3.1.2(4), needs none: a straight one has no side to buckle to."""


def equivalent_camber(project: Project, section: str, material: str, axis: SectionAxis, length: float) -> float:
    """Return the camber / length with which first yield of a pinned strut is at N_b,Rd.

    Args:
        section: its name in the project.
        material: name of its steel in the project; the steel yields.
        axis: about which the strut buckles; a stack of rectangles has its own only.
        length: L_cr, m.

    Source: EN 1993-1-1:2005, 5.3.2(11) with 6.3.1.2: e_0 = alpha (lambda - 0.2) W_el / A.
    """
    steel = project.materials[material]
    if isinstance(steel, ElasticMaterial):
        return CAMBER
    own, shape = project.sections.get(section), cross_section(project, section, axis)
    area, axes = _section(project, section, steel)
    inertia, curve = axes[1 if axis == "weak" and not isinstance(own, RectangleSection) else 0]
    if own is not None:
        assert isinstance(shape, CrossSection)  # an elastic section does not buckle
        farthest = shape.farthest
    else:
        known = steel_section(section)
        farthest = 0.5 * (known.b if axis == "weak" else known.h)
    relative = slenderness(area, steel.fy, critical_force(steel.E, inertia, length))
    camber = IMPERFECTION[curve] * (relative - NO_BUCKLING) * inertia / (farthest * area)
    return max(camber / length, SMALLEST_CAMBER)


def bar_of_member(
    name: str, run: ColumnRun | BraceRun, length: float, struts: Callable[[str, str, float], Strut | None]
) -> Bar:
    """Return a column or brace as a bar.

    Args:
        length: between its nodes, m.
        struts: `strut` of the project.
    """
    if not isinstance(run, BraceRun):
        return Bar(name, "column", run.section, struts(run.section, run.material, length))
    if run.buckling is not None or not run.compression:
        return Bar(name, "brace", run.section, None, compression=False)
    factor = run.buckling_length_factor
    return Bar(name, "brace", run.section, struts(run.section, run.material, length * factor))


def _section(project: Project, name: str, steel: Material) -> tuple[float, list[AxisData]]:
    """Area (m2), and about each axis second moment of area and buckling curve."""
    own = project.sections.get(name)
    shape = cross_section(project, name)
    if not isinstance(shape, CrossSection):
        return shape.area, [] if shape.inertia is None else [(shape.inertia, solid_curve())]
    if own is None:
        return _of_section(steel_section(name), steel)
    weak = sum(strip.depth * strip.width**3 / 12.0 for strip in shape.strips)
    if isinstance(own, PlateSection):
        return shape.area, [(shape.inertia, welded_i_curve(own.flange, "y")), (weak, welded_i_curve(own.flange, "z"))]
    return shape.area, [(shape.inertia, solid_curve()), (weak, solid_curve())]


def _of_section(shape: SteelSection, steel: Material) -> tuple[float, list[AxisData]]:
    curves = _curves(shape, 0.0 if isinstance(steel, ElasticMaterial) else steel.fy)
    return shape.A, list(zip((shape.I_y, shape.I_z), curves, strict=True))


def _curves(section: SteelSection, fy: float) -> list[Curve]:
    """Buckling curves about the strong and the weak axis."""
    if section.kind in ("other", "2U"):
        return [solid_curve()] * 2
    if section.kind == "L":
        return [angle_curve()] * 2
    if section.kind == "I" and section.welded:
        return [welded_i_curve(section.tf, axis) for axis in ("y", "z")]
    if section.welded:
        return [welded_box_curve(section.h, section.b, section.tf, section.tw)] * 2
    if section.kind == "I":
        return [rolled_i_curve(section.h, section.b, section.tf, axis, fy) for axis in ("y", "z")]
    return [hollow_curve(fy, section.cold_formed)] * 2
