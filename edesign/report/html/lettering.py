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
        written: the texts.
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
    return found


def _overlap(box: np.ndarray, other: np.ndarray) -> bool:
    """Whether two rectangles have more in common than `TOUCH`: no side of either separates them."""
    for corners in (box, other):
        for side in np.diff(corners[:3], axis=0):
            normal = np.array([-side[1], side[0]]) / max(float(np.hypot(*side)), 1e-9)
            mine, its = box @ normal, other @ normal
            if mine.max() <= its.min() + TOUCH or its.max() <= mine.min() + TOUCH:
                return False
    return True
