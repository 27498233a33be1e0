"""Boxes of texts in inches: where a text stands, and whether two of them meet."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

CELLS = 2  # an inch, in which boxes are sorted


@dataclass(frozen=True)
class Spot:
    """Where a text may stand: its anchor in inches, which part of it is there, and how it is turned, degrees."""

    x: float
    y: float
    ha: str = "center"
    va: str = "center"
    turned: float = 0.0


def corners_of(spot: Spot, wide: float, high: float) -> np.ndarray:
    """Return the corners of a rectangle with its anchor at a spot, (4, 2) inches, counter-clockwise.

    Args:
        spot: the anchor, and which part of the rectangle it is.
        wide: width, inches.
        high: height, inches.
    """
    left = {"left": 0.0, "center": -0.5, "right": -1.0}[spot.ha] * wide
    low = {"bottom": 0.0, "center": -0.5, "top": -1.0}[spot.va] * high
    box = np.array([(left, low), (left + wide, low), (left + wide, low + high), (left, low + high)])
    turn = math.radians(spot.turned)
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(box @ np.array([[c, s], [-s, c]]) + np.array([spot.x, spot.y]))


Bounds = tuple[float, float, float, float]
"""Left, low, right, high."""


class Boxes:
    """Rectangles in inches, found again by where they are."""

    def __init__(self) -> None:
        self._cells: dict[tuple[int, int], list[tuple[Bounds, np.ndarray]]] = {}

    def add(self, box: np.ndarray) -> None:
        """Add a rectangle by its corners, (4, 2)."""
        bounds = _bounds(box)
        for cell in _cells(bounds):
            self._cells.setdefault(cell, []).append((bounds, box))

    def add_lines(self, start: np.ndarray, end: np.ndarray, width: float) -> None:
        """Add straight lines, each as a rectangle.

        Args:
            start, end: (n, 2) inches.
            width: inches.
        """
        way = end - start
        length = np.maximum(np.hypot(way[:, 0], way[:, 1]), 1e-9)[:, None]
        aside = 0.5 * width * np.column_stack((-way[:, 1], way[:, 0])) / length
        for box in np.stack((start - aside, end - aside, end + aside, start + aside), axis=1):
            self.add(box)

    def meet(self, box: np.ndarray) -> bool:
        """Return whether a rectangle overlaps one of these."""
        bounds = left, low, right, high = _bounds(box)
        return any(
            right > u0 and left < u1 and high > v0 and low < v1 and _overlap(box, other)
            for cell in _cells(bounds)
            for (u0, v0, u1, v1), other in self._cells.get(cell, ())
        )


def _bounds(box: np.ndarray) -> Bounds:
    xs, ys = box.T.tolist()
    return min(xs), min(ys), max(xs), max(ys)


def _cells(bounds: Bounds) -> list[tuple[int, int]]:
    left, low, right, high = (math.floor(CELLS * value) for value in bounds)
    return [(column, row) for column in range(left, right + 1) for row in range(low, high + 1)]


def _overlap(box: np.ndarray, other: np.ndarray) -> bool:
    """Whether two rectangles have an area in common: no side of either separates them."""
    normals = np.concatenate([np.diff(corners[:3], axis=0) for corners in (box, other)])
    mine, its = box @ normals.T, other @ normals.T
    apart = (mine.max(axis=0) <= its.min(axis=0) + 1e-9) | (its.max(axis=0) <= mine.min(axis=0) + 1e-9)
    return not bool(apart.any())
