"""The outline of a floor that covers some bays of a grid, and its set-backs in plan."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

Vertex = tuple[int, int]
"""Numbers of the grid lines across x and across y that meet in a corner of a bay."""


def recess_areas(bays: Iterable[tuple[int, int]], x: Sequence[float], y: Sequence[float]) -> tuple[list[float], float]:
    """Return the areas between the outline of a floor and the convex polygon around it, one a set-back, and its area.

    Args:
        bays: that the floor covers, from 1 along x and along y; they hang together.
        x: places of the grid lines along x, m.
        y: places of the grid lines along y, m.

    Returns:
        Area of each set-back and area of the floor, m2.

    Source: EN 1998-1:2004, 4.2.3.2(3).
    """
    covered = set(bays)
    outline = _outline(covered)
    points = np.array([(x[i], y[j]) for i, j in outline])
    on_hull = np.flatnonzero(_on_hull(points))
    found = []
    for first, last in zip(on_hull, [*on_hull[1:], on_hull[0] + len(points)], strict=True):
        pocket = abs(_area(points[np.arange(first, last + 1) % len(points)]))
        if last - first > 1 and pocket > 0.0:
            found.append(pocket)
    return found, sum((x[i] - x[i - 1]) * (y[j] - y[j - 1]) for i, j in covered)


def corners(bays: Iterable[tuple[int, int]]) -> list[Vertex]:
    """Return where the outline of a floor turns, in order from below at the left.

    Args:
        bays: that the floor covers, from 1 along x and along y; they hang together.
    """
    vertices = _outline(set(bays))
    around = zip([vertices[-1], *vertices[:-1]], vertices, [*vertices[1:], vertices[0]], strict=True)
    return [
        at for before, at, after in around if len({before[0], at[0], after[0]}) > 1 < len({before[1], at[1], after[1]})
    ]


def _outline(bays: set[tuple[int, int]]) -> list[Vertex]:
    """Return the corners along the outer edge of some bays, counter-clockwise, from the lowest of those on the left."""
    sides: set[tuple[Vertex, Vertex]] = set()
    for i, j in bays:
        corners = ((i - 1, j - 1), (i, j - 1), (i, j), (i - 1, j))
        sides |= set(zip(corners, (*corners[1:], corners[0]), strict=True))
    edge = sorted(side for side in sides if side[::-1] not in sides)
    onwards: dict[Vertex, list[Vertex]] = {}
    for start, end in edge:
        onwards.setdefault(start, []).append(end)
    here, found = edge[0][0], [edge[0][0]]
    way = (0, -1)  # down the left side, to the first corner
    for _ in edge:
        ends = {(end[0] - here[0], end[1] - here[1]): end for end in onwards[here]}
        left = (-way[1], way[0])
        way = next(turn for turn in (left, way, (way[1], -way[0])) if turn in ends)
        here = ends[way]
        if here == found[0]:
            break
        found.append(here)
    return found


def _on_hull(points: np.ndarray) -> np.ndarray:
    """Return which corners of a counter-clockwise outline lie on the convex polygon around it, (n,)."""
    order = sorted(range(len(points)), key=lambda k: (points[k][0], points[k][1]))
    hull: list[np.ndarray] = []
    for sequence in (order, order[::-1]):
        half: list[np.ndarray] = []
        for k in sequence:
            while len(half) > 1 and _area(np.array([half[-2], half[-1], points[k]])) <= 0.0:
                half.pop()
            half.append(points[k])
        hull += half[:-1]
    rounding = 1e-9 * float(np.ptp(points, axis=0).prod())
    found = np.zeros(len(points), dtype=bool)
    for start, end in zip(hull, [*hull[1:], hull[0]], strict=True):
        found |= np.array([abs(_area(np.array([start, end, point]))) <= rounding for point in points])
    return found


def _area(points: np.ndarray) -> float:
    """Return the area of a polygon, positive where its corners run counter-clockwise, m2."""
    x, y = points[:, 0], points[:, 1]
    return 0.5 * float(x @ np.roll(y, -1) - y @ np.roll(x, -1))
