"""Plans and elevations of a building with its members coloured by their utilisation, and its modes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.captions import plain
from edesign.report.figures import VARIANTS, new_figure, styled
from edesign.space.archived import PLACE

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
MODES_DRAWN = 3
_PLAN, _X, _Z = (0, 1), 0, 2


def building_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Give the figures of a building: name of the file, caption, figure; none of other archives."""
    if PLACE not in archive.names():
        return
    members = archive.group(f"{PLACE}/members")
    for frame in _different_frames(members):
        caption = (
            f"Frame {frame}, members by their largest utilisation. "
            "Each line is a member, with its section where the section first stands."
        )
        yield f"elevation_{frame}", caption, _elevation(members, frame)
    modes = archive.group(f"{PLACE}/modes")
    periods = ", ".join(plain(float(T)) for T in modes.variables["period"].values[:MODES_DRAWN])
    caption = f"The first modes: {periods} s. Displacements of the floors, and rotation times half the plan's diagonal."
    yield "building_modes", caption, _modes(modes, members)


def _different_frames(members: Group) -> list[str]:
    """Return the plane frames that differ in sections, utilisation or shape, the worst of each kind."""
    of = members.variables
    worst = np.nan_to_num(np.nanmax(np.nan_to_num(of["utilisation"].values, nan=0.0), axis=1))
    found: dict[tuple[str, ...], tuple[float, str]] = {}
    for frame in sorted({name for names in of["frame"].values for name in str(names).split(", ") if name}):
        chosen = _of_frame(members, frame)
        kind = (frame[0], *sorted(f"{of['kind'].values[n]} {of['section'].values[n]}" for n in chosen))
        largest = float(worst[chosen].max())
        if kind not in found or largest > found[kind][0] + 1e-9:
            found[kind] = (largest, frame)
    return [frame for _, frame in found.values()]


def _of_frame(members: Group, frame: str) -> np.ndarray:
    names = members.variables["frame"].values
    return np.array([n for n, text in enumerate(names) if frame in str(text).split(", ")])


@styled
def _elevation(members: Group, frame: str) -> Figure:
    of = members.variables
    chosen = _of_frame(members, frame)
    along = 0 if frame.startswith("X") else 1
    starts, ends = of["start"].values[chosen], of["end"].values[chosen]
    use = np.max(np.nan_to_num(of["utilisation"].values[chosen], nan=0.0), axis=1)
    height = max(2.6, min(7.0, 0.14 * float(ends[:, _Z].max()) + 1.2))
    figure, [[axes]] = new_figure(1, 1, 6.0, height)
    told: set[tuple[str, str]] = set()
    for n, start, end, u in zip(chosen, starts, ends, use, strict=True):
        (x0, z0), (x1, z1) = (start[along], start[_Z]), (end[along], end[_Z])
        axes.plot([x0, x1], [z0, z1], color=_colour(float(u)), linewidth=1.6, solid_capstyle="round")
        kind, section = str(of["kind"].values[n]), str(of["section"].values[n])
        if (kind, section) not in told:
            told.add((kind, section))
            upright = kind == "column"
            axes.annotate(
                f"{section} {u:.2f}",
                (0.5 * (x0 + x1), 0.5 * (z0 + z1)),
                rotation=90 if upright else 0,
                ha="right" if upright else "center",
                va="center" if upright else "bottom",
                fontsize=6.0,
            )
    _dress(axes, f"{'x' if along == 0 else 'y'} [m]")
    return figure


@styled
def _modes(modes: Group, members: Group) -> Figure:
    of = modes.variables
    levels = np.unique(members.variables["end"].values[:, _Z].round(6))
    shape = of["floor_shape"].values[:MODES_DRAWN]
    z = np.concatenate([[0.0], levels[levels > 0.0][: shape.shape[1]]])
    radius = 0.5 * float(np.hypot(*np.ptp(members.variables["end"].values[:, _PLAN], axis=0)))
    figure, [row] = new_figure(1, len(shape), 6.0, 2.8)
    for k, each in enumerate(row):
        motion = shape[k] * np.array([1.0, 1.0, radius])
        motion /= np.abs(motion).max()
        for degree, name in enumerate(("ux", "uy", "rz")):
            each.plot(np.concatenate([[0.0], motion[:, degree]]), z, color=VARIANTS[degree], label=name)
        each.set_title(f"mode {k + 1}, {plain(float(of['period'].values[k]))} s")
        each.set_xlabel("displacement by the largest")
        each.set_ylabel("level [m]" if k == 0 else "")
        each.legend(loc="lower right")
    return figure


def _colour(use: float) -> str:
    return next(colour for limit, colour, _ in BANDS if use <= limit)


def _dress(axes: Axes, label: str) -> None:
    from matplotlib.lines import Line2D

    handles = [Line2D([], [], color=colour, linewidth=2.0, label=text) for _, colour, text in BANDS]
    axes.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4, title="utilisation")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel(label)
    axes.set_ylabel("level [m]")
    axes.grid(False)
