"""The texts of a figure as the page has them: which overlap, are cut at an edge, or stand on lines and marks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from edesign.report.drawing.style import SEEN, Rgb, contrast

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TOUCH = 0.5
"""Points by which boxes may overlap: half of the blank round the ink of a letter of 8 points, which nobody sees."""
BLANK = 0.2
"""Between two texts of one line, of their height: a blank is 0.32 em of the type, and less reads as one word."""


Clip = tuple[float, float, float, float]
"""Left, low, right, high, points."""


@dataclass(frozen=True)
class Written:
    """A text as it was drawn.

    Attributes:
        text: as it stands.
        corners: of its box, counter-clockwise from its lower left one, (4, 2) points from the lower left of the figure.
        after: how many inks were drawn before it.
    """

    text: str
    corners: np.ndarray
    after: int = 0


@dataclass(frozen=True)
class Ink:
    """Lines or marks that were drawn, or a face that hides what is under it.

    Attributes:
        lines: points of each, (n, 2) points from the lower left of the figure.
        width: of the lines, points.
        hides: whether it is a light face: what was drawn before is not seen within it.
        clip: beyond which nothing is seen; None: all is.
    """

    lines: Sequence[np.ndarray]
    width: float
    hides: bool = False
    clip: Clip | None = None


def is_cover(face: Rgb) -> bool:
    """Return whether a face is light enough to read texts on it, and hides black lines under it."""
    under = 1.0 - (face[3] if len(face) > 3 else 1.0)
    return contrast(face[:3]) < SEEN and contrast((0.0, 0.0, 0.0, under)) < SEEN


def faults(figure: Figure) -> list[str]:
    """Return what is wrong with the texts of a figure, in words: those that overlap, those that are cut or struck.

    Args:
        figure: as drawn by a `styled` function; it is drawn once more, at the size of the page.
    """
    from edesign.report.html.inline_svg import rendered

    renderer = rendered(figure, "figure")
    return faults_of(renderer.written, renderer.width, renderer.height, renderer.ink)


def faults_of(written: Sequence[Written], width: float, height: float, ink: Sequence[Ink] = ()) -> list[str]:
    """Return what is wrong with texts on a sheet; see `faults`.

    Args:
        width, height: of the sheet, points.
        ink: that can be seen, in the order in which it was drawn.
    """
    texts = [one for one in written if one.text.strip()]
    found = [
        f"`{one.text}` is cut"
        for one in texts
        if np.any(one.corners < -TOUCH) or np.any(one.corners > np.array([width, height]) + TOUCH)
    ]
    low = np.array([one.corners.min(axis=0) for one in texts]).reshape(-1, 2) + TOUCH
    high = np.array([one.corners.max(axis=0) for one in texts]).reshape(-1, 2) - TOUCH
    for i, j in combinations(range(len(texts)), 2):
        if np.all(low[i] < high[j]) and np.all(low[j] < high[i]) and _overlap(texts[i].corners, texts[j].corners):
            found.append(f"`{texts[i].text}` and `{texts[j].text}` overlap")
        elif _one_word(texts[i].corners, texts[j].corners):
            found.append(f"`{texts[i].text}` and `{texts[j].text}` read as one")
    return found + [f"`{one.text}` stands on a line or mark" for one in _struck(texts, ink)]


def _struck(texts: Sequence[Written], ink: Sequence[Ink]) -> list[Written]:
    """The texts through whose boxes lines go that are seen there."""
    strokes = [(k, one, points) for k, one in enumerate(ink) if one.width for points in one.lines if len(points) > 1]
    if not strokes:
        return []
    start, end = (np.concatenate([points[part] for *_, points in strokes]) for part in (slice(-1), slice(1, None)))
    counts = [len(points) - 1 for *_, points in strokes]
    number = np.repeat([k for k, *_ in strokes], counts)
    half = np.repeat([0.5 * one.width for _, one, _ in strokes], counts)
    all_seen = (-np.inf, -np.inf, np.inf, np.inf)
    clips = np.repeat([one.clip or all_seen for _, one, _ in strokes], counts, axis=0)
    low, high = np.minimum(start, end) - half[:, None], np.maximum(start, end) + half[:, None]
    found = []
    for text in texts:
        left_low, right_high = text.corners.min(axis=0), text.corners.max(axis=0)
        near = np.flatnonzero(
            np.all((low < right_high) & (high > left_low), axis=1)
            & np.all((clips[:, :2] < right_high - TOUCH) & (clips[:, 2:] > left_low + TOUCH), axis=1)
        )
        if not len(near):
            continue
        covers = (k for k in range(text.after - 1, -1, -1) if ink[k].hides and _within(text.corners, ink[k]))
        near = near[number[near] > next(covers, -1)]
        if len(near) and np.any(_through(text.corners, start[near], end[near], half[near])):
            found.append(text)
    return found


def _within(corners: np.ndarray, face: Ink) -> bool:
    """Whether a box is within a face, but for what nobody sees."""
    from matplotlib.path import Path

    middle = corners.mean(axis=0)
    ends = middle + (corners - middle) * (1.0 - 2.0 * TOUCH / np.maximum(np.ptp(corners, axis=0), 4.0 * TOUCH))
    return any(len(points) > 2 and bool(Path(points).contains_points(ends).all()) for points in face.lines)


def _through(corners: np.ndarray, start: np.ndarray, end: np.ndarray, half: np.ndarray) -> np.ndarray:
    """Whether lines of half a width go more than `TOUCH` deep into a rectangle, (n,)."""
    sides = corners[1] - corners[0], corners[3] - corners[0]
    enter, leave = np.zeros(len(start)), np.ones(len(start))
    for side in sides:
        length = max(float(np.hypot(*side)), 1e-9)
        at, to = ((points - corners[0]) @ side / length for points in (start, end))
        least, most = TOUCH - half, length - TOUCH + half
        way = np.where(to == at, 1e-12, to - at)
        first, second = (least - at) / way, (most - at) / way
        enter, leave = np.maximum(enter, np.minimum(first, second)), np.minimum(leave, np.maximum(first, second))
    return np.asarray(enter < leave)


def _one_word(box: np.ndarray, other: np.ndarray) -> bool:
    """Whether two level texts stand on one line with less than a blank between them."""
    level = all(abs(corners[1, 1] - corners[0, 1]) < TOUCH for corners in (box, other))
    if not level or abs(box[0, 1] - other[0, 1]) > TOUCH:
        return False
    gap = max(box[0, 0] - other[1, 0], other[0, 0] - box[1, 0])
    return bool(-TOUCH < gap < BLANK * max(corners[2, 1] - corners[1, 1] for corners in (box, other)))


def _overlap(box: np.ndarray, other: np.ndarray) -> bool:
    """Whether two rectangles have more in common than `TOUCH`: no side of either separates them."""
    for corners in (box, other):
        for side in np.diff(corners[:3], axis=0):
            normal = np.array([-side[1], side[0]]) / max(float(np.hypot(*side)), 1e-9)
            mine, its = box @ normal, other @ normal
            if mine.max() <= its.min() + TOUCH or its.max() <= mine.min() + TOUCH:
                return False
    return True
