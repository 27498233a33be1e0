"""Loads inside members that hinges, joints and panel zones divide, and what reaches the ground: by statics."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy.signal

from edesign.archive.dataset import Group
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.study.run.analyses import run_analysis

CASES = Path(__file__).parents[1] / "cases"
SPAN, HEIGHT = 8.0, 4.0  # m
PROJECT = """\
edesign: 1
title: Portal
frame:
  bays: [8 m]
  storeys: [4 m]
  columns: [{storeys: 1, section: HEB300, material: steel}]
  beams: [{floors: 1, section: IPE400, material: steel}]
  @frame@
materials:
  steel: {@law@}
elements: {geometry: {columns: @geometry@}, integration_points: @points@}
loads:
  beams:
    - {floors: 1, G: 10 kN/m, points: [{at: [0.1 m, 0.3 m, 2 m, 6 m], G: 40 kN}], partial: [{start: 0.05 m, end: 7.9 m, G: [4 kN/m, 12 kN/m]}]}
masses: {given: [{floors: 1, mass: 20 t}], directions: @directions@}
@more@
analyses:
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 0.5 %, steps: 4}
  @history@
outputs: {members: [B_1_1], histories: [supports]}
"""  # fmt: skip # noqa: E501
BILINEAR, ELASTIC = "law: bilinear, E: 210 GPa, fy: 2000 MPa, hardening: 1 %", "law: elastic, E: 210 GPa"
HINGE = "{M_y: 5000 kN*m, theta_p: 0.1 rad, theta_pc: 0.3 rad, theta_u: 0.4 rad}"
POINTS = np.array([0.1, 0.3, 2.0, 6.0])  # m
CUT = 0.6  # m


def run(analysis: str, **given: str) -> Group:
    keys = {"frame": "", "law": BILINEAR, "geometry": "linear", "points": "4", "directions": "horizontal"}
    text = PROJECT
    for key, value in (keys | {"more": "", "history": ""} | given).items():
        text = text.replace(f"@{key}@", value)
    project = parse_project(text, str(CASES / "project.yaml"), profile_names())
    group = run_analysis(project, next(item for item in project.analyses if item.name == analysis))
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def loads_between(first: float, last: float) -> tuple[float, float]:
    """Sum (N) of the loads between two places, and its moment about the first (N m), both downwards."""
    inside = POINTS[(POINTS > first) & (POINTS < last)]
    x, weight = np.polynomial.legendre.leggauss(4)
    at = 0.5 * (first + last) + 0.5 * (last - first) * x
    weight = 0.5 * (last - first) * weight
    start, end = max(first, 0.05), min(last, 7.9)
    part = 0.5 * (start + end) + 0.5 * (end - start) * x
    partial = 0.5 * (end - start) * np.polynomial.legendre.leggauss(4)[1] * (4e3 + 8e3 * (part - 0.05) / 7.85)
    total = 40e3 * inside.size + 10e3 * weight.sum() + partial.sum()
    moment = 40e3 * (inside - first).sum() + 10e3 * (weight * (at - first)).sum() + (partial * (part - first)).sum()
    return float(total), float(moment)


def largest(group: Group, name: str) -> np.ndarray:
    """Values at both ends of the beam under all of gravity, with their signs; they rise in proportion."""
    values = group.variables
    extremes = np.stack([values[f"member_{name}_{which}"].values[-1] for which in ("min", "max")])
    return np.asarray(extremes.sum(axis=0))  # one of both is 0


def hinges(distance: float) -> str:
    return f"hinges: [{{beams: {{floors: 1}}, distance: {distance} m, parameters: {HINGE}}}]"


def test_moments_at_hinges_are_those_of_statics() -> None:
    """Cuts at the hinges: the end's shear and moment less what stands outside of the hinge; and the whole beam."""
    group = run("gravity", more=hinges(CUT))
    shear, moment = largest(group, "shear_force"), largest(group, "bending_moment")
    at_hinges = group.variables["hinge_moment_final"].values
    total, about_start = loads_between(0.0, SPAN)
    outside, about_cut = loads_between(0.0, CUT)
    assert shear.sum() == pytest.approx(total, rel=1e-9)
    assert moment.sum() + shear[1] * SPAN == pytest.approx(about_start, rel=1e-9)
    left = moment[0] - shear[0] * CUT + outside * CUT - about_cut
    assert at_hinges[0] == pytest.approx(left, rel=1e-8)
    outside, about_cut = loads_between(SPAN - CUT, SPAN)
    assert at_hinges[1] == pytest.approx(moment[1] + shear[1] * CUT - about_cut, rel=1e-8)
    assert group.variables["reaction_y_final"].values.sum() == pytest.approx(total, rel=1e-9)


def test_hinges_that_do_not_yield_leave_the_moments() -> None:
    """The plain beam of one piece has the same end moments: the hinges' flexibility is taken from it exactly."""
    plain = largest(run("gravity", law=ELASTIC), "bending_moment")
    for distance in (0.3, CUT, 2.0):  # under a load, between loads
        hinged = largest(run("gravity", law=ELASTIC, more=hinges(distance)), "bending_moment")
        np.testing.assert_allclose(hinged, plain, rtol=1e-8)


