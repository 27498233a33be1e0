"""Elastic design of small buildings whose answers are known by hand or by symmetry."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.reader import open_archive
from edesign.building.building_file import load_building
from edesign.building.steel_section import steel_section
from edesign.cli.main import main
from edesign.codes.ec3 import lateral_torsional
from edesign.errors import InputError
from edesign.report.page.document import page_text
from edesign.space.elastic_design import ElasticDesign, elastic_design
from edesign.space.structure.model import space_model

TABLE = """
edesign_building: 1
title: Table
plan: {x: [6 m], y: [8 m]}
storeys: [4 m]
columns:
  - {section: HEB300, material: S275, strong: x, group: C}
beams:
  - {along: x, section: IPE400, material: S275, ends: rigid, group: BX}
  - {along: y, section: IPE400, material: S275, ends: rigid, group: BY}
materials:
  S275: {fy: 275 MPa}
loads:
  areas:
    - {G: 5 kN/m^2, Q: 2 kN/m^2, category: B, spans: y}
  self_weight: false
masses: {from_loads: {G: 1.0, Q: 0.3}}
hazard: {code: ec8-2004, a_gR: 2.5 m/s^2, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}
design:
  ductility_class: medium
  systems:
    x: {type: moment_frame, q: 4}
    y: {type: moment_frame, q: 4}
  accidental_torsion: none
