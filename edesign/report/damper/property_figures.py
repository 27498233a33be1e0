"""Storage modulus, equivalent modulus and loss factor against frequency: measured points and lines of a law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.testing.steady_state import PropertyRows
from edesign.report.drawing.style import legend_below, logarithmic, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

QUANTITIES = {
    "G_storage": ("storage modulus", "G' (MPa)", 1e6),
    "G_eq": ("equivalent modulus", "G_eq (MPa)", 1e6),
    "loss_factor": ("loss factor", "n", 1.0),
}
_SHADES = ("#0b2e59", "#1f5fa8", "#2e8b7a", "#c98a1b", "#c0392b", "#7d3c98")  # dark to light in grey print as well
_MARKS = "osD^vP"


@styled
def property_figure(
    measured: PropertyRows | None,
    predicted: PropertyRows | None,
    quantities: Sequence[str] = tuple(QUANTITIES),
    by: str = "strain",
    title: str = "",
) -> Figure:
    """Draw properties against frequency as in Figs. 3.15-3.24 of the thesis.

    One row of axes for each value of what is not `by`, one column for each quantity; in each a curve for each value of
    `by`: points where measured, lines where predicted.

    Args:
        measured: rows, drawn as points.
        predicted: rows, drawn as lines.
        quantities: keys of QUANTITIES.
        by: "strain" (one row of axes a temperature) or "temperature_C" (one row a strain).

    Raises:
        ValueError: neither measured nor predicted rows are given.
    """
    other = "temperature_C" if by == "strain" else "strain"
    some = measured if measured is not None else predicted
    if some is None:
        raise ValueError("nothing to draw")
    levels, panels = np.unique(getattr(some, by)), np.unique(getattr(some, other))
    figure, axes = new_figure(len(panels), len(quantities), 2.5 * len(quantities) + 0.4, 2.0 * len(panels) + 0.7)
    for row, panel in enumerate(panels):
        for column, quantity in enumerate(quantities):
            here = axes[row][column]
            for i, level in enumerate(levels):
                _curve(here, measured, predicted, quantity, {by: level, other: panel}, i)
            logarithmic(here)
            here.set_xticks(np.unique(some.frequency), minor=False)
            here.set_ylim(bottom=0.0)
            here.set_title(f"{QUANTITIES[quantity][0]}, {_named(other, panel)}", loc="left")
            here.set_ylabel(QUANTITIES[quantity][1])
            if row == len(panels) - 1:
                here.set_xlabel("frequency (Hz)")
    handles = _legend(levels, by, measured is not None, predicted is not None)
    legend_below(figure, handles, most=min(len(handles), 7))
    if title:
        figure.suptitle(title, x=0.01, ha="left", fontsize=9.0)
    return figure


@styled
def residual_figure(residuals: dict[str, np.ndarray], rows: PropertyRows) -> Figure:
    """Draw relative residuals against frequency, a panel a quantity, a line a strain, means over temperature.

    Args:
        residuals: by key of QUANTITIES, shape (n,), relative.
        rows: of the same tests.
    """
    figure, (axes,) = new_figure(1, len(residuals), 2.5 * len(residuals) + 0.4, 2.7)
    strains, frequencies = np.unique(rows.strain), np.unique(rows.frequency)
    for here, (quantity, values) in zip(axes, residuals.items(), strict=True):
        for i, strain in enumerate(strains):
            means = [np.mean(values[(rows.strain == strain) & (rows.frequency == f)]) for f in frequencies]
            here.plot(frequencies, 100.0 * np.array(means), color=_SHADES[i % 6], marker=_MARKS[i % 6], ms=3.0)
        here.axhline(0.0, color="#111111", lw=0.6)
        logarithmic(here)
        here.set_xticks(frequencies, minor=False)
        here.set_title(QUANTITIES[quantity][0], loc="left")
        here.set_xlabel("frequency (Hz)")
    axes[0].set_ylabel("predicted / measured - 1 (%)")
    handles = _legend(strains, "strain", True, True)[: len(strains)]
    legend_below(figure, handles, most=len(handles))
    return figure


def _curve(
    axes: Axes,
    measured: PropertyRows | None,
    predicted: PropertyRows | None,
    quantity: str,
    at: dict[str, float],
    number: int,
) -> None:
    """Points and line of one series."""
    colour, scale = _SHADES[number % len(_SHADES)], QUANTITIES[quantity][2]
    for rows, mark, line in ((measured, _MARKS[number % len(_MARKS)], ""), (predicted, "", "-")):
        if rows is None:
            continue
        chosen = np.flatnonzero(np.logical_and.reduce([getattr(rows, key) == value for key, value in at.items()]))
        chosen = chosen[np.argsort(rows.frequency[chosen])]
        values = getattr(rows, quantity)[chosen] / scale
        axes.plot(rows.frequency[chosen], values, color=colour, marker=mark, ls=line, ms=3.0)


def _legend(levels: np.ndarray, by: str, points: bool, lines: bool) -> list:
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=_SHADES[i % 6], marker=_MARKS[i % 6], ms=3.0, label=_named(by, level))
        for i, level in enumerate(levels)
    ]
    if points and lines:
        handles.append(Line2D([], [], color="#555555", marker="o", ls="", ms=3.0, label="measured"))
        handles.append(Line2D([], [], color="#555555", label="law"))
    return handles


def _named(key: str, value: float) -> str:
    return f"{100.0 * value:g} % strain" if key == "strain" else f"{value:g} °C"
