"""Boxes of texts in inches: how large a text is, and whether two of them meet."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

INCH = 72.0  # points
CELLS = 2  # an inch, in which boxes are sorted


@dataclass(frozen=True)
class Spot:
    """Where a text may stand: its anchor in inches, which part of it is there, and how it is turned, degrees."""

    x: float
    y: float
    ha: str = "center"
    va: str = "center"
    turned: float = 0.0


@lru_cache(maxsize=4096)
def text_size(words: str, size: float) -> tuple[float, float]:
    """Return width and height of a line of text, inches.

    Args:
        size: of the type, points.
    """
    from matplotlib.backend_bases import RendererBase
    from matplotlib.font_manager import FontProperties

    font, renderer = FontProperties(size=size), RendererBase()
    wide, _, _ = renderer.get_text_width_height_descent(words, font, False)
    _, high, _ = renderer.get_text_width_height_descent("lp", font, False)
    return wide / INCH, high / INCH


def wrapped(words: str, room: float, size: float) -> list[str]:
    """Return a text in lines that are not wider than a room.

    Args:
        room: width, inches.
        size: of the type, points.
    """
    wide = text_size(words, size)[0]
    if wide <= room:
        return [words]
    for letters in range(int(len(words) * room / wide * 1.15), 8, -2):
        lines = textwrap.wrap(words, letters)
        if all(text_size(line, size)[0] <= room for line in lines):
            return lines
    return [words]


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
