"""Axial forces of columns over the height of each column line."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.changes import EQUILIBRIUM
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, grid_figure, label_outer, legend_below, legend_label, some_of, styled
from edesign.report.response.histories import (
    History,
    by_level,
    histories,
    missing_text,
    names_of,
    variant_colors,
    with_results,
    worst_counts,
    worst_of_motions,
)
from edesign.study.results.kinds import ANALYSES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORCE = "column_axial_force"
COLUMNS = 4
MOST, FIRST = 12, 8
"""Column lines of a figure; of more than `MOST` so many are shown first: two rows, which stand on half a sheet."""
STOREY = 0.3  # inches, of a panel at least
PITCH = 0.72  # of a storey, over which its bars are spread
Place = tuple[str, int]  # line, storey


@dataclass(frozen=True)
class AxialForces:
    """Axial forces of one variant, tension positive, N, by line and storey.

    Attributes:
        label: its name.
        smallest, largest: of each record.
        color: of its bars.
    """

    label: str
    smallest: Mapping[Place, np.ndarray]
    largest: Mapping[Place, np.ndarray]
    color: str


def axial_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the axial forces at every level, variants side by side.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    gravity = _gravity_forces(archive)
    for level, variants in by_level(histories(archive)).items():
        found, counts = [], ""
        for variant, chosen in variants.items():
            read = dict(with_results(archive, chosen, f"{FORCE}_max"))
            if read:
                color = colors[variant]
                found.append(AxialForces(variant, _by_place(read, "min"), _by_place(read, "max"), color))
                counts = worst_counts(read) or counts
        if found:
            missing = missing_text(history for chosen in variants.values() for history in chosen)
            caption = (
                f"Axial forces of the columns{at_level(level)}, tension positive, gravity included. {_numbers(found)}"
            )
            first, others = _lines(found)
            which = f" The {len(first)} of {len(first) + len(others)} lines whose forces differ most." if others else ""
            yield file_name("axial", level), f"{caption}{which}{counts}{missing}", axial_figure(found, gravity, first)
            for number, start in enumerate(range(0, len(others), MOST), 1):
                lines = others[start : start + MOST]
                said = f"Axial forces of the columns{at_level(level)}, lines {', '.join(lines)}."
                yield file_name("axial", level, f"others{number}"), said, axial_figure(found, gravity, lines)


def _lines(variants: Sequence[AxialForces]) -> tuple[list[str], list[str]]:
    """The column lines that are shown first, those with the widest range of forces of many, and the others."""
    lines = list(dict.fromkeys(line for line, _ in variants[0].smallest))
    if len(lines) <= MOST:
        return lines, []
    ranges = dict.fromkeys(lines, 0.0)
    for one in variants:
        for place, values in one.smallest.items():
            width = float(np.mean(one.largest[place]) - np.mean(values))
            ranges[place[0]] = max(ranges[place[0]], width)
    first = sorted(lines, key=lambda line: -ranges[line])[:FIRST]
    return [line for line in lines if line in first], [line for line in lines if line not in first]


def _gravity_forces(archive: Archive) -> dict[Place, float]:
    """Return the axial forces of the columns in the archive's first gravity analysis, N; {} if there is none."""
    for name in archive.names(ANALYSES):
        if archive.group_attributes(f"{ANALYSES}/{name}").get("kind") == "gravity":
            group = archive.view(f"{ANALYSES}/{name}")
            if f"{FORCE}_final" in group.variables:
                values = group.variables[f"{FORCE}_final"].values
                return {_place(n): float(v) for n, v in zip(names_of(group, "column"), values, strict=True)}
    return {}


