"""Figures of pushovers: capacity curves with their events, and the N2 method in accelerations and displacements."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.sets import TARGET
from edesign.codes.spectrum import Spectrum, characteristic_period
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis.pushover import SIDES, WAYS
from edesign.report.archived import archived_building, archived_project
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import (
    BEFORE,
    MEAN,
    VARIANTS,
    grid_figure,
    label_outer,
    legend_below,
    legend_label,
    styled,
)
from edesign.study.results.kinds import ANALYSES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MARKERS = {
    "first yield of a beam": "o",
    "first yield of a column": "s",
    "first hinge in a beam": "^",
    "first hinge in a column": "v",
    "first yield of a panel zone": "D",
    "first yield of a brace": "P",
    "first buckling of a brace": "p",
    "drift of IO": "1",
    "drift of LS": "2",
    "drift of CP": "3",
    "largest base shear": "*",
    "no resistance left": "x",
    "equilibrium lost": "X",
}
"""Of events, by how their names begin."""

DASHES = {1.0: (), -1.0: (4, 1.5)}
"""By the sign of the push: to the right or along its axis, or against it."""
LONGEST = 4.0  # s: EN 1998-1 gives the spectrum up to it, 3.2.2.2(1)P
HIGHEST = 3.0  # spectra are drawn up to this multiple of the demand: the plateau says nothing of flexible frames
_ROUNDING = (
    1e-3  # share of the largest base shear, up to which one below zero is what the equilibrium under gravity left
)
COLUMNS = 3  # of panels, of four panels two


@dataclass(frozen=True)
class Curve:
    """A capacity curve of an archive.

    Attributes:
        variant: "" where it has none.
        label: name of the pushover without that of the variant.
        direction: right or left, of a building x+, x-, y+ or y-.
    """

    variant: str
    label: str
    direction: str
    group: Group

    @property
    def loading(self) -> str:
        """The label without the direction; pushes to both sides share its color. Of a building its axis stays."""
        axis = WAYS[self.direction][0]
        if not axis:
            return self.label.removesuffix(f".{self.direction}")
        return ".".join(axis if part == self.direction else part for part in self.label.split("."))

    @property
    def sign(self) -> float:
        """1 to the right or along the axis, -1 to the other side."""
        return WAYS[self.direction][1]

    @property
    def base_shear(self) -> np.ndarray:
        """Base shear in the direction of the push, (steps,) kN."""
        variable = self.group.variables["base_shear"]
        axis = WAYS[self.direction][0]
        along = (
            variable.values[:, self.group.coords["direction"].values.tolist().index(axis)] if axis else variable.values
        )
        return np.asarray(1e-3 * self.sign * along)


def pushover_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the capacity curves of all variants, and the N2 figure of each variant.

    Yields:
        Name of the file, caption and figure.
    """
    curves: list[Curve] = []
    targets: list[Curve] = []
    for name in archive.names(ANALYSES):
        about = archive.group_attributes(f"{ANALYSES}/{name}")
        if about.get("kind") in ("pushover", TARGET):
            variant = str(about.get("variant") or "")
            label = name.removeprefix(f"{variant}.") if variant else name
            one = Curve(variant, label, str(about.get("direction") or "right"), archive.view(f"{ANALYSES}/{name}"))
            (targets if about.get("kind") == TARGET else curves).append(one)
    curves = [curve for curve in curves if "control_displacement" in curve.group.variables]
    if curves:
        caption = (
            "Capacity curves: base shear against the displacement of the control node since gravity, in the direction "
            "of the push. Marks stand where each event has happened for the first time."
        )
        yield "capacity_curves", caption, capacity_figure(curves)
    file = archived_project(archive) or archived_building(archive)
    found = [one for one in targets if "n2_d_t" in one.group.variables]
    if file is None or file.hazard is None:
        return
    for variant in dict.fromkeys(one.variant for one in found):
        caption = (
            f"N2 method{f', {variant}' if variant else ''}: the equivalent oscillator against the elastic spectra. "
            "Dashed is its idealisation, thin the line of its period T*; points are the target displacements d_t*."
        )
        chosen = [one for one in found if one.variant == variant]
        yield file_name("n2", variant), caption, adrs_figure(file.hazard, chosen)


