"""Figures of the seismic action on a building: spectra with its modes, mode shapes, and the storeys over the height."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.codes.ec8.verification.second_order import AMPLIFIED, LARGEST, NEGLIGIBLE
from edesign.report.building.code_in_use import rules_in_use
from edesign.report.building.figures.elevations import strokes
from edesign.report.building.results import BuildingResults
from edesign.report.drawing.captions import plain
from edesign.report.drawing.panels import LINE
from edesign.report.drawing.style import BEFORE, TARGET, VARIANTS, legend_below, new_figure, styled
from edesign.space.structure.frame import AXES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MANY = 200
"""Members, from which only the outermost frames are drawn."""
_COLOURS = dict(zip(AXES, (VARIANTS[0], VARIANTS[1]), strict=True))
_SMALL = 0.05  # modal mass ratio up to which a mode is not marked; EN 1998-1, 4.3.3.3.1(3)
_CLOSE = 0.12  # s between modes whose numbers would meet
_TILT = 0.45  # of y in an oblique drawing
_SWING = 0.12  # largest displacement of a mode, of the largest extent of the building


def spectra(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the elastic and the design spectra with the modes of the building."""
    caption = (
        "Elastic spectrum and design spectra. Marks are the modes with more than 5 % of the mass in a direction, with "
        "their numbers."
    )
    yield "building_spectra", caption, _spectra(BuildingResults(archive))


