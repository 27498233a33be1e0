"""Figures of the seismic action of an archive."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.report.ground_motion.spectra_figure import spectra_figure
from edesign.study.results.kinds import HAZARD_LEVELS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LAST_DRAWN = 4.0
"""Periods are drawn to here, s: EN 1998-1 and NTC 2018 state their spectra to 4 s."""


def hazard_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the elastic spectra of the levels with dashed design spectra; none without levels.

    Yields:
        Name of the file, caption and figure.
    """
    names = archive.names(HAZARD_LEVELS)
    if not names:
        return
    levels = {name: archive.view(f"{HAZARD_LEVELS}/{name}") for name in names}
    first = next(iter(levels.values()))
    period = first.coords["period"].values
    drawn = period <= LAST_DRAWN
    elastic = {name: _ordinates(group, "elastic", period)[drawn] for name, group in levels.items()}
    design = {
        f"{name}, design": _ordinates(group, "design", period)[drawn]
        for name, group in levels.items()
        if "design" in group.variables
    }
    title = f"{100 * float(first.attributes['damping']):g} % damping"
    reduced = ", and design spectra" if design else ""
    caption = f"Elastic spectra of the hazard levels ({title}){reduced}."
    yield "hazard_spectra", caption, spectra_figure(period[drawn], elastic, design, title, mean=False)


def _ordinates(group: Group, name: str, period: np.ndarray) -> np.ndarray:
    """Ordinates at the periods of the first level; tables of other levels may end elsewhere."""
    known = group.coords["period"].values
    return np.interp(period, known, group.variables[name].values, right=np.nan)
