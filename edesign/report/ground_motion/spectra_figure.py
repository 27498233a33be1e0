"""Spectra of records, their mean, and the target."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.drawing.style import BEFORE, MEAN, TARGET, legend_below, legend_label, new_figure, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FEW = 4  # so many lines have names of their own
DASHES = ("--", ":")  # of the first target, and of further ones


@styled
def spectra_figure(
    period: np.ndarray,
    spectra: Mapping[str, np.ndarray],
    targets: Mapping[str, np.ndarray] | None = None,
    title: str = "",
    mean: bool = True,
) -> Figure:
    """Draw spectra as in Figs. 5.7 to 5.9 and 5.12 of the thesis.

    Args:
        period: shape (n,), s.
        spectra: pseudo-acceleration of each record by name, shape (n,), m/s2.
        targets: spectra of the code by label, shape (n,), m/s2.
        title: above the axes.
        mean: whether the mean of the spectra is drawn.
    """
    figure, ((axes,),) = new_figure(1, 1, 6.3, 4.0)
    for i, (name, psa) in enumerate(spectra.items()):
        if len(spectra) <= FEW:
            axes.plot(period, psa / STANDARD_GRAVITY, lw=1.1, label=legend_label(name))
        else:
            label = f"{len(spectra)} records" if i == 0 else None
            axes.plot(period, psa / STANDARD_GRAVITY, color=BEFORE, lw=0.5, label=label)
    if mean and len(spectra) > 1:
        average = np.mean(list(spectra.values()), axis=0)
        axes.plot(period, average / STANDARD_GRAVITY, color=MEAN, lw=1.6, label="mean")
    for i, (label, target) in enumerate((targets or {}).items()):
        style = DASHES[min(i, 1)]
        axes.plot(period, target / STANDARD_GRAVITY, color=TARGET, lw=1.4, ls=style, label=legend_label(label))
    axes.set_xlim(0.0, float(period[-1]))
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("period (s)")
    axes.set_ylabel("spectral acceleration (g)")
    axes.set_title(title, loc="left")
    if axes.get_legend_handles_labels()[0]:
        legend_below(figure, most=2 if len(targets or ()) < 2 else 1)  # labels of codes are long
    return figure