@styled
def capacity_figure(curves: Sequence[Curve]) -> Figure:
    """Draw capacity curves with their events: of one variant in one axis, of several a panel for each load pattern.

    So the curves of all variants under the same loads stand in one axis.

    Args:
        curves: at least one.
    """
    variants = list(dict.fromkeys(curve.variant for curve in curves))
    loadings = list(dict.fromkeys(curve.loading for curve in curves))
    over = len(variants) > 1
    panels, lines = (loadings, variants) if over else (variants, loadings)
    figure, axes = grid_figure(len(panels), COLUMNS, 3.6 if len(panels) > 1 else 6.0, 3.2)
    happened: dict[str, str] = {}
    drawn: dict[tuple[str, str], str] = {}
    for curve in curves:
        panel, line = (curve.loading, curve.variant) if over else (curve.variant, curve.loading)
        here, color = axes[panels.index(panel)], VARIANTS[lines.index(line) % len(VARIANTS)]
        variables = curve.group.variables
        here.plot(
            1e3 * variables["control_displacement"].values, curve.base_shear, color=color, dashes=DASHES[curve.sign]
        )
        drawn[line, curve.direction] = color
        happened |= _events(here, curve, color)
    for here, panel in zip(axes, panels, strict=True):
        here.set_title(in_words(panel) if over else panel, loc="left")
    right = max(float(1e3 * curve.group.variables["control_displacement"].values[-1]) for curve in curves)
    shears = [curve.base_shear for curve in curves]
    bottom, top = min(float(shear.min()) for shear in shears), max(float(shear.max()) for shear in shears)
    for here in axes:
        here.set_xlim(0.0, 1.03 * right)
        here.set_ylim(1.1 * bottom if bottom < -_ROUNDING * max(top, -bottom) else 0.0, 1.1 * top)
    label_outer(axes, COLUMNS, "displacement of the control node (mm)", "base shear (kN)")
    _legend(figure, drawn, happened, over)
    return figure


def _legend(figure: Figure, drawn: Mapping[tuple[str, str], str], happened: Mapping[str, str], over: bool) -> None:
    """Lines of the curves by what they are and their direction, and marks of the events."""
    from matplotlib.lines import Line2D

    both = len({direction for _, direction in drawn}) > 1
    handles = []
    for (line, direction), color in drawn.items():
        words = line if over else in_words(line)
        label = f"{words}, {SIDES[direction]}" if both else words
        handles.append(Line2D([], [], color=color, dashes=DASHES[WAYS[direction][1]], label=legend_label(label)))
    handles += [
        Line2D([], [], ls="none", marker=marker, color=MEAN, ms=4.5, mfc="none", label=what)
        for what, marker in happened.items()
    ]
    legend_below(figure, handles, most=3)


def in_words(label: str) -> str:
    """Return the name of a part of a pushover as words: push.first_mode.right is push, first mode, to the right."""
    return ", ".join(SIDES.get(part, part.replace("_", " ")) for part in label.split("."))


def _events(here: Axes, curve: Curve, color: str) -> dict[str, str]:
    """Mark the events of a curve; the marker of each by its name."""
    variables = curve.group.variables
    if "capacity_event_what" not in variables:
        return {}
    drawn = {}
    at = (variables[f"capacity_event_{key}"].values.tolist() for key in ("what", "displacement", "base_shear"))
    for what, x, y in zip(*at, strict=True):
        marker = next((marker for start, marker in MARKERS.items() if str(what).startswith(start)), ".")
        here.plot(1e3 * x, 1e-3 * y, ls="none", marker=marker, color=color, ms=5.0, mfc="none", zorder=3)
        drawn[str(what)] = marker
    return drawn


