"""Orbits of a building: roof, base shear and isolated base along x against those along y."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, legend_below, legend_label, new_figure, styled
from edesign.report.response.histories import by_motion, histories, missing_text, variant_colors, with_results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PANELS = (
    ("floor_displacement", "roof displacement", "mm", 1e3),
    ("base_shear", "base shear", "kN", 1e-3),
    ("base_displacement", "base displacement", "mm", 1e3),
    ("isolator_displacement", "farthest isolator", "mm", 1e3),
)
Orbits = Mapping[str, np.ndarray]
"""Of each panel by its variable, (nt, 2)."""


def orbit_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the orbits of each motion of a building whose floors, storeys or isolators were kept over time.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    own = [history for history in histories(archive) if history.temperature is None]
    for (level, record), chosen in by_motion(own).items():
        read = with_results(archive, chosen, "ground_acceleration")
        series = [
            (history.variant, colors[history.variant], found) for history, group in read if (found := _orbits(group))
        ]
        if series:
            caption = f"Orbits in plan, {chosen[0].motion}{at_level(level)}. {_numbers(series)}{missing_text(chosen)}"
            yield file_name("orbits", level, record), caption, orbit_figure(series)


def _orbits(group: Group) -> dict[str, np.ndarray]:
    if "direction" not in group.coords:
        return {}
    found = {}
    for name, _, _, factor in _PANELS:
        if name in group.variables:
            values = factor * np.asarray(group.variables[name].values, dtype=float)
            if values.ndim == 3:  # of floors the roof, of isolators the one that moves farthest
                at = -1 if name.startswith("floor") else int(np.hypot(*np.moveaxis(values, -1, 0)).max(axis=0).argmax())
                values = values[:, at]
            found[name] = values
    return found


@styled
def orbit_figure(series: Sequence[tuple[str, str, Orbits]]) -> Figure:
    """Draw orbits in plan, x to the right and y upwards, a panel for each quantity; the farthest points are marked.

    Args:
        series: label, colour and orbits of each variant; the first lies below.
    """
    panels = [panel for panel in _PANELS if any(panel[0] in orbits for _, _, orbits in series)]
    figure, (axes,) = new_figure(1, len(panels), 3.3 * len(panels), 3.5)
    for axis, (name, title, unit, _) in zip(axes, panels, strict=True):
        span = 1.08 * max(float(np.abs(orbits[name]).max()) for _, _, orbits in series if name in orbits) or 1.0
        for label, color, orbits in series:
            if name not in orbits:
                continue
            x, y = orbits[name].T
            far = int(np.argmax(np.hypot(x, y)))
            axis.plot(x, y, color=color, lw=0.7, label=legend_label(label) or None)
            axis.plot(x[far], y[far], marker="o", ms=3.6, mfc=color, mec=MEAN, mew=0.5, ls="none")
        axis.axhline(0.0, color=MEAN, lw=0.5, zorder=0.9)
        axis.axvline(0.0, color=MEAN, lw=0.5, zorder=0.9)
        axis.set_xlim(-span, span)
        axis.set_ylim(-span, span)
        axis.set_aspect("equal")
        axis.set_title(title, loc="left")
        axis.set_xlabel(f"along x ({unit})")
        axis.set_ylabel(f"along y ({unit})")
    handles, labels = axes[0].get_legend_handles_labels()
    if labels:
        legend_below(figure, handles, labels, len(labels))
    return figure


def _numbers(series: Sequence[tuple[str, str, Orbits]]) -> str:
    texts = []
    for label, _, orbits in series:
        parts = []
        for name, title, unit, _ in _PANELS:
            if name in orbits:
                sizes = np.hypot(*orbits[name].T)
                far = int(np.argmax(sizes))
                angle = float(np.degrees(np.arctan2(orbits[name][far, 1], orbits[name][far, 0])))
                parts.append(f"{title} {plain(float(sizes[far]))} {unit} at {angle:.0f}° from x")
        texts.append(f"{label}: {', '.join(parts)}" if label else ", ".join(parts))
    return f"Farthest from the middle: {'; '.join(texts)}."
