"""One picture of a motion, for paper and for readers without the viewer."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import numpy as np

from edesign.report.drawing.captions import at_level, plain
from edesign.report.drawing.frame_drawing import DAMPER, SUPPORTS, draw_lines
from edesign.report.drawing.panels import arrangement
from edesign.report.drawing.style import MEAN, legend_below, styled
from edesign.report.motion.encoding import fitting_scale
from edesign.report.motion.geometry import BELOW, GROUND, SIGN, Geometry, Hung
from edesign.report.motion.moving import Moving
from edesign.report.motion.scenes import Scene
from edesign.report.response.frame_figures import COLORS, SIZES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

UNMOVED = "#c9ced6"
TUNED = "#7b3f98"
MARGIN = 0.04  # of the larger side of the frame
MARGIN_UPWARDS = 0.06  # of its height, at most


@styled
def still_figure(scene: Scene) -> Figure:
    """Draw the deformed frames at the picture with the largest drift, side by side.

    Args:
        scene: with at least one variant.
    """
    places = np.array(list(scene.variants[0].geometry.nodes.values()))
    wide, high = (float(size) for size in np.ptp(places, axis=0))
    scale, margin = fitting_scale(scene), MARGIN * max(wide, high)
    aside = scale * max(one.at(np.array([scene.peak])).reach for one in scene.variants) + margin
    upwards = min(margin, MARGIN_UPWARDS * high)
    bottom = min(one.geometry.ground for one in scene.variants) - upwards
    top = places[:, 1].max() + upwards
    of_all = wide + 2.0 * aside, top - bottom
    arranged = arrangement(len(scene.variants), places[:, 0].tolist(), places[:, 1].tolist(), *of_all)
    figure, axes = arranged.figure()
    for axis in axes[len(scene.variants) :]:
        axis.set_visible(False)
    ranks: set[int] = set()
    for axis, one in zip(axes, scene.variants, strict=False):
        ranks |= _draw(axis, one, scene.peak, scale)
        arranged.scale(axis)
        arranged.title(axis, one.title or "frame")
        axis.set_xlim(places[:, 0].min() - aside, places[:, 0].max() + aside)
        axis.set_ylim(bottom, top)
    class_legend(figure, scene, ranks, 2 if figure.get_figwidth() < 4.0 else 4)
    return figure


def class_legend(figure: Figure, scene: Scene, ranks: Collection[int], columns: int) -> None:
    """Add a legend of the classes of hinges that show.

    Args:
        ranks: their numbers, from 1.
    """
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], marker="o", ls="none", ms=SIZES[i - 1], mfc=COLORS[i - 1], mec=MEAN, mew=0.5, label=name)
        for i, name in enumerate(scene.scale.names)
        if i in ranks
    ]
    if handles:
        legend_below(figure, handles, most=columns)


def member_curve(geometry: Geometry, member: str, motion: np.ndarray, scale: float, points: int = 17) -> np.ndarray:
    """Return a member as a cubic through displaced ends with the slopes of its nodes, (points, 2 or 3) m.

    An end that is hinged has no moment; a brace is straight.

    Args:
        geometry: of the frame.
        motion: of the nodes, (nodes, 3) m, m, rad, of a building (nodes, 6).
        scale: how many times larger it is drawn.
        points: along the member.
    """
    start, end = geometry.members[member]
    places = np.array(list(geometry.nodes.values()))
    axis = places[end] - places[start]
    first, last = (places[i] + scale * motion[i, : axis.size] for i in (start, end))
    hinged = [member[:1] == "D" or (member, at) in geometry.hinged for at in (0, 1)]
    tangents = [_turned(axis, scale * motion[i, axis.size :]) for i in (start, end)]
    if all(hinged):
        tangents = [last - first] * 2
    elif any(hinged):
        tangents[hinged[1]] = 1.5 * (last - first) - 0.5 * tangents[hinged[0]]
    s = np.linspace(0.0, 1.0, points)[:, np.newaxis]
    h = (2 * s**3 - 3 * s**2 + 1, s**3 - 2 * s**2 + s, 3 * s**2 - 2 * s**3, s**3 - s**2)
    return np.asarray(h[0] * first + h[1] * tangents[0] + h[2] * last + h[3] * tangents[1])


def _turned(axis: np.ndarray, rotation: np.ndarray) -> np.ndarray:
    """The axis of a member after a small rotation, in the plane (1,) or in space (3,) rad."""
    if axis.size == 2:
        return np.asarray(axis + rotation[0] * np.array((-axis[1], axis[0])))
    return np.asarray(axis + np.cross(rotation, axis))


def _draw(axis: Axes, one: Moving, picture: int, scale: float) -> set[int]:
    """Draw a variant and return the classes of the hinges that show."""
    geometry, motion = one.geometry, one.node_motion[picture]
    places = np.array(list(geometry.nodes.values()))
    at_rest = (places[list(pair)] for pair in geometry.members.values())
    draw_lines(axis, at_rest, color=UNMOVED, lw=0.6, ls=(0, (3, 2)), zorder=0.9)
    curves = (member_curve(geometry, name, motion, scale) for name in geometry.members)
    draw_lines(axis, curves, color=one.color, lw=1.4, zorder=1.5)
    braces = (np.transpose(_line(*of, motion, scale, (0.0, 1.0))) for one in geometry.dampers for of in one.braces)
    draw_lines(axis, braces, color=MEAN, lw=0.5, zorder=1.2)
    for damper in geometry.dampers:
        if not damper.wide:
            axis.plot(*_line(*damper.body, motion, scale, damper.span), color=MEAN, lw=2.4, zorder=1.6)
            continue
        (x0, x1), (y0, y1) = _line(*damper.body, motion, scale, damper.span)
        half = 0.5 * damper.wide
        axis.fill(
            (x0 - half, x0 + half, x1 + half, x1 - half), (y0, y0, y1, y1), color=DAMPER, ec=MEAN, lw=0.5, zorder=1.3
        )
    _draw_bases(axis, geometry, motion, scale)
    for mass, stroke in zip(geometry.masses, one.strokes[picture], strict=True):
        (x, _), (y, _) = _line(mass.at, mass.at, motion, scale, (0.0, 1.0))
        half, at = 0.5 * SIGN * geometry.size, x + scale * float(stroke)
        axis.plot((x, x, at), (y, y + half, y + half), color=MEAN, lw=0.6, zorder=1.2)
        axis.fill(
            (at - half, at + half, at + half, at - half), (y, y, y + 2 * half, y + 2 * half), color=TUNED, zorder=1.7
        )
    found: set[int] = set()
    rotations = one.rotation[picture] if one.rotation is not None else list(one.ends.values())
    for (member, side), rotation, limits in zip(one.ends, rotations, one.limits, strict=True):
        rank = int(np.searchsorted(limits, rotation, side="right"))
        if not rank:
            continue
        found.add(rank)
        x, y = member_curve(geometry, member, motion, scale)[-2 if side else 1]
        filled = COLORS[rank - 1] if one.rotation is not None else "white"
        edge = MEAN if one.rotation is not None else COLORS[rank - 1]
        axis.plot(x, y, marker="o", ls="none", ms=SIZES[rank - 1], mfc=filled, mec=edge, mew=0.5, zorder=3)
    return found


def _draw_bases(axis: Axes, geometry: Geometry, motion: np.ndarray, scale: float) -> None:
    """An isolated base, or the supports, and the ground."""
    places = np.array(list(geometry.nodes.values()))
    moved = places + scale * motion[:, :2]
    edge = (4.0 * BELOW if geometry.base else 2.0 * SIGN) * geometry.size
    if geometry.base:
        axis.plot(*moved[list(geometry.base)].T, color=MEAN, lw=2.4, zorder=1.4)
    for support in geometry.supports:
        axis.plot(*moved[support.node], marker=SUPPORTS[support.kind], ms=5.0, mfc="white", mec=MEAN, mew=0.7, zorder=2)
    ends = (places[:, 0].min() - edge, places[:, 0].max() + edge)
    axis.plot(ends, (geometry.ground, geometry.ground), color=MEAN, lw=0.8, zorder=1.0)


def _line(
    start: Hung, end: Hung, motion: np.ndarray, scale: float, span: tuple[float, float]
) -> tuple[list[float], list[float]]:
    ends = [hung_place(point, motion, scale) for point in (start, end)]
    places = [ends[0] + share * (ends[1] - ends[0]) for share in span]
    return [float(place[0]) for place in places], [float(place[1]) for place in places]


def hung_place(point: Hung, motion: np.ndarray, scale: float) -> np.ndarray:
    """Return where a point that hangs on nodes is drawn, (2 or 3,) m.

    Args:
        motion: of the nodes, as that of `member_curve`.
        scale: how many times larger displacements are drawn.
    """
    if point.nodes == GROUND:
        return np.array(point.at)
    first, second = (motion[i, : len(point.at)] for i in point.nodes)
    return np.array(point.at) + scale * ((1.0 - point.share) * first + point.share * second)


def motion_caption(scene: Scene) -> str:
    """Return the record, the scale and the largest drifts of a scene in sentences."""
    many = ""
    if scene.of > 1:
        kept = f" and of the {scene.among} kept in most detail" if scene.among < scene.of else ""
        which = "motions" if scene.in_space else "records"  # of a building also angles and places of the masses
        many = f", of {scene.of} {which}{kept} the one nearest to the mean peak drift"
    drifts = [f"{_largest_drift(one)}{f' ({one.title})' * bool(one.title)}" for one in scene.variants]
    sentences = [
        f"Motion of the {'building' if scene.in_space else 'frame'}, {scene.record}{at_level(scene.level)}{many}",
        f"The still is at {plain(float(scene.time[scene.peak]))} s, near the largest drift. Displacements are drawn "
        f"{fitting_scale(scene)} times as large as they are",
        f"Largest storey drift, mean over the column lines: {', '.join(drifts)}",
    ]
    if all(one.nodes is not None for one in scene.variants):
        sentences.append("Members are cubics through their nodes as computed, gravity included")
    else:
        turn = ", and turn with their floor" if scene.in_space else ""
        sentences.append(
            "Only floors were kept over time: joints are drawn without rotation and without vertical displacement"
            + turn
        )
    if any(one.ends and one.rotation is None for one in scene.variants):
        sentences.append(
            "When hinges form was not kept, as it is with histories: [motion] in the outputs. Rings mark the ends that "
            "yield at any time, by their largest rotation"
        )
    return "".join(f"{sentence}. " for sentence in sentences).strip()


def _largest_drift(one: Moving) -> str:
    """The largest storey drift of a variant in per cent, of a building along x and y."""
    largest = np.maximum(one.drift_max[-1], -one.drift_min[-1])
    if not one.geometry.in_space:
        return f"{plain(100.0 * float(largest.max()))} %"
    along_x, along_y = (plain(100.0 * float(value)) for value in largest.max(axis=0))
    return f"{along_x} % along x and {along_y} % along y"
