"""What is told of members and supports under histories: the rule of the code, what dampers change, lines of words."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.assess.member_uses import BeamForces, beam_forces, in_words, loaded_members, support_forces
from edesign.assess.quantities import located_quantity
from edesign.assess.sets import HistorySet, history_sets
from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.codes.ntc2018.accelerograms import ULTIMATE
from edesign.codes.registry import find_code
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.frame.member_design import FrameDesign
from edesign.project.loader import parse_project
from edesign.report.response.support_tables import support_tables
from edesign.report.response.use_tables import use_in_short, use_tables
from edesign.study.results.recording import coordinate

EC8 = find_code("ec8-2004").set_rules
MEMBERS = ["C_A_1", "C_B_1", "B_1_1"]


def history(record: int, variant: str, uses: list[float], V: float = 100e3, compression: float = 0.0) -> Group:
    """A history with uses against buckling of three members, sections at half of it, and one support."""
    group = Group()
    group.attributes |= {"kind": "history", "status": "completed", "variant": variant, "level": "DBE"}
    group.attributes |= {"record": f"r{record}", "record_checksum": str(record), "record_source": f"r{record}"}
    for name, values in (("member", MEMBERS), ("end", ["start", "end"]), ("column", MEMBERS[:2]), ("support", ["A0"])):
        coordinate(group, name, values, "", name)
    coordinate(group, "support_extreme", ["most compression", "least compression", "most shear", "most moment"], "", "")
    if variant != "bare":
        coordinate(group, "damper", ["V_1_1"], "", "damper")
    use = np.array(uses)
    group.add("section_use_max", ("member", "end"), np.outer(use, [0.5, 0.4]), "1", "")
    group.add("section_use_at", ("member", "end"), np.ones((3, 2)), "s", "")
    group.add("member_use_max", ("member",), use, "1", "")
    group.add("member_use_at", ("member",), np.full(3, 0.1 * record), "s", "")
    for quantity in ("section_use", "member_use"):
        for part, value in (("axial_force", -1e5), ("shear_force", 2e4), ("bending_moment", -3e4)):
            values = np.multiply.outer(use, [1.0, -0.5]) * value
            group.add(f"{quantity}_{part}", ("member", "end"), values, "N", "")
    group.add("column_axial_force_max", ("column",), np.array([-1e4, compression]), "N", "")
    vertical = np.array([[2.0 * V, -V, V, V]])
    group.add("support_extreme_at", ("support", "support_extreme"), np.ones((1, 4)), "s", "")
    group.add("support_extreme_vertical_reaction", ("support", "support_extreme"), vertical, "N", "")
    group.add("support_extreme_horizontal_reaction", ("support", "support_extreme"), -0.1 * vertical, "N", "")
    group.add("support_extreme_moment", ("support", "support_extreme"), 0.2 * vertical, "N*m", "")
    return group


def sets(count: int) -> list[HistorySet]:
    groups = {f"bare.DBE.r{i}": history(i, "bare", [0.7, 0.9, 0.5]) for i in range(1, count + 1)}
    for i in range(1, count + 1):
        groups[f"damped.DBE.r{i}"] = history(i, "damped", [0.2 * i, 1.1, 0.4], V=1e5 * i, compression=5e4)
    return list(history_sets(groups))


def test_mean_of_seven_and_largest_of_six() -> None:
    for count, use, V in ((7, 0.8, -400e3), (6, 1.2, -600e3)):
        damped = sets(count)[1]
        members = loaded_members(damped, EC8)
        first = members[0]
        assert (first.name, first.check, first.history) == ("C_A_1", "buckling", f"damped.DBE.r{count}")
        assert first.use == pytest.approx(use) and first.largest == pytest.approx(0.2 * count)
        assert (first.N, first.V, first.M) == pytest.approx((-2e4 * count, 4e3 * count, 6e3 * count))
        assert first.at == pytest.approx(0.1 * count) and members[1].tension == pytest.approx(5e4)
        least = support_forces(damped, EC8)[1]
        assert (least.V, least.H[0], least.M[0]) == pytest.approx((V, -0.1 * V, -0.2 * V))  # magnitudes


def test_another_code_has_another_number_of_motions_for_the_mean() -> None:
    """ASCE/SEI 7-22, 16.2.2: eleven."""
    first = loaded_members(sets(7)[1], find_code("asce7-22").set_rules)[0]
    assert first.use == first.largest == pytest.approx(1.4)


def test_what_dampers_bring_beyond_1_is_told() -> None:
    table = use_in_short(sets(7), None)
    texts = [[cell.strip() for cell in row] for row in table.texts]
    assert texts[1] == ["damped, DBE", "1.10", "C_B_1", "1", "0.40", "B_1_1", "0", "50.0", "400"]
    assert "damped, DBE: dampers bring columns beyond 1: C_B_1 1.10 (without 0.90)" in table.notes
    assert any("mean of 7 motions (EN 1998-1:2004, 4.3.3.4.3(3))" in note for note in table.notes)
    assert not any("bare, DBE" in note for note in table.notes)
    beyond = [one for one in use_tables(sets(7), None) if one.name == "members_beyond_1"]
    assert [row[:4] for row in beyond[0].texts] == [["column", "1", "C_B_1", "1.10"]] and len(beyond) == 1
    assert beyond[0].column("without dampers") == pytest.approx([0.9])


def test_of_many_sets_a_summary_has_the_worst_level_of_each_variant() -> None:
    """Seven levels of `damped`, of which the last has 1.4 times the use of the first: a row each for two variants."""
    groups = {"bare.DBE.r1": history(1, "bare", [0.7, 0.9, 0.5])}
    for level in range(7):
        one = history(1, "damped", [0.7 + 0.1 * level, 0.9, 0.4])
        one.attributes["level"] = f"L{level}"
        groups[f"damped.L{level}.r1"] = one
    table = use_in_short(history_sets(groups), None)
    assert [row[0].strip() for row in table.texts] == ["bare, DBE", "damped, L6"]
    assert "worst level of each variant" in " ".join(table.notes)


def test_reactions_for_the_foundation_engineer() -> None:
    bare, damped = support_tables(sets(7), None)
    assert bare.texts[1][:3] == ["A0", "least compression", "-100.0"]
    assert damped.texts[1][:5] == ["A0", "least compression", "-400.0", "40.00", "80.00"]
    assert "7 motions: means of the extremes" in " ".join(damped.notes)


def test_reactions_with_the_seismic_action_across() -> None:
    """-400 kN of uplift with 600 kN across is -1000 kN; of before, the column alone is known, and a note says so."""
    of_before = FrameDesign.model_validate({"elastic_use": ELASTIC})
    _, damped = support_tables(sets(7), None, of_before)
    assert "with across [kN]" not in damped.headers and "Columns above A0 belong to a bracing" in " ".join(damped.notes)
    across = {"frames": ("YA",), "N": "500 kN", "V": "600 kN"}
    known = FrameDesign.model_validate({"elastic_use": {"C_A_1": {**ELASTIC["C_A_1"], "across": across}}})
    _, damped = support_tables(sets(7), None, known)
    V, both = damped.column("V"), damped.column("with across")
    assert both[:2] == pytest.approx([V[0] + 600e3, V[1] - 600e3]) and V[1] == pytest.approx(-400e3)
    assert [row[-2].strip() for row in damped.texts[2:]] == ["-", "-"], (
        "extremes of shear and moment are another step's"
    )
    assert "gamma_Rd Omega" in " ".join(damped.notes) and "belong to" not in " ".join(damped.notes)


def test_archives_of_before_have_no_such_tables() -> None:
    found = sets(3)
    for one in found:
        for group in one.histories.values():
            for name in [name for name in group.variables if "use" in name or "support" in name]:
                del group.variables[name]
    assert (
        not list(use_tables(found, None))
        and not list(support_tables(found, None))
        and not use_in_short(found, None).rows
    )


def test_archives_without_concurrent_forces_have_their_uses() -> None:
    found = sets(3)
    for one in found:
        for group in one.histories.values():
            for name in [name for name in group.variables if "use_" in name and name[-4:] not in ("_max", "e_at")]:
                del group.variables[name]
    assert np.isnan(loaded_members(found[0], EC8)[0].N)
    assert len(list(use_tables(found, None))) == 3


ELASTIC = {
    "C_A_1": {"use": 0.8, "check": "N_M", "combination": "G + E_y", "across": {"frames": ("YA",), "N": "500 kN"}}
}
FRAME = """\
edesign: 1
title: Three members
frame:
  bays: [6 m]
  storeys: [3 m]
  columns: [{lines: all, storeys: all, section: HEB300, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0.01}}
