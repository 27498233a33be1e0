"""Loops of dampers in frames: force against deformation, a panel for each storey."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import (
    MEAN,
    TARGET,
    VARIANTS,
    grid_figure,
    label_outer,
    legend_below,
    legend_label,
    styled,
)
from edesign.report.response.histories import by_temperature, histories, names_of, variant_colors, with_results

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = (5, 4, 3)
MOST = 24
"""Storeys in one figure; of more, those with the largest deformation."""
STOREY = "storey "
WARM = (VARIANTS[0], VARIANTS[3], VARIANTS[2])  # at further temperatures


@dataclass(frozen=True)
class Loops:
    """Dampers of one history.

    Attributes:
        label: of the history among others in the figure.
        group: has damper_force (time, damper) N, damper_deformation (time, damper) m, damper_storey (damper,), and
            where they are known damper_layer_thickness m and damper_tested_strain.
        color: of its lines.
    """

    label: str
    group: Group
    color: str

    def of_panel(self, title: str) -> list[int]:
        """Return the positions of the dampers of a panel."""
        return [i for i, name in enumerate(_panel_titles(self.group)) if name == title]

    def along(self, name: str) -> np.ndarray:
        """Return a variable over dampers; nan where it is not known."""
        variable = self.group.variables.get(name)
        count = self.group.coords["damper"].values.size
        return np.full(count, np.nan) if variable is None else np.asarray(variable.values, dtype=float)


def damper_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the loops of every history whose dampers were kept over time (`outputs.histories: [dampers]`).

    The same history at several temperatures is one figure: name of the file, caption, figure.
    """
    colors = variant_colors(archive)
    for (variant, level, record), chosen in by_temperature(histories(archive)).items():
        own = colors[variant]
        series = (own, *(color for color in WARM if color != own))
        found = [
            Loops(history.temperature_label, group, series[i % len(series)])
            for i, (history, group) in enumerate(with_results(archive, chosen, "damper_force", "damper_deformation"))
        ]
        if found:
            who = f"{variant}, " if variant else ""
            about = f"Dampers: force against deformation, {who}{chosen[0].motion}{at_level(level)}. {_numbers(found)}"
            yield file_name("loops", variant, level, record), about, loops_figure(found)


@styled
def loops_figure(histories: Sequence[Loops]) -> Figure:
    """Draw loops as Figs. 5.48 and 5.59 of the thesis: dampers of a storey together, all panels in one scale.

    Where all layers are as thick as each other, the strain stands at the top; dashed lines mark the strain up to which
    the law was tested.

    Args:
        histories: at least one; they are overlaid in the panel of the same storey.
    """
    from matplotlib.lines import Line2D

    titles = _shown(histories)
    columns = _columns(len(titles))
    figure, cells = grid_figure(len(titles), columns, min(6.7 / columns, 2.2), 1.5)
    span = 1.05e3 * max(float(np.max(np.abs(one.group.variables["damper_deformation"].values))) for one in histories)
    tallest = 1.08e-3 * max(float(np.max(np.abs(one.group.variables["damper_force"].values))) for one in histories)
    limit = _common([one.along("damper_tested_strain") * one.along("damper_layer_thickness") for one in histories])
    thickness = _common([one.along("damper_layer_thickness") for one in histories])
    for place, (axis, title) in enumerate(zip(cells, titles, strict=True)):
        for one in histories:
            for k, i in enumerate(one.of_panel(title)):
                deformation = 1e3 * one.group.variables["damper_deformation"].values[:, i]
                force = 1e-3 * one.group.variables["damper_force"].values[:, i]
                axis.plot(deformation, force, color=one.color, lw=0.6, alpha=1.0 if k == 0 else 0.5)
        axis.set_xlim(-(span or 1.0), span or 1.0)
        axis.set_ylim(-(tallest or 1.0), tallest or 1.0)
        axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
        axis.axvline(0.0, color=MEAN, lw=0.4, zorder=0.9)
        for side in (-1.0, 1.0):
            if np.isfinite(limit) and 1e3 * limit < span:
                axis.axvline(side * 1e3 * limit, color=TARGET, lw=0.8, ls="--")
        top = place < columns and bool(np.isfinite(thickness))
        if top:
            _strain_axis(axis, 1e3 * thickness)
        box = {"boxstyle": "square,pad=0.15", "fc": "white", "ec": "none"}
        place_of: Any = {"xycoords": "axes fraction", "textcoords": "offset points", "ha": "right", "bbox": box}
        axis.annotate(title, (1.0, 0.0), (-3.0, 4.0), **place_of)  # loops leave this corner free
    label_outer(cells, columns, "deformation (mm)", "force (kN)")
    handles = [
        Line2D([], [], color=one.color, lw=1.2, label=legend_label(one.label))
        for one in histories
        if len(histories) > 1
    ]
    if np.isfinite(limit) and 1e3 * limit < span:
        strain = _common([one.along("damper_tested_strain") for one in histories])
        label = f"tested to a strain of {100.0 * strain:g} %" if np.isfinite(strain) else "tested"
        handles.append(Line2D([], [], color=TARGET, lw=0.8, ls="--", label=label))
    if handles:
        legend_below(figure, handles, most=min(len(handles), 3))
    return figure


