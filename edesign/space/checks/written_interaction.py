"""Members in bending and compression written out, EN 1993-1-1:2005, 6.3.3, with Annex A or Annex B."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from edesign.codes.ec3 import cross_section, interaction, lateral_torsional
from edesign.codes.ec3.interaction import AnnexAMember, AnnexATerms, InteractionFactors
from edesign.space.checks.written_steps import M_Y, M_Z, Calculation, Flexural

_TABLE_A1 = "Annex A, Table A.1"


class _Known(NamedTuple):
    """What the factors k follow from: effects, resistances and their ratios n_y, n_z, m_y, m_z."""

    N_Ed: float
    M_y: float
    M_z: float
    y: Flexural
    z: Flexural
    M_b: float
    M_z_Rk: float
    n_y: float
    n_z: float
    m_y: float
    m_z: float


def bending_and_compression(equation: int) -> Callable[[Calculation, int], None]:
    """Return the function that writes the steps of an interaction equation; its station does not count.

    Args:
        equation: 61 for Eq. 6.61, 62 for Eq. 6.62.
    """
    pair = ("yy", "yz") if equation == 61 else ("zy", "zz")

    def write(w: Calculation, station: int) -> None:
        of = _known(w)
        k = (_annex_a if w.member.annex_a else _annex_b)(w, of, pair)
        axis, n = ("y", of.n_y) if equation == 61 else ("z", of.n_z)
        uses = interaction.member_interaction(k, of.n_y, of.n_z, of.m_y, of.m_z)
        symbols = f"n_{axis} + k_{pair[0]} m_y + k_{pair[1]} m_z"
        k_y, k_z = (getattr(k, f"k_{index}") for index in pair)
        numbers = f"{n:.4g} + {k_y:.4g} x {of.m_y:.4g} + {k_z:.4g} x {of.m_z:.4g}"
        w.use(uses[0 if equation == 61 else 1], f"{symbols} = {numbers}", f"6.3.3(4), Eq. 6.{equation}")

    return write


def _known(w: Calculation) -> _Known:
    w.section_class()
    w.steel(stability=True)
    N_Ed, M_y, M_z = w.compression(), w.largest(M_Y), w.largest(M_Z)
    w.area()
    y, z = w.flexural("y"), w.flexural("z")
    M_b = w.M_b_Rd()
    M_z_Rk = cross_section.moment_resistance(w.modulus("z"), w.member.fy, w.member.gamma_M1)
    w.add("M_z,Rk / gamma_M1", M_z_Rk, "N*m", f"W_{w.theory},z f_y / gamma_M1", "6.3.3, Table 6.7")
    n_y = w.add("n_y", N_Ed / y.N_b_Rd, "1", "N_Ed / (chi_y N_Rk / gamma_M1)")
    n_z = w.add("n_z", N_Ed / z.N_b_Rd, "1", "N_Ed / (chi_z N_Rk / gamma_M1)")
    m_y = w.add("m_y", M_y / M_b, "1", "M_y,Ed / (chi_LT M_y,Rk / gamma_M1)")
    m_z = w.add("m_z", M_z / M_z_Rk, "1", "M_z,Ed / (M_z,Rk / gamma_M1)")
    return _Known(N_Ed, M_y, M_z, y, z, M_b, M_z_Rk, n_y, n_z, m_y, m_z)


def _annex_b(w: Calculation, of: _Known, pair: tuple[str, str]) -> InteractionFactors:
    held = w.member.stability
    for symbol, value in (("C_my", held.C_my), ("C_mz", held.C_mz), ("C_mLT", held.C_mLT)):
        w.add(symbol, value, "1", "", "Annex B, Table B.3")
    hollow, twists = w.section.kind != "I", w.member.constants.twists
    slender = of.y.slenderness, of.z.slenderness
    shape = (held.C_my, held.C_mz, held.C_mLT, *slender, of.n_y, of.n_z, w.plastic, hollow, twists)
    k = interaction.annex_b_factors(*shape)
    formulas = _annex_b_formulas(w.plastic, hollow, twists, of.z.slenderness)
    for index in pair:
        table = "Annex B, Table B.2" if twists else "Annex B, Table B.1"
        w.add(f"k_{index}", getattr(k, f"k_{index}"), "1", formulas[index], table)
    return k


def _annex_b_formulas(plastic: bool, hollow: bool, twists: bool, lambda_z: float) -> dict[str, str]:
    """The factors of Annex B in symbols, by their index."""
    if plastic:
        yy = "C_my (1 + min(lambda_y - 0.2, 0.8) n_y)"
        zz = f"C_mz (1 + min({'lambda_z - 0.2, 0.8' if hollow else '2 lambda_z - 0.6, 1.4'}) n_z)"
        zy = "1 - 0.1 min(lambda_z, 1) / (C_mLT - 0.25) n_z"
        if lambda_z < 0.4:
            zy = "min(0.6 + lambda_z, 1 - 0.1 lambda_z / (C_mLT - 0.25) n_z)"
        return {"yy": yy, "yz": f"0.6 {zz}", "zy": zy if twists else f"0.6 {yy}", "zz": zz}
    yy, zz = (f"C_m{of} (1 + 0.6 min(lambda_{of}, 1) n_{of})" for of in "yz")
    zy = "1 - 0.05 min(lambda_z, 1) / (C_mLT - 0.25) n_z"
    return {"yy": yy, "yz": zz, "zy": zy if twists else f"0.8 {yy}", "zz": zz}


def _annex_a(w: Calculation, of: _Known, pair: tuple[str, str]) -> InteractionFactors:
    s, N_cr_T = w.section, w.N_cr_T()
    for axis, N_cr in (("y", of.y.N_cr), ("z", of.z.N_cr), ("T", N_cr_T)):
        held = "" if N_cr < math.inf else "hollow section" if axis == "T" and s.kind != "I" else "held all along"
        if w.add(f"N_Ed / N_cr,{axis}", of.N_Ed / N_cr, "1", held) >= 1.0:
            return _beyond_critical(w, of, pair, axis)
    member = AnnexAMember(
        N_Rk=cross_section.axial_resistance(s.A, w.member.fy, w.member.gamma_M1),
        N_cr_y=of.y.N_cr,
        N_cr_z=of.z.N_cr,
        N_cr_T=N_cr_T,
        chi_y=of.y.chi,
        chi_z=of.z.chi,
        chi_LT=1.0,  # that of M_b,Rd
        lambda_y=of.y.slenderness,
        lambda_z=of.z.slenderness,
        lambda_0=_lambda_0(w),
        C1=w.member.stability.C1,
        W_pl_y=s.W_pl_y,
        W_el_y=s.W_el_y,
        W_pl_z=s.W_pl_z,
        W_el_z=s.W_el_z,
        A=s.A,
        I_y=s.I_y,
        I_t=s.I_t,
        M_pl_y=of.M_b,
        M_pl_z=of.M_z_Rk,
        plastic=w.plastic,
    )
    C_my_0, C_mz_0 = _C_m_0(w, "y", of.N_Ed / of.y.N_cr), _C_m_0(w, "z", of.N_Ed / of.z.N_cr)
    terms = interaction.annex_a_terms(member, of.N_Ed, of.M_y, of.M_z, C_my_0, C_mz_0)
    twists = _moment_factors(w, of, member, terms)
    axis = pair[0][0]
    chi = "chi by bending" if axis == "z" and w.twists else f"chi_{axis}"
    mu = f"(1 - N_Ed / N_cr,{axis}) / (1 - {chi} N_Ed / N_cr,{axis})"
    w.add(f"mu_{axis}", getattr(terms, f"mu_{axis}"), "1", mu, _TABLE_A1)
    if w.plastic:
        _plasticity_factors(w, member, terms, pair, twists)
    k = interaction.annex_a_factors(member, of.N_Ed, terms)
    for index in pair:
        row, column = index[0], index[1]
        factor = ("C_my C_mLT" if column == "y" else "C_mz") + f" mu_{row} / (1 - N_Ed / N_cr,{column})"
        if w.plastic:
            factor += f" / C_{index}" + (f" 0.6 sqrt(w_{column} / w_{row})" if row != column else "")
        w.add(f"k_{index}", getattr(k, f"k_{index}"), "1", factor, _TABLE_A1)
    return k


def _beyond_critical(w: Calculation, of: _Known, pair: tuple[str, str], axis: str) -> InteractionFactors:
    """Infinite factors; 0 where there is no moment that they multiply."""
    k_y, k_z = (math.inf if m > 0.0 else 0.0 for m in (of.m_y, of.m_z))
    for index, k, m in zip(pair, (k_y, k_z), "yz", strict=True):
        w.add(f"k_{index}", k, "1", f"N_Ed is not below N_cr,{axis}" if k > 0.0 else f"without m_{m}", _TABLE_A1)
    return InteractionFactors(k_y, k_z, k_y, k_z)


def _C_m_0(w: Calculation, axis: str, by: float) -> float:
    held = w.member.stability
    C_m, slope = (held.C_my, held.C_my_N) if axis == "y" else (held.C_mz, held.C_mz_N)
    expression = f"{C_m:.4g} {'-' if slope < 0.0 else '+'} {abs(slope):.4g} N_Ed / N_cr,{axis}"
    return w.add(f"C_m{axis},0", C_m + slope * by, "1", expression, "Annex A, Table A.2")


def _lambda_0(w: Calculation) -> float:
    """The slenderness in lateral torsional buckling under uniform moment."""
    s, member = w.section, w.member
    if not w.twists:
        return w.add("lambda_0", 0.0, "1", "no lateral torsional buckling", _TABLE_A1)
    of = member.E, member.G, s.I_z, s.I_t, s.I_w, member.stability.L_LT
    critical = lateral_torsional.critical_moment(*of)
    w.add("M_cr,0", critical, "N*m", "M_cr of a uniform moment over L_T: C_1 = 1, C_2 = 0", "SN003")
    slenderness = lateral_torsional.slenderness(w.modulus("y"), member.fy, critical)
    return w.add("lambda_0", slenderness, "1", f"sqrt(W_{w.theory},y f_y / M_cr,0)", _TABLE_A1)


def _moment_factors(w: Calculation, of: _Known, member: AnnexAMember, terms: AnnexATerms) -> bool:
    """C_my, C_mz, C_mLT; return whether lateral torsional buckling counts."""
    C_mLT, C_my = "1", "C_my,0"
    twists = member.lambda_0 > terms.lambda_0_lim
    if member.lambda_0 > 0.0:
        limit = f"0.2 sqrt({member.C1:.4g}) ((1 - N_Ed / N_cr,z) (1 - N_Ed / N_cr,T))^0.25, C_1 = {member.C1:.4g}"
        w.add("lambda_0,lim", terms.lambda_0_lim, "1", limit, _TABLE_A1)
    if twists:
        w.add("a_LT", terms.a_LT, "1", "1 - I_t / I_y >= 0", _TABLE_A1)
        C_my = "1, without N_Ed"
        if of.N_Ed > 0.0:
            modulus = w.add("W_el,y", member.W_el_y, "m3")
            w.add("epsilon_y", of.M_y / of.N_Ed * member.A / modulus, "1", "M_y,Ed / N_Ed A / W_el,y", _TABLE_A1)
            C_my = "C_my,0 + (1 - C_my,0) sqrt(epsilon_y) a_LT / (1 + sqrt(epsilon_y) a_LT)"
        C_mLT = "C_my^2 a_LT / sqrt((1 - N_Ed / N_cr,z) (1 - N_Ed / N_cr,T)) >= 1"
    below = "" if twists or member.lambda_0 == 0.0 else ", as lambda_0 <= lambda_0,lim"
    w.add("C_my", terms.C_my, "1", f"{C_my}{below}", _TABLE_A1)
    w.add("C_mz", terms.C_mz, "1", "C_mz,0", _TABLE_A1)
    w.add("C_mLT", terms.C_mLT, "1", f"{C_mLT}{below}", _TABLE_A1)
    return twists


_LATERAL = {  # by the index of the C that it makes less
    "yy": ("b_LT", "0.5 a_LT lambda_0^2 m_y m_z"),
    "yz": ("c_LT", "10 a_LT lambda_0^2 / (5 + lambda_z^4) m_y / C_my"),
    "zy": ("d_LT", "2 a_LT lambda_0 / (0.1 + lambda_z^4) m_y / C_my m_z / C_mz"),
    "zz": ("e_LT", "1.7 a_LT lambda_0 / (0.1 + lambda_z^4) m_y / C_my"),
}
_PLASTICITY = {  # with that term and its least value
    "yy": ("[(2 - 1.6 / w_y C_my^2 (lambda_max + lambda_max^2)) n_pl - {}]", "W_el,y / W_pl,y"),
    "yz": ("[(2 - 14 C_mz^2 lambda_max^2 / w_z^5) n_pl - {}]", "0.6 sqrt(w_z / w_y) W_el,z / W_pl,z"),
    "zy": ("[(2 - 14 C_my^2 lambda_max^2 / w_y^5) n_pl - {}]", "0.6 sqrt(w_y / w_z) W_el,y / W_pl,y"),
    "zz": ("[2 - 1.6 / w_z C_mz^2 (lambda_max + lambda_max^2) - {}] n_pl", "W_el,z / W_pl,z"),
}


def _plasticity_factors(
    w: Calculation, member: AnnexAMember, terms: AnnexATerms, pair: tuple[str, str], twists: bool
) -> None:
    for axis in "yz":
        for theory in ("el", "pl"):
            w.add(f"W_{theory},{axis}", getattr(member, f"W_{theory}_{axis}"), "m3")
        w.add(f"w_{axis}", getattr(terms, f"w_{axis}"), "1", f"W_pl,{axis} / W_el,{axis} <= 1.5", _TABLE_A1)
    w.add("n_pl", terms.n_pl, "1", "N_Ed / (A f_y / gamma_M1)", _TABLE_A1)
    w.add("lambda_max", max(member.lambda_y, member.lambda_z), "1", "max(lambda_y, lambda_z)", _TABLE_A1)
    for index in pair:
        symbol, lateral = _LATERAL[index]
        w.add(symbol, getattr(terms, symbol), "1", lateral if twists else "no lateral torsional buckling", _TABLE_A1)
        bracket, least = _PLASTICITY[index]
        expression = f"1 + (w_{index[1]} - 1) {bracket.format(symbol)} >= {least}"
        w.add(f"C_{index}", getattr(terms, f"C_{index}"), "1", expression, _TABLE_A1)
