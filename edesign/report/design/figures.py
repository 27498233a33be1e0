"""How a design of dampers came about, and what it put into each storey."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.archived import archived_project
from edesign.report.design.hysteretic_figures import hysteretic_figures
from edesign.report.design.placement_figures import placement_figures
from edesign.report.design.tables import ROUND_SIZES, round_areas, round_damping
from edesign.report.design.viscous_figures import viscous_figures
from edesign.report.drawing.captions import file_name, plain
from edesign.report.drawing.style import (
    AFTER,
    BEFORE,
    MEAN,
    TARGET,
    VARIANTS,
    grid_figure,
    legend_above,
    new_figure,
    some_of,
    styled,
)
from edesign.report.response.histories import names_of
from edesign.study.results.kinds import DESIGNS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_STYLES = ("-", "--", "-.", ":")
_LINE: Any = {"color": AFTER, "marker": "o", "ms": 3.5}
MARKERS = ("o", "s", "^", "D", "v")


def design_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the rounds of each design, and its dampers over the height.

    Yields:
        Name of the file, caption and figure.
    """
    for name in archive.names(DESIGNS):
        group = archive.group(f"{DESIGNS}/{name}")
        if group.attributes.get("method") == "placement":
            project = archived_project(archive)
            yield from placement_figures(name, group, None if project is None else project.frame)
            continue
        if group.attributes.get("method") == "viscous":
            yield from viscous_figures(name, group)
        if group.attributes.get("method") == "hysteretic":
            yield from hysteretic_figures(name, group)
        about = f"Design {name}"
        if "layer_area" in group.variables and "damper_stiffness" in group.variables:
            total = float(np.sum(_along(group, "damper_stiffness")) / np.sum(_along(group, "storey_stiffness")))
            caption = (
                f"{about}: stiffness of dampers and storeys, and area of a layer of elastomer. "
                f"The dampers have {plain(100.0 * total)} % of the stiffness of their storeys."
            )
            yield file_name("design", name, "heights"), caption, heights_figure(group)
        if "round" in group.coords and group.coords["round"].values.size > 1:
            reason = str(group.attributes.get("reason") or "")
            count = group.coords["round"].values.size
            chosen = group.attributes.get("chosen_round")
            shaded = f" Round {chosen} is the one that was chosen." if chosen is not None else ""
            caption = f"{about}: {count} rounds of sizing and verification by histories.{shaded} {reason}".strip()
            yield file_name("design", name, "rounds"), caption, rounds_figure(group)
        if "iteration_next_frequency" in group.variables and group.coords["iteration"].values.size > 1:
            count = group.coords["iteration"].values.size
            followed = " and the strain that is reached" if "strain_step" in group.coords else ""
            caption = (
                f"{about}: {count} iterations of the properties of the elastomer at the first frequency{followed}."
            )
            yield file_name("design", name, "iterations"), caption, iterations_figure(group)


@styled
def heights_figure(group: Group) -> Figure:
    """Draw the stiffness of storeys and dampers, and the area of their layers, storey by storey.

    Args:
        group: of a design: damper_stiffness, storey_stiffness N/m and layer_area m2 over (storey,), and where there
            are rounds of a verification round_layer_area over (round, storey).
    """
    figure, ((left, right),) = new_figure(1, 2, 6.3, 3.4)
    storeys = np.asarray(group.coords["storey"].values)
    parts = [
        ("frame", _along(group, "storey_stiffness"), BEFORE),
        ("dampers", _along(group, "damper_stiffness"), AFTER),
    ]
    if "brace_stiffness" in group.variables:
        parts.append(("braces", _along(group, "brace_stiffness"), VARIANTS[2]))
    thick = 0.8 / len(parts)
    for i, (label, values, color) in enumerate(parts):
        places = storeys + 0.4 - (i + 0.5) * thick
        left.barh(places, 1e-6 * values, 0.9 * thick, color=color, label=label)
    left.set_xlabel("stiffness (MN/m)")
    right.barh(storeys, _along(group, "layer_area"), 0.6, color=AFTER, label="chosen")
    if "round_layer_area" in group.variables:
        for k, areas in enumerate(group.variables["round_layer_area"].values):
            right.plot(areas, storeys, color=MEAN, lw=0.6, marker=".", ms=3.0, label=None if k else "each round")
    right.set_xlabel("area of a layer (m²)")
    right.set_xlim(left=0.0)
    right.tick_params(labelleft=False)
    left.set_ylabel("storey")
    for axis in (left, right):
        axis.set_ylim(storeys[0] - 0.6, storeys[-1] + 0.6)
        axis.set_yticks(some_of(storeys))
        axis.grid(axis="y", visible=False)
        legend_above(axis)
    return figure