@pytest.mark.parametrize(
    "more", ["joints: [{beams: {floors: 1}, stiffness: 60 MN*m/rad}]", "panel_zones: [{floors: 1}]"]
)
def test_fibres_between_springs_meet_the_loads_exactly(more: str) -> None:
    """Between loads moments are cubic at most: four points are exact for them times x, and ten change nothing."""
    few, many = (largest(run("gravity", more=more, points=points), "bending_moment") for points in ("4", "10"))
    np.testing.assert_allclose(few, many, rtol=1e-8)


def test_loads_on_panel_zones_stand_on_the_joints() -> None:
    """Columns 300 mm deep: what stands beyond 0.15 m of a node goes to it; the ground carries all."""
    group = run("gravity", more="panel_zones: [{floors: 1}]")
    edge = 0.15
    between, about_edge = loads_between(edge, SPAN - edge)
    shear, moment = largest(group, "shear_force"), largest(group, "bending_moment")
    assert shear.sum() == pytest.approx(between, rel=1e-8)
    assert moment.sum() + shear[1] * (SPAN - 2.0 * edge) == pytest.approx(about_edge, rel=1e-8)
    assert group.variables["reaction_y_final"].values.sum() == pytest.approx(loads_between(0.0, SPAN)[0], rel=1e-8)


SUPPORTS = "supports: {A: {rotation: 20 MN*m/rad, vertical: 200 kN/mm, horizontal: 40 kN/mm}, B: fixed}"
BASE_HINGES = f"hinges: [{{columns: {{storeys: 1}}, ends: start, parameters: {HINGE}}}]"


def test_reactions_of_springs_and_hinged_bases_overturn() -> None:
    """Linear: moment of all reactions about the middle of the base = push times height + that of the loads."""
    group = run("push", frame=SUPPORTS, more=BASE_HINGES)
    values = {name: group.variables[name].values for name in ("lateral_load", "base_shear", "overturning_moment")}
    total, about_left = loads_between(0.0, SPAN)
    np.testing.assert_allclose(values["base_shear"], values["lateral_load"], rtol=1e-8, atol=1e-3)
    expected = values["lateral_load"] * HEIGHT + about_left - 0.5 * SPAN * total
    np.testing.assert_allclose(values["overturning_moment"], expected, rtol=1e-8)
    vertical = group.variables["support_vertical_reaction"].values.sum(axis=-1)
    np.testing.assert_allclose(vertical, total, rtol=1e-9)


def test_a_leaning_column_overturns_by_what_it_pulls() -> None:
    """P-Delta: its load P adds P u to what the frame's column bases resist; its own base is none of the supports."""
    bases = "supports: {A: {rotation: 20 MN*m/rad}, B: {vertical: 200 kN/mm}}"
    frame = f"{bases}\n  leaning_column: {{G: 900 kN}}\n  diaphragms: all"
    group = run("push", frame=frame, more=BASE_HINGES, geometry="p_delta")
    push, drift = (group.variables[name].values for name in ("lateral_load", "storey_drift"))
    np.testing.assert_allclose(group.variables["base_shear"].values, push, rtol=1e-8, atol=1e-3)
    total, about_left = loads_between(0.0, SPAN)
    sway = drift[:, 0] * HEIGHT
    expected = push * HEIGHT + about_left - 0.5 * SPAN * total + (900e3 + total) * sway
    np.testing.assert_allclose(group.variables["overturning_moment"].values, expected, rtol=1e-6)


def test_vertical_motion_of_a_frame_on_springs() -> None:
    """Posts on springs under a beam on hinges: 20 t on spring and post in series, between samples by lsim, exactly."""
    stiffness, step, area, mass = 2e6, 0.001, 2.0 * 0.3 * 0.019 + 0.262 * 0.011, 20e3
    history = "- {name: up, kind: history, record: motion, vertical: {ratio: 0.8}}"
    group = run(
        "up",
        law=ELASTIC,
        frame="supports: {default: {vertical: 2 kN/mm}}\n  releases: [{beams: {floors: 1}, ends: both}]",
        directions="both",
        more=(
            "records:\n  motion: {file: records/motion.csv, acceleration_unit: m/s^2}\n"
            "damping: {kind: none}\nintegration: {method: newmark, time_step: 0.001 s}"
        ),
        history=history,
    )
    ground = group.variables["ground_acceleration_vertical"].values
    spring = 1.0 / (1.0 / stiffness + HEIGHT / (210e9 * area))
    system = scipy.signal.StateSpace([[0.0, 1.0], [-spring / mass, 0.0]], [[0.0], [-1.0]], [[1.0, 0.0]], [[0.0]])
    _, moved, _ = scipy.signal.lsim(system, ground, step * np.arange(ground.size))
    reaction = group.variables["support_vertical_reaction"].values
    at_rest = reaction[0]
    assert at_rest.sum() == pytest.approx(loads_between(0.0, SPAN)[0], rel=1e-8)
    # Newmark's period is (w h)^2 / 12 = 1e-5 too long, over some 200 rad
    np.testing.assert_allclose(
        reaction - at_rest, np.outer(-spring * moved, [1.0, 1.0]), atol=2e-3 * spring * np.ptp(moved)
    )
