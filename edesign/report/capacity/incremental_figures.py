"""Figures of incremental dynamic analysis: curves of all records with their fractiles, and fragilities."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.assess.incremental import COLLAPSE, FRACTILES, Stripes, capacities, fractile_curves
from edesign.assess.limit_fragility import LimitFragility
from edesign.report.assessment.measure_columns import measure_title
from edesign.report.capacity.incremental_results import UNITS, IncrementalResults, read_incremental
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import MEAN, RECORDS, TARGET, VARIANTS, label_outer, legend_below, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

POINTS = 400
_DASHES = {0.16: (4, 2), 0.50: (), 0.84: (1.5, 1.5)}


def incremental_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the curves and fragilities of each incremental study of an archive.

    Yields:
        Name of the file, caption and figure.
    """
    for one in read_incremental(archive):
        yield from results_figures(one)


def results_figures(results: IncrementalResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield the figures of one incremental study; see `incremental_figures`."""
    name, scale = results.name, UNITS[results.unit][1]
    for measure in results.measures:
        stripes = results.stripes_of(measure)
        if not stripes:
            continue
        title, unit, factor = measure_title(measure)
        limits = {limit: value for limit, value in results.limits_of(measure).items() if np.isfinite(value)}
        caption = f"Incremental dynamic analysis {name}: {title} of each record, and fractiles over the records."
        drawn = ida_figure(stripes, results.label, scale, f"{title} ({unit})" if unit else title, factor, limits)
        yield file_name("incremental", name, measure), caption, drawn
    caption = f"Fragilities of {name}: fitted curves, and the fractions of the records that were observed."
    yield file_name("fragility", name), caption, fragility_figure(results.fragilities, results.label, scale)


@styled
def ida_figure(
    stripes: Sequence[Stripes],
    intensity: str,
    intensity_scale: float,
    measure: str,
    measure_scale: float,
    limits: Mapping[str, float],
) -> Figure:
    """Draw the intensity against a response measure for every record, with the 16, 50 and 84 % curves.

    A panel for each variant. The curve of a record that collapses ends level, with a cross at the right edge.

    Args:
        stripes: of one measure and study, one for each variant.
        intensity: label of the intensity measure, with its unit.
        intensity_scale: that unit in SI.
        measure: label of the response measure, with its unit.
        measure_scale: that unit in SI.
        limits: values of the measure in SI by name, drawn across.
    """
    figure, (axes,) = new_figure(1, len(stripes), 0.5 + 3.0 * len(stripes), 3.2)
    right = 1.05 * max(_largest(one) for one in stripes) / measure_scale
    top = 1.05 * max(float(one.intensity[-1]) for one in stripes) / intensity_scale
    grid = np.linspace(0.0, right * measure_scale, POINTS)
    for here, one in zip(axes, stripes, strict=True):
        _record_curves(here, one, right, intensity_scale, measure_scale)
        for fraction, curve in zip(FRACTILES, fractile_curves(one, grid[1:]), strict=True):
            label = f"{100 * fraction:.0f} % of the records"
            x, y = grid / measure_scale, np.concatenate(([0.0], curve)) / intensity_scale
            here.plot(x, y, color=MEAN, linewidth=1.8, dashes=_DASHES[fraction], label=label)
        for name, value in limits.items():
            here.axvline(value / measure_scale, color=TARGET, linewidth=0.8, linestyle=":")
            here.annotate(
                name, (value / measure_scale, top), (2, -2), textcoords="offset points", va="top", color=TARGET
            )
        count = int(np.sum(np.isfinite(capacities(one, COLLAPSE))))
        here.set_title(f"{one.variant}: {count} of {len(one.records)} records collapse", loc="left")
        here.set_xlim(0.0, right)
        here.set_ylim(0.0, top)
    label_outer(axes, len(axes), measure, intensity)
    handles, labels = axes[0].get_legend_handles_labels()
    legend_below(figure, handles, labels, 4)
    return figure


@styled
def fragility_figure(fragilities: Sequence[LimitFragility], intensity: str, intensity_scale: float) -> Figure:
    """Draw fragilities as curves, the observed fractions as points: a panel for each limit, a colour for each variant.

    Args:
        fragilities: in any order; of those without a fit the points are drawn.
        intensity: label of the intensity measure, with its unit.
        intensity_scale: that unit in SI.
    """
    limits = list(dict.fromkeys(one.limit for one in fragilities))
    variants = list(dict.fromkeys(one.variant for one in fragilities))
    figure, (axes,) = new_figure(1, len(limits), 0.5 + 2.3 * len(limits), 2.7)
    right = 1.05 * max(float(one.intensity[-1]) for one in fragilities)
    grid = np.linspace(0.0, right, POINTS)
    for here, limit in zip(axes, limits, strict=True):
        for one in fragilities:
            if one.limit != limit:
                continue
            number = variants.index(one.variant)
            colour, there = VARIANTS[number % len(VARIANTS)], one.analyses > 0
            x, y = one.intensity[there] / intensity_scale, one.passed[there] / one.analyses[there]
            here.plot(
                x, y, "os^Dv"[number % 5], color=colour, markersize=3.5, clip_on=False, label=f"{one.variant}, observed"
            )
            if one.fit is not None:
                here.plot(
                    grid / intensity_scale, one.fit.probability(grid), color=colour, label=f"{one.variant}, fitted"
                )
        here.set_title(limit, loc="left")
        here.set_xlim(0.0, right / intensity_scale)
        here.set_ylim(0.0, 1.0)
    label_outer(axes, len(axes), intensity, "probability")
    named = {label: handle for here in axes for handle, label in zip(*here.get_legend_handles_labels(), strict=True)}
    legend_below(figure, list(named.values()), list(named), 4)
    return figure


def _largest(stripes: Stripes) -> float:
    finite = stripes.values[np.isfinite(stripes.values)]
    return float(finite.max()) if finite.size else 1.0


def _record_curves(here: Axes, stripes: Stripes, right: float, intensity_scale: float, measure_scale: float) -> None:
    collapse = capacities(stripes, COLLAPSE)
    label: str | None = "each record"
    for values, level in zip(stripes.values, collapse, strict=True):
        stands = np.isfinite(values) & (stripes.intensity < level)
        x = np.concatenate(([0.0], values[stands])) / measure_scale
        y = np.concatenate(([0.0], stripes.intensity[stands])) / intensity_scale
        if np.isfinite(level):
            x, y = np.append(x, (x[-1], right)), np.append(y, 2 * (level / intensity_scale,))
            here.plot(right, level / intensity_scale, "x", color=TARGET, markersize=4.0, clip_on=False, zorder=3)
        here.plot(x, y, color=RECORDS, linewidth=0.6, label=label)
        label = None
