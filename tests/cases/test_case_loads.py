"""Loads inside members and the leaning column, against statics and closed forms worked out from the project files."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
G = 9.80665  # m/s2

# ---- loads_inside_members: (load N, x of its resultant m) by hand; lines at 0, 6, 14 m

STRIP = 2.5 * (3.0 + 0.3 * 2.0)  # kN/m on every beam
VERTICAL = [
    (2 * STRIP * 6.0, 3.0),
    (2 * STRIP * 8.0, 10.0),
    (66.0, 2.0),
    (66.0, 4.0),
    (40.0, 9.0),
    (6.0 * 2.0, 11.0),  # the trapezoid as a rectangle and a triangle
    (0.5 * 6.0 * 2.0, 10.0 + 2.0 * 2.0 / 3.0),
    (30.0, 3.0),
    (4.0 * 4.0, 4.0),
    (0.5 * 4.0 * 4.0, 2.0 + 2.0 * 4.0 / 3.0),
]  # kN, m
PUSHED = 5.0 * 4.0  # kN on column A of the first storey, its resultant 2 m above the base


def test_reactions_balance_loads_inside_members(results_of: Results) -> None:
    group = results_of("loads_inside_members", "gravity")
    across, upwards, moment = (group.variables[f"reaction_{part}_final"].values for part in ("x", "y", "moment"))
    assert upwards.sum() == pytest.approx(1e3 * sum(load for load, _ in VERTICAL), rel=1e-8)
    assert across.sum() == pytest.approx(-1e3 * PUSHED, rel=1e-6)
    about_a0 = 1e3 * sum(load * x for load, x in VERTICAL) + 1e3 * PUSHED * 2.0
    # P-Delta of columns moves forces by the drifts; vertical forces of 500 kN by 1 mm at most
    assert upwards @ [0.0, 6.0, 14.0] + moment.sum() == pytest.approx(about_a0, abs=500.0)


def test_nodes_take_the_masses_of_loads_inside_beams(results_of: Results) -> None:
    mass = results_of("loads_inside_members", "modes").attributes["mass_kg"]
    assert mass == pytest.approx(1e3 * sum(load for load, _ in VERTICAL) / G, rel=1e-12)


def test_moments_along_a_beam_on_hinges_are_those_of_statics(results_of: Results) -> None:
    """B_2_1 under gravity alone: the step before the pushover; integrated in four pieces of five Lobatto points."""
    group = results_of("loads_inside_members", "push")
    rule = 0.5 + 0.5 * np.array([-1.0, -math.sqrt(3.0 / 7.0), 0.0, math.sqrt(3.0 / 7.0), 1.0])
    breaks = [0.0, 3.0, 4.0, 6.0, 8.0]
    x = np.unique(np.concatenate([a + (b - a) * rule for a, b in zip(breaks[:-1], breaks[1:], strict=True)]))
    assert list(group.coords["section"].values) == [f"B_2_1:{i}" for i in range(1, 18)]
    part = np.clip(x - 4.0, 0.0, 2.0)  # of the trapezoid, 6 + 3 s kN/m, before x
    before = 6.0 * part + 1.5 * part**2
    first_moment = 3.0 * part**2 + part**3  # of what is before, about the trapezoid's start
    left = (STRIP * 32.0 + 40.0 * 5.0 + 12.0 * 3.0 + 6.0 * (8.0 - 4.0 - 4.0 / 3.0)) / 8.0
    moments = left * x - STRIP * x**2 / 2.0 - 40.0 * np.maximum(x - 3.0, 0.0) - before * (x - 4.0) + first_moment
    found = group.variables["section_moment"].values[0] / 1e3
    np.testing.assert_allclose(found, moments, atol=1e-5 * moments.max())  # kept in single precision


# ---- leaning_column

H, STIFFNESS, WEIGHT = 4.0, 2.0 * 3.0 * 210e9 * 2.5e-4 / 4.0**3, 1400e3 + 0.3 * 500e3
THETA = WEIGHT / (STIFFNESS * H)


def test_leaning_loads_lengthen_the_period(results_of: Results) -> None:
    """k - P / h: one mass, exact in the P-Delta geometry, as the cantilevers themselves carry nothing."""
    period = 2.0 * math.pi * math.sqrt(WEIGHT / G / STIFFNESS)
    found = {name: results_of("leaning_column", name) for name in ("unloaded", "modes")}
    assert found["unloaded"].variables["period"].values[0] == pytest.approx(period, rel=1e-9)
    assert found["modes"].variables["period"].values[0] == pytest.approx(period / math.sqrt(1.0 - THETA), rel=1e-9)
    assert found["modes"].attributes["mass_kg"] == pytest.approx(WEIGHT / G, rel=1e-12)


def test_leaning_loads_amplify_the_drift(results_of: Results) -> None:
    """u = H / (k - P / h): 1 / (1 - theta) of the first order; the frame's columns take H + P u / h."""
    group = results_of("leaning_column", "push")
    u, lateral = group.variables["roof_displacement"].values, group.variables["lateral_load"].values
    np.testing.assert_allclose(u, lateral / STIFFNESS / (1.0 - THETA), rtol=1e-7)
    taken, of_columns = group.variables["leaning_column_shear_final"].values[0], STIFFNESS * u[-1]
    assert taken == pytest.approx(-WEIGHT * u[-1] / H, rel=1e-7)
    assert group.variables["storey_shear_final"].values[0] == pytest.approx(of_columns, rel=1e-7)
    assert group.variables["base_shear_final"].values == pytest.approx(lateral[-1], rel=1e-7)
    assert group.variables["leaning_column_axial_force_final"].values[0] == pytest.approx(-WEIGHT, rel=1e-9)


def test_a_leaning_column_is_no_member(results_of: Results) -> None:
    group = results_of("leaning_column", "gravity")
    assert list(group.coords["column"].values) == ["C_A_1", "C_B_1"]
    assert list(group.coords["node"].values) == ["A0", "B0", "A1", "B1"]
    assert np.abs(group.variables["column_axial_force_final"].values).max() < 1e-3  # N
