"""One picture of the motion of a building, for paper: its two elevations and its plan."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.report.drawing.frame_drawing import SUPPORTS, draw_lines
from edesign.report.drawing.style import MEAN, new_figure, styled
from edesign.report.motion.encoding import fitting_scale
from edesign.report.motion.moving import Moving
from edesign.report.motion.scenes import Scene
from edesign.report.motion.still import MARGIN, TUNED, UNMOVED, class_legend, hung_place, member_curve
from edesign.report.response.frame_figures import COLORS, SIZES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_VIEWS = (("elevation along x", (0, 2)), ("elevation along y", (1, 2)), ("plan, roof dark", (0, 1)))
_WIDTH, _HIGHEST = 6.6, 3.4  # inches of the panels of a variant, and of them at most
_POINTS = 7  # along a bent member
_PLAN = 2
_SEEN = 1e-3  # m, from which a member is more than a point in a view


@styled
def building_still(scene: Scene) -> Figure:
    """Draw the deformed building at the picture with the largest drift: a row of two elevations and a plan a variant.

    Args:
        scene: of a building, with at least one variant.
    """
    scale, count = fitting_scale(scene), len(scene.variants)
    places = np.array([place for one in scene.variants for place in one.geometry.nodes.values()])
    low, high = places.min(axis=0), places.max(axis=0)
    margin = MARGIN * float(np.max(high - low))
    aside = margin + scale * max(one.at(np.array([scene.peak])).reach for one in scene.variants)
    edge = np.array((aside, aside, margin))
    low, high = low - edge, high + edge
    sides = high - low
    wide = [float(sides[across]) for _, (across, _) in _VIEWS]
    tall = float(max(sides[up] for _, (_, up) in _VIEWS))
    inches = min(_WIDTH / sum(wide), _HIGHEST / tall)
    figure, axes = new_figure(count, len(_VIEWS), max(4.2, inches * sum(wide)), count * (inches * tall + 0.35) + 0.3)
    grid = axes[0][0].get_gridspec()
    assert grid is not None
    grid.set_width_ratios(wide)
    ranks: set[int] = set()
    for row, one in zip(axes, scene.variants, strict=True):
        curves = _curves(one, scene.peak, scale)
        for number, (axis, (words, view)) in enumerate(zip(row, _VIEWS, strict=True)):
            ranks |= _draw(axis, one, scene.peak, scale, curves, view)
            axis.set_title(f"{one.title}, {words}" if number == 0 and one.title else words, loc="left")
            axis.set_xlim(low[view[0]], high[view[0]])
            axis.set_ylim(low[view[1]], high[view[1]])
            axis.set_aspect("equal", anchor="N")
            axis.set_axis_off()
    class_legend(figure, scene, ranks, 4)
    return figure


def _curves(one: Moving, picture: int, scale: float) -> dict[str, np.ndarray]:
    """Every member, displaced: two points of a straight one."""
    geometry, motion = one.geometry, one.node_motion[picture]
    return {
        name: member_curve(geometry, name, motion, scale, 2 if {(name, 0), (name, 1)} <= geometry.hinged else _POINTS)
        for name in geometry.members
    }


def _draw(
    axis: Axes, one: Moving, picture: int, scale: float, curves: dict[str, np.ndarray], view: tuple[int, int]
) -> set[int]:
    """Draw a view of a variant and return the classes of the hinges that show."""
    geometry, motion, plan = one.geometry, one.node_motion[picture], view == _VIEWS[_PLAN][1]
    across = list(view)
    places = np.array(list(geometry.nodes.values()))
    at_rest = {name: places[list(pair)][:, across] for name, pair in geometry.members.items()}
    level = {name for name, pair in geometry.members.items() if abs(np.diff(places[list(pair), 2])[0]) < _SEEN}
    shown = [n for n, ends in at_rest.items() if np.ptp(ends, axis=0).max() > _SEEN and (n in level or not plan)]
    rest = {tuple(map(tuple, ends.round(3).tolist())): ends for ends in (at_rest[n] for n in shown)}
    draw_lines(axis, rest.values(), color=UNMOVED, lw=0.5, zorder=0.9)
    roof = geometry.levels[-1]
    dark = [n for n in shown if not plan or min(places[list(geometry.members[n]), 2]) > roof - _SEEN]
    others = (curves[n][:, across] for n in shown if n not in dark) if plan else ()
    draw_lines(axis, others, color=one.color, lw=0.4, alpha=0.45, zorder=1.2)
    draw_lines(axis, (curves[n][:, across] for n in dark), color=one.color, lw=1.1, zorder=1.5)
    for damper in geometry.dampers:
        start, end = (hung_place(point, motion, scale) for point in damper.body)
        body = np.array([start + share * (end - start) for share in damper.span])[:, across]
        lines = [[hung_place(point, motion, scale) for point in brace] for brace in damper.braces]
        draw_lines(axis, (np.array(line)[:, across] for line in lines), color=MEAN, lw=0.4, zorder=1.6)
        axis.plot(*body.T, color=MEAN, lw=1.8, zorder=1.7)
    for mass, stroke in zip(geometry.masses, one.strokes[picture], strict=True):
        foot = hung_place(mass.at, motion, scale)
        top = foot + scale * float(stroke) * np.eye(3)[mass.direction]
        draw_lines(axis, (np.array((foot, top))[:, across],), color=MEAN, lw=0.6, zorder=1.6)
        axis.plot(*top[across], marker="s", ms=4.5, color=TUNED, zorder=1.8)
    if plan:
        return set()
    moved = places + scale * motion[:, :3]
    for kind in dict.fromkeys(support.kind for support in geometry.supports):
        at = moved[[support.node for support in geometry.supports if support.kind == kind]]
        style: Any = {"ms": 3.4, "mfc": "white", "mec": MEAN, "mew": 0.6}
        axis.plot(*at[:, across].T, marker=SUPPORTS[kind], ls="none", zorder=2, **style)
    return _hinges(axis, one, picture, {n: curves[n][:, across] for n in shown})


def _hinges(axis: Axes, one: Moving, picture: int, curves: dict[str, np.ndarray]) -> set[int]:
    """Circles at the ends that have yielded, the largest rotations on top; rings where histories were not kept."""
    of: dict[int, list[np.ndarray]] = {}
    rotations = one.rotation[picture] if one.rotation is not None else list(one.ends.values())
    for (member, side), rotation, limits in zip(one.ends, rotations, one.limits, strict=True):
        rank = int(np.searchsorted(limits, rotation, side="right"))
        if rank and member in curves:
            near, far = curves[member][[-1, -2] if side else [0, 1]]
            of.setdefault(rank, []).append(near + 0.4 * (far - near))
    for rank, places in of.items():
        color, kept = COLORS[rank - 1], one.rotation is not None
        looks: Any = {"mfc": color if kept else "white", "mec": MEAN if kept else color, "mew": 0.4}
        axis.plot(*np.array(places).T, marker="o", ls="none", ms=0.75 * SIZES[rank - 1], zorder=3 + rank, **looks)
    return set(of)
