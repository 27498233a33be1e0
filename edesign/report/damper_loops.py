"""Figures of dampers in frames: force against deformation, and over time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.figures import AFTER, new_figure, styled
from edesign.report.summary import planned, results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = 4
MOST = 24
"""Dampers in one figure; of more, those with the largest deformation."""


def damper_figures(archive: Archive) -> Iterator[tuple[str, Figure]]:
    """The loops of every history whose dampers were kept over time (`outputs.histories: [dampers]`), by file name."""
    for name in planned(archive):
        group = results(archive, name)
        if "damper_force" in group.variables and "damper_deformation" in group.variables:
            yield f"{name.replace('/', '_')}_dampers", loops_figure(group, name)


@styled
def loops_figure(group: Group, title: str) -> Figure:
    """Force against deformation of each damper of a history, all to one scale of deformation.

    Args:
        group: has damper_force (time, damper) N and damper_deformation (time, damper) m.
        title: above the figure.
    """
    force, deformation = group.variables["damper_force"].values, group.variables["damper_deformation"].values
    names = [value.decode() if isinstance(value, bytes) else str(value) for value in group.coords["damper"].values]
    largest = np.max(np.abs(deformation), axis=0)
    shown = sorted(np.argsort(-largest)[:MOST].tolist())
    columns = min(COLUMNS, len(shown))
    rows = math.ceil(len(shown) / columns)
    figure, axes = new_figure(rows, columns, 1.0 + 1.75 * columns, 0.8 + 1.6 * rows)
    cells = [axis for row in axes for axis in row]
    span = 1.05e3 * float(np.max(largest)) or 1.0
    for axis, i in zip(cells, shown, strict=False):
        axis.plot(1e3 * deformation[:, i], 1e-3 * force[:, i], color=AFTER, linewidth=0.7)
        axis.set_title(names[i])
        axis.set_xlim(-span, span)
    for axis in cells[len(shown) :]:
        axis.set_visible(False)
    for place, axis in enumerate(cells[: len(shown)]):
        if place % columns == 0:
            axis.set_ylabel("force [kN]")
        if place + columns >= len(shown):
            axis.set_xlabel("deformation [mm]")
    left_out = f", the {MOST} with the largest deformation" if len(names) > MOST else ""
    figure.suptitle(f"{title}{left_out}", fontsize=9.0)
    return figure
