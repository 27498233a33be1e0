"""Plans of a building: grid, columns as they stand, beams with their ends, bracing."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.report.building.elevations import INK, hinges, strokes
from edesign.report.building.results import BuildingResults, BuildingValues
from edesign.report.drawing.style import AFTER, TARGET, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PANELS = 3
"""Plans that are drawn; of more those of other outlines come first."""
_BEAM = "#7c8796"
_COLUMN = 0.11  # size of a column in the drawing, by the narrowest bay
_BRACE = 0.05  # how far a brace is drawn beside its beam, by the narrowest bay
_SIZE, _MARGIN = 6.0, 0.62  # inches
_LABEL = 0.45  # inches of the narrowest bay, from which sections are named in the drawing
_NODE = re.compile(r"([A-Z]+)([0-9]+)\.[0-9]+")


def plans(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the plans of the storeys that differ.

    Yields:
        Name of the file, caption and figure.
    """
    return plans_of(BuildingResults(archive))


def plans_of(results: BuildingValues) -> Iterator[tuple[str, str, Figure]]:
    """Yield the plans of the storeys of a building that differ.

    Yields:
        Name of the file, caption and figure.
    """
    different = _different_storeys(results)
    drawn = _other_outlines_first(results, different)[:PANELS]
    left_out = f" {len(different) - len(drawn)} more plans are not drawn." if len(different) > len(drawn) else ""
    for storeys in sorted(drawn):
        which = f"storey {storeys[0]}" if len(storeys) == 1 else f"storeys {_runs(storeys)}"
        sections = _sections(results, storeys[0])
        caption = (
            f"Plan of {which}, widths in m. Columns with the direction of their webs, the beams above them, circles at "
            f"pinned ends, dashes beside braced bays, a cross at the centre of mass. Sections: {sections}.{left_out}"
        )
        yield f"plan_{storeys[0]}", caption, _plan(results, storeys[0])


def _different_storeys(results: BuildingValues) -> list[list[int]]:
    """Storeys with equal members in equal places, from below."""
    names = ("kind", "section", "start", "end", "web", "ends", "storey")
    columns = [results.values("members", name) for name in names]
    found: dict[frozenset[tuple[object, ...]], list[int]] = {}
    for storey in np.unique(columns[-1]).tolist():
        chosen = columns[-1] == storey
        kind, section, start, end, web, ends = (column[chosen] for column in columns[:-1])
        turned = (kind == "brace") & (start[:, 0] + start[:, 1] > end[:, 0] + end[:, 1])  # in plan both ways are alike
        start, end = (np.where(turned[:, None], b, a) for a, b in ((start, end), (end, start)))
        web = np.where((kind == "column")[:, None], web, 0.0)
        rows = np.concatenate([start[:, :2], end[:, :2], web, ends > 0.0], axis=1).round(6)
        members = frozenset(zip(kind.tolist(), section.tolist(), map(tuple, rows.tolist()), strict=True))
        found.setdefault(members, []).append(int(storey))
    return list(found.values())


def _other_outlines_first(results: BuildingValues, different: list[list[int]]) -> list[list[int]]:
    """Groups of storeys in the order in which they are drawn: one of each set of places of columns, then the others."""
    storey, kind, start = (results.values("members", name) for name in ("storey", "kind", "start"))
    first: list[list[int]] = []
    others: list[list[int]] = []
    seen: set[frozenset[tuple[float, ...]]] = set()
    for group in different:
        at = start[(storey == group[0]) & (kind == "column"), :2].round(6)
        outline = frozenset(map(tuple, at.tolist()))
        (others if outline in seen else first).append(group)
        seen.add(outline)
    return first + others


def _runs(numbers: list[int]) -> str:
    """1-4, 6 of numbers in rising order."""
    runs = [[n for _, n in run] for _, run in groupby(enumerate(numbers), key=lambda pair: pair[1] - pair[0])]
    return ", ".join(str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)


def _grid(results: BuildingValues) -> tuple[dict[str, float], dict[str, float]]:
    """Names of the lines across x and across y with their places, m."""
    across_x: dict[str, float] = {}
    across_y: dict[str, float] = {}
    for name, place in zip(results.values("nodes", "node"), results.values("nodes", "position"), strict=True):
        if (found := _NODE.fullmatch(str(name))) is not None:
            across_x[found[1]], across_y[found[2]] = float(place[0]), float(place[1])
    return across_x, across_y


