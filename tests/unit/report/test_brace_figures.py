"""Loops of braces that buckle: the panels are of the braces that moved most, the caption has the largest numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.report.figure_archive import RECORDS, history, small_archive

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import open_archive
from edesign.report.response.brace_figures import MOST, brace_figures


def braced(count: int) -> Group:
    """Brace i lengthens by i mm and shortens by 2 i mm, under 10 i kN and 5 i kN; the first yields at 1.5 mm."""
    group = history("bare", RECORDS[0], 3, 1.0)
    names = [f"D_{i}" for i in range(1, count + 1)]
    each = np.arange(1.0, count + 1.0)
    for coordinate in ("recorded_brace", "buckling_brace"):
        group.coords[coordinate] = Variable((coordinate,), np.array(names), "", "")
    steps = len(group.coords["time"].values)
    shape = np.interp(np.arange(steps), [0, steps // 3, 2 * steps // 3, steps - 1], [0.0, 1.0, -2.0, 0.0])
    forces = np.where(shape > 0.0, shape, 0.25 * shape)
    dims = ("time", "recorded_brace")
    group.add("recorded_brace_elongation", dims, np.outer(shape, 1e-3 * each), "m", "")
    group.add("recorded_brace_axial_force", dims, np.outer(forces, 10e3 * each), "N", "")
    group.add("brace_yield_elongation", ("buckling_brace",), np.full(count, 1.5e-3), "m", "")
    return group


def test_loops_are_those_of_the_archive(tmp_path: Path) -> None:
    with open_archive(small_archive(tmp_path, ("analyses/a", braced(MOST + 1)))) as archive:
        ((name, caption, figure),) = brace_figures(archive)
    assert name == "braces_a"
    panels = [axis for axis in figure.axes if axis.get_visible()]
    # the first brace moves least and is left out
    assert [axis.get_title(loc="left") for axis in panels] == [f"D_{i}" for i in range(2, MOST + 2)]
    loop = panels[0].lines[-1]
    # the largest and the least of each third lie at samples, or within one of them
    assert np.max(loop.get_xdata()) == pytest.approx(2.0, rel=0.05)
    assert np.min(loop.get_ydata()) == pytest.approx(-10.0, rel=0.05)
    dashed = [line.get_xdata()[0] for line in panels[0].lines if line.get_linestyle() == "--"]
    assert dashed == pytest.approx([-1.5, 1.5])
    assert caption.startswith("Braces that buckle: axial force against elongation, a. Largest compression ")
    assert caption.count(f"(D_{MOST + 1})") == 2
