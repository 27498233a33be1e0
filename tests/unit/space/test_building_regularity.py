"""Regularity of buildings, found and claimed: closed forms and geometry by hand (EN 1998-1, 4.2.3)."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import SMALL, building, changed, design_of, moment_frames

from edesign.codes.rule_check import RuleCheck
from edesign.space.checks.regularity import floor_stiffness
from edesign.space.designed import ElasticDesign
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model
from edesign.space.structure.plan_outline import recess_areas

BUILDING = changed(
    moment_frames(),
    (
        "{along: x, section: IPE400, material: S275, ends: rigid, group: BX}",
        "{along: x, frames: 1, section: IPE240, material: S275, group: B1}\n"
        "  - {along: x, frames: 2, section: IPE600, material: S275, group: B2}",
    ),
    (", Q: 2 kN/m^2, category: B", ""),
    (", Q: 0.3}", "}"),
)
"""One storey, the frame on line 2 stiffer than that on line 1."""
ALIKE = BUILDING.replace("section: IPE600", "section: IPE240")


def rules(found: ElasticDesign, clause: str) -> list[RuleCheck]:
    return [rule for rule in found.criteria if rule.clause == clause]


def test_frequencies_of_an_eccentric_storey() -> None:
    """A storey with the eccentricity e: omega2 / omega_x2 = (1 + Om2 -+ sqrt((1 - Om2)2 + 4 (e / rho)2)) / 2.

    rho is the radius of gyration and Om2 = (r2 + e2) / rho2. The ratio of the two frequencies that follows from e, r
    and rho is that of the natural modes (1e-9): both are exact for one rigid floor.
    """
    found = design_of(BUILDING)
    eccentricity, radius = rules(found, "4.2.3.2(6)")[:2]
    R = radius.value
    assert R is not None and eccentricity.value is not None
    e = eccentricity.value * R  # over rho
    Om2 = R**2 + e**2
    root = np.sqrt((1.0 - Om2) ** 2 + 4.0 * e**2)
    coupled = found.modes.effective_mass_ratio[:, 0] > 1e-6
    omega2 = np.sort(found.modes.omega[coupled] ** 2)
    assert omega2.size == 2 and e > 0.1
    assert omega2[1] / omega2[0] == pytest.approx((1.0 + Om2 + root) / (1.0 + Om2 - root), rel=1e-9)


def test_centre_of_stiffness_of_two_frames() -> None:
    """e = 4 m (K_2 - K_1) / (K_2 + K_1), K of each frame from a symmetric building of two of them.

    Columns twist and bend with the beams along y, which the plane frames do not have (0.5 %).
    """
    K = []
    for section in ("IPE240", "IPE600"):
        alike = design_of(BUILDING.replace("IPE240", section).replace("IPE600", section))
        K.append(alike.modes.omega[alike.modes.effective_mass_ratio[:, 0].argmax()] ** 2)
    whole = building(BUILDING)
    frame = space_frame(whole)
    of = floor_stiffness(frame, space_model(frame, whole.materials))
    assert of.e_0[0, 0] == pytest.approx(4.0 * (K[1] - K[0]) / (K[1] + K[0]), rel=5e-3)
    assert of.e_0[1, 0] == 0.0
    assert of.l_s[0] == pytest.approx(5.0, rel=1e-12)  # four equal masses at the corners of 6 x 8 m


def test_a_claim_that_does_not_hold() -> None:
    """One frame of two is stiffer, e_0 > 0.3 r: the claim fails, without it the figures inform."""
    regular = rules(design_of(BUILDING + "  regular_in_plan: true\n"), "4.2.3.2(6)")
    assert [rule.passed for rule in regular if rule.text == "e_0 / r, direction x"] == [False]
    assert rules(design_of(ALIKE + "  regular_in_plan: true\n"), "4.2.3.2(6)")[0].passed is True
    reported = rules(design_of(BUILDING + "  regular_in_plan: false\n"), "4.2.3.2(6)")
    assert {rule.passed for rule in reported} == {None, True}
    assert all(("counts as irregular" in rule.detail) is (rule.passed is None) for rule in reported)
    assert rules(design_of(BUILDING), "4.2.3.2(6)") == reported


def test_setbacks_and_interrupted_bracings() -> None:
    """Three bays, of which the top floor covers one: two bays of three set back, 0.67 > 0.20, 0.30 and 0.10."""
    tall = changed(
        BUILDING,
        ("x: [6 m]", "x: [6 m, 6 m, 6 m]"),
        ("storeys: [4 m]\n", "storeys: [4 m, 4 m, 4 m]\nsetbacks: [{floors: 3, bays: {x: 1, y: 1}}]\n"),
        ("y: {type: moment_frame, q: 4}", "y: {type: concentric_diagonal, q: 4}"),
        (
            "materials:",
            "braces:\n"
            "  - {along: y, frames: A, bays: 1, storeys: [1, 3], kind: cross, section: SHS100x6, material: S275}\n"
            "  - {along: y, frames: D, bays: 1, storeys: 1-2, kind: cross, section: SHS100x6, material: S275}\n"
            "materials:",
        ),
    )
    found = design_of(tall + "  regular_in_elevation: true\n")
    steps = [rule for rule in found.criteria if rule.clause.startswith("4.2.3.3(5)")]
    assert [rule.clause for rule in steps] == ["4.2.3.3(5)c", "4.2.3.3(5)c"]
    assert [rule.value for rule in steps] == [pytest.approx(2.0 / 3.0)] * 2
    assert all(rule.passed is False and rule.text.endswith("direction x") for rule in steps)
    (bracing,) = rules(found, "4.2.3.3(2)")
    assert bracing.passed is False and bracing.detail == "frame YA has none in storey 2"
    irregular = design_of(tall)
    assert {rule.passed for rule in irregular.criteria if rule.clause.startswith("4.2.3.3")} == {None}


def test_floors_that_are_not_rigid_have_no_centre_of_stiffness() -> None:
    soft = design_of(BUILDING, ("columns:", "diaphragms: none\ncolumns:"))
    (rule,) = rules(soft, "4.2.3.2(4)")
    assert rule.passed is None and not rules(soft, "4.2.3.2(6)")


@pytest.mark.parametrize(
    ("bays", "areas"),
    [
        (".#\n##", [0.5]),  # an L: a triangle of half a bay
        ("#.#\n###", [1.0]),  # a U
        (".#.\n###\n.#.", [0.5, 0.5, 0.5, 0.5]),  # a cross
        ("###\n#.#\n###", []),  # a court is no set-back of the outline
        ("##\n##", []),
        ("..#\n###\n#..", [1.0, 1.0]),  # a Z: triangles of 1 x 2
        ("#.#.#\n#####", [1.0, 1.0]),  # teeth on one side of the hull
    ],
)
def test_areas_of_recesses(bays: str, areas: list[float]) -> None:
    """Plans of square bays of 1 m, drawn from the north; areas by hand."""
    rows = bays.split("\n")[::-1]
    covered = {(i + 1, j + 1) for j, row in enumerate(rows) for i, sign in enumerate(row) if sign == "#"}
    lines = list(range(8))
    found, whole = recess_areas(covered, lines, lines)
    assert sorted(found) == pytest.approx(areas) and whole == len(covered)


def test_q_follows_what_is_found() -> None:
    """Table 6.2 in class high: 5 x 1.1 of one storey; irregular in plan 5 x (1 + 1.1) / 2 (6.3.2(4)); 0.8 of it."""
    high, alike = (
        text.replace("class: medium", "class: high").replace("q: 4", "q: table") for text in (BUILDING, ALIKE)
    )
    for text, q in (
        (alike + "  regular_in_plan: true\n", 5.5),
        (high, 5.25),
        (high + "  regular_in_elevation: false\n", 0.8 * 5.25),
    ):
        assert design_of(text).q["x"] == pytest.approx(q)


def test_a_column_above_none_makes_a_building_irregular_in_elevation() -> None:
    """EN 1998-1, 4.2.3.3(2) holds for frames too; q of the table falls to 0.8 of it."""
    changes = ("storeys: [4 m, 3 m]", "storeys: [4 m, 3 m]\nmissing: {columns: [{at: B2, storeys: 1}]}")
    found = design_of(SMALL, changes, ("{type: moment_frame, q: 4}", "{type: moment_frame, q: table}"))
    whole = design_of(SMALL, ("{type: moment_frame, q: 4}", "{type: moment_frame, q: table}"))
    rule = next(rule for rule in found.criteria if rule.clause == "4.2.3.3(2)")
    assert rule.value == 1.0 and "C_B2_2 stands on no column" in rule.detail
    assert found.q["x"] == pytest.approx(0.8 * whole.q["x"])


def test_masses_without_loads_are_reported() -> None:
    given = design_of(SMALL, ("masses: {from_loads: {}}", "masses: {given: [{floors: all, mass: 90 t}]}"))
    assert any("P and theta are those of the loads" in note for note in given.notes)
    assert not any("P and theta" in note for note in design_of(SMALL).notes)
