"""The pass of member checks in the core against the clauses in Python: each branch, then combinations and stations."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.codes.ec3.member import Stability
from edesign.codes.ec3.utilisation import ForcesAlong, utilisation
from edesign.codes.trace import Step, Trace
from edesign.core.errors import CoreError
from edesign.core.member_checks import (
    BEAM_CHECKS,
    CLAUSES,
    MEMBER_CHECKS,
    SECTION_CHECKS,
    Check,
    MemberConstants,
    MemberTable,
    Utilisations,
    mask,
    member_checks,
)
from edesign.errors import InputError
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.steel_section import steel_section
from edesign.space.checks.steel_member import SteelMember

ALL = mask(*Check)
S275 = 275e6
COLUMN = SteelMember(steel_section("HEB320"), S275, Stability(3.5, 3.5, 3.5, C1=1.77), 1)
BEAM = SteelMember(steel_section("IPE400"), S275, Stability(7.2, 2.4, 2.4), 1, V_M=200e3)
BRACE = SteelMember(steel_section("SHS180x10"), S275, Stability(8.0, 8.0, 8.0, C_my=1.0, C_mz=1.0), 1)
TUBE = SteelMember(steel_section("CHS168.3x8"), S275, Stability(4.0, 4.0, 4.0), 2)
SLENDER = SteelMember(steel_section("HEA300"), 355e6, Stability(6.0, 6.0, 6.0), 3)
RESTRAINED = SteelMember(steel_section("IPE400"), S275, Stability(7.2, 2.4, 0.0), 1)
MEMBERS = (COLUMN, BEAM, BRACE, TUBE, SLENDER, RESTRAINED)
UNIFORM = {"C_my": 1.0, "C_mz": 1.0, "C_my_N": 0.2412, "C_mz_N": 0.2412}  # C_mi,0 of a uniform moment, Table A.2
MEMBERS_A = (
    SteelMember(steel_section("HEB320"), S275, Stability(3.5, 3.5, 3.5, C1=1.77, **UNIFORM), 1, annex_a=True),
    SteelMember(steel_section("IPE400"), S275, Stability(7.2, 2.4, 2.4, **UNIFORM), 1, annex_a=True),
    SteelMember(steel_section("SHS180x10"), S275, Stability(8.0, 8.0, 8.0, **UNIFORM), 1, annex_a=True),
    SteelMember(
        steel_section("CHS168.3x8"), S275, Stability(4.0, 4.0, 4.0, C_my=0.79, C_mz=0.6, C_my_N=-0.12), 2, annex_a=True
    ),
    SteelMember(steel_section("HEA300"), 355e6, Stability(9.0, 9.0, 9.0, **UNIFORM), 3, annex_a=True),
    SteelMember(steel_section("IPE400"), S275, Stability(7.2, 0.0, 0.0, C_my_N=-0.18), 1, annex_a=True),
)
"""The same kinds of members with Annex A."""

# ---- each branch of the clauses --------------------------------------------------------------------------------------

KINDS = {
    "I": SteelMember(steel_section("HEB320"), S275, Stability(3.5, 3.5, 3.5), 1, gamma_M0=1.05),
    "I, another diagram": COLUMN,
    "I, general case": SteelMember(
        steel_section("IPE400"), S275, Stability(7.2, 2.4, 2.4, C1=1.77, general=True), 1, V_M=200e3
    ),
    "I, load on the flange": SteelMember(
        steel_section("IPE400"), 355e6, Stability(7.2, 2.4, 2.4, 1.348, 0.63, 0.2, C_mLT=0.6), 2, gamma_M1=1.1
    ),
    "I, short": SteelMember(steel_section("HEB320"), S275, Stability(1.2, 1.2, 1.2), 1),
    "I, long": SteelMember(steel_section("IPE400"), 355e6, Stability(9.0, 9.0, 14.0, C1=2.5), 1),
    "I, class 3": SLENDER,
    "I, class 3, restrained all along": SteelMember(steel_section("HEA300"), 355e6, Stability(6.0, 6.0, 0.0), 3),
    "I, restrained all along": SteelMember(steel_section("IPE330"), S275, Stability(7.2, 0.0, 0.0, twists=False), 1),
    "I, slender web": SteelMember(steel_section("HEA900"), 460e6, Stability(6.0, 6.0, 6.0), 1, V_M=900e3, gamma_M1=1.1),
    "I, torsion governs": SteelMember(steel_section("HEB200"), S275, Stability(3.0, 1.0, 12.0), 1),
    "I, thick web": SteelMember(replace(steel_section("IPE400"), tw=0.02), S275, Stability(4.0, 4.0, 4.0), 1),
    "I, twists before it bends": SteelMember(steel_section("HEB200"), S275, Stability(2.0, 2.0, 40.0), 1),
    "square": BRACE,
    "square, class 3": SteelMember(steel_section("SHS250x6.3"), S275, Stability(5.0, 4.0, 4.0), 3),
    "square, cold formed": SteelMember(steel_section("CFSHS180x10"), S275, Stability(5.0, 4.0, 4.0), 1),
    "rectangle": SteelMember(steel_section("RHS300x200x10"), 355e6, Stability(4.0, 5.0, 5.0), 2),
    "rectangle, class 3": SteelMember(steel_section("RHS300x200x6.3"), 355e6, Stability(4.0, 5.0, 5.0), 3),
    "circle": TUBE,
    "circle, class 3": SteelMember(steel_section("CHS406.4x6.3"), S275, Stability(6.0, 6.0, 6.0), 3),
}
ANNEX_A = {"C_my": 1.0, "C_mz": 0.79, "C_my_N": 0.2412, "C_mz_N": -0.1188}

Taken = Callable[[SteelMember, dict[str, Step]], bool]


def says(symbol: str, text: str) -> Taken:
    """Whether the expression or the clause of a step has a text in it."""
    return lambda member, steps: symbol in steps and text in f"{steps[symbol].expression}; {steps[symbol].clause}"


def value(symbol: str, test: Callable[[float], bool], kind: str = "") -> Taken:
    """Whether a step has such a value in a section of this shape."""
    return lambda member, steps: (
        member.section.kind.endswith(kind) and symbol in steps and test(float(steps[symbol].value))
    )


def at_least(index: str) -> Taken:
    """Whether a factor C of Annex A is the elastic one, its least; without lateral torsional buckling or with it."""

    def test(member: SteelMember, steps: dict[str, Step]) -> bool:
        if f"C_{index}" not in steps:
            return False
        ratio, w = {}, {}
        for axis in "yz":
            ratio[axis] = float(steps[f"W_el,{axis}"].value) / float(steps[f"W_pl,{axis}"].value)
            w[axis] = float(steps[f"w_{axis}"].value)
        row, column = index
        least = ratio[column] * (1.0 if row == column else 0.6 * math.sqrt(w[column] / w[row]))
        return float(steps[f"C_{index}"].value) == pytest.approx(least, rel=1e-12)

    return test


M_N_Y, M_N_Z = "M_N,y,Rd / M_y,Rd", "M_N,z,Rd / M_z,Rd"
USE = "utilisation"
BRANCHES: dict[str, tuple[str, Taken]] = {
    "axial force": ("N", says(USE, "N_pl,Rd")),
    "shear, the whole area yields": ("V_Z", says(USE, "V_pl,z,Rd")),
    "shear, a slender web buckles": ("V_Z", says(USE, "V_b,z,Rd")),
    "moment, plastic": ("M_Y", says(USE, "M_pl,y,Rd")),
    "moment, elastic": ("M_Y", says(USE, "M_el,y,Rd")),
    "moment about y with shear": ("M_Y", says(USE, "M_V,y,Rd")),
    "moment about z with shear": ("M_Z", says(USE, "M_V,z,Rd")),
    "shear uses up the section": ("M_Z", value("rho_y", lambda x: x == 1.0)),
    "nothing left for a moment": ("M_Z", value(USE, math.isinf)),
    "axial force with shear along y": ("N_M", lambda m, s: "N_V,Rd" in s and "rho_y" in s and "rho_z" not in s),
    "axial force with shear along z": ("N_M", lambda m, s: "N_V,Rd" in s and "rho_z" in s and "rho_y" not in s),
    "axial force beyond the resistance": ("N_M", value("n", lambda x: x >= 1.0)),
    "axial force by the other sign": ("N_M", says("N_Ed", "other sign")),
    "I: small axial force ignored": (
        "N_M",
        lambda m, s: value(M_N_Y, lambda x: x == 1.0, "I")(m, s) and s["n"].value > 0.0,
    ),
    "I: axial force reduces M_y": ("N_M", value(M_N_Y, lambda x: x < 1.0, "I")),
    "I: axial force above a quarter, within the web's": (
        "N_M",
        lambda m, s: value(M_N_Y, lambda x: x < 1.0, "I")(m, s) and 0.25 < s["n"].value < 0.26,  # of a thick web
    ),
    "I: axial force up to the web's": ("N_M", value(M_N_Z, lambda x: x == 1.0, "I")),
    "I: axial force reduces M_z": ("N_M", value(M_N_Z, lambda x: x < 1.0, "I")),
    "I: exponent of M_z above 1": ("N_M", lambda m, s: m.section.kind == "I" and says(USE, "6.41")(m, s)),
    "RHS": ("N_M", value(M_N_Z, lambda x: x < 1.0, "RHS")),
    "RHS: exponents at most 6": ("N_M", lambda m, s: m.section.kind == "RHS" and "^6 " in s[USE].expression),
    "RHS: exponents below 6": ("N_M", lambda m, s: m.section.kind == "RHS" and "^1.66 " in s[USE].expression),
    "CHS": ("N_M", value(M_N_Y, lambda x: x < 1.0, "CHS")),
    "one moment alone, y": ("N_M", says(USE, "M_y,Ed / M_N,y,Rd")),
    "one moment alone, z": ("N_M", says(USE, "M_z,Ed / M_N,z,Rd")),
    "linear sum, plastic": ("N_M", says(USE, "Eq. 6.2")),
    "linear sum, elastic": ("N_M", says(USE, "Eq. 6.42")),
    "buckling about y": ("N_B", says(USE, "N_b,y,Rd")),
    "buckling about z": ("N_B", says(USE, "N_b,z,Rd")),
    "no buckling of a short member": ("EQ_6_61", says("chi by bending", "no buckling")),
    "restrained against buckling": ("EQ_6_61", says("L_cr,z", "restrained all along")),
    "torsional buckling": ("N_B", lambda m, s: "chi by torsion" in s and s["chi_z"].value < s["chi by bending"].value),
    "tension is no compression": ("N_B", value("N_Ed", lambda x: x == 0.0)),
    "no lateral torsional buckling, restrained": ("M_B", says("chi_LT", "restrained all along")),
    "no lateral torsional buckling, hollow": ("M_B", says("chi_LT", "hollow")),
    "lateral torsional buckling, plateau": ("M_B", says("chi_LT", "no buckling up to")),
    "lateral torsional buckling, rolled": ("M_B", says("chi_LT", "6.57")),
    "lateral torsional buckling, general": ("M_B", says("chi_LT", "6.56")),
    "lateral torsional buckling, diagram": ("M_B", says("chi_LT,mod", "6.58")),
    "Annex B: twists": ("EQ_6_62", says("k_zy", "B.2")),
    "Annex B: twists, short": ("EQ_6_62", says("k_zy", "0.6 + lambda_z")),
    "Annex B: twists, elastic": ("EQ_6_62", says("k_zy", "0.05")),
    "Annex B: does not twist": ("EQ_6_62", says("k_zy", "0.6 C_my")),
    "Annex B: does not twist, elastic": ("EQ_6_62", says("k_zy", "0.8 C_my")),
    "Annex B: hollow": ("EQ_6_62", says("k_zz", "lambda_z - 0.2")),
    "Annex A: beyond N_cr,y": ("EQ_6_61", says("k_yy", "not below N_cr,y")),
    "Annex A: beyond N_cr,z": ("EQ_6_61", says("k_yy", "not below N_cr,z")),
    "Annex A: beyond N_cr,T": ("EQ_6_61", says("k_yy", "not below N_cr,T")),
    "Annex A: beyond, without M_y": ("EQ_6_61", says("k_yy", "without m_y")),
    "Annex A: beyond, without M_z": ("EQ_6_62", says("k_zz", "without m_z")),
    "Annex A: no lateral torsional buckling": ("EQ_6_61", says("C_my", "as lambda_0 <= lambda_0,lim")),
    "Annex A: lateral torsional buckling": ("EQ_6_61", says("C_my", "epsilon_y")),
    "Annex A: without compression": ("EQ_6_61", says("C_my", "without N_Ed")),
    "Annex A: C_mLT above 1": ("EQ_6_61", value("C_mLT", lambda x: x > 1.0)),
    "Annex A: elastic": ("EQ_6_61", lambda m, s: "mu_y" in s and "n_pl" not in s),
    "Annex A: w at most 1.5": ("EQ_6_61", value("w_z", lambda x: x == 1.5)),
    **{
        f"Annex A: C_{index} {'at its least' if least else 'above its least'}": (
            "EQ_6_61" if index[0] == "y" else "EQ_6_62",
            lambda m, s, index=index, least=least: f"C_{index}" in s and at_least(index)(m, s) == least,
        )
        for index in ("yy", "yz", "zy", "zz")
        for least in (True, False)
    },
    "moment of a dissipative beam": ("BEAM_M", says(USE, "6.6.2(2)")),
    "axial force of a dissipative beam": ("BEAM_N", says(USE, "0.15")),
    "shear of a dissipative beam": ("BEAM_V", value("V_Ed,M", lambda x: x > 0.0)),
    "shear of a column along y": ("COLUMN_V", says(USE, "V_y,Ed")),
    "shear of a column along z": ("COLUMN_V", says(USE, "V_z,Ed")),
}
"""Each branch of the clauses: the check that takes it, and how its steps show it."""


def test_the_core_takes_each_branch_as_the_clauses_do() -> None:
    """Forces at levels of the resistances at which branches change, on members of each kind, by both annexes."""
    draw, seen = np.random.default_rng(11), set()
    levels = np.array([0.0, 0.03, 0.15, 0.3, 0.7, 0.95, 1.05, 2.0])
    members = list(KINDS.values())
    members += [replace(m, stability=replace(m.stability, **ANNEX_A), annex_a=True) for m in members]
    for member in members:
        c = member.constants
        resistance = np.array([c.N_Rd, c.V_y_Rd, c.V_z_Rd, 1.0, c.M_y_Rd, c.M_z_Rd])
        beyond = 1.01 / max(c.per_N_cr_y, c.per_N_cr_z, c.per_N_cr_T, 0.1 / c.N_Rd) / c.N_Rd
        chosen = [
            [0.85, 0.0, 0.0, 0.0, 0.17, 0.17],
            [0.255, 0.0, 0.0, 0.0, 0.6, 0.6],
            [beyond, 0.0, 0.0, 0.0, 0.3, 0.0],
        ]
        shares = np.concatenate([chosen, draw.choice(levels, (60, 6))])
        for number, size in enumerate(resistance * shares):
            share = draw.choice([-1.0, 0.0, 0.4, 1.0], 6)  # of what has a sign; the rest alternates
            share[0] = -1.0 if number < len(chosen) else share[0]
            steady, alternating = share * size, (1.0 - np.abs(share)) * size
            found = one(c, steady.tolist(), alternating.tolist())
            for check in Check:
                trace, at = Trace(), ForcesAlong(np.zeros(1), steady[None], alternating[None])
                expected = utilisation(member, at, check.name, 0, trace=trace)
                assert expected is not None and trace.steps[-1].value == expected
                assert close(found[check], expected), (member, check, steady, alternating)
                steps = {step.symbol: step for step in trace.steps}
                seen |= {name for name, (of, taken) in BRANCHES.items() if of == check.name and taken(member, steps)}
    assert set(BRANCHES) - seen == set()


def close(found: float, expected: float) -> bool:
    """Some tens of roundings of 1.1e-16, which count against what is left of a resistance: 1/u of it."""
    return found == expected or abs(found - expected) <= expected * (1e-12 + 1e-14 * expected)


# ---- combinations, sets and stations ---------------------------------------------------------------------------------


def by_clauses(
    statics: np.ndarray,
    spectral: np.ndarray,
    static_factors: np.ndarray,
    spectral_factors: np.ndarray,
    combination_set: np.ndarray,
    gravity: np.ndarray,
    members: Sequence[SteelMember],
    masks: np.ndarray,
) -> np.ndarray:
    """The utilisations (m, n_checks) by the clauses; all cases count as gravity."""
    found, stations = np.zeros((len(members), len(Check))), range(statics.shape[2])
    for k, of in enumerate(combination_set):
        steady = np.einsum("c,cmsf->msf", static_factors[k], statics)
        alternating = np.einsum("d,dmsf->msf", np.abs(spectral_factors[k]), spectral)
        for m, member in enumerate(members):
            forces = ForcesAlong(np.linspace(0.0, 1.0, len(stations)), steady[m], alternating[m])
            for check in Check:
                if masks[m, of] >> check & 1:
                    at = stations if check in (Check.M_Y, Check.M_Z, Check.N_M) else stations[:1]
                    uses = [utilisation(member, forces, check.name, station) or 0.0 for station in at]
                    found[m, check] = max(found[m, check], *uses)
    return found


def random_loads(seed: int, scale: float, members: tuple[SteelMember, ...] = MEMBERS) -> tuple:
    """Loads on six members: 3 cases, 2 directions, 5 stations, 9 combinations of 3 sets."""
    draw = np.random.default_rng(seed)
    resistance = np.array(
        [[c.N_Rd, c.V_y_Rd, c.V_z_Rd, 1.0, c.M_y_Rd, c.M_z_Rd] for c in (of.constants for of in members)]
    )
    sparse = draw.random((3, len(members), 1, 6)) < 0.8
    statics = scale * sparse * draw.uniform(-1.0, 1.0, (3, len(members), 5, 6)) * resistance[:, None, :]
    spectral = scale * draw.uniform(0.0, 0.6, (2, len(members), 5, 6)) * resistance[:, None, :]
    factors = draw.choice([0.0, 0.3, 1.0, 1.35, -1.0], (9, 3))
    directions = draw.choice([0.0, 0.3, 1.0, -1.0], (9, 2))
    masks = draw.integers(0, ALL + 1, (len(members), 3))
    return statics, spectral, factors, directions, draw.integers(0, 3, 9), np.ones(3), members, masks


def checked(loads: tuple) -> Utilisations:
    table = MemberTable.of([of.constants if isinstance(of, SteelMember) else of for of in loads[6]])
    return member_checks(*loads[:6], table, loads[7])


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1.2), st.sampled_from([MEMBERS, MEMBERS_A]))
def test_the_core_computes_what_the_clauses_say(seed: int, scale: float, members: tuple[SteelMember, ...]) -> None:
    loads = random_loads(seed, scale, members)
    for found, expected in zip(checked(loads).utilisation.flat, by_clauses(*loads).flat, strict=True):
        assert close(found, expected)


def test_gravity_alone_counts_in_the_shear_of_a_dissipative_beam() -> None:
    loads = random_loads(3, 0.3)
    loads = (*loads[:5], np.array([1, 0, 1]), loads[6], np.full_like(loads[7], mask(Check.BEAM_V)))
    statics, factors = loads[0] * loads[5][:, None, None, None], loads[2]
    V_G = np.abs(np.einsum("kc,cms->kms", factors, statics[..., 2])).max(axis=(0, 2))
    expected = [(V + m.V_M) / m.constants.V_z_Rd / 0.5 for V, m in zip(V_G, MEMBERS, strict=True)]
    assert checked(loads).utilisation[:, Check.BEAM_V] == pytest.approx(expected, rel=1e-12)  # some roundings


def test_combinations_come_first_of_equal_ones() -> None:
    loads = random_loads(3, 0.3)
    doubled = [np.concatenate([x, x]) for x in loads[2:5]]
    some, twice = checked(loads), checked((*loads[:2], *doubled, *loads[5:]))
    np.testing.assert_array_equal(twice.combination, some.combination)
    np.testing.assert_array_equal(twice.utilisation, some.utilisation)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.floats(0.05, 0.8), st.floats(1.0, 3.0))
def test_more_load_is_more_utilisation(seed: int, scale: float, factor: float) -> None:
    """Every check grows with all loads, but for the sum of Eq. 6.41, whose exponent grows too: its verdict stays."""
    loads = random_loads(seed, scale)
    loads = (*loads[:-1], np.full_like(loads[-1], ALL))
    less, more = checked(loads).utilisation, checked((factor * loads[0], factor * loads[1], *loads[2:])).utilisation
    curved = (Check.N_M, Check.EQ_6_62)  # k_zy of Table B.2 falls with compression
    others = [check for check in Check if check not in curved]
    assert (more[:, others] >= less[:, others] * (1.0 - 1e-12)).all()
    beyond = less[:, curved] > 1.0
    assert (more[:, curved][beyond] > 1.0).all()


def one(member: MemberConstants | SteelMember, static: list[float], spectral: list[float] | None = None) -> np.ndarray:
    """Utilisations of one member at one station under one combination."""
    response = np.zeros((0 if spectral is None else 1, 1, 1, 6))
    if spectral is not None:
        response[0, 0, 0] = spectral
    factors = np.ones((1, 1)), np.ones((1, response.shape[0]))
    found = checked(
        (np.array(static).reshape(1, 1, 1, 6), response, *factors, np.array([0]), np.array([1]), (member,))
        + (np.array([[ALL]]),)
    )
    return found.utilisation[0]


def test_compression_and_tension() -> None:
    """Buckling counts in compression only, and with both signs of a response."""
    c = COLUMN.constants
    assert one(COLUMN, [1e6, 0, 0, 0, 0, 0])[Check.N_B] == 0.0
    assert one(COLUMN, [-1e6, 0, 0, 0, 0, 0])[Check.N_B] == pytest.approx(1e6 / c.N_b_z_Rd)
    alternating = one(COLUMN, [0.4e6, 0, 0, 0, 0, 0], [1e6, 0, 0, 0, 0, 0])
    assert alternating[Check.N] == pytest.approx(1.4e6 / c.N_Rd)
    assert alternating[Check.N_B] == pytest.approx(0.6e6 / c.N_b_z_Rd)


def test_beam_of_a_frame() -> None:
    """EN 1998-1, 6.6.2(2): by hand; V_Ed,G is that of gravity alone."""
    found = one(BEAM, [-30e3, 0, 60e3, 0, -150e3, 0], [20e3, 0, 80e3, 0, 90e3, 0])
    s = steel_section("IPE400")
    assert found[Check.BEAM_M] == pytest.approx(240e3 / (s.W_pl_y * S275))
    assert found[Check.BEAM_N] == pytest.approx(50e3 / (0.15 * s.A * S275))
    assert found[Check.BEAM_V] == pytest.approx(260e3 / (0.5 * s.A_vz * S275 / math.sqrt(3.0)))
    assert found[Check.COLUMN_V] == pytest.approx(140e3 / (0.5 * s.A_vz * S275 / math.sqrt(3.0)))


def test_thesis_sections_have_the_resistances_of_the_clauses() -> None:
    s, column = steel_section("HEB320"), COLUMN.constants
    assert column.N_Rd == s.A * S275 and column.M_y_Rd == s.W_pl_y * S275
    assert column.N_b_z_Rd < column.N_b_y_Rd < column.N_Rd
    assert (
        RESTRAINED.constants.M_b_Rd == RESTRAINED.constants.M_y_Rd
        and not RESTRAINED.twists
        and not BRACE.twists
        and COLUMN.twists
    )
    reduced = replace(COLUMN, gamma_M0=1.1, gamma_M1=1.2).constants
    assert reduced.N_Rd == pytest.approx(column.N_Rd / 1.1)
    assert reduced.N_b_z_Rd == pytest.approx(column.N_b_z_Rd / 1.2)
    with pytest.raises(InputError, match="HEB320 is of class 4"):
        replace(COLUMN, section_class=4)
    general = replace(COLUMN, stability=Stability(3.5, 3.5, 3.5, general=True)).constants
    assert general.M_b_Rd < column.M_b_Rd
    assert section_class(steel_section("HEA300"), 355e6).number == 3


def test_torsional_buckling_counts_where_it_is_less() -> None:
    torsional = replace(COLUMN, stability=Stability(3.0, 1.0, 12.0)).constants
    flexural = replace(COLUMN, stability=Stability(3.0, 1.0, 0.0)).constants
    assert torsional.N_b_z_Rd < flexural.N_b_z_Rd and torsional.lambda_z == flexural.lambda_z


def test_every_check_has_its_clause() -> None:
    assert set(CLAUSES) == set(Check) == {*SECTION_CHECKS, *MEMBER_CHECKS, *BEAM_CHECKS, Check.COLUMN_V}


def test_no_combination() -> None:
    loads = random_loads(1, 0.1)
    empty = (*loads[:2], loads[2][:0], loads[3][:0], loads[4][:0], *loads[5:])
    found = checked(empty)
    assert (found.utilisation == 0.0).all() and (found.combination == -1).all() and (found.station == -1).all()


def test_what_is_wrong_is_refused() -> None:
    statics, spectral, *rest, masks = random_loads(1, 0.1)
    with pytest.raises(ValueError, match="shapes do not fit together"):
        checked((statics[:2], spectral, *rest, masks))
    with pytest.raises(ValueError, match="5 constants and masks"):
        checked((statics, spectral, *rest[:4], MEMBERS[:5], masks))
    broken = statics.copy()
    broken[1, 2, 3, 4] = np.nan
    with pytest.raises(CoreError, match="not a finite number"):
        checked((broken, spectral, *rest, masks))
    with pytest.raises(CoreError, match="invalid argument"):
        checked((statics, -spectral, *rest, masks))
    for member in (
        replace(COLUMN.constants, N_Rd=0.0),
        replace(MEMBERS_A[0].constants, N_Rk=0.0),
        replace(MEMBERS_A[0].constants, elastic_y=1.2),
        replace(MEMBERS_A[0].constants, a_LT=-0.1),
        replace(MEMBERS_A[0].constants, C_my_N=-1.5),
    ):
        with pytest.raises(CoreError, match="invalid argument"):
            checked((statics, spectral, *rest[:4], (member, *MEMBERS[1:]), masks))
    with pytest.raises(CoreError, match="invalid argument"):
        checked((statics, spectral, rest[0], rest[1], rest[2] + 3, *rest[3:], masks))
