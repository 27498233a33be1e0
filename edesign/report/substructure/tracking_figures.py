"""How a rig followed its target: both over time with error and delay, and measured displacement over target."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from edesign.errors import EdesignError
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import MEAN, align_ordinates, legend_label, new_figure, styled
from edesign.report.substructure.curves import WIDTH, around_zero, curve, largest, legend_of_lines, window, within
from edesign.report.substructure.results import Series, SubstructureResults
from edesign.substructure.indicators.crossing_delay import CrossingDelay, crossing_delay
from edesign.substructure.methods.rate import motion_frequency

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SYNCHRONISED = 2.9  # inches of a square
HIGH = 1.1  # inches of a row


def tracking_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test target and measured displacement with the error.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        series = _tracked(results, test)
        if series:
            late = [_crossings(results, test, one) for one in series]
            each = ", then what each zero crossing comes late by" if any(late) else ""
            caption = (
                f"Target and measured displacement, {test}. From above the whole target, the shaded window with the "
                f"largest error, and the error{each}. {_numbers(results, test, series)}"
            )
            yield file_name("tracking", test), caption, tracking_figure(series, late)


def synchronisation_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test the measured displacement over the target.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        series = _tracked(results, test)
        if series:
            captions = [results.in_words(test, one.compensator) for one in series]
            runs = [results.run(test, one.compensator) for one in series]
            late = [run.value("crossing_delay_mean") if run is not None else math.nan for run in runs]
            caption = (
                f"Synchronisation, {test}: measured displacement over target. A rig that follows stays on the dashed "
                "line of 45 degrees; a late one goes round it in loops, and a wrong amplitude turns them. The thin "
                "ellipse is that of a sine with the largest target and its mean frequency, late by the mean delay."
            )
            yield file_name("synchronisation", test), caption, synchronisation_figure(series, captions, late)


def _tracked(results: SubstructureResults, test: str) -> list[Series]:
    """The runs that kept target and measured displacement."""
    return [one for one in results.shown(test) if one.of("target") is not None and one.of("measured") is not None]


def _crossings(results: SubstructureResults, test: str, series: Series) -> CrossingDelay | None:
    """Delays of the zero crossings of a run, None if there are none to be shown."""
    run, time = results.run(test, series.compensator), series.time
    expected = run.value("crossing_delay_mean") if run is not None else math.nan
    if math.isnan(expected) or time.size < 2:
        return None
    target, measured = series.of("target"), series.of("measured")
    assert target is not None and measured is not None
    try:
        return crossing_delay(target, measured, float(time[1] - time[0]), expected=expected)
    except EdesignError:
        return None


def _mm(series: Series, name: str) -> np.ndarray:
    values = series.of(name)
    assert values is not None
    return 1e3 * values


def _error(series: Series) -> np.ndarray:
    return _mm(series, "measured") - _mm(series, "target")


@styled
def tracking_figure(series: Sequence[Series], late: Sequence[CrossingDelay | None]) -> Figure:
    """Draw target, measured displacement in some cycles, and error, as Figs. 6.11 and 6.20 of the thesis.

    Args:
        series: at least one; the target is that of the last.
        late: delays of the zero crossings of each, drawn below; None: not known.
    """
    rows = 4 if any(late) else 3
    figure, axes = new_figure(rows, 1, WIDTH, 1.0 + 1.2 * rows)
    whole, some, wrong = (row[0] for row in axes[:3])
    size = (WIDTH - 0.7, HIGH)
    last = series[-1]
    target = _mm(last, "target")
    seen = window(series[0].time, _mm(series[0], "target"), _error(series[0]))
    curve(whole, last.time, target, size, color=MEAN, lw=0.6)
    around_zero(whole, largest([target]))
    whole.axvspan(*seen, color="#d5dbe4", zorder=0.5, lw=0)
    own_targets = []
    for one in series:
        part = within(one.time, seen)
        own = _mm(one, "target")[part]
        if _differ(own, target[part]):  # a structure answers what is measured: each run has its own target
            own_targets.append((f"its target, {one.label}", one.color, ":"))
            curve(some, one.time[part], own, size, color=one.color, lw=0.8, ls=":")
        curve(some, one.time[part], _mm(one, "measured")[part], size, color=one.color, lw=1.0)
        curve(wrong, one.time, _error(one), size, color=one.color, lw=0.6)
    part = within(last.time, seen)
    curve(some, last.time[part], target[part], size, color=MEAN, lw=0.9, ls="--")
    some.set_xlim(*seen)
    around_zero(
        some, largest([_mm(one, name)[within(one.time, seen)] for one in series for name in ("target", "measured")])
    )
    around_zero(wrong, largest([_error(one) for one in series]))
    end = max(float(one.time[-1]) for one in series)
    for axis, label in ((whole, "target (mm)"), (some, "displacement\n(mm)"), (wrong, "error (mm)")):
        axis.set_ylabel(label)
        if axis is not some:
            axis.set_xlim(0.0, end or 1.0)
    if rows > 3:
        _draw_delays(axes[3][0], series, late, end)
    axes[-1][0].set_xlabel("time (s)")
    align_ordinates(row[0] for row in axes)
    lines = [(f"measured, {one.label}", one.color, "-") for one in series]
    legend_of_lines(figure, [(f"target, {last.label}" if own_targets else "target", MEAN, "--"), *lines, *own_targets])
    return figure


def _draw_delays(axis: Axes, series: Sequence[Series], late: Sequence[CrossingDelay | None], end: float) -> None:
    for one, found in zip(series, late, strict=True):
        if found is not None:
            axis.plot(found.instants, 1e3 * found.delays, color=one.color, lw=0.8)
    axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
    axis.set_xlim(0.0, end or 1.0)
    axis.set_ylabel("delay (ms)")


def _differ(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two histories are visibly apart, as far as both go: one may be that of a test which diverged."""
    both = min(one.size, other.size)
    return largest([one[:both] - other[:both]]) > 0.01 * largest([one[:both]])


