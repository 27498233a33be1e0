"""Buildings on buckling-restrained braces against statics written out, and printed adjusted strengths."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import building, design_of, number_of
from every_building_key import RESTRAINED

from edesign.archive.reader import open_archive
from edesign.codes.aisc341.buckling_restrained import RestrainedBrace, expected_deformation
from edesign.core.member_checks import Check
from edesign.core.space import PROPERTIES
from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.section_lists import sections_of
from edesign.frame.sections.steel_section import steel_section
from edesign.project import parse_project
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.combinations import combinations_table
from edesign.space.check import check_building
from edesign.space.elastic_design import ElasticAnalysis, ElasticDesign
from edesign.space.extract import StudyNames, elastic_use, frame_row, project_text
from edesign.space.nonlinear.build import build_building
from edesign.space.selection.groups import groups_of
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties
from edesign.study.analysis.structure import make_structure
from edesign.study.check.summary import check_project
from edesign.study.run.building import run_building

BRACED = """\
edesign_building: 1
title: Two storeys on buckling-restrained braces
plan: {x: [6 m], y: [6 m]}
storeys: [4 m, 3.5 m]
supports: pinned
columns: [{section: HEB260, material: S355, strong: x}]
beams:
  - {along: x, section: IPE400, material: S355}
  - {along: y, section: HEA280, material: S355, ends: pinned}
braces:
  - {along: y, frames: all, bays: 1, storeys: 1, kind: chevron, section: BRB12, material: core, law: brb, group: low}
  - {along: y, frames: all, bays: 1, storeys: 2, kind: chevron, section: brb 8, material: core, law: brb, group: high}
materials: {S355: {fy: 355 MPa}, core: {fy: 235 MPa}}
dampers:
  laws:
    brb:
      type: buckling_restrained
      parameters: {A_sc: 1000 mm^2, F_ysc: 235 MPa, E: 210 GPa, L_wp: 5 m, L_y: 3.5 m, KF: 1.3, alpha: 0.5 %,
                   R_y: 1.1, strain: 3 %, omega: 1.4, beta: 1.1}
loads:
  self_weight: false
  areas: [{G: 5 kN/m^2, Q: 3 kN/m^2, category: B, spans: x}]
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.20 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: high
  systems: {x: {type: moment_frame, q: 4}, y: {type: buckling_restrained, q: 5, q_source: approval of the braces}}
"""
"""Chevrons of 5 m (4 m by 3 m) and 4.61 m (3.5 m by 3 m)."""
P_1, P_2 = 12e-4 * 235e6, 8e-4 * 235e6
T_1, T_2 = 1.4 * 1.1 * P_1, 1.4 * 1.1 * P_2
C_1, C_2 = 1.1 * T_1, 1.1 * T_2
SIN_1, COS_1 = 4.0 / 5.0, 3.0 / 5.0
SIN_2, COS_2 = 3.5 / np.hypot(3.5, 3.0), 3.0 / np.hypot(3.5, 3.0)


@pytest.fixture(scope="module")
def made() -> ElasticDesign:
    return design_of(BRACED)


def static(made: ElasticDesign, member: str, case: str) -> np.ndarray:
    """Internal forces at the stations under a case, N and N m."""
    return np.asarray(made.effects.static[made.effects.cases.index(case), number_of(made.frame, member)])


@pytest.mark.parametrize(
    ("A", "fy", "R_y", "omega", "beta", "P", "T", "C"),
    [
        # kip and in: core of 22.5 in2 of 38 ksi, R_y F_ysc = 46 ksi; P_ysc 855, T 1407.6, C 1548.4 (Steltic, example 4)
        (22.5, 38.0, 46.0 / 38.0, 1.36, 1.10, 855.0, 1407.6, 1548.4),
        # kN and mm: 3000 mm2 of 250 MPa: T 1155, C 1270.5 (a validation by AISC 341, F4, of another program)
        (3000.0, 0.250, 1.1, 1.4, 1.1, 750.0, 1155.0, 1270.5),
    ],
)
def test_printed_adjusted_strengths(
    A: float, fy: float, R_y: float, omega: float, beta: float, P: float, T: float, C: float
) -> None:
    brace = RestrainedBrace(A, fy, 29000.0, 1.0, 0.7, 1.3, 0.0, R_y, ((0.02, omega, beta),))
    found = brace.yield_force, brace.adjusted_tension, brace.adjusted_compression
    assert found == pytest.approx((P, T, C), rel=1e-4)  # five digits are printed


def test_printed_axial_strengths_of_cores() -> None:
    """0.9 F_ysc A_sc of 3 and 5 in2 of 38 ksi are 103 and 171 kip in CoreBrace's quick reference."""
    for area, kip in ((3.0, 103.0), (5.0, 171.0)):
        assert 0.9 * 38.0 * area == pytest.approx(kip, rel=5e-3)  # three digits are printed
        assert steel_section(f"BRB{6.4516 * area:.3f}").A == pytest.approx(area * 0.0254**2, rel=1e-4)


