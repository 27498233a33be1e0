"""Checks written out step by step, against the pass of the core over all members and combinations."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.reader import open_archive
from edesign.building.building_file import load_building
from edesign.building.sections.section_class import section_class
from edesign.building.sections.steel_section import steel_section
from edesign.building.steel_member import Stability, SteelMember
from edesign.codes.ec3.buckling import IMPERFECTION
from edesign.codes.ec3.lateral_torsional import buckling_moments, rolled_curve
from edesign.core.member_checks import Check, MemberTable, mask, member_checks
from edesign.report.building.checks import written
from edesign.report.building.results import BuildingResults
from edesign.space.checks.buckling_moments import quarter_moments
from edesign.space.checks.written_checks import written_check
from edesign.space.checks.written_steps import ForcesAlong, FreeBeam
from edesign.study.run.building import run_building

SAME = 1e-9
"""Both do the same sums of some tens of terms in another order; above rounding by six digits."""

MEMBERS = {
    "I, class 1": SteelMember(steel_section("HEB320"), 275e6, Stability(3.5, 3.5, 3.5), 1, gamma_M0=1.05),
    "I, h/b above 2, general case": SteelMember(
        steel_section("IPE400"), 275e6, Stability(7.2, 2.4, 2.4, C1=1.77, general=True), 1, V_M=200e3
    ),
    "I, load on the flange": SteelMember(
        steel_section("IPE400"), 355e6, Stability(7.2, 2.4, 2.4, 1.348, 0.63, 0.2, C_mLT=0.6), 2, gamma_M1=1.1
    ),
    "I, class 3": SteelMember(steel_section("HEA300"), 355e6, Stability(6.0, 6.0, 6.0), 3),
    "I, held all along": SteelMember(steel_section("IPE330"), 275e6, Stability(7.2, 0.0, 0.0, twists=False), 1),
    "I, slender web": SteelMember(steel_section("HEA900"), 460e6, Stability(6.0, 6.0, 6.0), 1, V_M=900e3, gamma_M1=1.1),
    "I, torsion governs": SteelMember(steel_section("HEB200"), 275e6, Stability(3.0, 1.0, 12.0), 1),
    "square, class 3": SteelMember(steel_section("SHS250x6.3"), 275e6, Stability(5.0, 4.0, 4.0), 3),
    "square": SteelMember(steel_section("SHS180x10"), 275e6, Stability(8.0, 8.0, 8.0, C_my=1.0, C_mz=1.0), 1),
    "rectangle, class 1": SteelMember(steel_section("RHS300x200x10"), 275e6, Stability(9.0, 9.0, 9.0), 1),
    "rectangle": SteelMember(steel_section("RHS300x200x10"), 355e6, Stability(4.0, 5.0, 5.0), 2),
    "rectangle, class 3": SteelMember(steel_section("RHS300x200x6.3"), 355e6, Stability(4.0, 5.0, 5.0), 3),
    "circle": SteelMember(steel_section("CHS168.3x8"), 275e6, Stability(4.0, 4.0, 4.0), 1),
    "circle, class 3": SteelMember(steel_section("CHS406.4x6.3"), 275e6, Stability(6.0, 6.0, 6.0), 3),
}
CHECKS = [check for check in Check]


def free_beam(member: SteelMember, share: float, steady: np.ndarray, swing: np.ndarray) -> tuple[FreeBeam, float]:
    """A member as a beam that no slab holds, and its M_b,Rd by the function of arrays.

    The load is a share of the uniform one that gives the largest moment on hinges, 8 M / L, half of which counts.
    """
    s, L, GI_t = member.section, 0.9 * member.stability.L_LT, member.G * member.section.I_t
    M_max = np.asarray((np.abs(steady) + swing).max())
    load, bending = float(share * 4.0 * M_max / L), math.pi**2 * member.E * s.I_z
    M_b_Rk = buckling_moments(
        np.asarray((s.W_pl_y if member.section_class < 3 else s.W_el_y) * member.fy),
        M_max,
        quarter_moments(steady, swing),
        tipping=np.asarray(max(load, 0.0) * L * s.h / 2.0 / math.pi**2),
        euler=np.asarray(bending / L**2),
        squared=np.asarray(s.I_w / s.I_z + GI_t * L**2 / bending),
        imperfection=np.asarray(IMPERFECTION[rolled_curve(s.h, s.b)]),
    )
    return FreeBeam(L, load), float(M_b_Rk) / member.gamma_M1


CASES = [(name, option) for name in MEMBERS for option in ("annex_a", "annex_b")] + [
    (name, option)
    for name, of in MEMBERS.items()
    if of.section.kind == "I" and of.stability.L_LT > 0.0 and not of.stability.general
    for option in ("ends", "annex_a, ends")
]


@pytest.mark.parametrize(("name", "option"), CASES)
def test_every_check_is_that_of_the_core(name: str, option: str) -> None:
    """Random forces up to 1.2 of each resistance, so that shear and axial force reduce moments, in 60 combinations."""
    member, random = MEMBERS[name], np.random.default_rng(5)
    annex_a, ends, checks = "annex_a" in option, "ends" in option, CHECKS
    if annex_a:
        uniform = replace(member.stability, C_my=1.0, C_mz=0.79, C_my_N=0.2412, C_mz_N=-0.1188)
        member = replace(member, stability=uniform, annex_a=True)
    if option != "annex_b":  # the other checks do not depend on it
        checks = [Check.M_B, Check.EQ_6_61, Check.EQ_6_62]
    c = member.constants
    resistance = np.array([c.N_b_z_Rd, c.V_y_Rd, c.V_z_Rd, 1.0, c.M_y_Rd, c.M_z_Rd])
    size = resistance * random.uniform(0.0, 1.2, (60, 1, 6)) ** 2
    steady = size * random.uniform(-0.6, 0.6, (60, 7, 6))
    swing = size * random.uniform(0.0, 0.6, (60, 7, 6)) * (random.random((60, 1, 1)) > 0.3)
    stations = np.linspace(0.0, 1.0, 7)
    seen = set()
    for k in range(60):
        beam, table, M_b = None, MemberTable.of([c]), None
        if ends:
            beam, least = free_beam(member, random.uniform(-0.5, 2.0), steady[k, :, 4], swing[k, :, 4])
            table.column("M_b_Rd")[:], M_b = least, np.array([[least]])
        core = member_checks(
            statics=steady[k][None, None],
            spectral=swing[k][None, None],
            static_factors=np.ones((1, 1)),
            spectral_factors=np.ones((1, 1)),
            combination_set=np.zeros(1),
            gravity=np.ones(1),
            members=table,
            masks=np.array([[mask(*checks)]]),
            M_b=M_b,
        )
        forces = ForcesAlong(stations, steady[k], swing[k])
        for check in checks:
            steps = written_check(member, forces, check.name, int(core.station[0, check]), beam)
            assert steps[-1].symbol == "utilisation"
            assert steps[-1].value == pytest.approx(core.utilisation[0, check], rel=SAME), (check.name, k)
            seen |= {step.symbol for step in steps}
    expected = {
        "N_cr,y": True,
        "k_yy": True,
        "rho_z": option == "annex_b",
        "mu_z": annex_a,
        "C_zz": annex_a and member.section_class < 3,
        "C_2 z_g": ends,
    }
    assert {symbol for symbol, written in expected.items() if written} <= seen


SPACED = ("chi by bending", "C_2 z_g")
"""Symbols that are no names."""


def calculated(formula: str, values: dict[str, float]) -> float:
    """A formula in symbols worked out: `a b` is a product, `>=` and `<=` bound what stands before them."""
    text = re.sub(r", (as|of|without|C_1) .*", "", formula).replace(" kN*m", "").replace(" x ", " * ")
    text = re.sub(r"\|(.*)\|", r"abs(\1)", text).replace("[", "(").replace("]", ")").replace("^", "**")
    for symbol in SPACED:
        text = text.replace(symbol, symbol.replace(" ", "_"))
    functions = {"sqrt": math.sqrt, "max": max, "min": min, "abs": abs}

    def number(part: str) -> float:
        part = re.sub(r"[A-Za-z]\w*(,\w+)*", lambda m: m[0] if m[0] in functions else f"({values[m[0]]!r})", part)
        return float(eval(re.sub(r"(?<=[\w)]) (?=[\w(])", " * ", part), functions))  # noqa: S307

    found, *bounds = (number(part) for part in re.split(r" [<>]= ", text))
    return (max if ">=" in text else min)(found, *bounds) if bounds else found


@pytest.mark.parametrize("forces", [(-300e3, 80e3, 5e3), (-20e3, 150e3, 12e3), (-900e3, 1e3, 1e3), (0.0, 150e3, 0.0)])
def test_formulas_of_annex_a_give_their_values(forces: tuple[float, float, float]) -> None:
    """Each formula, worked out with the values of the steps before it."""
    stability = Stability(6.0, 4.0, 4.0, C_my_N=0.2412, C_mz_N=-0.1188, C_my=1.0, C_mz=0.79)
    member = SteelMember(steel_section("IPE400"), 355e6, stability, 1, gamma_M1=1.1, annex_a=True)
    steady = np.zeros((7, 6))
    steady[:, [0, 4, 5]] = forces
    along, seen = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, np.zeros((7, 6))), set()
    for check in ("EQ_6_61", "EQ_6_62"):
        values: dict[str, float] = {}
        for step in written_check(member, along, check, 0):
            if step.clause.startswith("Annex A"):
                assert step.value == pytest.approx(calculated(step.expression, values), rel=SAME), step.symbol
                seen.add(step.symbol)
            if isinstance(step.value, float):
                values[step.symbol.replace(" ", "_")] = step.value
    for of in ("mu_{}", "C_m{},0", "C_m{}", "w_{}"):
        assert {of.format("y"), of.format("z")} <= seen
    assert {f"{of}_{index}" for of in "Ck" for index in ("yy", "yz", "zy", "zz")} <= seen
    assert {"lambda_0", "lambda_0,lim", "C_mLT", "n_pl", "lambda_max", "b_LT", "c_LT", "d_LT", "e_LT"} <= seen


def test_a_published_column() -> None:
    """UC152x152x30 of S275, 4 m, curve c: lambda_z 1.203, chi_z 0.4323, N_b,z,Rd 455 kN (steelcalculator.app).

    Tables of sections print i_z = 3.83 cm, so that lambda_z has a bar of 0.13 %; chi_z changes by 1.3 times as much,
    and N_b has the area of the tables, 38.3 cm2 to 0.13 %, in it too.
    """
    member = SteelMember(steel_section("UC152x152x30"), 275e6, Stability(4.0, 4.0, 0.0), 1)
    forces = ForcesAlong(np.array([0.0]), np.array([[-200e3, 0.0, 0.0, 0.0, 0.0, 0.0]]), np.zeros((1, 6)))
    found = {step.symbol: step.value for step in written_check(member, forces, "N_B", 0)}
    assert found["curve z"] == "c" and found["N_Ed"] == 200e3
    assert found["lambda_z"] == pytest.approx(1.203, rel=1.3e-3)
    assert found["chi_z"] == pytest.approx(0.4323, rel=1.7e-3)
    assert found["N_b,z,Rd"] == pytest.approx(455e3, rel=3e-3)
    assert found["utilisation"] == pytest.approx(200.0 / 455.0, rel=3e-3)


@pytest.mark.parametrize("moments", [(0.0, 0.0), (20e3, 0.0), (20e3, 5e3)])
def test_annex_a_beyond_a_critical_force(moments: tuple[float, float]) -> None:
    """Infinite where there is a moment, n alone without one, as in the core."""
    for section, held, over in (
        ("SHS180x10", Stability(9.0, 8.0, 8.0), "y"),
        ("IPE400", Stability(9.0, 8.0, 8.0), "z"),
        ("HEB200", Stability(2.0, 2.0, 40.0), "T"),
    ):
        member = SteelMember(steel_section(section), 275e6, held, 1, annex_a=True)
        c, steady = member.constants, np.zeros((7, 6))
        N_cr = min(1.0 / per for per in (c.per_N_cr_y, c.per_N_cr_z, c.per_N_cr_T) if per > 0.0)
        steady[:, [0, 4, 5]] = -1.01 * N_cr, *moments
        core = member_checks(
            statics=steady[None, None],
            spectral=np.zeros((1, 1, 7, 6)),
            static_factors=np.ones((1, 1)),
            spectral_factors=np.zeros((1, 1)),
            combination_set=np.zeros(1),
            gravity=np.ones(1),
            members=MemberTable.of([c]),
            masks=np.array([[mask(Check.EQ_6_61, Check.EQ_6_62)]]),
        )
        for check in (Check.EQ_6_61, Check.EQ_6_62):
            forces = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, np.zeros((7, 6)))
            steps = written_check(member, forces, check.name, 0)
            assert steps[-1].value == pytest.approx(core.utilisation[0, check], rel=SAME)
            assert np.isinf(steps[-1].value) == any(moments)
            assert any(moments) == (f"N_Ed is not below N_cr,{over}" in {step.expression for step in steps})


def test_formulas_of_a_free_beam_give_their_values() -> None:
    """M_b,Rd of an IPE400 of 6 m, worked out from the written moments, which have four digits."""
    member = SteelMember(steel_section("IPE400"), 275e6, Stability(6.0, 6.0, 6.0), 1)
    steady, swing = np.zeros((2, 7, 6))
    steady[:, 4] = [-90e3, -14e3, 31e3, 46e3, 31e3, -14e3, -90e3]
    swing[:, 4] = np.abs(np.linspace(60e3, -60e3, 7))
    forces = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, swing)
    steps = written_check(member, forces, "M_B", 0, FreeBeam(6.0, 92e3))
    formulas = {step.symbol.replace(" ", "_"): step.expression for step in steps}
    values = {step.symbol.replace(" ", "_"): step.value for step in steps if isinstance(step.value, float)}
    for symbol in ("M_A", "M_C"):
        assert calculated(formulas[symbol], {}) * 1e3 == pytest.approx(values[symbol], rel=1e-3)
    for symbol in ("C_1", "C_2_z_g", "M_cr", "lambda_LT", "k_c", "f", "chi_LT,mod", "M_b,Rd"):
        found = calculated(formulas[symbol], values | {"pi": math.pi})
        assert found == pytest.approx(values[symbol], rel=SAME), symbol


BUILDING = """
edesign_building: 1
title: One of each
plan: {x: [6 m, 1.5 m, 5 m], y: {count: 2, width: 5 m}}
storeys: [4 m, 3 m]
columns:
  - {section: HEB240, material: S355, strong: x, group: I}
  - {at: A, section: RHS300x200x10, material: S355, strong: x, group: RHS}
  - {at: D, section: HEA300, material: S355, strong: x, group: third}
