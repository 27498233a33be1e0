"""Deflections of beams against closed forms: E I v of bending, and M / (G A_s) of shear, of simply supported beams."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, design_of, number_of

from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.space.analysis.deflections import LIMITED, Deflections, under_point_loads
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection.evaluate import searched_clauses

HALL = """\
edesign_building: 1
title: Hall
plan: {x: [9 m], y: [6 m]}
storeys: [4 m]
columns: [{section: HEB300, material: S275, strong: x}]
beams:
  - {along: x, section: IPE400, material: S275, ends: pinned, group: BX}
  - {along: y, section: IPE300, material: S275, ends: pinned, group: BY}
braces:
  - {along: x, frames: all, bays: 1, kind: cross, section: SHS100x5, material: S275}
  - {along: y, frames: all, bays: 1, kind: cross, section: SHS100x5, material: S275}
materials: {S275: {fy: 275 MPa}}
loads:
  areas: [{G: 3 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 2}]
  perimeter: [{G: 1 kN/m}]
  self_weight: false
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.1 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: concentric_diagonal, q: 4}, y: {type: concentric_diagonal, q: 4}}
"""
IPE400, E, G = steel_section("IPE400"), 210e9, 210e9 / 2.6
P_G, P_Q, L = 3e3 * 3.0 * 3.0, 2e3 * 3.0 * 3.0, 9.0
"""Secondary beams at the thirds bring P to a beam along x: a third of the bay, half of its width."""


def of_beam(design: ElasticDesign, name: str) -> tuple[float, float]:
    """Deflections of a beam under all and under variable loads, m."""
    found: Deflections = design.deflections
    names = [design.frame.members[number].name for number in found.members]
    return float(found.total[names.index(name)]), float(found.live[names.index(name)])


def simple(P: float, w: float) -> float:
    """Middle of a beam on hinges: 23 P L3 / 648 EI + 5 w L4 / 384 EI, and M / GA_s = (P L / 3 + w L2 / 8) / GA_s."""
    EI, GA = E * IPE400.I_y, G * IPE400.A_z
    return 23.0 * P * L**3 / (648.0 * EI) + 5.0 * w * L**4 / (384.0 * EI) + (P * L / 3.0 + w * L**2 / 8.0) / GA


def test_simply_supported_with_loads_at_thirds() -> None:
    design = design_of(HALL)
    total, live = of_beam(design, "BX_1_1_1")
    assert total == pytest.approx(simple(P_G + P_Q, 1e3), rel=1e-9)
    assert live == pytest.approx(simple(P_Q, 0.0), rel=1e-9)
    of, w = steel_section("IPE300"), 2e3 * 1.5  # half of a strip of 3 m on the beams along y
    across = 5.0 * w * 6.0**4 / (384.0 * E * of.I_y) + w * 6.0**2 / (8.0 * G * of.A_z)
    assert of_beam(design, "BY_A_1_1")[1] == pytest.approx(across, rel=1e-9)


def test_ends_that_are_restrained() -> None:
    """A beam whose columns restrain its ends: v of hinges less M L2 / 8 EI of the end moments by statics (1e-9)."""
    text = HALL.replace("ends: pinned, group: BX", "ends: rigid, group: BX")
    design = design_of(text)
    number = number_of(design.frame, "BX_1_1_1")
    M = np.abs(design.static.internal[:, number, [0, -1], 4]).sum()  # both ends and both cases alike
    total, _ = of_beam(design, "BX_1_1_1")
    expected = simple(P_G + P_Q, 1e3) - 0.5 * M * L**2 / (8.0 * E * IPE400.I_y)
    assert 0.0 < expected < simple(P_G + P_Q, 1e3) and total == pytest.approx(expected, rel=1e-9)


def test_fixed_ends() -> None:
    """Columns of 100 times the stiffness fix the ends: 5 P L3 / 648 EI + w L4 / 384 EI, and shear as on hinges.

    The ends still turn: 1 % of the deflection.
    """
    text = HALL.replace("ends: pinned, group: BX", "ends: rigid, group: BX").replace("HEB300", "HEB1000")
    text = text.replace("section: IPE400", "section: IPE240")
    total, _ = of_beam(design_of(text), "BX_1_1_1")
    of = steel_section("IPE240")
    P, w, EI, GA = P_G + P_Q, 1e3, E * of.I_y, G * of.A_z
    hinged = 5.0 * P * L**3 / (648.0 * EI) + w * L**4 / (384.0 * EI) + (P * L / 3.0 + w * L**2 / 8.0) / GA
    assert total == pytest.approx(hinged, rel=0.01)


def test_one_load_out_of_the_middle() -> None:
    """P at a of L: the largest deflection is P b (L2 - b2)^1.5 / (9 sqrt(3) L EI), b < L/2 (0.2 % of places)."""
    bending, moment = under_point_loads(np.array([5e3]), np.array([0.7]), np.array([L]))
    b = 0.3 * L
    assert bending.max() == pytest.approx(5e3 * b * (L**2 - b**2) ** 1.5 / (9.0 * np.sqrt(3.0) * L), rel=2e-3)
    assert moment.max() == pytest.approx(5e3 * 0.3 * 0.7 * L, rel=0.05)  # the load stands between two places


def test_a_beam_that_braces_meet_spans_the_bay() -> None:
    """Braces carry no gravity: both halves deflect as one beam on hinges of 9 m, up to their hold of a thousandth.

    The middle node turns with the beam, which is one; 2 % for what braces of a thousandth of their area hold.
    """
    text = HALL.replace(
        "{along: x, frames: all, bays: 1, kind: cross,", "{along: x, frames: all, bays: 1, kind: chevron,"
    ).replace("x: {type: concentric_diagonal, q: 4}", "x: {type: concentric_v, q: 2}")
    design = design_of(text)
    for half in ("BX_1_1_1_1", "BX_1_1_1_2"):
        total, live = of_beam(design, half)
        assert total == pytest.approx(simple(P_G + P_Q, 1e3), rel=0.02)
        assert live == pytest.approx(simple(P_Q, 0.0), rel=0.02)
    np.testing.assert_allclose(design.deflections.span[:2], 9.0)


def test_limits_make_rules() -> None:
    assert not [rule for rule in design_of(HALL).criteria if rule.clause == LIMITED]
    limits = "  serviceability: {beams: {total: 1/250, live: 0.1 %}}\n"
    found = design_of(HALL + limits)
    rules = {rule.text: rule for rule in found.criteria if rule.clause == LIMITED}
    text = "deflection of beams over span, characteristic, "
    total, live = rules[text + "all loads"], rules[text + "variable loads alone"]
    assert total.required == 1.0 / 250.0 and live.required == 0.001
    assert total.value == pytest.approx(simple(P_G + P_Q, 1e3) / L) and total.detail == "BX_1_1_1"
    assert live.passed is False and not found.passed
    assert LIMITED in searched_clauses(ElasticAnalysis(building(HALL + limits)))
    assert LIMITED not in searched_clauses(ElasticAnalysis(building(HALL)))


@pytest.mark.parametrize("wrong", ["1/0", "2/250", "L/250", "250", "-1/250", "1/250 m", "true"])
def test_limits_that_are_none(wrong: str) -> None:
    with pytest.raises(InputError, match="serviceability.beams.total"):
        building(HALL + f"  serviceability: {{beams: {{total: {wrong}}}}}\n")
