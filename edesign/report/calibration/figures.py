"""All figures of a calibration, in the order of its report."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from edesign.calibration.results.result import Calibration
from edesign.report.calibration.effect_figures import effect_figures
from edesign.report.calibration.history_figures import error_figures, loop_figures, residual_figures
from edesign.report.calibration.residual_figures import curve_figures, dependence_figures, map_figures
from edesign.report.calibration.structure_figures import history_figures, peak_figures, spectrum_figures
from edesign.report.calibration.view import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Figures = Callable[[View], Iterator[tuple[str, str, "Figure"]]]
FIGURES: tuple[Figures, ...] = (
    error_figures,
    effect_figures,
    loop_figures,
    residual_figures,
    dependence_figures,
    curve_figures,
    map_figures,
)
STRUCTURE: tuple[Figures, ...] = (error_figures, peak_figures, history_figures, spectrum_figures)
"""Of a building: its records."""


def calibration_figures(calibration: Calibration) -> Iterator[tuple[str, str, Figure]]:
    """Name, caption and figure, one after the other."""
    view = View(calibration)
    for figures in STRUCTURE if calibration.subject == "structure" else FIGURES:
        yield from figures(view)