def test_deformation_that_braces_are_made_for() -> None:
    """Twice the design drift of 60 mm, or 2 % of 4 m = 80 mm, along a brace at 3/5."""
    assert expected_deformation(0.060, 4.0, 0.6) == pytest.approx(0.072)
    assert expected_deformation(0.020, 4.0, 0.6) == pytest.approx(0.048)


def test_stiffness_counts_the_ends(made: ElasticDesign) -> None:
    """K = 1.3 E A / L, so that the model has 1.3 A; the steel list has A."""
    number = number_of(made.frame, "DY_A_1_1_r")
    properties = dict(zip(PROPERTIES, member_properties(made.frame, made.building.materials)[number], strict=True))
    assert properties["A"] == pytest.approx(1.3 * 12e-4) and properties["E"] == 210e9
    assert made.frame.section("BRB12").A == pytest.approx(12e-4)


def test_beam_above_a_chevron(made: ElasticDesign) -> None:
    """(C - T) sin = 34.7 kN pushes the middle of the beam up: M = P L / 4 = 52.1 kN m, V = P / 2.

    The chevron below brings (T + C) cos to the middle; the braces above bring T_2 cos_2 and C_2 cos_2 to the ends.
    The floor brings the rest evenly along 6 m, half of it up to the middle.
    """
    push = (C_1 - T_1) * SIN_1
    rest = (T_1 + C_1) * COS_1 - (T_2 + C_2) * COS_2
    for case in ("BRB y+", "BRB y-"):
        at_middle = static(made, "BY_A_1_1_1", case)[-1]
        assert abs(at_middle[4]) == pytest.approx(push * 6.0 / 4.0, rel=1e-4)  # braces hold a millionth of their share
        assert abs(at_middle[2]) == pytest.approx(push / 2.0, rel=1e-4)
    found = sorted(abs(static(made, "BY_A_1_1_1", case)[-1, 0]) for case in ("BRB y+", "BRB y-"))
    assert found == pytest.approx(sorted((T_2 * COS_2 + rest / 2.0, C_2 * COS_2 + rest / 2.0)), rel=1e-6)


def test_columns_beside_chevrons(made: ElasticDesign) -> None:
    """Upwards: half of (C - T) sin at each beam. At the foot of a brace of storey 2 its pull or push, too."""
    lifted_2, lifted_1 = (C_2 - T_2) * SIN_2 / 2.0, (C_1 - T_1) * SIN_1 / 2.0
    for case in ("BRB y+", "BRB y-"):
        assert static(made, "C_A1_2", case)[0, 0] == pytest.approx(lifted_2, rel=1e-6)
    found = sorted(static(made, "C_A1_1", case)[0, 0] for case in ("BRB y+", "BRB y-"))
    both = lifted_1 + lifted_2
    assert found == pytest.approx([both - C_2 * SIN_2, both + T_2 * SIN_2], rel=1e-6)
    assert not static(made, "C_A1_1", "BRB y+")[:, 1:].any()