design:
  dissipative: {beams: [{floors: 1}]}
  elastic_use:
    C_A_1: {use: 0.8, check: EQ_6_62, combination: G + 1.6 E_y + 0.5 E_x, across: {frames: [YA], N: 500 kN}}
    B_1_1: {use: 0.7, check: M_Y, combination: G + E_x}
analyses: [{name: gravity, kind: gravity}]
"""


def test_members_meant_to_yield_and_uses_of_the_elastic_design() -> None:
    """A beam that is to yield is in no list of members beyond 1; a column of a bracing across goes beyond 1 with it."""
    frame = parse_project(FRAME, "frame.yaml", BuildingSections(), files=False)
    assert frame.dissipative("B_1_1") and frame.dissipative("B_1_1_2") and not frame.dissipative("C_A_1")
    found = sets(7)[:1]
    for group in found[0].histories.values():
        group.variables["member_use_max"].values[2] = 1.3
        group.add("across_use_max", ("member",), np.array([1.2, np.nan, np.nan]), "1", "")
    assert frame.design is not None
    tables = list(use_tables(found, None, frame, frame.design.elastic_use))
    assert [table.name for table in tables] == ["member_use", "elastic_use"]
    rows = [row[:7] for row in tables[1].texts]
    assert rows == [
        ["column", "1", "C_A_1", "0.70", "0.80", "YA", "500"],
        ["beam", "1", "B_1_1", "1.30", "0.70", "-", "-"],
    ]
    assert tables[1].column("with it")[0] == pytest.approx(1.2)
    notes = " ".join(use_in_short(found, None, frame).notes)
    assert "1 of 1 beams that are meant to yield do, B_1_1 1.30" in notes
    short = use_in_short(found, None, frame)
    assert [row[6].strip() for row in short.texts] == ["1"], "beside a use of 1.30 the summary counts no 0"
    plain = " ".join(use_in_short(found, None).notes)
    assert "1 of 1 beams beyond 1: B_1_1 1.30" in plain, "members beyond 1 are named without dampers too"
    assert "with the seismic action across columns go beyond 1: C_A_1 1.20 (without 0.70)" in notes
    assert [table.name for table in use_tables(found, None)] == ["member_use", "members_beyond_1"]


def test_criteria_choose_kinds_of_members() -> None:
    frame = parse_project(FRAME, "frame.yaml", BuildingSections(), files=False)
    group = history(1, "bare", [0.7, 0.9, 1.3])
    for of, use in (("all", 1.3), ("columns", 0.9), ("beams", 1.3), ("not_dissipative", 0.9)):
        asked = QuantityCriterion.model_validate({"name": "use", "quantity": "member_use", "of": of, "most": 1})
        located = located_quantity(group, asked, frame)
        assert located is not None and located.value == pytest.approx(use)


def test_axial_forces_of_beams_for_their_connections() -> None:
    """Means of seven: forces on the ends are +-10 i kN and +-20 i kN, i = 1 to 7, of which 4 is the mean."""
    found = sets(7)[1]
    for i, group in enumerate(found.histories.values(), 1):
        coordinate(group, "collector", ["B_1_1"], "", "beam")
        for which, way in (("max", 1.0), ("min", -1.0)):
            of = np.zeros((3, 2))
            of[2] = way * 1e4 * i * np.array([1.0, 2.0])
            group.add(f"member_axial_force_{which}", ("member", "end"), of, "N", "")
    (table,) = [one for one in use_tables([found], None) if one.name == "beam_axial_forces"]
    assert [list(row) for row in table.texts] == [["1", "B_1_1", "40.0", "40.0", "80.0", "80.0"]]
    group.variables["member_axial_force_min"].values[2] = 0.0  # the end of the last is never compressed
    group.variables["member_axial_force_max"].values[2] = [0.0, 7e5]
    (beam,) = beam_forces(found, EC8)
    assert beam.start == pytest.approx((30e3, 30e3)) and beam.end == pytest.approx((160e3, 60e3))


def test_the_clause_on_means_has_its_code_once() -> None:
    assert in_words(ULTIMATE) == "NTC 2018, 7.3.5"
    assert in_words(SET_RULES) == "EN 1998-1:2004, 4.3.3.4.3(3)"


def test_axial_forces_of_beams_stand_storey_by_storey_and_whole(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 6 bays and 8 floors all 48 beams, by storey and bay, whatever the size of their forces."""
    beams = [
        BeamForces(f"B_{bay}_{floor}", floor, (1e3 * floor, 0.0), (0.0, 1e3)) for bay in range(6) for floor in range(8)
    ]
    monkeypatch.setattr("edesign.report.response.use_tables.beam_forces", lambda found, rules: beams)
    table = next(one for one in use_tables(sets(7)[:1], None) if one.name == "beam_axial_forces")
    assert [row[1] for row in table.texts] == [f"B_{bay}_{floor}" for floor in range(8) for bay in range(6)]
