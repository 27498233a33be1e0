"""How many elevations stand beside each other, and how large each is, so that bays and storeys can be told apart."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from edesign.report.drawing.style import BESIDE, new_figure
from edesign.report.drawing.text_size import text_size, wrapped

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

LINE = 6.6  # inches of all elevations beside each other: the width of a sheet of A4 between its margins
TALLEST, STRETCHED = 3.9, 6.4  # inches of an elevation at one scale, and of one at two
PITCH = (
    0.2  # inches of a bay and of a storey: the largest hinge (6.8 points) at both ends of a beam, and as much between
)
NARROWEST = 1.5  # inches of a panel, for its title
SMALL_TITLE = 7.5  # points, of a title that takes several lines
TITLE = 0.3  # inches above an elevation


@dataclass(frozen=True)
class Panels:
    """Elevations of one structure on a figure.

    Attributes:
        columns: beside each other.
        rows: below each other.
        width, height: of one, inches.
        true: whether widths and heights have one scale.
    """

    columns: int
    rows: int
    width: float
    height: float
    true: bool

    def figure(self, more: float = 0.4) -> tuple[Figure, list[Axes]]:
        """Return a figure and its axes in reading order; to be called when `styled`.

        Args:
            more: inches below the elevations, for a legend.
        """
        high = self.rows * (self.height + TITLE) + more
        figure, axes = new_figure(self.rows, self.columns, self.columns * (self.width + 0.1), high)
        return figure, [axis for row in axes for axis in row]

    def title(self, axis: Axes, text: str) -> None:
        """Write a title above an elevation, in lines as wide as it is."""
        size = 9.0 if text_size(text, 9.0)[0] <= self.width - BESIDE else SMALL_TITLE
        axis.set_title("\n".join(wrapped(text, self.width - BESIDE, size)), loc="left", fontsize=size)

    def scale(self, axis: Axes) -> None:
        """Give an elevation that is drawn its scales."""
        axis.set_aspect("equal" if self.true else "auto")
        axis.set_axis_off()


def arrangement(count: int, xs: Iterable[float], ys: Iterable[float], wide: float, high: float) -> Panels:
    """Return the arrangement of elevations: as many beside each other as leave bays and storeys large enough.

    Widths and heights have two scales where one scale would leave storeys lower than `PITCH` on a sheet.

    Args:
        xs: places of column lines, m.
        ys: levels of floors, m.
        wide: what is drawn of an elevation, m.
        high: the same upwards, m.
    """
    bay, storey = (_mean_distance(places) for places in (xs, ys))
    most = max(1, min(count, int(LINE / NARROWEST)))
    for columns in range(most, 0, -1):
        room = LINE / columns
        scale = min(room / wide, TALLEST / high)
        if scale * min(bay, storey) >= PITCH:
            return _at(count, columns, scale * wide, scale * high, True)
        across, up = room / wide, min(max(room / wide, PITCH / storey), STRETCHED / high)
        if across * bay >= PITCH or columns == 1:
            return _at(count, columns, across * wide, up * high, abs(up - across) < 1e-9)
    raise AssertionError("one column always does")


def _at(count: int, columns: int, width: float, height: float, true: bool) -> Panels:
    rows = -(-count // columns)
    return Panels(-(-count // rows), rows, max(NARROWEST, width), height, true)


def _mean_distance(places: Iterable[float]) -> float:
    """The mean distance between places, m; of one alone it has no say."""
    found = sorted({round(place, 6) for place in places})
    return sum(b - a for a, b in pairwise(found)) / (len(found) - 1) if len(found) > 1 else float("inf")