def test_combinations_and_factors(made: ElasticDesign) -> None:
    """Amplified by beta omega R_y Omega = 1.694 Omega, at most q = 5; across the moment frame 0.3 of its own factor."""
    Omega = made.overstrength["y"]
    assert Omega.hardening == pytest.approx(1.1 * 1.4 * 1.1)
    factor = min(Omega.hardening * Omega.Omega, 5.0)
    amplified = made.members.amplified
    assert max(row.seismic[1] for row in amplified) == pytest.approx(factor)
    mechanisms = [row for row in amplified if "BRB" in row.name]
    assert [row.name.split(" + ")[-1] for row in mechanisms] == ["BRB y+", "BRB y-"]
    across = max(row.seismic[0] for row in amplified)
    assert all(row.seismic[0] == pytest.approx(0.3 * across) and row.seismic[1] == 0.0 for row in mechanisms)
    assert made.foundations.factor[1].min() == pytest.approx(max(factor, 1.2 * min(Omega.Omega, 5.0)))


def test_braces_are_checked_for_yielding_alone(made: ElasticDesign) -> None:
    number = number_of(made.frame, "DY_A_1_1_r")
    checks = made.members.utilisation[number]
    assert np.isfinite(checks[list(Check).index(Check.N)]) and np.isnan(checks[list(Check).index(Check.N_B)])
    ratios = dict(zip(made.overstrength["y"].members.tolist(), made.overstrength["y"].ratios.tolist(), strict=True))
    assert checks[list(Check).index(Check.N)] == pytest.approx(1.0 / ratios[number])


def test_rules(made: ElasticDesign) -> None:
    """2 % of 3.5 m along the upper brace: 70 mm x 0.651 = 45.6 mm in L_y = 0.7 L: 1.41 % less the elastic part."""
    rules = {rule.text: rule for rule in made.criteria}
    strain = next(rule for text, rule in rules.items() if text.startswith("strain of cores"))
    L = np.hypot(3.5, 3.0)
    elastic = 235e6 / 210e9 * (1.0 - 1.0 / (1.3 * 0.7))
    assert strain.value == pytest.approx(0.02 * 3.5 * COS_2 / (0.7 * L) + elastic, rel=1e-6)
    assert strain.required == 0.03 and strain.passed and strain.reference == "AISC 341-16, F4.2"
    connection = rules["connections of low, BRB12: beta omega R_y P_ysc, kN"]
    assert connection.value == pytest.approx(C_1 / 1e3) and "434.3 kN" in connection.detail
    q = next(rule for text, rule in rules.items() if text.startswith("behaviour factor q of buckling"))
    assert q.passed is None and "approval of the braces" in q.detail
    assert not any(rule.clause.startswith("6.7.3(") and rule.passed is not None for rule in made.criteria)


def test_braces_of_both_directions_yield_at_once() -> None:
    """Columns are common to both: four combinations of senses (D1.4a)."""
    found = [row for row in design_of(RESTRAINED).members.amplified if "BRB" in row.name]
    assert sorted(row.name for row in found) == sorted(f"G + 0.3 Q + BRB x{x} + BRB y{y}" for x in "+-" for y in "+-")
    assert all(row.seismic[:2] == (0.0, 0.0) for row in found)