@styled
def axial_figure(variants: Sequence[AxialForces], gravity: Mapping[Place, float], lines: Sequence[str] = ()) -> Figure:
    """Draw the range of the axial force of each column: the mean over records as a bar, the extremes as a thin line.

    Args:
        variants: at least one.
        gravity: axial forces that are marked, N; may be empty.
        lines: that are shown; (): all.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    places = list(variants[0].smallest)
    lines = lines or list(dict.fromkeys(line for line, _ in places))
    storeys = sorted({storey for _, storey in places})
    high = min(3.1, max(2.0, STOREY * len(storeys)))
    figure, cells = grid_figure(len(lines), COLUMNS, 1.6, high)
    thick = PITCH / len(variants)
    low = min(float(np.min(values)) for one in variants for values in one.smallest.values())
    most = max(float(np.max(values)) for one in variants for values in one.largest.values())
    margin = 0.04e-3 * (most - low) or 1.0
    for axis, line in zip(cells, lines, strict=True):
        axis.axvline(0.0, color=MEAN, lw=0.6, zorder=0.9)
        for place in (one for one in places if one[0] == line):
            for i, one in enumerate(variants):
                y = place[1] + PITCH * (0.5 - (i + 0.5) / len(variants))
                if place not in one.smallest:
                    continue
                smallest, largest = 1e-3 * one.smallest[place], 1e-3 * one.largest[place]
                start, end = float(np.mean(smallest)), float(np.mean(largest))
                axis.plot((np.min(smallest), np.max(largest)), (y, y), color=one.color, lw=0.9)
                axis.barh(y, end - start, 0.86 * thick, start, color=one.color, lw=0.0)
            if place in gravity:
                level = 1e-3 * gravity[place]
                axis.plot((level, level), (place[1] - 0.45, place[1] + 0.45), color=MEAN, lw=1.3)
        axis.set_title(f"line {line}", loc="left")
        axis.set_xlim(1e-3 * low - margin, max(1e-3 * most, 0.0) + margin)
        axis.set_ylim(storeys[0] - 0.6, storeys[-1] + 0.6)
        axis.set_yticks(some_of(storeys))
        axis.locator_params(axis="x", nbins=4)
        axis.grid(axis="y", visible=False)
    label_outer(cells, COLUMNS, "axial force (kN)", "storey")
    many = max(next(iter(one.smallest.values())).size for one in variants) > 1
    handles: list[Line2D | Patch] = [
        Patch(color=one.color, lw=0.0, label=legend_label(one.label)) for one in variants if one.label
    ]
    if many:
        handles.append(Line2D([], [], color=MEAN, lw=0.9, label="range over the records"))
    if gravity:
        handles.append(Line2D([], [], color=MEAN, lw=1.3, marker="|", ms=9.0, ls="none", mew=1.3, label="gravity"))
    if handles:
        legend_below(figure, handles, [str(handle.get_label()) for handle in handles], len(handles))
    return figure


def _by_place(read: Mapping[History, Group], which: str) -> dict[Place, np.ndarray]:
    """`min` or `max` of every column under every motion."""
    each = [group.variables[f"{FORCE}_{which}"].values for group in read.values()]
    table = worst_of_motions(read, each, np.min if which == "min" else np.max)
    return {_place(name): table[:, i] for i, name in enumerate(names_of(next(iter(read.values())), "column"))}


def _place(name: str) -> Place:
    """Line and storey of a column such as C_B_1."""
    _, line, storey = name.split("_")
    return line, int(storey)


def _numbers(variants: Sequence[AxialForces]) -> str:
    texts = []
    for one in variants:
        worst = min(one.smallest, key=lambda place: float(np.mean(one.smallest[place])))
        force, most = float(np.mean(one.smallest[worst])), float(np.min(one.smallest[worst]))
        where = f"line {worst[0]}, storey {worst[1]}"
        count = one.smallest[worst].size
        text = f"largest compression {plain(-1e-3 * force)} kN ({where})"
        text += f", mean of {count} records, in one record {plain(-1e-3 * most)} kN" if count > 1 else ""
        pulled = max(one.largest, key=lambda place: float(np.max(one.largest[place])))
        tension = float(np.max(one.largest[pulled]))
        if tension > EQUILIBRIUM * -most:
            text += f"; largest tension {plain(1e-3 * tension)} kN (line {pulled[0]}, storey {pulled[1]})"
        texts.append(f"{one.label}: {text}" if one.label else text)
    return f"{'; '.join(texts)}."
