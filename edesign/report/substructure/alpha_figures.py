"""Adaptive coefficients of compensators over time, with the limits that the file sets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.project.substructure.compensators import (
    AtsCompensator,
    LiveDelayCompensator,
    ModifiedAtsCompensator,
)
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import TARGET, VARIANTS, align_ordinates, new_figure, styled
from edesign.report.substructure.curves import WIDTH, curve, legend_of_lines
from edesign.report.substructure.results import BEST, Series, SubstructureResults

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

OTHERS = tuple(color for color in VARIANTS if color != BEST)
SIZE = (WIDTH - 0.7, 1.1)  # inches of a row


@dataclass(frozen=True)
class Coefficient:
    """A coefficient: its variable, how it is called, its unit in the figure, and how many of these are 1 in SI."""

    variable: str
    title: str
    unit: str
    factor: float


SERIES = (
    Coefficient("alpha_0", "α₀", "–", 1.0),
    Coefficient("alpha_1", "α₁", "ms", 1e3),
    Coefficient("alpha_2", "α₂", "10⁻⁶ s²", 1e6),
)
DELAY = (Coefficient("alpha_0", "delay", "ms", 1e3),)
"""Of a live delay."""


@dataclass(frozen=True)
class Adaptive:
    """A run of an adaptive compensator with the limits (least, largest) of its coefficients, () if not known."""

    series: Series
    limits: tuple[tuple[float, float], ...]


def alpha_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test the coefficients of all its adaptive compensators.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        for name, what, rows, chosen in (
            ("alpha", "Adaptive coefficients", SERIES, _adaptive(results, test, live=False)),
            ("live_delay", "Delay that the compensator found", DELAY, _adaptive(results, test, live=True)),
        ):
            if chosen:
                caption = f"{what} over time, {test}. {_limits_in_words(rows, chosen)}{_met(rows, chosen)}"
                yield file_name(name, test), caption, alpha_figure(chosen, rows)


def _adaptive(results: SubstructureResults, test: str, live: bool) -> list[Adaptive]:
    """The runs whose coefficients were kept; the best last, so that it lies upon the others, which are wider."""
    best = results.best(test)
    names = sorted(results.compensators(test), key=lambda name: name == best)
    file = results.described.file
    found: list[Adaptive] = []
    for name in names:
        described = file.compensators.get(name) if file is not None else None
        if isinstance(described, LiveDelayCompensator) is not live:
            continue
        color = BEST if name == best else OTHERS[len(found) % len(OTHERS)]
        series = results.series(test, name, color)
        if series is not None and series.of("alpha_0") is not None:
            found.append(Adaptive(series, _limits(described)))
    return found


def _limits(described: object) -> tuple[tuple[float, float], ...]:
    if isinstance(described, (AtsCompensator, ModifiedAtsCompensator)):
        return (described.limits.a0, described.limits.a1, described.limits.a2)
    return (described.limits,) if isinstance(described, LiveDelayCompensator) else ()


@styled
def alpha_figure(chosen: Sequence[Adaptive], rows: Sequence[Coefficient]) -> Figure:
    """Draw coefficients over time as Figs. 6.14, 6.22 and 6.26 of the thesis; limits are drawn where they are near.

    Args:
        chosen: at least one.
    """
    figure, axes = new_figure(len(rows), 1, WIDTH, 0.8 + 1.25 * len(rows))
    drawn = False
    for i, ((axis,), row) in enumerate(zip(axes, rows, strict=True)):
        for one in chosen:
            values = one.series.of(row.variable)
            if values is not None:
                thick = 0.7 if one is chosen[-1] else 2.0
                curve(axis, one.series.time, row.factor * values, SIZE, color=one.series.color, lw=thick)
        drawn |= _near_limits(
            axis, [row.factor * limit for one in chosen for pair in one.limits[i : i + 1] for limit in pair]
        )
        axis.set_xlim(0.0, max(float(one.series.time[-1]) for one in chosen) or 1.0)
        axis.set_ylabel(f"{row.title} ({row.unit})" if row.unit != "–" else row.title)
        axis.tick_params(labelbottom=i == len(rows) - 1)
        axis.ticklabel_format(axis="y", useOffset=False)
    axes[-1][0].set_xlabel("time (s)")
    align_ordinates(row[0] for row in axes)
    marked = [("limit", TARGET, "--")] if drawn else []
    legend_of_lines(figure, [*((one.series.label, one.series.color, "-") for one in chosen), *marked])
    return figure


def _near_limits(axis: Axes, limits: Sequence[float]) -> bool:
    """Draw the limits that lie within the height of the curves, or half of it away; say whether there are any."""
    low, high = axis.get_ylim()
    reach = 0.5 * (high - low)
    near = {limit for limit in limits if low - reach <= limit <= high + reach}
    for limit in near:
        axis.axhline(limit, color=TARGET, lw=0.8, ls="--")
    return bool(near)


def _limits_in_words(rows: Sequence[Coefficient], chosen: Sequence[Adaptive]) -> str:
    known = next((one.limits for one in reversed(chosen) if one.limits), ())
    if not known:
        return ""
    texts = [
        f"{row.title} {plain(row.factor * low)} to {plain(row.factor * high)}{f' {row.unit}' * (row.unit != '–')}"
        for row, (low, high) in zip(rows, known, strict=False)
    ]
    return f"Limits of {chosen[-1].series.label}: {', '.join(texts)}; drawn where they are near. "


def _met(rows: Sequence[Coefficient], chosen: Sequence[Adaptive]) -> str:
    """For how much of its time the last run was at a limit or a largest rate."""
    limited = chosen[-1].series.of("limited")
    if limited is None or not limited.size:
        return ""
    share = 100.0 * float(np.mean(limited != 0))
    return f"It was at a limit or a largest rate for {plain(share)} % of the time." if share else "It met no limit."
