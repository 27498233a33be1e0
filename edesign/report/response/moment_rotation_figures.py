"""Moment against rotation at the ends of recorded members."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, legend_below, legend_label, new_figure, styled
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import by_motion, histories, names_of, variant_colors, with_results

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOMENT = "member_bending_moment"
ROTATIONS = {"member_chord_rotation": "chord rotation", "member_plastic_rotation": "plastic rotation"}
_WIDTHS = (0.8, 0.8, 0.7)  # of the first line, which lies below, and of further ones
NONE = 1e-6  # rad, a rotation that is none


@in_each_direction
def moment_rotation_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the loops of each recorded member in each motion, variants overlaid.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    own = [history for history in histories(archive) if history.temperature is None]
    for (level, record), chosen in by_motion(own).items():
        loops: dict[str, dict[str, tuple[Group, int]]] = {}
        for history, group in with_results(archive, chosen, MOMENT, "member_chord_rotation"):
            for i, member in enumerate(names_of(group, "recorded_member")):
                loops.setdefault(member, {})[history.variant] = group, i
        motion = chosen[0].motion
        for member, variants in loops.items():
            found = {name: _member_loops(group, i) for name, (group, i) in variants.items()}
            if not any(np.any(loop[key]) for loop in found.values() for key in ROTATIONS):
                continue  # a brace
            caption = (
                f"Moment against rotation at both ends of {member} under {motion}{at_level(level)}. {_numbers(found)}"
            )
            figure = moment_rotation_figure(found, colors, ("bottom", "top") if member[0] == "C" else ("left", "right"))
            yield file_name("moment_rotation", member, level, record), caption, figure


def _member_loops(group: Group, member: int) -> dict[str, np.ndarray]:
    """Return moment (N m) and rotations (rad) of a recorded member, each (time, end), by name of the variable.

    Args:
        group: of the history.
        member: number of the member among the recorded ones, from 0.
    """
    there = [name for name in (MOMENT, *ROTATIONS) if name in group.variables]
    found = {name: np.asarray(group.variables[name].values[:, member, :]) for name in there}
    return {name: found.get(name, np.zeros_like(found[MOMENT])) for name in (MOMENT, *ROTATIONS)}


@styled
def moment_rotation_figure(
    loops: Mapping[str, Mapping[str, np.ndarray]], colors: Mapping[str, str], ends: tuple[str, str]
) -> Figure:
    """Draw moments against chord and plastic rotations as Figs. 5.46 and 5.47 of the thesis, all in one scale.

    Args:
        loops: by label, what `_member_loops` gives; the first lies below.
        ends: names of start and end of the member.
    """
    shown = [key for key in ROTATIONS if any(np.max(np.abs(loop[key])) > NONE for loop in loops.values())]
    figure, axes = new_figure(len(shown), 2, 6.3, 0.6 + 2.3 * len(shown))
    tallest = 1.08e-3 * max(float(np.max(np.abs(loop[MOMENT]))) for loop in loops.values())
    for row, key in zip(axes, shown, strict=True):
        span = 1.08e3 * max(float(np.max(np.abs(loop[key]))) for loop in loops.values())
        for end, axis in enumerate(row):
            for i, (label, loop) in enumerate(loops.items()):
                rotation, moment = 1e3 * loop[key][:, end], 1e-3 * loop[MOMENT][:, end]
                in_legend = legend_label(label) or None
                axis.plot(rotation, moment, color=colors[label], lw=_WIDTHS[min(i, 2)], label=in_legend)
            _centre(axis, span, tallest)
            axis.set_xlabel(f"{ROTATIONS[key]} (mrad)")
            axis.set_title(f"{ends[end]} end" if key == shown[0] else "", loc="left")
            if end:
                axis.tick_params(labelleft=False)
        row[0].set_ylabel("moment (kN m)")
    handles, labels = axes[0][0].get_legend_handles_labels()
    if labels:
        legend_below(figure, handles, labels, len(labels))
    return figure


def _centre(axis: Axes, span: float, tallest: float) -> None:
    axis.axhline(0.0, color=MEAN, lw=0.5, zorder=0.9)
    axis.axvline(0.0, color=MEAN, lw=0.5, zorder=0.9)
    axis.set_xlim(-span, span)
    axis.set_ylim(-tallest, tallest)


def _numbers(loops: Mapping[str, Mapping[str, np.ndarray]]) -> str:
    texts = []
    for label, loop in loops.items():
        moment, chord, plastic = (float(np.max(np.abs(loop[key]))) for key in (MOMENT, *ROTATIONS))
        text = f"largest moment {plain(1e-3 * moment)} kN m, chord rotation {plain(1e3 * chord)} mrad"
        text += f", plastic rotation {plain(1e3 * plastic)} mrad" if plastic > NONE else ", no plastic rotation"
        texts.append(f"{label}: {text}" if label else text)
    return f"{'; '.join(texts)}."
