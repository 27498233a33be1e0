"""Transfer functions over frequency: amplitude, phase, and what a sine comes late by."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.report.drawing.style import MEAN, align_ordinates, logarithmic, new_figure, styled
from edesign.report.substructure.curves import legend_of_lines
from edesign.report.substructure.results import BEST, FIRST
from edesign.substructure.stability.loop import Transfer

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 400
SIGMAS = 2.0
"""Standard deviations to either side in a band: 95 % of normal errors lie in it."""
QUARTERS = 45.0  # degrees from one tick to the next

Deviations = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class Path:
    """A line: its label, the transfer function over s, a colour, the style, and how sure it is.

    `deviations` gives the standard deviations of amplitude (ratio of it) and phase (rad) at omega; None: not known.
    """

    label: str
    transfer: Transfer
    color: str
    style: str = "-"
    deviations: Deviations | None = None


@styled
def bode_figure(
    paths: Sequence[Path],
    lines: Sequence[float],
    band: tuple[float, float],
    labels: Sequence[str],
    phases: tuple[float, float] = (-180.0, 45.0),
    least: float = 0.1,
) -> Figure:
    """Draw amplitude, phase and delay over frequency.

    Args:
        paths: at least one.
        lines: frequencies that are marked, Hz.
        band: lowest and highest frequency, Hz.
        labels: of the ordinates; without the third the delay is not drawn.
        phases: lowest and highest, degrees.
        least: amplitude that is drawn.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    figure, axes = new_figure(len(labels), 1, 5.6, 0.7 + 1.5 * len(labels))
    frequency = np.geomspace(*band, POINTS)
    omega = 2.0 * np.pi * frequency
    peak = 1.0
    for path in paths:
        width = 1.1 if path.color in (FIRST, BEST) else 1.9  # lines that agree lie on each other
        found = path.transfer(1j * omega)
        peak = max(peak, float(np.max(np.abs(found))))
        phase = np.unwrap(np.angle(found))
        for (axis,), values in zip(axes, (np.abs(found), np.degrees(phase), -1e3 * phase / omega), strict=False):
            axis.plot(frequency, values, color=path.color, lw=width, ls=path.style, zorder=3.2 - 0.2 * width)
        if path.deviations is not None:
            of_amplitude, of_phase = (SIGMAS * one for one in path.deviations(omega))
            factor, degrees, late = np.exp(of_amplitude), np.degrees(of_phase), 1e3 * of_phase / omega
            bands = (
                (np.abs(found) / factor, np.abs(found) * factor),
                (np.degrees(phase) - degrees, np.degrees(phase) + degrees),
                (-1e3 * phase / omega - late, -1e3 * phase / omega + late),
            )
            for (axis,), edges in zip(axes, bands, strict=False):
                axis.fill_between(frequency, *edges, color=path.color, alpha=0.25, lw=0.0, zorder=1.5)
    for (axis,), level, label in zip(axes, (1.0, 0.0, 0.0), labels, strict=False):
        axis.axhline(level, color=MEAN, lw=0.5, ls="--")
        for line in lines:
            axis.axvline(line, color=MEAN, lw=0.5, zorder=0.9)
        logarithmic(axis)
        axis.set_xlim(*band)
        axis.set_ylabel(label)
        axis.tick_params(labelbottom=axis is axes[-1][0])
    amplitude = axes[0][0]
    amplitude.set_yscale("log")
    amplitude.set_ylim(least, max(1.3 * peak, 2.0))
    amplitude.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    amplitude.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    amplitude.yaxis.set_minor_formatter(NullFormatter())
    axes[1][0].set_ylim(*phases)
    axes[1][0].set_yticks(np.arange(phases[0], phases[1] + 1.0, QUARTERS))
    axes[-1][0].set_xlabel("frequency (Hz)")
    align_ordinates(row[0] for row in axes)
    legend_of_lines(figure, [(path.label, path.color, path.style) for path in paths])
    return figure
