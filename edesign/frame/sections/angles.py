"""Angles with equal and unequal legs of EN 10056-1, for braces of buildings (data/angles.csv).

The sizes are those of the package structuralcodes; areas and second moments are exact for two rectangles, the root
fillet and the roundings of the toes. Axis y is the principal axis u, about which an angle is stiffest, and z is v.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from functools import cache
from importlib import resources

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.section_names import SectionName, SectionNames

_MM = 1e-3
FAMILY = "L"


@cache
def angle_names() -> SectionNames:
    """Return the names of all angles of the catalogue."""
    return SectionNames(tuple(_sizes()))


def angle_name(name: str) -> str | None:
    """Return the catalogue's name of an angle, `L100x100x10`; None if there is no such one.

    Args:
        name: as somebody writes it: `L 100x100x10`, or `L100x10` of equal legs.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family != FAMILY or len(parts.sizes) not in (2, 3):
        return None
    *legs, t = parts.sizes
    long, short = max(legs), min(legs)
    return angle_names().canonical(f"{FAMILY}{long:g}x{short:g}x{t:g}")


def near_angle(name: str) -> str:
    """Return what there is near an angle that the catalogue lacks, as a clause; "" of what is no angle.

    Args:
        name: as somebody writes it.
    """
    parts = SectionName.of(name)
    if parts is None or parts.family != FAMILY:
        return ""
    return f"{angle_names().near(name)}; angles are for braces of buildings alone"


@cache
def angle(name: str) -> SteelSection:
    """Return an angle with the properties that an axial force asks for; its moduli and shear areas are nan.

    Args:
        name: of the catalogue.

    Source: A, I of areas; I_t = (h + b - t) t3 / 3 of thin walls.
    """
    h, b, t, r_1, r_2 = (_MM * size for size in _sizes()[name])
    A = S_x = S_y = I_x = I_y = I_xy = 0.0
    for area, x, y, own_x, own_y, own_xy in _parts(h, b, t, r_1, r_2):
        A, S_x, S_y = A + area, S_x + area * y, S_y + area * x
        I_x, I_y, I_xy = I_x + own_x + area * y**2, I_y + own_y + area * x**2, I_xy + own_xy + area * x * y
    I_x, I_y, I_xy = I_x - S_x**2 / A, I_y - S_y**2 / A, I_xy - S_x * S_y / A
    mean, radius = 0.5 * (I_x + I_y), math.hypot(0.5 * (I_x - I_y), I_xy)
    I_t = (h + b - t) * t**3 / 3.0
    sizes = {"h": h, "b": b, "tw": t, "tf": t, "r": r_1}
    return SteelSection.of(name, "L", **sizes, A=A, I_y=mean + radius, I_z=mean - radius, I_t=I_t)


def leg_properties(name: str) -> tuple[float, float, float, float, float, float, float, float]:
    """Return an angle about axes along its legs, for sections that it is a part of.

    Args:
        name: of the catalogue.

    Returns:
        Long leg, short leg, thickness, m; area, m2; distances of the centroid from the backs of the long and of the
        short leg, m; own second moments for distances along the short and along the long leg, m4.
    """
    h, b, t, r_1, r_2 = (_MM * size for size in _sizes()[name])
    A = S_x = S_y = I_x = I_y = 0.0
    for area, x, y, own_x, own_y, _ in _parts(h, b, t, r_1, r_2):
        A, S_x, S_y = A + area, S_x + area * y, S_y + area * x
        I_x, I_y = I_x + own_x + area * y**2, I_y + own_y + area * x**2
    return h, b, t, A, S_y / A, S_x / A, I_y - S_y**2 / A, I_x - S_x**2 / A


def _parts(
    h: float, b: float, t: float, r_1: float, r_2: float
) -> Iterator[tuple[float, float, float, float, float, float]]:
    """Area, centre x and y from the heel, and own second moments about x, y and both, of each part; gaps are < 0.

    x runs along the leg b, y along the leg h.
    """
    for width, height, x, y in ((t, h, 0.5 * t, 0.5 * h), (b - t, t, t + 0.5 * (b - t), 0.5 * t)):
        yield width * height, x, y, width * height**3 / 12.0, height * width**3 / 12.0, 0.0
    # what lies between a square corner and a circle that touches both of its sides, from the corner
    area, place = 1.0 - math.pi / 4.0, (5.0 / 6.0 - math.pi / 4.0) / (1.0 - math.pi / 4.0)
    own = 1.0 - 5.0 * math.pi / 16.0 - area * place**2
    both = 19.0 / 24.0 - math.pi / 4.0 - area * place**2
    for sign, r, x, y, way in ((1.0, r_1, t, t, 1.0), (-1.0, r_2, t, h, -1.0), (-1.0, r_2, b, t, -1.0)):
        second = sign * r**4
        yield sign * area * r**2, x + way * place * r, y + way * place * r, second * own, second * own, second * both


@cache
def _sizes() -> dict[str, tuple[float, ...]]:
    """Return h, b, t, r_1 and r_2 of each angle, mm."""
    text = resources.files("edesign.frame.sections").joinpath("data/angles.csv").read_text(encoding="utf-8")
    rows = csv.reader(line for line in text.splitlines() if not line.startswith("#"))
    next(rows)
    return {name: tuple(map(float, cells)) for name, *cells in rows}
