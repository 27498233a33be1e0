"""Mode shapes of the variants of a frame."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.reader import Archive
from edesign.report.drawing.captions import plain
from edesign.report.drawing.panels import LINE
from edesign.report.drawing.style import BESIDE, MEAN, VARIANTS, legend_label, new_figure, some_of, styled
from edesign.report.drawing.text_size import text_size
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import variant_colors
from edesign.study.results.kinds import ANALYSES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 4  # modes in a figure
_STYLES = ("-", "--", "-.", ":")
FLOOR, TALLEST = 0.45, 5.5  # inches of a storey, and of the panels at most
PERIOD = 7.5  # points, of the periods above a mode


@dataclass(frozen=True)
class Shapes:
    """Modes of one structure.

    Attributes:
        label: its name.
        period: (modes,), s.
        shape: (modes, floors) over the largest displacement of a floor, from the base up, which moves only if it is
            isolated.
        color: of its lines.
    """

    label: str
    period: np.ndarray
    shape: np.ndarray
    color: str


@in_each_direction
def mode_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the first modes of all variants, overlaid.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    found: dict[str, Shapes] = {}
    for name in archive.names(ANALYSES):
        place = f"{ANALYSES}/{name}"
        about = archive.group_attributes(place)
        if about.get("kind") != "modal" or about.get("status") != "completed":
            continue
        variables = archive.view(place).variables
        variant = str(about.get("variant") or "")
        if "floor_shape" in variables and (variant or name) not in found:  # of several of a variant the first
            color = colors[variant] if variant else VARIANTS[len(found) % len(VARIANTS)]
            floors = variables["floor_shape"].values
            base = variables["base_shape"].values if "base_shape" in variables else np.zeros(floors.shape[0])
            shape = np.column_stack((base, floors))
            if "effective_mass_ratio_y" not in variables:  # of a building the largest may be in the other direction
                shape /= np.max(np.abs(shape), axis=1, keepdims=True)
            shapes = Shapes(variant or name, variables["period"].values, shape, color)
            found[shapes.label] = shapes
    same = [one for one in found.values() if one.shape.shape[1] == next(iter(found.values())).shape.shape[1]]
    if same:
        periods = "; ".join(f"{one.label} {', '.join(plain(float(t)) for t in one.period[:MOST])} s" for one in same)
        yield (
            "modes",
            f"Mode shapes, floors' horizontal displacements over their largest. Periods: {periods}.",
            (mode_figure(same)),
        )


@styled
def mode_figure(structures: Sequence[Shapes]) -> Figure:
    """Draw mode shapes, a panel for each mode with the structures overlaid and their periods below its title.

    Args:
        structures: at least one, all with the same number of floors.
    """
    count = min(MOST, max(one.period.size for one in structures))
    periods = [f"{one.label} {plain(float(period))} s" for one in structures for period in one.period[:count]]
    wide = max(min(2.6, (LINE - 0.6) / count), BESIDE + max(text_size(words, PERIOD)[0] for words in periods))
    high = min(TALLEST, max(3.3, FLOOR * (structures[0].shape.shape[1] - 1)))
    figure, (cells,) = new_figure(1, count, 0.6 + wide * count, 0.7 + high + 0.14 * len(structures))
    for mode, axis in enumerate(cells):
        floors = np.arange(structures[0].shape.shape[1])
        axis.axvline(0.0, color=MEAN, lw=0.6)
        for i, one in enumerate(structures):
            if mode >= one.period.size:
                continue
            shape = one.shape[mode]
            shape = -shape if shape[-1] < 0.0 else shape  # the roof to the right
            style: Any = {"color": one.color, "lw": 1.5, "ls": _STYLES[i % len(_STYLES)], "marker": "o", "ms": 2.4}
            axis.plot(shape, floors, label=legend_label(one.label), **style)
            above = 4.0 + 9.5 * (len(structures) - 1 - i)
            text = f"{one.label} {plain(float(one.period[mode]))} s"
            axis.annotate(
                text, (0.0, 1.0), (0.0, above), "axes fraction", "offset points", color=one.color, fontsize=PERIOD
            )
        axis.set_title(f"mode {mode + 1}", loc="left", pad=6.0 + 9.5 * len(structures))
        axis.set_xlim(-1.15, 1.15)
        axis.set_xticks((-1.0, 0.0, 1.0))
        axis.set_ylim(0.0, floors[-1] + 0.4)
        axis.set_yticks(some_of(floors))
        if mode:
            axis.tick_params(labelleft=False)
    cells[0].set_ylabel("floor")
    figure.supxlabel("shape, largest value 1", fontsize=8.0)
    return figure
