"""Modal and gravity analyses against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from shear_frames import AREA, HEIGHT, MASS, STIFFNESS, E
from unit.study.frames import NODE_MASS, THESIS_4_BAYS, project, shear_frame

from edesign.study.run.analyses import run_analysis


def test_period_of_one_storey() -> None:
    """T = 2 pi sqrt(2 m / k); of the flexibility of beam and columns' length 1e-7 is left."""
    made = shear_frame("{name: m, kind: modal, modes: 1, state: initial}")
    group = run_analysis(made, made.analyses[0])
    assert group.attributes["status"] == "completed"
    assert group.variables["period"].values == pytest.approx([2 * math.pi * math.sqrt(MASS / STIFFNESS)], rel=1e-6)
    assert group.variables["effective_mass_ratio_x"].values == pytest.approx([1.0], rel=1e-9)
    assert group.variables["participation_factor_x"].values == pytest.approx([1.0], rel=1e-9)
    assert group.attributes["mass_kg"] == 2 * NODE_MASS


def test_two_equal_storeys() -> None:
    """w^2 = (3 -+ sqrt 5)/2 k/m; phi_1 = (0.618, 1), phi_2 = (-0.618, 1) scaled to a largest value of 1."""
    made = shear_frame("{name: m, kind: modal, modes: 2, state: initial}", storeys=2)
    found = run_analysis(made, made.analyses[0]).variables
    golden = (math.sqrt(5) - 1) / 2
    omega = np.sqrt((3 + np.array([-1, 1]) * math.sqrt(5)) / 2 * STIFFNESS / (2 * NODE_MASS))
    assert found["circular_frequency"].values == pytest.approx(omega, rel=1e-6)
    assert found["floor_shape"].values == pytest.approx(np.array([[golden, 1], [1, -golden]]), abs=1e-6)
    shares = found["effective_mass_ratio_x"].values
    assert shares == pytest.approx(
        [(1 + golden) ** 2 / (1 + golden**2) / 2, (1 - golden) ** 2 / (1 + golden**2) / 2], rel=1e-6
    )
    assert found["cumulative_mass_ratio_x"].values[-1] == pytest.approx(1.0, rel=1e-9)
    # the modes together represent a unit displacement of the ground: sum of Gamma phi = 1 at every floor
    assert found["participation_factor_x"].values @ found["floor_shape"].values == pytest.approx([1.0, 1.0], rel=1e-6)


def test_periods_of_the_four_bay_frame_of_the_thesis() -> None:
    """2.7486 s bare and 2.8150 s under gravity with P-Delta, from an OpenSeesPy model of the same frame."""
    made = project(THESIS_4_BAYS)
    bare, loaded = (run_analysis(made, spec).variables["period"].values[0] for spec in made.analyses)
    assert bare == pytest.approx(2.7486, abs=1e-4)
    assert loaded == pytest.approx(2.8150, abs=1e-4)


def test_too_many_modes_is_a_failed_analysis_with_a_reason() -> None:
    made = shear_frame("{name: m, kind: modal, modes: 5}")
    group = run_analysis(made, made.analyses[0])
    assert group.attributes["status"] == "failed"
    assert "5 modes asked for" in str(group.attributes["reason"])
    assert group.attributes["name"] == "m" and group.attributes["kind"] == "modal"


def test_gravity_of_two_storeys() -> None:
    """12 kN/m on 8 m: 48 kN in a column from each floor above it, no sway; columns shorten by N h / (E A)."""
    made = shear_frame("{name: g, kind: gravity}", storeys=2)
    found = run_analysis(made, made.analyses[0])
    values = {name: variable.values for name, variable in found.variables.items()}
    assert list(found.coords["column"].values) == ["C_A_1", "C_B_1", "C_A_2", "C_B_2"]
    assert values["column_axial_force_final"] == pytest.approx([-96e3, -96e3, -48e3, -48e3], rel=1e-9)
    assert values["column_axial_force_min"] == pytest.approx(values["column_axial_force_final"], rel=1e-12)
    assert values["reaction_y_final"] == pytest.approx([96e3, 96e3], rel=1e-9)
    assert abs(values["base_shear_final"]) < 1e-6 and np.all(np.abs(values["storey_drift_max"]) < 1e-12)
    nodes = dict(zip(found.coords["node"].values, values["node_displacement_y_final"], strict=True))
    assert nodes["A1"] == pytest.approx(-96e3 * HEIGHT / (E * AREA), rel=1e-9)
    assert nodes["B2"] == pytest.approx(-(96e3 + 48e3) * HEIGHT / (E * AREA), rel=1e-9)
    assert found.attributes["statistics"]["steps"] == 10


def test_a_mechanism_is_a_failed_analysis_that_names_it() -> None:
    text = THESIS_4_BAYS.replace("bays: {count: 4, width: 7.2 m}", "bays: [7.2 m]\n  supports: roller")
    made = project(text.replace("lines: B-D, floors: all", "lines: A, floors: all").replace("[A, E]", "B"))
    group = run_analysis(made, made.analyses[1])
    assert group.attributes["status"] == "failed"
    assert "mechanism" in str(group.attributes["reason"]) and "ux" in str(group.attributes["reason"])
