"""Profiles over the height: what is drawn is what is in the archive."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from unit.report.figure_archive import RECORDS, history, small_archive

from edesign.archive.reader import open_archive
from edesign.report.response.profile_figures import profile_figures


@pytest.fixture(scope="module")
def figures(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[str, Any]]:
    with open_archive(small_archive(tmp_path_factory.mktemp("profiles"))) as archive:
        return {name: (caption, figure) for name, caption, figure in profile_figures(archive)}


def panels(figure: Any) -> list[Any]:
    return [axis for axis in figure.axes if axis.get_visible()]


def lines(axis: Any) -> list[Any]:
    """Without the vertical lines of limits."""
    return [line for line in axis.lines if len(set(line.get_xdata())) > 1]


def test_there_is_a_figure_of_each_archived_quantity(figures: dict[str, tuple[str, Any]]) -> None:
    kinds = ("floor_displacement", "storey_drift", "residual_storey_drift", "floor_acceleration", "storey_shear")
    assert list(figures) == [f"profile_{kind}_DBE" for kind in kinds]


def test_a_panel_has_every_record_their_percentile_and_their_mean(figures: dict[str, tuple[str, Any]]) -> None:
    bare, damped = panels(figures["profile_storey_drift_DBE"][1])
    assert len(lines(bare)) == 3 + 2 and len(lines(damped)) == 2 + 2
    assert lines(bare)[-1].get_xdata() == pytest.approx([2.0, 1.0])  # mean of 1, 2, 3 times 1 % and 0.5 %
    assert lines(bare)[-2].get_xdata() == pytest.approx([3.0, 1.5])  # of three values the third: ceil(0.84 * 3)
    assert lines(damped)[-1].get_xdata() == pytest.approx([0.65, 0.325])
    assert sorted(line.get_xdata()[0] for line in lines(bare)[:3]) == pytest.approx([1.0, 2.0, 3.0])


def test_variants_have_the_same_scales(figures: dict[str, tuple[str, Any]]) -> None:
    for _, figure in figures.values():
        first, second = panels(figure)
        assert first.get_xlim() == second.get_xlim() and first.get_ylim() == second.get_ylim()


def test_limits_of_performance_levels(figures: dict[str, tuple[str, Any]]) -> None:
    """FEMA 356, Table C1-3: 0.7, 2.5, 5 % transient; the last is beyond the scale, which ends at 1.08 times 3 %."""
    axis = panels(figures["profile_storey_drift_DBE"][1])[0]
    vertical = sorted(line.get_xdata()[0] for line in axis.lines if len(set(line.get_xdata())) == 1)
    assert vertical == pytest.approx([0.7, 2.5])
    assert {"IO", "LS"} <= {text.get_text() for text in axis.texts}


def test_floors_begin_at_the_base(figures: dict[str, tuple[str, Any]]) -> None:
    displacement = lines(panels(figures["profile_floor_displacement_DBE"][1])[0])[-1]
    assert displacement.get_xdata() == pytest.approx([0.0, 20.0, 40.0])
    assert list(displacement.get_ydata()) == [0, 1, 2]
    acceleration = lines(panels(figures["profile_floor_acceleration_DBE"][1])[0])[-1]
    assert acceleration.get_xdata() == pytest.approx([2.0, 6.0, 8.0])  # the ground's peak, then the floors'


def test_the_record_with_the_largest_value_is_named_and_the_failed_one_is_missing(
    figures: dict[str, tuple[str, Any]],
) -> None:
    caption, figure = figures["profile_storey_drift_DBE"]
    bare, damped = panels(figure)
    assert "largest: Borrego 1942 B-ELC000" in {text.get_text() for text in bare.texts}
    assert "largest: Imperial Valley 1979 H-EMO000" in {text.get_text() for text in damped.texts}
    assert damped.get_title("left") == "damped, 2 records"
    assert "bare: mean of 3 records up to 2.00 %, largest 3.00 % (Borrego 1942 B-ELC000)" in caption
    assert caption.endswith(
        "Missing, as the analysis did not complete: damped, Borrego 1942 B-ELC000 (no equilibrium at 3 s)."
    )


def test_storey_shear_with_dampers_is_that_of_one_moment(tmp_path: Path) -> None:
    """Columns and dampers in quadrature: the largest sum is the root of the squares, not the sum of the largest."""
    group = history("fitted", RECORDS[0], 20, 1.0)
    angle = np.linspace(0.0, 2.0 * np.pi, 101)
    group.add("storey_shear", ("time", "storey"), np.outer(np.sin(angle), [3e5, 1e5]), "N", "shear")
    group.add("storey_damper_force", ("time", "storey"), np.outer(np.cos(angle), [4e5, 2e5]), "N", "dampers")
    group.add("storey_damper_force_max", ("storey",), np.array([4e5, 2e5]), "N", "dampers")
    with open_archive(small_archive(tmp_path, ("analyses/fitted", group))) as archive:
        figure = {name: figure for name, _, figure in profile_figures(archive)}["profile_storey_shear_DBE"]
    titles = [axis.get_title("left") for axis in panels(figure)]
    assert titles[2:] == ["fitted: columns", "fitted: columns and dampers"]
    total = panels(figure)[3].lines[0].get_xdata()
    assert total == pytest.approx([500.0, np.sqrt(5.0) * 100.0], rel=1e-3)  # at the nearest of 101 instants
