"""Loops of dampers as figures."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.report.damper_loops import MOST, loops_figure


def history(dampers: int) -> Group:
    """Ellipses that grow with the number of the damper."""
    angle = np.linspace(0.0, 2.0 * np.pi, 50)
    size = np.arange(1, dampers + 1)
    group = Group()
    group.coords["damper"] = Variable(("damper",), np.array([f"V_1_{i}" for i in size]), "", "name")
    group.add("damper_deformation", ("time", "damper"), 1e-3 * np.outer(np.sin(angle), size), "m", "deformation")
    group.add("damper_force", ("time", "damper"), 1e4 * np.outer(np.cos(angle), size), "N", "force")
    return group


def test_every_damper_has_its_loop_in_mm_and_kN():
    figure = loops_figure(history(5), "quake")
    axes = [axis for axis in figure.axes if axis.get_visible()]
    assert [axis.get_title() for axis in axes] == [f"V_1_{i}" for i in range(1, 6)]
    x, y = axes[4].lines[0].get_xdata(), axes[4].lines[0].get_ydata()
    assert np.max(x) == np.float64(5.0 * np.max(np.sin(np.linspace(0.0, 2.0 * np.pi, 50))))
    assert y[0] == 50.0
    assert axes[0].get_xlim() == axes[4].get_xlim()  # one scale


def test_of_many_those_with_the_largest_deformation_are_shown():
    figure = loops_figure(history(MOST + 3), "quake")
    titles = [axis.get_title() for axis in figure.axes if axis.get_visible()]
    assert titles == [f"V_1_{i}" for i in range(4, MOST + 4)]
    assert figure.get_suptitle() == f"quake, the {MOST} with the largest deformation"
