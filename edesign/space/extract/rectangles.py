"""Sections of a building as those of a project file, which bend in the plane of their frame."""

from __future__ import annotations

import math

from edesign.building.steel_section import steel_section
from edesign.space.extract.selections import value


def plane_name(section: str, strong: bool) -> str:
    """Return the name of a section in the plane of a frame, in which it bends about its strong or weak axis."""
    shape = steel_section(section)
    return section if strong or shape.I_y == shape.I_z else f"{section}_weak"


def plane_section(section: str, strong: bool) -> tuple[float, float]:
    """Return area, m2, and second moment of area, m4, in the plane of a frame."""
    shape = steel_section(section)
    return shape.A, shape.I_y if strong else shape.I_z


def rectangles(section: str, strong: bool) -> str:
    """Return the rectangles that stand for a section in a project file; "" of an I section about its strong axis.

    An I section about its weak axis is its flanges and its web, without fillets. A hollow section is a square tube of
    the same area and second moment of area: sides a outside and b inside with a2 - b2 = A and a2 + b2 = 12 I / A.
    """
    shape = steel_section(section)
    if shape.kind == "I":
        if strong:
            return ""
        return ", ".join((_one(2.0 * shape.tf, shape.b, 0.0), _one(shape.h - 2.0 * shape.tf, shape.tw, 0.0)))
    area, inertia = plane_section(section, strong)
    outer, inner = (math.sqrt(0.5 * (12.0 * inertia / area + sign * area)) for sign in (1.0, -1.0))
    wall, arm = 0.5 * (outer - inner), 0.25 * (outer + inner)
    return ", ".join((_one(2.0 * wall, outer, 0.0), _one(inner, wall, arm), _one(inner, wall, -arm)))


def _one(width: float, depth: float, centre: float) -> str:
    sizes = {"width": width, "depth": depth, "centre": centre}
    return "{" + ", ".join(f"{key}: {value(1e3 * size, 'mm')}" for key, size in sizes.items()) + "}"
