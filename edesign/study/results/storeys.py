"""Drifts and shears of storeys.

The drift of a storey is the mean over the column lines that have a column there; its extremes are those of the worst
column line. Shears are positive for loads to the right; they are forces of the members, damping forces are not in them.
"""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.project.notation import names
from edesign.study.results.recording import Quantity, Terms


def storey_drifts(frame: FrameModel, history: bool) -> Quantity:
    """Return the drift ratio of each storey, a mean over its column lines, as a quantity to be recorded.

    Its extremes are stored by `store_drift_extremes`.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(_mean(lines) for lines in _line_drifts(frame))
    name = "drift ratio of the storey, mean over its column lines"
    return Quantity("storey_drift", ("storey",), (len(cells),), cells, "1", name, history, ("final",))


def line_drifts(frame: FrameModel) -> Quantity:
    """Return the drift ratio of each storey on every column line, one after the other; it is not archived."""
    cells = tuple(terms for lines in _line_drifts(frame) for terms in lines)
    return Quantity("line_drift", ("line_drift",), (len(cells),), cells, "1", "drift ratio on a column line", keep=())


def line_drift_storeys(frame: FrameModel) -> list[int]:
    """Return the storey, from 1, of each component of `line_drifts`."""
    return [storey for storey, lines in enumerate(_line_drifts(frame), start=1) for _ in lines]


def store_drift_extremes(group: Group, frame: FrameModel, drifts: Quantity, response: Response) -> None:
    """Add the extremes of the storey drifts over time and column lines to a group.

    Args:
        group: of the analysis.
        drifts: as `line_drifts` gives them.
        response: of the analysis.
    """
    counts = [len(lines) for lines in _line_drifts(frame)]
    starts = np.concatenate(([0], np.cumsum(counts)[:-1]))
    largest = np.maximum.reduceat(drifts.extreme(response, "max"), starts)
    smallest = np.minimum.reduceat(drifts.extreme(response, "min"), starts)
    label = "drift ratio of the storey"
    group.add("storey_drift_max", ("storey",), largest, "1", f"{label}, largest value over time and column lines")
    group.add("storey_drift_min", ("storey",), smallest, "1", f"{label}, smallest value over time and column lines")


def storey_shears(frame: FrameModel, history: bool) -> Quantity:
    """Return the horizontal force in all columns and braces of each storey, second-order terms included, N.

    Args:
        history: whether values over time are kept.
    """
    cells: list[Terms] = [() for _ in range(frame.frame.n_storeys)]
    for line, storey in frame.frame.column_at:
        element = frame.members[names.column_name(line, storey)].at_end(1)
        cells[storey - 1] += ((1.0, "global_force", element, 3),)
    for bay, storey, way in frame.frame.brace_at:
        element = frame.members[names.brace_name(bay, storey, way)].element
        upper_end = 3 if way == "r" else 0
        cells[storey - 1] += ((1.0, "global_force", element, upper_end),)
    name = "horizontal force on the upper ends of the storey's columns and braces"
    return Quantity("storey_shear", ("storey",), (len(cells),), tuple(cells), "N", name, history)


def _mean(several: list[Terms]) -> Terms:
    """The mean of several weighted sums as one."""
    share = 1.0 / len(several)
    return tuple((share * factor, kind, item, at) for terms in several for factor, kind, item, at in terms)


def _line_drifts(frame: FrameModel) -> list[list[Terms]]:
    """For each storey the drift ratio on each line that has a column there, from the left.

    Without any column it is taken on the lines with nodes above and below, and else between the leading nodes.
    """
    grid = frame.frame
    found = []
    for storey, height in enumerate(grid.storey_heights, start=1):
        pairs = [(names.node_name(line, storey), names.node_name(line, storey - 1)) for line in grid.lines]
        columns = [(line, storey) in grid.column_at for line in grid.lines]
        chosen = [pair for pair, column in zip(pairs, columns, strict=True) if column]
        if not chosen:
            chosen = [pair for pair in pairs if pair[0] in frame.nodes and pair[1] in frame.nodes]
        if not chosen:
            below = frame.floor_nodes(storey - 1)
            chosen = [(frame.leading_nodes[storey - 1], below[0] if below else "")]
        found.append([_drift(frame, upper, lower, height) for upper, lower in chosen])
    return found


def _drift(frame: FrameModel, upper: str, lower: str, height: float) -> Terms:
    terms: Terms = ((1.0 / height, "displacement", frame.nodes[upper], 0),)
    if lower in frame.nodes:
        terms += ((-1.0 / height, "displacement", frame.nodes[lower], 0),)
    return terms
