"""Errors, loops and residuals of single tests before and after a calibration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.series import Residual
from edesign.report.calibration.error_tables import STAGES, noise_of
from edesign.report.calibration.units import percent
from edesign.report.calibration.view import (
    COLOURS,
    MEASURED,
    NOISE,
    View,
    curve,
    outline,
    residual,
    series_label,
)
from edesign.report.drawing.style import grid_figure, legend_below, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MARKS = {"declared": ("o", 7.0), "refit": ("^", 6.0), "corrected": ("D", 4.0)}
_NARROWEST = 12.0  # ends of the axis of errors: a decade is seen as one
_POINTS = 64  # of a mean cycle
_LEAST = 1e-6  # %: what stands for an error of zero on a logarithmic axis


def error_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Error of each test at each stage with its noise floor."""
    series = view.calibration.series
    errors = view.calibration.errors
    worst = max(series, key=errors["corrected"].of)
    each = "channel" if worst.channel else "test"
    caption = (
        f"Error of each {each} before and after. The closer the blue marks are to the black lines (noise), the less is "
        f"left to explain; the largest error after is {percent(errors['corrected'].of(worst))} % in {worst.name}, "
        f"where it was {percent(errors['declared'].of(worst))} % as declared. Validation tests are in bold; no "
        "model is fitted to them."
    )
    yield "errors", caption, _errors_figure(view)


@styled
def _errors_figure(view: View) -> Figure:
    from matplotlib.ticker import FuncFormatter, NullFormatter

    series = view.calibration.series
    figure, ((axis,),) = new_figure(1, 1, 6.6, 1.1 + 0.24 * len(series))
    place = np.arange(len(series))
    for stage, label in STAGES.items():
        values = [100.0 * view.calibration.errors[stage].of(one) for one in series]
        fill = COLOURS[stage] if stage == "corrected" else "none"
        shown = np.maximum(values, _LEAST)
        mark, size = _MARKS[stage]
        axis.plot(shown, place, mark, ms=size, mfc=fill, mec=COLOURS[stage], mew=1.2, label=label)
    floors = np.maximum([100.0 * noise_of(one) for one in series], _LEAST)
    axis.plot(floors, place, "|", ms=11.0, mew=1.6, color=NOISE, label="noise floor", zorder=1.9)
    every = np.concatenate([np.asarray(line.get_xdata()) for line in axis.get_lines()])
    low, high = 0.6 * float(np.min(every)), 1.6 * float(np.max(every))
    axis.set_xscale("log")
    axis.set_xlim(min(low, high / _NARROWEST), max(high, low * _NARROWEST))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
    axis.set_yticks(place, [_short(series_label(one)) for one in series])
    for text, one in zip(axis.get_yticklabels(), series, strict=True):
        text.set_fontweight("bold" if one.use == "validate" else "normal")
    axis.set_ylim(len(series) - 0.4, -0.6)
    axis.set_xlabel("NRMS (%)")
    legend_below(figure, most=4)
    return figure


def _short(label: str) -> str:
    return label if len(label) <= 44 else f"{label[:42]}…"