def test_lists_of_cores() -> None:
    lists = "design:\n  select: {lists: {braces: [SHS, BRB6, BRB10, BRB14]}}\n"
    analysis = ElasticAnalysis(building(BRACED.replace("design:\n", lists)))
    groups = {group.name: group for group in groups_of(analysis)}
    assert groups["low"].sections == groups["high"].sections == ("BRB6", "BRB10", "BRB14")
    assert groups["low"].records == (0, 1, 2) and groups["low"].stiffer == ((1, 2), (2,), ())  # by their areas
    with pytest.raises(InputError, match="list areas of cores, such as `BRB20`.*E-SPACE-07"):
        groups_of(ElasticAnalysis(building(BRACED)))
    assert sections_of("brb 12.5")[0].A == pytest.approx(12.5e-4)
    with pytest.raises(InputError, match="`BRB` has no list of sizes.*E-SECT-03"):
        sections_of("BRB")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (", q: 5, q_source: approval of the braces", "", "systems.y.q: EN 1998-1 has no behaviour factor"),
        (", q_source: approval of the braces", "", "systems.y.q_source: this key is missing"),
        ("q: 4}", "q: 4, q_source: me}", "a source is for `buckling_restrained` alone"),
        ("type: buckling_restrained, q: 5, q_source: approval of the braces", "type: concentric_v", "whose type is"),
        ("ductility_class: high", "ductility_class: low", "needs capacity design"),
        ("kind: chevron, section: BRB12", "kind: cross, section: BRB12", "cannot cross.*E-DEVICE-04"),
        ("section: BRB12, material: core, law: brb", "section: BRB12, material: core", "omega, beta and KF.*E-KEY-02"),
        ("section: BRB12", "section: SHS100x5", "is no buckling-restrained brace.*E-DEVICE-04"),
        ("law: brb, group: low", "law: bbr, group: low", "there is no damper law `bbr`"),
        ("law: brb, group: low", "law: brb, compression: false, group: low", "leave this key out"),
        ("section: HEB260", "section: BRB30", "there is no section `BRB30`"),
    ],
)
def test_refused_in_files(old: str, new: str, message: str) -> None:
    assert old in BRACED
    with pytest.raises(InputError, match=message):
        building(BRACED.replace(old, new, 1))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("core: {fy: 235 MPa}", "core: {fy: 275 MPa}", "has fy = 275 MPa, and F_ysc of the law `brb` is 235 MPa.*-04"),
        ("core: {fy: 235 MPa}", "core: {fy: 235 MPa, E: 200 GPa}", "has E = 200000 MPa, and E of the law"),
        ("type: buckling_restrained\n", "type: friction\n", "E-"),
    ],
)
def test_refused_by_the_law(old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        check_building(building(BRACED.replace(old, new, 1)))


def test_analyses_in_space_are_refused() -> None:
    with pytest.raises(InputError, match="as `dampers.devices`.*E-DEVICE-04"):
        building(BRACED + "analyses: [{name: gravity, kind: gravity}]\n")
    with pytest.raises(InputError, match=r"braces\[0\].*E-DEVICE-04"):
        build_building(building(BRACED))


def test_extracted_frames_have_them_as_dampers() -> None:
    """Two equal frames of pinned beams: the period of one is that of the building, but for its small shear areas."""
    made = building(BRACED)
    row = frame_row(made, space_frame(made), "YA")
    text = project_text(row)
    assert "- {kind: chevron_braces, bays: all, storeys: 1, law: brb, scale: 1.2, carries_gravity: true}" in text
    frame = parse_project(text, "frame.yaml", BuildingSections())
    found = float(make_structure(frame, dampers=True).modes(1).period[0])
    assert found == pytest.approx(design_of(BRACED).response["y"].T_1, rel=1e-2)
    with pytest.raises(InputError, match="extract it without a study.*E-DEVICE-04"):
        project_text(row, StudyNames("a.yaml", "b.yaml"))
    inverted = BRACED.replace("storeys: 2, kind: chevron", "storeys: 2, kind: v")
    other = building(inverted)
    with pytest.raises(InputError, match="`v` is none of them.*E-DEVICE-04"):
        project_text(frame_row(other, space_frame(other), "YA"))


@pytest.mark.parametrize("kind", ["rising", "falling", "alternating", "chevron"])
def test_extracted_frames_with_uses_of_the_design_pass_their_checks(kind: str) -> None:
    """Braces that became dampers are members no more; those that are keep what the elastic design found for them."""
    made = building(BRACED.replace("kind: chevron", f"kind: {kind}"))
    uses = elastic_use(made, "y")
    read = parse_project(
        project_text(frame_row(made, space_frame(made), "YA"), elastic=uses), "frame.yaml", BuildingSections()
    )
    assert "frame" in check_project(read)
    assert read.design is not None
    assert set(read.design.elastic_use) == set(read.frame.members)
    assert any(name.startswith("DY_A") for name in uses)


def test_report_says_what_the_braces_bring(tmp_path: Path) -> None:
    path = tmp_path / "building.yaml"
    path.write_text(BRACED, encoding="utf-8")
    archive = run_building(load_building(path)).archive
    with open_archive(archive) as opened:
        rows = combinations_table(BuildingResults(opened)).rows
    situations = {str(row[2]) for row in rows}
    assert {"seismic, amplified by Omega", "seismic, BRB at adjusted strength"} <= situations