def _columns(panels: int) -> int:
    """Panels in a row: as many as leave the fewest places empty."""
    return min((min(columns, panels) for columns in COLUMNS), key=lambda columns: -panels % columns)


def _panel_titles(group: Group) -> list[str]:
    """Return the panel of each damper of a history: its storey, or its name where it has none."""
    names = names_of(group, "damper")
    storeys = group.variables.get("damper_storey")
    if storeys is None:
        return names
    return [f"{STOREY}{int(storey)}" if storey else name for storey, name in zip(storeys.values, names, strict=True)]


def _shown(histories: Sequence[Loops]) -> list[str]:
    """Titles of the panels from the lowest storey; of too many those with the largest deformations."""
    largest: dict[str, float] = {}
    for one in histories:
        peaks = np.max(np.abs(one.group.variables["damper_deformation"].values), axis=0)
        for title, peak in zip(_panel_titles(one.group), peaks, strict=True):
            largest[title] = max(largest.get(title, 0.0), float(peak))
    chosen = sorted(largest, key=lambda title: -largest[title])[:MOST]
    storeys = sorted((title for title in chosen if title.startswith(STOREY)), key=lambda t: int(t.removeprefix(STOREY)))
    return storeys + [title for title in largest if title in chosen and title not in storeys]


def _common(values: Sequence[np.ndarray]) -> float:
    """The value that all dampers share; not a number if they differ."""
    together = np.concatenate(values)
    return float(together[0]) if np.allclose(together, together[0], rtol=1e-6) else float("nan")


def _strain_axis(axis: Axes, thickness: float) -> None:
    """Give a panel the strain at its top; `thickness` of a layer in the unit of its abscissa."""
    factor = 100.0 / thickness
    top = axis.secondary_xaxis("top", functions=(lambda u: np.asarray(u) * factor, lambda s: np.asarray(s) / factor))
    top.set_xlabel("strain (%)")


def _numbers(histories: Sequence[Loops]) -> str:
    texts = []
    for one in histories:
        variables = one.group.variables
        deformation = np.max(np.abs(variables["damper_deformation"].values), axis=0)
        force = float(np.max(np.abs(variables["damper_force"].values)))
        worst = int(np.argmax(deformation))
        thickness = float(one.along("damper_layer_thickness")[worst])
        strain = f", a strain of {plain(100.0 * float(deformation[worst]) / thickness)} %" if thickness > 0.0 else ""
        text = f"{plain(1e3 * float(deformation[worst]))} mm{strain} ({names_of(one.group, 'damper')[worst]})"
        label = f"{one.label}: " if len(histories) > 1 else ""
        texts.append(f"{label}{text} and {plain(1e-3 * force)} kN")
    return f"Largest values: {'; '.join(texts)}."
