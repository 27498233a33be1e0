"""How the load of a floor comes to the beams around a bay.

A floor that spans one way rests on the two beams across its span, or on secondary beams, which bring their share to the
two other beams as point loads. A floor that spans two ways is cut by lines at 45 degrees from its corners: each beam
takes the load between it and the nearest lines, a triangle on a short beam, a trapezoid on a long one.

Source: statics; the lines at 45 degrees are those of a slab with the same support on its four sides, as in tables for
the loads of edge beams.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Span = Literal["x", "y", "two_way"]
_DIGITS = 12  # places that differ by less are one


@dataclass(frozen=True)
class BeamShare:
    """Load on one beam, downwards.

    Attributes:
        uniform: N/m.
        points: place as a fraction of the length, and force, N.
    """

    uniform: float = 0.0
    points: tuple[tuple[float, float], ...] = ()

    def total(self, length: float) -> float:
        """Return the sum of the loads on a beam, N.

        Args:
            length: m.
        """
        return self.uniform * length + sum(force for _, force in self.points)

    def plus(self, other: BeamShare, factor: float) -> BeamShare:
        """Return the sum with another share times a factor; forces at one place add up, forces of zero are left out.

        Args:
            other: on the same beam.
        """
        points: dict[float, float] = {}
        for position, force in (*self.points, *((at, factor * force) for at, force in other.points)):
            place = round(position, _DIGITS)
            points[place] = points.get(place, 0.0) + force
        return BeamShare(
            self.uniform + factor * other.uniform, tuple((at, force) for at, force in sorted(points.items()) if force)
        )


@dataclass(frozen=True)
class BayShares:
    """Loads on the beams around a bay: on each of the two along x, and on each of the two along y."""

    along_x: BeamShare
    along_y: BeamShare


def bay_shares(load: float, width_x: float, width_y: float, spans: Span, secondary_beams: int = 0) -> BayShares:
    """Return what the beams around a bay carry of the load on it.

    Args:
        load: N/m2, downwards.
        width_x: of the bay along x, m.
        width_y: of the bay along y, m.
        spans: the way of the floor: `x` rests on the beams along y.
        secondary_beams: across the span at equal distances; they rest on the beams along the span.

    Returns:
        Loads on the beams along x and along y.
    """
    if spans == "two_way":
        short = min(width_x, width_y)
        peak = 0.5 * load * short
        return BayShares(trapezoid(peak, width_x, 0.5 * short), trapezoid(peak, width_y, 0.5 * short))
    span, across = (width_x, width_y) if spans == "x" else (width_y, width_x)
    parts = secondary_beams + 1
    strip = load * span / parts  # N/m on each secondary beam, and half of it at both edges
    edge = BeamShare(0.5 * strip)
    girder = BeamShare(points=tuple((k / parts, 0.5 * strip * across) for k in range(1, parts)))
    return BayShares(girder, edge) if spans == "x" else BayShares(edge, girder)


_PLACES = ((0.5 - 0.5 * math.sqrt(0.6), 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + 0.5 * math.sqrt(0.6), 5.0 / 18.0))
"""Places and weights of Gauss-Legendre between 0 and 1, exact up to the fifth degree."""


def part_share(start: float, end: float, length: float, load: tuple[float, float]) -> BeamShare:
    """Return the three forces that stand for a load on a part of a beam, linear from its start to its end.

    The end forces of a beam under a unit force are polynomials of the third degree in its place, with and without
    shear deformation. Under the linear load their integral is that of three points of Gauss-Legendre. So reactions, end
    moments, and moments outside the part are exact. Within a uniform part w of length c the moment is
    between 0.007 w c2 too small and 0.018 w c2 too large.

    Args:
        start: of the part, as a fraction of the length.
        end: of the part, as a fraction of the length.
        length: of the beam, m.
        load: at the start and at the end, N/m.
    """
    width = (end - start) * length
    points = tuple(
        (start + at * (end - start), weight * width * (load[0] + at * (load[1] - load[0]))) for at, weight in _PLACES
    )
    return BeamShare(points=points)


def trapezoid(peak: float, length: float, ramp: float) -> BeamShare:
    """Return the load that stands for a symmetric trapezoid, with its total, end moments and moment at mid-span.

    It is a uniform load w and points P at the middle and S at both quarters. With a = ramp / length, three equations

        w L + P + 2 S = p L (1 - a)                                       total
        w L^2/12 + P L/8 + 3 S L/16 = p L^2/12 (1 - 2 a^2 + a^3)          moment of fixed ends
        w L^2/8 + P L/4 + S L/4 = p L^2 (1/8 - a^2/6)                     moment at mid-span of pinned ends

    give w = p (1 - 2a)^3, P = p L a (1 - 4a/3), S = 2 p L a (1 - 8a/3 + 2 a^2).

    Args:
        peak: p, N/m.
        length: L of the beam, m.
        ramp: length of each sloping part, m; half of L makes a triangle.

    Source: statics; the moments of fixed ends follow from those of a point load, P b^2 a / L^2, by integration.
    """
    a = ramp / length
    middle = peak * length * a * (1.0 - 4.0 * a / 3.0)
    quarter = 2.0 * peak * length * a * (1.0 - 8.0 * a / 3.0 + 2.0 * a**2)
    return BeamShare(peak * (1.0 - 2.0 * a) ** 3, ((0.25, quarter), (0.5, middle), (0.75, quarter)))
