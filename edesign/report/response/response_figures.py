"""Histories of roof and base with the ground motion above them, variants overlaid."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import (
    BEFORE,
    MEAN,
    align_ordinates,
    legend_below,
    legend_label,
    new_figure,
    styled,
)
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import by_motion, histories, missing_text, variant_colors, with_results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDTHS = (1.0, 0.7)  # of the first line, which lies below, and of further ones


@dataclass(frozen=True)
class Row:
    """A quantity over time: its variable, the component (None: it has none), and how it is shown."""

    variable: str
    component: int | None
    title: str
    unit: str
    factor: float

    def of(self, group: Group) -> np.ndarray | None:
        """Return the history in the unit of the figure, None if it was not kept."""
        if self.variable not in group.variables:
            return None
        values = np.asarray(group.variables[self.variable].values)
        return self.factor * (values if self.component is None else values[:, self.component])


GROUND = Row("ground_acceleration", None, "ground\nacceleration", "m/s²", 1.0)
ROWS = (
    Row("ground_acceleration_vertical", None, "vertical ground\nacceleration", "m/s²", 1.0),
    Row("floor_displacement", -1, "roof\ndisplacement", "mm", 1e3),
    Row("floor_acceleration", -1, "roof\nacceleration", "m/s²", 1.0),
    Row("storey_shear", 0, "first-storey shear,\ncolumns", "kN", 1e-3),
    Row("base_shear", None, "base\nshear", "kN", 1e-3),
)


@dataclass(frozen=True)
class Series:
    """The results of one history, its label, and its color."""

    label: str
    group: Group
    color: str


@in_each_direction
def response_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the histories of each motion whose floors or storeys were kept.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    own = [history for history in histories(archive) if history.temperature is None]
    for (level, record), chosen in by_motion(own).items():
        series = [
            Series(history.variant, group, colors[history.variant])
            for history, group in with_results(archive, chosen, GROUND.variable)
            if any(row.variable in group.variables for row in ROWS)
        ]
        if series:
            caption = f"Response to {chosen[0].motion}{at_level(level)}. {numbers(series)}{missing_text(chosen)}"
            yield file_name("response", level, record), caption, response_figure(series)


@styled
def response_figure(series: Sequence[Series]) -> Figure:
    """Draw histories as Figs. 5.44 and 5.45 of the thesis; the largest value of each is marked.

    Args:
        series: at least one, all of one ground motion; the first lies below.
    """
    rows = _shown(series)
    figure, axes = new_figure(1 + len(rows), 1, 6.5, 0.9 + 1.2 * (1 + len(rows)))
    top = axes[0][0]
    ground = series[0].group
    top.plot(ground.coords["time"].values, ground.variables[GROUND.variable].values, color=BEFORE, lw=0.5)
    last = max(float(one.group.coords["time"].values[-1]) for one in series)
    for (axis,), row in zip(axes, (GROUND, *rows), strict=True):
        largest = 0.0
        for i, one in enumerate(series):
            values = row.of(one.group)
            if values is None:
                continue
            largest = max(largest, float(np.max(np.abs(values))))
            if row is GROUND:
                continue
            time = one.group.coords["time"].values
            at = int(np.argmax(np.abs(values)))
            axis.plot(time, values, color=one.color, lw=_WIDTHS[min(i, 1)], label=legend_label(one.label) or None)
            axis.plot(time[at], values[at], marker="o", ms=3.4, mfc=one.color, mec=MEAN, mew=0.5, ls="none")
        axis.axhline(0.0, color=MEAN, lw=0.5, zorder=0.9)
        axis.set_ylim(-1.15 * largest or -1.0, 1.15 * largest or 1.0)
        axis.set_xlim(0.0, last)
        axis.set_ylabel(f"{row.title}\n({row.unit})")
        axis.tick_params(labelbottom=False)
    bottom = axes[-1][0]
    bottom.tick_params(labelbottom=True)
    bottom.set_xlabel("time (s)")
    align_ordinates(row[0] for row in axes)
    handles, labels = bottom.get_legend_handles_labels()
    if labels:
        legend_below(figure, handles, labels, len(labels))
    return figure


def _shown(series: Sequence[Series]) -> list[Row]:
    """Rows of which there is something; without dampers the shear of the first storey is that at the base."""
    damped = any("damper_force_max" in one.group.variables for one in series)
    there = [row for row in ROWS if any(row.variable in one.group.variables for one in series)]
    return [row for row in there if damped or row.variable != "storey_shear"]


def numbers(series: Sequence[Series]) -> str:
    """Return the largest values of all histories in words."""
    texts = []
    for one in series:
        parts = []
        for row in ROWS:
            values = row.of(one.group) if row in _shown([one]) else None
            if values is not None:
                title = row.title.replace("\n", " ")
                parts.append(f"{title} {plain(float(np.max(np.abs(values))))} {row.unit}")
        texts.append(f"{one.label}: {', '.join(parts)}" if one.label else ", ".join(parts))
    return f"Largest values: {'; '.join(texts)}."
