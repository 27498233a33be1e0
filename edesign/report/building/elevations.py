"""Elevations of a building with its members coloured by their utilisation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.report.building.results import BuildingResults, BuildingValues
from edesign.report.drawing.style import new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BANDS = (
    (0.5, "#9fb8d0", "up to 0.5"),
    (0.8, "#3f78ad", "0.5 to 0.8"),
    (1.0, "#1d4467", "0.8 to 1.0"),
    (np.inf, "#c0392b", "above 1.0"),
)
"""Upper end of each band of utilisation, its colour, and what the legend says."""
INK = "#1c2430"
_X, _Z = 0, 2
_PIN = 0.07  # place of a hinge in drawings, by the length of the member
_WIDTH, _HEIGHT = 6.0, 7.0  # inches at most
_LABEL = 0.6  # length of a label, inches


def elevations(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield an elevation of each kind of plane frame.

    Yields:
        Name of the file, caption and figure.
    """
    results = BuildingResults(archive)
    for frame, alike in _different_frames(results):
        others = f" {', '.join(alike)}: the same members, used less." if alike else ""
        caption = (
            f"Frame {frame}, members by their largest utilisation. Section and largest utilisation stand where a "
            f"section is used most, if there is room; circles are pinned ends of beams.{others}"
        )
        yield f"elevation_{frame}", caption, _elevation(results, frame)


def hinges(results: BuildingValues, members: np.ndarray) -> np.ndarray:
    """Return the places of the pinned ends of beams, (n, 3) m.

    Args:
        results: members and nodes of the building.
        members: numbers of the members, or which they are, (n,).
    """
    start, end = (results.values("members", name)[members] for name in ("start", "end"))
    stiffness = results.values("members", "ends")[members]
    bends = results.values("members", "kind")[members] == "beam"
    at_start, at_end = bends & (stiffness[:, 0] == 0.0), bends & (stiffness[:, 2] == 0.0)
    near_start, near_end = start + _PIN * (end - start), end - _PIN * (end - start)
    return np.concatenate([near_start[at_start], near_end[at_end]])


def _different_frames(results: BuildingResults) -> list[tuple[str, list[str]]]:
    """Return the plane frames that differ in sections, each the one that is used most, with those alike."""
    kind, section = (results.values("members", name) for name in ("kind", "section"))
    worst = _use(results)
    found: dict[tuple[str, ...], list[tuple[float, str]]] = {}
    for frame, chosen in _of_frames(results).items():
        alike = (frame[0], *sorted(f"{kind[n]} {section[n]}" for n in chosen))
        found.setdefault(alike, []).append((-float(worst[chosen].max().round(9)), frame))
    ordered = [[frame for _, frame in sorted(frames)] for frames in found.values()]
    return [(frames[0], sorted(frames[1:])) for frames in ordered]


def _of_frames(results: BuildingResults) -> dict[str, list[int]]:
    """Numbers of the members of each plane frame."""
    found: dict[str, list[int]] = {}
    for number, names in enumerate(results.values("members", "frame")):
        for name in filter(None, str(names).split(", ")):
            found.setdefault(name, []).append(number)
    return {name: found[name] for name in sorted(found)}


def _use(results: BuildingResults) -> np.ndarray:
    """The largest utilisation of each member."""
    return np.asarray(np.nan_to_num(results.values("members", "utilisation"), nan=0.0).max(axis=1))