@styled
def adrs_figure(hazard: Hazard, targets: Sequence[Curve]) -> Figure:
    """Draw equivalent oscillators against elastic spectra, acceleration against displacement, a panel for each push.

    Args:
        targets: of the N2 method and one variant, at least one.
    """
    from matplotlib.lines import Line2D

    pushes: dict[str, list[Curve]] = {}
    for one in targets:
        pushes.setdefault(one.label.removesuffix(f".n2.{one.group.attributes.get('level')}"), []).append(one)
    levels = list(dict.fromkeys(str(one.group.attributes.get("level")) for one in targets))
    columns = 2 if len(pushes) == 4 else COLUMNS
    figure, axes = grid_figure(len(pushes), columns, 3.0 if len(pushes) > 1 else 5.0, 2.9)
    right = top = 0.0
    spectra = {str(one.group.attributes["level"]): _spectrum(hazard, one.group) for one in targets}
    for here, (push, chosen) in zip(axes, pushes.items(), strict=True):
        for one in chosen:
            level = str(one.group.attributes["level"])
            color = VARIANTS[levels.index(level) % len(VARIANTS)]
            values = _of_n2(one.group)
            right = max(right, 1.6e3 * max(values["d_t_oscillator"], values["d_et"]))
            plateau = float(spectra[level].acceleration(characteristic_period(spectra[level]) or 0.0))
            top = max(top, min(1.1 * plateau, HIGHEST * max(values["S_e"], values["F_y"] / values["m"])))
            _oscillator(here, one.group, values, color)
            T = np.linspace(0.0, min(LONGEST, spectra[level].last_period), 400)
            here.plot(1e3 * spectra[level].displacement(T), spectra[level].acceleration(T), color=color)
        here.set_title(in_words(push), loc="left")
    for here in axes:
        here.set_xlim(0.0, right)
        here.set_ylim(0.0, top)
    label_outer(axes, columns, "displacement (mm)", "acceleration (m/s²)")
    handles = [
        Line2D([], [], color=VARIANTS[i % len(VARIANTS)], label=legend_label(f"elastic spectrum, {level}"))
        for i, level in enumerate(levels)
    ]
    handles.append(Line2D([], [], color=MEAN, lw=1.3, label="oscillator, F*/m* against d*"))
    handles.append(Line2D([], [], color=MEAN, lw=0.8, dashes=(4, 2), label="idealised"))
    handles.append(Line2D([], [], ls="none", marker="o", ms=4.5, color=BEFORE, mec=MEAN, label="target d_t*"))
    legend_below(figure, handles, most=3)
    return figure


def _oscillator(here: Axes, group: Group, values: Mapping[str, float], color: str) -> None:
    """The curve of the oscillator, its idealisation, the line of its period, and the target."""
    Gamma, mass = values["Gamma"], values["m"]
    d = 1e3 * group.variables["curve_displacement"].values / Gamma
    here.plot(d, group.variables["curve_base_shear"].values / Gamma / mass, color=MEAN, lw=1.3, zorder=2.5)
    idealised = 1e3 * group.variables["idealised_displacement"].values / Gamma
    force = group.variables["idealised_base_shear"].values / Gamma / mass
    here.plot(idealised, force, color=color, lw=0.9, dashes=(4, 2), zorder=2.6)
    here.plot([0.0, 1e3 * values["d_et"]], [0.0, values["S_e"]], color=color, lw=0.5)
    at = min(values["q_u"], 1.0) * values["F_y"] / mass
    here.plot(
        1e3 * values["d_t_oscillator"], at, marker="o", ms=4.5, color=color, mec=MEAN, mew=0.5, zorder=3, ls="none"
    )


def _of_n2(group: Group) -> dict[str, float]:
    names = [name for name in group.variables if name.startswith("n2_")]
    return {name.removeprefix("n2_"): float(group.variables[name].values) for name in names}


def _spectrum(hazard: Hazard, group: Group) -> Spectrum:
    spectrum = elastic_spectrum(hazard, str(group.attributes["level"]))
    return spectrum.with_damping(float(group.attributes["spectrum_damping"]))
