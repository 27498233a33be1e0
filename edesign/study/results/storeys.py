"""Drifts and shears of storeys.

The drift of a storey is the mean over the column lines that have a column there; its extremes are those of the worst
column line. Shears are positive for loads to the right; they are forces of the members, damping forces are not in them.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel, Sum
from edesign.study.results.recording import Quantity, Terms, directed, recorded


def storey_drifts(frame: FrameModel, history: bool) -> Quantity:
    """Return the drift ratio of each storey, a mean over its column lines, as a quantity to be recorded.

    Its extremes are stored by `store_drift_extremes`.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(_mean([at.ratio for at in lines]) for storey in frame.storeys for lines in storey.drifts)
    name = "drift ratio of the storey, mean over its column lines"
    return Quantity("storey_drift", *directed(frame, "storey"), cells, "1", name, history, ("final",))


def line_drifts(frame: FrameModel) -> Quantity:
    """Return the drift ratio of each storey on every column line, one after the other; it is not archived."""
    cells = tuple(recorded(at.ratio) for storey in frame.storeys for lines in storey.drifts for at in lines)
    return Quantity("line_drift", ("line_drift",), (len(cells),), cells, "1", "drift ratio on a column line", keep=())


def line_drift_storeys(frame: FrameModel) -> list[int]:
    """Return the storey, from 1, of each component of `line_drifts`."""
    return [storey.number for storey in frame.storeys for lines in storey.drifts for _ in lines]


def store_drift_extremes(group: Group, frame: FrameModel, drifts: Quantity, response: Response) -> None:
    """Add the extremes of the storey drifts over time and column lines to a group.

    Args:
        group: of the analysis.
        drifts: as `line_drifts` gives them.
        response: of the analysis.
    """
    counts = [len(lines) for storey in frame.storeys for lines in storey.drifts]
    dims, shape = directed(frame, "storey")
    starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
    largest = np.maximum.reduceat(drifts.extreme(response, "max"), starts).reshape(shape)
    smallest = np.minimum.reduceat(drifts.extreme(response, "min"), starts).reshape(shape)
    label = "drift ratio of the storey"
    group.add("storey_drift_max", dims, largest, "1", f"{label}, largest value over time and column lines")
    group.add("storey_drift_min", dims, smallest, "1", f"{label}, smallest value over time and column lines")


def storey_shears(frame: FrameModel, history: bool) -> Quantity:
    """Return the horizontal force in all columns and braces of each storey, second-order terms included, N.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(terms for storey in frame.storeys for terms in storey.shear)
    name = "horizontal force on the upper ends of the storey's columns and braces"
    return Quantity("storey_shear", *directed(frame, "storey"), cells, "N", name, history)


def _mean(ratios: Sequence[Sum]) -> Terms:
    """The mean of several displacements as one sum."""
    share = 1.0 / len(ratios)
    return tuple(term for ratio in ratios for term in recorded(ratio, factor=share))