@styled
def _elevation(results: BuildingResults, frame: str) -> Figure:
    chosen = np.array(_of_frames(results)[frame])
    along = 0 if frame.startswith("X") else 1
    starts, ends = (results.values("members", name)[chosen] for name in ("start", "end"))
    use = _use(results)[chosen]
    wide, high = float(np.ptp(ends[:, along])), float(ends[:, _Z].max())
    scale = min(_WIDTH / max(wide, 0.5 * high), (_HEIGHT - 1.2) / high)
    figure, [[axes]] = new_figure(1, 1, _WIDTH, scale * high + 1.2)
    lower = 0.0
    for upper, colour, _ in BANDS:
        within = (use <= upper) & ((use > lower) | (lower == 0.0))
        strokes(axes, starts[within][:, [along, _Z]], ends[within][:, [along, _Z]], colour, 1.6)
        lower = upper
    _supports(axes, results, chosen, along)
    pins = hinges(results, chosen)
    axes.plot(pins[:, along], pins[:, _Z], "o", markersize=2.6, mec=INK, mfc="white", mew=0.6)
    _names(axes, results, chosen, along, _LABEL / scale)
    axes.set_aspect("equal")
    axes.margins(0.05, 0.04)
    _dress(axes, f"{'x' if along == 0 else 'y'} [m]")
    return figure


def _names(axes: Axes, results: BuildingResults, chosen: np.ndarray, along: int, room: float) -> None:
    """The section of each kind of members where it is used most, but not within `room` (m) of another one."""
    kind, section = (results.values("members", name)[chosen] for name in ("kind", "section"))
    start, end = (results.values("members", name)[chosen] for name in ("start", "end"))
    use = _use(results)[chosen]
    taken: list[np.ndarray] = []
    for pair in dict.fromkeys(zip(kind.tolist(), section.tolist(), strict=True)):
        alike = np.flatnonzero((kind == pair[0]) & (section == pair[1]))
        middle = 0.5 * (start + end)[alike][:, [along, _Z]]
        order = np.argsort(-use[alike].round(3), kind="stable")
        free = [int(k) for k in order if all(np.abs(middle[k] - at).max() > room for at in taken)]
        if not free:
            continue
        place = free[0]
        taken.append(middle[place])
        way = (end - start)[alike[place]]
        turned = float(np.degrees(np.arctan2(way[_Z], way[along])))
        axes.annotate(
            f"{pair[1]} {use[alike[place]]:.2f}",
            tuple(middle[place]),
            rotation=turned if abs(turned) <= 90.0 else turned - 180.0,
            rotation_mode="anchor",
            ha="center",
            va="center",
            fontsize=6.0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
            transform_rotates_text=True,
        )


def _supports(axes: Axes, results: BuildingResults, chosen: np.ndarray, along: int) -> None:
    """Squares where a column base is fixed against turning in the frame, triangles where it is not."""
    nodes = {str(name): number for number, name in enumerate(results.values("nodes", "node"))}
    ends = [nodes[str(results.values("members", name)[n])] for n in chosen for name in ("start_node", "end_node")]
    at = np.unique(ends)
    fixed, place = results.values("nodes", "fixed")[at] > 0, results.values("nodes", "position")[at]
    turns = ~fixed[:, 4 if along == 0 else 3]
    for which, marker in ((fixed[:, 2] & ~turns, "s"), (fixed[:, 2] & turns, "^")):
        axes.plot(place[which, along], place[which, _Z], marker, color=INK, markersize=3.4)


def strokes(axes: Axes, starts: np.ndarray, ends: np.ndarray, colour: str, width: float) -> None:
    """Draw lines from (n, 2) to (n, 2) as one path, which is small and quick.

    Args:
        starts: first points of the lines, (n, 2).
        ends: second points of the lines, (n, 2).
        width: width of the line, points.
    """
    path = np.stack([starts, ends, np.full_like(starts, np.nan)], axis=1).reshape(-1, 2)
    axes.plot(path[:, 0], path[:, 1], color=colour, linewidth=width, solid_capstyle="round")


def _dress(axes: Axes, label: str) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=colour, linewidth=2.0, label=text) for _, colour, text in BANDS]
    figure = axes.get_figure()
    assert figure is not None
    figure.legend(handles=handles, loc="outside lower center", ncols=4, title="utilisation")
    axes.set_xlabel(label)
    axes.set_ylabel("level [m]")
    axes.grid(False)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
