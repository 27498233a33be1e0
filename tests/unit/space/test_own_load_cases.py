"""Own load cases of buildings against statics written out: wind on facades, floors, braces in tension, combinations."""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import building, design_of, number_of

from edesign.errors import InputError
from edesign.space.analysis.lateral import SWAY_LIMITED
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.evaluate import searched_clauses
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.geometry import space_frame

STEPPED = """\
edesign_building: 1
title: Stepped
plan: {x: [6 m, 4 m], y: {count: 2, width: 5 m}}
storeys: [4 m, 3 m]
setbacks: [{floors: 2, bays: {x: 1, y: all}}]
columns: [{section: HEB200, material: S275, strong: x}]
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE240, material: S275}
materials: {S275: {fy: 275 MPa}}
"""
BRACED = """\
edesign_building: 1
title: Braced
plan: {x: [6 m], y: [6 m]}
storeys: [4 m]
columns: [{section: HEB200, material: S275, strong: x}]
supports: pinned
beams:
  - {along: x, section: IPE300, material: S275, ends: pinned}
  - {along: y, section: IPE300, material: S275, ends: pinned}
braces:
  - {along: x, frames: all, bays: 1, kind: cross, section: SHS100x5, material: S275}
  - {along: y, frames: all, bays: 1, kind: cross, section: SHS100x5, material: S275}
materials: {S275: {fy: 275 MPa}}
loads:
  self_weight: false
  areas: [{G: 3 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]
  cases:
    wind: {category: wind, reversed: true, floors: [{floors: 1, y: 100 kN}]}
    beside: {category: wind, floors: [{floors: 1, y: 100 kN, at: {x: 6 m, y: 0 m}}]}
    drift: {category: snow, areas: [{q: 1 kN/m^2, spans: x}]}
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.05 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: concentric_diagonal, q: 4}, y: {type: concentric_diagonal, q: 4}}
  serviceability: {sway: {storey: 1/300, building: 1/2000}}
"""


def with_cases(cases: str) -> SpaceFrame:
    return space_frame(building(STEPPED + f"loads:\n  self_weight: false\n  cases: {{{cases}}}\n"), design=True)


def forces(frame: SpaceFrame, case: str, axis: int) -> dict[str, float]:
    """Forces on nodes along an axis in kN."""
    values = frame.cases[case].nodal[:, axis] / 1e3
    return {name: round(float(value), 6) for name, value in zip(frame.node_names, values, strict=True) if value}


def test_pressure_on_the_facade_that_wind_blows_on() -> None:
    """1 kN/m2 on side x-: at A1 0.25 x 5 m x 4 m = 5 kN at the base, 5 + 0.25 x 5 x 3 = 8.75 kN at floor 1, 3.75 kN.

    A2 between two bays has twice as much. The whole is (4 + 3) x 10 = 70 kN.
    """
    frame = with_cases("w: {category: wind, facades: [{side: x-, pressure: 1 kN/m^2}]}")
    found = forces(frame, "w", 0)
    assert found["A1.0"] == 5.0 and found["A1.1"] == 8.75 and found["A1.2"] == 3.75
    assert found["A2.0"] == 10.0 and found["A2.1"] == 17.5 and found["A2.2"] == 7.5
    assert sum(found.values()) == pytest.approx(70.0)
    assert not forces(frame, "w", 1)


def test_suction_behind_a_setback_goes_to_the_line_where_the_storey_ends() -> None:
    """Storey 1 ends at line C, storey 2 at line B: 10 m x 4 m x 0.5 = 20 kN at C, 10 m x 3 m x 0.5 = 15 kN at B."""
    frame = with_cases("w: {category: wind, facades: [{side: x+, pressure: -0.5 kN/m^2}]}")
    found = forces(frame, "w", 0)
    assert sum(value for name, value in found.items() if name[0] == "C") == pytest.approx(20.0)
    assert sum(value for name, value in found.items() if name[0] == "B") == pytest.approx(15.0)
    assert found["B2.1"] == found["B2.2"] == pytest.approx(0.5 * 5.0 * 3.0 * 0.5)


