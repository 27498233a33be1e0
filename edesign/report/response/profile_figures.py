"""Peaks over the height of a frame: every record, their mean and 84th percentile, a panel for each variant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.envelopes import peak, residual
from edesign.assess.statistics import FRACTION, counted_percentile
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, RECORDS, grid_figure, label_outer, legend_below, some_of, styled
from edesign.report.response.directions import in_each_direction
from edesign.report.response.histories import (
    History,
    by_level,
    counted,
    histories,
    missing_text,
    variant_colors,
    worst_counts,
    worst_of_motions,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMNS = 3
_MANY: Any = {"color": RECORDS, "lw": 0.6}
_WORST: Any = {"color": "#55595f", "lw": 0.9, "ls": "-."}
_MEAN: Any = {"lw": 2.0, "marker": "o", "ms": 2.6}
_HIGH: Any = {"lw": 1.2, "ls": "--"}


@dataclass(frozen=True)
class Kind:
    """A quantity over the height.

    Attributes:
        title: in words.
        unit: of the figure.
        factor: from SI to it.
        ordinate: "floor" or "storey".
        base: attribute of a history with the value at the base; None: no value there; "": zero. That of an isolated
            base is its own.
        limits: of performance levels by name, SI.
    """

    title: str
    unit: str
    factor: float
    ordinate: str
    base: str | None = None
    limits: Mapping[str, float] = field(default_factory=dict)


# limits: FEMA 356, Table C1-3, steel moment frames; the thesis' Table 5.5
KINDS = {
    "floor_displacement": Kind("floor displacement", "mm", 1e3, "floor", ""),
    "storey_drift": Kind("interstorey drift", "%", 1e2, "storey", None, {"IO": 0.007, "LS": 0.025, "CP": 0.05}),
    "residual_floor_displacement": Kind("residual floor displacement", "mm", 1e3, "floor", ""),
    "residual_storey_drift": Kind("residual interstorey drift", "%", 1e2, "storey", None, {"LS": 0.01, "CP": 0.05}),
    "floor_acceleration": Kind("floor acceleration", "m/s²", 1.0, "floor", "input_pga_m_s2"),
    "storey_shear": Kind("storey shear", "kN", 1e-3, "storey"),
}
DAMPERS, TOTAL = "storey_damper_force", "total"


@dataclass(frozen=True)
class Profiles:
    """The content of one panel.

    Attributes:
        title: of the panel.
        histories: of its values.
        profiles: (floors or storeys,) of each of them, from the bottom, in the unit of the figure; of floors the first
            may be the base.
        color: of mean and percentile.
    """

    title: str
    histories: tuple[History, ...]
    profiles: tuple[np.ndarray, ...]
    color: str

    @property
    def values(self) -> dict[str, np.ndarray]:
        """The profiles by what their histories are called."""
        return {history.motion: one for history, one in zip(self.histories, self.profiles, strict=True)}

    @property
    def of_motions(self) -> np.ndarray:
        """(motions, floors or storeys): what means are of."""
        return worst_of_motions(self.histories, self.profiles)


@in_each_direction
def profile_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the profiles of all histories of each hazard level, by quantity.

    Yields:
        Name of the file, caption and figure.
    """
    colors = variant_colors(archive)
    for level, variants in by_level(histories(archive)).items():
        read = {variant: [(h, h.read(archive)) for h in found if h.completed] for variant, found in variants.items()}
        missing = missing_text(history for found in variants.values() for history in found)
        for quantity, kind in KINDS.items():
            panels = [
                Profiles(title, tuple(values), tuple(values.values()), colors[variant])
                for variant, found in read.items()
                for title, values in _panels(quantity, kind, variant, found)
            ]
            if panels and next(iter(panels[0].values.values())).size > 1:  # one storey has no profile
                counts = worst_counts(history for found in read.values() for history, _ in found)
                numbers = f"{_numbers(panels, kind)}{counts}{missing}"
                caption = f"Peak {kind.title} over the height{at_level(level)}. {numbers}"
                if quantity.startswith("residual"):
                    caption = caption.replace("Peak r", "R", 1)
                yield file_name("profile", quantity, level), caption, profile_figure(panels, kind)


def _panels(
    quantity: str, kind: Kind, variant: str, found: Sequence[tuple[History, Group]]
) -> Iterator[tuple[str, dict[History, np.ndarray]]]:
    """Title and histories of the panels of a variant; of the shear also with the forces of its dampers."""
    parts = [(quantity, variant)]
    if quantity == "storey_shear" and any(np.any(peak(group, DAMPERS)) for _, group in found):
        both = all(DAMPERS in group.variables and quantity in group.variables for _, group in found)
        other = (TOTAL, "columns and dampers") if both else (DAMPERS, "dampers")
        parts = [(name, f"{variant}: {part}".strip(": ")) for name, part in ((quantity, "columns"), other)]
    for name, title in parts:
        values = {history: profile(group, name, kind) for history, group in found}
        there = {history: one for history, one in values.items() if one is not None}
        if there:
            yield title, there


def with_dampers(group: Group) -> bool:
    """Return whether dampers had forces in some storey of a history that kept the shears over time."""
    return bool(np.any(peak(group, DAMPERS))) and all(n in group.variables for n in (DAMPERS, "storey_shear"))


