"""Members in bending and axial compression, EN 1993-1-1:2005, 6.3.3, with Annex A or Annex B.

Compression and moments are magnitudes; moments are the largest along the member. Sections are of class 1, 2 or 3, so
that no shift of the centroid enters.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from edesign.codes.ec3.buckling import Flexural
from edesign.codes.ec3.section import SteelSection
from edesign.codes.trace import Trace, kept

ALL = ("yy", "yz", "zy", "zz")
"""Indices of the factors k."""
_TABLE_A1 = "Annex A, Table A.1"


class InteractionFactors(NamedTuple):
    """The factors k of Eqs. 6.61 and 6.62."""

    k_yy: float
    k_yz: float
    k_zy: float
    k_zz: float


def member_interaction(
    factors: InteractionFactors, n_y: float, n_z: float, m_y: float, m_z: float
) -> tuple[float, float]:
    """Return the left sides of Eqs. 6.61 and 6.62, which must not exceed 1.

    Args:
        factors: by `annex_a_factors` or `annex_b_factors`.
        n_y: N_Ed / (chi_y N_Rk / gamma_M1).
        n_z: N_Ed / (chi_z N_Rk / gamma_M1).
        m_y: M_y,Ed / (chi_LT M_y,Rk / gamma_M1).
        m_z: M_z,Ed / (M_z,Rk / gamma_M1).

    Source: EN 1993-1-1:2005, 6.3.3(4), Eqs. 6.61 and 6.62.
    """
    return (
        n_y + factors.k_yy * m_y + factors.k_yz * m_z,
        n_z + factors.k_zy * m_y + factors.k_zz * m_z,
    )


def annex_b_factors(
    C_my: float,
    C_mz: float,
    C_mLT: float,
    lambda_y: float,
    lambda_z: float,
    n_y: float,
    n_z: float,
    plastic: bool = True,
    hollow: bool = False,
    twists: bool = True,
    trace: Trace | None = None,
    recorded: Sequence[str] = ALL,
) -> InteractionFactors:
    """Return the factors of Annex B.

    Args:
        C_my: equivalent uniform moment factor about y, Table B.3.
        C_mz: equivalent uniform moment factor about z.
        C_mLT: equivalent uniform moment factor for lateral-torsional buckling.
        lambda_y: slenderness in flexural buckling about y.
        lambda_z: slenderness in flexural buckling about z.
        n_y: N_Ed / (chi_y N_Rk / gamma_M1).
        n_z: N_Ed / (chi_z N_Rk / gamma_M1).
        plastic: class 1 or 2; otherwise class 3.
        hollow: an RHS, whose k_zz is that of k_yy; circular sections are taken as these.
        twists: the member is susceptible to torsional deformation (Table B.2); hollow sections and members whose
            twisting is prevented are not (Table B.1).
        trace: records the factors.
        recorded: which of them.

    Returns:
        k_yy, k_yz, k_zy and k_zz.

    Source: EN 1993-1-1:2005, Annex B, Tables B.1 and B.2; SCI P362, Designers' Guide to EN 1993-1-1 (Gardner &
        Nethercot), 6.3.3.
    """
    if plastic:
        k_yy = C_my * (1.0 + min(lambda_y - 0.2, 0.8) * n_y)
        yy = "C_my (1 + min(lambda_y - 0.2, 0.8) n_y)"
        k_zz = C_mz * (1.0 + (min(lambda_z - 0.2, 0.8) if hollow else min(2.0 * lambda_z - 0.6, 1.4)) * n_z)
        zz = f"C_mz (1 + min({'lambda_z - 0.2, 0.8' if hollow else '2 lambda_z - 0.6, 1.4'}) n_z)"
        k_yz, yz = 0.6 * k_zz, f"0.6 {zz}"
        if not twists:
            k_zy, zy = 0.6 * k_yy, f"0.6 {yy}"
        elif lambda_z < 0.4:
            k_zy = min(0.6 + lambda_z, 1.0 - 0.1 * lambda_z / (C_mLT - 0.25) * n_z)
            zy = "min(0.6 + lambda_z, 1 - 0.1 lambda_z / (C_mLT - 0.25) n_z)"
        else:
            k_zy = 1.0 - 0.1 * min(lambda_z, 1.0) / (C_mLT - 0.25) * n_z
            zy = "1 - 0.1 min(lambda_z, 1) / (C_mLT - 0.25) n_z"
    else:
        k_yy, yy = C_my * (1.0 + 0.6 * min(lambda_y, 1.0) * n_y), "C_my (1 + 0.6 min(lambda_y, 1) n_y)"
        k_zz, zz = C_mz * (1.0 + 0.6 * min(lambda_z, 1.0) * n_z), "C_mz (1 + 0.6 min(lambda_z, 1) n_z)"
        k_yz, yz = k_zz, zz
        if twists:
            k_zy = 1.0 - 0.05 * min(lambda_z, 1.0) / (C_mLT - 0.25) * n_z
            zy = "1 - 0.05 min(lambda_z, 1) / (C_mLT - 0.25) n_z"
        else:
            k_zy, zy = 0.8 * k_yy, f"0.8 {yy}"
    factors, expressions = InteractionFactors(k_yy, k_yz, k_zy, k_zz), {"yy": yy, "yz": yz, "zy": zy, "zz": zz}
    for index in recorded:
        table = "Annex B, Table B.2" if twists else "Annex B, Table B.1"
        kept(trace).add(f"k_{index}", getattr(factors, f"k_{index}"), "1", expressions[index], table)
    return factors


def annex_a_factors(
    section: SteelSection,
    y: Flexural,
    z: Flexural,
    N_cr_T: float,
    lambda_0: float,
    C1: float,
    N_Rk: float,
    N_Ed: float,
    M_y_Ed: float,
    m_y: float,
    m_z: float,
    C_my_0: float,
    C_mz_0: float,
    plastic: bool = True,
    trace: Trace | None = None,
    recorded: Sequence[str] = ALL,
) -> InteractionFactors:
    """Return the factors of Annex A; infinite, or 0 without moment, where N_Ed reaches an elastic critical force.

    Args:
        section: its areas and moduli.
        N_cr_T: elastic critical force of torsional buckling, N.
        lambda_0: slenderness in lateral torsional buckling under uniform moment (C1 = 1); 0 without it.
        C1: of the moment diagram.
        N_Rk: A f_y by gamma_M1, N.
        N_Ed: compression, N.
        M_y_Ed: largest moment about y along the member, N m.
        m_y: M_y,Ed / (chi_LT M_y,Rk / gamma_M1).
        m_z: M_z,Ed / (M_z,Rk / gamma_M1).
        C_my_0: factor of the moments about y by Table A.2.
        C_mz_0: factor of the moments about z by Table A.2.
        plastic: class 1 or 2; otherwise class 3.
        trace: records the factors k and the terms of Table A.1 that they follow from.

    Returns:
        k_yy, k_yz, k_zy and k_zz.

    Source: EN 1993-1-1:2005 + AC:2009, Table A.1; ECCS publication 119, Rules for member stability in EN 1993-1-1.
        Below the limit of lambda_0 the terms b_LT to e_LT vanish, as in ECCS 119. Public programs differ in C_zz: two
        multiply e_LT by n_pl, as here, one does not.
    """
    s, steps, a_LT = section, kept(trace), max(1.0 - section.I_t / section.I_y, 0.0)
    by = {"y": N_Ed / y.N_cr, "z": N_Ed / z.N_cr, "T": N_Ed / N_cr_T}
    for axis, share in by.items():
        if share >= 1.0:
            return beyond_critical(axis, m_y, m_z, trace, recorded)

    def add(symbol: str, value: float, expression: str) -> float:
        return steps.add(symbol, value, "1", expression, _TABLE_A1)

    C_my, of_my, C_mLT, of_mLT, below = C_my_0, "C_my,0", 1.0, "1", ""
    lateral = (1.0 - by["z"]) * (1.0 - by["T"])
    limit = 0.2 * math.sqrt(C1) * lateral**0.25
    if lambda_0 > 0.0:
        of_limit = f"0.2 sqrt({C1:.4g}) ((1 - N_Ed / N_cr,z) (1 - N_Ed / N_cr,T))^0.25, C_1 = {C1:.4g}"
        add("lambda_0,lim", limit, of_limit)
        below = ", as lambda_0 <= lambda_0,lim"
    if lambda_0 > limit:
        add("a_LT", a_LT, "1 - I_t / I_y >= 0")
        C_my, of_my, below = 1.0, "1, without N_Ed", ""
        if N_Ed > 0.0:
            steps.add("W_el,y", s.W_el_y, "m3")
            epsilon_y = add("epsilon_y", M_y_Ed / N_Ed * s.A / s.W_el_y, "M_y,Ed / N_Ed A / W_el,y")
            root = math.sqrt(epsilon_y) * a_LT
            C_my = C_my_0 + (1.0 - C_my_0) * (root / (1.0 + root) if root < math.inf else 1.0)
            of_my = "C_my,0 + (1 - C_my,0) sqrt(epsilon_y) a_LT / (1 + sqrt(epsilon_y) a_LT)"
        C_mLT = max(C_my**2 * a_LT / math.sqrt(lateral), 1.0)
        of_mLT = "C_my^2 a_LT / sqrt((1 - N_Ed / N_cr,z) (1 - N_Ed / N_cr,T)) >= 1"
    else:
        lambda_0 = 0.0  # without lateral torsional buckling
    add("C_my", C_my, f"{of_my}{below}")
    C_mz = add("C_mz", C_mz_0, "C_mz,0")
    add("C_mLT", C_mLT, f"{of_mLT}{below}")
    mu = {"y": (1.0 - by["y"]) / (1.0 - y.chi * by["y"]), "z": (1.0 - by["z"]) / (1.0 - z.chi * by["z"])}
    chi = {"y": "chi_y", "z": "chi_z" if math.isinf(N_cr_T) else "chi by bending"}
    for row in dict.fromkeys(index[0] for index in recorded):
        add(f"mu_{row}", mu[row], f"(1 - N_Ed / N_cr,{row}) / (1 - {chi[row]} N_Ed / N_cr,{row})")
    of_moment = {"y": C_my * C_mLT / (1.0 - by["y"]), "z": C_mz / (1.0 - by["z"])}
    k = {index: of_moment[index[1]] * mu[index[0]] for index in ALL}
    if plastic:
        n_pl, slender = N_Ed / N_Rk, (y.slenderness, z.slenderness)
        w_y, w_z = min(s.W_pl_y / s.W_el_y, 1.5), min(s.W_pl_z / s.W_el_z, 1.5)
        C = _plasticity_factors(s, w_y, w_z, n_pl, slender, a_LT, lambda_0, m_y, m_z, C_my, C_mz, steps, recorded)
        k = {index: k[index] / C[index] for index in ALL}
        k["yz"] = k["yz"] * 0.6 * math.sqrt(w_z / w_y)
        k["zy"] = k["zy"] * 0.6 * math.sqrt(w_y / w_z)
    for index in recorded:
        row, column = index[0], index[1]
        factor = ("C_my C_mLT" if column == "y" else "C_mz") + f" mu_{row} / (1 - N_Ed / N_cr,{column})"
        if plastic:
            factor += f" / C_{index}" + (f" 0.6 sqrt(w_{column} / w_{row})" if row != column else "")
        add(f"k_{index}", k[index], factor)
    return InteractionFactors(*(k[index] for index in ALL))


def _plasticity_factors(
    s: SteelSection,
    w_y: float,
    w_z: float,
    n_pl: float,
    slender: tuple[float, float],
    a_LT: float,
    lambda_0: float,
    m_y: float,
    m_z: float,
    C_my: float,
    C_mz: float,
    steps: Trace,
    recorded: Sequence[str],
) -> dict[str, float]:
    """Return C_ij of Table A.1 by index."""

    def add(symbol: str, value: float, expression: str) -> float:
        return steps.add(symbol, value, "1", expression, _TABLE_A1)

    elastic_y, elastic_z = s.W_el_y / s.W_pl_y, s.W_el_z / s.W_pl_z
    for axis, w in (("y", w_y), ("z", w_z)):
        for theory in ("el", "pl"):
            steps.add(f"W_{theory},{axis}", getattr(s, f"W_{theory}_{axis}"), "m3")
        add(f"w_{axis}", w, f"W_pl,{axis} / W_el,{axis} <= 1.5")
    add("n_pl", n_pl, "N_Ed / (A f_y / gamma_M1)")
    most, lambda_z = add("lambda_max", max(slender), "max(lambda_y, lambda_z)"), slender[1]
    yz, zy = 0.6 * math.sqrt(w_z / w_y), 0.6 * math.sqrt(w_y / w_z)
    b_LT = 0.5 * a_LT * lambda_0**2 * m_y * m_z
    c_LT = 10.0 * a_LT * lambda_0**2 / (5.0 + lambda_z**4) * m_y / C_my
    d_LT = 2.0 * a_LT * lambda_0 / (0.1 + lambda_z**4) * m_y / C_my * m_z / C_mz
    e_LT = 1.7 * a_LT * lambda_0 / (0.1 + lambda_z**4) * m_y / C_my
    lateral = {
        "yy": ("b_LT", b_LT, "0.5 a_LT lambda_0^2 m_y m_z"),
        "yz": ("c_LT", c_LT, "10 a_LT lambda_0^2 / (5 + lambda_z^4) m_y / C_my"),
        "zy": ("d_LT", d_LT, "2 a_LT lambda_0 / (0.1 + lambda_z^4) m_y / C_my m_z / C_mz"),
        "zz": ("e_LT", e_LT, "1.7 a_LT lambda_0 / (0.1 + lambda_z^4) m_y / C_my"),
    }
    found = {
        "yy": (
            max(1.0 + (w_y - 1.0) * ((2.0 - 1.6 / w_y * C_my**2 * (most + most**2)) * n_pl - b_LT), elastic_y),
            "1 + (w_y - 1) [(2 - 1.6 / w_y C_my^2 (lambda_max + lambda_max^2)) n_pl - b_LT] >= W_el,y / W_pl,y",
        ),
        "yz": (
            max(1.0 + (w_z - 1.0) * ((2.0 - 14.0 * C_mz**2 * most**2 / w_z**5) * n_pl - c_LT), yz * elastic_z),
            "1 + (w_z - 1) [(2 - 14 C_mz^2 lambda_max^2 / w_z^5) n_pl - c_LT] >= 0.6 sqrt(w_z / w_y) W_el,z / W_pl,z",
        ),
        "zy": (
            max(1.0 + (w_y - 1.0) * ((2.0 - 14.0 * C_my**2 * most**2 / w_y**5) * n_pl - d_LT), zy * elastic_y),
            "1 + (w_y - 1) [(2 - 14 C_my^2 lambda_max^2 / w_y^5) n_pl - d_LT] >= 0.6 sqrt(w_y / w_z) W_el,y / W_pl,y",
        ),
        "zz": (
            max(1.0 + (w_z - 1.0) * (2.0 - 1.6 / w_z * C_mz**2 * (most + most**2) - e_LT) * n_pl, elastic_z),
            "1 + (w_z - 1) [2 - 1.6 / w_z C_mz^2 (lambda_max + lambda_max^2) - e_LT] n_pl >= W_el,z / W_pl,z",
        ),
    }
    for index in recorded:
        symbol, less, expression = lateral[index]
        add(symbol, less, expression if lambda_0 > 0.0 else "no lateral torsional buckling")
        add(f"C_{index}", *found[index])
    return {index: C_ij for index, (C_ij, _) in found.items()}


def beyond_critical(
    axis: str, m_y: float, m_z: float, trace: Trace | None = None, recorded: Sequence[str] = ALL
) -> InteractionFactors:
    """Return infinite factors, as N_Ed is not below an elastic critical force; 0 where there is no moment.

    Args:
        axis: of the critical force: "y", "z" or "T".
        m_y: see `annex_a_factors`.
        m_z: see `annex_a_factors`.
        trace: records the factors.
        recorded: which of them.
    """
    k = {"y": math.inf if m_y > 0.0 else 0.0, "z": math.inf if m_z > 0.0 else 0.0}
    for index in recorded:
        why = f"N_Ed is not below N_cr,{axis}" if k[index[1]] > 0.0 else f"without m_{index[1]}"
        kept(trace).add(f"k_{index}", k[index[1]], "1", why, _TABLE_A1)
    return InteractionFactors(k["y"], k["z"], k["y"], k["z"])
