"""Own sections of a building with their properties, and the sections of a building by their names."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import cache

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.i_steel_section import i_steel_section
from edesign.frame.sections.riveted import riveted_section
from edesign.frame.sections.section import rectangle_section
from edesign.frame.sections.space_section import box_torsion_constant, space_section
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building.building import Building
from edesign.project.frame.sections import (
    ROUNDING,
    BoxSection,
    ElasticSection,
    Fibres,
    PlateSection,
    RectangleSection,
    RivetedSection,
    SpaceElasticSection,
)
from edesign.project.project import Project

_NODES, _WEIGHTS = (-math.sqrt(0.6), 0.0, math.sqrt(0.6)), (5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0)  # Gauss-Legendre


def section_of(file: Building | Project, name: str) -> SteelSection:
    """Return a section of a building or frame by its name: an own one of the file, of the catalogue, or a hollow one.

    Args:
        file: from `load_building` or `load_project`; own sections by area alone are of buildings.

    Raises:
        InputError: there is no such section.
    """
    own = file.sections.get(name)
    assert not isinstance(own, ElasticSection), "sections of plane frames by their area have no shape"
    return steel_section(name) if own is None else own_section(name, own)


@cache
def own_section(
    name: str, own: PlateSection | BoxSection | RivetedSection | RectangleSection | SpaceElasticSection
) -> SteelSection:
    """Return an own section with its properties: plates are a welded or riveted I section or box, others have no class.

    The shear centre of a stack of rectangles that is not symmetric is taken at its centroid.

    Args:
        own: as the file describes it.

    Raises:
        InputError: its plates do not fit together.
    """
    if isinstance(own, PlateSection):
        return i_steel_section(name, own.height, own.width, own.web, own.flange, welded=True)
    if isinstance(own, BoxSection):
        return _box(name, own)
    if isinstance(own, RivetedSection):
        return riveted_section(name, own)
    if isinstance(own, RectangleSection):
        return _stack(name, own)
    return SteelSection.of(
        name,
        "other",
        A=own.area,
        A_y=own.weak_shear_area or 0.0,
        A_z=own.shear_area or 0.0,
        I_t=own.torsion_constant or 0.0,
        I_y=own.inertia or 0.0,
        I_z=own.weak_inertia or 0.0,
    )


def _box(name: str, box: BoxSection) -> SteelSection:
    """Return a welded box.

    Source: A_vy and A_vz: EN 1993-1-1, 6.2.6(3)d and e with eta = 1. A_y and A_z: I2 / integral (S/t)2 dA of the thin
        walls, as of hollow sections.
    """
    h, b, tf, tw = box.height, box.width, box.flange, box.web
    clear, inner = h - 2.0 * tf, b - 2.0 * tw
    A, I_y, I_z = h * b - clear * inner, (b * h**3 - inner * clear**3) / 12.0, (h * b**3 - clear * inner**3) / 12.0
    webs = 2.0 * clear * tw
    return SteelSection(
        name=name,
        kind="RHS",
        cold_formed=False,
        h=h,
        b=b,
        tw=tw,
        tf=tf,
        r=0.0,
        A=A,
        A_vy=A - webs,
        A_vz=webs,
        A_y=_thin_shear_area(b - tw, h - tf, tf, tw),
        A_z=_thin_shear_area(h - tf, b - tw, tw, tf),
        I_y=I_y,
        I_z=I_z,
        I_t=box_torsion_constant(box),
        I_w=0.0,
        W_el_y=2.0 * I_y / h,
        W_el_z=2.0 * I_z / b,
        W_pl_y=(b * h**2 - inner * clear**2) / 4.0,
        W_pl_z=(h * b**2 - clear * inner**2) / 4.0,
        welded=True,
    )


def _thin_shear_area(H: float, B: float, t: float, across: float) -> float:
    """Return the shear area of a thin-walled box along its walls of length H and thickness t.

    Args:
        B: length of the other walls, m.
        across: their thickness, m.
    """
    inertia, ratio = t * H**3 / 6.0 + across * B * H**2 / 2.0, across / t
    walls = 2.0 * t * H**3 * (ratio**2 * B**2 / 16.0 + ratio * B * H / 24.0 + H**2 / 120.0)
    return inertia**2 / (across * H**2 * B**3 / 24.0 + walls)


def _stack(name: str, own: RectangleSection) -> SteelSection:
    shape = rectangle_section(own, Fibres())
    upwards = [(s.centre - 0.5 * s.depth, s.centre + 0.5 * s.depth, s.width) for s in shape.strips]
    across = [(-0.5 * s.width, 0.5 * s.width, s.depth) for s in shape.strips]
    return SteelSection.of(
        name,
        "other",
        h=shape.depth,
        b=max(strip.width for strip in shape.strips),
        A=shape.area,
        A_y=_shear_area(across),
        A_z=_shear_area(upwards),
        I_t=space_section(own).I_t,
        I_y=shape.inertia,
        I_z=math.fsum(s.depth * s.width**3 / 12.0 for s in shape.strips),
    )


def _shear_area(parts: Sequence[tuple[float, float, float]]) -> float:
    """Return the shear area along a coordinate, I2 / integral of S2/b: of one rectangle 5/6 of its area; 0 of gaps.

    Args:
        parts: lower and upper coordinate of rectangles, and their breadth across it, m.
    """
    edges = _apart(edge for low, high, _ in parts for edge in (low, high))
    layers = [
        (low, high, math.fsum(of for start, end, of in parts if start < 0.5 * (low + high) < end))
        for low, high in zip(edges, edges[1:], strict=False)
    ]
    if not all(of for _, _, of in layers):
        return 0.0  # nothing carries shear across a gap
    area = math.fsum((high - low) * of for low, high, of in layers)
    centre = math.fsum(0.5 * (high**2 - low**2) * of for low, high, of in layers) / area
    inertia = math.fsum(((high - centre) ** 3 - (low - centre) ** 3) / 3.0 * of for low, high, of in layers)
    above, integral = 0.0, 0.0  # static moment of what lies below the point, with its sign
    for low, high, of in layers:
        half = 0.5 * (high - low)
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):  # exact: S2 is of the fourth degree
            at = low + half * (1.0 + node)
            static = above + 0.5 * of * ((at - centre) ** 2 - (low - centre) ** 2)
            integral += weight * half * static**2 / of
        above += 0.5 * of * ((high - centre) ** 2 - (low - centre) ** 2)
    return inertia**2 / integral


def _apart(edges: Iterable[float]) -> list[float]:
    """Return edges from the lowest on; of those that rounding alone parts, one."""
    ordered = sorted(edges)
    least = ROUNDING * (ordered[-1] - ordered[0])
    found = ordered[:1]
    for edge in ordered[1:]:
        if edge - found[-1] > least:
            found.append(edge)
    return found
