"""Leave out the points of a curve that nobody can see."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def thin_out(points: np.ndarray, tolerance: float) -> np.ndarray:
    """Return the points of a polyline that are needed to draw it within a tolerance; see `thin_out_all`.

    Args:
        points: the polyline, (n, 2).
        tolerance: largest distance of a point that is left out, in the unit of the points.
    """
    return thin_out_all([points], tolerance)[0]


def thin_out_all(curves: Sequence[np.ndarray], tolerance: float) -> list[np.ndarray]:
    """Return the points of polylines that are needed to draw them within a tolerance.

    Every point of the line through all points is within `tolerance` of the line through those that are kept; first
    and last are kept. All parts of a level of the subdivision of all curves are treated at once: thousands of points
    take milliseconds, in one long curve or in many short ones.

    Args:
        curves: each of shape (n, 2), in the order in which they are joined; loops and reversals are allowed.
        tolerance: largest deviation, in the unit of the points.

    Returns:
        Of each curve shape (m, 2), m <= n.

    Source: Ramer (1972), Comput. Graph. Image Process. 1, 244-256; Douglas and Peucker (1973), Cartographica 10,
        112-122; with the distance to the segment in place of that to the infinite line, which loops need.
    """
    if not curves:
        return []
    ends = np.cumsum([len(curve) for curve in curves])
    points = np.concatenate(curves)
    first, last = ends - [len(curve) for curve in curves], ends - 1
    long = last - first > 1
    kept = np.repeat(~long, np.diff(ends, prepend=0))
    first, last = first[long], last[long]
    kept[first] = kept[last] = True
    while first.size:
        counts = last - first - 1  # points inside each part
        starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
        part = np.repeat(np.arange(first.size), counts)
        inside = np.arange(part.size) - starts[part] + first[part] + 1
        distance = _to_segment(points[inside], points[first[part]], points[last[part]])
        largest = np.maximum.reduceat(distance, starts)
        at_largest = np.flatnonzero(distance == largest[part])
        _, foremost = np.unique(part[at_largest], return_index=True)
        farthest = inside[at_largest[foremost]]
        split = largest > tolerance
        first, middle, last = first[split], farthest[split], last[split]
        kept[middle] = True
        first, last = np.concatenate((first, middle)), np.concatenate((middle, last))
        open_parts = last - first > 1
        first, last = first[open_parts], last[open_parts]
    return [part[there] for part, there in zip(np.split(points, ends[:-1]), np.split(kept, ends[:-1]), strict=True)]


def _to_segment(points: np.ndarray, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Distance of each point to its segment; a segment without length is a point."""
    along = end - start
    length2 = np.sum(along**2, axis=1)
    share = np.sum((points - start) * along, axis=1) / np.where(length2 > 0.0, length2, 1.0)
    foot = start + np.clip(share, 0.0, 1.0)[:, None] * along
    return np.asarray(np.hypot(*(points - foot).T))
