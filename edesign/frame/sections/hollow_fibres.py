"""The fibres of hollow sections in plane bending."""

from __future__ import annotations

import math
from dataclasses import replace

from edesign.frame.sections.hollow_section import HollowSection
from edesign.frame.sections.section import CrossSection, Spot, Strip
from edesign.frame.sections.walls import hollow_walls
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
    flanges, webs = hollow_walls(depth, width, hollow.t, hollow.r_o)
    strips = [Strip(wall.width, wall.depth, wall.z, cut.flange_thickness, cut.flange_width) for wall in flanges]
    if webs:
        strips.append(Strip(2.0 * hollow.t, webs[0].depth, 0.0, cut.web_height, 2 * cut.web_thickness))
    above = hollow_corners(hollow, depth, width)
    return CrossSection(tuple(strips), (replace(above, centre=-above.centre), above))


def hollow_corners(hollow: HollowSection, depth: float, width: float) -> Spot:
    """Return the two corners of a rectangular section above the axis: half of what is not flat wall.

    Args:
        depth: of the section across the axis, m.
        width: of the section along the axis, m.
    """
    flanges, webs = hollow_walls(depth, width, hollow.t, hollow.r_o)
    flats = (*flanges, *webs)
    area = 0.5 * (hollow.A - math.fsum(wall.width * wall.depth for wall in flats))
    moment = 0.5 * (
        hollow.plastic_modulus(depth, width)
        - math.fsum(wall.width * wall.depth * abs(wall.z) for wall in flanges)
        - math.fsum(0.25 * wall.width * wall.depth**2 for wall in webs)
    )
    of_flats = [wall.width * wall.depth**3 / 12.0 for wall in flats]
    of_flats += [wall.width * wall.depth * wall.z**2 for wall in flats]
    inertia = 0.5 * (hollow.inertia(depth, width) - math.fsum(of_flats))
    centre = moment / area
    return Spot(area, centre, inertia - area * centre**2, 2)


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