def test_pressures_along_y_by_storeys() -> None:
    """Side y- in storey 2 is 6 m wide: 6 x 3 x 0.8 = 14.4 kN along y; side y+ of storey 1: 10 x 4 x 0.8 against y."""
    frame = with_cases(
        "a: {category: wind, facades: [{side: y-, storeys: 2, pressure: 0.8 kN/m^2}]}, "
        "b: {category: wind, facades: [{side: y+, storeys: 1, pressure: 0.8 kN/m^2}]}"
    )
    assert sum(forces(frame, "a", 1).values()) == pytest.approx(14.4)
    assert {name[:2] for name in forces(frame, "a", 1)} == {"A1", "B1"}
    assert sum(forces(frame, "b", 1).values()) == pytest.approx(-32.0)


def test_uplift_of_a_roof_beams_and_nodes() -> None:
    """-0.6 kN/m2 on 6 x 5 m that span x: 0.6 x 3 = 1.8 kN/m upwards on the beams along y, 3.6 kN/m between bays."""
    frame = with_cases(
        "w: {category: wind, areas: [{floors: 2, q: -0.6 kN/m^2, spans: x}],"
        " beams: [{along: x, frames: 1, bays: 1, floors: 2, q: -0.4 kN/m}],"
        " nodes: [{at: B2, floors: 2, x: 3 kN, y: -2 kN, down: -1 kN}]}"
    )
    case, members = frame.cases["w"], [member.name for member in frame.members]
    assert case.uniform[members.index("BY_A_1_2"), 2] == pytest.approx(1.8e3)
    assert case.uniform[members.index("BX_1_1_2"), 2] == pytest.approx(0.4e3)
    assert case.nodal[frame.node_names.index("B2.2"), :3] == pytest.approx([3e3, -2e3, 1e3])
    assert case.relieving


def test_own_cases_bring_no_masses_and_do_not_act_in_analyses() -> None:
    wind = building(BRACED)
    bare = building(BRACED.replace("areas: [{q: 1 kN/m^2", "areas: [{q: 9 kN/m^2"))
    assert np.array_equal(space_frame(wind, True).node_mass, space_frame(bare, True).node_mass)
    assert set(space_frame(wind).cases) == {"G", "Q_B"}


@pytest.fixture(scope="module")
def braced() -> ElasticDesign:
    return design_of(BRACED)


def static(design: ElasticDesign, case: str, member: str, station: int = 0) -> float:
    """Axial force of a member under a case, kN."""
    return (
        float(design.effects.static[design.effects.cases.index(case), number_of(design.frame, member), station, 0])
        / 1e3
    )


def test_of_a_cross_the_diagonal_in_tension_acts_alone(braced: ElasticDesign) -> None:
    """50 kN on each frame along y: N = 50 sqrt(52) / 6 = 60.09 kN in the one that rises along it, the other is slack.

    It pulls the leeward column down by N 4 / sqrt(52) = 33.33 kN and the windward base up, whose column has no force.
    """
    N, V = 50.0 * math.sqrt(52.0) / 6.0, 50.0 * 4.0 / 6.0
    for case, acts, slack, lee, wind in (("wind", "r", "f", "A2", "A1"), ("-wind", "f", "r", "A1", "A2")):
        assert static(braced, case, f"DY_A_1_1_{acts}") == pytest.approx(N, rel=1e-6)
        assert static(braced, case, f"DY_A_1_1_{slack}") == pytest.approx(0.0, abs=1e-6)
        # the crosses along x hold columns back that grow longer or shorter: 2 % of V
        assert static(braced, case, f"C_{lee}_1") == pytest.approx(-V, abs=0.03 * V)
        assert static(braced, case, f"C_{wind}_1") == pytest.approx(0.0, abs=0.03 * V)
        of = braced.foundations
        reactions = of.static[of.cases.index(case), :, 2] / 1e3
        assert reactions[of.nodes.index(f"{lee}.0")] == pytest.approx(V, rel=1e-4)
        assert reactions[of.nodes.index(f"{wind}.0")] == pytest.approx(-V, rel=1e-4)
        horizontal = of.static[of.cases.index(case), :, 1].sum() / 1e3
        assert horizontal == pytest.approx(-100.0 if case == "wind" else 100.0, rel=1e-6)


