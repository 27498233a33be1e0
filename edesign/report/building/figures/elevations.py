"""Elevations of a building with its members coloured by their utilisation."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.project.notation.axes import COLUMN_LINE
from edesign.report.building.results import BuildingResults, BuildingValues
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Grid, draw_axes
from edesign.report.model.figures import Named
from edesign.report.model.sheet import INK, SMALLEST, Entry, Sheet, on_sheet
from edesign.report.model.supports import SIGNS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BANDS = (
    (0.5, "#9fb8d0", "up to 0.5"),
    (0.8, "#3f78ad", "0.5 to 0.8"),
    (1.0, "#1d4467", "0.8 to 1.0"),
    (np.inf, "#c0392b", "above 1.0"),
)
"""Upper end of each band of utilisation, its colour, and what the legend says."""
_X, _Z = 0, 2
_PIN = 0.07  # place of a hinge in drawings, by the length of the member
LINK = 3.6  # width of the line of a seismic link, points
_BESIDE = 0.03  # of a label beside its member, inches
_WIDTH = 6.4  # of the legend, inches


def elevations(archive: Archive) -> Iterator[Named]:
    """Yield an elevation of each kind of plane frame.

    Yields:
        Name of the file, caption and figure.
    """
    results = BuildingResults(archive)
    for frame, alike in different_frames(results):
        others = f" {', '.join(alike)}: the same members, used less." if alike else ""
        caption = (
            f"Frame {frame}, members by their largest utilisation. Section and largest utilisation stand where a "
            f"section is used most, if there is room; circles are pinned ends of beams. Levels and spans in m.{others}"
        )
        yield f"elevation_{frame}", caption, on_sheet(partial(_draw, results=results, frame=frame))


def grid_lines(results: BuildingValues) -> tuple[list[tuple[str, float]], list[tuple[str, float]]]:
    """Return names and places of the lines across x and across y, m, in their order.

    Args:
        results: members and nodes of the building.
    """
    across_x: dict[str, float] = {}
    across_y: dict[str, float] = {}
    for name, place in zip(results.values("nodes", "node"), results.values("nodes", "position"), strict=True):
        if (found := COLUMN_LINE.fullmatch(str(name).partition(".")[0])) is not None:
            across_x[found[1]], across_y[found[2]] = float(place[0]), float(place[1])
    first, second = (sorted(lines.items(), key=lambda line: line[1]) for lines in (across_x, across_y))
    return first, second


def hinges(results: BuildingValues, members: np.ndarray, least: float = 0.0) -> np.ndarray:
    """Return the places of the pinned ends of beams, (n, 3) m.

    Args:
        results: members and nodes of the building.
        members: numbers of the members, or which they are, (n,).
        least: distance from the node at least, m, that a sign of its column leaves free.
    """
    start, end = (results.values("members", name)[members] for name in ("start", "end"))
    along = np.maximum(_PIN, least / np.linalg.norm(end - start, axis=1))[:, np.newaxis] * (end - start)
    stiffness = results.values("members", "ends")[members]
    bends = results.values("members", "kind")[members] == "beam"
    at_start, at_end = bends & (stiffness[:, 0] == 0.0), bends & (stiffness[:, 2] == 0.0)
    return np.concatenate([(start + along)[at_start], (end - along)[at_end]])


def different_frames(results: BuildingResults) -> list[tuple[str, list[str]]]:
    """Return the plane frames that differ in sections, each the one that is used most, with those alike."""
    kind, section = (results.values("members", name) for name in ("kind", "section"))
    worst = largest_use(results)
    found: dict[tuple[str, ...], list[tuple[float, str]]] = {}
    for frame, chosen in frames_of(results).items():
        alike = (frame[0], *sorted(f"{kind[n]} {section[n]}" for n in chosen))
        found.setdefault(alike, []).append((-float(worst[chosen].max().round(9)), frame))
    ordered = [[frame for _, frame in sorted(frames)] for frames in found.values()]
    return [(frames[0], sorted(frames[1:])) for frames in ordered]


def frames_of(results: BuildingResults) -> dict[str, list[int]]:
    """Return the numbers of the members of each plane frame, from 0, by its name."""
    found: dict[str, list[int]] = {}
    for number, names in enumerate(results.values("members", "frame")):
        for name in filter(None, str(names).split(", ")):
            found.setdefault(name, []).append(number)
    return {name: found[name] for name in sorted(found)}


def largest_use(results: BuildingResults) -> np.ndarray:
    """Return the largest utilisation of each member, (n_members,); 0 where no check applies."""
    return np.asarray(np.nan_to_num(results.values("members", "utilisation"), nan=0.0).max(axis=1))


def _draw(sheet: Sheet, results: BuildingResults, frame: str) -> None:
    chosen = np.array(frames_of(results)[frame])
    along = 0 if frame.startswith("X") else 1
    lines = grid_lines(results)[along]
    levels = np.unique(results.values("nodes", "position")[:, _Z].round(6)).tolist()
    grid = Grid.of([name for name, _ in lines], [place for _, place in lines], levels)
    draw_axes(sheet, grid)
    scale = np.array([grid.across, grid.up])
    starts, ends = (scale * results.values("members", name)[chosen][:, [along, _Z]] for name in ("start", "end"))
    use = largest_use(results)[chosen]
    links = results.values("links", "member") if results.has("links") else ()
    linked = np.isin(results.values("members", "member")[chosen], links)
    lower = 0.0
    for upper, colour, _ in BANDS:
        within = (use <= upper) & ((use > lower) | (lower == 0.0))
        for of, width in ((within & ~linked, 1.6), (within & linked, LINK)):
            sheet.lines(np.stack([starts, ends], axis=1)[of], colour, width, solid_capstyle="round")
        lower = upper
    pins = scale * hinges(results, chosen)[:, [along, _Z]]
    sheet.dots(pins, 2.6, mew=0.6)
    for x, y, kind in _supports(results, chosen, along):
        SIGNS[kind](sheet, grid.across * x, grid.up * y)
    kind, section = (results.values("members", name)[chosen] for name in ("kind", "section"))
    for pair in dict.fromkeys(zip(kind.tolist(), section.tolist(), strict=True)):
        alike = np.flatnonzero((kind == pair[0]) & (section == pair[1]))
        for n in alike[np.argsort(-use[alike].round(3), kind="stable")]:
            if sheet.place(_beside(starts[n], ends[n]), f"{pair[1]} {use[n]:.2f}", (SMALLEST,)):
                break
    entries = [Entry(f"utilisation {text}", partial(_stroke, colour=colour)) for _, colour, text in BANDS]
    entries += [Entry("seismic link", partial(_stroke, colour=INK, width=LINK))] * bool(linked.any())
    sheet.legend(entries, _WIDTH)


def _stroke(sheet: Sheet, x: float, y: float, colour: str, width: float = 2.0) -> None:
    sheet.line((x, y), (x + 0.3, y), color=colour, width=width)


def _beside(start: np.ndarray, end: np.ndarray) -> list[Spot]:
    """Places of a text on both sides of a member, along it, inches."""
    if (end[0], end[1]) < (start[0], start[1]):
        start, end = end, start
    way = end - start
    angle = math.atan2(way[1], way[0])
    side = _BESIDE * np.array([-math.sin(angle), math.cos(angle)])
    level, upright = abs(way[1]) < 1e-6, abs(way[0]) < 1e-6
    shares = (
        (0.5,) if upright else (0.5, 0.3, 0.7) if level else (0.27, 0.73, 0.23, 0.77, 0.5)
    )  # where crosses do not meet
    spots = []
    for sign, va in ((1.0, "bottom"), (-1.0, "top")):
        for share in shares:
            x, y = start + share * way + sign * side
            spots.append(Spot(x, y, "center", va, math.degrees(angle)))
    return spots


def _supports(results: BuildingResults, chosen: np.ndarray, along: int) -> Iterator[tuple[float, float, str]]:
    """Places of the column bases, m, and whether each is held against turning in the frame."""
    nodes = {str(name): number for number, name in enumerate(results.values("nodes", "node"))}
    ends = [nodes[str(results.values("members", name)[n])] for n in chosen for name in ("start_node", "end_node")]
    for at in np.unique(ends):
        fixed, place = results.values("nodes", "fixed")[at] > 0, results.values("nodes", "position")[at]
        if fixed[2]:
            yield float(place[along]), float(place[_Z]), "fixed" if fixed[4 if along == 0 else 3] else "pinned"


def strokes(axes: Axes, starts: np.ndarray, ends: np.ndarray, colour: str, width: float) -> None:
    """Draw lines from (n, 2) to (n, 2) as one path, which is small and quick.

    Args:
        starts: first points of the lines, (n, 2).
        ends: second points of the lines, (n, 2).
        width: width of the line, points.
    """
    path = np.stack([starts, ends, np.full_like(starts, np.nan)], axis=1).reshape(-1, 2)
    axes.plot(path[:, 0], path[:, 1], color=colour, linewidth=width, solid_capstyle="round")
