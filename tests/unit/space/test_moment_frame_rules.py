"""Column bases, web panels and foundations of small buildings, by hand and by equilibrium."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import NO_TORSION, PINNED, braced_frames, changed, design_of, moment_frames, number_of

from edesign.archive.reader import open_archive
from edesign.codes.ec8.verification.capacity import foundation_factor
from edesign.frame.building_file import load_building
from edesign.frame.sections.steel_section import steel_section
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.foundations import foundation_summary, foundation_table
from edesign.report.tables.number import significant
from edesign.space.analysis.bracing import bracing
from edesign.space.checks.foundations import supports
from edesign.space.designed import ElasticDesign
from edesign.study.run.building import run_building

OWN_WEIGHT = ("self_weight: false", "self_weight: true")
FRAME = changed(moment_frames(x="6 m, 6 m", storeys="4 m, 3 m"), OWN_WEIGHT) + NO_TORSION
FY = 275e6


@pytest.fixture(scope="module")
def found() -> ElasticDesign:
    return design_of(FRAME)


def test_web_panels_by_hand(found: ElasticDesign) -> None:
    """EN 1993-1-8, Eqs. 5.3 and 6.7: one beam IPE400 at the edge, two in the middle, HEB300 of S275.

    V_wp,Ed = sum M_pl / (h - t_f) less the mean shear of both columns at the first hinge. V_wp,Rd = 0.9 A_vc f_y /
    sqrt3, with a plate 208 mm wide and as thick as the web, 11 mm, beside it (6.2.6.1(6)). Along y the columns bend
    about their weak axis: no panels there.
    """
    beam, column = steel_section("IPE400"), steel_section("HEB300")
    M_over_z = beam.W_pl_y * FY / (0.4 - 0.0135)
    web = 0.9 * FY * column.A_vz / np.sqrt(3.0)
    plate = 0.9 * FY * 0.208 * 0.011 / np.sqrt(3.0)
    panels = {panel.node: panel for panel in found.panels}
    assert {panel.axis for panel in found.panels} == {"x"} and len(panels) == 12
    for line, beams in (("A1", 1), ("B1", 2)):
        E = found.effects.seismic[0]
        V = [E[number_of(found.frame, f"C_{line}_{storey}"), 0, 2] for storey in (1, 2)]
        panel = panels[f"{line}.1"]
        expected = beams * M_over_z - found.overstrength["x"].Omega * np.mean(V)
        assert panel.V_wp_Ed == pytest.approx(expected, rel=1e-12)
        assert panel.V_wp_Rd == pytest.approx(web, rel=1e-12)
        assert panel.V_wp_Rd_doubled == pytest.approx(web + plate, rel=1e-12)
        assert panel.doubler == (0.011 if expected > web else 0.0)
    (rule,) = [rule for rule in found.criteria if rule.clause == "6.6.3(6)" and rule.value is not None]
    assert rule.value == pytest.approx(max(panel.utilisation(True) for panel in found.panels), rel=1e-12)
    assert "doubler plates up to 11 mm at" in rule.detail


def test_without_doubler_plates(found: ElasticDesign) -> None:
    plain = design_of(FRAME + "  members: {doubler_plates: false}\n")
    worst = max(panel.V_wp_Ed / panel.V_wp_Rd for panel in found.panels)
    rules = [rule for rule in plain.criteria if rule.clause == "6.6.3(6)" and rule.value is not None]
    assert rules[0].value == pytest.approx(worst, rel=1e-12) and rules[0].passed is False


def test_hinges_at_the_bases(found: ElasticDesign) -> None:
    """EN 1998-1, 6.6.3(2) and (4): M_pl,Rd at the base and the moment at the head of the amplified combinations."""
    column = steel_section("HEB300")
    M_pl, V_pl = column.W_pl_y * FY, column.A_vz * FY / np.sqrt(3.0)
    ground = [n for n, of in enumerate(found.frame.members) if of.kind == "column" and of.storey == 1]
    head = [
        max(
            abs(found.effects.of_static(row)[n, -1, 4]) + found.effects.of_seismic(row)[n, -1, 4]
            for row in found.members.amplified
        )
        for n in ground
    ]
    rules = {rule.text: rule for rule in found.criteria}
    rule = rules["V_Ed / V_pl,Rd of columns with M_pl,Rd at the column base, direction x"]
    assert rule.value == pytest.approx((M_pl + max(head)) / 4.0 / V_pl, rel=1e-12) and rule.required == 0.5
    assert rules["class of columns at hinges at their bases, direction x"].value == 1.0


def test_pinned_bases_have_no_hinges() -> None:
    pinned = design_of(FRAME, PINNED)
    assert not [rule for rule in pinned.criteria if "at the column base" in rule.text or "at their bases" in rule.text]
    assert np.ptp(pinned.foundations.factor[0]) == 0.0  # Omega of the beams everywhere


def test_reactions_balance_the_loads(found: ElasticDesign) -> None:
    """Sums of the reactions are the weights; of the seismic action in a symmetric building V and its moment (1e-9)."""
    base = found.foundations
    assert base.nodes == ("A1.0", "A2.0", "B1.0", "B2.0", "C1.0", "C2.0")
    weight = dict(zip(base.cases, base.static[:, :, 2].sum(axis=1), strict=True))
    steel = sum(steel_section(of.section).A * found.frame.length[n] for n, of in enumerate(found.frame.members))
    assert weight["Q"] == pytest.approx(2 * 2e3 * 96.0, rel=1e-9)
    assert weight["G"] == pytest.approx(2 * 5e3 * 96.0 + 7850.0 * 9.80665 * steel, rel=1e-9)
    mode = int(found.modes.effective_mass_ratio[:, 0].argmax())
    of = supports(found.frame, bracing(found.frame))
    R = of.modal(found.modes.end_forces[[mode]])[0]
    inertia = found.modes.omega[mode] ** 2 * found.frame.node_mass * found.modes.displacements[mode, :, 0]
    x, z = found.frame.coordinates[of.nodes, 0], found.frame.coordinates[:, 2]
    assert R[:, 0].sum() == pytest.approx(-inertia.sum(), rel=1e-9)
    overturning = (inertia * z).sum()
    assert (R[:, 4] - x * R[:, 2]).sum() == pytest.approx(-overturning, rel=1e-9)


def test_design_actions_on_foundations(found: ElasticDesign) -> None:
    """EN 1998-1, Eq. 4.30: E_F,G -+ 1.2 Omega E_F,E for q = 4; Omega of fixed bases is M_Rd / M_Ed there, at most q."""
    base, acting = found.foundations, found.effects
    assert base.combinations == ("G + 0.3 Q + E_x + 0.3 E_y", "G + 0.3 Q + E_y + 0.3 E_x")
    G = base.static[0] + 0.3 * base.static[1]
    alternating = base.factor[0][:, None] * base.seismic[0] + 0.3 * base.factor[1][:, None] * base.seismic[1]
    np.testing.assert_allclose(base.largest[0], G + alternating, rtol=1e-12, atol=1e-6)
    np.testing.assert_allclose(base.least[0], G - alternating, rtol=1e-12, atol=1e-6)
    column, section = number_of(found.frame, "C_A1_1"), steel_section("HEB300")
    ratios = []
    for part, W in ((4, section.W_pl_y), (5, section.W_pl_z)):  # n is too small to reduce the resistance
        M = max(
            abs(acting.of_static(row)[column, 0, part]) + acting.of_seismic(row)[column, 0, part]
            for row in found.combinations
            if row.set == "seismic" and max(map(abs, row.seismic)) == 1.0
        )
        ratios.append(W * FY / M)
    assert base.factor[0, 0] == pytest.approx(1.2 * min(max(min(ratios), 1.0), 4.0), rel=1e-9)


def test_the_table_of_foundations_says_which_factor_each_support_has(tmp_path: Path) -> None:
    """`*` where Omega is that of the hinge at the column base; pinned bases have that of the direction."""
    file = tmp_path / "frame.yaml"
    pinned = ("supports: fixed", "supports: {default: fixed, B: pinned}")
    file.write_text(changed(FRAME, pinned), encoding="utf-8")
    path, design = run_building(load_building(file))
    with open_archive(path) as archive:
        table = foundation_table(BuildingResults(archive))
        summary = foundation_summary(archive.group("building/foundations"))
    base = design.foundations
    assert base.of_base.tolist() == [[node[0] != "B" for node in base.nodes]] * 2
    of_frame = foundation_factor(design.overstrength["x"].Omega, 4.0)
    np.testing.assert_allclose(base.factor[0][~base.of_base[0]], of_frame, rtol=1e-12)
    for k, row in enumerate(table.texts):
        for axis, name in enumerate("xy"):
            mark = "*" if base.of_base[axis, k] else ""
            assert row[table.headers.index(f"f_{name}")] == significant(base.factor[axis, k], 3) + mark
            assert summary[k][f"Omega_of_foot_{name}"] is bool(base.of_base[axis, k])
    assert sum(note.startswith("*: Omega of the hinge at the column base") for note in table.notes) == 1


def test_supports_of_a_braced_frame() -> None:
    """Diagonals in tension alone: the column bases of one frame take M / L of the overturning moment, whatever the
    sense.

    All beams along y and all column bases are hinged, so that columns carry no moment to the ground (1e-9).
    """
    found = design_of(braced_frames(storeys="4 m, 3 m") + NO_TORSION, PINNED, OWN_WEIGHT)
    mode = int(found.modes.effective_mass_ratio[:, 1].argmax())
    of = supports(found.frame, bracing(found.frame))
    ends, one = found.modes.end_forces[[mode]], np.ones((1, 1))
    R = of.combined(bracing(found.frame), of.modal(ends), ends[:, :, 6], one)
    inertia = found.modes.omega[mode] ** 2 * found.frame.node_mass * found.modes.displacements[mode, :, 1]
    overturning = abs((inertia * found.frame.coordinates[:, 2]).sum())
    np.testing.assert_allclose(R[:, 2], 0.5 * overturning / 8.0, rtol=1e-9)
    assert R[:, 1].max() == pytest.approx(0.5 * abs(inertia.sum()), rel=0.02)  # the rest is shear of columns
