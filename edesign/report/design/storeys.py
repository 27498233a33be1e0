"""What tables and figures of designs show storey by storey, whatever the method."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.drawing.style import AFTER, BEFORE, new_figure, some_of
from edesign.report.tables.table import Table, number, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def put_storeys(table: Table, group: Group, columns: Iterable[tuple[str, str, float]]) -> None:
    """Fill a table with a row for each storey with dampers.

    Args:
        table: without columns.
        group: of a design.
        columns: header, variable over (storey,), and the unit shown, in SI; those that the design has not are left out.
    """
    shown = [column for column in columns if column[1] in group.variables]
    table.columns = ("storey", *(header for header, _, _ in shown))
    for i, storey in enumerate(group.coords["storey"].values):
        cells = [number(float(group.variables[key].values[i]), scale=scale) for _, key, scale in shown]
        table.rows.append([whole(storey), *cells])


def heights_axes(group: Group) -> tuple[Figure, Axes, Axes | None]:
    """Make a figure over the height of a frame: an axis for the dampers, and one with the estimated drifts.

    Args:
        group: of a design; the second axis is there if a level was given: estimated_storey_drift and
            estimated_bare_storey_drift over (frame_storey,).
    """
    estimated = "estimated_storey_drift" in group.variables
    figure, (axes,) = new_figure(1, 2 if estimated else 1, 6.3 if estimated else 3.2, 3.0)
    every = np.asarray(group.coords["frame_storey"].values)
    axes[0].set_ylabel("storey")
    axes[0].grid(axis="y", visible=False)
    for axis in axes:
        axis.set_yticks(some_of(every))
        axis.set_ylim(every[0] - 0.6, every[-1] + 0.6)
    if not estimated:
        return figure, axes[0], None
    right = axes[1]
    for label, key, color in (
        ("without dampers", "estimated_bare_storey_drift", BEFORE),
        ("with dampers", "estimated_storey_drift", AFTER),
    ):
        right.plot(100.0 * group.variables[key].values, every, color=color, marker="o", ms=3.5, label=label)
    right.set_xlabel("estimated drift (%)")
    right.tick_params(labelleft=False)
    return figure, axes[0], right
