"""How a design of dampers came about, and what it put into each storey."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.archived import archived_base
from edesign.report.design.device_figures import device_figures
from edesign.report.design.heights import heights_caption, heights_figure, size_of
from edesign.report.design.hysteretic_figures import hysteretic_figures
from edesign.report.design.placement_figures import placement_figures
from edesign.report.design.storeys import first_mode
from edesign.report.design.tables import round_damping, round_sizes
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import (
    AFTER,
    BEFORE,
    TARGET,
    VARIANTS,
    grid_figure,
    legend_above,
    new_figure,
    some_of,
    styled,
)
from edesign.report.response.histories import names_of
from edesign.report.tables.unit import M2
from edesign.study.results.kinds import DESIGNS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_STYLES = ("-", "--", "-.", ":")
_LINE: Any = {"color": AFTER, "marker": "o", "ms": 3.5}
MARKERS = ("o", "s", "^", "D", "v")


def design_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the rounds of each design, its dampers over the height, and one of them as a device.

    Yields:
        Name of the file, caption and figure.
    """
    for name in archive.names(DESIGNS):
        group = archive.group(f"{DESIGNS}/{name}")
        method = group.attributes.get("method")
        if method == "placement":
            yield from placement_figures(name, group, archived_base(archive))
            continue
        if size_of(group) is not None:
            yield (
                file_name("design", name, "heights"),
                f"Design {name}: {heights_caption(group)}",
                heights_figure(group),
            )
        if method == "hysteretic":
            yield from hysteretic_figures(name, group)
        rounds, iterations = _rounds(name, group), _iterations(name, group)
        parts = [iterations, rounds] if method == "viscous" else [rounds, iterations]
        yield from (part for part in parts if part is not None)
    yield from device_figures(archive)


def _rounds(name: str, group: Group) -> tuple[str, str, Figure] | None:
    """Return name, caption and figure of the rounds of a design; None if there are not several."""
    if "round" not in group.coords or group.coords["round"].values.size < 2:
        return None
    reason = str(group.attributes.get("reason") or "")
    count = group.coords["round"].values.size
    chosen = group.attributes.get("chosen_round")
    shaded = f" Round {chosen} is the one that was chosen." if chosen is not None else ""
    caption = f"Design {name}: {count} rounds of sizing and verification by histories.{shaded} {reason}".strip()
    return file_name("design", name, "rounds"), caption, rounds_figure(group)


def _iterations(name: str, group: Group) -> tuple[str, str, Figure] | None:
    """Return name, caption and figure of the iterations of a design; None if there are not several."""
    if "iteration" not in group.coords or group.coords["iteration"].values.size < 2 or not _panels(group):
        return None
    followed = " and the strain that is reached" if "strain_step" in group.coords else ""
    what = f"properties of the elastomer at the first frequency{followed}"
    if "iteration_coefficient" in group.variables:
        what = "amplitude at which the dampers count"
    caption = f"Design {name}: {group.coords['iteration'].values.size} iterations of the {what}."
    return file_name("design", name, "iterations"), caption, iterations_figure(group)


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


def _panels(group: Group) -> list[tuple[str, float, tuple[str, ...]]]:
    """Return label, scale and variables of what a design iterates on, what was taken before what was found."""
    panels = [
        ("first frequency (Hz)", 1.0, ("iteration_frequency", "iteration_next_frequency")),
        ("added damping (%)", 100.0, ("iteration_damping",)),
        ("strain of the layers (%)", 100.0, ("strain_step_taken", "strain_step_reached")),
    ]
    coefficient = group.variables.get("iteration_coefficient")
    if coefficient is not None:
        panels = [
            ("roof amplitude (mm)", 1e3, ("iteration_roof_displacement",)),
            (f"c of all storeys ({kilonewtons(coefficient.unit).name})", 1e-3, ("iteration_coefficient",)),
        ]
    return [panel for panel in panels if all(name in group.variables for name in panel[2])]


@styled
def iterations_figure(group: Group) -> Figure:
    """Draw what a design took and found in each iteration; of values over the storeys the sum.

    Args:
        group: of a design, with variables over (iteration,), and over (strain_step,) where the strain was followed.
    """
    panels = _panels(group)
    figure, (axes,) = new_figure(1, len(panels), 6.3, 2.4)
    for axis, (label, scale, names) in zip(axes, panels, strict=True):
        of_strain = names[0].startswith("strain_step")
        steps = np.asarray(group.coords["strain_step" if of_strain else "iteration"].values)
        for name in names:
            values = scale * _along(group, name).reshape(steps.size, -1).sum(axis=1)
            style = _LINE if name == names[-1] else {"color": BEFORE, "ls": "--", "marker": "s", "ms": 3.5}
            axis.plot(steps, values, **style, label="found" if name == names[-1] else "taken")
        if names[0] == "iteration_frequency":
            legend_above(axis)
        else:
            _from_zero(axis)
        axis.set_ylabel(label)
        axis.set_xlabel("step of the strain" if of_strain else "iteration")
        axis.set_xticks(steps[:: 1 + len(steps) // 8] if of_strain else some_of(steps))
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
    total, name, unit = round_sizes(group)
    axis.plot(rounds, total / unit.si, **_LINE)
    axis.set_ylabel("elastomer, all layers (m²)" if unit == M2 else f"{name} ({unit.name})")
    _from_zero(axis)


def _period(axis: Axes, group: Group, rounds: np.ndarray) -> None:
    axis.plot(rounds, _along(group, "round_period"), **_LINE, label="with dampers")
    if "bare_period" in group.variables:
        axis.axhline(float(_along(group, "bare_period")[0]), color=BEFORE, ls="--", lw=1.0, label="without dampers")
    axis.set_ylabel(f"period of the {first_mode(group)} (s)" if "along" in group.attributes else "first period (s)")
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
