"""A record before and after it was fitted to a spectrum."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.ground_motion.intensity import displacement, husid, velocity
from edesign.ground_motion.sources import is_simulated
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.drawing.captions import record_label
from edesign.report.drawing.style import AFTER, BEFORE, TARGET, logarithmic, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

History = tuple[np.ndarray, np.ndarray]  # time (s), acceleration (m/s2)


@styled
def match_figure(group: Group) -> Figure:
    """Draw acceleration, velocity, displacement, Husid curve and spectrum before and after, as Fig. 5.10 of the thesis.

    Velocity and displacement show any drift that a method would leave behind.

    Args:
        group: a fitted record, as archived.
    """
    figure, axes = new_figure(4, 2, 8.2, 8.6)
    scale = float(group.attributes["match_scale"])
    before = _history(group, "time", "acceleration", scale)
    after = _history(group, "matched_time", "matched_acceleration", 1.0)
    _series(axes[0], (before, after), "acceleration (g)", lambda a, dt: a / STANDARD_GRAVITY)
    _series(axes[1], (before, after), "velocity (m/s)", velocity)
    _series(axes[2], (before, after), "displacement (m)", displacement)
    name, method = group.attributes["name"], group.attributes["match_method"]
    kind = "simulated" if is_simulated(group.attributes["origin"]) else "recorded"
    axes[0][0].set_title(f"{record_label(str(name))}: {kind}, times {scale:.3g}", loc="left")
    axes[0][1].set_title(f"matched ({method})", loc="left")
    for axis in axes[2]:
        axis.set_xlabel("time (s)")
    _husid(axes[3][0], before, after)
    _spectra(axes[3][1], group)
    return figure


def _history(group: Group, axis: str, name: str, factor: float) -> History:
    return group.coords[axis].values, factor * group.variables[name].values


def _series(
    axes: list[Axes], histories: tuple[History, History], label: str, of: Callable[[np.ndarray, float], np.ndarray]
) -> None:
    """Before on the left, after on the right, in one scale."""
    values = [of(acceleration, float(time[1] - time[0])) for time, acceleration in histories]
    highest = 1.05 * max(float(np.max(np.abs(value))) for value in values)
    first, last = min(float(time[0]) for time, _ in histories), max(float(time[-1]) for time, _ in histories)
    for axis, (time, _), value, color in zip(axes, histories, values, (BEFORE, AFTER), strict=True):
        axis.plot(time, value, color=color, lw=0.6)
        axis.set_ylim(-highest, highest)
        axis.set_xlim(first, last)
    axes[0].set_ylabel(label)


def _husid(axis: Axes, before: History, after: History) -> None:
    for (time, acceleration), color, label in ((before, BEFORE, "before"), (after, AFTER, "after")):
        axis.plot(time, 100.0 * husid(acceleration, float(time[1] - time[0])), color=color, label=label)
    axis.set_xlabel("time (s)")
    axis.set_ylabel("Arias intensity (% of total)")
    axis.legend(loc="lower right")


def _spectra(axis: Axes, group: Group) -> None:
    period = group.coords["period"].values
    for name, color, style, label in (
        ("psa_before", BEFORE, "-", "before"),
        ("psa_after", AFTER, "-", "after"),
        ("target", TARGET, "--", "target"),
    ):
        axis.plot(period, group.variables[name].values / STANDARD_GRAVITY, color=color, ls=style, label=label)
    logarithmic(axis)
    axis.set_xlabel("period (s)")
    axis.set_ylabel("spectral acceleration (g)")
    axis.legend(loc="best")
