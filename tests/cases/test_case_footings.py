"""The case on footings: what its project says put into formulas here, statics, and the work of its dashpots."""

from __future__ import annotations

from collections.abc import Callable
from math import pi, sqrt

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
CASE = "footings_on_soil"
G_CLAY = 1900.0 * 180.0**2 * 0.43  # EN 1998-5, Table 4.1, halfway between 0.2 g and 0.3 g
G_SAND = 60e6 * 0.70  # ASCE/SEI 7-16, Table 19.3-2, class D, halfway between 0.1 g and 0.4 g


def of(group: Group, name: str) -> np.ndarray:
    return group.variables[f"footing_{name}"].values


def test_soils_and_static_stiffness_by_hand(results_of: Results) -> None:
    """Footing B, 1.8 m along and 3.6 m across the frame: sway along its short side, rocking about its long one."""
    group = results_of(CASE, "modes")
    assert list(group.coords["footing"].values) == ["A0", "B0", "C0"]
    assert of(group, "shear_modulus") == pytest.approx([G_CLAY, G_CLAY, G_SAND], rel=1e-12)
    assert of(group, "soil_damping") == pytest.approx([0.08, 0.08, 0.045], rel=1e-12)
    B, nu = 0.9, 0.45
    expected = (
        G_CLAY * B / (2.0 - nu) * (6.8 * 2.0**0.65 + 1.6 + 1.6),
        G_CLAY * B / (1.0 - nu) * (3.1 * 2.0**0.75 + 1.6),
        G_CLAY * B**3 / (1.0 - nu) * 7.2,
    )
    for direction, value in zip(("x", "y", "rotation"), expected, strict=True):
        assert of(group, f"static_stiffness_{direction}")[1] == pytest.approx(value, rel=1e-12)


def test_dashpots_belong_to_their_ratios(results_of: Results) -> None:
    """c = 2 K (beta + beta_s) / omega at the period; sway of B radiates 4 L B rho V_s at any frequency."""
    group = results_of(CASE, "modes")
    for direction in ("x", "y", "rotation"):
        ratios = of(group, f"radiation_damping_{direction}") + of(group, "soil_damping")
        expected = of(group, f"stiffness_{direction}") * ratios * of(group, "period") / pi
        if direction == "y":
            expected[2] = 0.0  # it lifts off
        assert of(group, f"dashpot_{direction}") == pytest.approx(expected, rel=1e-12)
    waves = 1900.0 * sqrt(G_CLAY / 1900.0) * 1.8 * 3.6
    radiated = of(group, "radiation_damping_x")[1] * of(group, "stiffness_x")[1] * of(group, "period")[1] / pi
    assert radiated == pytest.approx(waves, rel=1e-12)


def test_weight_of_frame_and_footings_reaches_the_ground(results_of: Results) -> None:
    """30 kN/m + 0.3 * 10 kN/m on 24 m of beams, and one footing block of concrete."""
    group = results_of(CASE, "gravity")
    block = 2500.0 * 2.4 * 2.0 * 0.6 * 9.80665
    total = group.variables["support_reaction_y_final"].values.sum()
    assert total == pytest.approx(33e3 * 24.0 + block, rel=1e-9)
    settled = group.variables["support_displacement_y_final"].values
    reaction = group.variables["support_reaction_y_final"].values
    stiffness = of(results_of(CASE, "modes"), "stiffness_y")
    assert -settled * stiffness == pytest.approx(reaction, rel=1e-9)


def test_the_frame_is_softer_on_its_footings(results_of: Results) -> None:
    """The first period is longer than on fixed bases. One mass on a rigid base bounds it from below: it leaves out that
    each column base turns on its own."""
    modes = results_of(CASE, "modes").attributes
    assert modes["period_ratio"] > modes["closed_period_ratio"] > 1.0
    assert 0.0 < modes["closed_foundation_damping"] < modes["foundation_damping"] < 0.01


def test_dashpots_dissipate_and_the_footing_lifts_off(results_of: Results) -> None:
    """No tension under C; the work of all dashpots is the energy of dampers in the balance."""
    group = results_of(CASE, "shake")
    assert group.variables["support_reaction_y_min"].values[2] >= 0.0
    assert group.variables["support_displacement_y_max"].values[2] > 0.0
    work = of(group, "work_final")
    assert (work > 0.0).all()
    energy = dict(zip(group.coords["energy_term"].values.tolist(), group.variables["energy"].values[-1], strict=True))
    assert work.sum() == pytest.approx(energy["dampers"], rel=1e-6)