def test_uplift_of_supports_in_persistent_combinations(braced: ElasticDesign) -> None:
    """G at A1: 3 x 6 x 6 / 4 = 27 kN. G - 1.5 wind: 27 - 1.5 x 33.33 = -23 kN at A2.

    Wind beside the middle pulls B1 up by 75 x 4 / 6 = 50 kN and the cross on line 1 down by 25 x 4 / 6 = 16.67 kN:
    27 - 1.5 x 33.33 = -23 kN too, -24 kN with what the columns that become longer and shorter add.
    """
    of = braced.foundations
    rows = of.acting[:, :, 2] / 1e3
    back = of.persistent.index("G - 1.5 wind")
    assert rows[back, of.nodes.index("A2.0")] == pytest.approx(27.0 - 50.0, abs=0.1)
    assert rows[of.persistent.index("G + 1.5 wind"), of.nodes.index("A1.0")] == pytest.approx(-23.0, abs=0.1)
    worst = float(rows.min())
    assert worst == pytest.approx(-23.0, abs=1.1)
    assert any("in persistent combinations" in note and f"by {-worst:.0f} kN" in note for note in braced.notes)


def test_the_beam_above_a_cross_collects_its_force(braced: ElasticDesign) -> None:
    """The floor brings 50 kN evenly along the beam; the diagonal pulls at its leeward end: -50 kN there."""
    assert static(braced, "wind", "BY_A_1_1", 0) == pytest.approx(0.0, abs=1e-6)
    assert static(braced, "wind", "BY_A_1_1", 6) == pytest.approx(-50.0, rel=1e-6)


def test_a_force_beside_the_middle_turns_the_floor(braced: ElasticDesign) -> None:
    """100 kN along y through line B: the four frames of equal stiffness k, 3 m from the middle.

    The moment 100 x 3 = 300 kN m has 36 k of rotation: 300 x 3 / 36 = 25 kN on each: 75 kN on B, 25 kN on A.
    """
    force = math.sqrt(52.0) / 6.0
    assert static(braced, "beside", "DY_B_1_1_r") == pytest.approx(75.0 * force, rel=1e-4)
    assert static(braced, "beside", "DY_A_1_1_r") == pytest.approx(25.0 * force, rel=1e-4)
    along_x = sorted(static(braced, "beside", f"DX_{k}_1_1_{way}") for k in (1, 2) for way in "rf")
    assert along_x == pytest.approx([0.0, 0.0, 25.0 * force, 25.0 * force], rel=0.05, abs=1e-6)  # of common columns


def test_drift_under_wind_and_its_limits(braced: ElasticDesign) -> None:
    """d = N L / (E A cos) of the diagonal, and V h / (E A) of the columns, half up and half down in the model, h / b.

    The crosses along x hold the columns back, by 2 %. The criterion has the largest of the characteristic combinations.
    """
    frame = braced.frame
    brace, column = (frame.section(name).A for name in ("SHS100x5", "HEB200"))
    L, cosine = math.sqrt(52.0), 6.0 / math.sqrt(52.0)
    N, V = 50e3 / cosine, 50e3 * 4.0 / 6.0
    d = N * L / (210e9 * brace * cosine) + V * 4.0 / (210e9 * column) * 4.0 / 6.0
    of = braced.lateral
    found = of.drift[of.cases.index("wind"), 1, 0]
    assert found == pytest.approx(d, rel=0.03)
    assert of.combined[1, 0] >= found
    rules = [rule for rule in braced.criteria if rule.clause == SWAY_LIMITED]
    assert [rule.required for rule in rules] == [1 / 300, 1 / 2000, 1 / 300, 1 / 2000]
    assert rules[2].value == pytest.approx(of.combined[1, 0] / 4.0)
    assert SWAY_LIMITED in searched_clauses(ElasticAnalysis(building(BRACED)))


def test_combinations(braced: ElasticDesign) -> None:
    """EN 1990, 6.10 with psi_0 of offices 0.7, snow 0.5, wind 0.6, written out; winds never act together."""
    names = [row.name for row in braced.combinations if row.set == "fundamental" and "S_" not in row.name]
    winds = ("+ {} wind", "- {} wind", "+ {} beside")
    assert set(names) == {
        "1.35 G + 1.5 Q + 0.75 drift",
        "1.35 G + 1.05 Q + 1.5 drift",
        *(f"1.35 G + 1.5 Q {of.format(0.9)} + 0.75 drift" for of in winds),
        *(f"1.35 G + 1.05 Q {of.format(0.9)} + 1.5 drift" for of in winds),
        *(f"1.35 G + 1.05 Q {of.format(1.5)} + 0.75 drift" for of in winds),
        *(f"G {of.format(1.5)}" for of in winds),
    }
    assert all(set(row.static) <= {"G", "Q"} for row in braced.combinations if row.set == "seismic")


