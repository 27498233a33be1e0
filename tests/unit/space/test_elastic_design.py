"""Elastic design of small buildings whose answers are known by hand or by symmetry."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from building_examples import DAMPED, NO_TORSION, PINNED, SMALL, braced_frames, design_of, moment_frames, number_of

from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.codes.ec3 import lateral_torsional
from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.report.archive.document import page_text
from edesign.space.structure.model import space_model

TABLE = moment_frames() + NO_TORSION
BRACED = braced_frames() + NO_TORSION


def test_base_shear_and_theta_of_one_storey() -> None:
    """One mode a direction: V = m S_d(T), and theta = q P / (K h) whatever the spectrum, K = m (2 pi / T)2 (1e-9)."""
    found = design_of(TABLE, ("medium", "medium\n  second_order: none\n  displacement: q_times_d_e"))
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


def test_effects_grow_with_theta() -> None:
    """1/(1 - theta) above 0.1 (EN 1998-1, 4.4.2.2(3)); a soft table has theta between 0.1 and 0.2."""
    soft = TABLE.replace("HEB300", "HEB160").replace("IPE400", "IPE240")
    with_it, without = design_of(soft), design_of(soft + "  second_order: none\n")
    theta = float(with_it.storeys["x"].theta[0])
    assert 0.1 < theta < 0.3
    np.testing.assert_allclose(with_it.effects.seismic[0] * (1.0 - theta), without.effects.seismic[0], atol=1e-6)


def test_accidental_torsion_of_a_symmetric_table() -> None:
    """M_a = 0.05 L F turns the floor by M_a / K_rz: the frames at distance b take M_a K_i b / K_rz more (1e-6).

    K_rz is that of the four frames: their in-plane stiffness times the square of the distance from the centre; columns
    do not resist twisting much (0.2 %).
    """
    plain, twisted = design_of(TABLE), design_of(moment_frames())
    assert (twisted.response["x"].internal >= plain.response["x"].internal - 1e-9).all()
    mass = plain.frame.node_mass.sum()
    K = [mass * plain.modes.omega[plain.modes.effective_mass_ratio[:, n].argmax()] ** 2 for n in (0, 1)]
    K_rz = K[0] * 4.0**2 + K[1] * 3.0**2
    T_1 = plain.modes.period[plain.modes.effective_mass_ratio[:, 0].argmax()]
    F_b = 2.5 * 1.2 * 2.5 / 4.0 * min(1.0, 0.5 / T_1) * mass  # one storey: lambda = 1; ground B, q = 4
    assert plain.response["x"].F_b == pytest.approx(F_b, rel=1e-9)
    expected = 0.05 * 8.0 * F_b / K_rz * 4.0  # displacement of the frames along x at y = -4 and 4 m
    extra = twisted.response["x"].drift[0] - plain.response["x"].drift[0]
    assert extra == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("diaphragms", ["all", "[1, 3]"])
def test_accidental_torsion_goes_by_the_lateral_force_method(diaphragms: str) -> None:
    """EN 1998-1, 4.3.3.3.3(1): M_ai = e_ai F_i with F_i of 4.3.3.2.3, by hand; lambda is 1.0 along x, 0.85 along y.

    Masses 5 kN/m2 + 0.3 2 kN/m2 on 6 m by 8 m, storeys of 4, 3 and 3.5 m, ground B, q = 4. The effects of the moments
    are those of a static case of them (1e-6). A floor that is not rigid has its force, and no moment.
    """
    storeys = {"storeys": "4 m, 3 m, 3.5 m", "braces": "kind: cross, section: SHS140x6"}
    text = braced_frames(**storeys).replace("HEB300", "HEB220").replace("IPE400", "IPE270") + (
        "" if diaphragms == "all" else f"diaphragms: {diaphragms}\n"
    )
    plain, twisted = design_of(text, ("  systems", "  accidental_torsion: none\n  systems")), design_of(text)
    frame, mass, z = plain.frame, 48.0 * 5.6e3 / 9.80665, np.array([4.0, 7.0, 10.5])
    model = space_model(frame, plain.building.materials)
    for axis, direction, across, factor in (("x", 0, 8.0, 1.0), ("y", 1, 6.0, 0.85)):
        of, without = twisted.response[axis], plain.response[axis]  # type: ignore[index]
        T_1 = plain.modes.period[plain.modes.effective_mass_ratio[:, direction].argmax()]
        assert (T_1 <= 2.0 * 0.5) == (factor == 0.85) and T_1 > 0.15
        S_d = 2.5 * 1.2 * 2.5 / 4.0 * min(1.0, 0.5 / T_1)
        F_b = S_d * 3.0 * mass * factor
        assert S_d > 0.2 * 2.5  # the lower bound does not govern
        assert of.F_b == pytest.approx(F_b, rel=1e-9) and abs(of.F_b / of.base_shear - 1.0) > 0.02
        moments = 0.05 * across * F_b * z / z.sum()
        nodal = np.zeros((1, len(frame.node_names), 6))
        for floor, moment in enumerate(moments, start=1):
            if diaphragms == "all" or floor != 2:
                nodal[0, frame.node_names.index(f"A1.{floor}"), 5] = moment
        end_forces = model.static(nodal).end_forces
        columns = frame.columns
        extra = (of.internal - without.internal)[columns, 0, 4:]
        np.testing.assert_allclose(extra, np.abs(end_forces[0, columns, 4:6]), rtol=1e-6, atol=1.0)


def test_a_turned_table_gives_turned_results() -> None:
    """x and y are exchanged in the file; everything else follows (1e-9)."""
    text = moment_frames(x="8 m", y="6 m") + NO_TORSION
    one, other = design_of(TABLE), design_of(text, ("strong: x", "strong: y"), ("spans: y", "spans: x"))
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


def test_omega_and_joints_by_hand() -> None:
    """Omega = M_pl / (M_G + M_E) at the worse end; two columns, one above the other, and one beam a direction."""
    found = design_of(moment_frames(storeys="4 m, 4 m") + NO_TORSION)
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


def test_columns_are_checked_with_amplified_effects() -> None:
    """1.1 gamma_ov Omega in class medium; without it in class low, where the seismic combinations count."""
    medium = design_of(TABLE)
    factor = min(1.1 * 1.25 * max(medium.overstrength["x"].Omega, 1.0), 4.0)  # no more than the elastic spectrum
    amplified = [row for row in medium.combinations if row.name.startswith(f"G + 0.3 Q + {factor:.3g} E_x")]
    assert amplified and amplified[0].seismic[0] == pytest.approx(factor)
    low = design_of(TABLE.replace("medium", "low").replace("q: 4", "q: 1.5"))
    assert all(max(map(abs, row.seismic)) <= 1.0 for row in low.combinations)
    assert not [rule for rule in low.criteria if rule.clause == "4.4.2.3(4)"]
    column = next(n for n, member in enumerate(low.frame.members) if member.kind == "column")
    governing = low.members.rows[int(low.members.combination[column].max()) - 1]
    assert governing.set == "seismic"


def test_the_design_is_that_without_dampers() -> None:
    """Beams that dampers would meet in the middle are whole in it."""
    bare, damped = design_of(SMALL), design_of(DAMPED)
    assert damped.criteria == bare.criteria and np.array_equal(damped.modes.period, bare.modes.period)
    assert [member.name for member in damped.frame.members] == [member.name for member in bare.frame.members]
    assert set(damped.notes) - set(bare.notes) == {"the elastic design is that of the building without its dampers"}


def test_squares_of_directions() -> None:
    """SRSS of the directions lies between the larger one and their sum (EN 1998-1, 4.3.3.5.1(2))."""
    squares = design_of(TABLE + "  directions: srss\n")
    row = next(row for row in squares.combinations if row.directions == "srss")
    x, y = np.abs(squares.effects.seismic)
    total = squares.effects.of_seismic(row)
    np.testing.assert_allclose(total, np.sqrt(x**2 + y**2), atol=1e-9)
    assert np.isfinite(squares.members.utilisation).any()


def test_a_pair_of_tension_diagonals_is_as_stiff_as_one() -> None:
    """A cross of which one diagonal acts: K = E A cos2 / L of one diagonal a frame; its force is V / cos (1e-6)."""
    found = design_of(BRACED, PINNED, ("kind: cross", "kind: cross, compression: false"))
    length = np.hypot(8.0, 4.0)
    K = 2.0 * 210e9 * steel_section("SHS100x6").A * (8.0 / length) ** 2 / length
    mode = int(found.modes.effective_mass_ratio[:, 1].argmax())
    mass = found.frame.node_mass.sum()
    assert mass * found.modes.omega[mode] ** 2 == pytest.approx(K, rel=0.05)  # columns shorten, beams bend with them
    brace = next(n for n, member in enumerate(found.frame.members) if member.kind == "brace")
    V = found.response["y"].base_shear
    assert found.effects.seismic[1, brace, 0, 0] == pytest.approx(0.5 * V / (8.0 / length), rel=0.01)


def test_sections_of_class_4_are_refused_by_name() -> None:
    with pytest.raises(InputError, match="C_A1_1: CHS508x5.*E-EC3-03"):
        design_of(TABLE, ("HEB300", "CHS508x5"))


def test_what_the_commands_say(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "table.yaml"
    path.write_text(TABLE, encoding="utf-8")
    assert main(["run", str(path)]) == 0
    shown = capsys.readouterr().out
    assert "Verdict" in shown and f": edesign show {tmp_path / 'table.h5'} --all" in " ".join(shown.split())
    assert main(["show", str(tmp_path / "table.h5"), "--all"]) == 0
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
    reported = json.loads(capsys.readouterr().out)["building"]
    assert {item["group"] for item in reported["groups"]} == {"C", "BX", "BY"} and len(reported["modes"]) == 3
    with open_archive(tmp_path / "table.h5") as archive:
        assert archive.attributes["kind"] == "building"
        page = page_text(archive)
    assert "Design report" in page and "figure-elevation_X1" in page and "could not be shown" not in page
    assert main(["run", str(path), "--only", "x"]) == 2
    assert "this building has none" in capsys.readouterr().err


def test_check_ends_with_3_where_a_rule_is_not_met(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "table.yaml"
    path.write_text(TABLE.replace("IPE400", "IPE160"), encoding="utf-8")
    assert main(["run", str(path), "--quiet"]) == 0
    assert main(["run", str(path), "--quiet", "--check"]) == 3
    assert "not all checks are met" in capsys.readouterr().err


def test_braces_carry_no_gravity() -> None:
    """EN 1998-1, 6.7.2(1)P: each of four columns carries a quarter of G, 60 kN.

    Braces have a thousandth of their area in the model for gravity, so their part is below 1e-4 of the load.
    """
    found = design_of(BRACED)
    G = found.effects.static[found.effects.cases.index("G")]
    for n, member in enumerate(found.frame.members):
        if member.kind == "column":
            assert G[n, 0, 0] == pytest.approx(-60e3, rel=2e-4)
        elif member.kind == "brace":
            assert np.abs(G[n, :, 0]).max() < 1e-4 * 240e3


def test_the_elastic_cap_keeps_accidental_torsion() -> None:
    """On the plateau S_e = q S_d, so q d_e is the elastic drift, with the part of torsion too (4.3.4(3); 1e-9)."""
    slight = ("SHS100x6", "SHS60x4")
    found = design_of(braced_frames(), slight)
    along_y = found.modes.effective_mass_ratio[:, 1] > 1e-9
    assert ((found.modes.period[along_y] > 0.15) & (found.modes.period[along_y] < 0.5)).all()  # T_B and T_C of ground B
    of, table = found.response["y"], found.storeys["y"]
    assert of.drift[0] > design_of(BRACED, slight).response["y"].drift[0] * 1.01
    assert of.drift_elastic[0] == pytest.approx(4.0 * of.drift[0], rel=1e-9)
    assert table.drift[0] == pytest.approx(table.drift_q[0], rel=1e-9)


def test_the_amplified_effect_is_at_most_the_elastic_one() -> None:
    found = design_of(TABLE)
    assert 1.1 * 1.25 * found.overstrength["x"].Omega > 4.0
    assert max(abs(row.seismic[0]) for row in found.combinations) == pytest.approx(4.0)


def test_the_least_slenderness_of_crosses() -> None:
    """EN 1998-1, 6.7.3(1): above 1.3 in frames of more than two storeys; 8.9 m of SHS250x10 have 1.05."""
    stocky = braced_frames(storeys="4 m, 4 m, 4 m", braces="kind: cross, section: SHS250x10")
    rules = [rule for rule in design_of(stocky).criteria if rule.clause == "6.7.3(1)"]
    assert [rule.passed for rule in rules] == [False] and rules[0].value == pytest.approx(1.05, abs=0.01)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (BRACED.replace("kind: cross", "kind: chevron"), "there are braces of kind `chevron` along y"),
        (BRACED.replace("concentric_diagonal", "concentric_v"), "no brace along y is a `chevron` or `v`"),
        (TABLE.replace("Q: 2 kN", "Q: -2 kN"), "a variable load acts downwards"),
        (TABLE.replace("ends: rigid, group: BX", "ends: pinned, group: BX"), "nothing resists along x|E-SPACE-03"),
        (TABLE + "  modes: 99\n", "99 modes, .* 3 .E-SPACE-02"),
        (TABLE + "  modes: 1\n", "first 1 modes .*E-SPACE-02"),
    ],
)
def test_what_is_refused(text: str, says: str) -> None:
    with pytest.raises(InputError, match=says):
        design_of(text)


def test_beams_without_a_slab_buckle_by_their_diagram() -> None:
    """A beam of 6 m, 20 and 8 kN/m on its top flange: C1 of its moments, C2 of a uniform load, by hand.

    The quarter points lie in the middle between two sixths: a parabola of static moments, a line of responses.
    """
    free = design_of(TABLE + "  members: {lateral_restraint: {beams: ends}}\n")
    number = number_of(free.frame, "BX_1_1_1")
    s, E, L = steel_section("IPE400"), 210e9, 6.0
    G, worst = E / 2.6, 0.0
    for row in free.members.rows[: sum(free.members.counts[:2])]:  # a beam that dissipates: persistent, seismic
        steady, alternating = free.effects.of_static(row)[number, :, 4], free.effects.of_seismic(row)[number, :, 4]
        size = np.abs(steady) + alternating
        quarters = [
            abs(3.0 * steady[a] + 6.0 * steady[b] - steady[3]) / 8.0 + 0.5 * (alternating[a] + alternating[b])
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


def test_annex_a_changes_the_interaction_alone() -> None:
    """C_mi,0 of a uniform moment without compression is 1 of it, where Annex B has 0.9 for sway; k differ, not N_b."""
    b, a = (design_of(TABLE + f"  members: {{interaction: annex_{of}}}\n").members for of in "ba")
    interaction = [name.startswith("EQ_6_6") for name in b.checks]
    np.testing.assert_array_equal(a.utilisation[:, ~np.array(interaction)], b.utilisation[:, ~np.array(interaction)])
    one, other = a.utilisation[:, interaction], b.utilisation[:, interaction]
    assert (np.abs(one / other - 1.0) > 1e-3).any() and (np.abs(one / other - 1.0) < 0.25).all()


def test_psi_2_is_that_of_the_category() -> None:
    """EN 1990, Table A1.1: 0.3 for offices, 0.8 for stores."""
    for category, psi_2 in (("B", 0.3), ("E", 0.8)):
        found = design_of(TABLE, (", Q: 0.3}", "}"), ("category: B", f"category: {category}"))
        assert found.frame.node_mass.sum() == pytest.approx(48.0 * (5.0 + 2.0 * psi_2) * 1e3 / 9.80665)
        assert any(row.name.startswith(f"G + {psi_2} Q") for row in found.combinations)


def test_persistent_combinations_are_those_that_the_file_asks_for() -> None:
    """6.10a: 1.35 G + 1.5 x 0.7 Q; 6.10b: 0.85 x 1.35 G + 1.5 Q (EN 1990, Table A1.2(B)); favourable: G alone too."""

    def names(keys: str) -> list[str]:
        found = design_of(TABLE + keys)
        return [of.name for of in found.combinations if of.set == "fundamental" and "S_" not in of.name]

    assert names("") == names("  fundamental: {expression: 6.10}\n") == ["1.35 G + 1.5 Q"]
    assert names("  fundamental: {expression: 6.10a/b}\n") == ["1.35 G + 1.05 Q", "1.1475 G + 1.5 Q"]
    assert sorted(names("  fundamental: {favourable: true}\n")) == ["1.35 G", "1.35 G + 1.5 Q", "G", "G + 1.5 Q"]


def test_shifted_masses_twist_a_symmetric_storey_as_the_closed_form_says() -> None:
    """A storey on four equal columns, its mass e beside their centre (Chopra, Dynamics of Structures, 9.5).

    omega^2 / omega_x^2 = (1 + Om^2 + (e/rho)^2 -+ sqrt((1 + Om^2 + (e/rho)^2)^2 - 4 Om^2)) / 2 with Om^2 the stiffness
    about the centre of the columns over K_x rho^2, rho of the mass about its own centre.
    """
    found = design_of(TABLE)
    model = space_model(found.frame, found.building.materials)
    by_floor = found.modes.floor_shapes[:, 0]
    along_x, turning = (int(np.abs(by_floor[:, k]).argmax()) for k in (0, 2))
    Om2 = (found.modes.omega[turning] / found.modes.omega[along_x]) ** 2
    rho2 = 3.0**2 + 4.0**2  # masses in the corners of 6 m x 8 m
    e = 0.4
    shift = np.where(found.frame.node_diaphragm[:, None] >= 0, [0.0, e], 0.0)
    shifted = model.modes(found.frame.node_mass, mass_shift=shift)
    total = 1.0 + Om2 + e**2 / rho2
    expected = 0.5 * (total + np.array([-1.0, 1.0]) * np.sqrt(total**2 - 4.0 * Om2))
    ratios = np.sort((shifted.omega / found.modes.omega[along_x]) ** 2)
    for value in expected:
        assert np.abs(ratios - value).min() < 1e-9 * value


def test_shifted_masses_load_both_sides_of_a_symmetric_building_alike_and_more() -> None:
    none, shifted = (design_of(text) for text in (TABLE, moment_frames() + "  torsion_by: shifted_masses\n"))
    for axis in ("x", "y"):
        of = shifted.response[axis]
        columns = of.internal[shifted.frame.columns]
        np.testing.assert_allclose(columns, np.broadcast_to(columns[:1], columns.shape), rtol=1e-9, atol=1e-6)
        assert of.base_shear <= none.response[axis].base_shear * (1.0 + 1e-12)  # some of the mass turns instead
        assert of.drift[0] > none.response[axis].drift[0]
    np.testing.assert_allclose(shifted.modes.period, none.modes.period, rtol=1e-12)