"""


def design_of(folder: Path, text: str = TABLE, **changes: str) -> ElasticDesign:
    """Design a building of a text in which some words are replaced."""
    return elastic_design(load_building(written(folder, text, **changes)))


def written(folder: Path, text: str = TABLE, **changes: str) -> Path:
    for old, new in changes.items():
        key = old.replace("__", " ")
        assert key in text
        text = text.replace(key, new)
    path = folder / "table.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def test_base_shear_and_theta_of_one_storey(tmp_path: Path) -> None:
    """One mode a direction: V = m S_d(T), and theta = q P / (K h) whatever the spectrum, K = m (2 pi / T)2 (1e-9)."""
    found = design_of(tmp_path, medium="medium\n  second_order: none\n  displacement: q_times_d_e")
    mass = found.frame.node_mass.sum()
    assert mass == pytest.approx(48.0 * 5.6e3 / 9.80665)
    for axis, number in (("x", 0), ("y", 1)):
        of = found.response[axis]  # type: ignore[index]
        mode = int(found.modes.effective_mass_ratio[:, number].argmax())
        period = found.modes.period[mode]
        assert of.base_shear == pytest.approx(mass * float(of.spectrum.acceleration(period)), rel=1e-9)
        K = mass * (2.0 * np.pi / period) ** 2
        table = found.storeys[axis]  # type: ignore[index]
        assert table.gravity[0] == pytest.approx(mass * 9.80665, rel=1e-9)
        assert table.theta_q[0] == pytest.approx(4.0 * table.gravity[0] / (K * 4.0), rel=1e-9)
        assert table.reduced[0] == pytest.approx(0.5 * 4.0 * of.base_shear / K / 4.0, rel=1e-9)


def test_effects_grow_with_theta(tmp_path: Path) -> None:
    """1/(1 - theta) above 0.1 (EN 1998-1, 4.4.2.2(3)); a soft table has theta between 0.1 and 0.2."""
    soft = {"HEB300": "HEB160", "IPE400": "IPE240"}
    with_it = design_of(tmp_path, **soft)
    without = design_of(tmp_path, **soft, medium="medium\n  second_order: none")
    theta = float(with_it.storeys["x"].theta[0])
    assert 0.1 < theta < 0.3
    np.testing.assert_allclose(with_it.effects.seismic[0] * (1.0 - theta), without.effects.seismic[0], atol=1e-6)


def test_accidental_torsion_of_a_symmetric_table(tmp_path: Path) -> None:
    """M_a = 0.05 L F turns the floor by M_a / K_rz: the frames at distance b take M_a K_i b / K_rz more (1e-6).

    K_rz is that of the four frames: their in-plane stiffness times the square of the distance from the centre; columns
    do not resist twisting much (0.2 %).
    """
    plain, twisted = design_of(tmp_path), design_of(tmp_path, none="5 %")
    assert (twisted.response["x"].internal >= plain.response["x"].internal - 1e-9).all()
    mass = plain.frame.node_mass.sum()
    K = [mass * plain.modes.omega[plain.modes.effective_mass_ratio[:, n].argmax()] ** 2 for n in (0, 1)]
    K_rz = K[0] * 4.0**2 + K[1] * 3.0**2
    V = plain.response["x"].base_shear
    expected = 0.05 * 8.0 * V / K_rz * 4.0  # displacement of the frames along x at y = -4 and 4 m
    extra = twisted.response["x"].drift[0] - plain.response["x"].drift[0]
    assert extra == pytest.approx(expected, rel=2e-3)


def test_a_turned_table_gives_turned_results(tmp_path: Path) -> None:
    """x and y are exchanged in the file; everything else follows (1e-9)."""
    turned = (
        TABLE.replace("plan: {x: [6 m], y: [8 m]}", "plan: {x: [8 m], y: [6 m]}")
        .replace("strong: x", "strong: y")
        .replace("spans: y", "spans: x")
    )
    one, other = design_of(tmp_path), design_of(tmp_path, turned)
    for axis, turned_axis in (("x", "y"), ("y", "x")):
        first, second = one.response[axis], other.response[turned_axis]  # type: ignore[index]
        assert first.base_shear == pytest.approx(second.base_shear, rel=1e-9)
        assert one.overstrength[axis].Omega == pytest.approx(other.overstrength[turned_axis].Omega, rel=1e-9)  # type: ignore[index]
    for kind in ("column", "beam"):
        most = [
            sorted(
                float(np.nanmax(of.members.utilisation[n]))
                for n, member in enumerate(of.frame.members)
                if member.kind == kind
            )
            for of in (one, other)
        ]
        np.testing.assert_allclose(*most, rtol=1e-9)


def test_omega_and_joints_by_hand(tmp_path: Path) -> None:
    """Omega = M_pl / (M_G + M_E) at the worse end; two columns, one above the other, and one beam a direction."""
    two = TABLE.replace("storeys: [4 m]", "storeys: [4 m, 4 m]")
    found = design_of(tmp_path, two)
    M_pl = steel_section("IPE400").W_pl_y * 275e6
    rows = [row for row in found.combinations if row.set == "seismic" and max(map(abs, row.seismic)) == 1.0]
    worst = 0.0
    for n, member in enumerate(found.frame.members):
        if member.kind == "beam" and member.frame[0].startswith("X"):
            for row in rows:
                M = np.abs(found.effects.of_static(row)[n, [0, -1], 4]) + found.effects.of_seismic(row)[n, [0, -1], 4]
                worst = max(worst, float(M.max()))
    assert found.overstrength["x"].Omega == pytest.approx(M_pl / worst, rel=1e-12)
    asked = [joint for joint in found.joints if joint.axis == "x" and not joint.exempt]
    assert len(asked) == 4  # the first floor; the roof is exempt
    M_c = steel_section("HEB300").W_pl_y * 275e6
    for joint in asked:  # n is below 0.1: (1 - n) / (1 - 0.5 a) is above 1
        assert joint.M_Rb == pytest.approx(M_pl) and joint.M_Rc == pytest.approx(2.0 * M_c)


def test_columns_are_checked_with_amplified_effects(tmp_path: Path) -> None:
    """1.1 gamma_ov Omega in class medium; without it in class low, where the seismic combinations count."""
    medium = design_of(tmp_path)
    factor = min(1.1 * 1.25 * max(medium.overstrength["x"].Omega, 1.0), 4.0)  # no more than the elastic spectrum
    amplified = [row for row in medium.combinations if row.name.startswith(f"G + 0.3 Q + {factor:.3g} E_x")]
    assert amplified and amplified[0].seismic[0] == pytest.approx(factor)
    low = design_of(tmp_path, **{"medium": "low", "q: 4": "q: 1.5"})
    assert all(max(map(abs, row.seismic)) <= 1.0 for row in low.combinations)
    assert not [rule for rule in low.criteria if rule.clause == "4.4.2.3(4)"]
    column = next(n for n, member in enumerate(low.frame.members) if member.kind == "column")
    governing = low.members.rows[int(low.members.combination[column].max()) - 1]
    assert governing.set == "seismic"


def test_squares_of_directions(tmp_path: Path) -> None:
    """SRSS of the directions lies between the larger one and their sum (EN 1998-1, 4.3.3.5.1(2))."""
    squares = design_of(tmp_path, medium="medium\n  directions: srss")
    row = next(row for row in squares.combinations if row.directions == "srss")
    x, y = np.abs(squares.effects.seismic)
    total = squares.effects.of_seismic(row)
    np.testing.assert_allclose(total, np.sqrt(x**2 + y**2), atol=1e-9)
    assert np.isfinite(squares.members.utilisation).any()


def test_a_pair_of_tension_diagonals_is_as_stiff_as_one(tmp_path: Path) -> None:
    """A cross of which one diagonal acts: K = E A cos2 / L of one diagonal a frame; its force is V / cos (1e-6)."""
    braced = (
        TABLE.replace("ends: rigid, group: BY", "ends: pinned, group: BY")
        .replace("y: {type: moment_frame, q: 4}", "y: {type: concentric_diagonal, q: 4}")
        .replace(
            "materials:\n",
            "braces:\n"
            "  - {along: y, frames: all, bays: all, kind: cross, section: SHS100x6, material: S275,\n"
            "     compression: false}\n"
            "materials:\n",
        )
        .replace("columns:\n", "supports: pinned\ncolumns:\n")
    )
    found = design_of(tmp_path, braced)
    length = np.hypot(8.0, 4.0)
    K = 2.0 * 210e9 * steel_section("SHS100x6").A * (8.0 / length) ** 2 / length
    mode = int(found.modes.effective_mass_ratio[:, 1].argmax())
    mass = found.frame.node_mass.sum()
    assert mass * found.modes.omega[mode] ** 2 == pytest.approx(K, rel=0.05)  # columns shorten, beams bend with them
    brace = next(n for n, member in enumerate(found.frame.members) if member.kind == "brace")
    V = found.response["y"].base_shear
    assert found.effects.seismic[1, brace, 0, 0] == pytest.approx(0.5 * V / (8.0 / length), rel=0.01)


def test_sections_of_class_4_are_refused_by_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"C_A1_1: CHS508x5.* is of class 4 under its forces"):
        design_of(tmp_path, HEB300="CHS508x5")


def test_what_the_commands_say(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path)
    assert main(["run", str(path)]) == 0
    shown = capsys.readouterr().out
    for title in (
        "Natural modes",
        "Seismic action",
        "Storeys, direction x",
        "Rules for the building",
        "Combinations",
        "Verdict",
    ):
        assert title in shown
    assert main(["show", str(tmp_path / "table.h5"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["building"]
    assert {item["group"] for item in told["groups"]} == {"C", "BX", "BY"} and len(told["modes"]) == 3
    with open_archive(tmp_path / "table.h5") as archive:
        assert archive.attributes["kind"] == "building"
        page = page_text(archive)
    assert "Design report" in page and "figure-elevation_X1" in page and "could not be shown" not in page
    assert main(["run", str(path), "--only", "x"]) == 2
    assert "not for a building" in capsys.readouterr().err


def test_check_ends_with_3_where_a_rule_is_not_met(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path, IPE400="IPE160")
    assert main(["run", str(path), "--quiet"]) == 0
    assert main(["run", str(path), "--quiet", "--check"]) == 3
    assert "not all checks are met" in capsys.readouterr().err


BRACED = (
    TABLE.replace("ends: rigid, group: BY", "ends: pinned, group: BY")
    .replace("y: {type: moment_frame, q: 4}", "y: {type: concentric_diagonal, q: 4}")
    .replace(
        "materials:\n",
        "braces:\n  - {along: y, frames: all, bays: all, kind: cross, section: SHS100x6, material: S275}\nmaterials:\n",
    )
)


def test_braces_carry_no_gravity(tmp_path: Path) -> None:
    """EN 1998-1, 6.7.2(1)P: each of four columns carries a quarter of G, 60 kN.

    Braces have a thousandth of their area in the model for gravity, so their part is below 1e-4 of the load.
    """
    found = design_of(tmp_path, BRACED)
    G = found.effects.static[found.effects.cases.index("G")]
    for n, member in enumerate(found.frame.members):
        if member.kind == "column":
            assert G[n, 0, 0] == pytest.approx(-60e3, rel=2e-4)
        elif member.kind == "brace":
            assert np.abs(G[n, :, 0]).max() < 1e-4 * 240e3


def test_the_elastic_cap_keeps_accidental_torsion(tmp_path: Path) -> None:
    """On the plateau S_e = q S_d, so q d_e is the elastic drift, with the part of torsion too (4.3.4(3); 1e-9)."""
    slight = BRACED.replace("SHS100x6", "SHS60x4")
    found = design_of(tmp_path, slight, none="5 %")
    along_y = found.modes.effective_mass_ratio[:, 1] > 1e-9
    assert ((found.modes.period[along_y] > 0.15) & (found.modes.period[along_y] < 0.5)).all()  # T_B and T_C of ground B
    of, table = found.response["y"], found.storeys["y"]
    assert of.drift[0] > design_of(tmp_path, slight).response["y"].drift[0] * 1.01
    assert of.drift_elastic[0] == pytest.approx(4.0 * of.drift[0], rel=1e-9)
    assert table.drift[0] == pytest.approx(table.drift_q[0], rel=1e-9)


def test_the_amplified_effect_is_at_most_the_elastic_one(tmp_path: Path) -> None:
    found = design_of(tmp_path)
    assert 1.1 * 1.25 * found.overstrength["x"].Omega > 4.0
    assert max(abs(row.seismic[0]) for row in found.combinations) == pytest.approx(4.0)


def test_the_least_slenderness_of_crosses(tmp_path: Path) -> None:
    """EN 1998-1, 6.7.3(1): above 1.3 in frames of more than two storeys; 8.9 m of SHS250x10 have 1.05."""
    stocky = BRACED.replace("storeys: [4 m]", "storeys: {count: 3, height: 4 m}").replace("SHS100x6", "SHS250x10")
    rules = [rule for rule in design_of(tmp_path, stocky).criteria if rule.clause == "6.7.3(1)"]
    assert [rule.passed for rule in rules] == [False] and rules[0].value == pytest.approx(1.05, abs=0.01)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (BRACED.replace("kind: cross", "kind: chevron"), "there are braces of kind `chevron` along y"),
        (BRACED.replace("concentric_diagonal", "concentric_v"), "no brace along y is a `chevron` or `v`"),
        (TABLE.replace("Q: 2 kN", "Q: -2 kN"), "a variable load acts downwards"),
        (TABLE.replace("ends: rigid, group: BX", "ends: pinned, group: BX"), "nothing resists along x|has a stiff end"),
        (TABLE + "  modes: 99\n", "99 modes, the building has 3"),
        (TABLE + "  modes: 1\n", "the first 1 modes have"),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, says: str) -> None:
    with pytest.raises(InputError, match=says):
        design_of(tmp_path, text)


def test_beams_without_a_slab_buckle_by_their_diagram(tmp_path: Path) -> None:
    """A beam of 6 m, 20 and 8 kN/m on its top flange: C1 of its moments, C2 of a uniform load, by hand.

    The quarter points lie in the middle between two sixths: a parabola of static moments, a line of responses.
    """
    free = design_of(tmp_path, TABLE + "  members: {lateral_restraint: {beams: ends}}\n")
    number = [member.name for member in free.frame.members].index("BX_1_1_1")
    s, E, L = steel_section("IPE400"), 210e9, 6.0
    G, worst = E / 2.6, 0.0
    for row in free.members.rows[: sum(free.members.counts[:2])]:  # a beam that dissipates: persistent, seismic
        steady, swing = free.effects.of_static(row)[number, :, 4], free.effects.of_seismic(row)[number, :, 4]
        size = np.abs(steady) + swing
        quarters = [
            abs(3.0 * steady[a] + 6.0 * steady[b] - steady[3]) / 8.0 + 0.5 * (swing[a] + swing[b])
            for a, b in ((1, 2), (5, 4))
        ]
        C1 = lateral_torsional.diagram_factor(size.max(), quarters[0], size[3], quarters[1])
        w = 20e3 * row.static["G"] + 8e3 * row.static["Q"]
        C2 = C1 * w * L**2 / (2.0 * np.pi**2 * size.max())
        M_cr = lateral_torsional.critical_moment(E, G, s.I_z, s.I_t, s.I_w, L, C1, C2, 0.2)
        slenderness = lateral_torsional.slenderness(s.W_pl_y, 275e6, M_cr)
        chi = lateral_torsional.reduction_factor(slenderness, lateral_torsional.rolled_curve(s.h, s.b))
        k_c = lateral_torsional.correction_of_factor(C1)
        M_b = lateral_torsional.modified_reduction_factor(chi, slenderness, k_c) * s.W_pl_y * 275e6
        worst = max(worst, float(size.max() / M_b))
    assert free.members.utilisation[number, free.members.checks.index("M_B")] == pytest.approx(worst, rel=1e-9)


def test_annex_a_changes_the_interaction_alone(tmp_path: Path) -> None:
    """C_mi,0 of a uniform moment without compression is 1 of it, where Annex B has 0.9 for sway; k differ, not N_b."""
    b, a = (design_of(tmp_path, TABLE + f"  members: {{interaction: annex_{of}}}\n").members for of in "ba")
    interaction = [name.startswith("EQ_6_6") for name in b.checks]
    np.testing.assert_array_equal(a.utilisation[:, ~np.array(interaction)], b.utilisation[:, ~np.array(interaction)])
    one, other = a.utilisation[:, interaction], b.utilisation[:, interaction]
    assert (np.abs(one / other - 1.0) > 1e-3).any() and (np.abs(one / other - 1.0) < 0.25).all()


def test_psi_2_is_that_of_the_category(tmp_path: Path) -> None:
    """EN 1990, Table A1.1: 0.3 for offices, 0.8 for stores."""
    plain = TABLE.replace("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 1.0}")
    for category, psi_2 in (("B", 0.3), ("E", 0.8)):
        found = design_of(tmp_path, plain.replace("category: B", f"category: {category}"))
        assert found.frame.node_mass.sum() == pytest.approx(48.0 * (5.0 + 2.0 * psi_2) * 1e3 / 9.80665)
        assert any(row.name.startswith(f"G + {psi_2} Q") for row in found.combinations)


def test_persistent_combinations_are_those_that_the_file_asks_for(tmp_path: Path) -> None:
    """6.10a: 1.35 G + 1.5 x 0.7 Q; 6.10b: 0.85 x 1.35 G + 1.5 Q (EN 1990, Table A1.2(B)); favourable: G alone too."""

    def names(keys: str) -> list[str]:
        found = design_of(tmp_path, TABLE.replace("design:\n", f"design:\n{keys}"))
        return [of.name for of in found.combinations if of.set == "fundamental" and "S_" not in of.name]

    assert names("") == names("  fundamental: {expression: 6.10}\n") == ["1.35 G + 1.5 Q"]
    assert names("  fundamental: {expression: 6.10a/b}\n") == ["1.35 G + 1.05 Q", "1.1475 G + 1.5 Q"]
    assert sorted(names("  fundamental: {favourable: true}\n")) == ["1.35 G", "1.35 G + 1.5 Q", "G", "G + 1.5 Q"]


def test_shifted_masses_twist_a_symmetric_storey_as_the_closed_form_says(tmp_path: Path) -> None:
    """A storey on four equal columns, its mass e beside their centre (Chopra, Dynamics of Structures, 9.5).

    omega^2 / omega_x^2 = (1 + Om^2 + (e/rho)^2 -+ sqrt((1 + Om^2 + (e/rho)^2)^2 - 4 Om^2)) / 2 with Om^2 the stiffness
    about the centre of the columns over K_x rho^2, rho of the mass about its own centre.
    """
    found = design_of(tmp_path, TABLE)
    model = space_model(found.frame, found.building.materials)
    by_floor = found.modes.floor_shapes[:, 0]
    along_x, turning = (int(np.abs(by_floor[:, k]).argmax()) for k in (0, 2))
    Om2 = (found.modes.omega[turning] / found.modes.omega[along_x]) ** 2
    rho2 = 3.0**2 + 4.0**2  # masses in the corners of 6 m x 8 m
    e = 0.4
    shift = np.where(found.frame.node_floor[:, None] >= 0, [0.0, e], 0.0)
    shifted = model.modes(found.frame.node_mass, mass_shift=shift)
    total = 1.0 + Om2 + e**2 / rho2
    expected = 0.5 * (total + np.array([-1.0, 1.0]) * np.sqrt(total**2 - 4.0 * Om2))
    ratios = np.sort((shifted.omega / found.modes.omega[along_x]) ** 2)
    for value in expected:
        assert np.abs(ratios - value).min() < 1e-9 * value


def test_shifted_masses_load_both_sides_of_a_symmetric_building_alike_and_more(tmp_path: Path) -> None:
    none, shifted = (
        design_of(tmp_path, TABLE.replace("accidental_torsion: none", f"accidental_torsion: {text}"))
        for text in ("none", "5 %\n  torsion_by: shifted_masses")
    )
    for axis in ("x", "y"):
        of = shifted.response[axis]
        columns = of.internal[shifted.frame.columns]
        np.testing.assert_allclose(columns, np.broadcast_to(columns[:1], columns.shape), rtol=1e-9, atol=1e-6)
        assert of.base_shear <= none.response[axis].base_shear * (1.0 + 1e-12)  # some of the mass turns instead
        assert of.drift[0] > none.response[axis].drift[0]
    np.testing.assert_allclose(shifted.modes.period, none.modes.period, rtol=1e-12)
