"""Mean profiles over the height with all variants in one axis, a panel for each quantity."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.envelopes import peak
from edesign.assess.statistics import FRACTION, counted_percentile
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, grid_figure, legend_below, legend_label, some_of, styled
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import (
    History,
    by_level,
    histories,
    missing_text,
    variant_colors,
    worst_counts,
    worst_of_motions,
)
from edesign.report.response.profile_figures import DAMPERS, KINDS, TOTAL, Kind, profile, with_dampers

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = 3
HEIGHT = 2.2  # of a panel, inches: two figures of two rows stand on a sheet of the PDF
WITH_DAMPERS = Kind("storey shear, columns and dampers", "kN", 1e-3, "storey")
Read = Mapping[str, Sequence[tuple[History, Group]]]


@in_each_direction
def mean_profile_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the mean profiles of each hazard level with several variants.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    for level, variants in by_level(histories(archive)).items():
        read = {variant: [(h, h.read(archive)) for h in found if h.completed] for variant, found in variants.items()}
        read = {variant: found for variant, found in read.items() if found}
        panels = [(kind, values) for kind, values in _panels(read) if next(iter(values.values())).shape[1] > 1]
        if len(read) < 2 or not panels:
            continue
        several = any(len(values) > 1 for _, of in panels for values in of.values())
        counts = worst_counts(history for found in read.values() for history, _ in found)
        what = "Mean peaks" if several else "Peaks"
        dashed = " Thin and dashed is the 84th percentile of the records." if several else ""
        caption = (
            f"{what} over the height{at_level(level)}, all variants in one axis. {_numbers(panels)}"
            f"{dashed}{counts}{missing_text(history for found in variants.values() for history in found)}"
        )
        yield file_name("mean_profiles", level), caption, mean_profile_figure(panels, colors)


def _panels(read: Read) -> Iterator[tuple[Kind, dict[str, np.ndarray]]]:
    """Quantities, and of each variant that has it its values, (motions, floors or storeys) in the unit of the figure.

    The shear of columns and dampers together is known where all histories with dampers kept both over time.
    """
    damped = {name for name, found in read.items() if any(np.any(peak(group, DAMPERS)) for _, group in found)}
    for quantity, kind in KINDS.items():
        named = replace(kind, title="storey shear, columns") if damped and quantity == "storey_shear" else kind
        if values := _of_variants(read, named, dict.fromkeys(read, quantity)):
            yield named, values
    if damped and all(with_dampers(group) for name in damped for _, group in read[name]):
        names = {name: TOTAL if name in damped else "storey_shear" for name in read}
        if values := _of_variants(read, WITH_DAMPERS, names):
            yield WITH_DAMPERS, values


def _of_variants(read: Read, kind: Kind, names: Mapping[str, str]) -> dict[str, np.ndarray]:
    values = {}
    for variant, found in read.items():
        of = {history: profile(group, names[variant], kind) for history, group in found}
        there = {history: one for history, one in of.items() if one is not None}
        if there:
            values[variant] = worst_of_motions(there, there.values())
    return values


@styled
def mean_profile_figure(panels: Sequence[tuple[Kind, Mapping[str, np.ndarray]]], colors: Mapping[str, str]) -> Figure:
    """Draw the means of all variants over each other; of several records also the 84th percentile.

    Args:
        panels: at least one; values (motions, floors or storeys) by variant.
    """
    from matplotlib.lines import Line2D

    figure, axes = grid_figure(len(panels), COLUMNS, 2.35, HEIGHT)
    for axis, (kind, values) in zip(axes, panels, strict=True):
        _draw(axis, kind, values, colors)
    for place, axis in enumerate(axes):
        if place % COLUMNS and panels[place][0].ordinate == panels[place - 1][0].ordinate:
            axis.tick_params(labelleft=False)
        else:
            axis.set_ylabel(panels[place][0].ordinate)
    names = list(dict.fromkeys(name for _, values in panels for name in values))
    handles = [Line2D([], [], color=colors[name], lw=1.8) for name in names]
    legend_below(figure, handles, [legend_label(name) for name in names], 5)
    return figure


def _draw(axis: Axes, kind: Kind, values: Mapping[str, np.ndarray], colors: Mapping[str, str]) -> None:
    first = 0 if kind.base is not None else 1
    height = np.arange(first, first + next(iter(values.values())).shape[1])
    span = 0.0
    for variant, of in values.items():
        if of.shape[0] > 1:
            high = [counted_percentile(list(at), FRACTION) for at in of.T]
            axis.plot(high, height, color=colors[variant], lw=0.8, ls="--")
            span = max(span, *high)
        mean = of.mean(axis=0)
        axis.plot(mean, height, color=colors[variant], lw=1.8, marker="o", ms=2.4)
        span = max(span, float(mean.max()))
    span = 1.08 * span or 1.0
    for name, limit in kind.limits.items():
        if kind.factor * limit < span:
            at = kind.factor * limit
            axis.axvline(at, color=MEAN, lw=0.7, ls=":")
            axis.text(at, 1.0, name, transform=axis.get_xaxis_transform(), ha="center", va="bottom", fontsize=7.0)
    axis.set_xlim(0.0, span)
    axis.set_ylim(height[0] - (0.0 if first == 0 else 0.4), height[-1] + 0.4)
    axis.set_yticks(some_of(height))
    axis.set_xlabel(f"{kind.title} ({kind.unit})")


def _numbers(panels: Sequence[tuple[Kind, Mapping[str, np.ndarray]]]) -> str:
    """The largest mean of each variant in words."""
    texts = []
    for kind, values in panels:
        peaks = ", ".join(f"{variant} {plain(float(of.mean(axis=0).max()))}" for variant, of in values.items())
        texts.append(f"{kind.title} up to {peaks} {kind.unit}")
    text = "; ".join(texts)
    return f"{text[:1].upper()}{text[1:]}."
