"""Moment against rotation, axial forces and mode shapes: what is drawn is what is archived."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.report.figure_archive import RECORDS, TIME, history, small_archive

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.mode_figures import mode_figures
from edesign.report.response.moment_rotation_figures import moment_rotation_figures
from edesign.study.results.recording import coordinate


def with_member(variant: str, order: int, size: float, plastic: bool) -> tuple[str, Group]:
    group = history(variant, RECORDS[0], order, 1.0)
    coordinate(group, "recorded_member", ["C_A_1", "D_1_1_r"], "", "member")
    wave = np.zeros((TIME.size, 2, 2))
    wave[:, 0, 0] = np.sin(TIME)
    wave[:, 0, 1] = 0.5 * np.sin(TIME)
    dims = ("time", "recorded_member", "end")
    group.add("member_bending_moment", dims, size * 1e5 * wave, "N*m", "moment")
    group.add("member_chord_rotation", dims, size * 0.01 * wave, "rad", "chord")
    group.add("member_plastic_rotation", dims, size * 0.004 * wave * plastic, "rad", "plastic")
    return f"analyses/{variant}.DBE.loops", group


def test_moment_rotation_of_both_ends(tmp_path: Path) -> None:
    more = (with_member("weak", 40, 2.0, True), with_member("strong", 41, 1.0, False))
    with open_archive(small_archive(tmp_path, *more)) as archive:
        found = list(moment_rotation_figures(archive))
    assert [name for name, _, _ in found] == [f"moment_rotation_C_A_1_DBE_{RECORDS[0]}"]  # the brace has no moments
    _, caption, figure = found[0]
    bottom, top, plastic_bottom, plastic_top = figure.axes
    assert [axis.get_title("left") for axis in (bottom, top)] == ["bottom end", "top end"]
    assert plastic_bottom.get_xlabel() == "plastic rotation (mrad)"
    curves = {line.get_label(): line for line in bottom.lines}
    np.testing.assert_allclose(curves["weak"].get_xdata(), 20.0 * np.sin(TIME))
    np.testing.assert_allclose(curves["weak"].get_ydata(), 200.0 * np.sin(TIME))
    np.testing.assert_allclose({line.get_label(): line for line in top.lines}["strong"].get_xdata(), 5.0 * np.sin(TIME))
    assert bottom.get_xlim() == top.get_xlim() and plastic_bottom.get_ylim() == plastic_top.get_ylim()
    assert "weak: largest moment 200 kN m, chord rotation 20.0 mrad, plastic rotation 8.00 mrad" in caption
    assert "strong: largest moment 100 kN m, chord rotation 10.0 mrad, no plastic rotation" in caption


def test_axial_forces_span_the_mean_of_the_extremes(tmp_path: Path) -> None:
    gravity = history("bare", "", 50, 0.0, kind="gravity")
    gravity.add("column_axial_force_final", ("column",), np.array([-4e5, -4e5, -2e5, -2e5]), "N", "gravity")
    with open_archive(small_archive(tmp_path, ("analyses/bare.gravity", gravity))) as archive:
        ((name, caption, figure),) = axial_figures(archive)
    assert name == "axial_DBE"
    line_a, line_b = figure.axes
    assert [axis.get_title("left") for axis in (line_a, line_b)] == ["line A", "line B"]
    assert line_a.get_xlim() == line_b.get_xlim()
    bars = sorted((bar.get_y() + 0.5 * bar.get_height(), bar.get_x(), bar.get_width()) for bar in line_a.patches)
    # first storey, damped below bare: -400 kN -+ 0.65 (200, 100) and -+ 2 (200, 100); means over 2 and 3 records
    assert [bar[1:] for bar in bars[:2]] == [pytest.approx((-530.0, 195.0)), pytest.approx((-800.0, 600.0))]
    assert bars[0][0] < 1.0 < bars[1][0]
    ticks = [line for line in line_a.lines if line.get_linewidth() == 1.3]
    assert [line.get_xdata()[0] for line in ticks] == pytest.approx([-400.0, -200.0])
    assert "bare: largest compression 800 kN (line A, storey 1), mean of 3 records, in one record 1000 kN" in caption
    assert "Missing" in caption


def test_modes_have_one_size_and_the_roof_to_the_right(tmp_path: Path) -> None:
    more = []
    for order, (variant, period, shape) in enumerate(
        (("bare", [2.0, 0.6], [[0.5, 1.0], [1.0, -0.8]]), ("damped", [1.5, 0.5], [[0.4, 1.0], [-0.9, 1.0]]))
    ):
        group = Group()
        coordinate(group, "mode", [1, 2], "1", "mode")
        coordinate(group, "floor", [1, 2], "1", "floor")
        group.add("period", ("mode",), period, "s", "period")
        group.add("floor_shape", ("mode", "floor"), shape, "1", "shape")
        group.attributes |= {"kind": "modal", "variant": variant, "status": "completed", "order": 60 + order}
        more.append((f"analyses/{variant}.modes", group))
    with open_archive(small_archive(tmp_path, *more)) as archive:
        ((name, caption, figure),) = mode_figures(archive)
    assert name == "modes" and "bare 2.00, 0.600 s; damped 1.50, 0.500 s" in caption
    first, second = figure.axes
    assert [line.get_xdata() for line in second.lines[1:]] == [
        pytest.approx([0.0, -1.0, 0.8]),
        pytest.approx([0.0, -0.9, 1.0]),
    ]
    assert {text.get_text() for text in first.texts} == {"bare 2.00 s", "damped 1.50 s"}
