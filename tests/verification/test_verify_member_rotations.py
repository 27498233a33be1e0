"""Recorded rotations of member ends against closed forms of beams."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.study.run.analyses import run_analysis

E, INERTIA, HEIGHT = 210e9, 1e-4, 4.0  # Pa, m4, m
FRAME = """\
edesign: 1
title: Portal
frame:
  bays: [8 m]
  storeys: [4 m]
  columns: [{storeys: all, section: @column@, material: @steel@}]
  beams: [{floors: all, section: rigid, material: elastic}]
  @more@
materials:
  elastic: {law: elastic, E: 210 GPa}
  steel: {law: bilinear, E: 210 GPa, fy: 250 MPa}
sections:
  bar: {area: 1000 m^2, inertia: 1e-4 m^4}
  layers: {rectangles: [{width: 100 mm, depth: 200 mm, centre: 0 m}]}
  rigid: {area: 1000 m^2, inertia: 1e6 m^4}
elements: {geometry: {columns: linear}}
masses:
  given: [{lines: all, floors: all, mass: 1 t}]
analyses:
  - {name: push, kind: pushover, pattern: uniform, roof_drift: @drift@, steps: 20}
outputs: {members: [C_A_1, B_1_1]}
"""


def push(column: str = "bar", steel: str = "elastic", more: str = "", drift: str = "1 %") -> Group:
    text = FRAME.replace("@column@", column).replace("@steel@", steel).replace("@more@", more).replace("@drift@", drift)
    one = parse_project(text, "project.yaml", profile_names())
    group = run_analysis(one, one.analyses[0])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def test_cantilever_with_a_load_at_its_tip() -> None:
    """The beam is hinged to the columns: each is a cantilever, u = P L^3 / (3 E I), tip rotation P L^2 / (2 E I).

    Against the chord, u / L clockwise, the base turns by P L^2 / (3 E I), the tip back by P L^2 / (6 E I) (Timoshenko,
    Strength of Materials I, art. 39). The axial stiffness of the column is 1e7 times that in bending.
    """
    group = push(more="releases: [{beams: {floors: all, bays: all}, ends: both}]")
    moment = group.variables["member_bending_moment"].values[-1, 0]
    chord = group.variables["member_chord_rotation"].values[-1, 0]
    load = moment[0] / HEIGHT
    assert load == pytest.approx(3.0 * E * INERTIA * 0.04 / HEIGHT**3, rel=1e-6)  # of 1 % of 4 m
    assert moment[1] == pytest.approx(0.0, abs=1e-6 * moment[0])
    unit = load * HEIGHT**2 / (E * INERTIA)
    assert chord == pytest.approx([unit / 3.0, -unit / 6.0], rel=1e-6)
    assert chord == pytest.approx([0.01, -0.005], rel=1e-6)  # the base does not turn: it is the drift


def test_column_between_nodes_that_do_not_turn() -> None:
    """Rigid beam: both ends turn against the chord by the drift, with 6 E I / L times it as moment."""
    group = push()
    chord = group.variables["member_chord_rotation"].values[:, 0]
    drift = group.variables["storey_drift"].values[:, 0]
    np.testing.assert_allclose(chord, np.stack((drift, drift), axis=1), rtol=1e-6, atol=1e-12)
    moment = group.variables["member_bending_moment"].values[:, 0]
    np.testing.assert_allclose(moment, 6.0 * E * INERTIA / HEIGHT * chord, rtol=1e-6, atol=1e-3)
    assert "member_plastic_rotation" not in group.variables  # nothing recorded can yield


def test_plastic_part_is_the_chord_rotation_less_the_elastic_part() -> None:
    """Elastic-perfectly plastic column of 16 layers: theta_p = theta_i - L / (6 E I) (2 M_i - M_j)."""
    group = push(column="layers", steel="steel", drift="5 %")
    inertia = 0.1 * 0.2**3 / 12.0 * (1.0 - 1.0 / 16**2)  # of 16 lumped layers
    variables = group.variables
    chord, plastic = (variables[f"member_{part}_rotation"].values[:, 0] for part in ("chord", "plastic"))
    moment = variables["member_bending_moment"].values[:, 0]
    elastic = (
        HEIGHT / (6.0 * E * inertia) * (2.0 * moment - moment[:, ::-1])
    )  # the columns' axial strain tilts the beam
    np.testing.assert_allclose(plastic, chord - elastic, rtol=1e-9, atol=1e-12)
    elastic_drift = 250e6 / E * HEIGHT / 6.0 / (0.1 * 15 / 16)  # first yield of the outer layer
    assert np.all(np.abs(plastic[np.abs(chord) < 0.99 * elastic_drift]) < 1e-12)
    assert plastic[-1] == pytest.approx([0.05 - 100e3 * 2.5 * HEIGHT / (6.0 * E * inertia)] * 2, rel=2e-3)  # M_p
    assert np.all(variables["member_plastic_rotation"].values[:, 1] == 0.0)  # the beam stays elastic
    assert plastic[-1] == pytest.approx(variables["column_plastic_rotation_max"].values[0], rel=1e-12)