def mode_shapes(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the shapes of the first modes and of those with the most mass in each direction."""
    results = BuildingResults(archive)
    caption = "Mode shapes: the first modes, and those with the most mass along x, along y and in rotation."
    yield "building_modes", caption, _mode_shapes(results)


def storey_curves(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield shear, drift and theta of the storeys over the height, with their limits."""
    caption = (
        "Storey shear, reduced interstorey drift and interstorey drift sensitivity under the seismic action along x "
        "and along y; dashed: limits."
    )
    yield "building_storeys", caption, _storey_curves(BuildingResults(archive))


@styled
def _spectra(results: BuildingResults) -> Figure:
    figure, [[axes]] = new_figure(1, 1, 6.0, 3.2)
    period = results.values("spectrum", "period")
    axes.plot(period, results.values("spectrum", "elastic"), color=BEFORE, label="elastic, Sₑ")
    T = results.values("modes", "period")
    numbered: set[int] = set()
    for axis in AXES:
        S_d = results.values("spectrum", f"design_{axis}")
        label = f"design along {axis}, q = {results.number(f'q_{axis}'):g}"
        axes.plot(period, S_d, color=_COLOURS[axis], label=label)
        large = np.flatnonzero(results.values("modes", f"effective_mass_ratio_{axis}") > _SMALL)
        value = results.values("modes", f"design_acceleration_{axis}")
        axes.plot(T[large], value[large], "o", color=_COLOURS[axis], markersize=4.0)
        _number(axes, [(int(k), float(T[k]), float(value[k])) for k in large if k not in numbered], axis == AXES[-1])
        numbered |= set(large.tolist())
    axes.set_xlim(0.0, float(period[-1]))
    axes.set_ylim(0.0, None)
    axes.set_xlabel("period T [s]")
    axes.set_ylabel("acceleration [m/s²]")
    axes.legend(loc="upper right")
    return figure


def _number(axes: Axes, modes: list[tuple[int, float, float]], above: bool) -> None:
    """The numbers of modes at (period, acceleration), above the marks in one direction and below them in the other."""
    beside, last = 0.0, np.inf
    for k, T, S_d in modes:  # from long periods to short ones
        beside = beside + 7.0 if last - T < _CLOSE else 0.0
        last = T
        shift = (0.0, (5.0 + beside) * (1.0 if above else -1.0))
        align = "bottom" if above else "top"
        axes.annotate(str(k + 1), (T, S_d), shift, textcoords="offset points", fontsize=6.5, ha="center", va=align)


@styled
def _mode_shapes(results: BuildingResults) -> Figure:
    drawn = results.values("nodes", "mode_shape").shape[0]
    ratios = [results.values("modes", f"effective_mass_ratio_{name}")[:drawn] for name in ("x", "y", "rz")]
    modes = sorted({*range(min(3, drawn)), *(int(ratio.argmax()) for ratio in ratios)})[:6]
    lines = _lines(results)
    place = results.values("nodes", "position")
    size = float(np.ptp(place, axis=0).max())
    reach = np.ptp(_oblique(place), axis=0) + _SWING * size * np.array([1.0 + _TILT, 0.6 * _TILT])
    ratio = float(min(reach[1] / reach[0], 1.6))
    across = min(3 if ratio > 1.25 else 2, len(modes))  # slender ones stand closer
    down = -(-len(modes) // across)
    figure, rows = new_figure(down, across, LINE, down * (0.4 + LINE / across * ratio))
    cells = [cell for row in rows for cell in row]
    for cell in cells[len(modes) :]:
        cell.set_visible(False)
    for k, axes in zip(modes, cells, strict=False):
        shape = results.values("nodes", "mode_shape")[k].astype(float)
        moved = place + _SWING * size * shape / max(float(np.abs(shape).max()), 1e-12)
        for where, colour, width in ((place, "#cfd4db", 0.5), (moved, VARIANTS[1], 0.7)):
            starts, ends = np.moveaxis(_oblique(where)[lines], 1, 0)
            strokes(axes, starts, ends, colour, width)
        axes.set_aspect("equal")
        axes.set_axis_off()
        shares = (100.0 * float(ratio[k]) for ratio in ratios)
        mass = ", ".join(f"{name} {share:.0f} %" for name, share in zip(("x", "y", "rz"), shares, strict=True))
        axes.set_title(
            f"mode {k + 1}: {plain(float(results.values('modes', 'period')[k]))} s\nmass {mass}", fontsize=8.0
        )
    return figure


def _lines(results: BuildingResults) -> np.ndarray:
    """Numbers of the nodes of the members that are drawn, (n, 2)."""
    nodes = {str(name): number for number, name in enumerate(results.values("nodes", "node"))}
    ends = [[nodes[str(of)] for of in results.values("members", name)] for name in ("start_node", "end_node")]
    pairs = np.array(ends).T
    if len(pairs) <= MANY:
        return pairs
    place = results.values("nodes", "position")[:, :2]
    levels = results.values("nodes", "position")[:, 2].round(6)
    edges = []
    for extreme in (np.minimum, np.maximum):
        limit = np.zeros_like(place)
        for level in np.unique(levels):
            limit[levels == level] = extreme.reduce(place[levels == level])
        edges.append(np.isclose(place, limit))
    at_edge = np.stack(edges)  # (side, node, direction), each at its level
    return np.asarray(pairs[np.any(at_edge[:, pairs].all(axis=2), axis=(0, 2))])


def _oblique(place: np.ndarray) -> np.ndarray:
    """Places of a drawing in which y goes to the right and upwards, (n, 2)."""
    return np.column_stack([place[:, 0] + _TILT * place[:, 1], place[:, 2] + 0.6 * _TILT * place[:, 1]])


@styled
def _storey_curves(results: BuildingResults) -> Figure:
    figure, [row] = new_figure(1, 3, 6.4, 3.4)
    height = results.values("storeys_x", "height")
    levels = np.concatenate([[0.0], np.cumsum(height)])
    panels = (
        ("shear", 1e3, "storey shear [kN]", ()),
        ("reduced", 1.0, "q dᵣ / h" if rules_in_use(results).clauses else "ν dᵣ / h", _drift_limit(results)),
        ("theta", 1.0, "θ", (NEGLIGIBLE, AMPLIFIED, LARGEST)),
    )
    for number, (axes, (name, unit, label, limits)) in enumerate(zip(row, panels, strict=True)):
        top = 0.0
        for axis in AXES:
            values = results.values(f"storeys_{axis}", name) / unit
            top = max(top, float(values.max()))
            axes.stairs(
                values, levels, orientation="horizontal", baseline=None, color=_COLOURS[axis], linewidth=1.2,
                label=f"along {axis}",
            )  # fmt: skip
        for limit in limits:
            if limit <= 1.6 * top or limit == limits[0]:
                axes.axvline(limit, color=TARGET, linewidth=0.8, linestyle=(0, (4, 2)))
        axes.set_xlim(0.0, None)
        axes.set_ylim(0.0, float(levels[-1]))
        axes.locator_params(axis="x", nbins=4)
        axes.set_xlabel(label)
        if number:
            axes.tick_params(labelleft=False)
        else:
            axes.set_ylabel("level [m]")
    legend_below(figure, *row[0].get_legend_handles_labels(), 2)
    return figure


def _drift_limit(results: BuildingResults) -> tuple[float, ...]:
    limit = results.group("storeys_x").attributes.get("limit")
    return () if limit is None else (float(str(limit)),)
