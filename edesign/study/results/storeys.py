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
from edesign.study.results.recording import Quantity, Terms, coordinate, directed, recorded


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


def drifts_in_words(frame: FrameModel) -> list[str]:
    """Return what each component of `line_drifts` is, such as "drift of storey 3"."""
    return [
        f"drift of storey {storey.number}" + (f" along {direction.name} at {at.line}" if direction.name else "")
        for storey in frame.storeys
        for direction, lines in zip(frame.directions, storey.drifts, strict=True)
        for at in lines
    ]


def line_coordinates(group: Group, frame: FrameModel) -> None:
    """Add the column lines of a building on which its storeys drift to a group; a plane frame has none there.

    Args:
        group: of an analysis.
    """
    if not frame.directions[0].name:
        return
    lines = [(storey, i, at) for storey in frame.storeys for i, at in enumerate(storey.drifts[0])]
    coordinate(group, "drift_line", [f"{at.line}.{storey.number}" for storey, _, at in lines], "", "column line.storey")
    group.add("drift_line_storey", ("drift_line",), [storey.number for storey, _, _ in lines], "1", "its storey")
    frames = [[", ".join(of[i].frames) for of in storey.drifts] for storey, i, _ in lines]
    label = "plane frames along the direction that the line stands in"
    group.add("drift_line_frame", ("drift_line", "direction"), frames, "", label)


def by_line(frame: FrameModel, values: np.ndarray) -> np.ndarray:
    """Return values of `line_drifts` by the column lines and directions of a building, (..., drift lines, directions).

    Args:
        values: (..., components).
    """
    counts = [len(storey.drifts[0]) for storey in frame.storeys]
    ends = len(frame.directions) * np.cumsum(counts)[:-1]
    parts = np.split(values, ends, axis=-1)
    shaped = [part.reshape(*values.shape[:-1], len(frame.directions), -1) for part in parts]
    return np.moveaxis(np.concatenate(shaped, axis=-1), -2, -1)


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
    if not frame.directions[0].name:
        return
    for which, words in (("max", "largest value"), ("min", "smallest value"), ("final", "at the end")):
        values = by_line(frame, drifts.extreme(response, which))
        label = f"drift ratio of the storey on the column line, {words}"
        group.add(f"line_drift_{which}", ("drift_line", "direction"), values, "1", label)


def store_mean_drifts(group: Group, drifts: Quantity, response: Response) -> None:
    """Add the extremes over time of the mean drifts of a building's storeys to a group; nothing of a plane frame.

    Args:
        group: of the analysis.
        drifts: as `storey_drifts` gives them.
        response: of the analysis.
    """
    if drifts.dims[-1] != "direction":
        return
    for which, words in (("max", "largest"), ("min", "smallest")):
        label = f"{drifts.long_name}, {words} value"
        group.add(f"mean_storey_drift_{which}", drifts.dims, drifts.extreme(response, which), "1", label)


def storey_shears(frame: FrameModel, history: bool) -> Quantity:
    """Return the horizontal force in all columns and braces of each storey, second-order terms included, N.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(terms for storey in frame.storeys for terms in storey.shear)
    name = "horizontal force on the upper ends of the storey's columns and braces"
    return Quantity("storey_shear", *directed(frame, "storey"), cells, "N", name, history)


def storey_torques(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the moment of the storey shears of a building about the vertical, N m; nothing for a plane frame.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(storey.torque for storey in frame.storeys)
    name = "moment of the forces of the storey's columns and braces about the centre of mass of the floor above"
    return [Quantity("storey_torque", ("storey",), (len(cells),), cells, "N*m", name, history)] if any(cells) else []


def _mean(ratios: Sequence[Sum]) -> Terms:
    """The mean of several displacements as one sum."""
    share = 1.0 / len(ratios)
    return tuple(term for ratio in ratios for term in recorded(ratio, factor=share))
