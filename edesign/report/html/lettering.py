"""The texts of a figure as the page has them: which of them overlap, and which are cut at an edge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TOUCH = 0.5
"""Points by which boxes may overlap: half of the blank round the ink of a letter of 8 points, which nobody sees."""
BLANK = 0.2
"""Between two texts of one line, of their height: a blank is 0.32 em of the type, and less reads as one word."""


@dataclass(frozen=True)
class Written:
    """A text as it was drawn.

    Attributes:
        text: as it stands.
        corners: of its box, counter-clockwise from its lower left one, (4, 2) points from the lower left of the figure.
    """

    text: str
    corners: np.ndarray


def faults(figure: Figure) -> list[str]:
    """Return what is wrong with the texts of a figure, in words: those that overlap, and those that are cut.

    Args:
        figure: as drawn by a `styled` function; it is drawn once more, at the size of the page.
    """
    from edesign.report.html.inline_svg import rendered

    renderer = rendered(figure, "figure")
    return faults_of(renderer.written, renderer.width, renderer.height)


def faults_of(written: Sequence[Written], width: float, height: float) -> list[str]:
    """Return what is wrong with texts on a sheet; see `faults`.

    Args:
        width, height: of the sheet, points.
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
    return found


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
