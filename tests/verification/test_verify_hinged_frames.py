"""Frames with hinges, joints and springs at supports, from project files, against closed forms of portals."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.study.run.analyses import run_analysis

E, HEIGHT, SPAN = 210e9, 4.0, 8.0  # Pa, m
COLUMN, BEAM = 1e-4, 3e-4  # m4
FRAME = """\
edesign: 1
title: Portal
frame:
  bays: [8 m]
  storeys: [4 m]
  supports: @supports@
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: all, section: beam, material: steel}]
materials:
  steel: {law: elastic, E: 210 GPa}
sections:
  column: {area: 1000 m^2, inertia: 1e-4 m^4}
  beam: {area: 1000 m^2, inertia: 3e-4 m^4}
loads: {beams: [{floors: all, G: 10 kN/m}], gravity: {G: @G@, Q: 0}}
elements: {geometry: {columns: linear}}
masses:
  given: [{lines: all, floors: all, mass: 10 t}]
  directions: horizontal
@more@
analyses:
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: uniform, roof_drift: @drift@, steps: 400}
  - {name: modes, kind: modal, modes: 1, state: initial}
outputs: {members: [C_A_1, B_1_1]}
"""
HINGE = "{M_y: 400 kN*m, theta_p: 0.1 rad, theta_pc: 0.3 rad, theta_u: 0.4 rad, M_c_ratio: 1.001, M_r_ratio: 0.4%s}"


def run(analysis: str, more: str = "", supports: str = "fixed", drift: str = "1 %", G: str = "0") -> Group:
    text = FRAME
    for key, value in (("more", more), ("supports", supports), ("drift", drift), ("G", G)):
        text = text.replace(f"@{key}@", value)
    one = parse_project(text, "project.yaml", profile_names())
    group = run_analysis(one, next(item for item in one.analyses if item.name == analysis))
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def stiffness(group: Group) -> float:
    """Base shear over roof displacement in the first step."""
    return float(group.variables["base_shear"].values[1] / (group.variables["storey_drift"].values[1, 0] * HEIGHT))


def portal_stiffness(beam: float, base: float) -> float:
    """Sway stiffness of a portal of stiff axes, by slope deflection.

    Args:
        beam: moment over rotation at the ends of the beam in double curvature, its joints included, N m/rad.
        base: stiffness of the springs under the columns, N m/rad.
    """
    k = E * COLUMN / HEIGHT
    turning = np.array([[4.0 * k + base, 2.0 * k], [2.0 * k, 4.0 * k + beam]])
    sway = np.full(2, -6.0 * k / HEIGHT)
    return float(2.0 * (12.0 * k / HEIGHT**2 - sway @ np.linalg.solve(turning, sway)))


def test_semi_rigid_joints() -> None:
    """Joints of 20 MN m/rad at both ends of the beam: in series with 6 EI / L of it."""
    joint = 20e6
    group = run("push", "joints: [{beams: {floors: all}, stiffness: 20 MN*m/rad}]")
    beam = 1.0 / (SPAN / (6.0 * E * BEAM) + 1.0 / joint)
    assert stiffness(group) == pytest.approx(portal_stiffness(beam, 1e30), rel=1e-6)
    moment, chord = (group.variables[f"member_{name}"].values[-1, 1] for name in ("bending_moment", "chord_rotation"))
    np.testing.assert_allclose(moment, beam * chord, rtol=1e-6)  # the chord's rotation has the joint in it


def test_rotational_springs_at_supports() -> None:
    """The sway stiffness, and the reactions: those of the springs balance the columns."""
    springs = "{default: {rotation: 15 MN*m/rad}}"
    group = run("push", supports=springs)
    assert stiffness(group) == pytest.approx(portal_stiffness(6.0 * E * BEAM / SPAN, 15e6), rel=1e-6)
    column_bases = group.variables["member_bending_moment"].values[-1, 0, 0]
    resting = run("gravity", supports=springs, G="1.0")
    assert np.sum(resting.variables["reaction_y_final"].values) == pytest.approx(80e3, rel=1e-9)
    at_bases = resting.variables["member_bending_moment_max"].values[:2, 0]
    other = resting.variables["member_bending_moment_min"].values[:2, 0]
    np.testing.assert_allclose(resting.variables["reaction_moment_final"].values, at_bases + other, rtol=1e-7)
    assert abs(column_bases) > 1e3


def test_horizontal_and_vertical_springs_at_supports() -> None:
    """Vertical springs sink by 40 kN / 20 kN/mm under each base; horizontal ones add their flexibility to the sway."""
    springs = "{default: {horizontal: 5 kN/mm, vertical: 20 kN/mm}}"
    resting = run("gravity", supports=springs, G="1.0")
    np.testing.assert_allclose(resting.variables["node_displacement_y_final"].values[:2], -40.0 / 20e3, rtol=1e-6)
    group = run("push", supports="{default: {horizontal: 5 kN/mm}}")
    shear, roof = (group.variables[name].values[..., -1] for name in ("base_shear", "floor_displacement"))
    flexibility = 1.0 / portal_stiffness(6.0 * E * BEAM / SPAN, 1e30) + 1.0 / (2.0 * 5e6)
    step = 10
    moved = roof[step] if roof.ndim == 1 else group.variables["floor_displacement"].values[step, 0]
    assert moved == pytest.approx(group.variables["base_shear"].values[step] * flexibility, rel=1e-6)
    assert shear > 0.0


def test_a_base_that_lifts_off() -> None:
    """Pushed until one column base lifts: there the vertical force is none, and the other carries all of the load.

    The portal then turns about the other column base: H h = W L / 2 holds the push, but for 1e-4 of it that the springs
        of
    1 kN m/rad carry, without which nothing would hold it at the limit.
    """
    springs = "{default: {vertical: {stiffness: 200 kN/mm, uplift: true}, rotation: 1 kN*m/rad}}"
    group = run("push", supports=springs, G="1.0", drift="2 %")
    load = 10e3 * SPAN
    lifted = group.variables["base_shear"].values[-1]
    assert lifted == pytest.approx(load * SPAN / 2.0 / HEIGHT, rel=3e-4)


@pytest.mark.parametrize("place", ["", ", distance: 0.6 m", ", ends: start"])
def test_hinges_do_not_change_the_elastic_frame(place: str) -> None:
    """Period, sway stiffness and moments under gravity are those of the frame without hinges."""
    values = HINGE % ""
    more = f"hinges: [{{beams: {{floors: all}}, parameters: {values}{place}}}, {{columns: {{storeys: all}}, "
    more += f"parameters: {values}}}]"
    plain, hinged = (run("modes", text) for text in ("", more))
    np.testing.assert_allclose(hinged.variables["period"].values, plain.variables["period"].values, rtol=1e-7)
    plain, hinged = (run("gravity", text, G="1.0") for text in ("", more))
    for name in ("member_bending_moment_min", "member_bending_moment_max", "member_shear_force_max"):
        mine, theirs = hinged.variables[name].values, plain.variables[name].values
        np.testing.assert_allclose(mine, theirs, rtol=1e-7, atol=1e-2)


def test_mechanism_of_hinges_with_other_strengths_sagging_and_hogging() -> None:
    """Pinned bases, hinges in the beam: H h = M_sagging + M_hogging, whatever the gravity load.

    The hinges are elastic-plastic but for 0.1 % of hardening, without which a mechanism is singular: sagging 400 kN m,
    hogging 250 kN m.
    """
    values = HINGE % ", hogging: {M_y: 250 kN*m}"
    more = f"hinges: [{{beams: {{floors: all}}, parameters: {values}}}]"
    group = run("push", more, supports="pinned", drift="8 %", G="1.0")
    shear = group.variables["base_shear"].values
    assert np.max(shear) == pytest.approx(650e3 / HEIGHT, rel=1e-3)
    moment = group.variables["member_bending_moment"].values[-1, 1]
    # pushed to the right: the beam sags at its left end and hogs at its right end
    np.testing.assert_allclose(np.abs(moment), [400e3, 250e3], rtol=1e-3)
    plastic = group.variables["member_plastic_rotation"].values[-1, 1]
    assert abs(plastic[0]) > 0.005 and abs(plastic[1]) > 0.005


def test_hinges_away_from_the_nodes() -> None:
    """Hinges at 1 m from the nodes: the mechanism needs M_y L / (L - 2 e) at the nodes."""
    more = f"hinges: [{{beams: {{floors: all}}, distance: 1 m, parameters: {HINGE % ''}}}]"
    group = run("push", more, supports="pinned", drift="8 %")
    at_nodes = 400e3 * SPAN / (SPAN - 2.0)
    assert np.max(group.variables["base_shear"].values) == pytest.approx(2.0 * at_nodes / HEIGHT, rel=1e-3)
    # rigid-plastic: the joint turns by the drift, the hinge by L / (L - 2 e) of what is not elastic
    chord = group.variables["member_chord_rotation"].values[-1, 1]
    plastic = group.variables["member_plastic_rotation"].values[-1, 1]
    elastic = group.variables["member_bending_moment"].values[-1, 1] * SPAN / (6.0 * E * BEAM)
    np.testing.assert_allclose(plastic, (chord - elastic) * SPAN / (SPAN - 2.0), rtol=1e-3)