def test_own_categories_and_stated_combinations() -> None:
    """A crane with psi 1.0, 0.9, 0.6: 1.5 with the wind that leads too; 0.6 in an earthquake, and no mass."""
    text = BRACED.replace(
        "    drift: {category: snow, areas: [{q: 1 kN/m^2, spans: x}]}",
        "    crane: {category: crane, nodes: [{at: A1, floors: 1, down: 50 kN}]}\n  psi: {crane: [1, 0.9, 0.6]}",
    ).replace("  serviceability:", "  fundamental: {stated: [{G: 1.2, Q_B: 0.5, -wind: 1.1}]}\n  serviceability:")
    design = design_of(text)
    names = [row.name for row in design.combinations]
    assert "1.35 G + 1.05 Q + 1.5 wind + 1.5 crane" in names or "1.35 G + 1.05 Q + 1.5 crane + 1.5 wind" in names
    assert "1.2 G + 0.5 Q - 1.1 wind" in names
    assert "G + 0.3 Q + 0.6 crane + E_x + 0.3 E_y" in names
    assert any("crane" in note for note in design.notes)


def test_patterns_load_every_other_bay() -> None:
    """A chessboard of 2 x 2 bays in two storeys, 6 and 4 m by 5 m: half of the bays of each floor in either case."""
    text = STEPPED.replace("setbacks: [{floors: 2, bays: {x: 1, y: all}}]\n", "") + (
        "loads: {self_weight: false, pattern: chessboard, areas: [{Q: 2 kN/m^2, G: 1 kN/m^2, category: B, spans: x}]}\n"
    )
    one = building(text)
    frame, whole = space_frame(one, True), space_frame(one)
    assert set(frame.cases) == {"G", "Q_B1", "Q_B2"}
    assert np.allclose(frame.cases["Q_B1"].uniform + frame.cases["Q_B2"].uniform, whole.cases["Q_B"].uniform)
    members = [member.name for member in frame.members]
    # beam along y on line B between bays of 6 and 4 m: 2 x 3 = 6 kN/m in one case, 2 x 2 = 4 kN/m in the other
    of = members.index("BY_B_1_1")
    assert sorted(-frame.cases[name].uniform[of, 2] / 1e3 for name in ("Q_B1", "Q_B2")) == pytest.approx([4.0, 6.0])
    floors = -frame.cases["Q_B1"].uniform[:, 2]
    assert floors[members.index("BY_A_1_1")] != floors[members.index("BY_A_1_2")]  # they alternate upwards too
    assert np.allclose(frame.node_mass, whole.node_mass)


def test_patterns_in_combinations() -> None:
    text = BRACED.replace("  self_weight: false\n", "  self_weight: false\n  pattern: chessboard\n")
    names = [row.name for row in design_of(text).combinations]
    assert {"1.35 G + 1.5 Q1 + 0.75 drift", "1.35 G + 1.5 Q2 + 0.75 drift"} <= set(names)
    assert "1.35 G + 1.5 Q1 + 1.5 Q2 + 0.75 drift" in names
    assert "G + 0.3 Q1 + 0.3 Q2 + E_x + 0.3 E_y" in names


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("category: wind, reversed", "category: wnd, reversed", r"did you mean `wind`.*snow"),
        ("    wind: {", "    Q_B: {", "a name of edesign's own cases"),
        ("    wind: {", "    Q2: {", "a name of edesign's own cases"),  # that of a pattern
        ("floors: [{floors: 1, y: 100 kN}]", "floors: [{floors: 3, y: 100 kN}]", "floor 3"),
        ("floors: [{floors: 1, y: 100 kN}]", "nodes: []", "this case has no load"),
        ("floors: [{floors: 1, y: 100 kN}]", "facades: [{side: x-, pressure: 80 kN/m^2}]", "E-UNIT-03"),
        ("category: snow, areas", "category: snow, reversed: true, areas", "snow acts downwards"),
        ("  self_weight: false\n", "  psi: {wind: [0.5, 0.2, 0]}\n", "national: psi"),
        ("  self_weight: false\n", "  psi: {crane: [1, 0.9, 0.5]}\n", "no case of `loads.cases` has the category"),
        ("  self_weight: false\n", "  pattern: strips_x\n  live_load_reduction: true\n", "loads half of them"),
        ("  serviceability:", "  fundamental: {stated: [{G: 1, wynd: 1}]}\n  serviceability:", "did you mean `wind`"),
        ("masses:", "diaphragms: none\nmasses:", "floor `1` is not rigid as one"),
    ],
)
def test_refused(old: str, new: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        building(BRACED.replace(old, new, 1))
