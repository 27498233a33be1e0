"""Boxes of texts in inches: how large a text is, and whether two of them meet."""

from __future__ import annotations

import math
import textwrap
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

INCH = 72.0  # points


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
    """Width and height of a line of text of a size in points, inches."""
    from matplotlib.backend_bases import RendererBase
    from matplotlib.font_manager import FontProperties

    font, renderer = FontProperties(size=size), RendererBase()
    wide, _, _ = renderer.get_text_width_height_descent(words, font, False)
    _, high, _ = renderer.get_text_width_height_descent("lp", font, False)
    return wide / INCH, high / INCH


def wrapped(words: str, room: float, size: float) -> list[str]:
    """A text in lines that are not wider than a room in inches."""
    wide = text_size(words, size)[0]
    if wide <= room:
        return [words]
    for letters in range(int(len(words) * room / wide * 1.15), 8, -2):
        lines = textwrap.wrap(words, letters)
        if all(text_size(line, size)[0] <= room for line in lines):
            return lines
    return [words]


def corners_of(spot: Spot, wide: float, high: float) -> np.ndarray:
    """Corners of a rectangle with its anchor at a spot, (4, 2) inches, counter-clockwise."""
    left = {"left": 0.0, "center": -0.5, "right": -1.0}[spot.ha] * wide
    low = {"bottom": 0.0, "center": -0.5, "top": -1.0}[spot.va] * high
    box = np.array([(left, low), (left + wide, low), (left + wide, low + high), (left, low + high)])
    turn = math.radians(spot.turned)
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(box @ np.array([[c, s], [-s, c]]) + np.array([spot.x, spot.y]))


def meets(box: np.ndarray, others: np.ndarray) -> bool:
    """Whether a rectangle has an area in common with one of others, (n, 4, 2): no side of either separates them."""
    if not len(others):
        return False
    low, high = others.min(axis=1), others.max(axis=1)
    near = others[np.all(low < box.max(axis=0), axis=1) & np.all(high > box.min(axis=0), axis=1)]
    for other in near:
        normals = np.concatenate([np.diff(corners[:3], axis=0) for corners in (box, other)])
        mine, its = box @ normals.T, other @ normals.T
        if np.all(mine.max(axis=0) > its.min(axis=0) + 1e-9) and np.all(its.max(axis=0) > mine.min(axis=0) + 1e-9):
            return True
    return False
