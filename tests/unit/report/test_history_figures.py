"""Responses, energies and temperatures over time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from unit.report.figure_archive import RECORDS, TIME, history, small_archive

from edesign.archive.reader import open_archive
from edesign.report.response.energy_figures import energy_figures
from edesign.report.response.histories import histories, variant_colors
from edesign.report.response.response_figures import response_figures
from edesign.report.response.temperature_figures import temperature_figures

TABAS = RECORDS[0]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    warm = history("damped", TABAS, 30, 0.7, temperature_C=35.0)
    return small_archive(tmp_path_factory.mktemp("histories"), ("analyses/damped.35C.DBE.Tabas", warm))


def test_variants_are_overlaid_below_the_ground_motion(path: Path) -> None:
    with open_archive(path) as archive:
        found = {name: (caption, figure) for name, caption, figure in response_figures(archive)}
    assert list(found) == [f"response_DBE_{record}" for record in RECORDS]
    caption, figure = found[f"response_DBE_{TABAS}"]
    ground, roof, base = figure.axes  # accelerations were not kept, and without dampers one shear is enough
    assert np.max(ground.lines[0].get_ydata()) == pytest.approx(2.0, rel=1e-2)
    curves = {line.get_label(): line.get_ydata() for line in roof.lines if len(line.get_xdata()) == TIME.size}
    assert set(curves) == {"bare", "damped"}  # not the warm one
    np.testing.assert_allclose(curves["damped"], 0.5 * 20.0 * np.sin(2.0 * np.pi * 0.3 * TIME), atol=1e-12)
    assert roof.get_ylabel() == "roof\ndisplacement\n(mm)"
    marked = [line for line in base.lines if line.get_marker() == "o"]
    assert [abs(line.get_ydata()[0]) for line in marked] == pytest.approx([200.0, 100.0], rel=1e-2)
    assert "bare: roof displacement 20.0 mm, base shear 200 kN; damped: roof displacement 10.0 mm" in caption


def test_a_failed_history_is_not_drawn_but_named(path: Path) -> None:
    with open_archive(path) as archive:
        found = {name: (caption, figure) for name, caption, figure in response_figures(archive)}
    caption, figure = found[f"response_DBE_{RECORDS[2]}"]
    assert "damped, Borrego 1942 B-ELC000 (no equilibrium at 3 s)" in caption
    assert {line.get_label() for line in figure.axes[1].lines if len(line.get_xdata()) > 2} == {"bare"}


def test_temperatures_of_one_history(path: Path) -> None:
    with open_archive(path) as archive:
        found = list(temperature_figures(archive))
    assert [name for name, _, _ in found] == [f"temperature_damped_DBE_{TABAS}"]
    curves = {line.get_label(): line.get_ydata() for line in found[0][2].axes[1].lines}
    assert np.max(curves["35 °C"]) / np.max(curves["design temperature"]) == pytest.approx(0.7 / 0.5)
    assert "35 °C: roof displacement 14.0 mm" in found[0][1]


def test_energy_parts_stand_one_upon_the_other(path: Path) -> None:
    with open_archive(path) as archive:
        found = {name: (caption, figure) for name, caption, figure in energy_figures(archive)}
    caption, figure = found[f"energy_DBE_{TABAS}"]
    bare: Any = figure.axes[0]
    tops = [line.get_ydata()[-1] for line in bare.lines]
    # 35 % yielding, 20 % dampers, 30 % damping, 15 % kinetic and elastic, of 10 kJ; the last line is the input
    assert tops == pytest.approx([3.5, 5.5, 8.5, 10.0, 10.0])
    assert len(bare.collections) == 4
    assert figure.axes[0].get_ylim() == figure.axes[1].get_ylim()
    assert "bare: input 10.0 kJ, yielding 35 %, dampers 20 %, inherent damping 30 %" in caption


def test_analyses_of_one_motion_without_labels_are_kept_apart(tmp_path: Path) -> None:
    """As in a project whose analyses `stiff` and `soft` of one record have no `variant`."""
    more = [
        (f"analyses/{name}.{TABAS}", history("", TABAS, 50 + i, 1.0 + i)) for i, name in enumerate(("stiff", "soft"))
    ]
    with open_archive(small_archive(tmp_path, *more)) as archive:
        found = [one for one in histories(archive) if one.variant in ("stiff", "soft", "")]
        colors = variant_colors(archive)
        figure = {name: figure for name, _, figure in response_figures(archive)}[f"response_DBE_{TABAS}"]
    assert [(one.variant, one.name) for one in found] == [(n, f"{n}.{TABAS}") for n in ("stiff", "soft")]
    assert len({colors[name] for name in ("bare", "damped", "stiff", "soft")}) == 4
    curves = {line.get_label(): np.max(line.get_ydata()) for line in figure.axes[1].lines if len(line.get_xdata()) > 2}
    assert curves["soft"] / curves["stiff"] == pytest.approx(2.0)
