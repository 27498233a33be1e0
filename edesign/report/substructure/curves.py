"""Long histories of substructure tests as curves: thinned out, and windows in which single cycles can be seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.report.drawing.style import MEAN, legend_below, legend_label
from edesign.report.drawing.thin_out import thin_out

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 72.0  # in an inch
TOLERANCE = 0.1  # points
WIDTH = 6.8  # inches of figures over time
MANY = 4000  # points of a curve
LONGEST = 36  # characters of a label
CYCLES = 4  # in a window


def curve(
    axis: Axes,
    x: np.ndarray,
    y: np.ndarray,
    size: tuple[float, float],
    spans: tuple[float, float] | None = None,
    **style: Any,
) -> None:
    """Draw a curve without the points that lie within a line's width of its neighbours.

    Args:
        x: (n,) abscissas in the unit of the axes.
        y: (n,) ordinates in the unit of the axes; points that are not finite are left out.
        size: width and height of the axes, inches.
        spans: which values the axis has in width and height; None: those of the curve.
        **style: properties of matplotlib beside those.
    """
    good = np.isfinite(x) & np.isfinite(y)
    x, y = x[good], y[good]
    if not x.size:
        return
    wide, tall = spans if spans is not None else (float(np.ptp(x)), float(np.ptp(y)))
    scale = np.array([POINTS * size[0] / (wide or 1.0), POINTS * size[1] / (tall or 1.0)])
    points = _fewer(np.column_stack([x, y]) * scale)
    points = (thin_out(points, TOLERANCE) if len(points) > MANY else points) / scale
    axis.plot(points[:, 0], points[:, 1], **style)


def _fewer(points: np.ndarray) -> np.ndarray:
    """Leave out points of a polyline in points of the page, which a subdivision would take long over.

    Of one that goes forwards, as over time, the extremes in each piece of the abscissa are kept; of another a point for
    each piece of its length.
    """
    if len(points) < MANY:
        return points
    steps = np.diff(points, axis=0)
    if np.all(steps[:, 0] >= 0.0):
        piece = np.floor((points[:, 0] - points[0, 0]) / (3.0 * TOLERANCE)).astype(int)
        order = np.lexsort((points[:, 1], piece))
        first = np.flatnonzero(np.diff(piece[order], prepend=-1))
        kept = np.concatenate([order[first], order[np.append(first[1:], len(order)) - 1], [0, len(points) - 1]])
        return np.asarray(points[np.unique(kept)])
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*steps.T))])
    kept = np.flatnonzero(np.diff(np.floor(along / (2.0 * TOLERANCE)), prepend=-1.0, append=np.inf)[:-1])
    return np.asarray(points[np.union1d(kept, [len(points) - 1])])


def window(time: np.ndarray, target: np.ndarray, error: np.ndarray) -> tuple[float, float]:
    """Return start and end of a few cycles around the largest error, s.

    Args:
        time: (n,) s.
        target: (n,) whose cycles count.
        error: (n,) of what the largest is looked for.
    """
    if time.size < 2:
        return (0.0, 1.0)
    at = int(np.argmax(np.abs(error)))
    change = np.flatnonzero(np.diff(np.signbit(target - np.mean(target))))
    here = int(np.searchsorted(change, at))
    low, high = here - CYCLES, here + CYCLES
    begin = time[change[low]] if 0 <= low < change.size else time[0]
    end = time[change[high]] if high < change.size else time[-1]
    return float(begin), float(end)


def within(time: np.ndarray, limits: tuple[float, float]) -> slice:
    """Return the samples of a window as a slice.

    Args:
        time: (n,) s.
        limits: start and end of the window, s.
    """
    first, last = np.searchsorted(time, limits)
    return slice(int(first), int(last) + 1)


def largest(values: Sequence[np.ndarray]) -> float:
    """Return the largest finite magnitude in histories, 0 if there is none."""
    found = [np.max(np.abs(one[np.isfinite(one)]), initial=0.0) for one in values]
    return float(max(found, default=0.0))


def around_zero(axis: Axes, reach: float) -> None:
    """Give the ordinate the same reach to both sides, with a line at zero.

    Args:
        axis: the axes to draw on.
        reach: largest magnitude of the values.
    """
    axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
    axis.set_ylim(-1.1 * reach or -1.0, 1.1 * reach or 1.0)


def legend_of_lines(figure: Figure, lines: Sequence[tuple[str, str, str]]) -> None:
    """Put a legend below a figure: label, colour and style of each line; long labels are cut.

    Args:
        lines: label, colour and style of each line.
    """
    from matplotlib.lines import Line2D

    named = [label if len(label) <= LONGEST else f"{label[: LONGEST - 1]}…" for label, _, _ in lines]
    handles = [
        Line2D([], [], color=color, ls=style, lw=1.3, label=legend_label(label))
        for label, (_, color, style) in zip(named, lines, strict=True)
    ]
    legend_below(figure, handles)
