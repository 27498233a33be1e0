"""A placement of dampers: the elevation of the frame with them, and cost against demand of all layouts analysed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.report.design.placement_tables import front
from edesign.report.drawing.building_drawing import BuildingElevation
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.frame_drawing import Elevation, FrameElevation, draw_damper
from edesign.report.drawing.style import AFTER, MEAN, RECORDS, TARGET, VARIANTS, legend_above, new_figure, styled
from edesign.report.response.histories import names_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SIDE_BY_SIDE = 2
_MARKERS = ("s", "o", "D", "^", "v", "P", "X", "h")


def placement_figures(name: str, group: Group, file: AnalysisFile | None) -> Iterator[tuple[str, str, Figure]]:
    """Yield the chosen layout, and the layouts analysed.

    Args:
        file: the project or building; None: it cannot be read, and there is no elevation.

    Yields:
        Name of the file, caption and figure.
    """
    if "placement" not in group.variables:
        return
    about = group.attributes
    if file is not None:
        caption = f"Design {name}: the chosen layout, {about['dampers']} dampers, cost {float(about['cost']):.6g}."
        yield file_name("design", name, "placement"), caption, elevation_figure(group, _elevations(group, file))
    count = group.coords["layout"].values.size
    if count > 1:
        caption = (
            f"Design {name}: cost and worst ratio of demand to limit of the {count} layouts analysed; the line joins "
            "those than which none is as cheap and better."
        )
        yield file_name("design", name, "cost"), caption, cost_figure(group)


def _elevations(group: Group, file: AnalysisFile) -> dict[str, Elevation]:
    """The plane frames with candidate places by their names, that of a project without one."""
    if isinstance(file, Building):
        frames = dict.fromkeys(bay.partition(".")[0] for bay in names_of(group, "bay"))
        return {f"frame {frame}": BuildingElevation(file, frame) for frame in frames}
    assert isinstance(file, Project)
    return {"": FrameElevation(file.frame)}


@styled
def elevation_figure(group: Group, elevations: Mapping[str, Elevation]) -> Figure:
    """Draw plane frames to scale with the dampers of each item in its own colour and sign.

    Args:
        group: of a design, with damper_item over (damper,).
        elevations: of the frames, by their titles.
    """
    columns = min(_SIDE_BY_SIDE, len(elevations))
    rows = -(-len(elevations) // columns)
    slender = max(one.height / one.width for one in elevations.values())
    tall = min(5.0, max(1.6, 4.5 * slender)) if columns == 1 else min(3.0, max(1.2, 2.4 * slender))
    figure, grid = new_figure(rows, columns, 6.3, rows * tall)
    axes = [axis for row in grid for axis in row]
    dampers = names_of(group, "damper") if "damper" in group.coords else []
    items = group.variables["damper_item"].values.tolist() if dampers else []
    for axis in axes[len(elevations) :]:
        axis.set_axis_off()
    for axis, (title, elevation) in zip(axes, elevations.items(), strict=False):
        elevation.draw(axis, (), isolated=True)
        if title:
            axis.set_title(title)
        for name, item in zip(dampers, items, strict=True):
            draw_damper(axis, elevation.damper(name), *_sign(item))
    for item, name in enumerate(names_of(group, "item"), start=1):
        color, marker = _sign(item)
        label = f"{name} ({items.count(item)})"
        axes[columns - 1].plot([], [], color=color, marker=marker, ms=4.0, lw=0.7, label=label)
    axes[columns - 1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5), title="places with")
    return figure


def _sign(item: int) -> tuple[str, str]:
    """Colour and marker of an item by its number from 1."""
    return VARIANTS[(item - 1) % len(VARIANTS)], _MARKERS[(item - 1) % len(_MARKERS)]


@styled
def cost_figure(group: Group) -> Figure:
    """Draw the worst ratio of demand to limit of every layout analysed against its cost, with the Pareto front.

    Args:
        group: of a design, with layout_cost, layout_demand and layout_met over (layout,).
    """
    figure, ((axis,),) = new_figure(1, 1, 6.3, 3.2)
    cost, demand = (np.asarray(group.variables[f"layout_{key}"].values, dtype=float) for key in ("cost", "demand"))
    met = np.asarray(group.variables["layout_met"].values) == 1
    axis.plot(cost[~met], demand[~met], ls="none", marker="x", ms=4.0, color=RECORDS, label="missed")
    axis.plot(cost[met], demand[met], ls="none", marker="o", ms=3.5, mfc="white", mec=AFTER, label="met")
    best = front(group)
    axis.plot(cost[best], demand[best], color=MEAN, lw=0.8, drawstyle="steps-post", zorder=1.5, label="Pareto front")
    chosen = int(str(group.attributes["chosen_layout"])) - 1
    if met[chosen]:
        axis.plot(cost[chosen], demand[chosen], ls="none", marker="o", ms=6.0, color=AFTER, label="chosen")
    axis.axhline(1.0, color=TARGET, lw=0.9, ls="--")
    axis.set_xlabel("cost")
    axis.set_ylabel("worst demand / limit")
    axis.set_ylim(bottom=0.0)
    axis.set_xlim(left=min(0.0, float(cost.min())))
    legend_above(axis, 4)
    return figure