@styled
def synchronisation_figure(series: Sequence[Series], captions: Sequence[str], late: Sequence[float]) -> Figure:
    """Draw measured displacement over target, a square for each run, as Figs. 6.13, 6.21 and 6.25 of the thesis.

    Args:
        series: at least one.
        captions: delay and error of each in words.
        late: delay of each, s; NaN: not known.
    """
    figure, axes = new_figure(1, len(series), 0.5 + SYNCHRONISED * len(series), SYNCHRONISED + 0.5)
    reach = 1.08 * largest([_mm(one, name) for one in series for name in ("target", "measured")]) or 1.0
    for axis, one, words, delay in zip(axes[0], series, captions, late, strict=True):
        size = (SYNCHRONISED - 0.5, SYNCHRONISED - 0.5)
        spans = (2.0 * reach, 2.0 * reach)
        curve(axis, _mm(one, "target"), _mm(one, "measured"), size, spans, color=one.color, lw=0.4)
        axis.plot([-reach, reach], [-reach, reach], color=MEAN, lw=0.7, ls="--")
        if math.isfinite(delay):
            axis.plot(*_ellipse(one, delay), color=MEAN, lw=0.6)
        _square(axis, reach, one.label, words)
    axes[0][0].set_ylabel("measured (mm)")
    return figure


def _ellipse(series: Series, delay: float) -> tuple[np.ndarray, np.ndarray]:
    """Target and measured displacement, mm, of a sine of the target's size and frequency that comes late, s."""
    target, turn = _mm(series, "target"), np.linspace(0.0, 2.0 * np.pi, 91)
    omega = 2.0 * np.pi * motion_frequency(target, float(series.time[1] - series.time[0]))
    return largest([target]) * np.cos(turn), largest([target]) * np.cos(turn - omega * delay)


def _square(axis: Axes, reach: float, label: str, words: str) -> None:
    axis.set_xlim(-reach, reach)
    axis.set_ylim(-reach, reach)
    axis.set_aspect("equal")
    axis.set_title(legend_label(label))
    axis.set_xlabel("target (mm)")
    box = {"boxstyle": "square,pad=0.15", "fc": "white", "ec": "none"}
    axis.annotate(
        words.replace(", ", "\n"),
        (1.0, 0.0),
        (-3.0, 4.0),
        "axes fraction",
        textcoords="offset points",
        ha="right",
        bbox=box,
    )


def _numbers(results: SubstructureResults, test: str, series: Sequence[Series]) -> str:
    """Largest error and delay of each run in words."""
    texts = []
    for one in series:
        words = results.in_words(test, one.compensator)
        size = f"largest error {plain(largest([_error(one)]))} mm"
        texts.append(f"{one.label}: {', '.join(filter(None, (size, words)))}")
    return f"{'; '.join(texts)}."
