"""I sections of members: their plates, and properties of the whole."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from edesign.codes.ec3.section import SteelSection
from edesign.codes.fema356.sections import ISection
from edesign.frame.sections.named_section import cross_section
from edesign.frame.sections.profiles import profile, profile_names
from edesign.frame.sections.section import CrossSection
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.members import BeamRun, ColumnRun
from edesign.project.frame.sections import PlateSection
from edesign.project.project import Project


@dataclass(frozen=True)
class IShape:
    """Height, width, thicknesses of flange and web, and radius of the fillets of an I section, m."""

    height: float
    width: float
    flange: float
    web: float
    radius: float


def i_shape(project: Project, run: ColumnRun | BeamRun) -> IShape | None:
    """Return the plates of a member's section; None if it is no I section, or bends about its weak axis."""
    return None if run.axis == "weak" else plates_of(run.section, project.sections)


def plates_of(name: str, sections: Mapping[str, object]) -> IShape | None:
    """Return the plates of an I section of a file or of the catalogue; None if it is none.

    Args:
        sections: own ones of the file, by name.
    """
    own = sections.get(name)
    if isinstance(own, PlateSection):
        return IShape(own.height, own.width, own.flange, own.web, 0.0)
    if own is not None or profile_names().canonical(name) is None:
        return None
    rolled = profile(name)
    return IShape(rolled.h, rolled.b, rolled.tf, rolled.tw, rolled.r)


def i_section(project: Project, run: ColumnRun | BeamRun) -> ISection | None:
    """Return the properties of a member's I section as it is analysed (with fillets or not); None if it has none."""
    material, plates = project.materials[run.material], i_shape(project, run)
    if isinstance(material, ElasticMaterial) or plates is None:
        return None
    shape = cross_section(project, run.section)
    if not isinstance(shape, CrossSection):
        return None
    return ISection(
        flange_slenderness=plates.width / (2.0 * plates.flange),
        web_slenderness=(plates.height - 2.0 * plates.flange - 2.0 * plates.radius) / plates.web,
        area=shape.area,
        inertia=shape.inertia,
        weak_inertia=math.fsum(s.depth * s.width**3 / 12.0 for s in shape.strips),  # fillets add nothing that counts
        plastic_modulus=plastic_modulus(shape),
        E=material.E,
        expected_yield=material.fy,
        lower_bound_yield=material.fy,
        flange_outstand=(plates.width - plates.web - 2.0 * plates.radius) / (2.0 * plates.flange),
        web_thickness=plates.web,
    )


def full_i_section(section: SteelSection, E: float, fy: float) -> ISection:
    """Return the properties of an I section with what fillets it has.

    Args:
        section: rolled, or welded of plates.
        E: modulus of elasticity, Pa.
        fy: yield strength, Pa.
    """
    return ISection(
        flange_slenderness=section.b / (2.0 * section.tf),
        web_slenderness=(section.h - 2.0 * section.tf - 2.0 * section.r) / section.tw,
        area=section.A,
        inertia=section.I_y,
        weak_inertia=section.I_z,
        plastic_modulus=section.W_pl_y,
        E=E,
        expected_yield=fy,
        lower_bound_yield=fy,
        flange_outstand=(section.b - section.tw - 2.0 * section.r) / (2.0 * section.tf),
        web_thickness=section.tw,
    )


def plastic_modulus(shape: CrossSection) -> float:
    """Return Z of a section that is symmetric about its axis of bending, m3: the sum of |y| over its area.

    A fillet counts with its area at its centroid, which is exact.
    """
    total = [spot.area * abs(spot.centre - shape.centroid) for spot in shape.spots]
    for strip in shape.strips:
        low, high = (strip.centre - shape.centroid + side * 0.5 * strip.depth for side in (-1.0, 1.0))
        across = low < 0.0 < high
        total.append(strip.width * ((low**2 + high**2) if across else abs(high**2 - low**2)) / 2.0)
    return math.fsum(total)
