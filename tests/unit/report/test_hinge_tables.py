"""Tables of hinges and springs: every row is of one analysis, and names it."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.report.response.hinge_tables import hinge_tables


def hinged(rotation: float, left: float, sway: float) -> Group:
    """Results of an analysis with one hinge of theta_p = 20 mrad and one support on springs."""
    group = Group()
    group.coords["hinge"] = Variable(("hinge",), np.array(["B_1_1:end"]), "", "")
    group.coords["sprung_support"] = Variable(("sprung_support",), np.array(["A0"]), "", "")
    for name, value in (
        ("M_y", 400e3),
        ("theta_p", 0.02),
        ("plastic_rotation_max", rotation),
        ("plastic_rotation_min", 0.0),
        ("strength_left_final", left),
    ):
        group.add(f"hinge_{name}", ("hinge",), [value], "", "")
    for which, value in (("max", sway), ("min", 0.0)):
        group.add(f"support_displacement_x_{which}", ("sprung_support",), [value], "m", "")
    return group


def test_every_row_is_of_one_analysis() -> None:
    """The push turns the hinge most, the shaking weakens it most: a row of each, with the values of that analysis."""
    hinges, supports = hinge_tables({"push": hinged(0.03, 1.0, 0.001), "shake": hinged(0.01, 0.8, 0.002)})
    assert hinges.texts == [
        ["B_1_1:end", "400.0", "20.00", "30.00", "150", "100.0", "push"],
        ["B_1_1:end", "400.0", "20.00", "10.00", "50.0", "80.00", "shake"],
    ]
    assert supports.texts == [["A0", "sway [mm]", "2.000", "shake"]]


def test_one_row_where_one_analysis_governs() -> None:
    hinges, _ = hinge_tables({"push": hinged(0.03, 0.5, 0.001), "shake": hinged(0.01, 0.8, 0.002)})
    assert [row[-1] for row in hinges.texts] == ["push"]


def sprung(moment: float, distortion: float, rotation: float) -> Group:
    """Results of an analysis with a panel zone that yields at 4 mrad and a joint of S_j = 90 MN m/rad."""
    group = Group()
    group.coords["panel"] = Variable(("panel",), np.array(["B1"]), "", "")
    group.coords["joint"] = Variable(("joint",), np.array(["B_1_1:end"]), "", "")
    for name, value in (
        ("panel_stiffness", 100e6),
        ("panel_yield_moment", 400e3),
        ("panel_moment", moment),
        ("panel_distortion", distortion),
        ("joint_stiffness", 90e6),
        ("joint_M_y", np.inf),
        ("joint_stiffness_ratio", 12.0),
        ("joint_rotation", rotation),
        ("joint_moment", 90e6 * rotation),
    ):
        coordinate = name.partition("_")[0]
        if name in ("panel_moment", "panel_distortion", "joint_rotation", "joint_moment"):
            group.add(f"{name}_max", (coordinate,), [0.0], "", "")
            group.add(f"{name}_min", (coordinate,), [-value], "", "")
        else:
            group.add(name, (coordinate,), [value], "", "")
    group.add("joint_class", ("joint",), np.array(["semi-rigid"]), "", "")
    return group


def test_panel_zones_and_joints_are_of_the_analysis_that_strained_them_most() -> None:
    """8 mrad are twice 400 kN m / 100 MN m/rad; a joint without a resistance has none."""
    joints, panels = hinge_tables({"push": sprung(500e3, 0.008, 0.002), "shake": sprung(300e3, 0.003, 0.005)})
    assert panels.texts == [["B1", "400.0", "500.0", "4.000", "8.000", "2.00", "push"]]
    assert joints.texts == [["B_1_1:end", "90.00", "12.0", "semi-rigid", "-", "450.0", "5.000", "shake"]]