@styled
def _plan(results: BuildingValues, storey: int) -> Figure:
    across_x, across_y = _grid(results)
    of_storey = results.values("members", "storey") == storey
    kind = results.values("members", "kind")
    xs, ys = sorted(across_x.values()), sorted(across_y.values())
    narrow = float(min(np.diff(xs).min(initial=np.inf), np.diff(ys).min(initial=np.inf)))
    wide, deep = xs[-1] - xs[0], ys[-1] - ys[0]
    scale = (_SIZE - 2.0 * _MARGIN) / max(wide, deep)  # inches a metre
    figure, [[axes]] = new_figure(1, 1, _SIZE, scale * deep + 2.0 * _MARGIN)
    _draw_grid(axes, across_x, across_y, scale)
    columns, beams, braces = (np.flatnonzero(of_storey & (kind == name)) for name in ("column", "beam", "brace"))
    named = narrow * scale > _LABEL
    _draw_beams(axes, results, beams, braces, named)
    _draw_braces(axes, results, braces, narrow, named)
    gap = np.full((1, 2), np.nan)
    size = _COLUMN * min(narrow, 2.0 * _MARGIN / scale)
    lines = [part for number in columns for part in _column_lines(results, int(number), size)]
    path = np.concatenate([part for line in lines for part in (line, gap)]) if lines else gap
    axes.plot(path[:, 0], path[:, 1], color=INK, linewidth=1.5, solid_capstyle="butt", zorder=3)
    if named:
        _name_columns(axes, results, columns, 1.2 * size)
    floor = results.values("floors", "floor").tolist().index(storey)
    centre = [float(results.values("floors", name)[floor]) for name in ("x", "y")]
    axes.plot(*centre, "x", color=TARGET, markersize=5.0)
    axes.set_aspect("equal")
    axes.set_axis_off()
    return figure


def _draw_grid(axes: Axes, across_x: dict[str, float], across_y: dict[str, float], scale: float) -> None:
    """Lines with their names, and the widths of the bays, where there is room for them."""
    inch = 1.0 / scale
    bubble = {"boxstyle": "circle,pad=0.25", "facecolor": "white", "edgecolor": INK, "linewidth": 0.5}
    origin = min(across_x.values()), min(across_y.values())
    for along, lines in ((0, across_x), (1, across_y)):
        across = across_y if along == 0 else across_x
        low, high = min(across.values()) - 0.4 * inch, max(across.values()) + 0.12 * inch
        labelled = last = -np.inf

        def point(place: float, beside: float, along: int = along) -> tuple[float, float]:
            return (place, origin[1] - beside * inch) if along == 0 else (origin[0] - beside * inch, place)

        for name, place in sorted(lines.items(), key=lambda line: line[1]):
            ends = [(place, low), (place, high)] if along == 0 else [(low, place), (high, place)]
            axes.plot(*zip(*ends, strict=True), color="#c9ced6", linewidth=0.5, zorder=0)
            if place - labelled > 0.24 * inch:
                axes.text(*point(place, 0.5), name, fontsize=7.0, ha="center", va="center", bbox=bubble)
                labelled = place
            if place - last > 0.3 * inch and np.isfinite(last):
                text, turned = f"{place - last:.4g}", 90.0 * along
                middle = point(0.5 * (place + last), 0.27)
                axes.text(*middle, text, fontsize=6.0, ha="center", va="center", rotation=turned)
            last = place


def _draw_beams(axes: Axes, results: BuildingValues, beams: np.ndarray, braces: np.ndarray, named: bool) -> None:
    """Beams, and the section of each way and size beside one of them where nothing else is."""
    start, end = (results.values("members", name)[beams] for name in ("start", "end"))
    section = results.values("members", "section")[beams]
    strokes(axes, start[:, :2], end[:, :2], _BEAM, 1.3)
    pins = hinges(results, beams)
    axes.plot(pins[:, 0], pins[:, 1], "o", markersize=2.8, mec=INK, mfc="white", mew=0.6, zorder=2)
    if not named:
        return
    braced = {(str(frame), int(bay)) for frame, bay in _bays(results, braces)}
    free = np.array([place not in braced for place in _bays(results, beams)])
    along_x = np.abs((end - start)[:, 0]) > np.abs((end - start)[:, 1])
    for way in (True, False):
        of_way = np.flatnonzero(along_x == way)
        for name in dict.fromkeys(section[of_way].tolist()):
            alike = of_way[section[of_way] == name]
            beside_nothing = free[alike].any()
            k = int((alike[free[alike]] if beside_nothing else alike)[-1])
            x, y = (0.5 * (start[k] + end[k]))[:2]
            side = 1.0 if beside_nothing else -1.0  # braces are drawn above a beam along x, on the left of one along y
            shift = (0.0, side) if way else (-2.0 * side, 0.0)
            place = {"ha": "center", "va": "bottom" if beside_nothing else "top", "rotation": 0}
            if not way:
                place = {"ha": "right" if beside_nothing else "left", "va": "center", "rotation": 90}
            axes.annotate(name, (x, y), shift, textcoords="offset points", fontsize=6.0, **place)  # type: ignore[arg-type]


