"""alpha_A of beams and alpha_n of columns in the persistent combinations, by hand."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, design_of, number_of

from edesign.frame.sections.steel_section import steel_section
from edesign.space.analysis.live_load_reduction import loaded_areas
from edesign.space.designed import ElasticDesign

TOWER = """\
edesign_building: 1
title: Tower
plan: {x: [9 m, 9 m], y: [6 m]}
storeys: {count: 4, height: 4 m}
columns: [{section: HEB300, material: S275, strong: x}]
beams:
  - {along: x, section: IPE450, material: S275}
  - {along: y, section: IPE300, material: S275, ends: pinned}
braces:
  - {along: y, frames: [A, C], bays: 1, kind: cross, section: SHS100x5, material: S275}
materials: {S275: {fy: 275 MPa}}
loads:
  areas: [{G: 3 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 2}]
  self_weight: false
  live_load_reduction: true
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.1 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: concentric_diagonal, q: 4}}
  imperfections: none
"""
PSI_0 = 0.7


def factors(design: ElasticDesign, name: str, force: int, at: int = 0) -> float:
    """Effect of the reduced load by that of the whole one."""
    cases, number = design.effects.cases, number_of(design.frame, name)
    reduced, whole = (design.effects.static[cases.index(case), number, at, force] for case in ("alpha Q", "Q"))
    return float(reduced / whole)


def test_beams_by_the_area_that_they_carry() -> None:
    """Beams along x carry two thirds of a bay's half from secondary beams, 18 m2; of those along y B carries 18 m2 too
    (a third of two bays' halves), A 9 m2, which is below A_0 / (1 - 5/7 psi_0) = 20 m2: alpha_A = 1 there."""
    of = building(TOWER)
    areas = {str(place): area for place, area in loaded_areas(of, "B").items()}
    assert areas["BX_1_1_2"] == pytest.approx(18.0) and areas["BY_A_1_2"] == pytest.approx(9.0)
    assert areas["BY_B_1_2"] == pytest.approx(18.0)
    assert sum(areas.values()) == pytest.approx(4 * 18.0 * 6.0)
    wide = design_of(TOWER, ("y: [6 m]", "y: [10 m]"))
    assert factors(wide, "BX_1_1_2", 4) == pytest.approx(5.0 / 7.0 * PSI_0 + 10.0 / 30.0)
    assert factors(wide, "BX_1_1_2", 2) == pytest.approx(5.0 / 7.0 * PSI_0 + 10.0 / 30.0)


def test_columns_by_the_storeys_above() -> None:
    """alpha_n = (2 + (n - 2) psi_0) / n on N of four, three, two and one storeys; moments stay."""
    found = design_of(TOWER)
    expected = [(2.0 + 2.0 * PSI_0) / 4.0, (2.0 + PSI_0) / 3.0, 1.0, 1.0]
    assert [factors(found, f"C_B1_{storey}", 0) for storey in (1, 2, 3, 4)] == pytest.approx(expected)
    assert factors(found, "C_A1_1", 4) == 1.0
    assert any("alpha_A in beams and alpha_n in columns" in note for note in found.notes)


def test_only_leading_loads_are_reduced() -> None:
    """Not with psi_0 beside snow that leads, nor with psi_2 in an earthquake."""
    found = design_of(TOWER, ("areas: [", "areas: [{floors: 4, Q: 1 kN/m^2, category: snow, spans: x}, "))
    assert [row.name for row in found.members.rows if row.set == "fundamental"] == [
        "1.35 G + 1.5 alpha Q_B + 0.75 Q_snow",
        "1.35 G + 1.05 Q_B + 1.5 Q_snow",
    ]
    assert found.members.rows[0].static == {"G": 1.35, "Q_snow": 0.75, "alpha Q_B": 1.5}
    assert not any("alpha" in row.name for row in found.combinations if row.set != "fundamental")


def test_stores_are_not_reduced() -> None:
    found = design_of(TOWER, ("category: B", "category: E"))
    assert found.effects.cases == ("G", "Q") and found.members.rows[0].name == "1.35 G + 1.5 Q"


def test_checks_take_the_reduced_loads() -> None:
    """N of the lowest column: 1.35 N_G + 1.5 alpha_n N_Q over A f_y (rounding, 1e-9)."""
    found = design_of(TOWER)
    number = number_of(found.frame, "C_B1_1")
    N_G, N_Q = found.static.internal[:, number, 0, 0]
    check = found.members.checks.index("N")
    assert found.members.combination[number, check] == 1
    expected = 1.35 * N_G + 1.5 * (2.0 + 2.0 * PSI_0) / 4.0 * N_Q
    N_Rd = steel_section("HEB300").A * 275e6
    assert found.members.utilisation[number, check] == pytest.approx(-expected / N_Rd, rel=1e-9)


def test_sway_imperfections_stay_those_of_the_whole_loads() -> None:
    text = TOWER.replace("imperfections: none", "imperfections: sway")
    one, other = (design_of(text, ("reduction: true", f"reduction: {key}")) for key in ("true", "false"))
    np.testing.assert_array_equal(one.sway.internal, other.sway.internal)
    assert one.members.rows[1].name == "1.35 G + 1.5 alpha Q + S_x"
