"""What a substructure test did: loops of the specimen, response of the structure, energy of the interface error."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import EdesignError
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import MEAN, align_ordinates, legend_label, new_figure, styled
from edesign.report.substructure.curves import WIDTH, around_zero, curve, largest, legend_of_lines, window, within
from edesign.report.substructure.results import Series, SubstructureResults, times
from edesign.substructure.sized_damper import SizedDamper

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HIGH = 1.1  # inches of a row
PANEL = (3.1, 2.6)  # inches of loops
MOST_STEPS = 20_000
"""Of the law under a target: cubics between fewer samples are as good, and a law may need an equation solver."""
MANY = 60  # reversals, of more the loops of a window are drawn


@dataclass(frozen=True)
class Loop:
    """Deformation (m) and force (N) over time (s)."""

    time: np.ndarray
    deformation: np.ndarray
    force: np.ndarray


def loop_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test the loops of the specimen beside the law.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        found = [(one, loop) for one in results.shown(test) if (loop := _loop(one)) is not None]
        if not found:
            continue
        wanted, what = _wanted(results, test)
        seen = in_window(found[-1][1])
        shown = f" Shown are the cycles from {plain(seen[0])} to {plain(seen[1])} s." if seen is not None else ""
        forces = [f"{one.label} {plain(1e-3 * largest([loop.force]))} kN" for one, loop in found]
        dashed = f" The dashed line is {what}." if wanted is not None else ""
        caption = (
            f"Force over deformation of the specimen, and below over time, {test}. Largest: {'; '.join(forces)}."
            f"{dashed}{shown}"
        )
        yield file_name("specimen", test), caption, loop_figure(found, wanted, what, seen)


def _is_bare(series: Series) -> bool:
    """Whether the rig moved without a specimen: what the load cell read is noise."""
    force = series.of("true_force")
    return force is not None and not np.any(force)


def _loop(series: Series) -> Loop | None:
    for deformation, force in (("deformation", "true_force"), ("measured", "force")):
        x, y = series.of(deformation), series.of(force)
        if x is not None and y is not None and not _is_bare(series):
            return Loop(series.time, x, y)
    return None


def _wanted(results: SubstructureResults, test: str) -> tuple[Loop | None, str]:
    """The specimen as it should have moved: under the direct analysis, or by its law under a given target."""
    driven = results.driven(test)
    if {"direct_deformation", "direct_force"} <= set(driven.variables):
        values = (np.asarray(driven.variables[name].values) for name in ("direct_deformation", "direct_force"))
        return Loop(times(driven), *values), "the direct analysis"
    lab, shown = results.described.laboratory, results.shown(test)
    target = shown[-1].of("target") if shown else None
    if lab is None or lab.damper is None or target is None or target.size < 2:
        return None, ""
    every = -(-target.size // MOST_STEPS)
    time, target = shown[-1].time[::every], target[::every]
    try:
        found = SizedDamper(lab.damper.values, lab.damper.scales).force(time, target, np.gradient(target, time))
    except (EdesignError, ValueError):
        return None, ""
    return Loop(time, target, found), "the law under the target"


def in_window(loop: Loop) -> tuple[float, float] | None:
    """Return a window around the largest force of a history of many cycles; None to show all of it."""
    reversals = np.count_nonzero(np.diff(np.signbit(np.diff(loop.deformation[::10]))))
    return window(loop.time, loop.deformation, loop.force) if reversals > MANY else None


@styled
def loop_figure(
    found: Sequence[tuple[Series, Loop]], wanted: Loop | None, what: str, seen: tuple[float, float] | None
) -> Figure:
    """Draw loops as Figs. 6.23 and 6.27 of the thesis, a panel for each run, and below the forces over time.

    Args:
        wanted: how the specimen should have moved, drawn in each panel; None: not known.
        what: this is, in words.
        seen: a window in s; None: all of the history.
    """
    wide_figure = 0.5 + PANEL[0] * max(len(found), 2)
    figure, axes = new_figure(2, len(found), wide_figure, PANEL[1] + HIGH + 1.0)
    loops = [_part(loop, seen) for _, loop in found]
    aim = _part(wanted, seen) if wanted is not None else None
    both = [*loops, aim] if aim is not None else loops
    wide, tall = 1e3 * largest([one.deformation for one in both]), 1e-3 * largest([one.force for one in both])
    spans = (2.0 * wide or 1.0, 2.0 * tall or 1.0)
    grid = axes[1][0].get_gridspec()
    assert grid is not None
    grid.set_height_ratios([PANEL[1], HIGH])
    for axis in axes[1]:
        axis.remove()
    history = figure.add_subplot(grid[1, :], axes_class=type(axes[0][0]))
    for axis, (one, _), loop in zip(axes[0], found, loops, strict=True):
        curve(axis, 1e3 * loop.deformation, 1e-3 * loop.force, PANEL, spans, color=one.color, lw=1.5)
        curve(history, loop.time, 1e-3 * loop.force, (wide_figure - 0.7, HIGH), color=one.color, lw=1.2)
        if aim is not None:
            curve(axis, 1e3 * aim.deformation, 1e-3 * aim.force, PANEL, spans, color=MEAN, lw=0.6, ls="--")
        axis.set_title(legend_label(one.label))
        around_zero(axis, tall)
        axis.axvline(0.0, color=MEAN, lw=0.4, zorder=0.9)
        axis.set_xlim(-1.08 * wide or -1.0, 1.08 * wide or 1.0)
        axis.set_xlabel("deformation (mm)")
    if aim is not None:
        curve(history, aim.time, 1e-3 * aim.force, (wide_figure - 0.7, HIGH), color=MEAN, lw=0.6, ls="--")
    around_zero(history, tall)
    history.set_xlim(*(seen or (0.0, max(float(loop.time[-1]) for loop in loops) or 1.0)))
    history.set_xlabel("time (s)")
    for axis in (axes[0][0], history):
        axis.set_ylabel("force (kN)")
    lines = [(one.label, one.color, "-") for one, _ in found]
    legend_of_lines(figure, [*([(what, MEAN, "--")] if aim is not None else []), *lines])
    return figure


def _part(loop: Loop, seen: tuple[float, float] | None) -> Loop:
    if seen is None:
        return loop
    part = within(loop.time, seen)
    return Loop(loop.time[part], loop.deformation[part], loop.force[part])


@dataclass(frozen=True)
class Response:
    """A history of the structure by name, mm: direct (time, values), and each run (series, values)."""

    title: str
    time: np.ndarray
    direct: np.ndarray
    found: list[tuple[Series, np.ndarray]]


def response_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test with a structure its response beside the direct analysis.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        rows = _responses(results, test)
        if rows:
            caption = (
                f"Response of the structure, {test}, beside the direct analysis without a test. "
                f"The lowest panel is the shaded window with the largest error. {_peaks(rows)}"
            )
            yield file_name("structure", test), caption, response_figure(rows)


def _responses(results: SubstructureResults, test: str) -> list[Response]:
    driven, shown = results.driven(test), results.shown(test)
    damper = [(one, one.of("deformation")) for one in shown]
    roof = [(one, _roof(results.building(test, one.compensator))) for one in shown]
    direct = driven.variables.get("direct_deformation")
    rows: list[Response] = []
    for title, found, values in (
        ("damper", damper, None if direct is None else np.asarray(direct.values)),
        ("top floor", roof, _roof(results.building(test))),
    ):
        there = [(one, 1e3 * own) for one, own in found if own is not None and own.size]
        if there and values is not None and values.size and not _known(rows, 1e3 * values):
            rows.append(Response(title, times(driven), 1e3 * values, there))
    return rows


def _roof(building: Group | None) -> np.ndarray | None:
    """Displacement of the top floor over time, m; None: it was not kept."""
    kept = building.variables.get("floor_displacement") if building is not None else None
    return None if kept is None else np.asarray(kept.values)[:, -1]


def _known(rows: Sequence[Response], values: np.ndarray) -> bool:
    """Whether a history (mm) is shown already: the only floor moves as its damper."""
    return any(largest([row.direct - values]) < 0.01 * largest([values]) for row in rows)


@styled
def response_figure(rows: Sequence[Response]) -> Figure:
    """Draw the response of the structure in tests beside the direct analysis, and a window of the first row.

    Args:
        rows: at least one.
    """
    figure, axes = new_figure(len(rows) + 1, 1, WIDTH, 0.9 + 1.25 * (len(rows) + 1))
    first = rows[0]
    one, values = first.found[0]
    count = min(values.size, first.direct.size)
    seen = window(first.time[:count], first.direct[:count], values[:count] - first.direct[:count])
    for (axis,), row in zip(axes, (*rows, first), strict=True):
        zoomed = axis is axes[-1][0]
        limits = seen if zoomed else (0.0, float(row.time[-1]) or 1.0)
        size = (WIDTH - 0.7, HIGH)
        for series, values in row.found:
            part = within(series.time, limits)
            curve(axis, series.time[part], values[part], size, color=series.color, lw=0.9 if zoomed else 0.7)
        part = within(row.time, limits)
        curve(
            axis,
            row.time[part],
            row.direct[part],
            size,
            color=MEAN,
            lw=0.8 if zoomed else 0.5,
            ls="--" if zoomed else "-",
        )
        around_zero(axis, largest([row.direct[part], *(v[within(s.time, limits)] for s, v in row.found)]))
        axis.set_xlim(*limits)
        axis.set_ylabel(f"{row.title}\n(mm)")
        if not zoomed:
            axis.axvspan(*seen, color="#d5dbe4", zorder=0.5, lw=0)
    axes[-1][0].set_xlabel("time (s)")
    align_ordinates(row[0] for row in axes)
    legend_of_lines(figure, [("direct analysis", MEAN, "--"), *((s.label, s.color, "-") for s, _ in first.found)])
    return figure


def _peaks(rows: Sequence[Response]) -> str:
    texts = []
    for row in rows:
        runs = [f"{series.label} {plain(largest([values]))}" for series, values in row.found]
        texts.append(f"{row.title}: direct {plain(largest([row.direct]))}, {', '.join(runs)} mm")
    return f"Largest values: {'; '.join(texts)}."


def energy_error_figures(results: SubstructureResults) -> Iterator[tuple[str, str, Figure]]:
    """Yield for each test the work that the error feeds into the structure.

    Yields:
        Name of the file, caption and figure.
    """
    for test in results.tests:
        found = [one for one in results.shown(test) if np.any(energy_error(one)) and not _is_bare(one)]
        if found:
            closed = results.is_closed(test)
            fed = "the test feeds energy into the structure, as negative damping would"
            fed = fed if closed else "a structure would be fed with energy, as by negative damping"
            ends = [f"{one.label} {plain(float(energy_error(one)[-1]))} J" for one in found]
            caption = (
                f"Work of the specimen's force along the tracking error, {test}. Where it rises, {fed}. "
                f"At the end: {'; '.join(ends)}."
            )
            yield file_name("interface_energy", test), caption, energy_figure(found)


def energy_error(series: Series) -> np.ndarray:
    """Return the work of the interface error of a run over time, (n,) J; a single zero where it was not kept."""
    values = series.of("interface_energy_error")
    return values if values is not None else np.zeros(1)


@styled
def energy_figure(found: Sequence[Series]) -> Figure:
    """Draw the work of the interface error over time."""
    figure, ((axis,),) = new_figure(1, 1, WIDTH, 2.2)
    spans = (
        max(float(one.time[-1]) for one in found) or 1.0,
        max(float(np.ptp(energy_error(one))) for one in found) or 1.0,
    )
    for one in found:
        curve(axis, one.time, energy_error(one), (WIDTH - 0.7, 1.4), spans, color=one.color, lw=1.0)
    axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
    axis.set_xlim(0.0, spans[0])
    axis.set_xlabel("time (s)")
    axis.set_ylabel("interface energy\nerror (J)")
    legend_of_lines(figure, [(one.label, one.color, "-") for one in found])
    return figure
