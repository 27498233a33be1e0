"""The pass of member checks in the core against the clauses in Python, one combination and station at a time."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.building.sections.section_class import section_class
from edesign.building.sections.steel_section import steel_section
from edesign.building.steel_member import Stability, member_constants
from edesign.codes.ec3 import cross_section
from edesign.codes.ec3.interaction import (
    AnnexAMember,
    InteractionFactors,
    annex_a_factors,
    annex_a_terms,
    annex_b_factors,
    member_interaction,
)
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

ALL = mask(*Check)
S275 = 275e6
COLUMN = member_constants(steel_section("HEB320"), S275, Stability(3.5, 3.5, 3.5, C1=1.77), 1)
BEAM = member_constants(steel_section("IPE400"), S275, Stability(7.2, 2.4, 2.4), 1, V_M=200e3)
BRACE = member_constants(steel_section("SHS180x10"), S275, Stability(8.0, 8.0, 8.0, C_my=1.0, C_mz=1.0), 1)
TUBE = member_constants(steel_section("CHS168.3x8"), S275, Stability(4.0, 4.0, 4.0), 2)
SLENDER = member_constants(steel_section("HEA300"), 355e6, Stability(6.0, 6.0, 6.0), 3)
HELD = member_constants(steel_section("IPE400"), S275, Stability(7.2, 2.4, 0.0), 1)
MEMBERS = (COLUMN, BEAM, BRACE, TUBE, SLENDER, HELD)
UNIFORM = {"C_my": 1.0, "C_mz": 1.0, "C_my_N": 0.2412, "C_mz_N": 0.2412}  # C_mi,0 of a uniform moment, Table A.2
MEMBERS_A = (
    member_constants(steel_section("HEB320"), S275, Stability(3.5, 3.5, 3.5, C1=1.77, **UNIFORM), 1, annex_a=True),
    member_constants(steel_section("IPE400"), S275, Stability(7.2, 2.4, 2.4, **UNIFORM), 1, annex_a=True),
    member_constants(steel_section("SHS180x10"), S275, Stability(8.0, 8.0, 8.0, **UNIFORM), 1, annex_a=True),
    member_constants(
        steel_section("CHS168.3x8"), S275, Stability(4.0, 4.0, 4.0, C_my=0.79, C_mz=0.6, C_my_N=-0.12), 2, annex_a=True
    ),
    member_constants(steel_section("HEA300"), 355e6, Stability(9.0, 9.0, 9.0, **UNIFORM), 3, annex_a=True),
    member_constants(steel_section("IPE400"), S275, Stability(7.2, 0.0, 0.0, C_my_N=-0.18), 1, annex_a=True),
)
"""The same kinds of members with Annex A."""


def ratio(load: float, resistance: float) -> float:
    return load / resistance if resistance > 0.0 else math.inf if load > 0.0 else 0.0


def section_utilisation(c: MemberConstants, N: float, V_y: float, V_z: float, M_y: float, M_z: float) -> list[float]:
    """M_y, M_z and N-M with shear of one section by the clauses; magnitudes."""
    rho_y, rho_z = cross_section.shear_reduction(V_y, c.V_y_Rd), cross_section.shear_reduction(V_z, c.V_z_Rd)
    m_y = ratio(M_y, cross_section.moment_resistance_with_shear(c.M_y_Rd, rho_z, c.M_y_shear))
    m_z = ratio(M_z, cross_section.moment_resistance_with_shear(c.M_z_Rd, rho_y, c.M_z_Rd))
    n = ratio(N, cross_section.axial_resistance_with_shear(c.N_Rd, rho_y, c.V_y_Rd, rho_z, c.V_z_Rd))
    if c.class_3:
        return [m_y, m_z, cross_section.linear_interaction(n, m_y, m_z)]
    if c.shape == "CHS":
        reduced_y = reduced_z = cross_section.moment_resistance_with_axial_force_round(1.0, n)
    else:
        reduced_y = cross_section.moment_resistance_with_axial_force_y(1.0, n, c.a_y)
        if c.shape == "RHS":
            reduced_z = cross_section.moment_resistance_with_axial_force_y(1.0, n, c.a_z)
        else:
            reduced_z = cross_section.moment_resistance_with_axial_force_z(1.0, n, c.a_z)
            if cross_section.axial_force_may_be_ignored_y(n, N, (1.0 - rho_z) * c.N_web):
                reduced_y = 1.0
    return [m_y, m_z, cross_section.plastic_interaction(c.shape, n, m_y, m_z, reduced_y, reduced_z)]


def by_annex_a(c: MemberConstants, N: float, M_y: float, M_z: float) -> InteractionFactors:
    """Annex A in Python; areas and moduli in units of W_pl and I_y."""
    least = min(math.inf if x == 0.0 else 1.0 / x for x in (c.per_N_cr_y, c.per_N_cr_z, c.per_N_cr_T))
    if N >= least:
        return InteractionFactors(*[math.inf if M_y > 0.0 else 0.0, math.inf if M_z > 0.0 else 0.0] * 2)
    critical = [math.inf if x == 0.0 else 1.0 / x for x in (c.per_N_cr_y, c.per_N_cr_z, c.per_N_cr_T)]
    member = AnnexAMember(
        c.N_Rk,
        *critical,
        chi_y=c.N_b_y_Rd / c.N_Rk,
        chi_z=c.chi_z,
        chi_LT=1.0,
        lambda_y=c.lambda_y,
        lambda_z=c.lambda_z,
        lambda_0=c.lambda_0,
        C1=(c.LT_limit / 0.2) ** 2,
        W_pl_y=1.0,
        W_el_y=c.elastic_y,
        W_pl_z=1.0,
        W_el_z=c.elastic_z,
        A=c.area_by_modulus * c.elastic_y,
        I_y=1.0,
        I_t=1.0 - c.a_LT,
        M_pl_y=c.M_b_Rd,
        M_pl_z=c.M_z_Rk,
        plastic=not c.class_3,
    )
    C_my, C_mz = c.C_my + c.C_my_N * N * c.per_N_cr_y, c.C_mz + c.C_mz_N * N * c.per_N_cr_z
    return annex_a_factors(member, N, annex_a_terms(member, N, M_y, M_z, C_my, C_mz))


def by_clauses(
    statics: np.ndarray,
    spectral: np.ndarray,
    static_factors: np.ndarray,
    spectral_factors: np.ndarray,
    combination_set: np.ndarray,
    gravity: np.ndarray,
    members: tuple[MemberConstants, ...],
    masks: np.ndarray,
) -> np.ndarray:
    """The utilisations (m, n_checks) by the clauses."""
    found = np.zeros((len(members), len(Check)))
    for k, of in enumerate(combination_set):
        steady = np.einsum("c,cmsf->msf", static_factors[k], statics)
        swing = np.einsum("d,dmsf->msf", np.abs(spectral_factors[k]), spectral)
        V_G = np.abs(np.einsum("c,cms->ms", static_factors[k] * gravity, statics[..., 2]))
        size = np.abs(steady) + swing
        for m, c in enumerate(members):
            u = np.zeros(len(Check))
            for s in range(statics.shape[2]):
                N, V_y, V_z, _, M_y, M_z = size[m, s]
                other = abs(abs(steady[m, s, 0]) - swing[m, s, 0])
                m_y, m_z, n_m = section_utilisation(c, N, V_y, V_z, M_y, M_z)
                n_m = max(n_m, section_utilisation(c, other, V_y, V_z, M_y, M_z)[2] if swing[m, s, 0] > 0 else 0.0)
                here = np.zeros(len(Check))
                here[[Check.N, Check.V_Y, Check.V_Z]] = N / c.N_Rd, V_y / c.V_y_Rd, V_z / c.V_z_Rd
                here[[Check.M_Y, Check.M_Z, Check.N_M]] = m_y, m_z, n_m
                here[[Check.BEAM_M, Check.BEAM_N]] = M_y / c.M_y_Rd, N / c.N_Rd / 0.15
                here[Check.BEAM_V] = (V_G[m, s] + c.V_M) / c.V_z_Rd / 0.5
                here[Check.COLUMN_V] = max(V_y / c.V_y_Rd, V_z / c.V_z_Rd) / 0.5
                u = np.maximum(u, here)
            compression = max(0.0, (swing[m, :, 0] - steady[m, :, 0]).max())
            n_y, n_z = compression / c.N_b_y_Rd, compression / c.N_b_z_Rd
            m_y, m_z = size[m, :, 4].max() / c.M_b_Rd, size[m, :, 5].max() / c.M_z_Rk
            if c.annex_a:
                factors = by_annex_a(c, compression, size[m, :, 4].max(), size[m, :, 5].max())
            else:
                factors = annex_b_factors(
                    *(c.C_my, c.C_mz, c.C_mLT, c.lambda_y, c.lambda_z, n_y, n_z),
                    plastic=not c.class_3,
                    hollow=c.shape != "I",
                    twists=c.twists,
                )
            u[Check.N_B], u[Check.M_B] = max(n_y, n_z), m_y
            u[[Check.EQ_6_61, Check.EQ_6_62]] = member_interaction(factors, n_y, n_z, m_y, m_z)
            applies = np.array([masks[m, of] >> check & 1 for check in Check], dtype=bool)
            found[m] = np.maximum(found[m], np.where(applies, u, 0.0))
    return found


def random_loads(seed: int, scale: float, members: tuple[MemberConstants, ...] = MEMBERS) -> tuple:
    """Loads on six members: 3 cases, 2 directions, 5 stations, 9 combinations of 3 sets."""
    draw = np.random.default_rng(seed)
    resistance = np.array([[c.N_Rd, c.V_y_Rd, c.V_z_Rd, 1.0, c.M_y_Rd, c.M_z_Rd] for c in members])
    sparse = draw.random((3, len(members), 1, 6)) < 0.8
    statics = scale * sparse * draw.uniform(-1.0, 1.0, (3, len(members), 5, 6)) * resistance[:, None, :]
    spectral = scale * draw.uniform(0.0, 0.6, (2, len(members), 5, 6)) * resistance[:, None, :]
    factors = draw.choice([0.0, 0.3, 1.0, 1.35, -1.0], (9, 3))
    directions = draw.choice([0.0, 0.3, 1.0, -1.0], (9, 2))
    masks = draw.integers(0, ALL + 1, (len(members), 3))
    return statics, spectral, factors, directions, draw.integers(0, 3, 9), np.array([1, 0, 1]), members, masks


def checked(loads: tuple) -> Utilisations:
    return member_checks(*loads[:6], MemberTable.of(loads[6]), loads[7])


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1.2), st.sampled_from([MEMBERS, MEMBERS_A]))
def test_the_core_computes_what_the_clauses_say(seed: int, scale: float, members: tuple[MemberConstants, ...]) -> None:
    loads = random_loads(seed, scale, members)
    found, expected = checked(loads).utilisation, by_clauses(*loads)
    # some tens of roundings of 1.1e-16, which count against what is left of a resistance: 1/u of it
    finite = np.isfinite(expected)
    assert (found[~finite] == expected[~finite]).all()
    found, expected = found[finite], expected[finite]
    assert (np.abs(found - expected) <= expected * (1e-12 + 1e-14 * expected)).all()


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


def one(member: MemberConstants, static: list[float], spectral: list[float] | None = None) -> np.ndarray:
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
    c = COLUMN
    assert one(c, [1e6, 0, 0, 0, 0, 0])[Check.N_B] == 0.0
    assert one(c, [-1e6, 0, 0, 0, 0, 0])[Check.N_B] == pytest.approx(1e6 / c.N_b_z_Rd)
    swinging = one(c, [0.4e6, 0, 0, 0, 0, 0], [1e6, 0, 0, 0, 0, 0])
    assert swinging[Check.N] == pytest.approx(1.4e6 / c.N_Rd)
    assert swinging[Check.N_B] == pytest.approx(0.6e6 / c.N_b_z_Rd)


def test_beam_of_a_frame() -> None:
    """EN 1998-1, 6.6.2(2): by hand; V_Ed,G is that of gravity alone."""
    found = one(BEAM, [-30e3, 0, 60e3, 0, -150e3, 0], [20e3, 0, 80e3, 0, 90e3, 0])
    s = steel_section("IPE400")
    assert found[Check.BEAM_M] == pytest.approx(240e3 / (s.W_pl_y * S275))
    assert found[Check.BEAM_N] == pytest.approx(50e3 / (0.15 * s.A * S275))
    assert found[Check.BEAM_V] == pytest.approx(260e3 / (0.5 * s.A_vz * S275 / math.sqrt(3.0)))
    assert found[Check.COLUMN_V] == pytest.approx(140e3 / (0.5 * s.A_vz * S275 / math.sqrt(3.0)))


def test_thesis_sections_have_the_resistances_of_the_clauses() -> None:
    s = steel_section("HEB320")
    assert COLUMN.N_Rd == s.A * S275 and COLUMN.M_y_Rd == s.W_pl_y * S275
    assert COLUMN.N_b_z_Rd < COLUMN.N_b_y_Rd < COLUMN.N_Rd
    assert HELD.M_b_Rd == HELD.M_y_Rd and not HELD.twists and not BRACE.twists and COLUMN.twists
    reduced = member_constants(s, S275, Stability(3.5, 3.5, 3.5, C1=1.77), 1, gamma_M0=1.1, gamma_M1=1.2)
    assert reduced.N_Rd == pytest.approx(COLUMN.N_Rd / 1.1)
    assert reduced.N_b_z_Rd == pytest.approx(COLUMN.N_b_z_Rd / 1.2)
    with pytest.raises(InputError, match="HEB320 is of class 4"):
        member_constants(s, S275, Stability(3.5, 3.5, 3.5), 4)
    general = member_constants(s, S275, Stability(3.5, 3.5, 3.5, general=True), 1)
    assert general.M_b_Rd < COLUMN.M_b_Rd
    assert section_class(steel_section("HEA300"), 355e6).number == 3


def test_torsional_buckling_counts_where_it_is_less() -> None:
    s = steel_section("HEB320")
    held = member_constants(s, S275, Stability(3.0, 1.0, 12.0), 1)
    flexural = member_constants(s, S275, Stability(3.0, 1.0, 0.0), 1)
    assert held.N_b_z_Rd < flexural.N_b_z_Rd and held.lambda_z == flexural.lambda_z


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
        replace(COLUMN, N_Rd=0.0),
        replace(MEMBERS_A[0], N_Rk=0.0),
        replace(MEMBERS_A[0], elastic_y=1.2),
        replace(MEMBERS_A[0], a_LT=-0.1),
        replace(MEMBERS_A[0], C_my_N=-1.5),
    ):
        with pytest.raises(CoreError, match="invalid argument"):
            checked((statics, spectral, *rest[:4], (member, *MEMBERS[1:]), masks))
    with pytest.raises(CoreError, match="invalid argument"):
        checked((statics, spectral, rest[0], rest[1], rest[2] + 3, *rest[3:], masks))
