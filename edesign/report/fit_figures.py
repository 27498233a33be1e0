"""Measured and fitted loops of damper tests."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.fitting import Fit
from edesign.report.figures import AFTER, BEFORE, new_figure, save, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.damper.test_record import DamperTest

ERROR = "#c0392b"


@styled
def fit_figure(test: DamperTest, predicted: np.ndarray, title: str) -> Figure:
    """Draw a test's loop, measured and predicted, and the force over time with the error, as thesis Figs. 4.3 to 4.8.

    Args:
        test: with measured force.
        predicted: force (n,), N.
        title: above the axes.
    """
    figure, ((loop, history),) = new_figure(1, 2, 8.2, 3.4)
    measured = test.measured_force()
    for force, color, label in ((measured, BEFORE, "measured"), (predicted, AFTER, "fitted")):
        loop.plot(1e3 * test.displacement, 1e-3 * force, color=color, lw=0.8, label=label)
        history.plot(test.time, 1e-3 * force, color=color, lw=0.8)
    history.plot(test.time, 1e-3 * (predicted - measured), color=ERROR, lw=0.5, label="fitted - measured")
    loop.set_xlabel("displacement (mm)")
    loop.set_ylabel("force (kN)")
    loop.set_title(title, loc="left")
    loop.legend(loc="upper left")
    history.set_xlabel("time (s)")
    history.legend(loc="upper right")
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
    for fit in fits:
        for test in tests:
            predicted = fit.damper(test.temperature_C).force(test.time, test.displacement)
            kind = "" if test.name in fit.nrms else ", not fitted"
            path = folder / f"{_file_name(f'{fit.law.name}_{test.name}')}.{suffix}"
            save(fit_figure(test, predicted, f"{fit.law.name}: {test.label}{kind}"), path)
            paths.append(path)
    return paths


def _file_name(name: str) -> str:
    return re.sub(r"[^A-Za-z0-9._-]+", "_", name)