def _bays(results: BuildingValues, members: np.ndarray) -> list[tuple[str, int]]:
    """Frame of each member and its place in it, mm along."""
    frames = results.values("members", "frame")[members]
    middle = 0.5 * (results.values("members", "start")[members] + results.values("members", "end")[members])
    places = [middle[k, 0 if str(frame).startswith("X") else 1] for k, frame in enumerate(frames)]
    return [(str(frame), round(1e3 * float(place))) for frame, place in zip(frames, places, strict=True)]


def _draw_braces(axes: Axes, results: BuildingValues, braces: np.ndarray, narrow: float, named: bool) -> None:
    start, end = (results.values("members", name)[braces] for name in ("start", "end"))
    section = results.values("members", "section")[braces]
    labelled: set[str] = set()
    for a, b, name in zip(start, end, section, strict=True):
        way = (b - a)[:2]
        length = float(np.hypot(*way))
        if length == 0.0:
            continue
        side = _BRACE * narrow * np.array([-abs(way[1]), abs(way[0])]) / length
        (x0, y0), (x1, y1) = a[:2] + 0.12 * way + side, b[:2] - 0.12 * way + side
        axes.plot([x0, x1], [y0, y1], color=AFTER, linewidth=1.3, linestyle=(0, (4, 2)), zorder=2)
        if named and name not in labelled:
            labelled.add(str(name))
            along_x = abs(way[0]) > abs(way[1])
            x, y = np.array([0.5 * (x0 + x1), 0.5 * (y0 + y1)]) + side
            turned = {"rotation": 0, "ha": "center"} if along_x else {"rotation": 90, "ha": "right"}
            axes.text(x, y, str(name), fontsize=6.0, color=AFTER, va="bottom" if along_x else "center", **turned)  # type: ignore[arg-type]


def _column_lines(results: BuildingValues, number: int, size: float) -> list[np.ndarray]:
    """An I with its web as it stands, a circle or a rectangle, as lines of points."""
    shape = results.section(str(results.values("members", "section")[number])).kind
    middle = results.values("members", "start")[number][:2]
    web = results.values("members", "web")[number][:2]
    web = web / max(float(np.hypot(*web)), 1e-12)
    flange = np.array([-web[1], web[0]])
    if shape == "CHS":
        turn = np.linspace(0.0, 2.0 * np.pi, 25)
        return [middle + 0.8 * size * np.column_stack([np.cos(turn), np.sin(turn)])]
    if shape == "RHS":
        corners = np.array([(1, 0.8), (-1, 0.8), (-1, -0.8), (1, -0.8), (1, 0.8)]) * size
        return [middle + corners @ np.array([web, flange])]
    ends = [middle + size * web, middle - size * web]
    return [np.array(ends), *(np.array([of + size * flange, of - size * flange]) for of in ends)]


def _name_columns(axes: Axes, results: BuildingValues, columns: np.ndarray, shift: float) -> None:
    """The section of a column, beside the last one that has it."""
    section, start = results.values("members", "section")[columns], results.values("members", "start")[columns]
    for name in dict.fromkeys(section.tolist()):
        x, y = start[np.flatnonzero(section == name)[-1]][:2]
        axes.text(x + shift, y + shift, name, fontsize=6.0, ha="left", va="bottom", zorder=4)


def _sections(results: BuildingValues, storey: int) -> str:
    """The sections of a storey in words."""
    of_storey = results.values("members", "storey") == storey
    kind, section = (results.values("members", name)[of_storey] for name in ("kind", "section"))
    kinds = [(name, dict.fromkeys(section[kind == name].tolist())) for name in ("column", "beam", "brace")]
    return "; ".join(f"{name}s {', '.join(sections)}" for name, sections in kinds if sections)
