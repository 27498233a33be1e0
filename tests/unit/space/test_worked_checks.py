"""Worked calculations of checks that reports print: formulas give their values, and lead to what archives have."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.reader import open_archive
from edesign.codes.ec3.buckling import IMPERFECTION
from edesign.codes.ec3.lateral_torsional import buckling_moments, quarter_moments, rolled_curve
from edesign.codes.ec3.member import Member, Stability
from edesign.codes.ec3.utilisation import ForcesAlong, FreeBeam, utilisation
from edesign.codes.trace import Step, Trace
from edesign.frame.building_file import load_building
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.steel_section import steel_section
from edesign.report.building.checks import worked_check
from edesign.report.building.results import BuildingResults
from edesign.study.run.building import run_building

SAME = 1e-9
"""Both do the same sums of some tens of terms in another order; above rounding by six digits."""


def steps_of(
    member: Member, forces: ForcesAlong, check: str, station: int, free_beam: FreeBeam | None = None
) -> list[Step]:
    """The worked calculation of a check."""
    trace = Trace()
    assert utilisation(member, forces, check, station, free_beam, trace) == trace.steps[-1].value
    return trace.steps


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
    member = Member(steel_section("IPE400"), 355e6, stability, 1, gamma_M1=1.1, annex_a=True)
    steady = np.zeros((7, 6))
    steady[:, [0, 4, 5]] = forces
    along, seen = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, np.zeros((7, 6))), set()
    for check in ("EQ_6_61", "EQ_6_62"):
        values: dict[str, float] = {}
        for step in steps_of(member, along, check, 0):
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
    member = Member(steel_section("UC152x152x30"), 275e6, Stability(4.0, 4.0, 0.0), 1)
    forces = ForcesAlong(np.array([0.0]), np.array([[-200e3, 0.0, 0.0, 0.0, 0.0, 0.0]]), np.zeros((1, 6)))
    found = {step.symbol: step.value for step in steps_of(member, forces, "N_B", 0)}
    assert found["curve z"] == "c" and found["N_Ed"] == 200e3
    assert found["lambda_z"] == pytest.approx(1.203, rel=1.3e-3)
    assert found["chi_z"] == pytest.approx(0.4323, rel=1.7e-3)
    assert found["N_b,z,Rd"] == pytest.approx(455e3, rel=3e-3)
    assert found["utilisation"] == pytest.approx(200.0 / 455.0, rel=3e-3)


def test_formulas_of_a_free_beam_give_their_values() -> None:
    """M_b,Rd of an IPE400 of 6 m, worked out from the printed moments, which have four digits."""
    member = Member(steel_section("IPE400"), 275e6, Stability(6.0, 6.0, 6.0), 1)
    steady, alternating = np.zeros((2, 7, 6))
    steady[:, 4] = [-90e3, -14e3, 31e3, 46e3, 31e3, -14e3, -90e3]
    alternating[:, 4] = np.abs(np.linspace(60e3, -60e3, 7))
    forces = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, alternating)
    steps = steps_of(member, forces, "M_B", 0, FreeBeam(6.0, 92e3))
    formulas = {step.symbol.replace(" ", "_"): step.expression for step in steps}
    values = {step.symbol.replace(" ", "_"): step.value for step in steps if isinstance(step.value, float)}
    for symbol in ("M_A", "M_C"):
        assert calculated(formulas[symbol], {}) * 1e3 == pytest.approx(values[symbol], rel=1e-3)
    for symbol in ("C_1", "C_2_z_g", "M_cr", "lambda_LT", "k_c", "f", "chi_LT,mod", "M_b,Rd"):
        found = calculated(formulas[symbol], values | {"pi": math.pi})
        assert found == pytest.approx(values[symbol], rel=SAME), symbol


@pytest.mark.parametrize("name", ["HEB320", "IPE400", "HEA300"])
def test_a_free_beam_has_the_moment_of_the_function_of_arrays(name: str) -> None:
    """Random diagrams with and without loads, which may lift: M_b,Rd as `FreeBeams` finds it for all beams at once."""
    s, draw = steel_section(name), np.random.default_rng(5)
    member = Member(s, 355e6, Stability(6.0, 6.0, 6.0), 3 if name == "HEA300" else 1, gamma_M1=1.1)
    bending = math.pi**2 * member.E * s.I_z
    for _ in range(30):
        steady, alternating = np.zeros((2, 7, 6))
        steady[:, 4], alternating[:, 4] = draw.uniform(-1e5, 1e5, 7), draw.uniform(0.0, 1e5, 7) * draw.integers(0, 2)
        M_max = np.asarray((np.abs(steady[:, 4]) + alternating[:, 4]).max())
        load = float(draw.uniform(-0.5, 2.0) * 4.0 * M_max / 6.0)  # about that of a uniform one on hinges
        expected = buckling_moments(
            np.asarray(getattr(s, f"W_{member.theory}_y") * member.fy),
            M_max,
            quarter_moments(steady[:, 4], alternating[:, 4]),
            tipping=np.asarray(max(load, 0.0) * 6.0 * s.h / 2.0 / math.pi**2),
            euler=np.asarray(bending / 6.0**2),
            squared=np.asarray(s.I_w / s.I_z + member.G * s.I_t * 6.0**2 / bending),
            imperfection=np.asarray(IMPERFECTION[rolled_curve(s.h, s.b)]),
        )
        forces = ForcesAlong(np.linspace(0.0, 1.0, 7), steady, alternating)
        values = {step.symbol: step.value for step in steps_of(member, forces, "M_B", 0, FreeBeam(6.0, load))}
        assert values["M_b,Rd"] == pytest.approx(float(expected) / 1.1, rel=SAME)


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
def test_every_check_of_an_archive_has_a_worked_calculation(tmp_path: Path, directions: str, members: str) -> None:
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
                found = worked_check(results, number, check)
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