def profile(group: Group, quantity: str, kind: Kind) -> np.ndarray | None:
    """Return the peaks of a history over the height in the unit of a figure, None if it has no such quantity.

    Args:
        quantity: of `KINDS`, `DAMPERS`, or `TOTAL`, the shear of columns and dampers at one moment.

    Returns:
        (floors or storeys,) from the bottom; of floors the first is the base.
    """
    if quantity == TOTAL:  # at one moment: the extremes of both do not add up
        total = group.variables["storey_shear"].values + group.variables[DAMPERS].values
        return np.asarray(kind.factor * np.max(np.abs(total), axis=0))
    name = quantity.removeprefix("residual_")
    found = residual(group, name) if name != quantity else peak(group, quantity)
    if found is None:
        return None
    if kind.base is not None:
        base = float(str(group.attributes[kind.base])) if kind.base else 0.0
        if group.attributes.get("isolated"):
            of_base = name.replace("floor_", "base_")
            own = residual(group, of_base) if name != quantity else peak(group, of_base)
            base = base if own is None else float(own)
        found = np.concatenate(([base], found))
    return kind.factor * found


@styled
def profile_figure(panels: Sequence[Profiles], kind: Kind) -> Figure:
    """Draw profiles as Figs. 5.17 to 5.22 of the thesis: records thin, their mean bold, the 84th percentile dashed.

    Args:
        panels: at least one, all on the same scales; the record with the largest value of each is named.
    """
    from matplotlib.lines import Line2D

    figure, cells = grid_figure(len(panels), COLUMNS, 2.35 if len(panels) > 1 else 3.6, 3.1)
    largest = max(float(np.max(profile)) for panel in panels for profile in panel.values.values())
    limits = {name: kind.factor * value for name, value in kind.limits.items()}
    for axis, panel in zip(cells, panels, strict=True):
        _draw(axis, panel, kind, limits, 1.08 * largest or 1.0)
    label_outer(cells, COLUMNS, f"{kind.title} ({kind.unit})", kind.ordinate)
    one = "history" if any(len(panel.of_motions) < len(panel.profiles) for panel in panels) else "record"
    handles = [
        Line2D([], [], **_MANY, label=one),
        Line2D([], [], **_WORST, label=f"{one} with the largest value"),
        Line2D([], [], **_MEAN, color=MEAN, label="mean"),
        Line2D([], [], **_HIGH, color=MEAN, label="84th percentile"),
    ]
    if any(len(panel.values) > 1 for panel in panels):
        legend_below(figure, handles, most=4 if len(panels) > 1 else 2)
    return figure


def _draw(axis: Axes, panel: Profiles, kind: Kind, limits: Mapping[str, float], span: float) -> None:
    values = list(panel.values.values())
    count = values[0].size
    first = 0 if kind.base is not None else 1
    height = np.arange(first, first + count)
    governing = max(panel.values, key=lambda name: float(np.max(panel.values[name])))
    if len(values) > 1:
        for name, profile in panel.values.items():
            if name != governing:
                axis.plot(profile, height, **_MANY)
        axis.plot(panel.values[governing], height, **_WORST)
    if len(panel.of_motions) > 1:
        high = [counted_percentile(list(at), FRACTION) for at in panel.of_motions.T]
        axis.plot(high, height, **_HIGH, color=panel.color)
    axis.plot(panel.of_motions.mean(axis=0), height, **_MEAN, color=panel.color)
    axis.set_xlim(0.0, span)
    axis.set_ylim(height[0] - (0.0 if first == 0 else 0.4), height[-1] + 0.4)
    axis.set_yticks(some_of(height))
    for name, limit in limits.items():
        if limit < span:
            axis.axvline(limit, color=MEAN, lw=0.7, ls=":")
            axis.text(limit, 1.0, name, transform=axis.get_xaxis_transform(), ha="center", va="bottom", fontsize=7.0)
    above = 11.0 if limits else 4.0  # points, over the names of the limits
    text = f"largest: {governing}" if len(values) > 1 else governing
    style = {"textcoords": "offset points", "fontsize": 7.0, "color": _WORST["color"]}
    axis.annotate(text, (0.0, 1.0), (0.0, above), "axes fraction", **style)
    many = counted(panel.histories) if len(values) > 1 else ""
    title = ", ".join(part for part in (panel.title, many) if part)
    axis.set_title(title, loc="left", pad=above + 10.0)


def _numbers(panels: Sequence[Profiles], kind: Kind) -> str:
    """The mean and largest value of each panel in words."""
    texts = []
    for panel in panels:
        values = panel.values
        worst = max(values, key=lambda name: float(np.max(values[name])))
        top = float(np.max(values[worst]))
        mean = float(np.max(panel.of_motions.mean(axis=0)))
        label = f"{panel.title}: " if panel.title else ""
        if len(values) == 1:
            texts.append(f"{label}{plain(top)} {kind.unit} ({worst})")
        else:
            most = f"largest {plain(top)} {kind.unit} ({worst})"
            texts.append(f"{label}mean of {counted(panel.histories)} up to {plain(mean)} {kind.unit}, {most}")
    return f"{'; '.join(texts)}."