beams:
  - {along: x, section: IPE300, material: S355, group: BX}
  - {along: y, section: IPE270, material: S355, ends: pinned, group: BY}
braces:
  - {along: y, frames: [A], bays: 1, kind: cross, section: CHS101.6x5, material: S355, group: CHS}
  - {along: y, frames: [D], bays: 1-2, kind: alternating, compression: true,
     section: SHS140x8, material: S355, group: SHS}
materials: {S355: {fy: 355 MPa}}
loads:
  areas: [{G: 9 kN/m^2, Q: 3 kN/m^2, category: B, spans: x}]
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.3 g, ground: C, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: concentric_diagonal, q: 4}}
  directions: 30 %
"""


@pytest.mark.parametrize(
    ("directions", "members"),
    [("30 %", "interaction: annex_b"), ("srss", "interaction: annex_a, lateral_restraint: {beams: ends}")],
)
def test_every_check_of_an_archive_is_written_out(tmp_path: Path, directions: str, members: str) -> None:
    """Of every member and check of a building with I, RHS, SHS and CHS sections, from its archive alone."""
    text = BUILDING.replace("directions: 30 %", f"directions: {directions}") + f"  members: {{{members}}}\n"
    if "ends" in members:
        text = text.replace("section: IPE270", "section: RHS300x200x10")
    file = tmp_path / "building.yaml"
    file.write_text(text, encoding="utf-8")
    path, design = run_building(load_building(file))
    with open_archive(path) as archive:
        results = BuildingResults(archive)
        groups, seen, beams = set(), set(), set()
        for number, member in enumerate(design.frame.members):
            for check, name in enumerate(design.members.checks):
                if not design.members.combination[number, check]:
                    continue
                found = written(results, number, check)
                assert found.steps[-1].value == pytest.approx(design.members.utilisation[number, check], rel=SAME)
                if "C_2 z_g" in {step.symbol for step in found.steps}:
                    place = next(step.value for step in found.steps if step.symbol == "M_b,Rd")
                    free = design.members.free_beams
                    assert free is not None
                    at = free.members.tolist().index(number), found.number - 1
                    assert place == pytest.approx(results.values("free_beams", "M_b_Rd")[at], rel=SAME)
                    beams.add(name)
                groups.add(member.group)
                seen.add(name)
    assert groups == {"I", "RHS", "third", "BX", "BY", "CHS", "SHS"}
    assert seen == set(design.members.checks)
    assert beams == ({"M_B", "EQ_6_61", "EQ_6_62"} if "ends" in members else set())


def test_the_class_is_that_of_the_checks(tmp_path: Path) -> None:
    """HEA300 of S355 is of class 3 in bending; the archive gives the class by the largest axial force."""
    assert section_class(steel_section("HEA300"), 355e6).number == 3
    file = tmp_path / "building.yaml"
    file.write_text(BUILDING, encoding="utf-8")
    path, design = run_building(load_building(file))
    with open_archive(path) as archive:
        found = BuildingResults(archive).values("members", "class")
    used = np.array([member.section_class for member in design.members.members])[design.members.kinds]
    assert ((found < 3) == (used < 3)).all()
    assert set(found[[member.group == "third" for member in design.frame.members]]) == {3}
