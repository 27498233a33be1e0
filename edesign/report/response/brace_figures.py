"""Axial force against elongation of recorded braces that buckle."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import AFTER, MEAN, TARGET, grid_figure, label_outer, styled
from edesign.report.response.histories import ANALYSES, names_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORCE, ELONGATION = "recorded_brace_axial_force", "recorded_brace_elongation"
MOST = 12
"""Braces in one figure; of more, those with the largest elongation or shortening."""
COLUMNS = 3


def brace_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the loops of each analysis that recorded braces that buckle.

    Yields:
        Name of the file, caption and figure.
    """
    for name in archive.names(ANALYSES):
        about = archive.group_attributes(f"{ANALYSES}/{name}")
        if about.get("incremental") or about.get("kind") not in ("history", "pushover"):
            continue
        group = archive.group(f"{ANALYSES}/{name}")
        if FORCE in group.variables:
            caption = f"Braces that buckle: axial force against elongation, {name}. {_numbers(group)}"
            yield file_name("braces", name), caption, brace_figure(group)


@styled
def brace_figure(group: Group) -> Figure:
    """Draw the loops of the recorded braces, a panel each, all in one scale; dashed: elongation of first yield.

    Args:
        group: with what `outputs.members` records of braces that buckle.
    """
    names, force, elongation = _loops(group)
    largest = np.max(np.abs(elongation), axis=0)
    shown = sorted(np.argsort(-largest, kind="stable")[:MOST])
    columns = min(COLUMNS, len(shown))
    figure, cells = grid_figure(len(shown), columns, min(6.7 / columns, 3.4), 2.0)
    span, tallest = 1.06e3 * largest.max() or 1.0, 1.08e-3 * np.max(np.abs(force)) or 1.0
    yields = _yields(group)
    for axis, i in zip(cells, shown, strict=True):
        axis.axhline(0.0, color=MEAN, lw=0.4, zorder=0.9)
        axis.axvline(0.0, color=MEAN, lw=0.4, zorder=0.9)
        for side in (-1.0, 1.0):
            if 1e3 * yields.get(names[i], np.inf) < span:
                axis.axvline(side * 1e3 * yields[names[i]], color=TARGET, lw=0.8, ls="--")
        axis.plot(1e3 * elongation[:, i], 1e-3 * force[:, i], color=AFTER, lw=0.7)
        axis.set_xlim(-span, span)
        axis.set_ylim(-tallest, tallest)
        axis.set_title(names[i], loc="left")
    label_outer(cells, columns, "elongation (mm)", "axial force (kN)")
    return figure


def _loops(group: Group) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Names (n,), forces (nt, n) N and elongations (nt, n) m of the recorded braces."""
    force, elongation = (np.asarray(group.variables[name].values, dtype=float) for name in (FORCE, ELONGATION))
    return names_of(group, "recorded_brace"), force, elongation


def _yields(group: Group) -> dict[str, float]:
    """Elongation of first yield of the braces, m, by name."""
    stored = group.variables.get("brace_yield_elongation")
    return {} if stored is None else dict(zip(names_of(group, "buckling_brace"), stored.values.tolist(), strict=True))


def _numbers(group: Group) -> str:
    names, force, elongation = _loops(group)
    parts = []
    for what, values, unit, scale in (("compression", -force, "kN", 1e-3), ("shortening", -elongation, "mm", 1e3)):
        worst = int(np.argmax(values.max(axis=0)))
        parts.append(f"{what} {plain(scale * float(values[:, worst].max()))} {unit} ({names[worst]})")
    return f"Largest {' and '.join(parts)}."
