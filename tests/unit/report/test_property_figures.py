"""Figures of damper properties: what is drawn is what is in the rows."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.damper.testing.steady_state import PropertyRows
from edesign.damper.thesis_tables import measured
from edesign.report.damper.property_figures import property_figure, residual_figure
from edesign.report.drawing.style import save


def test_points_and_lines_are_the_rows() -> None:
    rows = measured()
    stiffer = PropertyRows(
        rows.strain, rows.frequency, rows.temperature_C, 2.0 * rows.G_storage, rows.G_eq, rows.G_loss, rows.loss_factor
    )
    figure = property_figure(rows, stiffer)
    assert len(figure.axes) == 4 * 3  # temperatures, quantities
    lines = figure.axes[0].get_lines()
    assert len(lines) == 5 * 2  # strains; points and line
    np.testing.assert_allclose(lines[0].get_ydata(), rows.G_storage[:6] / 1e6)
    np.testing.assert_allclose(lines[1].get_ydata(), 2.0 * rows.G_storage[:6] / 1e6)
    assert figure.axes[0].get_title(loc="left") == "storage modulus, 20 °C"


def test_by_temperature() -> None:
    """Figs. 3.15 and 3.16: one row of axes a strain, a curve a temperature."""
    figure = property_figure(measured(), None, ("G_storage", "loss_factor"), by="temperature_C")
    assert len(figure.axes) == 5 * 2
    assert len(figure.axes[0].get_lines()) == 4


def test_means_of_residuals_and_the_same_file_twice(tmp_path: Path) -> None:
    rows = measured()
    figure = residual_figure({"loss_factor": rows.strain}, rows)
    np.testing.assert_allclose(figure.axes[0].get_lines()[1].get_ydata(), 20.0)
    for name in "ab":
        save(residual_figure({"loss_factor": rows.strain}, rows), tmp_path / f"{name}.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
