"""The fibres of hollow sections in plane bending."""

from __future__ import annotations

import math

from edesign.frame.sections.hollow_section import HollowSection
from edesign.frame.sections.section import CrossSection, Spot, Strip
from edesign.project.frame.sections import Fibres


def hollow_cross_section(hollow: HollowSection, cut: Fibres, weak: bool = False) -> CrossSection:
    """Return a hollow section with its exact area, second moment of area and plastic modulus.

    Walls are cut as flanges and webs of I sections are. The corners of a rectangular section are one spot below and one
    above. A circular section is cut into `2 web_height` sectors from its bottom to its top, left and right together.

    Args:
        weak: it bends about its weak axis.
    """
    if hollow.round:
        return CrossSection((), tuple(_sectors(hollow, 2 * cut.web_height)))
    depth, width = (hollow.b, hollow.h) if weak else (hollow.h, hollow.b)
    t, r = hollow.t, hollow.r_o
    arm, flat, clear = 0.5 * (depth - t), width - 2.0 * r, depth - 2.0 * r
    strips = []
    if flat > 0.0:
        strips += [Strip(flat, t, side * arm, cut.flange_thickness, cut.flange_width) for side in (-1.0, 1.0)]
    if clear > 0.0:
        strips.append(Strip(2.0 * t, clear, 0.0, cut.web_height, 2 * cut.web_thickness))
    flats = CrossSection(tuple(strips)) if strips else None
    area = 0.5 * (hollow.A - (flats.area if flats else 0.0))
    moment = 0.5 * (
        hollow.plastic_modulus(depth, width) - 2.0 * max(flat, 0.0) * t * arm - 0.5 * t * max(clear, 0.0) ** 2
    )
    inertia = 0.5 * (hollow.inertia(depth, width) - (flats.inertia if flats else 0.0))
    centre = moment / area
    corners = tuple(Spot(area, side * centre, inertia - area * centre**2, 2) for side in (-1.0, 1.0))
    return CrossSection(tuple(strips), corners)


def _sectors(hollow: HollowSection, count: int) -> list[Spot]:
    """Pairs of sectors of a ring, left and right, from the bottom to the top."""
    outer, inner = 0.5 * hollow.h, 0.5 * hollow.h - hollow.t
    found = []
    for i in range(count):
        start, end = (math.pi * j / count for j in (i, i + 1))  # angle from the bottom
        area = (outer**2 - inner**2) * (end - start)
        centre = -2.0 / 3.0 * (outer**3 - inner**3) * (math.sin(end) - math.sin(start)) / area
        about_middle = (
            0.25 * (outer**4 - inner**4) * (end - start + 0.5 * (math.sin(2.0 * end) - math.sin(2.0 * start)))
        )
        found.append(Spot(area, centre, about_middle - area * centre**2, 2))
    return found
