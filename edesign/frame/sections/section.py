"""Cross-sections in plane bending: exact properties, and the fibres they are cut into.

A section is a set of rectangles, and of spots for what is not one (the fillets of a rolled profile). The coordinate y
of its fibres is measured upwards from the centroid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.errors import InputError
from edesign.frame.sections.profiles import Profile
from edesign.frame.sections.walls import i_walls
from edesign.project.frame.sections import Fibres, PlateSection, RectangleSection


@dataclass(frozen=True)
class Strip:
    """A rectangle cut into rows x columns equal fibres; `centre` is its height in any common coordinate; all in m."""

    width: float
    depth: float
    centre: float
    rows: int = 1
    columns: int = 1


@dataclass(frozen=True)
class Spot:
    """An area (m2) with its centroid (m) and its own second moment of area (m4); one layer of `fibres` fibres."""

    area: float
    centre: float
    inertia: float = 0.0
    fibres: int = 1


@dataclass(frozen=True)
class CrossSection:
    """A section made of strips and spots.

    Raises:
        InputError: it has no part, or a size is not greater than zero.
    """

    strips: tuple[Strip, ...]
    spots: tuple[Spot, ...] = ()

    def __post_init__(self) -> None:
        if not self.strips and not self.spots:
            raise InputError("a section needs at least one part [E-VALUE-01]")
        sizes = [size for strip in self.strips for size in (strip.width, strip.depth, strip.rows, strip.columns)]
        if not all(size > 0 for size in [*sizes, *(spot.area for spot in self.spots)]):
            raise InputError("all sizes of a section must be greater than zero [E-VALUE-02]")

    @cached_property
    def area(self) -> float:
        """Area, m2."""
        return math.fsum([s.width * s.depth for s in self.strips] + [s.area for s in self.spots])

    @cached_property
    def depth(self) -> float:
        """Depth from the lowest to the highest edge of the strips, m."""
        edges = [s.centre + half * s.depth for s in self.strips for half in (-0.5, 0.5)]
        return max(edges) - min(edges)

    @cached_property
    def centroid(self) -> float:
        """Height of the centroid in the coordinate of the parts, m."""
        moments = [s.width * s.depth * s.centre for s in self.strips] + [s.area * s.centre for s in self.spots]
        return math.fsum(moments) / self.area

    @property
    def farthest(self) -> float:
        """Distance of the outermost edge of a rectangle from the centroid, m; spots lie inside."""
        return max(abs(s.centre - self.centroid) + 0.5 * s.depth for s in self.strips)

    @cached_property
    def inertia(self) -> float:
        """Second moment of area about the centroid, exact for the parts (not for the fibres), m4."""
        own = [s.width * s.depth**3 / 12.0 for s in self.strips] + [s.inertia for s in self.spots]
        areas = [(s.width * s.depth, s.centre) for s in self.strips] + [(s.area, s.centre) for s in self.spots]
        return math.fsum(own + [area * (centre - self.centroid) ** 2 for area, centre in areas])

    @cached_property
    def fibres(self) -> tuple[np.ndarray, np.ndarray]:
        """Depths y (n,) in m above the centroid and areas (n,) in m2 of all fibres, from the bottom to the top."""
        cut = []
        for strip in self.strips:
            area = strip.width * strip.depth / (strip.rows * strip.columns)
            for row in range(strip.rows):
                # measured from the middle, so that symmetric sections get exactly symmetric fibres
                offset = (2 * row + 1 - strip.rows) * (strip.depth / (2 * strip.rows))
                cut += [(strip.centre - self.centroid + offset, area)] * strip.columns
        for spot in self.spots:
            cut += [(spot.centre - self.centroid, spot.area / spot.fibres)] * spot.fibres
        cut.sort(key=lambda fibre: fibre[0])
        depths, areas = np.array(cut).T
        return depths, areas

    @cached_property
    def layers(self) -> tuple[np.ndarray, np.ndarray]:
        """Depths y (n,) and areas (n,) of the layers that fibres of one depth form, from the bottom to the top."""
        depths, areas = self.fibres
        levels, of_fibre = np.unique(depths, return_inverse=True)
        return levels, np.bincount(of_fibre, weights=areas)


def i_section(
    height: float, width: float, flange: float, web: float, cut: Fibres, radius: float = 0.0, weak: bool = False
) -> CrossSection:
    """Return a doubly symmetric I section of three rectangles, with fillets if `radius` is greater than zero.

    Args:
        height: overall, m.
        width: of the flanges, m.
        flange: thickness of a flange, m.
        web: thickness of the web, m.
        cut: numbers of fibres of flanges and web.
        radius: of the fillets between web and flanges, m.
        weak: it bends about its weak axis; the depth of its fibres is then that along the flanges.

    Returns:
        The section as strips of fibres and fillets.

    Raises:
        InputError: the flanges leave no web, the web is wider than the flange, or the fillets do not fit.
    """
    lower, middle, upper = i_walls(height, width, flange, web, radius)
    if weak:
        flanges = Strip(2.0 * flange, width, 0.0, cut.flange_width, 2 * cut.flange_thickness)
        walls = (flanges, Strip(middle.depth, web, 0.0, cut.web_thickness, cut.web_height))
        return CrossSection(walls, fillets(-0.5 * web, radius) if radius > 0.0 else ())
    strips = (
        Strip(width, flange, lower.z, cut.flange_thickness, cut.flange_width),
        Strip(web, middle.depth, middle.z, cut.web_height, cut.web_thickness),
        Strip(width, flange, upper.z, cut.flange_thickness, cut.flange_width),
    )
    return CrossSection(strips, fillets(0.5 * middle.depth, radius) if radius > 0.0 else ())


def fillets(face: float, radius: float) -> tuple[Spot, Spot]:
    """Return the lower and the upper pair of fillets of an I section, each pair one spot of two fibres.

    Args:
        face: distance of the flanges' inner faces from the middle of the web, m.
        radius: m.

    Source: a fillet is a square of side r without a quarter of a circle of radius r about its far corner.
    """
    circle = math.pi * radius**2 / 4.0
    centre = radius - 4.0 * radius / (3.0 * math.pi)  # of the quarter circle, from the flange
    about_face = radius**4 / 3.0 - (math.pi / 16.0 - 4.0 / (9.0 * math.pi)) * radius**4 - circle * centre**2
    area = radius**2 - circle
    arm = (radius**3 / 2.0 - circle * centre) / area  # of the fillet, from the flange
    own = about_face - area * arm**2
    return (Spot(2.0 * area, arm - face, 2.0 * own, 2), Spot(2.0 * area, face - arm, 2.0 * own, 2))


def rolled_section(rolled: Profile, cut: Fibres, weak: bool = False) -> CrossSection:
    """Return a section of the catalogue; its fillets are left out unless `cut.fillets` asks for them.

    Args:
        rolled: entry of the catalogue.
        weak: it bends about its weak axis.
    """
    return i_section(rolled.h, rolled.b, rolled.tf, rolled.tw, cut, rolled.r if cut.fillets else 0.0, weak)


def plate_section(plates: PlateSection, cut: Fibres, weak: bool = False) -> CrossSection:
    """Return an own I section of three plates.

    Args:
        plates: sizes of the plates.
        weak: it bends about its weak axis.
    """
    return i_section(plates.height, plates.width, plates.flange, plates.web, cut, weak=weak)


def rectangle_section(stack: RectangleSection, cut: Fibres) -> CrossSection:
    """Return a stack of rectangles, each cut like a web: `web_height` fibres over the depth, `web_thickness` across."""
    return CrossSection(
        tuple(Strip(r.width, r.depth, r.centre, cut.web_height, cut.web_thickness) for r in stack.rectangles)
    )
