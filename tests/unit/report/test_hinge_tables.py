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
    assert hinges.rows == [
        ["B_1_1:end", "400.0", "20.00", "30.00", "150", "100.0", "push"],
        ["B_1_1:end", "400.0", "20.00", "10.00", "50.0", "80.00", "shake"],
    ]
    assert supports.rows == [["A0", "sway [mm]", "2.000", "shake"]]


def test_one_row_where_one_analysis_governs() -> None:
    hinges, _ = hinge_tables({"push": hinged(0.03, 0.5, 0.001), "shake": hinged(0.01, 0.8, 0.002)})
    assert [row[-1] for row in hinges.rows] == ["push"]