@styled
def rounds_figure(group: Group) -> Figure:
    """Draw the target of each round of a design, its size, and the verdicts on its histories.

    Args:
        group: of a design, with variables over (round,), (round, storey) and (round, criterion).
    """
    panels = [_damping, _size, _period]
    panels += [_verdicts] if "verdict_value" in group.variables else []
    panels += [_strain] if "round_history_strain" in group.variables else []
    figure, cells = grid_figure(len(panels), 2, 3.1, 1.9)
    rounds = np.asarray(group.coords["round"].values)
    for axis, panel in zip(cells, panels, strict=True):
        panel(axis, group, rounds)
        axis.set_xlim(rounds[0] - 0.5, rounds[-1] + 0.5)
        if "chosen_round" in group.attributes:
            chosen = int(str(group.attributes["chosen_round"]))
            axis.axvspan(chosen - 0.3, chosen + 0.3, color=AFTER, alpha=0.12, lw=0.0, zorder=0.0)
        axis.set_xticks(some_of(rounds))
        axis.set_xlabel("round")
        if axis.get_legend_handles_labels()[0]:
            legend_above(axis)
    return figure


@styled
def iterations_figure(group: Group) -> Figure:
    """Draw the frequency before and after each iteration, and the damping that the dampers add.

    Args:
        group: of a design, with iteration_frequency, iteration_next_frequency (Hz) and iteration_damping; where the
            strain was followed, with strain_step_taken and strain_step_reached too.
    """
    followed = "strain_step" in group.coords
    figure, (axes,) = new_figure(1, 3 if followed else 2, 6.3, 2.4)
    left, right = axes[:2]
    steps = np.asarray(group.coords["iteration"].values)
    left.plot(steps, _along(group, "iteration_frequency"), color=BEFORE, ls="--", marker="s", ms=3.5, label="taken")
    left.plot(steps, _along(group, "iteration_next_frequency"), **_LINE, label="found")
    left.set_ylabel("first frequency (Hz)")
    legend_above(left)
    right.plot(steps, 100.0 * _along(group, "iteration_damping"), **_LINE)
    right.set_ylabel("added damping (%)")
    _from_zero(right)
    for axis in (left, right):
        axis.set_xlabel("iteration")
        axis.set_xticks(some_of(steps))
    if followed:
        last = axes[2]
        steps = np.asarray(group.coords["strain_step"].values)
        last.plot(steps, 100.0 * _along(group, "strain_step_taken"), color=BEFORE, ls="--", marker="s", ms=3.5)
        last.plot(steps, 100.0 * _along(group, "strain_step_reached"), **_LINE)
        last.set_ylabel("strain of the layers (%)")
        last.set_xlabel("step of the strain")
        last.set_xticks(steps[:: 1 + len(steps) // 8])
        _from_zero(last)
    return figure


def _damping(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    target = _along(group, "round_target")
    of_damping = group.attributes.get("target", "damping") == "damping"  # others are shares of shears
    if group.attributes.get("method") != "simplified" and of_damping and np.all(np.isfinite(target)):
        axis.plot(rounds, 100.0 * target, color=TARGET, ls="--", lw=1.0, label="target")
    axis.plot(rounds, 100.0 * round_damping(group), **_LINE, label="with braces")
    axis.set_ylabel("added damping (%)")
    _from_zero(axis)


def _size(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    if group.attributes.get("method") in ROUND_SIZES:
        total, label = ROUND_SIZES[str(group.attributes["method"])](group)
        axis.plot(rounds, total, **_LINE)
        axis.set_ylabel(label.replace("[", "(").replace("]", ")"))
        _from_zero(axis)
        return
    axis.plot(rounds, round_areas(group), **_LINE)
    axis.set_ylabel("elastomer, all layers (m²)")
    _from_zero(axis)


def _period(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    axis.plot(rounds, _along(group, "round_period"), **_LINE, label="with dampers")
    if "bare_period" in group.variables:
        axis.axhline(float(_along(group, "bare_period")[0]), color=BEFORE, ls="--", lw=1.0, label="without dampers")
    axis.set_ylabel("first period (s)")
    _from_zero(axis)


def _strain(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    axis.plot(rounds, 100.0 * _along(group, "round_strain"), color=TARGET, ls="--", lw=1.0, label="of the properties")
    axis.plot(rounds, 100.0 * _along(group, "round_history_strain"), **_LINE, label="in histories")
    axis.set_ylabel("strain of the layers (%)")
    _from_zero(axis)


def _verdicts(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    """Values over limits: filled where the criterion is met."""
    values, limits, met = (group.variables[f"verdict_{part}"].values for part in ("value", "limit", "met"))
    for i, name in enumerate(names_of(group, "criterion")):
        ratio = values[:, i] / limits[:, i]
        color = (AFTER, VARIANTS[0], VARIANTS[2], VARIANTS[3])[i % 4]
        axis.plot(rounds, ratio, color=color, lw=1.0, ls=_STYLES[i % 4], label=name)
        for x, y, good in zip(rounds, ratio, met[:, i], strict=True):
            face = color if good == 1.0 else "white"
            axis.plot(x, y, marker=MARKERS[i % len(MARKERS)], ms=4.0, mfc=face, mec=color, ls="none")
    axis.axhline(1.0, color=TARGET, lw=0.9, ls="--")
    axis.set_ylabel("value / limit (1)")
    _from_zero(axis)


def _from_zero(axis: Axes) -> None:
    """Let an axis begin at zero, and end above all marks."""
    axis.set_ylim(0.0, 1.1 * axis.get_ylim()[1])


def _along(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)
