"""Plastic rotations that ASCE/SEI 41-17, Table 9-7.1, and EN 1998-3, Table B.1, allow, by hand."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest
from unit.assess.assessed import FRAME

from edesign.assess.acceptance import ACCEPTANCE, FrameMember, section_class
from edesign.assess.members import frame_members, under_gravity
from edesign.codes.asce41.steel import beam_rotations, column_rotations, web_limits
from edesign.codes.ec8.verification.existing_steel import plastic_rotations
from edesign.errors import InputError
from edesign.project import load_project, parse_project
from edesign.project.analysis.analyses import GravityAnalysis
from edesign.study.analysis.gravity import run_gravity

BEAM_YIELD, COLUMN_YIELD = 0.0079398 * 6.0 / 7.2, 0.0027945 * 3.0 / 3.5  # rad, tests of FEMA 356 have 7.2 and 3.5 m
P = 1544.53e3  # N, of P_ye = 5822.3 kN: 0.26528


def member(name: str, text: str = FRAME) -> FrameMember:
    return frame_members(parse_project(text))[name]


def test_beams_of_asce_41() -> None:
    # IPE450, S275: b_f/(2 t_f) = 6.5 < 0.3 sqrt(210000/275) = 8.3, h/t_w = 40.3 < 2.45*27.63 = 67.7: line a
    allowed = ACCEPTANCE["asce41-17"](member("B_1_1"), 0.0).rotations
    assert allowed is not None
    assert allowed == pytest.approx({"IO": BEAM_YIELD, "LS": 9 * BEAM_YIELD, "CP": 11 * BEAM_YIELD}, rel=1e-4)
    # half of the way from 0.30 to 0.38: 6.5, 8.5, 0.4; 0.625, 6, 7.5 theta_y
    section = member("B_1_1").section
    between = replace(section, flange_slenderness=0.34 * math.sqrt(section.E / section.expected_yield))
    line, theta_y = beam_rotations(between, 6.0), BEAM_YIELD
    assert (line.a, line.b, line.io, line.ls, line.cp) == pytest.approx(
        [value * theta_y for value in (6.5, 8.5, 0.625, 6.0, 7.5)], rel=1e-4
    )
    assert line.c == pytest.approx(0.4, rel=1e-12)
    with pytest.raises(InputError, match="performance level `SD`"):
        line.allowed("SD")


def test_columns_of_asce_41() -> None:
    # HEB450, 3.0 m: r_y = sqrt(117.091e-6/0.021172) = 74.367 mm, L/r_y = 40.340, h/t_w = 344/14 = 24.571
    # a = 0.8*0.73472^2.2/(4.0340 + 19.657) - 0.0035 = 0.40603/23.691 - 0.0035 = 0.013638
    # b = 7.4*0.73472^2.3/(20.170 + 71.257) - 0.006 = 3.64175/91.427 - 0.006 = 0.033832
    section = member("C_A_2").section
    line = column_rotations(section, 3.0, P)
    assert line is not None
    assert (line.a, line.b, line.c) == pytest.approx((0.013638, 0.033832, 0.9 * 0.73472), rel=2e-4)
    assert (line.io, line.ls, line.cp) == pytest.approx((0.5 * 0.013638, 0.75 * 0.033832, 0.033832), rel=2e-4)
    # line b, of a flange of 0.4 sqrt(E/F_ye) = 11.054: 1.2*0.73472^1.2/(56.476 + 2.457 + 9.949) - 0.0023 = 0.009735
    # and 2.5*0.73472^1.8/(4.034 + 4.914 + 29.846) - 0.0097 = 0.027301
    slender = column_rotations(replace(section, flange_slenderness=11.0536), 3.0, P)
    assert slender is not None
    assert (slender.a, slender.b, slender.c) == pytest.approx((0.009735, 0.027301, 0.5 * 0.73472), rel=2e-4)
    assert column_rotations(section, 3.0, 0.59 * section.yield_axial_force) is not None
    assert column_rotations(section, 3.0, 0.61 * section.yield_axial_force) is None
    assert column_rotations(section, 3.0, -P) == column_rotations(section, 3.0, 0.0)


def test_limits_of_webs_meet_where_their_formulas_change() -> None:
    below, above = web_limits(0.2 - 1e-12), web_limits(0.2)
    assert below == pytest.approx(above, rel=2e-3)  # 2.1021 and 2.1021; 2.3838 and 2.3856


def test_gravity_stands_for_the_largest_compression_where_it_is_known() -> None:
    column, rule = member("C_A_2"), ACCEPTANCE["asce41-17"]
    large = 0.7 * column.section.yield_axial_force
    assert rule(column, large).elastic == "is force-controlled (P_G/P_ye = 0.70)"
    loaded = replace(column, gravity=P)
    assert rule(loaded, large) == rule(column, P)
    assert rule(loaded, large).axial_ratio == pytest.approx(0.26528, rel=1e-4)


def test_the_base_column_of_the_thesis_under_gravity() -> None:
    """FEMA 356 makes `C_B_1` force-controlled under 0.79 P_CL; P_G/P_ye is 0.317."""
    project = load_project(Path(__file__).parents[2] / "projects" / "thesis_10_storey" / "project.yaml")
    gravity = run_gravity(project, GravityAnalysis(kind="gravity", name="gravity"))
    column = under_gravity(frame_members(project), gravity)["C_B_1"]
    found = {name: rule(column, 0.79 * column.strength) for name, rule in ACCEPTANCE.items()}
    assert found["fema356"].elastic and found["en1998-3"].elastic == "has no plastic rotation in Table B.1 (nu = 0.70)"
    assert found["asce41-17"].axial_ratio == pytest.approx(0.317, abs=5e-4)
    # L/r_y = 47.064, h/t_w = 24.571: a = 0.8*0.68283^2.2/24.363 - 0.0035, b = 7.4*0.68283^2.3/94.789 - 0.006
    expected = {"IO": 0.5 * 0.010685, "LS": 0.75 * 0.026463, "CP": 0.026463}
    assert found["asce41-17"].rotations == pytest.approx(expected, rel=2e-4)


def test_members_of_en_1998_3() -> None:
    beam = ACCEPTANCE["en1998-3"](member("B_1_1"), 0.0)
    expected = {"DL": BEAM_YIELD, "SD": 6 * BEAM_YIELD, "NC": 8 * BEAM_YIELD}
    assert beam.rotations == pytest.approx(expected, rel=1e-4)
    column, rule = member("C_A_2"), ACCEPTANCE["en1998-3"]
    found = rule(column, P)  # class 1: alpha = 1, 24.6 < 33 epsilon = 30.5
    assert found.rotations == pytest.approx(
        {"DL": COLUMN_YIELD, "SD": 6 * COLUMN_YIELD, "NC": 8 * COLUMN_YIELD}, rel=1e-4
    )
    assert rule(column, 1.8e6).elastic == "has no plastic rotation in Table B.1 (nu = 0.31)"
    assert plastic_rotations(2, 0.3, 0.01) == pytest.approx({"DL": 0.0025, "SD": 0.02, "NC": 0.03}, rel=1e-12)


def test_classes_of_sections() -> None:
    # HEA300: c/t_f = (300 - 8.5 - 54)/28 = 8.48; epsilon 1, 0.924, 0.814: class 1 up to 9, 2 to 10, 3 above
    for steel, expected in (("235", 1), ("275", 2), ("355", 3)):
        text = FRAME.replace("HEB450", "HEA300").replace("fy: 275", f"fy: {steel}")
        column = member("C_A_2", text)
        assert section_class(column.section, 0.0) == expected
        found = ACCEPTANCE["en1998-3"](column, 0.0)
        assert found.elastic == ("" if expected < 3 else "has no plastic rotation in Table B.1 (class 3)")
