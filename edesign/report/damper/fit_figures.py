"""Measured and fitted loops of damper tests."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.fitting import Fit
from edesign.damper.testing.nrms import nrms
from edesign.errors import ArchiveError
from edesign.optional_stages import optional
from edesign.report.drawing.captions import UniqueNames, file_name
from edesign.report.drawing.style import AFTER, BEFORE, legend_below, new_figure, save, styled
from edesign.report.tables.number import significant
from edesign.report.tables.unit import PERCENT

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.damper.testing.measured_histories import DamperTest

ERROR = "#c0392b"


@styled
def fit_figure(test: DamperTest, predicted: np.ndarray, law: str, title: str) -> Figure:
    """Draw a test's loop, measured and predicted, and the force over time with the error, as thesis Figs. 4.3 to 4.8.

    Args:
        predicted: force (n,), N.
        title: above the axes.
    """
    figure, ((loop, history),) = new_figure(1, 2, 8.2, 3.6)
    measured = test.measured_force()
    for force, color, label in ((measured, BEFORE, "measured"), (predicted, AFTER, law)):
        loop.plot(1e3 * test.displacement, 1e-3 * force, color=color, lw=0.8, label=label)
        history.plot(test.time, 1e-3 * force, color=color, lw=0.8)
    error = 1e-3 * (predicted - measured)
    history.plot(test.time, error, color=ERROR, lw=0.5, label=f"{law} \u2212 measured")
    loop.set_xlabel("displacement (mm)")
    loop.set_ylabel("force (kN)")
    history.set_xlabel("time (s)")
    history.set_xlim(float(test.time[0]), float(test.time[-1]))
    figure.suptitle(title, fontsize=9.0, x=0.01, ha="left")
    lines = [*loop.get_lines(), history.get_lines()[-1]]
    legend_below(figure, lines, most=3)  # beside the curves, which fill the axes
    return figure


def draw_fits(fits: Sequence[Fit], tests: Sequence[DamperTest], folder: Path, suffix: str = "svg") -> list[Path]:
    """Draw every test with every law.

    Args:
        fits: to forces.
        tests: those fitted, and those for validation.
        folder: where; one file for each law and test.
        suffix: svg, png or pdf.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    paths = []
    unique = UniqueNames()
    for fit in fits:
        for test in tests:
            path = folder / f"{unique(file_name(fit.law.name, test.name.replace('/', '_')))}.{suffix}"
            with optional(f"the figure {path.name}", passing=(ArchiveError,)):
                predicted = fit.damper(test.temperature_C).force(test.time, test.displacement)
                kind = "" if test.name in fit.nrms else "; not fitted"
                error = significant(nrms(predicted, test.measured_force()) / PERCENT.si, 3)
                title = f"{fit.law.name}: {test.label}, {test.temperature_C:g} °C, NRMS {error} %{kind}"
                save(fit_figure(test, predicted, fit.law.name, title), path)
                paths.append(path)
    return paths