def loop_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Loops of the tests that show most, measured and predicted."""
    names = ", ".join(one.name for one in view.most_different)
    caption = (
        f"Force over displacement of {names}, the tests with the largest errors as declared; of each the cycles about "
        "the largest error. What the law lacks shows as the distance between the measured loop (wide, "
        "grey) and the one as declared."
    )
    yield "loops", caption, _loops_figure(view)


@styled
def _loops_figure(view: View) -> Figure:
    tests = view.most_different
    figure, cells = grid_figure(len(tests), 2, 3.6, 2.6)
    for axis, series in zip(cells, tests, strict=True):
        part = view.window(series)
        u = 1e3 * series.displacement[part]
        axis.plot(*curve(u, 1e-3 * series.measured[part]), color=MEASURED, lw=2.4, alpha=0.55, label="measured")
        for stage, label in view.stages.items():
            force = 1e-3 * series.predicted[stage][part]
            axis.plot(*curve(u, force), color=COLOURS[stage], lw=0.9, label=label)
        axis.set_title(_short(series_label(series)), fontsize=8.0, loc="left")
        axis.set_xlabel("displacement (mm)")
        axis.set_ylabel("force (kN)")
    legend_below(figure, *cells[0].get_legend_handles_labels(), 3)
    return figure


def residual_figures(view: View) -> Iterator[tuple[str, str, Figure]]:
    """Residuals of the same tests over time and over displacement."""
    left = [
        f"{one.name}: {' to '.join(_kN(float(np.sqrt(np.mean(residual(one, stage) ** 2)))) for stage in view.stages)}"
        for one in view.most_different
    ]
    way = "before to after" if len(view.stages) > 1 else "as declared"
    caption = (
        "Measured less predicted force over time, and over displacement (mean cycle of steady tests, else the cycles "
        "about the largest error). Where only noise is left the curve after is a band without shape, as wide as noise "
        f"(dotted: two standard deviations). Root mean square, {way}: {'; '.join(left)} kN."
    )
    yield "residuals", caption, _residuals_figure(view)


def _kN(force: float) -> str:
    return f"{1e-3 * force:.3g}"


@styled
def _residuals_figure(view: View) -> Figure:
    tests = view.most_different
    figure, rows = new_figure(len(tests), 2, 8.4, 0.7 + 1.65 * len(tests))
    grid = rows[0][0].get_gridspec()
    assert grid is not None
    grid.set_width_ratios((2.1, 1.0))
    for (history, loop), series in zip(rows, tests, strict=True):
        part = view.window(series)
        for stage, label in view.stages.items():
            left = 1e-3 * residual(series, stage)
            style: Any = {"color": COLOURS[stage], "lw": 0.7}
            history.plot(*outline(series.time, left), label=label, **style)
            cycle = residual_loop(series.residual(stage), view.motions[series.name])
            if cycle is not None:
                closed = np.append(np.arange(cycle.residual.size), 0)
                loop.plot(1e3 * cycle.displacement[closed], 1e-3 * cycle.residual[closed], **style)
            else:
                loop.plot(*curve(1e3 * series.displacement[part], left[part]), **style)
        for side in (-2.0, 2.0):
            history.axhline(side * 1e-3 * series.noise, color=NOISE, lw=0.8, ls=":", zorder=3.0)
        history.set_xlim(float(series.time[0]), float(series.time[-1]))
        history.set_title(_short(series_label(series)), fontsize=8.0, loc="left")
        history.set_ylabel("residual (kN)")
    rows[-1][0].set_xlabel("time (s)")
    rows[-1][1].set_xlabel("displacement (mm)")
    legend_below(figure, *rows[0][0].get_legend_handles_labels(), 3)
    return figure


@dataclass(frozen=True)
class Loop:
    """A cycle averaged at equal phase, which runs from a zero of the displacement.

    Attributes:
        displacement: (p,) m.
        residual: (p,) N.
    """

    displacement: np.ndarray
    residual: np.ndarray


def residual_loop(test: Residual, motion: Cycles) -> Loop | None:
    """Mean cycle of the longest steady part of a test; None if it is not periodic or sampled too coarsely."""
    part = motion.longest()
    if part is None:
        return None
    inside = part.samples(test.time)
    phase = np.mod((test.time[inside] - part.start) / part.period, 1.0)
    points = min(_POINTS, int(phase.size / part.cycles / 2.0))
    number = np.minimum((phase * points).astype(int), points - 1)
    count = np.bincount(number, minlength=points) if points else np.zeros(1)
    if np.min(count) < 1:
        return None

    def mean(values: np.ndarray) -> np.ndarray:
        return np.asarray(np.bincount(number, values[inside], points) / count)

    return Loop(mean(test.displacement), mean(test.residual))
