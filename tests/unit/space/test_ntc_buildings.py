"""Buildings by NTC 2018: equal to EN 1998-1 where numbers are equal, and by hand where they are not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import NO_TORSION, braced_frames, building, changed, design_of, moment_frames, number_of

from edesign.archive.reader import open_archive
from edesign.codes.ntc2018.displacement import displacement_ductility
from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.frame.sections.steel_section import steel_section
from edesign.report.building.facts import design_rows
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.all import building_tables
from edesign.study.run.building import run_building

_EC8 = "hazard: {code: ec8-2004, a_gR: 2.5 m/s^2, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}\n"
_DESIGN = "design:\n  ductility_class: medium\n"
G = 9.80665


def ntc(text: str, use: str = "II", ductility: str = "medium", **limit_states: str) -> str:
    """The building with the action of NTC 2018 on ground A: SLV of 2.5 m/s2, F_0 = 2.5, T_C* = 0.3 s."""
    states = {
        "SLO": "a_g: 0.6 m/s^2, F_0: 2.4, T_C_star: 0.25 s",
        "SLD": "a_g: 0.9 m/s^2, F_0: 2.4, T_C_star: 0.27 s",
        "SLV": "a_g: 2.5 m/s^2, F_0: 2.5, T_C_star: 0.3 s",
    } | limit_states
    levels = ", ".join(f"{name}: {{limit_state: {name}, {of}}}" for name, of in states.items() if of)
    hazard = (
        f"hazard: {{code: ntc-2018, nominal_life: 50 years, class_of_use: {use}, ground: A, levels: {{{levels}}}}}\n"
    )
    design = f"design:\n  code: {{seismic: ntc-2018}}\n  ductility_class: {ductility}\n"
    return changed(text, (_EC8, hazard), (_DESIGN, design))


def ec8_alike(text: str, ductility: str = "medium") -> str:
    """The same building and an action of 12 m/s2 by EN 1998-1, with the partial factors of NTC 2018."""
    T_D = 4.0 * 12.0 / G + 1.6
    spectrum = f"parameters: {{S: 1, F_0: 2.5, T_B: 0.05 s, T_C: 0.15 s, T_D: {T_D!r} s}}"
    hazard = _EC8.replace("ground: B, spectrum: 1", f"ground: A, spectrum: 1, {spectrum}").replace(
        "2.5 m/s^2", "12 m/s^2"
    )
    factors = "  partial_factors: {M0: 1.05, M1: 1.05, G: 1.3, Q: 1.5}\n  displacement: q_times_d_e\n"
    return changed(text, (_EC8, hazard), (_DESIGN, f"design:\n  ductility_class: {ductility}\n{factors}"))


LOW = ("q: 4}, y", "q: 1.5}, y"), ("q: 4}}", "q: 1.5}}")
FRAMES = moment_frames(x="6 m, 6 m", storeys="4 m, 3 m") + NO_TORSION
_CROSSES = "{along: y, frames: all, bays: all, kind: cross, section: SHS80x5, material: S275}"
BRACED = braced_frames(storeys="4 m, 3 m, 3.5 m", braces="kind: cross, section: SHS80x5") + NO_TORSION
BRACED_BOTH_WAYS = changed(
    BRACED,
    ("ends: rigid, group: BX", "ends: pinned, group: BX"),
    (f"  - {_CROSSES}\n", f"  - {_CROSSES}\n  - {_CROSSES.replace('along: y', 'along: x')}\n"),
    ("x: {type: moment_frame", "x: {type: concentric_diagonal"),
)


@pytest.mark.parametrize(("text", "ductility"), [(changed(FRAMES, *LOW), "low"), (BRACED_BOTH_WAYS, "medium")])
def test_same_action_and_factors_give_the_same_utilisations(text: str, ductility: str) -> None:
    """The spectra are equal beyond T_B = 0.05 s, below which NTC starts from a_g S and EC8 from 2/3 of it (1e-9).

    So is what follows from them: forces, theta, Omega = N_pl,Rd / N_Ed of diagonals, and all checks of members. The
    frames have Omega beside gravity by NTC, which counts in classes A and B alone.
    """
    text = text.replace("HEB300", "HEB200").replace("IPE400", "IPE300").replace("SHS80x5", "SHS40x4")
    short = "a_g: 12 m/s^2, F_0: 2.5, T_C_star: 0.15 s"
    one, other = design_of(ntc(text, ductility=ductility, SLV=short)), design_of(ec8_alike(text, ductility))
    assert one.modes.period.min() > 0.05
    if ductility != "low":  # the bound of 1.1 gamma_ov Omega, which differs, is far
        assert max(1.1 * 1.25 * one.overstrength[axis].Omega for axis in ("x", "y")) < 4.0 / 1.5  # type: ignore[index]
    np.testing.assert_allclose(one.members.utilisation, other.members.utilisation, rtol=1e-9)
    for axis in ("x", "y"):
        S_d = [found.response[axis].acceleration for found in (one, other)]  # type: ignore[index]
        np.testing.assert_allclose(*S_d, rtol=1e-12)
        np.testing.assert_allclose(one.storeys[axis].theta, other.storeys[axis].theta, rtol=1e-9)  # type: ignore[index]
    assert one.members.clauses[-1] == "NTC 2018, 7.5.4.2" and other.members.clauses[-1].startswith("EN 1998-1")


def test_drifts_under_damage_and_their_limit() -> None:
    """One storey, one mode a direction: q d_r = S_e,SLD(T) (T / 2 pi)2 with q = 1, over h = 4 m (1e-9).

    S_e = a_g F_0 T_C / T with T_C = T_C* on ground A; class of use III has SLO, and two thirds of the limit.
    """
    table = moment_frames().replace("HEB300", "HEB160").replace("IPE400", "IPE240") + NO_TORSION
    for use, a_g, T_C, limit in (("II", 0.9, 0.27, 0.0075), ("III", 0.6, 0.25, 0.005)):
        found = design_of(ntc(table, use))
        T = found.response["x"].T_1
        assert T > T_C
        expected = a_g * 2.4 * T_C / T * (T / (2.0 * np.pi)) ** 2 / 4.0
        assert found.storeys["x"].reduced[0] == pytest.approx(expected, rel=1e-9)
        assert found.storeys["x"].limit == pytest.approx(limit)


def test_theta_with_the_ductility_of_displacements() -> None:
    """d_E = mu_d d_Ee: a table with T_1 below T_C = 0.3 s has mu_d = 1 + (q - 1) T_C / T_1, above q, and so theta."""
    found = design_of(ntc(moment_frames() + NO_TORSION))
    of, table = found.response["x"], found.storeys["x"]
    mu = displacement_ductility(4.0, of.T_1, 0.3)
    assert mu == pytest.approx(1.0 + 3.0 * 0.3 / of.T_1) and mu > 4.0
    assert table.drift[0] == pytest.approx(mu * of.drift[0], rel=1e-12)
    assert table.theta[0] == pytest.approx(table.theta_q[0] * mu / 4.0, rel=1e-12)


def test_overstrength_of_beams_beside_gravity() -> None:
    """Omega = (M_pl,Rd - M_Ed,G) / M_Ed,E with G + 0.3 Q, the least of both ends of all beams (1e-12).

    1.1 gamma_ov Omega is at most q / q_ND: as if the building did not dissipate energy (7.2.2).
    """
    found = design_of(ntc(FRAMES))
    row = found.combinations[found.members.counts[0]]
    assert row.set == "seismic" and row.equation == "2.5.5"
    M_pl = steel_section("IPE400").W_pl_y * 275e6 / 1.05
    least = np.inf
    for name in ("BX_1_1_1", "BX_1_2_1", "BX_2_1_1", "BX_1_1_2"):
        number = number_of(found.frame, name)
        gravity = found.effects.of_static(row)[number, [0, -1], 4]
        seismic = found.effects.of_seismic(row)[number, [0, -1], 4]
        ratio = float(((M_pl - np.abs(gravity)) / seismic).min())
        place = found.overstrength["x"].members.tolist().index(number)
        assert found.overstrength["x"].ratios[place] <= ratio * (1.0 + 1e-12)
        least = min(least, ratio)
    assert found.overstrength["x"].Omega <= least
    raised = next(row for row in found.members.amplified if row.seismic[0] > abs(row.seismic[1]))
    assert raised.seismic[0] == pytest.approx(min(1.1 * 1.25 * found.overstrength["x"].Omega, 4.0 / 1.5))


def test_foundations_have_the_factor_of_the_class() -> None:
    """7.2.5: all that comes from above times 1.1 in class B and 1.3 in class A; gravity where that is worse."""
    for ductility, factor in (("medium", 1.1), ("high", 1.3)):
        found = design_of(ntc(FRAMES, ductility=ductility))
        of = found.foundations
        assert (of.factor == factor).all()
        steady = of.static[of.cases.index("G"), :, 2] + 0.3 * of.static[of.cases.index("Q"), :, 2]
        swing = factor * (of.seismic[0, :, 2] + 0.3 * of.seismic[1, :, 2])
        np.testing.assert_allclose(of.largest[0, :, 2], factor * steady + swing, rtol=1e-9)
        np.testing.assert_allclose(of.least[0, :, 2], steady - swing, rtol=1e-9, atol=1e-6)


def test_rules_of_columns_and_diagonals() -> None:
    """7.5.3: N_Ed / N_pl,Rd at hinged bases up to 0.3; 7.5.5: h / t - 3 of SHS80x5 is 13 of 18."""
    frames = {rule.reference: rule for rule in design_of(ntc(FRAMES)).criteria}
    assert frames["NTC 2018, 7.5.3.2"].required in (0.3, 2)
    axial = [rule for rule in design_of(ntc(FRAMES)).criteria if rule.text.startswith("N_Ed / N_pl,Rd")]
    assert [rule.required for rule in axial] == [0.3, 0.3]
    (wall,) = [rule for rule in design_of(ntc(BRACED)).criteria if rule.text.startswith("width over thickness")]
    assert wall.value == pytest.approx(13.0) and wall.required == 18.0 and wall.passed


def test_strength_under_damage_of_important_buildings() -> None:
    """C7.3.1 in class III: q' = q_ND S_e,SLV / S_e,SLD = 1.5 (2.5 2.5 0.3) / (0.9 2.4 0.27) at T_1; else it informs."""
    for use, asked in (("II", None), ("III", True)):
        rules = [rule for rule in design_of(ntc(FRAMES, use)).criteria if "C7.3.1" in rule.clause]
        assert [rule.passed for rule in rules] == [asked, asked]
        assert rules[0].required == pytest.approx(1.5 * 2.5 * 2.5 * 0.3 / (0.9 * 2.4 * 0.27), rel=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ntc(FRAMES, SLD=""), "no level is of SLD, by which NTC 2018, 7.3.6.1, looks at drifts in class of use II"),
        (ntc(FRAMES, "IV", SLO=""), "no level is of SLO"),
        (ntc(FRAMES) + "  displacement: q_times_d_e\n", "NTC 2018 leaves no such choice"),
        (ntc(FRAMES) + "  drift: {limit: ductile, nu: 0.5}\n", "NTC 2018 leaves no such choice"),
        (ntc(FRAMES) + "  directions: srss\n", "NTC 2018 leaves no such choice"),
        (ntc(FRAMES) + "  level: SLD\n", "is for SLV"),
        (ntc(FRAMES) + '  select: {leave_out: ["4.4.3.2(1)"]}\n', "no clause of the seismic code of this design"),
        (changed(ntc(FRAMES), ("seismic: ntc-2018", "seismic: ec8-2004")), "both are of one code"),
        (changed(ntc(FRAMES), ("Q: 0.3}}", "Q: 0.3}, phi: 0.8}")), "phi is of EN 1998-1"),
    ],
)
def test_what_ntc_does_not_know_is_refused(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        building(text)


def test_tables_name_the_code_in_use(tmp_path: Path) -> None:
    """Only what NTC 2018 has no figure for names EN 1998-1: e_0 / r, r / l_s and the symmetry of diagonals."""
    (tmp_path / "b.yaml").write_text(ntc(BRACED))
    run_building(load_building(tmp_path / "b.yaml"), tmp_path / "b.h5")
    with open_archive(tmp_path / "b.h5") as archive:
        results = BuildingResults(archive)
        tables = building_tables(archive)
        facts = dict(design_rows(load_building(tmp_path / "b.yaml"), results))
    texts = [str(cell) for table in tables for row in table.rows for cell in row]
    texts += [line for table in tables for line in (table.title, *table.notes, *(of.header for of in table.columns))]
    left = {text for text in texts if "EN 1998-1" in text}
    assert left == {"EN 1998-1, 4.2.3.2(6)", "EN 1998-1, 6.7.1(3)"}
    assert any(text == "NTC 2018, 7.3.6.1" for text in texts) and "q d_r/h" in texts
    assert (facts["Codes"], facts["Ductility class"]) == ("NTC 2018, EN 1993-1-1:2005", 'CD"B"')
    assert facts["Drift limit"] == "ductile elements, SLD in class of use II"


def test_own_cases_are_combined_by_ntc() -> None:
    """Eq. 2.5.1 and 2.5.2 written out: gamma_G1 = 1.3 and gamma_Q = 1.5 (Table 2.6.I, A1), psi_0 of Table 2.5.I.

    psi_0 is 0.7 of offices, 0.6 of wind and 0.5 of snow up to 1000 m; gamma_G1 is 1.0 where G relieves. Two floors of
    12 m by 8 m bring 2 x 96 x 5 = 960 kN of G and 2 x 96 x 2 = 384 kN of Q, the roof 96 x 0.8 = 76.8 kN of snow; the
    wind is 50 kN and 30 kN. Where Q leads the ground carries 1.3 x 960 + 1.5 x 384 + 0.75 x 76.8 = 1881.6 kN, and
    0.9 x 80 = 72 kN against the wind.
    """
    cases = "  cases:\n    wind: {category: wind, floors: [{floors: 1, x: 50 kN}, {floors: 2, x: 30 kN}]}\n"
    cases += "    snow: {category: snow, areas: [{floors: 2, q: 0.8 kN/m^2, spans: x}]}\n"
    found = design_of(ntc(changed(FRAMES, ("masses:", f"{cases}masses:"))))
    rows = {row.name: row for row in found.combinations if row.set == "fundamental" and "S_" not in row.name}
    assert set(rows) == {
        "1.3 G + 1.5 Q + 0.75 snow",
        "1.3 G + 1.05 Q + 1.5 snow",
        "1.3 G + 1.5 Q + 0.9 wind + 0.75 snow",
        "1.3 G + 1.05 Q + 0.9 wind + 1.5 snow",
        "1.3 G + 1.05 Q + 1.5 wind + 0.75 snow",
        "G + 1.5 wind",
    }
    assert {row.equation for row in rows.values()} == {"2.5.1"}
    rare = [row.name for row in found.combinations if row.set == "characteristic"]
    assert {"G + Q + 0.6 wind + 0.5 snow", "G + 0.7 Q + wind + 0.5 snow", "G + 0.7 Q + 0.6 wind + snow"} <= set(rare)
    of = found.foundations
    acting = of.acting[of.persistent.index("1.3 G + 1.5 Q + 0.9 wind + 0.75 snow")].sum(axis=0)
    assert acting[[0, 2]] == pytest.approx([-72e3, 1881.6e3], rel=1e-9)
